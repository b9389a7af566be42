import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { expect, it } from 'vitest';

/** The folders of src, lowest first: a file imports from its own folder and from lower ones. Beside them stands main.ts, which is on top. */
const kOrder = ['base', 'math', 'engine', 'drawing', 'studio', 'tools', 'scene', 'input', 'ui', 'offline', 'app'];
/** Which folders may use three.js. */
const kPictures = ['scene', 'input'];

const files = readdirSync('src', { recursive: true, encoding: 'utf8' }).filter((name) => name.endsWith('.ts') && !name.endsWith('.d.ts'));

/** What a file imports, types and workers too, as files of src; packages as they are named. */
function imports(file: string): string[] {
  const text = readFileSync(join('src', file), 'utf8');
  const named = [...text.matchAll(/(?:\bfrom\s*|\bimport\s*\(?\s*|new URL\(\s*)'([^']+)'/g)].map((match) => match[1]!);
  return named.map((name) => (name.startsWith('.') ? normalize(join(dirname(file), name)).replace(/(\.ts)?$/, '.ts') : name));
}

const floor = (file: string): number => (file.includes('/') ? kOrder.indexOf(file.split('/')[0]!) : kOrder.length);

it('each folder imports only from lower ones', () => {
  expect(files.length).toBeGreaterThan(50);
  const upward: string[] = [];
  let count = 0;
  for (const file of files) {
    expect(floor(file), `${file}: its folder has no place in the order`).toBeGreaterThanOrEqual(0);
    for (const other of imports(file)) {
      if (!other.endsWith('.ts')) {
        if (/^three(\/|$)/.test(other) && !kPictures.includes(file.split('/')[0]!)) upward.push(`${file} uses three.js`);
        continue;
      }
      expect(files, `${file} imports ${other}`).toContain(other);
      count += 1;
      if (floor(other) > floor(file)) upward.push(`${file} imports ${other}`);
    }
  }
  expect(count).toBeGreaterThan(150);
  expect(upward).toEqual([]);
});

it('no file imports itself through others', () => {
  const known = new Map<string, 'open' | 'done'>();
  const circles: string[] = [];
  const visit = (file: string, path: readonly string[]): void => {
    if (known.get(file) === 'open') circles.push([...path.slice(path.indexOf(file)), file].join(' -> '));
    if (known.has(file)) return;
    known.set(file, 'open');
    for (const other of imports(file)) if (files.includes(other)) visit(other, [...path, file]);
    known.set(file, 'done');
  };
  for (const file of files) visit(file, []);
  expect(circles).toEqual([]);
});

it('docs/studio.md says so', () => {
  const table = readFileSync('../docs/studio.md', 'utf8').split('| folder of `web/src` | holds |')[1]!.split('\n\n')[0]!;
  expect([...table.matchAll(/^\| `(\w+)` \|/gm)].map((match) => match[1])).toEqual(kOrder);
});
