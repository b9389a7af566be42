import type { Studio } from '../studio/studio';
import type { Messages } from './messages';

/** Says what a stroke did, for those who do not see it. */
export function speakStrokes(studio: Studio, messages: Messages): void {
  let before = studio.state.now.history.drawing;
  studio.state.watch((now, then) => {
    if (now.drawing && !then.drawing) {
      before = now.history.drawing;
      messages.say('Pen down.');
    }
    if (now.drawing || !then.drawing) return;
    const added = now.history.drawing.filter((drawn) => !before.includes(drawn));
    const [curve] = added;
    if (!curve) return messages.say('Pen up: the stroke met nothing.');
    const length_cm = 100 * curve.curve.length * curve.stroke.modelToWorld[7]!;
    messages.say(`Stroke ${now.history.drawing.filter((drawn) => drawn.mirror === null).length}: ${length_cm.toFixed(length_cm < 10 ? 1 : 0)} centimetres with ${studio.techniqueTitle(curve.curve.technique)}${added.length > 1 ? ', and its mirror image' : ''}.`);
  });
}
