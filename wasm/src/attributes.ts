// What meshes carry beside their geometry. Nothing that is drawn depends on it.
import { MimicryError } from './error.js';
import type { Pointer } from './exports.js';
import { givenList, givenNumbers } from './given.js';
import { calling, textAt, type Module } from './module.js';
import type { Floats, Integers } from './types.js';

/**
 * Values at the corners of faces. Corners name their values by number: where corners of one vertex name different ones there is a seam,
 * which splits no vertex.
 */
export interface CornerValues {
  /** `itemSize` numbers a value. */
  values: Floats;
  itemSize: 2 | 4;
  /** 3 a face: the number of the corner's value, -1: it has none. */
  corners: Integers;
}

/** A name for each face. */
export interface FaceLabels {
  names: readonly string[];
  /** For each face the number of its name, -1: it has none. */
  faces: Integers;
}

/** What is missing the mesh does not carry. */
export interface MeshAttributes {
  /** u, v; of files v is up. */
  texcoords?: CornerValues;
  /** Linear red, green, blue and alpha. */
  colors?: CornerValues;
  groups?: FaceLabels;
  materials?: FaceLabels;
  objects?: FaceLabels;
}

/** Numbers at vertices, as engines hold them: floating-point, or integers that stand for 0 to 1 (of 8 or 16 bits). */
export interface VertexValues {
  /** 2 a vertex. */
  uvs?: ArrayLike<number> | null | undefined;
  /** 3 or 4 a vertex, linear red, green, blue and alpha. */
  colors?: ArrayLike<number> | null | undefined;
  /** 3 a vertex. Not looked at, as the surface has normals of its own: engines' arrays can be given as they are. */
  normals?: ArrayLike<number> | null | undefined;
}

/** Of a mimicry_mesh. */
export function attributesOf(m: Module, mesh: Pointer, faceCount: number): MeshAttributes {
  const found: MeshAttributes = {};
  calling(m, (args) => {
    const at = args.room(12);
    const read = (itemSize: 2 | 4): CornerValues | undefined => {
      const [values, count, corners] = [m.HEAPU32[at >> 2]! >> 2, m.HEAPU32[(at >> 2) + 1]!, m.HEAPU32[(at >> 2) + 2]! >> 2];
      return corners === 0 ? undefined
        : { values: m.HEAPF32.slice(values, values + itemSize * count), itemSize, corners: m.HEAP32.slice(corners, corners + 3 * faceCount) };
    };
    m._mimicry_wasm_mesh_texcoords(mesh, at);
    const texcoords = read(2);
    if (texcoords) found.texcoords = texcoords;
    m._mimicry_wasm_mesh_colors(mesh, at);
    const colors = read(4);
    if (colors) found.colors = colors;
  });
  kLabels.forEach((kind, number) => {
    const at = m._mimicry_mesh_face_labels(mesh, number) >> 2;
    if (at === 0) return;
    const names = Array.from({ length: m._mimicry_mesh_label_count(mesh, number) }, (_, i) => textAt(m, m._mimicry_mesh_label_name(mesh, number, i)));
    found[kind] = { names, faces: m.HEAP32.slice(at, at + faceCount) };
  });
  return found;
}

const kLabels = ['groups', 'materials', 'objects'] as const; // in the order of mimicry_label_kind

/** Of a mesh that was given: what it names at corners and faces, checked, and what it has at vertices. faces: its vertex numbers. */
export function givenAttributes(mesh: VertexValues & { attributes?: MeshAttributes | undefined }, vertexCount: number, faces: Int32Array): MeshAttributes {
  const found: MeshAttributes = {};
  const given = mesh.attributes ?? {};
  if (mesh.normals) givenNumbers(mesh.normals, "the normals of a mesh's vertices", { count: 3 * vertexCount });
  if (given.texcoords) found.texcoords = checkedValues(given.texcoords, 2, 'texcoords', faces.length);
  else if (mesh.uvs) found.texcoords = atVertices(mesh.uvs, 2, "the uvs of a mesh's vertices", vertexCount, faces);
  if (given.colors) found.colors = checkedValues(given.colors, 4, 'colors', faces.length);
  else if (mesh.colors) found.colors = atVertices(mesh.colors, 4, "the colors of a mesh's vertices", vertexCount, faces);
  for (const kind of kLabels) {
    const labels = given[kind];
    if (!labels) continue;
    givenList(labels.names, `the names of a mesh's ${kind}`);
    requireNumbers(labels.faces, faces.length / 3, labels.names.length, `attribute ${kind}`, 'face', 'names');
    found[kind] = labels;
  }
  return found;
}

function checkedValues(given: CornerValues, itemSize: 2 | 4, name: string, corners: number): CornerValues {
  if (given.itemSize !== itemSize) throw new MimicryError('invalid_input', `attribute ${name}: itemSize must be ${itemSize}, not ${String(given.itemSize)}`);
  if (!(given.values instanceof Float32Array) || given.values.length % itemSize !== 0)
    throw new MimicryError('invalid_input', `attribute ${name}: values must be a Float32Array of ${itemSize} numbers each`);
  requireNumbers(given.corners, corners, given.values.length / itemSize, `attribute ${name}`, 'corner', 'values');
  return given;
}

/** Numbers of values that there are, or -1. */
function requireNumbers(numbers: Int32Array, count: number, most: number, what: string, place: string, named: string): void {
  if (!(numbers instanceof Int32Array) || numbers.length !== count)
    throw new MimicryError('invalid_input', `${what}: must be an Int32Array with a number for each ${place} (${count}), not ${numbers?.length}`);
  const wrong = numbers.findIndex((number) => number < -1 || number >= most);
  if (wrong >= 0) throw new MimicryError('invalid_input', `${what}: ${place} ${wrong} has number ${numbers[wrong]} of ${most} ${named}; give one of these, or -1 for none`);
}

/** Each corner has the value of its vertex. */
function atVertices(given: ArrayLike<number>, itemSize: 2 | 4, what: string, vertexCount: number, faces: Int32Array): CornerValues {
  const each = itemSize === 4 && given.length === 3 * vertexCount ? 3 : itemSize;
  const numbers = givenNumbers(given, what, { count: each * vertexCount });
  const one = given instanceof Uint8Array || given instanceof Uint8ClampedArray ? 255 : given instanceof Uint16Array ? 65535 : 1;
  const values = new Float32Array(itemSize * vertexCount).fill(1);
  for (let v = 0; v < vertexCount; v += 1)
    for (let k = 0; k < each; k += 1) values[itemSize * v + k] = numbers[each * v + k]! / one;
  return { values, itemSize, corners: faces.slice() };
}

/**
 * The value at a point of a face (a `SurfaceHit`, a curve's point), linear between the face's corners; NaN where one of them has none.
 * Makes no objects where `out` is given.
 */
export function cornerValueAt({ values, itemSize, corners }: CornerValues, place: { readonly face: number; readonly barycentric: ArrayLike<number> }, out: Float32Array = new Float32Array(itemSize)): Float32Array {
  for (let i = 0; i < itemSize; i += 1) {
    let sum = 0;
    for (let k = 0; k < 3; k += 1) {
      const value = corners[3 * place.face + k] ?? -1;
      sum += value < 0 ? NaN : place.barycentric[k]! * values[itemSize * value + i]!;
    }
    out[i] = sum;
  }
  return out;
}

/**
 * The values of all corners, face by face, for engines that draw without an index: of `CornerValues`, or of vertices as
 * `{ values: mesh.positions, itemSize: 3, corners: mesh.faces }`. NaN where a corner has none.
 */
export function perCorner({ values, itemSize, corners }: { values: ArrayLike<number>; itemSize: number; corners: ArrayLike<number> }): Floats {
  const all = new Float32Array(itemSize * corners.length).fill(NaN);
  for (let c = 0; c < corners.length; c += 1)
    if (corners[c]! >= 0) for (let i = 0; i < itemSize; i += 1) all[itemSize * c + i] = values[itemSize * corners[c]! + i]!;
  return all;
}
