import type { UrlLike, WasmContent } from './types.js';

// As core_files.ts.
export const bakeWasm = async (): Promise<WasmContent> => new URL('./bake.wasm', import.meta.url);

/** The worker's script: its place, or its text. */
export const workerScript = (): UrlLike | string => new URL('./bake_worker.js', import.meta.url);
