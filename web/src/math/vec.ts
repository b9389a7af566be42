/** Vectors and quaternions at an offset of a flat array: nothing is allocated, nothing is wrapped. */
export type Numbers = Float64Array | Float32Array | number[];

/** out = the quaternion (x, y, z, w) that turns -z to the unit vector `forward`, with +y near `up`. */
export function lookRotation(
  out: Numbers, at: number,
  fx: number, fy: number, fz: number,
  ux: number, uy: number, uz: number,
): void {
  // z = -forward, x = up x z, y = z x x.
  const zx = -fx, zy = -fy, zz = -fz;
  let xx = uy * zz - uz * zy, xy = uz * zx - ux * zz, xz = ux * zy - uy * zx;
  let n = Math.sqrt(xx * xx + xy * xy + xz * xz);
  if (n < 1e-6) {
    // Straight up or down: any x that is square to z.
    if (Math.abs(zx) < 0.9) { xx = 0; xy = zz; xz = -zy; } else { xx = -zz; xy = 0; xz = zx; }
    n = Math.sqrt(xx * xx + xy * xy + xz * xz);
  }
  xx /= n; xy /= n; xz /= n;
  axes[0] = xx; axes[1] = xy; axes[2] = xz;
  axes[3] = zy * xz - zz * xy; axes[4] = zz * xx - zx * xz; axes[5] = zx * xy - zy * xx;
  axes[6] = zx; axes[7] = zy; axes[8] = zz;
  quaternionFromAxes(out, at, axes);
}

const axes = new Float64Array(9);

/** From the columns x, y, z of a rotation matrix. */
export function quaternionFromAxes(out: Numbers, at: number, columns: Float64Array): void {
  const xx = columns[0]!, xy = columns[1]!, xz = columns[2]!, yx = columns[3]!, yy = columns[4]!, yz = columns[5]!;
  const zx = columns[6]!, zy = columns[7]!, zz = columns[8]!;
  const trace = xx + yy + zz;
  let x: number, y: number, z: number, w: number;
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    w = s / 4; x = (yz - zy) / s; y = (zx - xz) / s; z = (xy - yx) / s;
  } else if (xx > yy && xx > zz) {
    const s = 2 * Math.sqrt(1 + xx - yy - zz);
    w = (yz - zy) / s; x = s / 4; y = (yx + xy) / s; z = (zx + xz) / s;
  } else if (yy > zz) {
    const s = 2 * Math.sqrt(1 + yy - xx - zz);
    w = (zx - xz) / s; x = (yx + xy) / s; y = s / 4; z = (zy + yz) / s;
  } else {
    const s = 2 * Math.sqrt(1 + zz - xx - yy);
    w = (xy - yx) / s; x = (zx + xz) / s; y = (zy + yz) / s; z = s / 4;
  }
  const n = Math.sqrt(x * x + y * y + z * z + w * w);
  out[at] = x / n; out[at + 1] = y / n; out[at + 2] = z / n; out[at + 3] = w / n;
}

/** out[to..] = v[from..] rotated by the unit quaternion at q[qa..]. May be in place. */
export function rotate(out: Numbers, to: number, q: Numbers, qa: number, v: Numbers, from: number): void {
  const x = q[qa]!, y = q[qa + 1]!, z = q[qa + 2]!, w = q[qa + 3]!;
  const vx = v[from]!, vy = v[from + 1]!, vz = v[from + 2]!;
  const tx = 2 * (y * vz - z * vy), ty = 2 * (z * vx - x * vz), tz = 2 * (x * vy - y * vx);
  out[to] = vx + w * tx + y * tz - z * ty;
  out[to + 1] = vy + w * ty + z * tx - x * tz;
  out[to + 2] = vz + w * tz + x * ty - y * tx;
}

/** out = a b, quaternions. May be in place. */
export function multiply(out: Numbers, to: number, a: Numbers, aa: number, b: Numbers, ba: number): void {
  const ax = a[aa]!, ay = a[aa + 1]!, az = a[aa + 2]!, aw = a[aa + 3]!;
  const bx = b[ba]!, by = b[ba + 1]!, bz = b[ba + 2]!, bw = b[ba + 3]!;
  out[to] = aw * bx + ax * bw + ay * bz - az * by;
  out[to + 1] = aw * by - ax * bz + ay * bw + az * bx;
  out[to + 2] = aw * bz + ax * by - ay * bx + az * bw;
  out[to + 3] = aw * bw - ax * bx - ay * by - az * bz;
}

/** out = the conjugate of q. May be in place. */
export function conjugate(out: Numbers, to: number, q: Numbers, qa: number): void {
  out[to] = -q[qa]!; out[to + 1] = -q[qa + 1]!; out[to + 2] = -q[qa + 2]!; out[to + 3] = q[qa + 3]!;
}
