import { existsSync } from 'node:fs';
import { defineConfig, type Plugin } from 'vite';
import { offline } from './scripts/offline';

if (!existsSync(new URL('../wasm/dist/split.js', import.meta.url)))
  throw new Error('wasm/dist is missing or of an earlier version; in the repository\'s root: scripts/setup; cmake --preset wasm; cmake --build --preset wasm --target wasm_package');

/** The core is fetched while the page's script is. */
const early: Plugin = {
  name: 'early-core',
  transformIndexHtml: {
    order: 'post',
    handler: (_html, { bundle }) => Object.keys(bundle ?? {}).filter((name) => /core-[^/]*\.wasm$/.test(name))
      .map((name) => ({ tag: 'link', attrs: { rel: 'preload', as: 'fetch', type: 'application/wasm', href: `./${name}`, crossorigin: true }, injectTo: 'head' as const })),
  },
};

export default defineConfig({
  base: './',
  plugins: [early, offline()],
  // The WebAssembly in files of its own, which are compiled while they arrive and pass the server's policy (no workers from text).
  resolve: { alias: [{ find: /^mimicry(\/bake)?$/, replacement: 'mimicry/split' }] },
  optimizeDeps: { exclude: ['mimicry'] },
  worker: { format: 'es' },
  build: { target: 'es2022', chunkSizeWarningLimit: 900 },
});
