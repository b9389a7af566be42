import { kInkFrame, kInkStarts, kInkStride } from '../engine/core';
import { rootId, type Drawing, type DrawnCurve } from './document';
import { without, type Range } from './kept';

/**
 * The squared distance from a point to what is left of a curve's ink; Infinity where it is not
 * below `near`. visit: told each frame of which some ink is nearer than that.
 */
function nearestSquared(drawn: DrawnCurve, x: number, y: number, z: number, near: number, visit?: (frame: number) => void): number {
  const { floats, integers, count } = drawn.curve.ink;
  let best = Infinity;
  for (let i = 0; i < count; i += 1) {
    const at = i * kInkStride;
    const frame = integers[at + kInkFrame]!;
    if (!keeps(drawn.kept, frame)) continue;
    const ax = floats[at]! - x, ay = floats[at + 1]! - y, az = floats[at + 2]! - z;
    let d = ax * ax + ay * ay + az * az;
    // Ink runs straight from the vertex before: a long step may pass nearer than its ends.
    if (i > 0 && integers[at + kInkStarts] === 0 && keeps(drawn.kept, integers[at - kInkStride + kInkFrame]!)) {
      const bx = floats[at - kInkStride]! - floats[at]!, by = floats[at - kInkStride + 1]! - floats[at + 1]!, bz = floats[at - kInkStride + 2]! - floats[at + 2]!;
      const length2 = bx * bx + by * by + bz * bz;
      const t = length2 > 0 ? Math.min(1, Math.max(0, -(ax * bx + ay * by + az * bz) / length2)) : 0;
      // The half that is nearer to the other end is that one's.
      const dx = ax + t * bx, dy = ay + t * by, dz = az + t * bz;
      const across = dx * dx + dy * dy + dz * dz;
      if (across <= near && t > 0.5) visit?.(integers[at - kInkStride + kInkFrame]!);
      if (across < best && across <= near) best = across;
      if (t <= 0.5) d = Math.min(d, across);
    }
    if (d > near) continue;
    if (d < best) best = d;
    visit?.(frame);
  }
  return best;
}

function keeps(kept: readonly Range[], frame: number): boolean {
  for (const [first, last] of kept) if (frame >= first && frame <= last) return true;
  return false;
}

/**
 * The drawing without what lies within `radius` of a point (model space). copies: the mirrored
 * copies of a stroke lose the same frames. The same drawing where nothing is near.
 */
export function erasePart(drawing: Drawing, x: number, y: number, z: number, radius: number, copies = false): Drawing {
  const gone = new Map<string, Set<number>>(); // of a curve, or of all copies of a stroke
  const key = (drawn: DrawnCurve): string => (copies ? rootId(drawn.id) : drawn.id);
  for (const drawn of drawing) {
    nearestSquared(drawn, x, y, z, radius * radius, (frame) => {
      const known = gone.get(key(drawn));
      if (known) known.add(frame);
      else gone.set(key(drawn), new Set([frame]));
    });
  }
  if (gone.size === 0) return drawing;
  const left: DrawnCurve[] = [];
  for (const drawn of drawing) {
    const frames = gone.get(key(drawn));
    const kept = frames ? without(drawn.kept, (frame) => frames.has(frame)) : drawn.kept;
    if (!frames) left.push(drawn);
    else if (kept.length > 0) left.push({ ...drawn, kept });
  }
  return left;
}

/** The drawing without the curve that is nearest to the point, where one is within `radius`. copies: and without its stroke's mirrored copies. */
export function eraseCurve(drawing: Drawing, x: number, y: number, z: number, radius: number, copies = false): Drawing {
  let best = radius * radius;
  let nearest: DrawnCurve | null = null;
  for (const drawn of drawing) {
    const d = nearestSquared(drawn, x, y, z, best);
    if (d < best) {
      best = d;
      nearest = drawn;
    }
  }
  if (!nearest) return drawing;
  const { id } = nearest;
  return drawing.filter((drawn) => (copies ? rootId(drawn.id) !== rootId(id) : drawn.id !== id));
}
