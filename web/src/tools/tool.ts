import type { SurfaceHit } from '../engine/core';
import type { Settings } from '../studio/settings';
import type { Studio } from '../studio/studio';

export type PenDevice = 'mouse' | 'pen' | 'touch' | 'controller';
export type Modifier = 'shift' | 'alt' | 'control';

/** The pen at one moment, whatever device moves it. One object that the next moment writes over. */
export interface PenSample {
  /** Time, head, pen, trigger and pressure (drawing/frame.ts): world. */
  readonly frame: Float64Array;
  readonly device: PenDevice;
  /** Which end of a pen is down. */
  readonly end: 'tip' | 'eraser';
  /** Keys that are held; a controller has none. */
  readonly modifiers: Readonly<Record<Modifier, boolean>>;
  /**
   * The place that the pen is at: under the pointer; of a controller the nearest place within reach of its tip, else where it
   * points. Model space; null: it is beside the model. One query; the target's next query writes over what it returns.
   */
  hit(): SurfaceHit | null;
}

/** A tool from press to release; `release` or `cancel` is the last call. The studio may have ended what it does before (undo, another model). */
export interface ToolUse {
  move(sample: PenSample): void;
  /** Keeps what was done, as one step of the history. */
  release(): void;
  /** Takes back what was done since the press. */
  cancel(): void;
}

/** What the slider, [ ] and a thumbstick change: a radius in the world. */
export interface ToolSize {
  readonly title: string;
  readonly least_m: number;
  readonly most_m: number;
  get(settings: Settings): number;
  set(settings: Settings, radius_m: number): Partial<Settings>;
}

/** A control of the panel that opens beside the size, while the tool is in use. */
export type ToolOption = {
  readonly title: string;
  /** For those who do not see where it stands. */
  readonly label: string;
  /** A sentence below it. */
  readonly note?: string;
} & ({
  readonly kind: 'choice';
  readonly choices: readonly { readonly value: string; readonly text: string; readonly title: string }[];
  get(settings: Settings): string;
  set(settings: Settings, value: string): Partial<Settings>;
} | {
  readonly kind: 'range';
  readonly least: number;
  readonly most: number;
  readonly step: number;
  text(value: number): string;
  get(settings: Settings): number;
  set(settings: Settings, value: number): Partial<Settings>;
});

/**
 * What the pen does, and all that the page, the keyboard, pointers and a headset need to know of it: a tool is a file in this
 * folder and a row in tools.ts.
 */
export interface Tool {
  /** In settings and tests; never shown. */
  readonly name: string;
  /** Of its button. */
  readonly title: string;
  /** In lists and in the room, two words at most. */
  readonly short: string;
  /** A small letter. */
  readonly key: string;
  /** A path of lines, 20 by 20. */
  readonly icon: string;
  /**
   * space: each reading of the device is a sample, the pen may be off the surface (on its plane, in the air).
   * surface: samples lie on the model, without gaps however fast the pen moves: each few pixels, each radius of the tool.
   */
  readonly samples: 'space' | 'surface';
  /** CSS cursors: over the model, and while it is pressed. */
  readonly cursor: { readonly over: string; readonly pressed: string };
  /** What a newcomer does with it, a sentence each. */
  readonly hint: { readonly page: string; readonly headset: string };
  readonly size: ToolSize;
  readonly options: readonly ToolOption[];
  /** It writes in the chosen colour: choosing one keeps it in use. */
  readonly inks: boolean;
  /** What the eraser end of a pen uses instead; null: this tool, whose samples tell the end. */
  readonly otherEnd: Tool | null;
  /** Modifiers that are its own: held at a press they do not navigate. */
  readonly takes: readonly Modifier[];
  /** Of its marks, #rrggbb; null: as of what has no colour. */
  color(settings: Settings): string | null;
  /** Radius in the world of the ring that shows where it works. */
  ring_m(settings: Settings): number;
  /** What the card in the room calls it. */
  caption(studio: Studio): string;
  /**
   * The pen goes down: on a screen on the model, in a headset anywhere. null: not here; on a screen the pointer navigates then.
   * Symmetry is the studio's for strokes (`beginStroke`); others ask it for the plane (`symmetryPlane`).
   */
  press(studio: Studio, sample: PenSample): ToolUse | null;
}
