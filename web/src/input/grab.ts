import { conjugate, multiply, rotate } from '../math/vec';

const turn = new Float64Array(4);
const point = new Float64Array(3);

/** A hand that holds the model moved from one pose to the next (each x, y, z and quaternion): the model moves along. In place. */
export function carryModel(model: Float64Array, before: Float64Array, now: Float64Array): void {
  conjugate(turn, 0, before, 3);
  multiply(turn, 0, now, 3, turn, 0);
  for (let k = 0; k < 3; k += 1) point[k] = model[4 + k]! - before[k]!;
  rotate(point, 0, turn, 0, point, 0);
  for (let k = 0; k < 3; k += 1) model[4 + k] = now[k]! + point[k]!;
  multiply(model, 0, turn, 0, model, 0);
  normalise(model);
}

const from = new Float64Array(3);
const to = new Float64Array(3);

/** Two hands that hold the model moved: it moves, turns and is scaled so that it stays in both. least, most: of its scale. In place. */
export function stretchModel(model: Float64Array, a0: Float64Array, b0: Float64Array, a1: Float64Array, b1: Float64Array, least: number, most: number): void {
  let n0 = 0, n1 = 0;
  for (let k = 0; k < 3; k += 1) {
    from[k] = b0[k]! - a0[k]!;
    to[k] = b1[k]! - a1[k]!;
    n0 += from[k]! ** 2;
    n1 += to[k]! ** 2;
  }
  n0 = Math.sqrt(n0);
  n1 = Math.sqrt(n1);
  if (n0 < 1e-3 || n1 < 1e-3) return;
  const factor = Math.min(most, Math.max(least, (model[7]! * n1) / n0)) / model[7]!;
  // The shortest turn from one direction to the other.
  const [x0, y0, z0] = [from[0]! / n0, from[1]! / n0, from[2]! / n0];
  const [x1, y1, z1] = [to[0]! / n1, to[1]! / n1, to[2]! / n1];
  turn[0] = y0 * z1 - z0 * y1;
  turn[1] = z0 * x1 - x0 * z1;
  turn[2] = x0 * y1 - y0 * x1;
  turn[3] = 1 + x0 * x1 + y0 * y1 + z0 * z1;
  normalise(turn);
  for (let k = 0; k < 3; k += 1) point[k] = factor * (model[4 + k]! - (a0[k]! + b0[k]!) / 2);
  rotate(point, 0, turn, 0, point, 0);
  for (let k = 0; k < 3; k += 1) model[4 + k] = (a1[k]! + b1[k]!) / 2 + point[k]!;
  multiply(model, 0, turn, 0, model, 0);
  model[7] = model[7]! * factor;
  normalise(model);
}

function normalise(q: Float64Array): void {
  const n = Math.hypot(q[0]!, q[1]!, q[2]!, q[3]!);
  if (n < 1e-9) {
    q[0] = 0; q[1] = 0; q[2] = 0; q[3] = 1;
    return;
  }
  for (let k = 0; k < 4; k += 1) q[k] = q[k]! / n;
}
