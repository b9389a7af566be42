// node bundle.mjs FOLDER: each script of src/ that is run as it is, in one file with all it needs.
import { join } from 'node:path';
import { build } from 'esbuild';

const folder = process.argv[2];
const common = {
  bundle: true, minify: true, legalComments: 'none', logLevel: 'warning', charset: 'ascii',
  banner: { js: '/* Contains Vega and Vega-Lite (BSD 3-clause, University of Washington Interactive Data Lab) and D3 (ISC, Mike Bostock). */' },
};

await build({
  ...common, entryPoints: ['src/page.ts'], outfile: join(folder, 'page.js'), format: 'iife', target: 'es2022',
  // It stands inside an element of the page.
  supported: { 'inline-script': false },
});
await build({
  ...common, entryPoints: ['src/files.ts'], outfile: join(folder, 'files.cjs'), format: 'cjs', platform: 'node',
  target: 'node18', loader: { '.wasm': 'binary' },
  // Layout must not depend on whether a native canvas happens to be installed.
  alias: { 'vega-canvas': './node_modules/vega-canvas/build/vega-canvas.browser.js' },
});
