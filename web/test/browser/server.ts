import { createReadStream, existsSync, readFileSync, statSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import { extname, join, normalize, resolve } from 'node:path';
import { createGzip } from 'node:zlib';

const kTypes: Record<string, string> = {
  '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml',
  '.mimicry': 'application/octet-stream', '.webmanifest': 'application/manifest+json', '.png': 'image/png',
};

export interface Served {
  url: string;
  /** Bytes that went over the wire, compressed. */
  sent(): number;
  /** Another folder from now on. */
  move(folder: string): void;
  close(): void;
}

/** The built page, as a web server would send it. */
export async function serve(folder = resolve('dist')): Promise<Served> {
  let sent = 0;
  const server: Server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url!, 'http://x').pathname));
    const file = join(folder, path === '/' ? 'index.html' : path);
    if (!file.startsWith(folder) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end();
      return;
    }
    const head = { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream', 'cache-control': path.startsWith('/assets/') ? 'public, max-age=31536000, immutable' : 'no-cache' };
    // As `mimicry serve` does; a page that was just built may not be packed.
    if (existsSync(`${file}.br`) && /\bbr\b/.test(String(request.headers['accept-encoding']))) {
      const bytes = readFileSync(`${file}.br`);
      sent += bytes.length;
      response.writeHead(200, { ...head, 'content-encoding': 'br' }).end(bytes);
      return;
    }
    response.writeHead(200, { ...head, 'content-encoding': 'gzip' });
    const zip = createGzip();
    zip.on('data', (part: Buffer) => (sent += part.length));
    createReadStream(file).pipe(zip).pipe(response);
  });
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  const address = server.address();
  if (address === null || typeof address === 'string') throw new Error('no port');
  return {
    url: `http://127.0.0.1:${address.port}/`,
    sent: () => sent,
    move: (to) => (folder = to),
    close() {
      server.close();
      server.closeAllConnections();
    },
  };
}
