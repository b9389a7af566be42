import type { Curve } from '../engine/core';
import type { Range } from './kept';
import type { MirrorAxis } from './symmetry';

export interface InkStyle {
  color: string; // #rrggbb
  radius_m: number; // at the scale at which it was drawn
  offset_m: number; // above the surface
}

/** What the devices did, world; `frames` holds 17 numbers a frame. */
export interface Stroke {
  id: string;
  target: string;
  modelToWorld: Float64Array;
  frames: Float64Array;
}

/** A curve on the target. Never changed in place: edits make a new one with the same id. */
export interface DrawnCurve {
  id: string;
  stroke: Stroke;
  mirror: MirrorAxis | null; // a mirrored copy, and in which plane
  style: InkStyle;
  kept: readonly Range[]; // numbers of the stroke's frames that were not erased
  curve: Curve;
}

export type Drawing = readonly DrawnCurve[];

/** A drawing with its past and future; `labels` say what led to each. */
export interface History {
  past: readonly Step[];
  drawing: Drawing;
  future: readonly Step[];
}

interface Step {
  drawing: Drawing;
  label: string;
}

/** Steps that can be undone; memory is bounded. */
const kMostSteps = 500;

export const kEmptyHistory: History = { past: [], drawing: [], future: [] };

/** The drawing becomes `drawing`; nothing happens where it is the same. */
export function commit(history: History, drawing: Drawing, label: string): History {
  if (drawing === history.drawing) return history;
  const past = [...history.past, { drawing: history.drawing, label }];
  return { past: past.slice(-kMostSteps), drawing, future: [] };
}

export function undo(history: History): History {
  const step = history.past.at(-1);
  if (!step) return history;
  return {
    past: history.past.slice(0, -1),
    drawing: step.drawing,
    future: [{ drawing: history.drawing, label: step.label }, ...history.future],
  };
}

export function redo(history: History): History {
  const step = history.future[0];
  if (!step) return history;
  return {
    past: [...history.past, { drawing: history.drawing, label: step.label }],
    drawing: step.drawing,
    future: history.future.slice(1),
  };
}

/** Curves that some state of the history shows. */
export function reachable(history: History): Set<Curve> {
  const all = new Set<Curve>();
  for (const drawing of [history.drawing, ...history.past.map((s) => s.drawing), ...history.future.map((s) => s.drawing)]) {
    for (const drawn of drawing) all.add(drawn.curve);
  }
  return all;
}

/** The last stroke's curves: the drawn one and its mirrored copies. */
export function lastStroke(drawing: Drawing): Drawing {
  const last = drawing.at(-1);
  if (!last) return [];
  const root = rootId(last.id);
  return drawing.filter((drawn) => rootId(drawn.id) === root);
}

/** Ids are `<stroke>` and, of mirrored copies, `<stroke>/<axis>`. */
export function rootId(id: string): string {
  return id.split('/')[0]!;
}

/** Writes a frame's width, a factor of the radius, into out[0]: a number that is returned would be an object in every frame. */
export type Width = (frame: number, out: Float64Array) => void;

/** How wide the ink of a frame is, as a factor of the radius. */
export function widthOfPressure(pressure: number): number {
  return pressure < 0 ? 1 : 0.35 + 1.3 * pressure;
}
