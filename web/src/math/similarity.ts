import { rotate, type Numbers } from './vec';

/** Where a model stands: rotation x, y, z, w; translation x, y, z; scale. x -> scale R x + t. */
export const kSimilaritySize = 8;

export function identitySimilarity(): Float64Array {
  return new Float64Array([0, 0, 0, 1, 0, 0, 0, 1]);
}

export function toWorld(out: Numbers, to: number, s: Float64Array, v: Numbers, from: number): void {
  rotate(out, to, s, 0, v, from);
  out[to] = out[to]! * s[7]! + s[4]!;
  out[to + 1] = out[to + 1]! * s[7]! + s[5]!;
  out[to + 2] = out[to + 2]! * s[7]! + s[6]!;
}

const kInverse = new Float64Array(4);

export function toModel(out: Numbers, to: number, s: Float64Array, v: Numbers, from: number): void {
  const k = 1 / s[7]!;
  out[to] = (v[from]! - s[4]!) * k;
  out[to + 1] = (v[from + 1]! - s[5]!) * k;
  out[to + 2] = (v[from + 2]! - s[6]!) * k;
  directionToModel(out, to, s, out, to);
}

/** Directions are rotated only. */
export function directionToModel(out: Numbers, to: number, s: Float64Array, v: Numbers, from: number): void {
  kInverse[0] = -s[0]!; kInverse[1] = -s[1]!; kInverse[2] = -s[2]!; kInverse[3] = s[3]!;
  rotate(out, to, kInverse, 0, v, from);
}
