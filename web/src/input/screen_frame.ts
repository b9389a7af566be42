import { kController, kHead, kPressure, kTime, kTrigger } from '../drawing/frame';
import { lookRotation } from '../math/vec';

/** How far in front of the surface the plane lies: this part of the distance to the eye, and at most that of the target's diagonal. */
const kPlaneGap = 0.04, kMostPlaneGap = 0.25;
/** A step of the wheel moves the plane by this part of the gap. */
const kPlaneStep = 1 / 8;

/** Camera and pointer at one moment, world. `direction` is unit; `forward` and `up` are the camera's. */
export interface View {
  eye: Float64Array; // 3
  forward: Float64Array; // 3
  up: Float64Array; // 3
  direction: Float64Array; // 3, from the eye through the pointer
}

export function makeView(): View {
  return {
    eye: new Float64Array(3), forward: new Float64Array([0, 0, -1]),
    up: new Float64Array([0, 1, 0]), direction: new Float64Array([0, 0, -1]),
  };
}

/**
 * From press to release the pen's tip lies on a plane that faces the camera, a little in front of
 * what was pressed on, so that each technique sees motion in space as from a headset's controller.
 * The gap goes with the distance to the eye: ink moves as fast in the window however near it is
 * looked at. The wheel moves the plane.
 */
export class PlanePen {
  /** Distance of the plane from the eye along the camera's forward axis, world. */
  depth = 1;
  private gap = 0;

  /** The pen is pressed `distance` away along the pointer's ray, on a target of this diagonal; both world. */
  press(view: View, distance: number, diagonal: number): void {
    this.gap = Math.min(kPlaneGap * distance, kMostPlaneGap * diagonal);
    this.depth = (distance - this.gap) * dot(view.direction, view.forward);
  }

  /** steps: of the wheel, positive toward the eye. */
  wheel(steps: number): void {
    this.depth = Math.max(this.gap, this.depth - steps * kPlaneStep * this.gap);
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
 * Fills a frame: the head at the eye, looking where the pointer is, the pen at `tip` pointing along
 * the ray. A tilted pen points where its body does: tiltX, tiltY in degrees as of PointerEvent, 0 where it has none, up to half of
 * which is taken over so that the spray still lands on what is seen.
 */
export function screenFrame(
  frame: Float64Array, view: View, tip: Float64Array, time_s: number, pressure: number, tiltX: number, tiltY: number,
): void {
  frame[kTime] = time_s;
  for (let k = 0; k < 3; k += 1) frame[kHead + k] = view.eye[k]!;
  for (let k = 0; k < 3; k += 1) frame[kController + k] = tip[k]!;
  const { forward: f, up: u, direction: d } = view;
  lookRotation(frame, kHead + 3, d[0]!, d[1]!, d[2]!, u[0]!, u[1]!, u[2]!);
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
