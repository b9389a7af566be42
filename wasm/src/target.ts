import type { MeshAttributes } from './attributes.js';
import { Curve } from './curve.js';
import { MimicryError } from './error.js';
import type { Pointer } from './exports.js';
import { Geodesics } from './geodesics.js';
import { givenBytes, givenList, givenNumbers, givenText } from './given.js';
import { meshAttributes, meshReport, withMesh, type MeshInput, type MeshReport } from './mesh.js';
import { calling, check, Handle, made, requireNoStep, takeBytes, textAt, type Arguments, type Module } from './module.js';
import { ownTechniques } from './own_technique.js';
import { PointQueries, type SurfaceHit } from './queries.js';
import { Session, type SessionOptions } from './session.js';
import { kSurfacePointBytes, pointsAt, putPlaces, type SurfacePlaces, type SurfacePoints } from './surface_points.js';
import type { Bytes } from './types.js';

/** obj: a line element a segment, obj-polylines: one a part. ply and glb have tubes, their -lines edges and line strips. packed: for keeping, written and read twenty times faster than json. */
export type CurveFormat = 'json' | 'obj' | 'csv' | 'ply' | 'glb' | 'obj-polylines' | 'ply-lines' | 'glb-lines' | 'packed';
const kFormats: readonly CurveFormat[] = ['json', 'obj', 'csv', 'ply', 'glb', 'obj-polylines', 'ply-lines', 'glb-lines', 'packed'];

export interface TargetOptions {
  /** Join vertices at equal positions at seams (default true); otherwise curves stop there. */
  join?: boolean;
  /** Refuse a mesh with flaws rather than draw on what it is meant to be (default false). */
  strict?: boolean;
  /** Of no effect: every mesh can be drawn on. */
  allowNonmanifold?: boolean;
}

/**
 * A mesh ready to be drawn on. What is drawn on is the surface that the mesh is meant to be: seams
 * are joined, places where sheets meet are split, doubled and collapsed faces left out, turned faces
 * turned back (`notes`). Faces, barycentrics and vertices are given by the mesh's own numbers.
 */
export class Target extends Handle {
  private readonly queries: PointQueries;

  /** @internal */
  constructor(m: Module, pointer: Pointer, readonly name: string, readonly report: MeshReport, readonly vertexCount: number,
    /** What the mesh carries beside its geometry; the numbers of faces are those of queries and curves. */
    readonly attributes: MeshAttributes) {
    super(m, pointer, 'target');
    this.queries = new PointQueries(m);
  }

  /** @internal */
  static create(m: Module, mesh: MeshInput, name: string, options: TargetOptions): Target {
    const attributes = meshAttributes(mesh);
    return withMesh(m, mesh, name, (pointer) => {
      const target = made(m, (args, out) =>
        m._mimicry_target_make(pointer, args.put(Int32Array.of(options.join === false ? 0 : 1, options.strict ? 1 : 0)), out));
      return new Target(m, target, name, meshReport(m, pointer), mesh.positions.length / 3, attributes);
    });
  }

  protected override destroy(pointer: Pointer): void {
    this.queries.free();
    this.m._mimicry_target_destroy(pointer);
  }

  get diagonal(): number { return this.m._mimicry_target_diagonal(this.at); }
  get min(): readonly number[] { return this.report.boxMin; }
  get max(): readonly number[] { return this.report.boxMax; }
  get faceCount(): number { return this.report.faces; }
  get hasEmbedding(): boolean { return this.m._mimicry_target_has_embedding(this.at) !== 0; }

  /** What was done to make the surface, a sentence each. */
  get notes(): string[] {
    const text = textAt(this.m, this.m._mimicry_target_notes(this.at));
    return text === '' ? [] : text.split('\n');
  }

  /** For each vertex of the mesh one of the surface's, -1 where no face uses it. */
  surfaceVertices(): Int32Array {
    const at = this.m._mimicry_target_surface_vertices(this.at) >> 2;
    return this.m.HEAP32.slice(at, at + this.vertexCount);
  }

  /** For each vertex of the surface the lowest of the mesh's vertices that it joins. */
  surfaceSources(): Int32Array {
    const at = this.m._mimicry_target_surface_sources(this.at) >> 2;
    return this.m.HEAP32.slice(at, at + this.m._mimicry_target_surface_vertex_count(this.at));
  }

  /** Unit normals, 3 a vertex, for drawing the mesh; 0 where no face uses one. */
  vertexNormals(): Float32Array {
    const at = this.m._mimicry_target_vertex_normals(this.at) >> 3;
    return Float32Array.from(this.m.HEAPF64.subarray(at, at + 3 * this.vertexCount));
  }

  /** The closest point of the surface; null where there is none within `most`. Makes no objects. */
  closestPoint(x: number, y: number, z: number, most = Infinity): SurfaceHit | null {
    return this.queries.closestPoint(this.at, x, y, z, most);
  }

  /** The first point on a ray; null where there is none. Makes no objects. */
  firstHit(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number): SurfaceHit | null {
    return this.queries.firstHit(this.at, ox, oy, oz, dx, dy, dz);
  }

  /** The closest points to many: 3 numbers a point. */
  closestPoints(points: ArrayLike<number>, most = Infinity): SurfacePoints {
    const numbers = givenNumbers(points, 'the points', { per: 3 });
    return this.queried(numbers.length / 3, (args, out) =>
      this.m._mimicry_target_closest_points(this.at, args.put(numbers), numbers.length / 3, most, out));
  }

  /** The first points on many rays: 3 numbers each. */
  firstHits(origins: ArrayLike<number>, directions: ArrayLike<number>): SurfacePoints {
    const from = givenNumbers(origins, 'the origins', { per: 3 });
    const to = givenNumbers(directions, 'the directions', { count: from.length });
    return this.queried(from.length / 3, (args, out) =>
      this.m._mimicry_target_first_hits(this.at, args.put(from), args.put(to), from.length / 3, out));
  }

  /** The smooth closest points to many, of a target with its embedding; where there are none, closest points. */
  smoothClosestPoints(points: ArrayLike<number>): SurfacePoints {
    const numbers = givenNumbers(points, 'the points', { per: 3 });
    return this.queried(numbers.length / 3, (args, out) =>
      this.m._mimicry_target_smooth_closest_points(this.at, args.put(numbers), numbers.length / 3, 0, out, 0));
  }

  private queried(count: number, query: (args: Arguments, out: Pointer) => number): SurfacePoints {
    return calling(this.m, (args) => {
      const out = args.room(kSurfacePointBytes * count);
      check(this.m, query(args, out));
      return pointsAt(this.m, out, count);
    });
  }

  /** Exact distances on the surface from the nearest of some points, within a radius (model units). Blocks: seconds on large meshes. */
  geodesics(sources: SurfacePlaces, radius = Infinity): Geodesics {
    const m = this.m;
    return new Geodesics(m, made(m, (args, out) => {
      const { at, count } = putPlaces(m, args, sources, 'the sources');
      return m._mimicry_geodesics_create(this.at, at, count, radius, 0, 0, out);
    }), this.vertexCount);
  }

  /**
   * Moves the mesh's vertices: 3 numbers each. Sessions go on with the moved surface, curves stay where they were. Not of a target
   * that was given an embedding, which is of one shape.
   */
  updatePositions(positions: ArrayLike<number>): void {
    requireNoStep(this.m, 'vertices were moved');
    const numbers = givenNumbers(positions, 'the positions', { per: 3 });
    calling(this.m, (args) => check(this.m, this.m._mimicry_target_update_positions(this.at, args.put(numbers), numbers.length / 3)));
  }

  /** A new target: this one with its bake, the content of a `.mimicry` file that was made for the same mesh. */
  withEmbedding(bytes: Uint8Array | ArrayBuffer, name = `${this.name}.mimicry`): Target {
    const content = givenBytes(bytes, "a file's content");
    const pointer = made(this.m, (args, out) =>
      this.m._mimicry_target_with_embedding(this.at, args.put(content), content.length, args.put(givenText(name, "a file's name")), out));
    return new Target(this.m, pointer, this.name, this.report, this.vertexCount, this.attributes);
  }

  session(technique: string, options: SessionOptions = {}): Session {
    ownTechniques(this.m).require(technique);
    const pointer = made(this.m, (args, out) => this.m._mimicry_session_create(this.at, args.put(givenText(technique, "a technique's name")), out));
    return new Session(this.m, pointer, technique, options);
  }

  /** A file of curves on this target. colors: 3 a curve, sRGB (PLY and GLB). tubeRadius: model units; of curves without radii of their own (PLY and GLB). */
  writeCurves(curves: readonly Curve[], format: CurveFormat, colors?: Uint8Array, tubeRadius = 0.003 * this.diagonal): Bytes {
    const m = this.m;
    const pointers = Int32Array.from(givenList(curves, 'the curves'), (curve) => {
      if (!(curve instanceof Curve)) throw new MimicryError('invalid_input', `the curves must be curves of this package, not ${String(curve)}`);
      return curve.addressIn(m);
    });
    if (!kFormats.includes(format)) throw new MimicryError('invalid_input', `there is no format ${String(format)} for curves; choose one of ${kFormats.join(', ')}`);
    const painted = Uint8Array.from(givenNumbers(colors ?? new Uint8Array(3 * curves.length), "the curves' colors", { count: 3 * curves.length }));
    return takeBytes(m, made(m, (args, out) =>
      m._mimicry_curves_write(this.at, args.put(this.name), args.put(pointers), curves.length,
        kFormats.indexOf(format), args.put(painted), tubeRadius, out)));
  }

  /** What `writeCurves` wrote as JSON or packed, for the same mesh. */
  readCurves(bytes: Uint8Array | ArrayBuffer, name: string): Curve[] {
    const m = this.m;
    const content = givenBytes(bytes, "a file's content");
    const list = made(m, (args, out) =>
      m._mimicry_curves_read(this.at, args.put(content), content.length, args.put(givenText(name, "a file's name")), out));
    try {
      return Array.from({ length: m._mimicry_curve_list_count(list) }, (_, i) =>
        new Curve(m, made(m, (_args, out) => m._mimicry_curve_list_get(list, i, out))));
    } finally {
      m._mimicry_curve_list_destroy(list);
    }
  }

  /** Takes curves over from another target of the same mesh, in another memory too: all or none. They stay the same objects. */
  adopt(curves: readonly Curve[], from: Target): void {
    const copies = this.readCurves(from.writeCurves(curves, 'packed'), from.name);
    curves.forEach((curve, i) => curve.become(copies[i]!));
  }
}
