import { kLeastRadius_m, kMostRadius_m } from '../drawing/ink_styles';
import type { Settings } from '../studio/settings';
import { kErasePart } from './erase';
import type { Tool } from './tool';

/** Strokes, through the technique of the settings. */
export const kDraw: Tool = {
  name: 'draw', title: 'Draw', short: 'Draw', key: 'd',
  icon: 'M4 16c2.5-7 5-8.5 6.5-5s3 2.5 5.5-7',
  samples: 'space',
  cursor: { over: 'crosshair', pressed: 'none' },
  hint: { page: 'Press on the model and draw.', headset: 'Pull the trigger on the model to draw' },
  size: {
    title: 'Thickness of the ink', least_m: kLeastRadius_m, most_m: kMostRadius_m,
    get: ({ style }) => style.radius_m,
    set: ({ style }, radius_m) => ({ style: { ...style, radius_m } }),
  },
  options: [
    {
      kind: 'choice', title: 'Pen and pointer', label: 'Pen on the screen',
      note: 'On a plane: the pen floats in front of the model, as a hand does in space, and the wheel moves it nearer or farther. It shows how techniques differ; ink is then not under the pointer.',
      choices: [
        { value: 'under the pointer', text: 'Under it', title: 'Ink comes where the pointer is' },
        { value: 'on a plane', text: 'On a plane', title: 'The pen moves on a plane in front of the model, like a hand in space' },
      ],
      get: ({ penPlace }) => penPlace,
      set: (_, value) => ({ penPlace: value as Settings['penPlace'] }),
    },
    {
      kind: 'range', title: 'Ink height', label: 'Height of the ink above the surface, millimetres', least: -5, most: 20, step: 0.5,
      text: (mm) => `${mm.toFixed(1)} mm`,
      get: ({ style }) => 1000 * style.offset_m,
      set: ({ style }, mm) => ({ style: { ...style, offset_m: mm / 1000 } }),
    },
  ],
  inks: true,
  otherEnd: kErasePart,
  takes: [],
  color: ({ style }) => style.color,
  ring_m: ({ style }) => 2 * style.radius_m,
  caption: (studio) => studio.techniqueTitle(studio.settings.technique),
  press(studio, sample) {
    studio.beginStroke();
    if (!studio.isDrawing) return null;
    studio.addFrame(sample.frame);
    return {
      move: ({ frame }) => { studio.addFrame(frame); },
      release: () => studio.endStroke(),
      cancel: () => studio.cancelStroke(),
    };
  },
};
