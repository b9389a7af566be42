import type { Curve, RecordedStroke, Target } from '../engine/core';
import { kDefaults, kInks } from '../settings';
import type { DrawnCurve, InkStyle } from './document';
import { kFrameSize } from './frame';
import type { Range } from './kept';
import type { MirrorAxis } from './symmetry';

/** A curve of a saved drawing, each part as it could be read. */
export interface Part {
  id: string;
  mirror: unknown;
  style: unknown;
  kept: unknown;
  stroke: RecordedStroke | null;
  /** Throws where it cannot be read. */
  curve: () => Curve;
  technique?: string | undefined;
}

export interface Recovered {
  drawing: DrawnCurve[];
  /** What is not as it was saved, as sentences that name the strokes. */
  remarks: string[];
}

/**
 * A saved drawing, with everything of it that is sound: one bad stroke takes no other along. name: the file's, or the drawing's.
 * reasons: what a reader said of strokes that are null.
 */
export function recover(target: Target, parts: Iterable<Part>, name: string, reasons: readonly string[] = []): Recovered {
  const drawing: DrawnCurve[] = [], missing: string[] = [], redrawn: string[] = [], restyled: string[] = [];
  for (const part of parts) {
    const { id, stroke } = part;
    if (!stroke || !isSound(stroke)) {
      missing.push(id);
      continue;
    }
    let curve: Curve;
    try {
      curve = part.curve();
    } catch {
      try {
        curve = redraw(target, part.technique, stroke);
      } catch {
        missing.push(id);
        continue;
      }
      redrawn.push(id);
    }
    const style = soundStyle(part.style), kept = soundRanges(part.kept, stroke, curve);
    const mirror = part.mirror === 'x' || part.mirror === 'y' || part.mirror === 'z' ? part.mirror as MirrorAxis : null;
    if (!style || !kept) restyled.push(id);
    drawing.push({ id, stroke, mirror, style: style ?? { ...kDefaults.style, color: kInks[0].color }, kept: kept ?? [[0, frameCount(stroke) - 1]], curve });
  }
  const remarks = reasons.map((reason) => `Left out: ${reason}`);
  if (missing.length > reasons.length) remarks.push(`${name}: ${few(missing, 'stroke')} ${missing.length === 1 ? 'is' : 'are'} damaged and left out; the others are here.`);
  if (redrawn.length > 0) remarks.push(`${name}: the ${few(redrawn, 'curve')} could not be read and ${redrawn.length === 1 ? 'was' : 'were'} drawn anew from the recorded strokes.`);
  if (restyled.length > 0) remarks.push(`${name}: colour, size or erased parts of ${few(restyled, 'curve')} could not be read; ${restyled.length === 1 ? 'it is' : 'they are'} shown whole.`);
  return { drawing, remarks };
}

/** A stroke from first frame to last through a technique; the studio's first one where that is not to be had. */
function redraw(target: Target, technique: string | undefined, stroke: RecordedStroke): Curve {
  const session = sessionOf(target, technique ?? kDefaults.technique) ?? target.session(kDefaults.technique);
  try {
    session.begin(stroke.modelToWorld);
    for (let at = 0; at < stroke.frames.length; at += kFrameSize) session.add(stroke.frames.subarray(at, at + kFrameSize));
    session.end();
    if (session.ink.count === 0) throw new Error('it meets nothing');
    const curve = session.curve(), named = curve.withStroke(stroke.id);
    curve.dispose();
    return named;
  } finally {
    session.dispose();
  }
}

function sessionOf(target: Target, technique: string): ReturnType<Target['session']> | null {
  try {
    return target.session(technique);
  } catch {
    return null;
  }
}

function isSound({ modelToWorld, frames }: RecordedStroke): boolean {
  return modelToWorld instanceof Float64Array && modelToWorld.length === 8 && modelToWorld.every(Number.isFinite) && frames instanceof Float64Array && frames.length % kFrameSize === 0;
}

export function frameCount(stroke: Pick<RecordedStroke, 'frames'>): number {
  return stroke.frames.length / kFrameSize;
}

function soundStyle(given: unknown): InkStyle | null {
  const style = given as Partial<InkStyle> | null | undefined;
  const isSound = style && /^#[0-9a-f]{6}$/i.test(String(style.color)) && Number.isFinite(style.radius_m) && style.radius_m! > 0 && Number.isFinite(style.offset_m);
  return isSound ? { color: style.color!, radius_m: style.radius_m!, offset_m: style.offset_m! } : null;
}

/** Ranges in order and apart, each of whole numbers from 0; what lies beyond the last frame is cut. */
function soundRanges(given: unknown, stroke: RecordedStroke, curve: Curve): Range[] | null {
  if (!Array.isArray(given) || given.length === 0) return null;
  const last = Math.max(frameCount(stroke) - 1, curve.frames.at(-1) ?? 0);
  const ranges: Range[] = [];
  let after = -1;
  for (const range of given as unknown[]) {
    if (!Array.isArray(range) || range.length !== 2) return null;
    const [from, to] = range as unknown[];
    if (!Number.isInteger(from) || !Number.isInteger(to) || (from as number) <= after || (to as number) < (from as number)) return null;
    after = Math.min(to as number, last);
    if ((from as number) <= last) ranges.push([from as number, after]);
  }
  return ranges.length > 0 ? ranges : null;
}

/** Names the first of them. */
function few(ids: readonly string[], noun: string): string {
  const named = ids.slice(0, 3).join(', ');
  return `${ids.length} ${noun}${ids.length === 1 ? '' : 's'} (${named}${ids.length > 3 ? ', …' : ''})`;
}
