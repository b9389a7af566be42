// Bakes built-in models into embeddings, with the shapes that the page itself makes: an
// embedding belongs to its mesh to the last bit.
// usage: node scripts/embeddings.mjs SHAPE...
import { mkdirSync, writeFileSync } from 'node:fs';
import { Mimicry } from 'mimicry';
import { bakeHere } from 'mimicry/bake';

const folder = new URL('../embeddings/', import.meta.url);

mkdirSync(folder, { recursive: true });
const core = await new Mimicry().ready;
for (const shape of process.argv.slice(2)) {
  const file = new URL(`${shape}.mimicry`, folder);
  const start = performance.now();
  const bytes = await bakeHere(core.shape(shape));
  writeFileSync(file, bytes);
  console.log(`${shape}: ${(bytes.length / 1e6).toFixed(1)} MB in ${((performance.now() - start) / 1000).toFixed(1)} s`);
}
