// The program through every bundler with that bundler's own defaults, as a page and in workers.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { nodeResolve } from '@rollup/plugin-node-resolve';
import * as esbuild from 'esbuild';
import { rollup } from 'rollup';
import * as vite from 'vite';
import webpack from 'webpack';
import { checkDrawn, checkPage, fresh, from, html, pageMain, program, run, serving, workerMain } from './harness.mjs';

const kAsk = 'worker.onmessage = ({ data }) => { globalThis.result = data; };\nworker.postMessage(0);\n';
const printing = "import { draw } from './draw.js';\ndraw().then((drawn) => console.log(JSON.stringify(drawn)));\n";

function webpacked(context, options = {}) {
  return new Promise((resolve, reject) => {
    const compiler = webpack({ context, mode: 'production', output: { path: join(context, 'dist') }, ...options }); // its default folder is the process's
    compiler.run((error, stats) => compiler.close(() => {
      const complaints = error ? [error] : [...stats.compilation.errors, ...stats.compilation.warnings];
      const others = complaints.filter(({ message }) => !/size limit|performance recommendations/.test(message)); // of files above 244 KiB
      if (others.length > 0) reject(new Error(others.map(({ message }) => message).join('\n')));
      else resolve();
    }));
  });
}

test('webpack: a page', async () => {
  const folder = fresh('webpack', { 'src/draw.js': program, 'src/index.js': pageMain, 'dist/index.html': html('<script src="main.js"></script>') });
  await webpacked(folder);
  await serving(join(folder, 'dist'), checkPage);
});

test('webpack: a worker, which bakes in another', async () => {
  const main = `const worker = new Worker(new URL('./worker.js', import.meta.url));\n${kAsk}`;
  const folder = fresh('webpack-worker', { 'src/draw.js': program, 'src/worker.js': workerMain, 'src/index.js': main, 'dist/index.html': html('<script src="main.js"></script>') });
  await webpacked(folder);
  await serving(join(folder, 'dist'), checkPage);
});

test('webpack: a program for Node', async () => {
  const folder = fresh('webpack-node', { 'src/draw.js': program, 'src/index.js': printing }, {});
  await webpacked(folder, { target: 'node' });
  await checkDrawn(JSON.parse(run(folder, 'node', 'dist/main.js')));
});

test('webpack: everything inside', async () => {
  const folder = fresh('webpack-compat', { 'src/draw.js': from('mimicry/compat'), 'src/index.js': pageMain, 'dist/index.html': html('<script src="main.js"></script>') });
  await webpacked(folder);
  assert.deepEqual(readdirSync(join(folder, 'dist')).sort(), ['index.html', 'main.js']);
  await serving(join(folder, 'dist'), checkPage);
});

for (const [format, script] of [['iife', '<script src="main.js"></script>'], ['esm', '<script type="module" src="main.js"></script>']])
  test(`esbuild: a page (${format})`, async () => {
    const folder = fresh(`esbuild-${format}`, { 'draw.js': program, 'in.js': pageMain, 'out/index.html': html(script) });
    const { warnings } = await esbuild.build({ absWorkingDir: folder, entryPoints: ['in.js'], bundle: true, outfile: 'out/main.js', ...(format === 'esm' && { format }) });
    assert.deepEqual(warnings, []);
    await serving(join(folder, 'out'), checkPage);
  });

test('esbuild: a classic worker, which bakes in another', async () => {
  const folder = fresh('esbuild-worker', {
    'draw.js': program, 'worker.js': workerMain,
    'out/index.html': html(`<script>const worker = new Worker('worker.js');\n${kAsk}</script>`),
  });
  await esbuild.build({ absWorkingDir: folder, entryPoints: ['worker.js'], bundle: true, outdir: 'out' });
  await serving(join(folder, 'out'), checkPage);
});

for (const format of ['cjs', 'esm'])
  test(`esbuild: a program for Node (${format})`, async () => {
    const folder = fresh(`esbuild-node-${format}`, { 'draw.js': program, 'in.js': printing }, { type: format === 'esm' ? 'module' : 'commonjs' });
    await esbuild.build({ absWorkingDir: folder, entryPoints: ['in.js'], bundle: true, outfile: 'out/main.js', platform: 'node', format });
    await checkDrawn(JSON.parse(run(folder, 'node', 'out/main.js')));
  });

test('esbuild: who does not bake has no bake in the bundle', async () => {
  const folder = fresh('esbuild-small', { 'in.js': "import { Mimicry } from 'mimicry';\nnew Mimicry().ready.then((m) => console.log(m.shapes.length));\n" });
  const built = await esbuild.build({ absWorkingDir: folder, entryPoints: ['in.js'], bundle: true, write: false, platform: 'node', format: 'esm' });
  const whole = readFileSync(join(folder, 'node_modules/mimicry/dist/compat.js')).length;
  assert.ok(built.outputFiles[0].contents.length < 0.7 * whole, `${built.outputFiles[0].contents.length} of ${whole} bytes`);
});

for (const [format, script] of [['es', '<script type="module" src="main.js"></script>'], ['iife', '<script src="main.js"></script>']])
  test(`rollup: a page (${format})`, async () => {
    const folder = fresh(`rollup-${format}`, { 'draw.js': program, 'in.js': pageMain, 'out/index.html': html(script) });
    const warnings = [];
    const bundle = await rollup({ input: join(folder, 'in.js'), plugins: [nodeResolve()], onwarn: (warning) => warnings.push(warning.message) });
    await bundle.write({ file: join(folder, 'out/main.js'), format });
    await bundle.close();
    assert.deepEqual(warnings, []);
    await serving(join(folder, 'out'), checkPage);
  });

const viteWorker = `const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });\n${kAsk}`;
const viteMain = '<script type="module" src="/main.js"></script>';

for (const [name, main] of [['a page', pageMain], ['a worker, which bakes in another', viteWorker]])
  test(`Vite: ${name}, built`, async () => {
    const folder = fresh(`vite-${name.length}`, { 'draw.js': program, 'main.js': main, 'worker.js': workerMain, 'index.html': html(viteMain) });
    await vite.build({ root: folder, configFile: false, logLevel: 'error' });
    await serving(join(folder, 'dist'), checkPage);
  });

for (const [name, main] of [['a page', pageMain], ['a worker, which bakes in another', viteWorker]])
  test(`Vite: ${name}, while developing`, async () => {
    const folder = fresh(`vite-dev-${name.length}`, { 'draw.js': program, 'main.js': main, 'worker.js': workerMain, 'index.html': html(viteMain) });
    const server = await vite.createServer({ root: folder, configFile: false, logLevel: 'error', server: { port: 0, host: '127.0.0.1' } });
    try {
      await server.listen();
      await checkPage(server.resolvedUrls.local[0]);
    } finally {
      await server.close();
    }
  });

test('Vite: the WebAssembly in files of its own', async () => {
  const folder = fresh('vite-split', { 'draw.js': from('mimicry/split'), 'main.js': pageMain, 'index.html': html(viteMain) });
  await vite.build({ root: folder, configFile: false, logLevel: 'error' });
  const assets = readdirSync(join(folder, 'dist/assets'));
  for (const kind of [/^core-.*\.wasm$/, /^bake-.*\.wasm$/, /^bake_worker-.*\.js$/]) assert.ok(assets.some((name) => kind.test(name)), `${kind} among ${assets}`);
  await serving(join(folder, 'dist'), checkPage);
});
