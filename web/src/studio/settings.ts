import type { InkStyle } from '../drawing/document';
import { clampRadius, kFirstStyle } from '../drawing/ink_styles';
import type { MirrorAxis } from '../drawing/symmetry';
import { kFirstTechnique } from '../engine/techniques';

export type Theme = 'system' | 'light' | 'dark';
export type Hand = 'left' | 'right';
/** Where the pen is while it is drawn with on a screen. */
export type PenPlace = 'under the pointer' | 'on a plane';

export type ToolValue = number | string | boolean;

export interface Settings {
  technique: string;
  /** The name of the tool in use (tools/tools.ts); not kept. */
  tool: string;
  /** What tools have of their own, by their names. */
  ofTools: Readonly<Record<string, Readonly<Record<string, ToolValue>>>>;
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

export const kLeastEraser_m = 0.002;
export const kMostEraser_m = 0.06;

export const kDefaults: Settings = {
  technique: kFirstTechnique,
  tool: 'draw',
  ofTools: {},
  style: kFirstStyle,
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
  pick('ofTools', isOfTools);
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
    storage.setItem(kKey, JSON.stringify({ ...settings, compare: null, tool: kDefaults.tool }));
  } catch {
    // Private windows and full disks: the choice lasts until the page is closed.
  }
}

/** A setting that a tool has of its own, kept with the others; `fallback` where there is none of its kind. */
export function toolSetting<T extends ToolValue>({ ofTools }: Settings, tool: string, key: string, fallback: T): T {
  const value = ofTools[tool]?.[key];
  return typeof value === typeof fallback ? (value as T) : fallback;
}

export function withToolSetting({ ofTools }: Settings, tool: string, key: string, value: ToolValue): Pick<Settings, 'ofTools'> {
  return { ofTools: { ...ofTools, [tool]: { ...ofTools[tool], [key]: value } } };
}

function isOfTools(given: unknown): boolean {
  const isRecord = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value);
  const isValue = (value: unknown): boolean => typeof value === 'string' || typeof value === 'boolean' || Number.isFinite(value);
  return isRecord(given) && Object.values(given).every((own) => isRecord(own) && Object.values(own).every(isValue));
}
