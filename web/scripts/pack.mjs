// Packs the built page: beside each file that gets smaller its forms in brotli (.br) and gzip (.gz), for servers to send as they are.
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { promisify } from 'node:util';
import { brotliCompress, constants, gzip } from 'node:zlib';

const folder = new URL('../dist/', import.meta.url);
/** Beyond it the last percent costs half a minute. */
const kLarge = 2e6;

const forms = {
  '.br': (bytes) => promisify(brotliCompress)(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: bytes.length > kLarge ? 5 : 11, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }),
  '.gz': (bytes) => promisify(gzip)(bytes, { level: bytes.length > kLarge ? 6 : 9 }),
};

const names = readdirSync(folder, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile() && !/\.(br|gz|png|woff2)$/.test(entry.name))
  .map((entry) => `${entry.parentPath}/${entry.name}`);
await Promise.all(names.flatMap((name) => {
  const bytes = readFileSync(name);
  return Object.entries(forms).map(async ([ending, form]) => {
    const packed = await form(bytes);
    if (packed.length < 0.9 * bytes.length) writeFileSync(name + ending, packed);
  });
}));
