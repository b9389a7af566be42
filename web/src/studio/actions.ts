import type { CurveFormat } from '../engine/core';

/** What the interface can ask for. */
export interface Actions {
  undo(): void;
  redo(): void;
  clear(): void;
  frameModel(): void;
  /** By 90 degrees: around the axis from left to right, or toward the viewer. */
  turnModel(axis: 'x' | 'z'): void;
  openFiles(files: Iterable<File>): void;
  chooseFiles(): void;
  openShape(name: string): void;
  showDrawings(): void;
  saveDrawing(): void;
  exportCurves(format: CurveFormat): void;
  exportStrokes(): void;
  bake(): void;
  redrawLast(): void;
  /** For those who do not see it. */
  say(sentence: string): void;
  enterXr(mode: 'immersive-vr' | 'immersive-ar'): void;
}
