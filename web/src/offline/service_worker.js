/*
 * The page without a network. `kBuild` and `kFiles` are written in front of this by the build (scripts/offline.ts).
 * The page itself always comes from the network where there is one, so that nobody is left with an old one; its files, whose
 * names change with their content, come from what was kept with it.
 */
/* global kBuild, kFiles */
const kPrefix = 'mimicry-studio-';
const kCache = kPrefix + kBuild;
/** A network that does not answer within this time counts as none. */
const kPatience_ms = 3000;

self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(kCache).then((cache) =>
    cache.addAll(kFiles.map((file) => new Request(file, { cache: file.startsWith('assets/') ? 'default' : 'no-cache' })))));
});

self.addEventListener('activate', (event) => {
  event.waitUntil((async () => {
    for (const name of await caches.keys()) if (name.startsWith(kPrefix) && name !== kCache) await caches.delete(name);
    await self.clients.claim();
  })());
});

self.addEventListener('message', (event) => {
  if (event.data === 'build') event.ports[0].postMessage(kBuild);
  // Other tabs may still need the files of the build before.
  if (event.data === 'take over if alone') {
    event.waitUntil(self.clients.matchAll({ type: 'window', includeUncontrolled: true }).then((pages) => pages.length <= 1 && self.skipWaiting()));
  }
});

self.addEventListener('fetch', (event) => {
  const { request } = event;
  const url = new URL(request.url), scope = new URL(self.registration.scope);
  if (request.method !== 'GET' || url.origin !== scope.origin || !url.pathname.startsWith(scope.pathname)) return;
  const path = url.pathname.slice(scope.pathname.length);
  if (request.mode === 'navigate') {
    if (path === '' || path === 'index.html') event.respondWith(page(request));
  } else if (kFiles.includes(path)) {
    event.respondWith(kept(path).then((response) => response ?? fetch(request)));
  } else if (path.endsWith('.mimicry')) {
    event.respondWith(keptOnUse(request, path));
  }
});

async function page(request) {
  try {
    const response = await fetch(request, { signal: AbortSignal.timeout(kPatience_ms) });
    if (response.status < 500) return response;
  } catch {
    // No network.
  }
  return (await kept('index.html')) ?? fetch(request);
}

async function kept(path) {
  return (await caches.open(kCache)).match(new URL(path, self.registration.scope), { ignoreVary: true });
}

/** Large files come when they are first wanted. */
async function keptOnUse(request, path) {
  const known = await kept(path);
  if (known) return known;
  const response = await fetch(request);
  if (response.ok) {
    const copy = response.clone();
    // Storage that is full keeps nobody from drawing.
    void caches.open(kCache).then((cache) => cache.put(new URL(path, self.registration.scope), copy)).catch(() => undefined);
  }
  return response;
}
