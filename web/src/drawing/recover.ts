import type { Curve, RecordedStroke, Target } from '../engine/core';
import { kFirstTechnique } from '../engine/techniques';
import type { DrawnCurve, InkStyle } from './document';
import { kFrameSize } from './frame';
import { kFirstStyle, kInks } from './ink_styles';
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
  const drawing: DrawnCurve[] = [], missing: string[] = [], redrawn: string[] = [], restyled: string[] = [], resized: string[] = [];
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
    const given = soundStyle(part.style), style = given && shownStyle(given, stroke, target), kept = soundRanges(part.kept, stroke, curve);
    const mirror = part.mirror === 'x' || part.mirror === 'y' || part.mirror === 'z' ? part.mirror as MirrorAxis : null;
    if (!style || !kept) restyled.push(id);
    if (style !== given) resized.push(id);
    drawing.push({ id, stroke, mirror, style: style ?? { ...kFirstStyle, color: kInks[0].color }, kept: kept ?? [[0, frameCount(stroke) - 1]], curve });
  }
  const remarks = reasons.map((reason) => `Left out: ${reason}`);
  if (missing.length > reasons.length) remarks.push(`${name}: ${few(missing, 'stroke')} ${missing.length === 1 ? 'is' : 'are'} damaged and left out; the others are here.`);
  if (redrawn.length > 0) remarks.push(`${name}: the ${few(redrawn, 'curve')} could not be read and ${redrawn.length === 1 ? 'was' : 'were'} drawn anew from the recorded strokes.`);
  if (restyled.length > 0) remarks.push(`${name}: colour, size or erased parts of ${few(restyled, 'curve')} could not be read; ${restyled.length === 1 ? 'it is' : 'they are'} shown whole.`);
  if (resized.length > 0) remarks.push(`${name}: the ink of ${few(resized, 'curve')} has a thickness or a height that cannot be shown on this model; ${resized.length === 1 ? 'it is' : 'they are'} shown with the usual one. Thickness must be more than 0, and both at most half of the model’s diagonal.`);
  return { drawing, remarks };
}

/** A stroke from first frame to last through a technique; the studio's first one where that is not to be had. */
function redraw(target: Target, technique: string | undefined, stroke: RecordedStroke): Curve {
  const session = sessionOf(target, technique ?? kFirstTechnique) ?? target.session(kFirstTechnique);
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
  return modelToWorld instanceof Float64Array && modelToWorld.length === 8 && modelToWorld.every(Number.isFinite) && modelToWorld[7]! > 0 && frames instanceof Float64Array && frames.length % kFrameSize === 0;
}

export function frameCount(stroke: Pick<RecordedStroke, 'frames'>): number {
  return stroke.frames.length / kFrameSize;
}

/** Of the right kinds; the sizes may be any. */
function soundStyle(given: unknown): InkStyle | null {
  const style = given as Partial<InkStyle> | null | undefined;
  if (!style || !/^#[0-9a-f]{6}$/i.test(String(style.color))) return null;
  const size = (value: unknown): number => (typeof value === 'number' ? value : NaN);
  return { color: style.color!, radius_m: size(style.radius_m), offset_m: size(style.offset_m) };
}

/** Ink is at most so thick, and lies at most so high above the surface, as a part of the model's diagonal. */
const kMostInk = 0.5;
/** And where a hand's usual thickness is too much. */
const kUsualInk = 0.01;

/** The same where its sizes can be shown: ink as thick as the model hides all of it. Else of the usual size. */
function shownStyle(style: InkStyle, { modelToWorld }: RecordedStroke, target: Target): InkStyle {
  const diagonal_m = target.diagonal * modelToWorld[7]!;
  const isThickness = style.radius_m > 0 && style.radius_m <= kMostInk * diagonal_m;
  const isHeight = Math.abs(style.offset_m) <= kMostInk * diagonal_m;
  if (isThickness && isHeight) return style;
  return { ...style, radius_m: isThickness ? style.radius_m : Math.min(kFirstStyle.radius_m, kUsualInk * diagonal_m), offset_m: isHeight ? style.offset_m : 0 };
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
