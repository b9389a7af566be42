// Fresh folders with the packed package in them, pages in Chromium, and what every program must have drawn.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { dirname, extname, join } from 'node:path';
import { after } from 'node:test';
import { chromium } from 'playwright-core';

export const here = import.meta.dirname ?? dirname(new URL(import.meta.url).pathname);
const root = mkdtempSync(join(tmpdir(), 'mimicry-consumers-'));
after(() => rmSync(root, { recursive: true }));

const quiet = { stdio: ['ignore', 'pipe', 'pipe'], encoding: 'utf8' };
/** What a program prints; what it complains of too where it fails. */
export function run(cwd, program, ...args) {
  try {
    return execFileSync(program, args, { ...quiet, cwd });
  } catch (error) {
    throw new Error(`${[program, ...args].join(' ')}: ${error.stdout}${error.stderr}`);
  }
}
export const tool = (name) => join(here, 'node_modules', '.bin', name);

run(root, 'npm', 'pack', '--silent', '--pack-destination', root, join(here, '..'));
const archive = join(root, readdirSync(root).find((name) => name.endsWith('.tgz')));

/** A folder of its own, with files by name, and the package as npm installs it. */
export function fresh(name, files, manifest = { type: 'module' }) {
  const folder = join(root, name);
  const installed = join(folder, 'node_modules', 'mimicry');
  mkdirSync(installed, { recursive: true });
  run(folder, 'tar', 'xzf', archive, '-C', installed, '--strip-components=1'); // it has no dependencies
  write(folder, { 'package.json': JSON.stringify({ private: true, ...manifest }), ...files });
  return folder;
}

export function write(folder, files) {
  for (const [name, content] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), content);
  }
}

export const program = readFileSync(join(here, 'programs/draw.js'), 'utf8');
/** The same from another entry of the package. */
export const from = (entry) => program.replace(/from 'mimicry(\/bake)?'/g, `from '${entry}'`);
/** Tells the page what became of the program. */
export const pageMain = `import { draw } from './draw.js';
draw().then((drawn) => ({ drawn }), (error) => ({ error: error.message })).then((result) => { globalThis.result = result; });\n`;
/** A worker that draws when it hears, and a page that asks it. */
export const workerMain = `import { draw } from './draw.js';
onmessage = () => draw().then((drawn) => ({ drawn }), (error) => ({ error: error.message })).then((result) => postMessage(result));\n`;

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.json': 'application/json' };

/** Serves a folder while a body runs. headers(path, usual): what is sent with a file; null refuses it. */
export async function serving(folder, body, headers = (_path, usual) => usual) {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://here').pathname);
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    const sent = existsSync(file) ? headers(path, { 'content-type': types[extname(file)] ?? 'application/octet-stream' }) : null;
    if (!sent) return response.writeHead(404).end();
    response.writeHead(200, sent).end(readFileSync(file));
  });
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  try {
    return await body(`http://127.0.0.1:${server.address().port}/`);
  } finally {
    server.closeAllConnections?.();
    await new Promise((closed) => server.close(closed));
  }
}

let browser;
after(() => browser?.close());

/** `result` of a page, when it is there; what the page said to the console comes with a failure. */
export async function pageResult(address) {
  browser ??= await chromium.launch({ executablePath: process.env.MIMICRY_CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
  const page = await browser.newPage();
  const said = [];
  page.on('console', (message) => said.push(message.text()));
  page.on('pageerror', (error) => said.push(String(error)));
  try {
    await page.goto(address);
    await page.waitForFunction(() => globalThis.result !== undefined, undefined, { timeout: 300_000 });
    return await page.evaluate(() => globalThis.result);
  } catch (error) {
    throw new Error(`${error.message}\n${said.join('\n')}`);
  } finally {
    await page.close();
  }
}

export const html = (script) => `<!doctype html><title>page</title><body>${script}`;

let expected;
/** The points are the known ones on the square, and those of Node's on the sphere, bit by bit. */
export async function checkDrawn(drawn) {
  assert.equal(drawn.flat.length, 40);
  drawn.flat.forEach(([x, y, z], i) => {
    assert.ok(Math.abs(x - (0.02 * i - 0.4)) < 1e-14 && Math.abs(y - 0.001 * (i - 20) * (i - 20)) < 1e-14 && Math.abs(z) < 1e-14, `point ${i}: ${[x, y, z]}`);
  });
  assert.ok(drawn.stages > 0, 'progress is told');
  expected ??= JSON.parse(run(fresh('expected', { 'draw.js': program, 'main.js': "import { draw } from './draw.js';\nconsole.log(JSON.stringify(await draw()));\n" }), 'node', 'main.js'));
  assert.equal(expected.round.length, 40);
  for (const [, , z] of expected.round) assert.ok(z > 0.5 && z <= 1 + 1e-6, 'on the side of the sphere that the pen is on');
  assert.equal(drawn.bytes, expected.bytes);
  assert.deepEqual(drawn.round, expected.round);
}

export const checkPage = async (address) => {
  const { drawn, error } = await pageResult(address);
  assert.equal(error, undefined);
  await checkDrawn(drawn);
};
