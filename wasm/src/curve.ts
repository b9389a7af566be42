import { MimicryError } from './error.js';
import type { Pointer } from './exports.js';
import { givenCount, givenNumbers, givenText } from './given.js';
import { copiedInk, type Ink } from './ink.js';
import { calling, check, Handle, made, textAt, type Module } from './module.js';

export interface CurvePoint {
  position: [number, number, number];
  normal: [number, number, number];
  barycentric: [number, number, number];
  time_s: number;
  /** Model units. */
  penDistance: number;
  face: number;
  frame: number;
}

/** Triangles of a curve as a tube; model units. */
export interface TubeArrays {
  positions: Float32Array;
  normals: Float32Array;
  faces: Uint32Array;
}

const kPointBytes = 12 * 8;

/** A curve on its target, which it keeps alive. It never changes: edits make a new one. */
export class Curve extends Handle {
  private cached: Ink | undefined;

  /** @internal */
  constructor(m: Module, pointer: Pointer) {
    super(m, pointer, 'curve');
  }

  protected override destroy(pointer: Pointer): void {
    this.m._mimicry_curve_destroy(pointer);
  }

  /** @internal Takes the place of a copy of itself, which is given back. */
  become(copy: Curve): void {
    this.exchange(copy);
    copy.dispose();
  }

  get pointCount(): number { return this.m._mimicry_curve_point_count(this.at); }
  /** Along the surface, model units. */
  get length(): number { return this.m._mimicry_curve_length(this.at); }
  get closed(): boolean { return this.m._mimicry_curve_is_closed(this.at) !== 0; }
  /** The id of the stroke that it came from. */
  get stroke(): string { return textAt(this.m, this.m._mimicry_curve_stroke(this.at)); }
  get technique(): string { return textAt(this.m, this.m._mimicry_curve_technique(this.at)); }
  /** Copied once. */
  get ink(): Ink {
    this.cached ??= copiedInk(this.m, this.m._mimicry_curve_ink(this.at), this.m._mimicry_curve_ink_count(this.at));
    return this.cached;
  }

  /** number: from 0. */
  point(number: number): CurvePoint {
    if (!(givenCount(number, "a point's number") >= 0 && number < this.pointCount))
      throw new MimicryError('invalid_input', `there is no point ${number} in a curve of ${this.pointCount} points`);
    return calling(this.m, (args) => {
      const at = args.room(kPointBytes);
      check(this.m, this.m._mimicry_curve_point_at(this.at, number, at));
      return pointAt(this.m, at);
    });
  }

  /** Of its points, in order: the numbers of the stroke's frames that they came from. */
  get frames(): Int32Array {
    return calling(this.m, (args) => {
      const at = args.room(kPointBytes);
      return Int32Array.from({ length: this.pointCount }, (_, i) => {
        check(this.m, this.m._mimicry_curve_point_at(this.at, i, at));
        return this.m.HEAP32[(at >> 2) + 23]!;
      });
    });
  }

  private edited(call: (m: Module, at: Pointer, out: Pointer) => number): Curve {
    return new Curve(this.m, made(this.m, (_, out) => call(this.m, this.at, out)));
  }

  /** Points [first, end), an open curve. */
  slice(first: number, end: number): Curve {
    const [from, to] = [givenCount(first, 'the first point'), givenCount(end, 'the end of the points')];
    return this.edited((m, at, out) => m._mimicry_curve_slice(at, from, to, out));
  }
  /** `count` points at equal steps of length. */
  resample(count: number): Curve { return this.edited((m, at, out) => m._mimicry_curve_resample(at, givenCount(count, 'the number of points'), out)); }
  /** strength: 0 to 1. */
  smooth(strength = 0.5, iterations = 1): Curve { return this.edited((m, at, out) => m._mimicry_curve_smooth(at, strength, iterations, out)); }
  /** tolerance: model units. */
  simplify(tolerance: number): Curve { return this.edited((m, at, out) => m._mimicry_curve_simplify(at, tolerance, out)); }
  /** Joins the end to the start by the shortest path. */
  close(): Curve { return this.edited((m, at, out) => m._mimicry_curve_close(at, out)); }
  /** A copy that bears another stroke's id. */
  withStroke(id: string): Curve {
    return new Curve(this.m, made(this.m, (args, out) => this.m._mimicry_curve_with_stroke(this.at, args.put(givenText(id, "a stroke's id")), out)));
  }

  /** A copy whose tube is as thick as given at each point: one a point, model units, above 0. */
  withRadii(radii: ArrayLike<number>): Curve {
    const numbers = givenNumbers(radii, 'radii');
    if (numbers.length !== this.pointCount)
      throw new MimicryError('invalid_input', `${numbers.length} radii for a curve of ${this.pointCount} points; give one for each`);
    return new Curve(this.m, made(this.m, (args, out) => this.m._mimicry_curve_with_radii(this.at, args.put(numbers), out)));
  }

  /** A copy whose tube is raised along the surface's normal in GLB and PLY files; model units. */
  withLift(lift: number): Curve { return this.edited((m, at, out) => m._mimicry_curve_with_lift(at, lift, out)); }

  /** radius (of a curve without radii of its own) and lift (along the surface's normal): model units. */
  tube(radius: number, sides = 12, lift = 0): TubeArrays {
    const m = this.m;
    const tube = made(m, (_, out) => m._mimicry_curve_tube(this.at, radius, sides, lift, out));
    const words = 3 * m._mimicry_tube_vertex_count(tube);
    const positions = m._mimicry_tube_positions(tube) >> 2;
    const normals = m._mimicry_tube_normals(tube) >> 2;
    const faces = m._mimicry_tube_faces(tube) >> 2;
    const arrays = {
      positions: m.HEAPF32.slice(positions, positions + words),
      normals: m.HEAPF32.slice(normals, normals + words),
      faces: m.HEAPU32.slice(faces, faces + 3 * m._mimicry_tube_face_count(tube)),
    };
    m._mimicry_tube_destroy(tube);
    return arrays;
  }
}

function pointAt(m: Module, at: Pointer): CurvePoint {
  const d = (i: number) => m.HEAPF64[(at >> 3) + i]!;
  return {
    position: [d(0), d(1), d(2)],
    normal: [d(3), d(4), d(5)],
    barycentric: [d(6), d(7), d(8)],
    time_s: d(9),
    penDistance: d(10),
    face: m.HEAP32[(at >> 2) + 22]!,
    frame: m.HEAP32[(at >> 2) + 23]!,
  };
}
