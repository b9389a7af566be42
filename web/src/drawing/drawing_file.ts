import type { Core, Curve, RecordedStroke, Target } from '../engine/core';
import type { ModelSource } from '../studio';
import { widthOfPressure, type Drawing, type DrawnCurve, type InkStyle } from './document';
import { kFrameSize, kPressure } from './frame';
import type { Range } from './kept';
import type { MirrorAxis } from './symmetry';

/** What a drawing file says of a curve; strokes and curves stand in the file's own two parts. */
interface Entry {
  id: string;
  mirror: MirrorAxis | null;
  style: InkStyle;
  kept: readonly Range[];
}

/** A drawing without its model. */
export interface DrawingContent {
  entries: Entry[];
  strokes: unknown; // mimicry-strokes
  curves: unknown; // mimicry-curves
}

interface DrawingFile extends DrawingContent {
  format: 'mimicry-drawing';
  version: 1;
  model: { name: string; shape?: string; mesh?: string }; // mesh: base64 of the file
}

export const kDrawingEnding = '.mimicry-drawing';

const text = new TextDecoder();
const bytes = new TextEncoder();

/** The drawing with its model, strokes and curves in one file (docs/formats.md). */
export function writeDrawing(core: Core, target: Target, source: ModelSource, drawing: Drawing): Uint8Array {
  const file: DrawingFile = {
    format: 'mimicry-drawing', version: 1,
    model: 'shape' in source ? { name: target.name, shape: source.shape } : { name: source.file, mesh: toBase64(source.bytes) },
    ...drawingContent(core, target, drawing),
  };
  return bytes.encode(JSON.stringify(file));
}

/** The drawing as plain data that outlives the target. */
export function drawingContent(core: Core, target: Target, drawing: Drawing): DrawingContent {
  return {
    entries: drawing.map(({ id, mirror, style, kept }) => ({ id, mirror, style, kept })),
    strokes: JSON.parse(text.decode(core.writeStrokes(drawing.map((drawn) => drawn.stroke)))),
    curves: JSON.parse(text.decode(target.writeCurves(drawing.map((drawn) => drawn.curve), 'json', new Uint8Array(3 * drawing.length), 1))),
  };
}

/** Whether a file's content is a drawing. */
export function isDrawing(content: Uint8Array): boolean {
  return text.decode(content.subarray(0, 64)).includes('"mimicry-drawing"');
}

export function readDrawingModel(content: Uint8Array, name: string): { source: ModelSource; rest: DrawingFile } {
  let file: DrawingFile;
  try {
    file = JSON.parse(text.decode(content)) as DrawingFile;
  } catch {
    throw new Error(`${name}: the file is cut off or damaged; use another copy`);
  }
  if (file.format !== 'mimicry-drawing') throw new Error(`${name}: not a mimicry drawing`);
  if (file.version !== 1) throw new Error(`${name}: a drawing of version ${String(file.version)}; this page reads version 1, reload it to get a newer one`);
  const damaged = new Error(`${name}: the file is cut off or damaged; use another copy`);
  if (!file.strokes || !file.curves || !Array.isArray(file.entries)) throw damaged;
  if (file.model?.shape) return { source: { shape: file.model.shape }, rest: file };
  if (!file.model?.mesh) throw new Error(`${name}: the drawing does not say which model it is on; use another copy`);
  try {
    return { source: { file: String(file.model.name), bytes: fromBase64(file.model.mesh) }, rest: file };
  } catch {
    throw damaged;
  }
}

/** The drawing on the target, which is the file's model. */
export function readDrawing(core: Core, target: Target, file: DrawingContent, name: string): Drawing {
  const strokes = core.readStrokes(bytes.encode(JSON.stringify(file.strokes)), name);
  const curves = target.readCurves(bytes.encode(JSON.stringify(file.curves)), name);
  return assemble(file.entries, strokes, curves, name);
}

function assemble(entries: readonly Entry[], strokes: readonly RecordedStroke[], curves: readonly Curve[], name: string): Drawing {
  if (!Array.isArray(entries) || entries.length !== strokes.length || entries.length !== curves.length) {
    for (const curve of curves) curve.dispose();
    throw new Error(`${name}: the file has ${curves.length} curves and ${strokes.length} strokes but describes ${entries?.length ?? 0}; use another copy`);
  }
  return entries.map((entry, i): DrawnCurve => ({ ...entry, stroke: strokes[i]!, curve: curves[i]! }));
}

/** The curves that are left after erasing, for files, as thick as the ink: parts are curves of their own. The caller disposes of them. */
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

export function frameCount(stroke: Pick<RecordedStroke, 'frames'>): number {
  return stroke.frames.length / kFrameSize;
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
