import { eraseCurve, erasePart } from '../drawing/erase';
import { kLeastEraser_m, kMostEraser_m } from '../studio/settings';
import type { Studio } from '../studio/studio';
import type { PenSample, Tool } from './tool';

/** What both erasers have in common. label: of their step in the history. */
function eraser(row: Pick<Tool, 'name' | 'title' | 'short' | 'key' | 'icon' | 'hint'>, label: string, erase: typeof erasePart): Tool {
  const rub = (studio: Studio, sample: PenSample): void => {
    const hit = sample.hit();
    if (!hit) return;
    const [x, y, z] = hit.position, radius = studio.settings.eraser_m / studio.state.now.modelToWorld[7]!;
    studio.edit((drawing) => erase(drawing, x!, y!, z!, radius, studio.settings.mirror !== null));
  };
  return {
    ...row,
    samples: 'surface',
    cursor: { over: 'crosshair', pressed: 'none' },
    size: {
      title: 'Size of the eraser', least_m: kLeastEraser_m, most_m: kMostEraser_m,
      get: ({ eraser_m }) => eraser_m,
      set: (_, eraser_m) => ({ eraser_m }),
    },
    options: [],
    inks: false,
    otherEnd: null,
    takes: [],
    color: () => null,
    ring_m: ({ eraser_m }) => eraser_m,
    caption: () => row.short,
    press(studio, sample) {
      studio.beginEdit(label);
      rub(studio, sample);
      return {
        move: (next) => rub(studio, next),
        release: () => studio.endEdit(),
        cancel: () => studio.cancelEdit(),
      };
    },
  };
}

export const kEraseCurve = eraser({
  name: 'erase curve', title: 'Erase whole curves', short: 'Erase curves', key: 'e',
  icon: 'M3 17h14M8.5 14 3.8 9.3a1 1 0 0 1 0-1.4l5.1-5.1a1 1 0 0 1 1.4 0l5.9 5.9a1 1 0 0 1 0 1.4L12.3 14zM6.5 5.5l7 7',
  hint: { page: 'Press on a curve to erase it.', headset: 'Pull the trigger on a curve to erase it' },
}, 'erasing', eraseCurve);

export const kErasePart = eraser({
  name: 'erase part', title: 'Erase parts of curves', short: 'Erase parts', key: 'r',
  icon: 'M2.5 15c2-5 3.5-6.5 5-5M12.5 12c2 1 3.5-2 5-7M9.2 11.8l2-2M9.5 8.5l3 3',
  hint: { page: 'Press on ink and rub it off.', headset: 'Pull the trigger on ink to rub it off' },
}, 'erasing a part', erasePart);
