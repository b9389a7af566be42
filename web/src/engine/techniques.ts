import type { Core, TechniqueInfo } from './core';

/** Of a new page; it works on every model. */
export const kFirstTechnique = 'mimicry-live';

/** The core's techniques in the order in which they are offered. */
export function techniquesOf(core: Core): TechniqueInfo[] {
  return [...core.techniques].sort((a, b) => a.rank - b.rank);
}

/** What to say where a stroke on a screen left little ink. */
export function littleInk({ title, screenNote }: TechniqueInfo): string {
  return `${title} drew little of this stroke: ${screenNote || 'it did not follow this motion'}. Draw in a headset, or choose another technique.`;
}
