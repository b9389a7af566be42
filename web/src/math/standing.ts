import { multiply, rotate } from './vec';

/** modelToWorld of a model whose box's centre is at `where`, turned by a unit quaternion and scaled. */
export function standing(centre: readonly number[], where: readonly number[], turn: readonly number[], scale: number): Float64Array {
  const place = new Float64Array([...turn, 0, 0, 0, scale]), at = [centre[0]!, centre[1]!, centre[2]!];
  rotate(at, 0, place, 0, at, 0);
  for (let k = 0; k < 3; k += 1) place[4 + k] = where[k]! - scale * at[k]!;
  return place;
}

/** A quarter of a turn around the world's x (toward the viewer) or z (to the side), after `turn`; exact after four. */
export function quarterTurned(turn: readonly number[], axis: 'x' | 'z'): number[] {
  const quarter = axis === 'x' ? [Math.SQRT1_2, 0, 0, Math.SQRT1_2] : [0, 0, -Math.SQRT1_2, Math.SQRT1_2], out = [0, 0, 0, 1];
  multiply(out, 0, quarter, 0, [...turn], 0);
  const length = Math.hypot(...out);
  return out.map((x) => x / length);
}
