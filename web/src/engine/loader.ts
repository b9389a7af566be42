import type { MeshFile } from 'mimicry';
import { Mimicry, type Core, type Curve, type MeshArrays, type Target } from './core';
import type { Loaded, LoadNews, LoadOrder, LoadSource } from './load_worker';
import type { LoadedModel } from './loaded_model';
import { kMostFileBytes } from './model';

/** What comes with a model that was drawn on before. */
export interface Companions {
  embedding?: MeshFile | null;
  /** Curves on it, a file each. */
  curves?: readonly Uint8Array[];
}

export interface LoadWatch {
  signal: AbortSignal;
  onProgress?: (stage: string, fraction: number | null) => void;
}

/**
 * Makes models ready in a worker: read, looked at, with all that searches in them, their bake and the curves on them.
 * The page takes what was made as it is, in a memory that goes with the model; it never waits.
 */
export class Loader {
  private spare: Worker | null = null;

  constructor(private readonly core: Core) {}

  /** Starts the worker before it is needed. */
  warm(): void {
    this.spare ??= start();
  }

  /** A file's model. `beside`: files that came with it. Rejects with an Error whose message is a sentence; `signal` stops it at once. */
  async file(name: string, content: Blob | Uint8Array, beside: readonly File[], watch: LoadWatch, with_: Companions = {}): Promise<LoadedModel> {
    const size = content instanceof Blob ? content.size : content.length;
    const all = beside.reduce((sum, file) => sum + (/\.bin$/i.test(file.name) ? file.size : 0), size);
    if (all > kMostFileBytes) throw new Error(`${name}: ${(all / 1e9).toFixed(1)} GB is more than a browser can hold; simplify the model to at most ${kMostFileBytes / 1e6} MB first`);
    if (size === 0) throw new Error(`${name}: the file is empty; export it again`);
    return this.model({ file: name, content, beside }, name, watch, with_);
  }

  /** A built-in shape. */
  shape(shape: string, watch: LoadWatch, with_: Companions = {}): Promise<LoadedModel> {
    return this.model({ shape }, shape, watch, with_);
  }

  /** A model that is open, with its bake. */
  async withEmbedding(mesh: MeshArrays, name: string, embedding: MeshFile, watch: LoadWatch): Promise<Target> {
    const { image } = await this.run({ name, mesh }, name, watch, { embedding });
    return (await Mimicry.receive(image, this.core)).target;
  }

  private async model(source: LoadSource, name: string, watch: LoadWatch, with_: Companions): Promise<LoadedModel> {
    const { image, model, found, unusable } = await this.run(source, name, watch, with_);
    const { target, curves } = await Mimicry.receive(image, this.core);
    watch.signal.throwIfAborted();
    const made = { target, curves: found.map((i): Curve | null => (i === null ? null : curves[i]!)), unusable };
    return { ...model!, made };
  }

  private run(source: LoadSource, name: string, { signal, onProgress }: LoadWatch, { embedding = null, curves = [] }: Companions): Promise<Loaded> {
    const worker = this.spare ?? start();
    this.spare = null;
    return new Promise<Loaded>((resolve, reject) => {
      const stop = (): void => {
        worker.terminate();
        reject(new DOMException('cancelled', 'AbortError'));
      };
      if (signal.aborted) return stop();
      const finish = (): void => {
        signal.removeEventListener('abort', stop);
        // Its memory goes with it: a large model's would stay as large.
        worker.terminate();
        this.warm();
      };
      signal.addEventListener('abort', stop);
      worker.onmessage = ({ data }: MessageEvent<LoadNews>) => {
        if ('stage' in data) return onProgress?.(data.stage, data.fraction);
        finish();
        if ('loaded' in data) resolve(data.loaded);
        else reject(new Error(data.problem));
      };
      worker.onerror = (event) => {
        event.preventDefault();
        finish();
        reject(new Error(`${name}: the browser ran out of memory or the reader could not be loaded; try a smaller model, or reload the page`));
      };
      worker.postMessage({ code: this.core.code, source, embedding, curves } satisfies LoadOrder);
    });
  }
}

function start(): Worker {
  return new Worker(new URL('./load_worker.ts', import.meta.url), { type: 'module' });
}
