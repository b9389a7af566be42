import { Mimicry } from 'mimicry';
import type { LoadedModel } from '../studio';
import { prepareModel } from './model';

export interface LoadOrder {
  name: string;
  /** Whole, or still on the disk. */
  content: Blob | Uint8Array;
}
export type LoadNews = { stage: string; fraction: number | null } | { model: LoadedModel } | { problem: string };

const kSlice = 8 << 20;
const core = new Mimicry();

const tell = (news: LoadNews, transfer: Transferable[] = []): void => (self as unknown as Worker).postMessage(news, transfer);

self.onmessage = async ({ data }: MessageEvent<LoadOrder>): Promise<void> => {
  try {
    const bytes = data.content instanceof Blob ? await read(data.content, data.name) : data.content;
    tell({ stage: `Reading ${data.name}`, fraction: null });
    await core.ready;
    const mesh = core.readMesh(bytes, data.name);
    tell({ stage: `Looking at ${data.name}`, fraction: 0.7 });
    const model = prepareModel(core, mesh, data.name, { file: data.name, bytes });
    tell({ model }, [model.mesh.positions.buffer, model.mesh.faces.buffer, model.corners.positions.buffer as ArrayBuffer, model.corners.normals.buffer as ArrayBuffer, bytes.buffer as ArrayBuffer]);
  } catch (error) {
    tell({ problem: error instanceof Error ? error.message : String(error) });
  }
};

async function read(blob: Blob, name: string): Promise<Uint8Array> {
  const bytes = new Uint8Array(blob.size);
  for (let at = 0; at < blob.size; at += kSlice) {
    bytes.set(new Uint8Array(await blob.slice(at, at + kSlice).arrayBuffer()), at);
    tell({ stage: `Reading ${name}`, fraction: (0.5 * Math.min(blob.size, at + kSlice)) / blob.size });
  }
  return bytes;
}
