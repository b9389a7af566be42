import type { Exports, Pointer } from './exports.js';

/** Where a WebAssembly file comes from; the package's own, next to its code, where nothing is given. */
export type WasmSource = string | URL | Response | BufferSource | WebAssembly.Module;

/** Emscripten's module. Its views are new objects after memory has grown: they are looked up at each use. */
export interface Module extends Exports {
  HEAPU8: Uint8Array<ArrayBuffer>;
  HEAP32: Int32Array<ArrayBuffer>;
  HEAPU32: Uint32Array<ArrayBuffer>;
  HEAPF32: Float32Array<ArrayBuffer>;
  HEAPF64: Float64Array<ArrayBuffer>;
  _malloc(size: number): Pointer;
  _free(pointer: Pointer): void;
}

export interface ModuleHooks {
  instantiateWasm(imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void): object;
  onBakeProgress?(stage: string, fraction: number): number;
}

/** What emscripten's glue exports. */
export type Factory = (hooks: ModuleHooks) => Promise<Module>;

export type Status =
  | 'invalid_input' | 'io' | 'unsupported' | 'cancelled' | 'out_of_memory' | 'failed' | 'disposed';
const kStatus: readonly Status[] = ['failed', 'invalid_input', 'io', 'unsupported', 'cancelled', 'out_of_memory', 'failed'];

/** The message is a sentence that names the thing, the place and the remedy. */
export class MimicryError extends Error {
  override readonly name = 'MimicryError';
  constructor(readonly status: Status, message: string) {
    super(message);
  }
}

const isNode = typeof process !== 'undefined' && process.versions?.node !== undefined;

async function compiled(source: WasmSource): Promise<WebAssembly.Module> {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source as BufferSource);
  if (typeof source === 'string' || source instanceof URL) {
    const url = new URL(source, import.meta.url);
    if (isNode && url.protocol === 'file:') {
      // Not a text that a bundler for pages would follow.
      const files = ['node:fs', 'promises'].join('/');
      const { readFile } = (await import(/* @vite-ignore */ files)) as typeof import('node:fs/promises');
      return WebAssembly.compile(await readFile(url));
    }
    return arriving(await fetch(url));
  }
  return arriving(source as Response);
}

async function arriving(response: Response): Promise<WebAssembly.Module> {
  if (!response.ok) throw new MimicryError('io', `${response.url}: the server answers ${response.status} ${response.statusText}; is the file beside the package's code?`);
  // Compiling while it arrives needs the right content type; not every server sends it.
  if (response.headers.get('content-type') === 'application/wasm') return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** A module ready for use. */
export async function instantiate(factory: Factory, source: WasmSource, onBakeProgress?: ModuleHooks['onBakeProgress']): Promise<Module> {
  const code = await compiled(source);
  return new Promise<Module>((resolve, reject) => {
    const hooks: ModuleHooks = {
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(code, imports).then(done, reject);
        return {};
      },
    };
    if (onBakeProgress) hooks.onBakeProgress = onBakeProgress;
    factory(hooks).then(resolve, reject);
  });
}

const kDecoder = new TextDecoder();
const kEncoder = new TextEncoder();

/** The text at an address, up to its 0. */
export function textAt(m: Module, pointer: Pointer): string {
  if (pointer === 0) return '';
  return kDecoder.decode(m.HEAPU8.subarray(pointer, m.HEAPU8.indexOf(0, pointer)));
}

export function check(m: Module, status: number): void {
  if (status === 0) return;
  throw new MimicryError(kStatus[status] ?? 'failed', textAt(m, m._mimicry_last_error()));
}

type Put = Uint8Array | Float64Array | Int32Array | string;

/** Memory for the arguments of one call, given back by `end`. */
export class Arguments {
  private readonly held: Pointer[] = [];
  constructor(private readonly m: Module) {}

  room(bytes: number): Pointer {
    const pointer = this.m._malloc(Math.max(bytes, 8));
    if (pointer === 0) throw new MimicryError('out_of_memory', `there is no memory left for ${bytes} bytes; use a smaller file or close something else`);
    this.held.push(pointer);
    return pointer;
  }

  put(data: Put): Pointer {
    const bytes = typeof data === 'string' ? kEncoder.encode(data + '\0') : new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
    const pointer = this.room(bytes.length);
    this.m.HEAPU8.set(bytes, pointer);
    return pointer;
  }

  end(): void {
    for (const pointer of this.held) this.m._free(pointer);
  }
}

/** Runs a call with its arguments in memory. */
export function calling<T>(m: Module, body: (args: Arguments) => T): T {
  const args = new Arguments(m);
  try {
    return body(args);
  } finally {
    args.end();
  }
}

/** The object that a call makes through its last argument. */
export function made(m: Module, call: (args: Arguments, out: Pointer) => number): Pointer {
  return calling(m, (args) => {
    const out = args.room(4);
    check(m, call(args, out));
    return m.HEAPU32[out >> 2]!;
  });
}

/** The content of a mimicry_bytes, copied; the object is destroyed. */
export function takeBytes(m: Module, bytes: Pointer): Uint8Array<ArrayBuffer> {
  const data = m._mimicry_bytes_data(bytes);
  const copy = m.HEAPU8.slice(data, data + m._mimicry_bytes_size(bytes));
  m._mimicry_bytes_destroy(bytes);
  return copy;
}

/** Something in the module's memory that is given back once. */
export abstract class Handle {
  constructor(protected readonly m: Module, private pointer: Pointer) {}

  /** @internal */
  get at(): Pointer {
    if (this.pointer === 0) throw new MimicryError('disposed', `a ${this.constructor.name} was used after dispose()`);
    return this.pointer;
  }

  /** Gives its memory back; a second time does nothing. Must not be used afterwards. */
  dispose(): void {
    if (this.pointer !== 0) this.destroy(this.pointer);
    this.pointer = 0;
  }

  protected abstract destroy(pointer: Pointer): void;
}
