import type { Factory } from './module.js';

/** Emscripten's glue of the core; made by `wasm/build`. */
declare const factory: Factory;
export default factory;
