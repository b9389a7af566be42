import type { ModelSource } from '../engine/loaded_model';
import type { InkStyle } from './document';
import type { Range } from './kept';
import type { MirrorAxis } from './symmetry';

/** A model as it is kept. */
export interface StoredModel {
  name: string;
  source: ModelSource;
  /** How the model was turned to stand upright: a unit quaternion x, y, z, w. */
  turn?: readonly number[];
}

/** What is kept of a curve beside its stroke and its points. */
export interface Entry {
  id: string;
  mirror: MirrorAxis | null;
  style: InkStyle;
  kept: readonly Range[];
}

/** An entry whose two parts lie on the shelf. */
export interface StoredEntry extends Entry {
  strokeKey: string;
  curveKey: string;
}

/** A drawing without its model, as a file has it. */
export interface DrawingContent {
  entries: Entry[];
  strokes: unknown; // mimicry-strokes
  curves: unknown; // mimicry-curves
}
