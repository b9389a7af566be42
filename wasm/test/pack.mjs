// pack.mjs PACKAGE_FOLDER: `npm pack`, installed in an empty folder without network, runs the README's
// program and the tests of the facade.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const root = process.argv[2];
const work = mkdtempSync(join(tmpdir(), 'mimicry-pack-'));
const quiet = { cwd: work, stdio: ['ignore', 'pipe', 'pipe'], encoding: 'utf8' };
try {
  execFileSync('npm', ['pack', '--silent', '--pack-destination', work, root], quiet);
  const archive = readdirSync(work).find((name) => name.endsWith('.tgz'));
  writeFileSync(join(work, 'package.json'), '{"private": true, "type": "module"}');
  execFileSync('npm', ['install', '--offline', '--no-audit', '--no-fund', '--silent', `./${archive}`], quiet);
  const installed = readdirSync(join(work, 'node_modules', 'mimicry'));
  assert.deepEqual(installed.sort(), ['LICENSE', 'README.md', 'THIRD_PARTY.md', 'bake.js', 'compat.js', 'dist', 'package.json']);
  // What resolvers find that look at files alone.
  const [bake, compat] = await Promise.all(['bake.js', 'compat.js'].map((name) => import(join(work, 'node_modules', 'mimicry', name))));
  assert.ok(bake.bake === compat.bake && compat.Mimicry);

  const program = /```js\n([^]*?)```/.exec(readFileSync(join(root, 'README.md'), 'utf8'))[1];
  writeFileSync(join(work, 'readme.mjs'), program);
  assert.match(execFileSync('node', ['readme.mjs'], quiet), /^90 points, 0\.4\d\d long\n$/);

  const own = /```js\n((?:(?!```)[^])*registerTechnique[^]*?)```/.exec(readFileSync(join(root, 'README.md'), 'utf8'))[1];
  writeFileSync(join(work, 'own.mjs'), own);
  assert.match(execFileSync('node', ['own.mjs'], quiet), /^90 points, 0\.\d\d\d long\n$/);

  const tests = ['api.mjs', 'attributes.mjs', 'own_technique.mjs'];
  for (const name of tests) cpSync(join(root, 'test', name), join(work, name));
  process.stdout.write(execFileSync('node', ['--test', '--test-reporter=spec', ...tests], quiet));
} catch (error) {
  console.error(error.stdout ?? '', error.stderr ?? '', error);
  process.exitCode = 1;
} finally {
  rmSync(work, { recursive: true });
}
