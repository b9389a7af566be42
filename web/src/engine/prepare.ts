import { bake } from 'mimicry/bake';
import type { ModelSource } from '../studio';
import type { MeshArrays } from './core';

/**
 * The content of a model's `.mimicry` file. A page that comes from `mimicry serve` has its models from
 * files baked by that program, many times faster than a headset could; where there is none, or it is
 * busy, a worker bakes here. (Built-in shapes are baked here: the server's differ in their last bits.)
 */
export async function prepareEmbedding(mesh: MeshArrays, source: ModelSource, signal: AbortSignal, onProgress: (stage: string, fraction: number | null) => void): Promise<Uint8Array> {
  if ('file' in source) {
    const bytes = await fromServer(source.bytes, source.file, signal, () => onProgress('the server is at work', null));
    if (bytes) return bytes;
  }
  return bake(mesh, { signal, onProgress });
}

async function fromServer(content: Uint8Array, name: string, signal: AbortSignal, started: () => void): Promise<Uint8Array | null> {
  try {
    const status = await fetch('api/status', { signal });
    if (!status.ok) return null;
    const { largest_upload } = (await status.json()) as { largest_upload?: number };
    if (content.length > (largest_upload ?? Infinity)) return null;
    started();
    const response = await fetch(`api/bake?name=${encodeURIComponent(name)}`, { method: 'POST', body: content as Uint8Array<ArrayBuffer>, signal });
    return response.ok ? new Uint8Array(await response.arrayBuffer()) : null;
  } catch (error) {
    if (signal.aborted) throw error;
    return null; // no such server
  }
}
