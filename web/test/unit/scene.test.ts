import { Matrix4, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Width } from '../../src/drawing/document';
import type { Ink } from '../../src/engine/core';
import { creasedCorners } from '../../src/engine/creased';
import { CameraRig, fittingDistance } from '../../src/scene/camera_rig';
import { discs } from '../../src/scene/room_floor';
import { Tube } from '../../src/scene/tube';
import { random } from './random';

function ink(points: number[][], starts: number[] = [0]): Ink {
  const floats = new Float32Array(8 * points.length), integers = new Int32Array(floats.buffer);
  points.forEach((p, i) => {
    floats.set([...p, 0, 0, 1], 8 * i);
    integers[8 * i + 6] = i;
    integers[8 * i + 7] = starts.includes(i) ? 1 : 0;
  });
  return { floats, integers, count: points.length };
}

const full: Width = (_frame, out) => { out[0] = 1; };

/** The shown vertices. */
function vertices(tube: Tube): Vector3[] {
  const positions = tube.geometry.getAttribute('position'), index = tube.geometry.getIndex()!;
  const used = new Set<number>();
  for (let i = 0; i < tube.geometry.drawRange.count; i += 1) used.add(index.getX(i));
  return [...used].map((i) => new Vector3().fromBufferAttribute(positions, i));
}

function wave(count: number): number[][] {
  return Array.from({ length: count }, (_, i) => [0.1 * i, Math.sin(0.05 * i), 0.3 * Math.cos(0.11 * i)]);
}

describe('tube', () => {
  it('lies within its radius of the curve and reaches it everywhere', () => {
    const points = wave(400), tube = new Tube({ radius: 0.05, lift: 0, sides: 8 });
    tube.append(ink(points), full);
    const path = points.map((p) => new Vector3(...(p as [number, number, number])));
    for (const v of vertices(tube)) {
      const d = Math.min(...path.map((p) => p.distanceTo(v)));
      expect(d).toBeLessThan(0.05 + 1e-5); // single precision
    }
    for (const p of path) expect(Math.min(...vertices(tube).map((v) => v.distanceTo(p)))).toBeLessThan(0.06);
  });

  it('is the same however it was cut into pieces', () => {
    const points = wave(700), all = ink(points);
    const once = new Tube({ radius: 0.05, lift: 0.01, sides: 6 }), bits = new Tube({ radius: 0.05, lift: 0.01, sides: 6 });
    once.append(all, full);
    const next = random(8);
    for (let count = 0; count < points.length;) {
      count = Math.min(points.length, count + 1 + Math.floor(5 * next()));
      bits.append({ ...all, count }, full);
    }
    expect(bits.geometry.drawRange.count).toBe(once.geometry.drawRange.count);
    const a = once.geometry.getAttribute('position'), b = bits.geometry.getAttribute('position');
    const last = (once.geometry.drawRange.count / 6 + 6) * 3;
    for (let i = 0; i < last; i += 1) expect(b.array[i]).toBe(a.array[i]);
  });

  it('draws nothing between parts', () => {
    const tube = new Tube({ radius: 0.05, lift: 0, sides: 8 });
    tube.append(ink([[0, 0, 0], [1, 0, 0], [5, 0, 0], [6, 0, 0]], [0, 2]), full);
    const positions = tube.geometry.getAttribute('position'), index = tube.geometry.getIndex()!;
    const corner = [0, 1, 2].map(() => new Vector3());
    for (let i = 0; i < tube.geometry.drawRange.count; i += 3) {
      corner.forEach((c, k) => c.fromBufferAttribute(positions, index.getX(i + k)));
      const area = corner[1]!.clone().sub(corner[0]!).cross(corner[2]!.clone().sub(corner[0]!)).length();
      const middle = (corner[0]!.x + corner[1]!.x + corner[2]!.x) / 3;
      if (middle > 1.06 && middle < 4.94) expect(area).toBeLessThan(1e-9);
    }
  });

  it('shows what was kept only', () => {
    const tube = new Tube({ radius: 0.05, lift: 0, sides: 8 });
    const kept: [number, number][] = [[0, 2], [5, 9]];
    tube.append(ink(wave(10)), full, (from, to) => kept.some(([a, b]) => from >= a && to <= b));
    for (const v of vertices(tube)) expect(v.x < 0.2 + 0.06 || v.x > 0.5 - 0.06).toBe(true);
    expect(vertices(tube).some((v) => v.x > 0.85)).toBe(true);
  });

  it('of one point is a ball, and of one place too', () => {
    for (const points of [[[1, 2, 3]], [[1, 2, 3], [1, 2, 3]]]) {
      const tube = new Tube({ radius: 0.1, lift: 0, sides: 8 });
      tube.append(ink(points), full);
      expect(vertices(tube).length).toBeGreaterThan(8);
      for (const v of vertices(tube)) expect(v.distanceTo(new Vector3(1, 2, 3))).toBeLessThan(0.1 + 1e-5);
    }
  });

  it('normals are unit and look outward', () => {
    const tube = new Tube({ radius: 0.05, lift: 0, sides: 8 });
    tube.append(ink([[0, 0, 0], [1, 0, 0], [2, 0, 0]]), full);
    const positions = tube.geometry.getAttribute('position'), normals = tube.geometry.getAttribute('normal');
    const rings = tube.geometry.drawRange.count / (6 * 8) + 1;
    for (let i = 0; i < rings * 8; i += 1) {
      const n = new Vector3().fromBufferAttribute(normals, i), p = new Vector3().fromBufferAttribute(positions, i);
      expect(n.length()).toBeCloseTo(1, 5);
      const centre = new Vector3(Math.min(2, Math.max(0, p.x)), 0, 0);
      expect(n.dot(p.sub(centre))).toBeGreaterThan(0);
    }
  });
});

describe('creasedCorners', () => {
  const at = <T extends Float32Array | Float64Array>(array: T, vertex: number): T => array.subarray(3 * vertex, 3 * vertex + 3) as T;

  it('keeps a cube sharp and a flat quad flat', () => {
    // Two faces of a box that meet at a right angle, two triangles each.
    const positions = new Float64Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, -1, 0, 1, -1]);
    const faces = new Int32Array([0, 1, 2, 0, 2, 3, 4, 0, 3, 4, 3, 5]);
    const corners = creasedCorners(positions, faces, 0.6);
    for (let c = 0; c < 6; c += 1) expect([...at(corners.normals, corners.faces[c]!)]).toEqual([0, 0, 1]);
    for (let c = 6; c < 12; c += 1) expect(at(corners.normals, corners.faces[c]!)[0]).toBeCloseTo(-1, 6);
    // Four vertices of each quad, each with the quad's normal.
    expect(corners.normals).toHaveLength(3 * 8);
    for (let c = 0; c < 12; c += 1) expect([...at(corners.positions, corners.faces[c]!)]).toEqual([...at(positions, faces[c]!)]);
  });

  it('smooths what is nearly flat', () => {
    const positions = new Float64Array([0, 0, 0, 1, 0, 0.1, 1, 1, 0.1, 0, 1, 0, -1, 0, 0.1, -1, 1, 0.1]);
    const faces = new Int32Array([0, 1, 2, 0, 2, 3, 4, 0, 3, 4, 3, 5]);
    const corners = creasedCorners(positions, faces, 0.6);
    expect(corners.faces[0]).toBe(corners.faces[7]); // vertex 0 in the first and in the third face
    expect(Math.abs(at(corners.normals, corners.faces[0]!)[0]!)).toBeLessThan(0.06);
    expect(corners.normals).toHaveLength(3 * 6);
  });

  it('survives faces without area', () => {
    const { normals } = creasedCorners(new Float64Array([0, 0, 0, 1, 0, 0, 2, 0, 0]), new Int32Array([0, 1, 2]), 0.6);
    for (const n of normals) expect(Number.isFinite(n)).toBe(true);
  });
});

describe('camera', () => {
  it('shows the whole ball, whatever the window', () => {
    for (const aspect of [0.5, 1, 2]) {
      const camera = new PerspectiveCamera(35, aspect), rig = new CameraRig(camera);
      rig.frame(1, 2, 3, 0.5, 0.3, 0.2);
      const next = random(9);
      for (let i = 0; i < 200; i += 1) {
        const p = new Vector3(next() - 0.5, next() - 0.5, next() - 0.5).normalize().multiplyScalar(0.5).add(new Vector3(1, 2, 3)).project(camera);
        expect(Math.abs(p.x)).toBeLessThan(1.001);
        expect(Math.abs(p.y)).toBeLessThan(1.001);
      }
    }
  });

  it('stands where all points just fit, however long the model is', () => {
    const next = random(10), camera = new PerspectiveCamera(35, 1.3), rig = new CameraRig(camera), half = Math.tan((35 / 360) * Math.PI);
    for (let k = 0; k < 20; k += 1) {
      const size = [next(), next() * 0.1, 1 + next()], centre = new Vector3(next(), next(), next());
      const points = Array.from({ length: 300 }, (_, i) => size[i % 3]! * (next() - 0.5));
      const place = new Matrix4().makeRotationY(next()).setPosition(centre), yaw = 6 * next(), pitch = 2 * next() - 1;
      const least = fittingDistance(points, place, centre, yaw, pitch, half * 1.3, half * 0.6);
      rig.frame(centre.x, centre.y, centre.z, 1e-3, yaw, pitch, 0.6, least);
      let most = 0;
      for (let at = 0; at < points.length; at += 3) {
        const p = new Vector3(points[at], points[at + 1], points[at + 2]).applyMatrix4(place).project(camera);
        most = Math.max(most, Math.abs(p.x), Math.abs(p.y) / 0.6);
      }
      expect(most).toBeCloseTo(1, 6);
    }
  });

  it('tells when someone has moved the view, until it is framed again', () => {
    const rig = new CameraRig(new PerspectiveCamera(35, 1));
    const moves = [() => rig.orbit(0.1, 0), () => rig.pan(0.1, 0), () => rig.zoom(2), () => rig.roll(0.1)];
    for (const move of moves) {
      rig.frame(0, 0, 0, 1, 0, 0);
      rig.scale(1.5);
      expect(rig.isMoved).toBe(false);
      move();
      expect(rig.isMoved).toBe(true);
    }
  });

  it('zooms about a point of the window, which stays', () => {
    const camera = new PerspectiveCamera(35, 1.5), rig = new CameraRig(camera);
    rig.frame(0, 0, 0, 1, 0.4, 0.3);
    rig.instant = true;
    // A point of the plane through the centre, under (0.5, -0.3).
    const depth = rig.distance, half = Math.tan((35 / 360) * Math.PI);
    const under = new Vector3(0.5 * 1.5 * half * depth, -0.3 * half * depth, -depth).applyMatrix4(camera.matrixWorld);
    rig.zoom(0.6, 0.5, -0.3);
    rig.update(0.016);
    const p = under.clone().project(camera);
    expect(p.x).toBeCloseTo(0.5, 6);
    expect(p.y).toBeCloseTo(-0.3, 6);
  });

  it('follows softly and comes to rest', () => {
    const camera = new PerspectiveCamera(35, 1), rig = new CameraRig(camera);
    rig.frame(0, 0, 0, 1, 0, 0);
    rig.orbit(1, 0.5);
    let steps = 0;
    while (rig.update(1 / 60)) {
      steps += 1;
      expect(steps).toBeLessThan(120);
    }
    expect(steps).toBeGreaterThan(3);
  });
});

describe('the floor in a headset', () => {
  it('faces up, and fades without an edge that would look like a hill', () => {
    const geometry = discs();
    const at = geometry.getAttribute('position'), color = geometry.getAttribute('color'), index = geometry.getIndex()!;
    const seen = Array.from({ length: at.count }, (_, i) => ({ r: Math.hypot(at.getX(i), at.getZ(i)), alpha: color.getW(i) })).sort((a, b) => a.r - b.r);
    expect(seen[0]!.alpha).toBe(1);
    expect(seen.at(-1)!.alpha).toBe(0);
    expect(seen.at(-1)!.r).toBeGreaterThan(10);
    for (let i = 1; i < seen.length; i += 1) {
      expect(seen[i]!.alpha).toBeLessThanOrEqual(seen[i - 1]!.alpha);
      // From ring to ring less than the eye takes for an edge: a tenth of the floor's own difference to the background.
      expect(seen[i - 1]!.alpha - seen[i]!.alpha).toBeLessThan(0.1);
    }
    for (let f = 0; f < index.count; f += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => [at.getX(index.getX(f + k)), at.getZ(index.getX(f + k))]);
      const up = (b![1]! - a![1]!) * (c![0]! - a![0]!) - (b![0]! - a![0]!) * (c![1]! - a![1]!);
      expect(up).toBeGreaterThanOrEqual(0); // flat at the middle
    }
  });
});
