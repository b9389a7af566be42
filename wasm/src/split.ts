// All of the package, with the WebAssembly in files of their own. `mimicry/compat` is this, packed with everything inside.
export * from './bake.js';
export * from './index.js';
