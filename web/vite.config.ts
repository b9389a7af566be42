import { existsSync, readdirSync } from 'node:fs';
import { defineConfig } from 'vite';

const embeddings = new URL('./public/embeddings', import.meta.url);

export default defineConfig({
  base: './',
  // Its WebAssembly file lies beside its code.
  optimizeDeps: { exclude: ['mimicry'] },
  worker: { format: 'es' },
  build: { target: 'es2022', chunkSizeWarningLimit: 900 },
  define: {
    // The built-in models that were baked before the page was built (scripts/embeddings.mjs).
    __EMBEDDINGS__: JSON.stringify(existsSync(embeddings) ? readdirSync(embeddings).map((name) => name.replace(/\.mimicry$/, '')) : []),
  },
});
