/** A sentence a technique, for someone who has never read of it. */
export const kTechniqueText: Record<string, { title: string; sentence: string; onScreens?: string }> = {
  'mimicry-live': { title: 'Mimicry live', sentence: 'Follows your hand smoothly, wherever you hold it. Works at once.' },
  mimicry: { title: 'Mimicry', sentence: 'Follows your hand through smooth closest points.' },
  'mimicry-planar': { title: 'Mimicry planar', sentence: 'Follows your hand within the plane of your last two motions. Made for hands in space: on a screen it may draw little.', onScreens: 'it needs a hand that moves in space, and a pen on a screen hardly does' },
  'mimicry-offset': { title: 'Mimicry offset', sentence: 'Follows your hand but for motion toward the surface, seen from the pen.' },
  'mimicry-parallel': { title: 'Mimicry parallel', sentence: 'Follows your hand but for motion toward the surface, seen from the ink.' },
  'anchored-closest': { title: 'Anchored closest', sentence: 'Carries the motion of your hand to the ink, then takes the closest point.' },
  'anchored-ray-plane': { title: 'Anchored ray, plane', sentence: 'Moves with your hand, then looks along a ray square to the motion.' },
  'anchored-ray-transport': { title: 'Anchored ray, transport', sentence: 'Moves with your hand, and the ray to the surface turns with it.' },
  spraycan: { title: 'Spraycan', sentence: 'Sprays along the direction in which you point, like a can of paint.' },
  occlude: { title: 'Occlude', sentence: 'Draws on what the pen hides from your eye.' },
  'head-centric': { title: 'Head-centric', sentence: 'Draws where your head looks, whatever the hand does. On a screen you look where the pointer is.', onScreens: 'it needs a head that moves' },
  snap: { title: 'Snap', sentence: 'Draws at the closest point of the model to the pen.' },
  'snap-smooth': { title: 'Snap smooth', sentence: 'Draws at the smooth closest point to the pen: no jumps at ridges.' },
};

/** What to say where a stroke on a screen left little ink. */
export function littleInk(technique: string): string {
  const text = kTechniqueText[technique];
  const why = text?.onScreens ?? 'it did not follow this motion';
  return `${text?.title ?? technique} drew little of this stroke: ${why}. Draw in a headset, or choose another technique.`;
}

/** The order in which they are offered; what is not named follows. */
export const kTechniqueOrder = Object.keys(kTechniqueText);

/** The colours in which documents and pictures show the techniques. */
export const kTechniqueColors: Record<string, string> = {
  occlude: '#576aff', spraycan: '#d55e00', 'head-centric': '#7d6f3c', snap: '#caa2ff', 'snap-smooth': '#442567',
  'anchored-closest': '#e69f00', mimicry: '#0072b2', 'mimicry-planar': '#0000f9', 'mimicry-offset': '#00788d',
  'mimicry-parallel': '#165e3c', 'anchored-ray-plane': '#95c86c', 'anchored-ray-transport': '#7a2800', 'mimicry-live': '#009e73',
};
