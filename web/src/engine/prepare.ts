import { bake } from 'mimicry/bake';
import { BakeProgress } from './bake_progress';
import type { MeshArrays } from './core';
import type { ModelSource } from './loaded_model';

/** A server that bakes is asked so often how far it is. */
const kPause_ms = 500;

/**
 * The content of a model's `.mimicry` file. A page that comes from `mimicry serve` has its models from
 * files baked by that program, many times faster than a headset could; where there is none, or it is
 * busy, a worker bakes here. (Built-in shapes are baked here: the server's differ in their last bits.)
 * onProgress: a sentence, and how far the whole is, 0 to 1, which only grows.
 */
export async function prepareEmbedding(mesh: MeshArrays, source: ModelSource, signal: AbortSignal, onProgress: (text: string, fraction: number) => void): Promise<Uint8Array> {
  const progress = new BakeProgress();
  const tell = (stage: string, fraction: number): void => {
    const { text, fraction: whole } = progress.take(stage, fraction);
    onProgress(text, whole);
  };
  tell('', 0);
  if ('file' in source) {
    const bytes = await fromServer(source.bytes, source.file, signal, tell);
    if (bytes) return bytes;
  }
  return bake(mesh, { signal, onProgress: tell });
}

interface Status {
  largest_upload?: number;
  waiting?: number;
  bake?: { stage: string; fraction: number };
}

async function fromServer(content: Uint8Array, name: string, signal: AbortSignal, tell: (stage: string, fraction: number) => void): Promise<Uint8Array | null> {
  let asking = 0;
  const status = async (): Promise<Status | null> => {
    const response = await fetch('api/status', { signal });
    return response.ok ? ((await response.json()) as Status) : null;
  };
  try {
    const first = await status();
    if (!first || content.length > (first.largest_upload ?? Infinity)) return null;
    const ask = async (): Promise<void> => {
      // Where others wait it may be another one's.
      const now = await status().catch(() => null);
      if (asking && now?.bake && now.waiting === 0) tell(now.bake.stage, now.bake.fraction);
      if (asking) asking = window.setTimeout(() => void ask(), kPause_ms);
    };
    asking = window.setTimeout(() => void ask(), kPause_ms);
    const response = await fetch(`api/bake?name=${encodeURIComponent(name)}`, { method: 'POST', body: content as Uint8Array<ArrayBuffer>, signal });
    return response.ok ? new Uint8Array(await response.arrayBuffer()) : null;
  } catch (error) {
    if (signal.aborted) throw error;
    return null; // no such server
  } finally {
    clearTimeout(asking);
    asking = 0;
  }
}
