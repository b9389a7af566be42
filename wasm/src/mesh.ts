import { attributesOf, givenAttributes, type MeshAttributes, type VertexValues } from './attributes.js';
import { givenBytes, givenList, givenNumbers, givenText } from './given.js';
import { Arguments, calling, check, made, textAt, type Module } from './module.js';
import type { Pointer } from './exports.js';
import type { Doubles, Integers } from './types.js';

/** Triangles to draw on: `MeshArrays`, or any arrays of numbers, a geometry of three.js among them. */
export interface MeshInput extends VertexValues {
  /** 3 a vertex. */
  positions: ArrayLike<number>;
  /** 3 vertex numbers a face, counter-clockwise seen from outside; where there are none, each 3 vertices are a face. */
  faces?: ArrayLike<number> | null | undefined;
  /** At corners and faces; where they have texcoords or colors these stand before those of vertices. */
  attributes?: MeshAttributes | undefined;
}

/** As the core takes it. */
export function meshInput(mesh: MeshInput): { positions: Float64Array; faces: Int32Array } {
  const positions = givenNumbers(mesh?.positions, "the positions of a mesh's vertices", { per: 3 });
  const faces: ArrayLike<number> = mesh.faces instanceof Int32Array && mesh.faces.length % 3 === 0 ? mesh.faces
    : mesh.faces ? givenNumbers(mesh.faces, "the vertex numbers of a mesh's faces", { per: 3 })
    : Int32Array.from({ length: positions.length / 3 }, (_, i) => i);
  // Numbers that are no vertex's stay so: -1 is refused with the face's number.
  return { positions, faces: faces instanceof Int32Array ? faces : Int32Array.from(faces, (v) => (Number.isInteger(v) && v < 2 ** 31 ? v : -1)) };
}

/** Triangles as plain arrays, that can be transferred from thread to thread. */
export interface MeshArrays {
  /** 3 a vertex, the file's own coordinates and units. */
  positions: Doubles;
  /** 3 vertex numbers a face, counter-clockwise seen from outside. */
  faces: Integers;
  /** The size at which it is suggested to be shown: a shape's own, or 0.6 m across the bounding box. */
  metresPerUnit: number;
  /** What the file tells beside its geometry; missing where it is nothing. */
  attributes?: MeshAttributes;
}

export interface MeshReport {
  boxMin: [number, number, number];
  boxMax: [number, number, number];
  diagonal: number;
  area: number;
  /** Enclosed; NaN where the mesh is not closed and consistently oriented. */
  volume: number;
  vertices: number;
  edges: number;
  faces: number;
  components: number;
  boundaryLoops: number;
  /** Sum of the components'; -1 where one has none. */
  genus: number;
  manifold: boolean;
  closed: boolean;
  invalidVertices: number;
  nonmanifoldEdges: number;
  nonmanifoldVertices: number;
  inconsistentEdges: number;
  degenerateFaces: number;
  duplicateFaces: number;
}

export interface ShapeInfo {
  name: string;
  description: string;
  defaultResolution: number;
  leastResolution: number;
  mostResolution: number;
}

export function shapeList(m: Module): ShapeInfo[] {
  return Array.from({ length: m._mimicry_shape_count() }, (_, i) => {
    const at = m._mimicry_shape(i) >> 2;
    return {
      name: textAt(m, m.HEAPU32[at]!),
      description: textAt(m, m.HEAPU32[at + 1]!),
      defaultResolution: m.HEAP32[at + 2]!,
      leastResolution: m.HEAP32[at + 3]!,
      mostResolution: m.HEAP32[at + 4]!,
    };
  });
}

/** A file's content; the name may begin with folders. */
export interface MeshFile {
  name: string;
  bytes: Uint8Array;
}

const kFileWords = 3; // name, data, size

/** An array of mimicry_file. */
export function putFiles(m: Module, args: Arguments, files: readonly MeshFile[]): Pointer {
  const held = givenList(files, 'the files').map((file) => {
    const bytes = givenBytes(file?.bytes, 'the content of a file');
    return [args.put(givenText(file.name, "a file's name")), args.put(bytes), bytes.length];
  });
  const at = args.room(4 * kFileWords * files.length);
  m.HEAPU32.set(held.flat(), at >> 2);
  return at;
}

/** What a mesh carries beside its geometry, by corners and faces. */
export function meshAttributes(mesh: MeshInput): MeshAttributes {
  if (!mesh.attributes && !mesh.uvs && !mesh.colors && !mesh.normals) return {};
  const { positions, faces } = meshInput(mesh);
  return givenAttributes(mesh, positions.length / 3, faces);
}

/** The mesh that a call makes, as arrays. */
export function meshArrays(m: Module, call: (args: Arguments, out: Pointer) => number): MeshArrays {
  const mesh = made(m, call);
  try {
    const attributes = attributesOf(m, mesh, m._mimicry_mesh_face_count(mesh));
    const positions = m._mimicry_mesh_positions(mesh) >> 3;
    const faces = m._mimicry_mesh_faces(mesh) >> 2;
    return {
      ...(Object.keys(attributes).length > 0 ? { attributes } : {}),
      positions: m.HEAPF64.slice(positions, positions + 3 * m._mimicry_mesh_vertex_count(mesh)),
      faces: m.HEAP32.slice(faces, faces + 3 * m._mimicry_mesh_face_count(mesh)),
      metresPerUnit: m._mimicry_mesh_metres_per_unit(mesh),
    };
  } finally {
    m._mimicry_mesh_destroy(mesh);
  }
}

/** Runs a body with the mesh in the module's memory. */
export function withMesh<T>(m: Module, mesh: MeshInput, name: string, body: (pointer: Pointer) => T): T {
  const { positions, faces } = meshInput(mesh);
  const pointer = made(m, (args, out) =>
    m._mimicry_mesh_create(args.put(positions), positions.length / 3, args.put(faces), faces.length / 3, args.put(name), out));
  try {
    return body(pointer);
  } finally {
    m._mimicry_mesh_destroy(pointer);
  }
}

const kReportBytes = 9 * 8 + 14 * 4;

export function meshReport(m: Module, mesh: Pointer): MeshReport {
  return calling(m, (args) => {
    const at = args.room(kReportBytes);
    check(m, m._mimicry_mesh_validate(mesh, at));
    const d = (i: number) => m.HEAPF64[(at >> 3) + i]!;
    const n = (i: number) => m.HEAP32[(at >> 2) + 18 + i]!;
    return {
      boxMin: [d(0), d(1), d(2)], boxMax: [d(3), d(4), d(5)], diagonal: d(6), area: d(7), volume: d(8),
      vertices: n(0), edges: n(1), faces: n(2), components: n(3), boundaryLoops: n(4), genus: n(5),
      manifold: n(6) !== 0, closed: n(7) !== 0, invalidVertices: n(8), nonmanifoldEdges: n(9),
      nonmanifoldVertices: n(10), inconsistentEdges: n(11), degenerateFaces: n(12), duplicateFaces: n(13),
    };
  });
}
