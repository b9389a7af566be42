import { bakeWasm } from './bake_files.js';
import { kBakeFile, runBake, type BakeOrder, type BakeSettings } from './bake_run.js';
import { MimicryError } from './error.js';
import { compiled } from './load.js';
import { meshInput, type MeshInput } from './mesh.js';
import type { AbortSignalLike, Bytes, WasmSource, WorkerLike } from './types.js';
import { follow, requireWorker, startWorker } from './worker.js';

export { MimicryError } from './error.js';
export type { BakeSettings } from './bake_run.js';
export type { MeshInput } from './mesh.js';
export type { Bytes, WasmSource, WorkerLike } from './types.js';

export interface BakeOptions extends BakeSettings {
  /** The bake's WebAssembly file; the package's own where nothing is given. */
  wasm?: WasmSource;
  /** How far a stage is, 0 to 1. */
  onProgress?: (stage: string, fraction: number) => void;
}

export interface BakeJobOptions extends BakeOptions {
  /** Aborting stops the bake at once. */
  signal?: AbortSignalLike;
  /** One that runs `mimicry/bake_worker`, where the package's own cannot be started. It ends with the bake. */
  worker?: WorkerLike;
}

/** Bakes in the calling thread, which it blocks: for workers and programs. The content of a `.mimicry` file. */
export async function bakeHere(mesh: MeshInput, options: BakeOptions = {}): Promise<Bytes> {
  return runBake(await compiled(options.wasm ?? bakeWasm(), kBakeFile), mesh, options, options.onProgress);
}

/** Bakes in a worker of its own, in pages, workers and Node. The mesh's arrays are copied. The content of a `.mimicry` file. */
export async function bake(mesh: MeshInput, options: BakeJobOptions = {}): Promise<Bytes> {
  const { signal, worker: given, onProgress } = options;
  if (given) requireWorker(given);
  const cancelled = () => new MimicryError('cancelled', 'the bake was cancelled');
  let abort = () => {};
  const aborted = new Promise<never>((_, reject) => { abort = () => reject(cancelled()); });
  let worker = given;
  let done = worker && follow(worker, onProgress);
  try {
    if (signal?.aborted) throw cancelled();
    signal?.addEventListener('abort', abort);
    const code = await Promise.race([compiled(options.wasm ?? bakeWasm(), kBakeFile), aborted]);
    worker ??= await startWorker();
    done ??= follow(worker, onProgress);
    const order: BakeOrder = { code, mesh: meshInput(mesh), settings: settingsOf(options) };
    worker.postMessage(order);
    return await Promise.race([done, aborted]);
  } finally {
    worker?.terminate();
    signal?.removeEventListener('abort', abort);
  }
}

/** What can be sent. */
const settingsOf = ({ dimension, samples, offset }: BakeOptions): BakeSettings => ({ dimension, samples, offset }) as BakeSettings;
