import { Matrix4, PerspectiveCamera, Quaternion, Vector3 } from 'three';

const kSteepest = (89 / 180) * Math.PI;
/** Seconds after which a move has been followed to 1/e. */
const kEase_s = 0.045;

interface View {
  yaw: number;
  pitch: number;
  roll: number;
  distance: number;
  x: number;
  y: number;
  z: number;
}

/** A camera on a turntable around a point: orbit, pan, zoom about a point of the screen; follows softly. */
export class CameraRig {
  private readonly goal: View = { yaw: 0, pitch: 0, roll: 0, distance: 1, x: 0, y: 0, z: 0 };
  private readonly now: View = { ...this.goal };
  private nearest = 0.01;
  private farthest = 100;
  /** Follows at once. */
  instant = false;
  /** Someone chose another view than the one that was framed. */
  isMoved = false;

  constructor(readonly camera: PerspectiveCamera) {}

  get distance(): number {
    return this.now.distance;
  }

  /**
   * Shows a ball as large as the window allows, of whose height `free` may be used, from no nearer than `least`. yaw and pitch in
   * radians, 0: from +z.
   */
  frame(x: number, y: number, z: number, radius: number, yaw: number, pitch: number, free = 1, least = 0): void {
    const half = (this.camera.fov / 360) * Math.PI;
    const narrow = Math.atan(Math.tan(half) * Math.min(free, this.camera.aspect));
    Object.assign(this.goal, { yaw, pitch, roll: 0, x, y, z, distance: Math.max(least, radius / Math.sin(narrow)) });
    this.isMoved = false;
    this.nearest = radius * 0.15;
    this.farthest = radius * 20;
    this.camera.near = radius * 0.02;
    this.camera.far = radius * 60;
    this.camera.updateProjectionMatrix();
    this.jump();
  }

  /** dYaw, dPitch: as seen in the window, whatever the roll. */
  orbit(dYaw: number, dPitch: number): void {
    this.isMoved = true;
    const c = Math.cos(this.goal.roll), s = Math.sin(this.goal.roll);
    this.goal.yaw += c * dYaw + s * dPitch;
    this.goal.pitch = Math.min(kSteepest, Math.max(-kSteepest, this.goal.pitch + c * dPitch - s * dYaw));
  }

  /** The picture turns by this angle in the window, clockwise. */
  roll(angle: number): void {
    this.isMoved = true;
    this.goal.roll += angle;
  }

  /** dx, dy: parts of the window's height, to the right and down. */
  pan(dx: number, dy: number): void {
    this.isMoved = true;
    const height = 2 * this.goal.distance * Math.tan((this.camera.fov / 360) * Math.PI);
    right.set(1, 0, 0).applyQuaternion(this.camera.quaternion);
    up.set(0, 1, 0).applyQuaternion(this.camera.quaternion);
    this.goal.x += height * (dy * up.x - dx * right.x);
    this.goal.y += height * (dy * up.y - dx * right.y);
    this.goal.z += height * (dy * up.z - dx * right.z);
  }

  /** factor > 1: away. cx, cy: the point of the window that stays, -1 to 1, right and up. */
  zoom(factor: number, cx = 0, cy = 0): void {
    this.isMoved = true;
    this.scale(factor, cx, cy);
  }

  /** The same, as the window asks. */
  scale(factor: number, cx = 0, cy = 0): void {
    const before = this.goal.distance;
    const after = Math.min(this.farthest, Math.max(this.nearest, before * factor));
    const half = Math.tan((this.camera.fov / 360) * Math.PI);
    const k = (before - after) * half;
    right.set(1, 0, 0).applyQuaternion(this.camera.quaternion);
    up.set(0, 1, 0).applyQuaternion(this.camera.quaternion);
    this.goal.x += k * (cx * this.camera.aspect * right.x + cy * up.x);
    this.goal.y += k * (cx * this.camera.aspect * right.y + cy * up.y);
    this.goal.z += k * (cx * this.camera.aspect * right.z + cy * up.z);
    this.goal.distance = after;
  }

  /** Moves the camera toward where it should be; false once it is there. */
  update(dt_s: number): boolean {
    const part = this.instant ? 1 : 1 - Math.exp(-dt_s / kEase_s);
    let moving = false;
    for (const key of keys) {
      const left = this.goal[key] - this.now[key];
      if (Math.abs(left) < 1e-5 * this.now.distance) {
        this.now[key] = this.goal[key];
      } else {
        this.now[key] += part * left;
        moving = true;
      }
    }
    this.apply();
    return moving && !this.instant;
  }

  /** The camera is where it should be, at once: a stroke is about to start. */
  jump(): void {
    Object.assign(this.now, this.goal);
    this.apply();
  }

  private apply(): void {
    const { yaw, pitch, roll, distance, x, y, z } = this.now;
    turn.setFromAxisAngle(yAxis, yaw);
    this.camera.quaternion.setFromAxisAngle(xAxis, -pitch).premultiply(turn);
    this.camera.position.set(0, 0, distance).applyQuaternion(this.camera.quaternion);
    this.camera.quaternion.multiply(turn.setFromAxisAngle(zAxis, roll));
    this.camera.position.x += x;
    this.camera.position.y += y;
    this.camera.position.z += z;
    this.camera.updateMatrixWorld();
  }
}

/**
 * The least distance from `centre` from which all points lie within halfX and halfY (tangents of the angles from the camera's axis)
 * in a picture that is taken from yaw and pitch. points: x, y, z; toWorld places them. O(#points)
 */
export function fittingDistance(points: ArrayLike<number>, toWorld: Matrix4, centre: Vector3, yaw: number, pitch: number, halfX: number, halfY: number): number {
  const view = new Quaternion().setFromAxisAngle(yAxis, yaw).multiply(new Quaternion().setFromAxisAngle(xAxis, -pitch)).invert();
  const toView = new Matrix4().makeRotationFromQuaternion(view).multiply(new Matrix4().makeTranslation(-centre.x, -centre.y, -centre.z)).multiply(toWorld);
  const m = toView.elements;
  let distance = 0;
  for (let at = 0; at + 2 < points.length; at += 3) {
    const px = points[at]!, py = points[at + 1]!, pz = points[at + 2]!;
    const x = m[0]! * px + m[4]! * py + m[8]! * pz + m[12]!, y = m[1]! * px + m[5]! * py + m[9]! * pz + m[13]!, z = m[2]! * px + m[6]! * py + m[10]! * pz + m[14]!;
    distance = Math.max(distance, z + Math.abs(x) / halfX, z + Math.abs(y) / halfY);
  }
  return distance;
}

const keys = ['yaw', 'pitch', 'roll', 'distance', 'x', 'y', 'z'] as const;
const right = new Vector3();
const up = new Vector3();
const xAxis = new Vector3(1, 0, 0);
const yAxis = new Vector3(0, 1, 0);
const zAxis = new Vector3(0, 0, 1);
const turn = new Quaternion();
