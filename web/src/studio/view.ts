import type { Drawing, DrawnCurve, InkStyle, Width } from '../drawing/document';
import type { Curve, Ink, Target } from '../engine/core';
import type { LoadedModel } from '../engine/loaded_model';

/** What shows the studio: three.js, or nothing in tests. The live calls come once a frame. */
export interface StudioView {
  showModel(model: LoadedModel, target: Target): void;
  place(modelToWorld: Float64Array): void;
  beginInk(copy: number, style: InkStyle, modelToWorld: Float64Array, width: Width): void;
  growInk(copy: number, ink: Ink): void;
  /** The live ink of a copy becomes that of a finished curve. */
  keepInk(copy: number, id: string): void;
  dropInk(): void;
  showDrawing(drawing: Drawing): void;
  showReplay(curve: Curve | null, drawn: DrawnCurve | null): void;
}
