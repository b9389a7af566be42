import { kInkStride } from '../scene/tube';
import type { Drawing, DrawnCurve } from './document';
import { without, type Range } from './kept';

function nearestSquared(drawn: DrawnCurve, x: number, y: number, z: number, near: number, visit?: (frame: number) => void): number {
  const { floats, integers, count } = drawn.curve.ink;
  let best = Infinity;
  for (let i = 0; i < count; i += 1) {
    const at = i * kInkStride;
    const d = (floats[at]! - x) ** 2 + (floats[at + 1]! - y) ** 2 + (floats[at + 2]! - z) ** 2;
    if (d > near) continue;
    const frame = integers[at + 6]!;
    if (!keeps(drawn.kept, frame)) continue;
    if (d < best) best = d;
    visit?.(frame);
  }
  return best;
}

function keeps(kept: readonly Range[], frame: number): boolean {
  for (const [first, last] of kept) if (frame >= first && frame <= last) return true;
  return false;
}

/** The drawing without what lies within `radius` of a point (model space). The same drawing where nothing does. */
export function erasePart(drawing: Drawing, x: number, y: number, z: number, radius: number): Drawing {
  let changed = false;
  const left: DrawnCurve[] = [];
  for (const drawn of drawing) {
    const gone = new Set<number>();
    nearestSquared(drawn, x, y, z, radius * radius, (frame) => gone.add(frame));
    if (gone.size === 0) {
      left.push(drawn);
      continue;
    }
    changed = true;
    const kept = without(drawn.kept, (frame) => gone.has(frame));
    if (kept.length > 0) left.push({ ...drawn, kept });
  }
  return changed ? left : drawing;
}

/** The drawing without the curve that is nearest to the point, where one is within `radius`. */
export function eraseCurve(drawing: Drawing, x: number, y: number, z: number, radius: number): Drawing {
  let best = radius * radius;
  let nearest: DrawnCurve | null = null;
  for (const drawn of drawing) {
    const d = nearestSquared(drawn, x, y, z, best);
    if (d < best) {
      best = d;
      nearest = drawn;
    }
  }
  return nearest ? drawing.filter((drawn) => drawn !== nearest) : drawing;
}
