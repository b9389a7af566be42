import type { InkStyle } from './drawing/document';
import type { MirrorAxis } from './drawing/symmetry';
import type { PenPlace } from './input/screen_frame';

export type Tool = 'draw' | 'erase curve' | 'erase part';
export type Theme = 'system' | 'light' | 'dark';
export type Hand = 'left' | 'right';

export interface Settings {
  technique: string;
  tool: Tool;
  style: InkStyle;
  penPlace: PenPlace;
  /** Radius of the eraser in the world. */
  eraser_m: number;
  mirror: MirrorAxis | null;
  /** The technique that the right half shows; null: no second half. */
  compare: string | null;
  hand: Hand;
  theme: Theme;
  hintSeen: boolean;
}

export const kInks = [
  { name: 'Ink', color: '#22252b' },
  { name: 'Vermilion', color: '#d6401f' },
  { name: 'Orange', color: '#f0932b' },
  { name: 'Yellow', color: '#f2c230' },
  { name: 'Green', color: '#1f9d6b' },
  { name: 'Blue', color: '#2469d6' },
  { name: 'Violet', color: '#7d4fc4' },
  { name: 'White', color: '#fbfaf7' },
] as const;

export const kLeastRadius_m = 0.0005;
export const kMostRadius_m = 0.012;
export const kLeastEraser_m = 0.002;
export const kMostEraser_m = 0.06;

export const kDefaults: Settings = {
  technique: 'mimicry-live',
  tool: 'draw',
  style: { color: kInks[1].color, radius_m: 0.003, offset_m: 0 },
  penPlace: 'under the pointer',
  eraser_m: 0.009,
  mirror: null,
  compare: null,
  hand: 'right',
  theme: 'system',
  hintSeen: false,
};

const kKey = 'mimicry-studio-settings';

/** Where settings are kept; where the browser forbids it, nowhere. */
export function settingsStorage(): Pick<Storage, 'getItem' | 'setItem'> {
  try {
    return localStorage;
  } catch {
    return { getItem: () => null, setItem: () => undefined };
  }
}

/** What was chosen last time; defaults for what is missing or of another kind. */
export function readSettings(storage: Pick<Storage, 'getItem'>): Settings {
  let stored: unknown = null;
  try {
    stored = JSON.parse(storage.getItem(kKey) ?? 'null');
  } catch {
    // Not ours, or storage is off.
  }
  const settings = structuredClone(kDefaults);
  if (typeof stored !== 'object' || stored === null) return settings;
  const from = stored as Record<string, unknown>;
  const pick = <K extends keyof Settings>(key: K, ok: (value: unknown) => boolean): void => {
    if (ok(from[key])) settings[key] = from[key] as Settings[K];
  };
  pick('technique', (v) => typeof v === 'string');
  pick('tool', (v) => v === 'draw' || v === 'erase curve' || v === 'erase part');
  pick('penPlace', (v) => v === 'under the pointer' || v === 'on a plane');
  pick('eraser_m', (v) => typeof v === 'number' && v >= kLeastEraser_m && v <= kMostEraser_m);
  pick('mirror', (v) => v === null || v === 'x' || v === 'y' || v === 'z');
  pick('hand', (v) => v === 'left' || v === 'right');
  pick('theme', (v) => v === 'system' || v === 'light' || v === 'dark');
  pick('hintSeen', (v) => typeof v === 'boolean');
  const style = from['style'] as Partial<InkStyle> | undefined;
  if (style && /^#[0-9a-f]{6}$/.test(String(style.color)) && Number.isFinite(style.radius_m) && Number.isFinite(style.offset_m)) {
    settings.style = { color: style.color!, radius_m: clampRadius(style.radius_m!), offset_m: style.offset_m! };
  }
  return settings;
}

export function writeSettings(storage: Pick<Storage, 'setItem'>, settings: Settings): void {
  try {
    storage.setItem(kKey, JSON.stringify({ ...settings, compare: null, tool: 'draw' }));
  } catch {
    // Private windows and full disks: the choice lasts until the page is closed.
  }
}

/** The settings after what the tool in use writes or erases with became `factor` times as large. */
export function resized({ tool, style, eraser_m }: Settings, factor: number): Partial<Settings> {
  if (tool === 'draw') return { style: { ...style, radius_m: clampRadius(style.radius_m * factor) } };
  return { eraser_m: Math.min(kMostEraser_m, Math.max(kLeastEraser_m, eraser_m * factor)) };
}

export function clampRadius(radius_m: number): number {
  return Math.min(kMostRadius_m, Math.max(kLeastRadius_m, radius_m));
}
