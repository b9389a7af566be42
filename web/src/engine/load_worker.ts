import { Mimicry } from 'mimicry';
import type { LoadedModel } from '../studio';
import { bufferNames, packed } from './gltf_files';
import { prepareModel } from './model';

export interface LoadOrder {
  name: string;
  /** Whole, or still on the disk. */
  content: Blob | Uint8Array;
  /** Files that came with it: the buffers of a glTF are among them. */
  beside: readonly File[];
}
export type LoadNews = { stage: string; fraction: number | null } | { model: LoadedModel } | { problem: string };

const kSlice = 8 << 20;
const core = new Mimicry();

const tell = (news: LoadNews, transfer: Transferable[] = []): void => (self as unknown as Worker).postMessage(news, transfer);

self.onmessage = async ({ data }: MessageEvent<LoadOrder>): Promise<void> => {
  try {
    const bytes = data.content instanceof Blob ? await read(data.content, data.name) : data.content;
    const names = data.beside.length > 0 ? bufferNames(bytes) : [];
    const buffers = data.beside.filter((file) => names.includes(file.name));
    const files = await Promise.all(buffers.map(async (file) => ({ name: file.name, bytes: await read(file, file.name) })));
    tell({ stage: `Reading ${data.name}`, fraction: null });
    await core.ready;
    const mesh = core.readMeshFiles([{ name: data.name, bytes }, ...files], data.name);
    tell({ stage: `Looking at ${data.name}`, fraction: 0.7 });
    // What is kept with a drawing and sent to be prepared is one file.
    const kept = files.length > 0 ? packed(bytes, files) : bytes;
    const model = prepareModel(core, mesh, data.name, { file: data.name, bytes: kept });
    tell({ model }, [model.mesh.positions.buffer, model.mesh.faces.buffer, model.corners.positions.buffer as ArrayBuffer, model.corners.normals.buffer as ArrayBuffer, kept.buffer as ArrayBuffer]);
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
