import factory from './bake_module.js';
import { withMesh, type MeshArrays } from './mesh.js';
import { calling, instantiate, made, MimicryError, takeBytes, type WasmSource } from './module.js';

export { MimicryError } from './module.js';

export interface BakeOptions {
  /** Of the embedding, 3 to 8. */
  dimension?: number;
  /** At most. */
  samples?: number;
  /** Half the shell's thickness, part of the diagonal. */
  offset?: number;
  /** The bake's WebAssembly file; the package's own where nothing is given. */
  wasm?: WasmSource;
  /** How far a stage is, 0 to 1. */
  onProgress?: (stage: string, fraction: number) => void;
}

export type BakeMesh = Pick<MeshArrays, 'positions' | 'faces'>;

/** Bakes in the calling thread, which it blocks: for workers and Node. The content of a `.mimicry` file. */
export async function bakeHere(mesh: BakeMesh, options: BakeOptions = {}): Promise<Uint8Array<ArrayBuffer>> {
  const m = await instantiate(factory, options.wasm ?? new URL('./bake.wasm', import.meta.url), (stage, fraction) => {
    options.onProgress?.(stage, fraction);
    return 1;
  });
  return withMesh(m, mesh, '', (pointer) =>
    calling(m, (args) => {
      const chosen = args.room(32);
      m._mimicry_wasm_default_bake_options(chosen);
      if (options.dimension !== undefined) m.HEAP32[chosen >> 2] = options.dimension;
      if (options.samples !== undefined) m.HEAP32[(chosen >> 2) + 1] = options.samples;
      if (options.offset !== undefined) m.HEAPF64[(chosen >> 3) + 1] = options.offset;
      return takeBytes(m, made(m, (_, out) => m._mimicry_wasm_bake(pointer, chosen, out)));
    }));
}

export interface BakeJobOptions extends Omit<BakeOptions, 'wasm'> {
  /** Aborting stops the bake at once. */
  signal?: AbortSignal;
}

/** @internal What goes to the worker and what comes back. */
export interface BakeOrder { mesh: BakeMesh; dimension?: number; samples?: number; offset?: number }
/** @internal */
export type BakeNews = { stage: string; fraction: number } | { bytes: Uint8Array<ArrayBuffer> } | { status: string; message: string };

/** Bakes in a worker of its own, for pages. The mesh's arrays are copied. */
export function bake(mesh: BakeMesh, options: BakeJobOptions = {}): Promise<Uint8Array<ArrayBuffer>> {
  const { signal, onProgress, ...order } = options;
  return new Promise((resolve, reject) => {
    const cancelled = () => new MimicryError('cancelled', 'the bake was cancelled');
    if (signal?.aborted) return reject(cancelled());
    const worker = new Worker(new URL('./bake_worker.js', import.meta.url), { type: 'module' });
    const finish = () => {
      worker.terminate();
      signal?.removeEventListener('abort', abort);
    };
    const abort = () => {
      finish();
      reject(cancelled());
    };
    signal?.addEventListener('abort', abort);
    worker.onmessage = ({ data }: MessageEvent<BakeNews>) => {
      if ('stage' in data) return onProgress?.(data.stage, data.fraction);
      finish();
      if ('bytes' in data) return resolve(data.bytes);
      reject(new MimicryError(data.status as MimicryError['status'], data.message));
    };
    worker.onerror = (event) => {
      finish();
      reject(new MimicryError('failed', `the bake's worker failed: ${event.message || 'it could not be loaded'}; reload the page`));
    };
    worker.postMessage({ mesh: { positions: mesh.positions, faces: mesh.faces }, ...order } satisfies BakeOrder);
  });
}
