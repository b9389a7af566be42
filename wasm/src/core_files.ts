import type { WasmContent } from './types.js';

// Files beside the code. Bundlers look for exactly these words; the build with everything inside (package.mjs) has another
// module in this one's place.
export const coreWasm = async (): Promise<WasmContent> => new URL('./core.wasm', import.meta.url);
