// Pages without a bundler: scripts, workers of both kinds, and servers and policies that are in the way.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { checkPage, fresh, from, html, pageMain, pageResult, program, serving, workerMain } from './harness.mjs';

const kDist = '/node_modules/mimicry/dist';
const kMap = `<script type="importmap">{ "imports": { "mimicry": "${kDist}/index.js", "mimicry/bake": "${kDist}/bake.js" } }</script>`;
const plain = { 'draw.js': program, 'main.js': pageMain, 'index.html': html(`${kMap}<script type="module" src="main.js"></script>`) };
// Import maps do not reach workers.
const placed = program.replace("'mimicry/bake'", `'${kDist}/bake.js'`).replace("from 'mimicry'", `from '${kDist}/index.js'`);
const asked = (worker) => html(`<script>const worker = ${worker};\nworker.onmessage = ({ data }) => { globalThis.result = data; };\nworker.postMessage(0);</script>`);

test('a page with an import map', () => serving(fresh('plain', plain), checkPage));

test('a page whose server knows no type for .wasm', () =>
  serving(fresh('untyped', plain), checkPage, (path, usual) => (path.endsWith('.wasm') ? { 'content-type': 'text/plain' } : usual)));

test('a page with one module from elsewhere', () =>
  // Another origin: its worker could not be started from a file.
  serving(fresh('elsewhere', {}), (other) =>
    serving(fresh('compat', { ...plain, 'draw.js': from(`${other}node_modules/mimicry/dist/compat.js`) }), checkPage),
  (_, usual) => ({ ...usual, 'access-control-allow-origin': '*' })));

test('a page with a script', async () => {
  const draw = program.replace(/import (\{.*\}) from '.*';/g, 'const $1 = mimicry;').replace('const mimicry = await', 'const core = await')
    .replaceAll('mimicry.createTarget', 'core.createTarget').replace('mimicry.shape', 'core.shape').replace('export ', '');
  const tell = pageMain.replace(/import .*\n/, '');
  await serving(fresh('script', { 'index.html': html(`<script src="${kDist}/cjs/compat.js"></script><script>{${draw}${tell}}</script>`) }), checkPage);
});

test('a worker of modules, which bakes in another', () =>
  serving(fresh('module-worker', { 'draw.js': placed, 'worker.js': workerMain, 'index.html': asked("new Worker('worker.js', { type: 'module' })") }), checkPage));

test('a classic worker that imports when it is asked, and bakes in another', () =>
  serving(fresh('classic-import', {
    'draw.js': placed,
    'worker.js': workerMain.replace(/import .*\n/, '').replace('draw()', "import('/draw.js').then(({ draw }) => draw())"),
    'index.html': asked("new Worker('worker.js')"),
  }), checkPage));

test('a classic worker with a script, which bakes in another', () => {
  const draw = program.replace(/import (\{.*\}) from '.*';/g, 'var $1 = mimicry;').replace('const mimicry = await', 'const core = await')
    .replaceAll('mimicry.createTarget', 'core.createTarget').replace('mimicry.shape', 'core.shape').replace('export ', '');
  const worker = `importScripts('${kDist}/cjs/compat.js');\n${draw}${workerMain.replace(/import .*\n/, '')}`;
  return serving(fresh('classic-script', { 'worker.js': worker, 'index.html': asked("new Worker('worker.js')") }), checkPage);
});

test('a page that gives WebAssembly and a worker', () => {
  const options = `{ core: { wasm: '${kDist}/core.wasm' }, bake: { wasm: fetch('${kDist}/bake.wasm'), worker: new Worker('${kDist}/bake_worker.js') } }`;
  return serving(fresh('given', { ...plain, 'main.js': pageMain.replace('draw()', `draw(${options})`) }), checkPage);
});

const failing = async (name, headers, main = pageMain) => {
  const { error, drawn } = await serving(fresh(name, { ...plain, 'main.js': main }), pageResult, headers);
  assert.equal(drawn, undefined);
  return error;
};
const policy = (text) => (_, usual) => ({ ...usual, 'content-security-policy': text });

test('a file that is not served is named, with the remedies', async () => {
  assert.match(await failing('missing', (path, usual) => (path.endsWith('core.wasm') ? null : usual)),
    /dist\/core\.wasm: the server answers 404 Not Found; put core\.wasm of the package there, .*option wasm.*mimicry\/compat/);
});


test('a page in the place of a file is told', async () => {
  const main = pageMain.replace('draw()', "draw({ core: { wasm: 'index.html' } })");
  assert.match(await failing('stand-in', undefined, main), /index\.html is not WebAssembly: it begins with "<!doctype.*a page that a server sends for what it does not have; put core\.wasm/);
});

test('a server that cannot be reached is told', async () => {
  const main = pageMain.replace('draw()', "draw({ core: { wasm: 'http://127.0.0.1:9/core.wasm' } })");
  assert.match(await failing('unreachable', undefined, main), /127\.0\.0\.1:9\/core\.wasm cannot be loaded .*connect-src.*CORS/);
});

test('a policy that forbids WebAssembly is told', async () => {
  assert.match(await failing('no-wasm', policy("script-src 'self' 'unsafe-inline'")), /Content-Security-Policy forbids WebAssembly .*'wasm-unsafe-eval' to its script-src/);
});

test('a policy that forbids the worker is told', async () => {
  assert.match(await failing('no-worker', policy("script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'; worker-src 'none'")),
    /the bake's worker could not be started.*bake_worker\.js of the package must be served as .*worker-src.*option worker.*bakeHere/);
});

test('a worker that is not served is told', async () => {
  assert.match(await failing('missing-worker', (path, usual) => (path.endsWith('bake_worker.js') ? null : usual)), /could not be started.*bake_worker\.js/);
});

test('a policy that forbids workers from text is told', async () => {
  const folder = fresh('no-blob', { ...plain, 'draw.js': from(`${kDist}/compat.js`) });
  const { error } = await serving(folder, pageResult, policy("script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'; worker-src 'self'"));
  assert.match(error, /could not be started.*must allow blob:.*option worker/);
});
