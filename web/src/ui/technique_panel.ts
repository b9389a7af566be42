import type { Studio } from '../studio';
import type { Actions } from './actions';
import { h, icon, kIcons } from './dom';
import { kTechniqueColors, kTechniqueOrder, kTechniqueText } from './technique_text';

export function techniqueTitle(name: string): string {
  return kTechniqueText[name]?.title ?? name;
}

export function orderedTechniques(studio: Studio): typeof studio.core.techniques {
  const place = (name: string): number => (kTechniqueOrder.includes(name) ? kTechniqueOrder.indexOf(name) : kTechniqueOrder.length);
  return [...studio.core.techniques].sort((a, b) => place(a.name) - place(b.name));
}

/** The pill that names the technique, and the sheet in which another one is chosen. */
export function techniquePicker(studio: Studio, actions: Actions): HTMLElement[] {
  const dot = h('i', { class: 'dot' }), title = h('b'), sentence = h('span');
  const pill = h('button', { id: 'technique', class: 'panel', type: 'button', popovertarget: 'techniques', 'aria-label': 'Technique' }, dot, title, sentence, icon(kIcons.chevron));

  const inputs = new Map<string, HTMLInputElement>();
  const choices = orderedTechniques(studio).map((technique) => {
    const input = h('input', { type: 'radio', name: 'technique', value: technique.name, onchange: () => studio.set({ technique: technique.name }) });
    inputs.set(technique.name, input);
    const text = kTechniqueText[technique.name];
    return h('label', { class: 'choice' }, input, h('b', {}, techniqueTitle(technique.name)),
      h('em', { 'data-needs-bake': technique.needsBake }, technique.needsBake ? 'needs preparation' : ''), h('small', {}, text?.sentence ?? technique.description));
  });
  const prepare = h('button', { class: 'button outlined', type: 'button', onclick: () => actions.bake() }, 'Prepare this model');
  const bake = h('div', { class: 'bake' }, h('p', {}, 'Five techniques need the model prepared: some seconds to minutes, once. You can go on drawing meanwhile.'), prepare);
  const again = h('button', { class: 'button outlined', type: 'button', onclick: () => actions.redrawLast() }, 'Redraw the last stroke with it');
  const sheet = h('div', { id: 'techniques', popover: 'auto', role: 'dialog', 'aria-label': 'Techniques' },
    h('div', { class: 'sheet-title' }, 'How your motion becomes a curve', again),
    h('div', { role: 'radiogroup', 'aria-label': 'Technique' }, ...choices), bake);

  studio.state.watch(({ settings, hasEmbedding, history }) => {
    dot.style.background = kTechniqueColors[settings.technique] ?? '#777';
    title.textContent = techniqueTitle(settings.technique);
    sentence.textContent = kTechniqueText[settings.technique]?.sentence ?? studio.technique(settings.technique).description;
    pill.setAttribute('aria-label', `Technique: ${title.textContent}. ${sentence.textContent}`);
    bake.hidden = hasEmbedding;
    again.disabled = history.drawing.length === 0;
    for (const [name, input] of inputs) {
      input.checked = name === settings.technique;
      input.disabled = studio.technique(name).needsBake && !hasEmbedding;
      const mark = input.parentElement!.querySelector('em')!;
      mark.hidden = hasEmbedding || !studio.technique(name).needsBake;
    }
  });
  return [pill, sheet];
}
