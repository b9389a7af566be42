import { describe, expect, it } from 'vitest';
import { carryFrame } from '../../src/drawing/carry';
import { kController, kHead, makeFrame } from '../../src/drawing/frame';
import { mirrorFrame, mirrorPlane } from '../../src/drawing/symmetry';
import { carryModel, stretchModel } from '../../src/input/grab';
import { toModel, toWorld } from '../../src/math/similarity';
import { lookRotation, rotate } from '../../src/math/vec';
import { random, unitQuaternion } from './random';

const kRounding = 1e-12;

function near(a: ArrayLike<number>, b: ArrayLike<number>, tolerance = kRounding): void {
  for (let k = 0; k < b.length; k += 1) expect(Math.abs(a[k]! - b[k]!)).toBeLessThan(tolerance);
}

function forward(frame: Float64Array, at: number): number[] {
  const out = [0, 0, -1];
  rotate(out, 0, frame, at + 3, out, 0);
  return out;
}

function randomFrame(next: () => number): Float64Array {
  const frame = makeFrame();
  for (const at of [kHead, kController]) {
    for (let k = 0; k < 3; k += 1) frame[at + k] = 2 * next() - 1;
    frame.set(unitQuaternion(next), at + 3);
  }
  return frame;
}

function randomPlace(next: () => number): Float64Array {
  return new Float64Array([...unitQuaternion(next), next(), next(), next(), 0.2 + next()]);
}

describe('similarities', () => {
  it('there and back is where it was', () => {
    const next = random(1);
    for (let i = 0; i < 100; i += 1) {
      const place = randomPlace(next), x = [next(), next(), next()], y = [0, 0, 0];
      toWorld(y, 0, place, x, 0);
      toModel(y, 0, place, y, 0);
      near(y, x);
    }
  });
});

describe('lookRotation', () => {
  it('points -z along the direction with no roll, straight up and down too', () => {
    const next = random(2);
    for (let i = 0; i < 100; i += 1) {
      const d = i === 0 ? [0, 1, 0] : i === 1 ? [0, -1, 0] : [next() - 0.5, next() - 0.5, next() - 0.5];
      const n = Math.hypot(...d);
      const q = new Float64Array(4), f = [0, 0, -1], right = [1, 0, 0];
      lookRotation(q, 0, d[0]! / n, d[1]! / n, d[2]! / n, 0, 1, 0);
      expect(Math.hypot(...q)).toBeCloseTo(1, 12);
      rotate(f, 0, q, 0, f, 0);
      near(f, d.map((c) => c / n));
      if (i > 1) {
        rotate(right, 0, q, 0, right, 0);
        expect(Math.abs(right[1]!)).toBeLessThan(kRounding);
      }
    }
  });
});

describe('mirrorFrame', () => {
  it('reflects positions and where devices point, and is undone by itself', () => {
    const next = random(3);
    for (let i = 0; i < 100; i += 1) {
      const place = randomPlace(next);
      const plane = mirrorPlane((['x', 'y', 'z'] as const)[i % 3]!, [0.1, 0.2, 0.3], place);
      const frame = randomFrame(next), once = makeFrame(), twice = makeFrame();
      mirrorFrame(once, frame, plane);
      mirrorFrame(twice, once, plane);
      const reflected = (v: number[], offset: number): number[] => {
        const d = 2 * (v[0]! * plane.normal[0] + v[1]! * plane.normal[1] + v[2]! * plane.normal[2] - offset);
        return v.map((c, k) => c - d * plane.normal[k]!);
      };
      for (const at of [kHead, kController]) {
        near(once.subarray(at, at + 3), reflected([...frame.subarray(at, at + 3)], plane.offset));
        near(forward(once, at), reflected(forward(frame, at), 0));
        near(twice.subarray(at, at + 3), frame.subarray(at, at + 3));
        near(forward(twice, at), forward(frame, at));
      }
    }
  });

  it('leaves the points of the plane, which goes through the centre', () => {
    const place = new Float64Array([0, 0, 0, 1, 5, 6, 7, 2]);
    const plane = mirrorPlane('x', [0.5, 0, 0], place);
    expect(plane.offset).toBeCloseTo(6, 12);
  });
});

describe('carryFrame', () => {
  it('keeps the frame as the model sees it', () => {
    const next = random(4);
    for (let i = 0; i < 50; i += 1) {
      const from = randomPlace(next), to = randomPlace(next), frame = randomFrame(next), carried = frame.slice();
      carryFrame(carried, from, to);
      for (const at of [kHead, kController]) {
        const a = [0, 0, 0], b = [0, 0, 0];
        toModel(a, 0, from, frame, at);
        toModel(b, 0, to, carried, at);
        near(b, a);
      }
    }
  });
});

describe('holding the model', () => {
  it('with one hand keeps what is in the hand in the hand', () => {
    const next = random(5);
    const model = randomPlace(next);
    const before = new Float64Array([next(), next(), next(), ...unitQuaternion(next)]);
    const now = new Float64Array([next(), next(), next(), ...unitQuaternion(next)]);
    const held = [0, 0, 0], after = [0, 0, 0];
    toModel(held, 0, model, before, 0);
    carryModel(model, before, now);
    toWorld(after, 0, model, held, 0);
    near(after, now.subarray(0, 3));
  });

  it('with two hands keeps it in both, and stops at the limits of its scale', () => {
    const next = random(6);
    for (let i = 0; i < 50; i += 1) {
      const model = randomPlace(next);
      const hand = (): Float64Array => new Float64Array([next(), next(), next(), 0, 0, 0, 1]);
      const [a0, b0, a1, b1] = [hand(), hand(), hand(), hand()];
      const a = [0, 0, 0], b = [0, 0, 0];
      toModel(a, 0, model, a0!, 0);
      toModel(b, 0, model, b0!, 0);
      const wide = model.slice(), tight = model.slice();
      stretchModel(wide, a0!, b0!, a1!, b1!, 0, 1e9);
      toWorld(a, 0, wide, a, 0);
      toWorld(b, 0, wide, b, 0);
      near(a, a1!.subarray(0, 3), 1e-9); // nearly opposite hands turn with few digits
      near(b, b1!.subarray(0, 3), 1e-9);
      stretchModel(tight, a0!, b0!, a1!, b1!, model[7]!, model[7]!);
      expect(tight[7]).toBe(model[7]);
    }
  });
});
