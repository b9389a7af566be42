import { makeFrame } from '../../src/drawing/frame';
import type { Studio } from '../../src/studio/studio';
import type { PenSample } from '../../src/tools/tool';

/** A pen at the place of the surface that is nearest to a point of model space. */
export function penAt(studio: Studio, [x, y, z]: readonly number[]): PenSample {
  return {
    frame: makeFrame(), device: 'mouse', end: 'tip', modifiers: { shift: false, alt: false, control: false },
    hit: () => studio.target!.closestPoint(x!, y!, z!),
  };
}
