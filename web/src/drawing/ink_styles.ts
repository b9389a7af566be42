import type { InkStyle } from './document';

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

export const kFirstStyle: InkStyle = { color: kInks[1].color, radius_m: 0.003, offset_m: 0 };

export function clampRadius(radius_m: number): number {
  return Math.min(kMostRadius_m, Math.max(kLeastRadius_m, radius_m));
}
