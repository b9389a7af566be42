import { kInks } from '../drawing/ink_styles';
import type { Settings } from '../studio/settings';
import type { Studio } from '../studio/studio';
import type { Tool } from '../tools/tool';
import type { Tools } from '../tools/tools';
import { h, icon, kIcons } from './dom';
import { field, radio, type Radio } from './fields';
import { toolOptions } from './tool_options';

/** The slider runs evenly in the logarithm of the size. */
function span({ size }: Tool): number {
  return Math.log(size.most_m / size.least_m);
}

/** Tools, colours, size, and a sheet with what is needed less often. */
export function dock(studio: Studio, tools: Tools): HTMLElement[] {
  const set = (part: Partial<Settings>): void => studio.set(part);
  const toolbar = h('div', { class: 'tools' });
  let choice: Radio<string>;
  tools.list.watch((list) => {
    choice = radio<string>('Tool', 'inks', list.map(({ name, title, key, icon: path }) => ({ value: name, title: `${title} (${key.toUpperCase()})`, content: [icon(path)], className: 'button' })), (tool) => set({ tool }));
    choice.show(tools.now.name);
    toolbar.replaceChildren(choice.element);
  });
  const inks = radio<string>('Colour', 'inks colors', kInks.map(({ name, color }) => ({ value: color, title: name, content: [], className: 'ink' })), (color) => tools.ink(color));
  inks.element.querySelectorAll<HTMLElement>('.ink').forEach((button, i) => button.style.setProperty('--ink', kInks[i]!.color));

  const preview = h('i');
  const slider = h('input', {
    type: 'range', min: 0, max: 100, step: 1, 'aria-label': tools.now.size.title,
    oninput: () => set(tools.sized(tools.now.size.least_m * Math.exp((span(tools.now) * slider.valueAsNumber) / 100))),
  });
  const size = h('label', { class: 'size', title: 'Size of ink or eraser ([ and ])' }, h('span', { class: 'preview' }, preview), slider);
  const more = h('button', { class: 'button', type: 'button', popovertarget: 'pen-panel', title: 'Symmetry, pen and hand', 'aria-label': 'Symmetry, pen and hand' }, icon(kIcons.mirror));
  const bar = h('div', { id: 'dock', class: 'panel', role: 'toolbar', 'aria-label': 'Drawing' }, toolbar, h('i', { class: 'divider' }), inks.element, h('i', { class: 'divider' }), size, more);

  const mirror = radio<Settings['mirror']>('Symmetry', 'segments', [
    { value: null, title: 'No symmetry', content: ['Off'] }, { value: 'x', title: 'Symmetry left and right', content: ['X'] },
    { value: 'y', title: 'Symmetry up and down', content: ['Y'] }, { value: 'z', title: 'Symmetry front and back', content: ['Z'] },
  ], (value) => set({ mirror: value }));
  const hand = radio<Settings['hand']>('Hand that draws in a headset', 'segments', [
    { value: 'left', title: 'Left hand', content: ['Left'] }, { value: 'right', title: 'Right hand', content: ['Right'] },
  ], (value) => set({ hand: value }));
  const options = toolOptions(studio, tools);
  const panel = h('div', { id: 'pen-panel', popover: 'auto', role: 'dialog', 'aria-label': 'Symmetry, pen and hand' },
    field('Symmetry', mirror.element), options, field('Drawing hand (VR)', hand.element));

  studio.state.watch(({ settings }) => {
    const tool = tools.now, { size } = tool, radius_m = size.get(settings);
    choice.show(tool.name);
    inks.show(settings.style.color);
    mirror.show(settings.mirror);
    hand.show(settings.hand);
    more.setAttribute('aria-pressed', String(settings.mirror !== null));
    const at = String(Math.round((100 * Math.log(radius_m / size.least_m)) / span(tool)));
    if (slider.value !== at) slider.value = at;
    slider.setAttribute('aria-label', size.title);
    slider.setAttribute('aria-valuetext', `${(2000 * radius_m).toFixed(1)} millimetres`);
    const px = 22 * Math.sqrt(radius_m / size.most_m);
    preview.style.width = preview.style.height = `${px.toFixed(1)}px`;
    preview.style.color = tool.color(settings) ?? 'currentColor';
  });
  return [bar, panel];
}
