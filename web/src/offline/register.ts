const kHour_ms = 3600e3;

/** The build that this page is of; empty where it was not built. */
function pageBuild(): string {
  return document.querySelector<HTMLMetaElement>('meta[name=build]')?.content ?? '';
}

/**
 * Keeps the page for use without a network. announce: a newer page can be had, by reloading. Nothing happens where pages cannot
 * be kept (plain HTTP, private windows) and in a page that was not built.
 */
export async function keepOffline(announce: () => void): Promise<void> {
  if (!pageBuild() || !('serviceWorker' in navigator)) return;
  const registration = await navigator.serviceWorker.register('sw.js', { updateViaCache: 'none' }).catch(() => null);
  if (!registration) return; // forbidden
  const look = async (): Promise<void> => {
    const { waiting } = registration;
    if (!waiting) return;
    // The page comes from the network: it may be the new one already.
    if ((await buildOf(waiting)) === pageBuild()) waiting.postMessage('take over if alone');
    else announce();
  };
  registration.addEventListener('updatefound', () => {
    const { installing } = registration;
    installing?.addEventListener('statechange', () => {
      if (installing.state === 'installed' && navigator.serviceWorker.controller) void look();
    });
  });
  await look();
  let last_ms = Date.now();
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden' || Date.now() - last_ms < kHour_ms) return;
    last_ms = Date.now();
    void registration.update().catch(() => undefined); // no network
  });
}

function buildOf(worker: ServiceWorker): Promise<string> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = ({ data }: MessageEvent<string>) => resolve(data);
    worker.postMessage('build', [port2]);
  });
}
