// Node without a bundler: modules and CommonJS, bakes in threads, WebAssembly from wherever it is given.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { checkDrawn, fresh, from, program, run } from './harness.mjs';

const printing = "draw(options).then((drawn) => console.log(JSON.stringify(drawn)));\n";
const required = (text) => text.replace(/import (\{.*\}) from ('.*');/g, 'const $1 = require($2);').replace('export async', 'async');

for (const entry of [undefined, 'mimicry/compat', 'mimicry/split'])
  test(`a module from ${entry ?? 'mimicry'}`, async () => {
    const folder = fresh(`node-esm-${entry?.slice(8)}`, { 'main.js': `${entry ? from(entry) : program}\nconst options = {};\n${printing}` });
    await checkDrawn(JSON.parse(run(folder, 'node', 'main.js')));
  });

for (const entry of [undefined, 'mimicry/compat'])
  test(`CommonJS from ${entry ?? 'mimicry'}`, async () => {
    const folder = fresh(`node-cjs-${entry?.slice(8)}`, { 'main.js': `${required(entry ? from(entry) : program)}\nconst options = {};\n${printing}` }, {});
    await checkDrawn(JSON.parse(run(folder, 'node', 'main.js')));
  });

test('a worker thread, which bakes in another', async () => {
  const folder = fresh('node-worker', {
    'draw.js': program,
    'worker.js': "import { parentPort } from 'node:worker_threads';\nimport { draw } from './draw.js';\nparentPort.postMessage(await draw());\n",
    'main.js': "import { Worker } from 'node:worker_threads';\nnew Worker(new URL('./worker.js', import.meta.url)).on('message', (drawn) => console.log(JSON.stringify(drawn)));\n",
  });
  await checkDrawn(JSON.parse(run(folder, 'node', 'main.js')));
});

const kSources = `import { readFileSync } from 'node:fs';
import { Worker } from 'node:worker_threads';
const place = (name) => new URL('./node_modules/mimicry/dist/' + name, import.meta.url);
const bytes = (name) => readFileSync(place(name));
const server = (await import('node:http')).createServer((q, r) => r.writeHead(200, { 'content-type': 'application/wasm' }).end(bytes(q.url.slice(1))));
await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
const address = (name) => 'http://127.0.0.1:' + server.address().port + '/' + name;
`;
for (const [what, core, bake] of [
  ['a URL', "place('core.wasm')", "place('bake.wasm')"],
  ['a path', "'node_modules/mimicry/dist/core.wasm'", "'./node_modules/mimicry/dist/bake.wasm'"],
  ['bytes', "bytes('core.wasm')", "new Uint8Array(bytes('bake.wasm')).buffer"],
  ['a compiled module', "new WebAssembly.Module(bytes('core.wasm'))", "WebAssembly.compile(bytes('bake.wasm'))"],
  ['a server', "address('core.wasm')", "fetch(address('bake.wasm'))"],
])
  test(`WebAssembly from ${what}, and a bake in a given worker`, async () => {
    const options = `const options = { core: { wasm: ${core} }, bake: { wasm: ${bake}, worker: new Worker(new URL(import.meta.resolve('mimicry/bake_worker'))) } };\n`;
    const folder = fresh(`node-wasm-${what.slice(-5)}`, { 'main.js': `${program}${kSources}${options}await ${printing}server.close();\n` });
    await checkDrawn(JSON.parse(run(folder, 'node', 'main.js')));
  });

test('what cannot be loaded is told with the remedy', () => {
  const folder = fresh('node-errors', { 'main.js': `import { Mimicry } from 'mimicry';
import { bake, bakeHere } from 'mimicry/bake';
import { readFileSync } from 'node:fs';
import { Worker } from 'node:worker_threads';
const dist = './node_modules/mimicry/dist/';
const mesh = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], faces: [0, 1, 2] };
const said = [];
const tell = (promise) => promise.then(() => said.push('no error'), (error) => said.push(error.name + ' ' + error.status + ' ' + error.message));
await tell(new Mimicry({ wasm: 'nowhere/core.wasm' }).ready);
await tell(new Mimicry({ wasm: dist + 'bake.wasm' }).ready);
await tell(new Mimicry({ wasm: readFileSync(dist + 'core.wasm').subarray(0, 5000) }).ready);
await tell(new Mimicry({ wasm: readFileSync(dist + 'index.js') }).ready);
await tell(new Mimicry({ wasm: 7 }).ready);
await tell(new Mimicry({ wasm: 'http://127.0.0.1:9/core.wasm' }).ready);
await tell(new Mimicry({ wasm: new WebAssembly.Module(Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0)) }).ready);
await tell(bake({ positions: [0, 0], faces: [] }));
await tell(bake(mesh, { worker: new Worker('process.exit(3)', { eval: true }) }));
await tell(bake(mesh, { worker: new Worker('throw new Error("broken")', { eval: true }) }));
const slow = () => new Promise((served) => setTimeout(() => served(readFileSync(dist + 'bake.wasm')), 2000)); // the worker ends before
await tell(bake(mesh, { wasm: slow(), worker: new Worker('process.exit(3)', { eval: true }) }));
await tell(bake(mesh, { wasm: slow(), worker: new Worker('throw new Error("broken")', { eval: true }) }));
await tell(bake(mesh, { signal: AbortSignal.abort() }));
const stop = new AbortController();
await tell(bake(mesh, { signal: stop.signal, onProgress: () => stop.abort() }));
await tell(bakeHere(mesh, { dimension: 99 }));
console.log(JSON.stringify(said));
` });
  const said = JSON.parse(run(folder, 'node', 'main.js'));
  const words = [
    /^MimicryError io nowhere\/core\.wasm cannot be read \(ENOENT.*option wasm.*mimicry\/compat/,
    /invalid_input what was given as core\.wasm is bake 0\.1\.0 \(\w+\), the code belongs to core 0\.1\.0 \(\w+\)/,
    /invalid_input the bytes that were given is damaged or not WebAssembly/,
    /invalid_input the bytes that were given is not WebAssembly: it begins with "import/,
    /invalid_input option wasm: 7 is no WebAssembly; give/,
    /io http:\/\/127\.0\.0\.1:9\/core\.wasm cannot be loaded/,
    /is no build of mimicry/,
    /invalid_input the positions .*3 numbers each, not 2 of them/,
    /failed the bake's worker failed \(it ended with code 3\)/,
    /failed the bake's worker failed \(broken\)/,
    /failed the bake's worker failed \(it ended with code 3\)/,
    /failed the bake's worker failed \(broken\)/,
    /cancelled/,
    /cancelled/,
    /dimension/,
  ];
  words.forEach((word, i) => assert.match(said[i], word));
  assert.equal(said.length, words.length);
});
