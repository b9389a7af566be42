import type { Actions } from '../studio/actions';
import type { TechniqueInfo } from '../engine/core';
import type { Studio, StudioState } from '../studio/studio';
import { h, icon, kIcons } from './dom';

/** The pill that names the technique, and the sheet in which another one is chosen. */
export function techniquePicker(studio: Studio, actions: Actions): HTMLElement[] {
  const dot = h('i', { class: 'dot' }), title = h('b'), sentence = h('span');
  const pill = h('button', { id: 'technique', class: 'panel', type: 'button', popovertarget: 'techniques', 'aria-label': 'Technique' }, dot, title, sentence, icon(kIcons.chevron));

  const inputs = new Map<string, HTMLInputElement>();
  const choice = (technique: TechniqueInfo): HTMLElement => {
    const input = h('input', { type: 'radio', name: 'technique', value: technique.name, onchange: () => studio.set({ technique: technique.name }) });
    inputs.set(technique.name, input);
    return h('label', { class: 'choice' }, input, h('b', {}, technique.title),
      h('em', { 'data-needs-bake': technique.needsBake }, technique.needsBake ? 'needs preparation' : ''), h('small', {}, technique.sentence));
  };
  const choices = h('div', { role: 'radiogroup', 'aria-label': 'Technique' });
  const prepare = h('button', { class: 'button outlined', type: 'button', onclick: () => actions.bake() }, 'Prepare this model');
  const bake = h('div', { class: 'bake' }, h('p', {}, `${studio.techniques.filter((t) => t.needsBake).length} techniques need the model prepared: some seconds to minutes, once. You can go on drawing meanwhile.`), prepare);
  const again = h('button', { class: 'button outlined', type: 'button', onclick: () => actions.redrawLast() }, 'Redraw the last stroke with it');
  const sheet = h('div', { id: 'techniques', popover: 'auto', role: 'dialog', 'aria-label': 'Techniques' },
    h('div', { class: 'sheet-title' }, 'How your motion becomes a curve', again),
    choices, bake);
  const show = ({ settings, hasEmbedding, history }: StudioState): void => {
    // A page may have registered more of its own.
    if (inputs.size !== studio.techniques.length) choices.replaceChildren(...studio.techniques.map(choice));
    const technique = studio.technique(settings.technique);
    dot.style.background = technique.color;
    title.textContent = technique.title;
    sentence.textContent = technique.sentence;
    pill.setAttribute('aria-label', `Technique: ${title.textContent}. ${sentence.textContent}`);
    bake.hidden = hasEmbedding;
    again.disabled = history.drawing.length === 0;
    for (const [name, input] of inputs) {
      input.checked = name === settings.technique;
      input.disabled = studio.technique(name).needsBake && !hasEmbedding;
      const mark = input.parentElement!.querySelector('em')!;
      mark.hidden = hasEmbedding || !studio.technique(name).needsBake;
    }
  };
  studio.state.watch(show);
  sheet.addEventListener('beforetoggle', () => show(studio.state.now));
  return [pill, sheet];
}
