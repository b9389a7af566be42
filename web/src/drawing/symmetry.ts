import { kController, kFrameSize, kHead } from './frame';
import { quaternionFromAxes, rotate } from '../math/vec';

/** A plane of the world: points x with normal . x = offset; `normal` is unit. */
export interface Plane {
  normal: [number, number, number];
  offset: number;
}

export type MirrorAxis = 'x' | 'y' | 'z';

/** The model's plane through `centre` (model space) square to one of its axes, in the world. */
export function mirrorPlane(axis: MirrorAxis, centre: readonly number[], modelToWorld: Float64Array): Plane {
  const normal: [number, number, number] = [axis === 'x' ? 1 : 0, axis === 'y' ? 1 : 0, axis === 'z' ? 1 : 0];
  const point = [centre[0]!, centre[1]!, centre[2]!];
  rotate(normal, 0, modelToWorld, 0, normal, 0);
  rotate(point, 0, modelToWorld, 0, point, 0);
  const s = modelToWorld[7]!;
  let offset = 0;
  for (let k = 0; k < 3; k += 1) offset += normal[k]! * (s * point[k]! + modelToWorld[4 + k]!);
  return { normal, offset };
}

const axes = new Float64Array(9);

function mirrorPose(out: Float64Array, at: number, plane: Plane): void {
  const nx = plane.normal[0], ny = plane.normal[1], nz = plane.normal[2];
  const d = 2 * (nx * out[at]! + ny * out[at + 1]! + nz * out[at + 2]! - plane.offset);
  out[at] = out[at]! - d * nx;
  out[at + 1] = out[at + 1]! - d * ny;
  out[at + 2] = out[at + 2]! - d * nz;
  // M R diag(-1, 1, 1): the mirrored device with its own left and right exchanged is a rotation again.
  for (let k = 0; k < 3; k += 1) {
    const a = 3 * k;
    axes[a] = k === 0 ? -1 : 0;
    axes[a + 1] = k === 1 ? 1 : 0;
    axes[a + 2] = k === 2 ? 1 : 0;
    rotate(axes, a, out, at + 3, axes, a);
    const e = 2 * (nx * axes[a]! + ny * axes[a + 1]! + nz * axes[a + 2]!);
    axes[a] = axes[a]! - e * nx;
    axes[a + 1] = axes[a + 1]! - e * ny;
    axes[a + 2] = axes[a + 2]! - e * nz;
  }
  quaternionFromAxes(out, at + 3, axes);
}

/** The frame that the mirror image of the drawer would have made. */
export function mirrorFrame(out: Float64Array, frame: Float64Array, plane: Plane): void {
  for (let k = 0; k < kFrameSize; k += 1) out[k] = frame[k]!;
  mirrorPose(out, kHead, plane);
  mirrorPose(out, kController, plane);
}
