import type { LoadedModel } from '../studio';
import type { LoadNews, LoadOrder } from './load_worker';
import { kMostFileBytes } from './model';

let spare: Worker | null = null;

function start(): Worker {
  return new Worker(new URL('./load_worker.ts', import.meta.url), { type: 'module' });
}

/** Starts the worker before it is needed. */
export function warmLoader(): void {
  spare ??= start();
}

/** Reads a model in a worker. `beside`: files that came with it. Rejects with an Error whose message is a sentence; `signal` stops it at once. */
export function loadModel(name: string, content: Blob | Uint8Array, beside: readonly File[], onProgress: (stage: string, fraction: number | null) => void, signal: AbortSignal): Promise<LoadedModel> {
  const size = content instanceof Blob ? content.size : content.length;
  const all = beside.reduce((sum, file) => sum + (/\.bin$/i.test(file.name) ? file.size : 0), size);
  if (all > kMostFileBytes) {
    return Promise.reject(new Error(`${name}: ${(all / 1e9).toFixed(1)} GB is more than a browser can hold; simplify the model to at most ${kMostFileBytes / 1e6} MB first`));
  }
  if (size === 0) return Promise.reject(new Error(`${name}: the file is empty; export it again`));
  const worker = spare ?? start();
  spare = null;
  return new Promise<LoadedModel>((resolve, reject) => {
    const stop = (): void => {
      worker.terminate();
      reject(new DOMException('cancelled', 'AbortError'));
    };
    const finish = (): void => {
      signal.removeEventListener('abort', stop);
      worker.onmessage = null;
      worker.onerror = null;
      if (spare) worker.terminate();
      else spare = worker;
    };
    signal.addEventListener('abort', stop);
    worker.onmessage = ({ data }: MessageEvent<LoadNews>) => {
      if ('stage' in data) return onProgress(data.stage, data.fraction);
      finish();
      if ('model' in data) resolve(data.model);
      else reject(new Error(data.problem));
    };
    worker.onerror = (event) => {
      event.preventDefault();
      signal.removeEventListener('abort', stop);
      worker.terminate();
      reject(new Error(`${name}: the browser ran out of memory or the reader could not be loaded; try a smaller model, or reload the page`));
    };
    worker.postMessage({ name, content, beside } satisfies LoadOrder);
  });
}
