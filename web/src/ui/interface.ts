import { shapeTitle } from '../engine/loaded_model';
import type { Actions } from '../studio/actions';
import type { Studio } from '../studio/studio';
import type { Tools } from '../tools/tools';
import { dock } from './dock';
import { h, icon, kIcons } from './dom';
import { kExports } from './exports';
import { helpDialog } from './help';
import { Messages } from './messages';
import { techniquePicker } from './technique_panel';

export interface Interface {
  messages: Messages;
  help: HTMLDialogElement;
  showXr(vr: boolean, ar: boolean): void;
  showDrop(on: boolean): void;
}

/** Builds the page around the canvas. */
export function buildInterface(root: HTMLElement, studio: Studio, tools: Tools, actions: Actions): Interface {
  const messages = new Messages();
  const help = helpDialog(tools);
  const button = (path: string, label: string, keys: string, onclick: () => void, className = ''): HTMLButtonElement =>
    h('button', { class: `button ${className}`, type: 'button', 'aria-label': label, title: keys ? `${label} (${keys})` : label, onclick }, icon(path));
  const closing = (act: () => void): EventListener => (event) => {
    (event.currentTarget as HTMLElement).closest<HTMLElement>('[popover]')?.hidePopover();
    act();
  };

  const modelName = h('span');
  const model = h('button', { class: 'button model', type: 'button', popovertarget: 'models', title: 'Choose or open a model' }, modelName, icon(kIcons.chevron));
  const undo = button(kIcons.undo, 'Undo', 'Ctrl Z', () => actions.undo());
  const redo = button(kIcons.redo, 'Redo', 'Ctrl Shift Z', () => actions.redo());
  const compare = button(kIcons.compare, 'Compare the last stroke with another technique', 'C', () => studio.toggleCompare(), 'only-wide');
  const frame = button(kIcons.frame, 'Show the whole model', 'F', () => actions.frameModel(), 'only-wide');
  const vr = h('button', { class: 'button', type: 'button', hidden: true, onclick: () => actions.enterXr('immersive-vr') }, icon(kIcons.headset), 'VR');
  const ar = h('button', { class: 'button', type: 'button', hidden: true, onclick: () => actions.enterXr('immersive-ar') }, icon(kIcons.headset), 'AR');
  const files = h('button', { class: 'button', type: 'button', popovertarget: 'files', 'aria-label': 'Save, export and more', title: 'Save, export and more' }, icon(kIcons.menu));

  const top = h('header', { id: 'top' },
    h('div', { class: 'panel brand' }, h('h1', { class: 'mark' }, h('img', { src: 'icon.svg', alt: '', width: 24, height: 24 }), h('span', {}, 'mimicry')), h('i', { class: 'divider only-wide' }), model),
    h('div', { class: 'panel', role: 'toolbar', 'aria-label': 'Drawing and view' }, undo, redo, h('i', { class: 'divider only-wide' }), compare, frame, vr, ar,
      button(kIcons.help, 'Help', '?', () => help.showModal(), 'only-wide'), files));

  // Models.
  const shapes = studio.core.shapes.map(({ name, description }) =>
    h('button', { class: 'list-button', type: 'button', title: description, 'data-shape': name, onclick: closing(() => actions.openShape(name)) }, shapeTitle(name)));
  const remarks = h('ul', { class: 'remarks' });
  const models = h('div', { id: 'models', popover: 'auto', role: 'dialog', 'aria-label': 'Models' },
    h('button', { class: 'list-button', type: 'button', onclick: closing(() => actions.chooseFiles()) }, icon(kIcons.folder), 'Open a file…', h('small', {}, 'OBJ PLY STL GLB')),
    h('hr', { class: 'hairline' }), h('div', { class: 'shapes' }, ...shapes), remarks);

  // Files and the rest.
  const item = (path: string | null, title: string, note: string, act: () => void, className = ''): HTMLButtonElement =>
    h('button', { class: `list-button ${className}`, type: 'button', onclick: closing(act) }, path ? icon(path) : null, title, note ? h('small', {}, note) : null);
  /** An export in two words; its whole name is read out. */
  const small = (title: string, what: string, act: () => void): HTMLButtonElement =>
    h('button', { class: 'list-button', type: 'button', 'aria-label': title, title: `${title}: ${what}`, onclick: closing(act) }, title.split(/, | /).at(-1)!);
  const save = item(kIcons.save, 'Save the drawing', 'Ctrl S', () => actions.saveDrawing());
  const clear = item(kIcons.trash, 'Clear the drawing', '', () => actions.clear());
  const exports = [...kExports.map(({ format, title, what }) => small(title, what, () => actions.exportCurves(format))), small('Recorded strokes', 'to draw again', () => actions.exportStrokes())];
  const needing = [save, ...exports, clear];
  const headset = item(kIcons.headset, 'Draw in a headset', '', () => actions.enterXr('immersive-vr'));
  const theme = item(kIcons.light, 'Light or dark', '', () => studio.set({ theme: document.documentElement.dataset['theme'] === 'dark' ? 'light' : 'dark' }));
  const menu = h('div', { id: 'files', popover: 'auto', role: 'dialog', 'aria-label': 'Save, export and more' },
    item(kIcons.folder, 'Open…', 'Ctrl O', () => actions.chooseFiles()), item(kIcons.drawings, 'Drawings…', '', () => actions.showDrawings()), save,
    h('hr', { class: 'hairline' }), h('p', { class: 'sheet-title' }, 'Export'), h('div', { class: 'exports', role: 'group', 'aria-label': 'Export' }, ...exports), h('hr', { class: 'hairline' }),
    h('div', { class: 'rest' }, clear, item(kIcons.turn, 'Turn by 90°', 'U', () => actions.turnModel('x')),
      item(kIcons.compare, 'Compare techniques', '', () => studio.toggleCompare(), 'only-narrow'), item(kIcons.frame, 'Show the whole model', '', () => actions.frameModel(), 'only-narrow'),
      headset, theme, item(kIcons.help, 'Help', '', () => help.showModal(), 'only-narrow')));

  // Comparing.
  const left = h('div', { class: 'panel' });
  const select = h('select', { 'aria-label': 'Technique to compare with', onchange: () => studio.set({ compare: select.value }) });
  const halves = h('div', { id: 'halves', hidden: true }, left, h('div', { class: 'panel' }, select));

  const hintText = h('b');
  const hint = h('div', { id: 'hint', class: 'panel', hidden: true }, hintText, ' Drag beside it to turn.');
  const drop = h('div', { id: 'drop', hidden: true }, 'Drop a model, a drawing or recorded strokes');
  const bottom = h('div', { id: 'bottom' }, ...techniquePicker(studio, actions), ...dock(studio, tools));
  root.append(top, models, menu, halves, hint, bottom, messages.element, messages.live, drop, help);

  studio.state.watch((now, before) => {
    const { history, settings, model: current } = now;
    undo.disabled = history.past.length === 0;
    redo.disabled = history.future.length === 0;
    undo.title = history.past.length > 0 ? `Undo ${history.past.at(-1)!.label} (Ctrl Z)` : 'Undo (Ctrl Z)';
    redo.title = history.future.length > 0 ? `Redo ${history.future[0]!.label} (Ctrl Shift Z)` : 'Redo (Ctrl Shift Z)';
    for (const element of needing) element.disabled = history.drawing.length === 0;
    modelName.textContent = current ? ('shape' in current.source ? shapeTitle(current.source.shape) : current.name) : 'Loading…';
    if (current !== before.model || remarks.childElementCount === 0) {
      remarks.replaceChildren(...(current ? [`${current.faces.toLocaleString('en')} triangles`, ...current.remarks] : []).map((remark) => h('li', {}, remark)));
      for (const shape of shapes) shape.setAttribute('aria-current', String(current !== null && 'shape' in current.source && current.source.shape === shape.dataset['shape']));
    }
    halves.hidden = settings.compare === null;
    compare.setAttribute('aria-pressed', String(settings.compare !== null));
    left.textContent = studio.techniqueTitle(history.drawing.at(-1)?.curve.technique ?? settings.technique);
    if (settings.compare !== null) {
      if (now.hasEmbedding !== before.hasEmbedding || select.options.length === 0 || before.settings.compare === null) {
        select.replaceChildren(...studio.techniques.map(({ name, title }) => h('option', { value: name, disabled: !studio.offers(name) }, title)));
      }
      select.value = settings.compare;
    }
    hintText.textContent = tools.now.hint.page;
    hint.hidden = settings.hintSeen || current === null;
    if (now.drawing) hint.classList.add('gone');
  });

  return {
    messages, help,
    showXr(withVr, withAr) {
      vr.hidden = !withVr;
      ar.hidden = !withAr;
      headset.hidden = withVr || withAr; // it says why there is no button
    },
    showDrop(on) {
      drop.hidden = !on;
    },
  };
}
