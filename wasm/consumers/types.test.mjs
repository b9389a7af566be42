// The package's types in the versions of TypeScript from 5.0 on, in every way of finding modules, without the DOM's types and with
// them, with none of the checks left out.
import { join } from 'node:path';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fresh, here, run } from './harness.mjs';

const typed = readFileSync(join(here, 'programs/typed.ts'), 'utf8');
const page = readFileSync(join(here, 'programs/typed_page.ts'), 'utf8');
const kStrict = { strict: true, exactOptionalPropertyTypes: true, noUncheckedIndexedAccess: true, skipLibCheck: false, target: 'es2022', types: [], noEmit: true };
const kBare = { ...kStrict, lib: ['es2022'] };
const kPage = { ...kStrict, lib: ['es2022', 'dom'] };

for (const version of ['5.0', '5.6', 'newest'])
  test(`TypeScript ${version}`, () => {
    const compiles = (name, options, programs) => {
      const folder = fresh(`types-${version}-${name}`, { ...programs, 'tsconfig.json': JSON.stringify({ compilerOptions: options, files: Object.keys(programs) }) });
      run(folder, join(here, 'node_modules', `typescript-${version}`, 'bin', 'tsc'), '--project', '.');
    };
    compiles('bundler', { ...kBare, module: 'es2022', moduleResolution: 'bundler' }, { 'main.ts': typed });
    compiles('node', { ...kBare, module: 'node16', moduleResolution: 'node16' }, { 'main.mts': typed, 'main.cts': typed });
    // TypeScript 7 has no other ways.
    if (version !== 'newest') compiles('old', { ...kBare, module: 'commonjs', moduleResolution: 'node10' }, { 'main.ts': typed });
    compiles('page', { ...kPage, module: 'es2022', moduleResolution: 'bundler' }, { 'main.ts': page });
  });
