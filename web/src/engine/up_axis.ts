import type { MeshArrays } from './core';

/** Turns +z up. */
export const kZUp: readonly number[] = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];
export const kAsIs: readonly number[] = [0, 0, 0, 1];

/** Faces of a ground lie within this part of the model's size of its lowest place, and face down to this cosine. */
const kLevel = 0.003, kDown = 0.999;
/** A ground that tells covers this part of the model's outline seen from below, and this many times what the other axis has. */
const kGround = 0.03, kClear = 2;

/**
 * The turn that stands a model upright. glTF is y up by definition. Of other formats the shape tells where it can: things stand
 * on a flat side, or their lowest place is at 0. Else the format: STL comes from CAD and printing, where z is up; OBJ, PLY and
 * OFF mostly from modelling programs and libraries of shapes, where y is. O(#V + #F).
 */
export function guessTurn(mesh: Pick<MeshArrays, 'positions' | 'faces'>, name: string): readonly number[] {
  const ending = /\.([a-z]+)$/i.exec(name)?.[1]?.toLowerCase() ?? '';
  if (ending === 'glb' || ending === 'gltf') return kAsIs;
  const { y, z, size } = looks(mesh);
  if (z.ground > kGround && z.ground > kClear * y.ground) return kZUp;
  if (y.ground > kGround && y.ground > kClear * z.ground) return kAsIs;
  const isAtZero = (axis: Look): boolean => axis.height > 0 && Math.abs(axis.lowest) < kLevel * size;
  if (isAtZero(z) !== isAtZero(y)) return isAtZero(z) ? kZUp : kAsIs;
  return ending === 'stl' ? kZUp : kAsIs;
}

interface Look {
  lowest: number;
  height: number;
  /** Area of the faces that it could stand on, as a part of its outline's box. */
  ground: number;
}

function looks({ positions, faces }: Pick<MeshArrays, 'positions' | 'faces'>): { y: Look; z: Look; size: number } {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  for (const v of faces) {
    for (let k = 0; k < 3; k += 1) {
      const x = positions[3 * v + k]!;
      if (x < min[k]!) min[k] = x;
      if (x > max[k]!) max[k] = x;
    }
  }
  const extent = min.map((low, k) => max[k]! - low);
  const size = Math.max(...extent);
  const ground = [0, 0, 0];
  for (let at = 0; at < faces.length; at += 3) {
    const a = 3 * faces[at]!, b = 3 * faces[at + 1]!, c = 3 * faces[at + 2]!;
    for (const k of [1, 2]) {
      const top = min[k]! + kLevel * size;
      if (positions[a + k]! > top || positions[b + k]! > top || positions[c + k]! > top) continue;
      // Twice the face's area vector.
      const ux = positions[b]! - positions[a]!, uy = positions[b + 1]! - positions[a + 1]!, uz = positions[b + 2]! - positions[a + 2]!;
      const vx = positions[c]! - positions[a]!, vy = positions[c + 1]! - positions[a + 1]!, vz = positions[c + 2]! - positions[a + 2]!;
      const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      const length = Math.hypot(...n);
      if (-n[k]! > kDown * length) ground[k]! += length / 2;
    }
  }
  const look = (k: number): Look => {
    const outline = extent[(k + 1) % 3]! * extent[(k + 2) % 3]!;
    return { lowest: min[k]!, height: extent[k]!, ground: outline > 0 ? ground[k]! / outline : 0 };
  };
  return { y: look(1), z: look(2), size };
}
