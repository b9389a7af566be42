import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Plugin } from 'vite';

/** What is not kept before it is wanted, and what is no file of the page's own. */
const kLeftOut = /\.(mimicry|br|gz)$|^sw\.js$/;

/**
 * Writes dist/sw.js, the service worker with the list of the page's files and a hash of them all, and the same hash into the page.
 * A browser takes any change of sw.js for a new build.
 */
export function offline(): Plugin {
  let folder = '';
  return {
    name: 'mimicry-offline',
    apply: 'build',
    configResolved(config) {
      folder = join(config.root, config.build.outDir);
    },
    writeBundle: {
      order: 'pre',
      sequential: true,
      handler() {
        const files = (readdirSync(folder, { recursive: true }) as string[]).map((file) => file.replaceAll('\\', '/'))
          .filter((file) => !kLeftOut.test(file) && statSync(join(folder, file)).isFile()).sort();
        const worker = readFileSync(join('src', 'offline', 'service_worker.js'), 'utf8');
        const hash = createHash('sha256').update(worker);
        for (const file of files) hash.update(`${file}\0`).update(readFileSync(join(folder, file)));
        const build = hash.digest('hex').slice(0, 16);
        writeFileSync(join(folder, 'sw.js'), `const kBuild = ${JSON.stringify(build)}, kFiles = ${JSON.stringify(files)};\n${worker}`);
        const page = join(folder, 'index.html');
        writeFileSync(page, readFileSync(page, 'utf8').replace('<head>', `<head>\n    <meta name="build" content="${build}" />`));
      },
    },
  };
}
