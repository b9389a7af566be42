import type { Core, Curve, RecordedStroke, Target } from '../engine/core';
import { widthOfPressure, type Drawing, type DrawnCurve, type InkStyle } from './document';
import { kFrameSize, kPressure } from './frame';
import { recover, type Part, type Recovered } from './recover';
import type { DrawingContent, StoredModel } from './stored';

interface DrawingFile extends DrawingContent {
  format: 'mimicry-drawing';
  version: 1;
  name?: string;
  model: { name: string; shape?: string; mesh?: string; turn?: readonly number[] }; // mesh: base64 of the file
}

export const kDrawingEnding = '.mimicry-drawing';

const text = new TextDecoder();
const bytes = new TextEncoder();

/** The drawing with its model, strokes and curves in one file (docs/formats.md). */
export function writeDrawing(core: Core, target: Target, model: StoredModel, drawing: Drawing, name?: string): Uint8Array {
  const { source, turn } = model;
  const file: DrawingFile = {
    format: 'mimicry-drawing', version: 1, ...(name ? { name } : {}),
    model: { ...('shape' in source ? { name: target.name, shape: source.shape } : { name: source.file, mesh: toBase64(source.bytes) }), ...(turn ? { turn } : {}) },
    ...drawingContent(core, target, drawing),
  };
  return bytes.encode(JSON.stringify(file));
}

/** The drawing as plain data that outlives the target. */
function drawingContent(core: Core, target: Target, drawing: Drawing): DrawingContent {
  return {
    entries: drawing.map(({ id, mirror, style, kept }) => ({ id, mirror, style, kept })),
    strokes: JSON.parse(text.decode(core.writeStrokes(drawing.map((drawn) => drawn.stroke)))),
    curves: JSON.parse(text.decode(target.writeCurves(drawing.map((drawn) => drawn.curve), 'json', new Uint8Array(3 * drawing.length), 1))),
  };
}

/** What a JSON file is: the `format` that it names first. Empty: none. */
export function formatOf(content: Uint8Array): string {
  return /^\s*\{\s*"format"\s*:\s*"([^"]*)"/.exec(text.decode(content.subarray(0, 256)))?.[1] ?? '';
}

/** Whether a file's content is a drawing. */
export function isDrawing(content: Uint8Array): boolean {
  return text.decode(content.subarray(0, 64)).includes('"mimicry-drawing"');
}

export function readDrawingModel(content: Uint8Array, name: string): { model: StoredModel; title: string | null; rest: DrawingContent } {
  let file: DrawingFile;
  try {
    file = JSON.parse(text.decode(content)) as DrawingFile;
  } catch {
    throw new Error(`${name}: the file is cut off or damaged; use another copy`);
  }
  if (file.format !== 'mimicry-drawing') throw new Error(`${name}: not a mimicry drawing`);
  if (file.version !== 1) throw new Error(`${name}: a drawing of version ${String(file.version)}; this page reads version 1, reload it to get a newer one`);
  const damaged = new Error(`${name}: the file is cut off or damaged; use another copy`);
  if (!isObject(file.strokes) || !isObject(file.curves) || !Array.isArray(file.entries)) throw damaged;
  const title = typeof file.name === 'string' && file.name.trim() ? file.name.trim() : null;
  const turn = soundTurn(file.model?.turn);
  if (file.model?.shape) return { model: { name: String(file.model.shape), source: { shape: String(file.model.shape) }, ...(turn ? { turn } : {}) }, title, rest: file };
  if (!file.model?.mesh) throw new Error(`${name}: the drawing does not say which model it is on; use another copy`);
  try {
    const file64 = fromBase64(file.model.mesh);
    return { model: { name: String(file.model.name), source: { file: String(file.model.name), bytes: file64 }, ...(turn ? { turn } : {}) }, title, rest: file };
  } catch {
    throw damaged;
  }
}

/** A unit quaternion, or nothing. */
export function soundTurn(given: unknown): number[] | null {
  if (!Array.isArray(given) || given.length !== 4 || !given.every((x) => Number.isFinite(x))) return null;
  const length = Math.hypot(...(given as number[]));
  return Math.abs(length - 1) < 1e-3 ? (given as number[]).map((x) => x / length) : null;
}

/**
 * The drawing on the target, which is the file's model. What is damaged is told and left out; throws where nothing is left.
 */
export function readDrawing(core: Core, target: Target, file: DrawingContent, name: string): Recovered {
  const { strokes, reasons } = readStrokes(core, file.strokes, name);
  const curves = readCurves(target, file.curves, name);
  const parts = file.entries.map((entry, i): Part => {
    const id = typeof entry?.id === 'string' ? entry.id : `curve ${i + 1}`;
    return { id, mirror: entry?.mirror, style: entry?.style, kept: entry?.kept, stroke: strokes.get(id) ?? null, curve: () => curves.of(id), technique: curves.techniqueOf(id) };
  });
  const recovered = recover(target, parts, name, reasons);
  curves.dispose(new Set(recovered.drawing.map((drawn) => drawn.curve)));
  if (recovered.drawing.length === 0 && parts.length > 0) throw new Error(`${name}: none of its ${parts.length} strokes can be read: they are damaged; use another copy`);
  return recovered;
}

function readStrokes(core: Core, file: unknown, name: string): { strokes: Map<string, RecordedStroke>; reasons: string[] } {
  const reasons: string[] = [];
  let list: RecordedStroke[] = [];
  if ((file as { strokes?: unknown[] }).strokes?.length !== 0) {
    try {
      list = core.readStrokes(bytes.encode(JSON.stringify(file)), name, (reason) => reasons.push(reason));
    } catch (error) {
      reasons.push(error instanceof Error ? error.message : String(error));
    }
  }
  return { strokes: new Map(list.map((stroke) => [stroke.id, stroke])), reasons };
}

interface CurvesFile {
  curves?: { stroke?: string; technique?: string }[];
}

/** The curves of a file by their strokes: all at once, or one by one where one is damaged. */
function readCurves(target: Target, file: unknown, name: string): { of(id: string): Curve; techniqueOf(id: string): string | undefined; dispose(but: ReadonlySet<Curve>): void } {
  const { curves } = file as CurvesFile;
  const one = new Map((Array.isArray(curves) ? curves : []).map((curve) => [curve?.stroke, curve]));
  const read = (content: unknown): Curve[] => target.readCurves(bytes.encode(JSON.stringify(content)), name);
  let all = new Map<string, Curve>();
  try {
    all = new Map(read(file).map((curve) => [curve.stroke, curve]));
  } catch {
    // One by one.
  }
  return {
    of(id) {
      const known = all.get(id) ?? read({ ...(file as object), curves: [one.get(id)] })[0]!;
      all.set(id, known);
      return known;
    },
    techniqueOf: (id) => one.get(id)?.technique,
    dispose(but) {
      for (const curve of all.values()) if (!but.has(curve)) curve.dispose();
    },
  };
}

function isObject(value: unknown): boolean {
  return typeof value === 'object' && value !== null;
}

/** The curves that are left after erasing, for files, as thick and as high as the ink: parts are curves of their own. The caller disposes of them. */
export function keptCurves(drawing: Drawing): { curves: Curve[]; styles: InkStyle[] } {
  const curves: Curve[] = [], styles: InkStyle[] = [];
  for (const drawn of drawing) {
    const { frames } = drawn.curve;
    drawn.kept.forEach(([first, last], part) => {
      let from = 0;
      while (from < frames.length && frames[from]! < first) from += 1;
      let to = frames.length;
      while (to > from && frames[to - 1]! > last) to -= 1;
      if (to <= from) return;
      let curve = drawn.curve.slice(from, to);
      const replace = (by: Curve): void => {
        curve.dispose();
        curve = by;
      };
      replace(curve.withRadii(inkRadii(drawn, frames.subarray(from, to))));
      if (drawn.style.offset_m !== 0) replace(curve.withLift(drawn.style.offset_m / drawn.stroke.modelToWorld[7]!));
      if (drawn.kept.length > 1) replace(curve.withStroke(`${drawn.id}.${part + 1}`));
      curves.push(curve);
      styles.push(drawn.style);
    });
  }
  return { curves, styles };
}

/** Of the ink at these frames, model units: by the pen's pressure where there is one. */
function inkRadii({ stroke, style }: DrawnCurve, frames: Int32Array): Float64Array {
  const radius = style.radius_m / stroke.modelToWorld[7]!;
  return Float64Array.from(frames, (frame) => radius * widthOfPressure(stroke.frames[frame * kFrameSize + kPressure] ?? -1));
}

export function colorBytes(styles: readonly InkStyle[]): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(3 * styles.length);
  styles.forEach(({ color }, i) => {
    for (let k = 0; k < 3; k += 1) out[3 * i + k] = Number.parseInt(color.slice(1 + 2 * k, 3 + 2 * k), 16);
  });
  return out;
}

function toBase64(content: Uint8Array): string {
  let out = '';
  for (let at = 0; at < content.length; at += 0x6000) out += btoa(String.fromCharCode(...content.subarray(at, at + 0x6000)));
  return out;
}

function fromBase64(text64: string): Uint8Array {
  const binary = atob(text64);
  const out = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i += 1) out[i] = binary.charCodeAt(i);
  return out;
}
