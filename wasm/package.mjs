// package.mjs BUILT: puts wasm/dist together from emscripten's output in the folder BUILT and the facade, and the licences
// beside it.
//
//   index.js, bake.js, split.js   modules, the WebAssembly in files beside them
//   compat.js                     all of it in one module, the WebAssembly inside
//   cjs/compat.js                 the same as a script: for require, <script> and importScripts
//   bake_worker.js                the bake's worker, a script
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';

const here = import.meta.dirname ?? new URL('.', import.meta.url).pathname;
const built = process.argv[2];
const out = join(here, 'dist.new');
const tool = (name) => join(here, 'node_modules', '.bin', name);
if (!existsSync(tool('tsc')) || !existsSync(tool('esbuild'))) {
  console.error('wasm/package.mjs: the TypeScript compiler or esbuild is missing; run scripts/setup');
  process.exit(1);
}
const { build } = await import('esbuild');

// A section of its own tells which code a WebAssembly file belongs to: emscripten's code calls it by names of one letter, so that
// the code of another build would call the wrong functions.
function marked(name, version) {
  const wasm = readFileSync(join(built, `${name}.wasm`));
  const hash = createHash('sha256').update(wasm).update(readFileSync(join(built, `${name}.js`))).digest('hex').slice(0, 12);
  const text = `${name.replace('_module', '')} ${version} (${hash})`;
  const content = Buffer.concat([Buffer.from([7]), Buffer.from('mimicry'), Buffer.from(text)]);
  return { text, wasm: Buffer.concat([wasm, Buffer.from([0, content.length]), content]) }; // below 128: lengths of one byte
}
const { version } = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));
const core = marked('core', version);
const bake = marked('bake_module', version);

execFileSync('python3', [join(here, 'exports.py'), 'types', join(here, '../include/mimicry/mimicry.h'), join(here, 'src/exports.ts')]);
writeFileSync(join(here, 'src/builds.ts'),
  `// Made by package.mjs.\nexport const kCoreBuild = '${core.text}';\nexport const kBakeBuild = '${bake.text}';\n`);

rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, 'cjs'), { recursive: true });
execFileSync(tool('tsc'), ['--outDir', out], { cwd: here, stdio: ['ignore', 'inherit', 'inherit'] });
for (const name of ['core.js', 'bake_module.js']) cpSync(join(built, name), join(out, name));
for (const name of ['core.d.ts', 'bake_module.d.ts']) cpSync(join(here, 'src', name), join(out, name));
writeFileSync(join(out, 'core.wasm'), core.wasm);
writeFileSync(join(out, 'bake.wasm'), bake.wasm);

// With its white space: comments for bundlers stand in it.
const packed = (options) => build({ bundle: true, minifySyntax: true, minifyIdentifiers: true, target: 'es2022', legalComments: 'none', logLevel: 'warning', ...options });
const script = join(out, 'bake_worker.js');
await packed({ entryPoints: [script], outfile: script, allowOverwrite: true, format: 'iife' });

// The two modules that tell where files are have others in their place.
const inside = {
  core_files: `export const coreWasm = () => unpacked('${gzipSync(core.wasm, { level: 9 }).toString('base64')}');`,
  bake_files: `export const bakeWasm = () => unpacked('${gzipSync(bake.wasm, { level: 9 }).toString('base64')}');
export const workerScript = () => ${JSON.stringify(readFileSync(script, 'utf8'))};`,
};
const unpacking = `function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}`;
const plugins = [{
  name: 'inside',
  setup({ onLoad }) {
    onLoad({ filter: /\/(core|bake)_files\.js$/ }, ({ path }) => ({ contents: `${inside[/(\w+)\.js$/.exec(path)[1]]}\n${unpacking}`, loader: 'js' }));
  },
}];
const whole = { entryPoints: [join(out, 'split.js')], plugins };
await packed({ ...whole, outfile: join(out, 'compat.js'), format: 'esm' });
await packed({
  ...whole, outfile: join(out, 'cjs/compat.js'), format: 'iife', globalName: 'mimicry',
  footer: { js: "if (typeof module === 'object' && module.exports) module.exports = mimicry;" },
});
writeFileSync(join(out, 'cjs/package.json'), '{ "type": "commonjs" }\n');
for (const name of readdirSync(out)) if (name.endsWith('.d.ts')) cpSync(join(out, name), join(out, 'cjs', name));

rmSync(join(here, 'dist'), { recursive: true, force: true });
renameSync(out, join(here, 'dist'));
for (const name of ['LICENSE', 'THIRD_PARTY.md']) cpSync(join(here, '..', name), join(here, name));
