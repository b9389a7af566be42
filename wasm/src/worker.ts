import { workerScript } from './bake_files.js';
import type { BakeNews } from './bake_run.js';
import { messageOf, MimicryError } from './error.js';
import { builtin, isNode } from './node.js';
import type { Bytes, WorkerLike } from './types.js';

const kRemedy = 'bake() takes a worker of your own (option worker), and bakeHere() needs none';

/** The bake's own worker. */
export async function startWorker(): Promise<WorkerLike> {
  const script = workerScript();
  try {
    if (isNode) {
      const { Worker: Thread } = await builtin<typeof import('node:worker_threads')>('node:worker_threads');
      // Of the program's own flags, such as loaders, nothing concerns it.
      return typeof script === 'string' ? new Thread(script, { eval: true, execArgv: [] }) : new Thread(new URL(script.href), { execArgv: [] });
    }
    if (typeof Worker === 'undefined') throw new Error('there are no workers here');
    // A script, but servers for developing add imports to it.
    if (typeof script !== 'string') return new Worker(script.href, { type: 'module' });
    const place = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
    try {
      return new Worker(place);
    } finally {
      URL.revokeObjectURL(place); // it is being loaded already
    }
  } catch (error) {
    throw notStarted(messageOf(error));
  }
}

function notStarted(why: string): MimicryError {
  const script = workerScript();
  const place = typeof script === 'string'
    ? "worker-src of the page's Content-Security-Policy must allow blob:"
    : `bake_worker.js of the package must be served as ${script.href}, from the page's own origin, and worker-src of its Content-Security-Policy must allow that`;
  return new MimicryError('failed', `the bake's worker could not be started${why ? ` (${why})` : ''}: ${isNode ? '' : `${place}; `}${kRemedy}`);
}

export function requireWorker(worker: WorkerLike): void {
  if (typeof worker.postMessage !== 'function' || typeof worker.terminate !== 'function' || !('on' in worker || 'addEventListener' in worker))
    throw new MimicryError('invalid_input', 'option worker: give a Worker that runs mimicry/bake_worker');
}

/**
 * Hears of a worker until its bake is done. It is called as soon as there is a worker: one of Node's that fails
 * while nobody listens ends the program.
 */
export function follow(worker: WorkerLike, onProgress?: (stage: string, fraction: number) => void): Promise<Bytes> {
  const done = new Promise<Bytes>((resolve, reject) => {
    const hear = (news: BakeNews) => {
      if ('stage' in news) onProgress?.(news.stage, news.fraction);
      else if ('bytes' in news) resolve(news.bytes);
      else if ('status' in news) reject(new MimicryError(news.status as MimicryError['status'], news.message));
    };
    const fail = (why: string) => reject(new MimicryError('failed', `the bake's worker failed (${why}); ${kRemedy}`));
    if ('on' in worker) {
      worker.on('message', hear);
      worker.on('error', (error: unknown) => fail(messageOf(error)));
      worker.on('exit', (code: number) => fail(`it ended with code ${code}`));
    } else {
      worker.addEventListener('message', (event: { data: BakeNews }) => hear(event.data));
      worker.addEventListener('messageerror', () => fail('its answer could not be read'));
      // Scripts that cannot be loaded have no message.
      worker.addEventListener('error', (event: { message?: string }) => event.message ? fail(event.message) : reject(notStarted('')));
    }
  });
  done.catch(() => {}); // a failure before the order is told by who waits for it
  return done;
}
