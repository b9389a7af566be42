import { kController, kHead, kPressure, kTime, kTrigger } from '../drawing/frame';
import { lookRotation } from '../math/vec';

/** Where the pen is while it is drawn with on a screen. */
export type PenPlace = 'in front' | 'on the surface';

/** How far in front of the surface the pen starts, as a part of the target's diagonal. */
export const kPenDepth = 0.08;
/** A step of the wheel moves the pen by this part of the diagonal. */
export const kDepthStep = 0.01;

/** Camera and pointer at one moment, world. `direction` is unit; `forward` and `up` are the camera's. */
export interface View {
  eye: Float64Array; // 3
  eyeOrientation: Float64Array; // 4, x y z w
  forward: Float64Array; // 3
  up: Float64Array; // 3
  direction: Float64Array; // 3, from the eye through the pointer
}

export function makeView(): View {
  return {
    eye: new Float64Array(3), eyeOrientation: new Float64Array([0, 0, 0, 1]),
    forward: new Float64Array([0, 0, -1]), up: new Float64Array([0, 1, 0]), direction: new Float64Array([0, 0, -1]),
  };
}

/**
 * A pen for screens. From press to release its tip lies on a plane that faces the camera, a little
 * in front of what was pressed on, so that each technique sees motion in space as from a headset's
 * controller. The wheel moves the plane.
 */
export class PlanePen {
  /** Distance of the plane from the eye along the camera's forward axis, world. */
  depth = 1;

  /** The pen is pressed `distance` away along the pointer's ray; `gap`: how far in front it stays. */
  press(view: View, distance: number, gap: number): void {
    const along = dot(view.direction, view.forward);
    this.depth = Math.max(0.05 * distance, distance - gap) * along;
  }

  /** Where the pointer's ray meets the plane. */
  tip(out: Float64Array, at: number, view: View): void {
    const t = this.depth / Math.max(1e-3, dot(view.direction, view.forward));
    for (let k = 0; k < 3; k += 1) out[at + k] = view.eye[k]! + t * view.direction[k]!;
  }
}

function dot(a: Float64Array, b: Float64Array): number {
  return a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
}

const kAxis = new Float64Array(3);

/**
 * Fills a frame: head at the eye, pen at `tip` pointing along the ray. A tilted pen points where
 * its body does: tiltX, tiltY in degrees as of PointerEvent, 0 where it has none, up to half of
 * which is taken over so that the spray still lands on what is seen.
 */
export function screenFrame(
  frame: Float64Array, view: View, tip: Float64Array, time_s: number, pressure: number, tiltX: number, tiltY: number,
): void {
  frame[kTime] = time_s;
  for (let k = 0; k < 3; k += 1) frame[kHead + k] = view.eye[k]!;
  for (let k = 0; k < 4; k += 1) frame[kHead + 3 + k] = view.eyeOrientation[k]!;
  for (let k = 0; k < 3; k += 1) frame[kController + k] = tip[k]!;
  const { forward: f, up: u, direction: d } = view;
  // right = forward x up; a pen that leans right (tiltX > 0) points left, one that leans to the user (tiltY > 0) points up.
  const rx = f[1]! * u[2]! - f[2]! * u[1]!, ry = f[2]! * u[0]! - f[0]! * u[2]!, rz = f[0]! * u[1]! - f[1]! * u[0]!;
  const a = -Math.tan((clampTilt(tiltX) / 2) * (Math.PI / 180)), b = Math.tan((clampTilt(tiltY) / 2) * (Math.PI / 180));
  kAxis[0] = d[0]! + a * rx + b * u[0]!;
  kAxis[1] = d[1]! + a * ry + b * u[1]!;
  kAxis[2] = d[2]! + a * rz + b * u[2]!;
  const n = Math.hypot(kAxis[0]!, kAxis[1]!, kAxis[2]!);
  lookRotation(frame, kController + 3, kAxis[0]! / n, kAxis[1]! / n, kAxis[2]! / n, u[0]!, u[1]!, u[2]!);
  frame[kTrigger] = 1;
  frame[kPressure] = pressure;
}

function clampTilt(degrees: number): number {
  return Math.min(60, Math.max(-60, degrees));
}
