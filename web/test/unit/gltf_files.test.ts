import { Mimicry } from 'mimicry';
import { beforeAll, describe, expect, it } from 'vitest';
import { bufferNames, packed } from '../../src/engine/gltf_files';

const core = new Mimicry();
beforeAll(() => core.ready);

const floats = (...values: number[]): Uint8Array => new Uint8Array(new Float32Array(values).buffer);
const kEmbedded = `data:application/octet-stream;base64,${Buffer.from(floats(0, 0, 9, 1, 0, 9, 0, 1, 9)).toString('base64')}`;

/** Three triangles: of one buffer in a file, of one in the text, of another file, which has an odd length. */
const kGltf = new TextEncoder().encode(JSON.stringify({
  asset: { version: '2.0' },
  nodes: [{ mesh: 0 }],
  meshes: [{ primitives: [0, 1, 2].map((n) => ({ attributes: { POSITION: n } })) }],
  accessors: [0, 1, 2].map((n) => ({ bufferView: n, count: 3, componentType: 5126, type: 'VEC3' })),
  bufferViews: [{ buffer: 0, byteOffset: 3, byteLength: 36 }, { buffer: 1, byteLength: 36 }, { buffer: 2, byteLength: 36 }],
  buffers: [{ uri: 'parts/one%201.bin', byteLength: 39 }, { uri: kEmbedded, byteLength: 36 }, { uri: 'two.bin', byteLength: 36 }],
}));
const kFiles = [
  { name: 'two.bin', bytes: floats(0, 0, 5, 1, 0, 5, 0, 1, 5) },
  { name: 'one 1.bin', bytes: new Uint8Array([1, 2, 3, ...floats(0, 0, 7, 1, 0, 7, 0, 1, 7)]) },
];

describe('a glTF of several files', () => {
  it('names its buffers', () => {
    expect(bufferNames(kGltf)).toEqual(['one 1.bin', 'two.bin']);
    expect(bufferNames(new Uint8Array([1, 2, 3]))).toEqual([]);
  });

  it('is the same mesh as one file', () => {
    const apart = core.readMeshFiles([{ name: 'a.gltf', bytes: kGltf }, ...kFiles]);
    const together = core.readMesh(packed(kGltf, kFiles), 'a.gltf');
    expect([...together.positions]).toEqual([...apart.positions]);
    expect([2, 11, 20].map((z) => together.positions[z])).toEqual([7, 9, 5]);
    expect([...together.faces]).toEqual([...apart.faces]);
  });
});
