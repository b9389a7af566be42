// run.mjs [--chromium]: builds its inputs with the command line, measures, prints Markdown tables.
// The bunny is the study's (MIMICRY_STUDY_DATA); without it the double torus stands in.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const root = resolve(here, '../..');
const program = join(root, 'build/release/bin/mimicry');
const work = join(root, 'build/wasm-bench');
mkdirSync(work, { recursive: true });
const study = process.env.MIMICRY_STUDY_DATA ?? join(root, '../shared/data/study');

const native = (...args) => execFileSync(program, args, { stdio: ['ignore', 'ignore', 'inherit'] });
const once = (file, make) => {
  if (!existsSync(join(work, file))) make(join(work, file));
};
const bunny = existsSync(join(study, 'bunny.obj'));
once('first.obj', (out) => {
  if (bunny) native('simulate', join(study, 'bunny.obj'), '--targets', join(study, 'targets.json'), '--shape', 'bunny', '--out', join(work, 'first.json'));
  else native('simulate', 'shape:double-torus', '--out', join(work, 'first.json'));
  if (bunny) execFileSync('cp', [join(study, 'bunny.obj'), out]);
  else native('shapes', 'double-torus', '--out', out);
});
once('86k.obj', (out) => {
  native('simulate', 'shape:torus:120', '--out', join(work, '86k.json'));
  native('shapes', 'torus', '--resolution', '120', '--out', out);
});
for (const name of ['first', '86k']) once(`${name}.mimicry`, (out) => native('bake', join(work, `${name}.obj`), '--out', out));
const names = { first: bunny ? 'bunny' : 'double torus', '86k': '86K' };

async function inNode() {
  const { bench } = await import('./bench.js');
  return bench(Object.keys(names).map((key) => ({
    name: names[key], file: `${key}.obj`, mesh: readFileSync(join(work, `${key}.obj`)),
    strokes: readFileSync(join(work, `${key}.json`)), embedding: readFileSync(join(work, `${key}.mimicry`)),
  })));
}

const page = `<!doctype html><script type="importmap">{"imports": {
  "mimicry": "/node_modules/mimicry/dist/index.js",
  "three": "/node_modules/three/build/three.module.js",
  "three-mesh-bvh": "/node_modules/three-mesh-bvh/src/index.js"}}</script>
<script type="module">
  import { bench } from '/bench.js';
  const bytes = async (file) => new Uint8Array(await (await fetch('/work/' + file)).arrayBuffer());
  const names = ${JSON.stringify(names)};
  const cases = [];
  for (const key in names) cases.push({ name: names[key], file: key + '.obj', mesh: await bytes(key + '.obj'), strokes: await bytes(key + '.json'), embedding: await bytes(key + '.mimicry') });
  const body = await bench(cases).then(JSON.stringify, (e) => JSON.stringify({ error: String(e.stack) }));
  await fetch('/done', { method: 'POST', body });
</script>`;

function inChromium() {
  const types = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.json': 'application/json' };
  return new Promise((done, fail) => {
    let browser;
    const server = createServer((request, response) => {
      // An isolated page has a clock with steps of 5 us, any other of 100.
      response.setHeader('cross-origin-opener-policy', 'same-origin');
      response.setHeader('cross-origin-embedder-policy', 'require-corp');
      if (request.url === '/done') {
        let body = '';
        request.on('data', (part) => (body += part));
        request.on('end', () => {
          response.end();
          browser.kill();
          server.close();
          server.closeAllConnections();
          const result = JSON.parse(body);
          if (result.error) fail(new Error(result.error));
          else done(result);
        });
        return;
      }
      if (request.url === '/') return response.setHeader('content-type', 'text/html').end(page);
      const file = request.url.startsWith('/work/') ? join(work, request.url.slice(6)) : join(here, request.url);
      if (!existsSync(file)) return response.writeHead(404).end();
      response.setHeader('content-type', types[extname(file)] ?? 'application/octet-stream').end(readFileSync(file));
    });
    server.listen(0, '127.0.0.1', async () => {
      const { spawn } = await import('node:child_process');
      browser = spawn('chromium', ['--headless=new', '--no-sandbox', '--disable-gpu', `--user-data-dir=${join(work, 'profile')}`, `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore' });
    });
  });
}

const result = process.argv.includes('--chromium') ? await inChromium() : await inNode();
const us = (x) => (x < 0.95 ? x.toFixed(2) : x.toFixed(1));
const targets = Object.keys(result.frames);
console.log(`| add frame, us | ${targets.map((t) => `${t}: median | p99 | largest`).join(' | ')} |`);
console.log(`| --- |${' --- | --- | --- |'.repeat(targets.length)}`);
for (const name of Object.keys(result.frames[targets[0]]))
  console.log(`| ${name} | ${targets.map((t) => ['median', 'p99', 'largest'].map((k) => us(result.frames[t][name][k])).join(' | ')).join(' | ')} |`);
console.log('\n| us | ours: median | p99 | three-mesh-bvh: median | p99 | ratio of medians |\n| --- | --- | --- | --- | --- | --- |');
for (const [name, rows] of Object.entries(result.queries))
  for (const [query, { ours, peer }] of Object.entries(rows))
    console.log(`| ${query}, ${name} | ${us(ours.median)} | ${us(ours.p99)} | ${us(peer.median)} | ${us(peer.p99)} | ${(ours.median / peer.median).toFixed(2)} |`);
