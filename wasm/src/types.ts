/** Typed arrays of memory of their own: `Uint8Array<ArrayBuffer>` and so on where TypeScript has these (5.7 and later). */
export type Bytes = ReturnType<typeof Uint8Array.of>;
export type Doubles = ReturnType<typeof Float64Array.of>;
export type Floats = ReturnType<typeof Float32Array.of>;
export type Integers = ReturnType<typeof Int32Array.of>;

// What is used of the platform's classes, so that neither the DOM's types nor Node's are needed.
/** A `URL`. */
export interface UrlLike { readonly href: string }

/** A `Response`. */
export interface ResponseLike {
  readonly url: string;
  readonly ok: boolean;
  readonly status: number;
  readonly statusText: string;
  readonly headers: { get(name: string): string | null };
  arrayBuffer(): Promise<ArrayBuffer>;
}

/** A `WebAssembly.Module`. */
export type CompiledModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer M } } } ? M : object;

/** An `AbortSignal`. */
export interface AbortSignalLike {
  readonly aborted: boolean;
  addEventListener(type: 'abort', listener: () => void): void;
  removeEventListener(type: 'abort', listener: () => void): void;
}

/** A `Worker` of a page, or of Node's `worker_threads`. */
export type WorkerLike = { postMessage(message: unknown): void; terminate(): unknown } & (
  | { addEventListener(type: string, listener: (event: any) => void): void }
  | { on(event: string, listener: (value: any) => void): unknown });

/**
 * Where a WebAssembly file comes from: an address (relative to the page), in Node also a path; an answer of `fetch`, bytes or a
 * compiled module; or a promise of one.
 */
export type WasmSource = WasmContent | PromiseLike<WasmContent>;
export type WasmContent = string | UrlLike | ResponseLike | ArrayBuffer | ArrayBufferView | CompiledModule;
