import { Mimicry, type MeshFile } from 'mimicry';
import { sentence } from '../base/text';
import type { Curve, MeshArrays, Target, TargetImage } from './core';
import { bufferNames, packed } from './gltf_files';
import type { LoadedModel, ModelSource } from './loaded_model';
import { makeTarget, prepareModel } from './model';

/** What is drawn on: a file, whole or still on the disk, with files that came beside it (a glTF's buffers are among them); a shape; a mesh. */
export type LoadSource =
  | { file: string; content: Blob | Uint8Array; beside: readonly File[] }
  | { shape: string }
  | { name: string; mesh: MeshArrays };

export interface LoadOrder {
  code: WebAssembly.Module;
  source: LoadSource;
  /** Its `.mimicry` file. */
  embedding: MeshFile | null;
  /** Curves on it, a file each. */
  curves: readonly Uint8Array[];
}

/** `found`: for each of the curves where it is among the image's; null: it is damaged. */
export interface Loaded {
  image: TargetImage;
  found: (number | null)[];
  /** What was read; null where a mesh was given. */
  model: Omit<LoadedModel, 'made'> | null;
  /** Why the bake cannot be used: it is left out then. */
  unusable: string | null;
}
export type LoadNews = { stage: string; fraction: number | null } | { loaded: Loaded } | { problem: string };

const kSlice = 8 << 20;

const tell = (news: LoadNews, transfer: Transferable[] = []): void => (self as unknown as Worker).postMessage(news, transfer);

self.onmessage = async ({ data }: MessageEvent<LoadOrder>): Promise<void> => {
  try {
    const { source, code } = data;
    const read: Read = 'file' in source ? await readFile(source, code) : 'shape' in source ? readShape(await engine(code), source.shape) : source;
    tell({ stage: `Making ${read.name} ready`, fraction: 0.6 });
    // A memory of its own, with nothing else in it: it is handed over whole.
    const core = await engine(code);
    const made = make(core, read, data);
    const image = core.handOver(made.target, made.curves);
    const transfer: Transferable[] = [image.memory.buffer];
    const model = read.source ? modelOf(made.target, read.mesh, read.source, transfer) : null;
    tell({ loaded: { image, model, found: made.found, unusable: made.unusable } }, transfer);
  } catch (error) {
    tell({ problem: sentence(error) });
  }
};

/** `source`: null where the page has the model. */
interface Read {
  name: string;
  mesh: MeshArrays;
  source?: ModelSource;
}

function engine(code: WebAssembly.Module): Promise<Mimicry> {
  return new Mimicry({ wasm: code }).ready;
}

function readShape(core: Mimicry, shape: string): Read {
  return { name: shape, mesh: core.shape(shape), source: { shape } };
}

async function readFile({ file: name, content, beside }: Extract<LoadSource, { file: string }>, code: WebAssembly.Module): Promise<Read> {
  const bytes = content instanceof Blob ? await read(content, name) : content;
  const names = beside.length > 0 ? bufferNames(bytes) : [];
  const buffers = beside.filter((file) => names.includes(file.name));
  const files = await Promise.all(buffers.map(async (file) => ({ name: file.name, bytes: await read(file, file.name) })));
  tell({ stage: `Reading ${name}`, fraction: null });
  // The page draws a plain surface: what the file tells beside its geometry is not sent.
  const { attributes: _, ...mesh } = (await engine(code)).readMeshFiles([{ name, bytes }, ...files], name);
  // What is kept with a drawing and sent to be prepared is one file.
  return { name, mesh, source: { file: name, bytes: files.length > 0 ? packed(bytes, files) : bytes } };
}

function make(core: Mimicry, { mesh, name, source }: Read, { embedding, curves }: LoadOrder): Pick<Loaded, 'found' | 'unusable'> & { target: Target; curves: Curve[] } {
  let target = makeTarget(core, mesh, name), unusable: string | null = null;
  if (embedding) {
    try {
      const bare = target;
      target = bare.withEmbedding(embedding.bytes, embedding.name);
      bare.dispose();
    } catch (error) {
      if (!source) throw error; // it was all that was asked for
      unusable = sentence(error);
    }
  }
  const whole: Curve[] = [];
  const found = curves.map((file, i) => {
    try {
      const [curve] = target.readCurves(file, `curve ${i + 1}`);
      return curve ? whole.push(curve) - 1 : null;
    } catch {
      return null;
    }
  });
  return { target, curves: whole, found, unusable };
}

function modelOf(target: Target, mesh: MeshArrays, source: ModelSource, transfer: Transferable[]): NonNullable<Loaded['model']> {
  const { made: _, ...model } = prepareModel(target, mesh, source);
  const { positions, normals, faces } = model.corners;
  for (const array of [mesh.positions, mesh.faces, positions, normals, faces]) transfer.push(array.buffer as ArrayBuffer);
  if ('bytes' in source) transfer.push(source.bytes.buffer as ArrayBuffer);
  return model;
}

async function read(blob: Blob, name: string): Promise<Uint8Array> {
  const bytes = new Uint8Array(blob.size);
  for (let at = 0; at < blob.size; at += kSlice) {
    bytes.set(new Uint8Array(await blob.slice(at, at + kSlice).arrayBuffer()), at);
    tell({ stage: `Reading ${name}`, fraction: (0.4 * Math.min(blob.size, at + kSlice)) / blob.size });
  }
  return bytes;
}
