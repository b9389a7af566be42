import type { Tool } from '../tools/tool';
import type { Tools } from '../tools/tools';
import { h, icon, kIcons } from './dom';

interface Section {
  title: string;
  rows: readonly [string[], string][];
}

/** All gestures and keys; of the tools, theirs. */
export const helpSections = (tools: readonly Tool[]): readonly Section[] => [
  { title: 'Mouse', rows: [
    [['drag on the model'], 'draw, or erase'], [['drag beside it'], 'turn the view'], [['right-drag', 'Alt, Ctrl or Space + drag'], 'turn the view, anywhere'],
    [['middle-drag', 'Shift + drag'], 'move the view'], [['wheel'], 'zoom at the pointer; with the pen on a plane, while drawing: nearer or farther'],
  ] },
  { title: 'Fingers and pen', rows: [
    [['one finger on the model'], 'draw'], [['one finger beside it'], 'turn the view'], [['two fingers together'], 'turn the view, anywhere'], [['two fingers apart'], 'zoom, turn and move the picture'], [['three fingers'], 'move the view'], [['tap with two'], 'undo; with three: redo'],
    [['pen'], 'draws with its pressure; its other end erases; fingers then only navigate'],
  ] },
  { title: 'Keyboard', rows: [
    ...tools.map(({ key, short }): [string[], string] => [[key.toUpperCase()], short.toLowerCase()]), [['1', '…', '8'], 'colour'], [['[', ']'], 'ink or eraser smaller, larger'], [['T'], 'techniques'], [['C'], 'compare'],
    [['M'], 'symmetry'], [['P'], 'pen under the pointer, on a plane'], [['F'], 'show the whole model'], [['U'], 'turn the model by 90°; Shift: to the side'], [['Arrows'], 'turn the view'], [['+', '−'], 'zoom'],
    [['Ctrl Z'], 'undo'], [['Ctrl Shift Z'], 'redo'], [['Ctrl O'], 'open'], [['Ctrl S'], 'save'], [['Esc'], 'drop the stroke'], [['Enter'], 'draw from the keyboard: arrows move the pen, Enter ends'], [['?'], 'this help'],
  ] },
  { title: 'Headset', rows: [
    [['trigger'], 'draw, or erase'], [['squeeze, other hand'], 'hold the model, also while drawing'], [['both squeezes'], 'turn and scale'],
    [['thumbstick ↕'], 'thickness'], [['thumbstick ↔'], 'technique; other hand: one to compare with'], [['thumbstick pressed'], tools.map(({ short }) => short.toLowerCase()).join(', ')], [['A or X'], 'colour; other hand: symmetry'], [['B or Y'], 'undo; other hand: redo'],
  ] },
];

export function helpDialog(tools: Tools): HTMLDialogElement {
  const close = h('button', { class: 'button', type: 'button', 'aria-label': 'Close the help', onclick: () => dialog.close() }, icon(kIcons.close));
  const content = h('div', { class: 'content' });
  const dialog: HTMLDialogElement = h('dialog', { id: 'help', 'aria-labelledby': 'help-title', onclick: (event: Event) => { if (event.target === dialog) dialog.close(); } },
    h('header', {}, h('h2', { id: 'help-title' }, 'Drawing in the studio'), close),
    content);
  tools.list.watch((list) => content.replaceChildren(...helpSections(list).map(({ title, rows }) => h('section', {}, h('h3', {}, title),
    h('dl', {}, ...rows.flatMap(([keys, what]) => {
      const term = h('dt');
      keys.forEach((key, i) => term.append(...(i > 0 ? [' '] : []), h('kbd', {}, key)));
      return [term, h('dd', {}, what)];
    }))))));
  return dialog;
}
