import type { MeshFile } from 'mimicry';

interface Gltf {
  buffers?: { uri?: string; byteLength?: number }[];
  bufferViews?: BufferPart[];
}
interface BufferPart {
  buffer?: number;
  byteOffset?: number;
  extensions?: Record<string, BufferPart>;
}

/** The names, without folders, of the files that a .gltf keeps its buffers in. */
export function bufferNames(gltf: Uint8Array): string[] {
  return (parsed(gltf)?.buffers ?? []).flatMap((buffer) => nameOf(buffer.uri) ?? []);
}

/** One file instead of several: the .gltf as a GLB with its buffers, one behind the other, in its chunk. */
export function packed(gltf: Uint8Array, files: readonly MeshFile[]): Uint8Array<ArrayBuffer> {
  const json = parsed(gltf) ?? {};
  const parts: Uint8Array[] = [];
  const offsets = new Map<number, number>();
  let size = 0;
  (json.buffers ?? []).forEach((buffer, number) => {
    const name = nameOf(buffer.uri);
    const file = files.find((f) => f.name === name);
    if (!file) return;
    offsets.set(number, size);
    parts.push(file.bytes);
    size += file.bytes.length + padding(file.bytes.length);
  });
  const move = (part: BufferPart): void => {
    const offset = offsets.get(part.buffer ?? -1);
    if (offset === undefined) return;
    part.byteOffset = (part.byteOffset ?? 0) + offset;
    part.buffer = 0;
  };
  // Buffers with data of their own, in the text, come behind the chunk's.
  const others = (json.buffers ?? []).filter((_, number) => !offsets.has(number));
  const moved = new Map((json.buffers ?? []).map((buffer, number) => [number, others.indexOf(buffer) + 1]));
  for (const view of json.bufferViews ?? []) {
    for (const part of [view, ...Object.values(view.extensions ?? {})]) {
      if (offsets.has(part.buffer ?? -1)) move(part);
      else if (part.buffer !== undefined) part.buffer = moved.get(part.buffer) ?? part.buffer;
    }
  }
  json.buffers = [{ byteLength: size }, ...others];

  const text = new TextEncoder().encode(JSON.stringify(json));
  const textSize = text.length + padding(text.length);
  const out = new Uint8Array(12 + 8 + textSize + 8 + size);
  const words = new DataView(out.buffer);
  const head = [0x46546c67, 2, out.length, textSize, 0x4e4f534a];
  head.forEach((word, k) => words.setUint32(4 * k, word, true));
  out.fill(0x20, 20, 20 + textSize);
  out.set(text, 20);
  words.setUint32(20 + textSize, size, true);
  words.setUint32(24 + textSize, 0x004e4942, true);
  let at = 28 + textSize;
  for (const part of parts) {
    out.set(part, at);
    at += part.length + padding(part.length);
  }
  return out;
}

function parsed(gltf: Uint8Array): Gltf | null {
  try {
    return JSON.parse(new TextDecoder().decode(gltf)) as Gltf;
  } catch {
    return null; // a GLB, or broken: the reader says so
  }
}

function nameOf(uri: string | undefined): string | null {
  if (!uri || /^data:/i.test(uri)) return null;
  try {
    uri = decodeURIComponent(uri);
  } catch {
    // Not encoded.
  }
  return uri.slice(uri.lastIndexOf('/') + 1);
}

function padding(size: number): number {
  return (4 - (size % 4)) % 4;
}
