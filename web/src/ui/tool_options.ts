import type { Settings } from '../studio/settings';
import type { Studio } from '../studio/studio';
import type { Tool, ToolOption } from '../tools/tool';
import type { Tools } from '../tools/tools';
import { h } from './dom';
import { field, radio } from './fields';

interface Control {
  elements: HTMLElement[];
  show(settings: Settings): void;
}

/** The options of the tool in use. */
export function toolOptions(studio: Studio, tools: Tools): HTMLElement {
  const element = h('div', { class: 'options' });
  let shown: Tool | null = null, controls: Control[] = [];
  studio.state.watch(({ settings }) => {
    const tool = tools.of(settings);
    if (tool !== shown) {
      shown = tool;
      controls = tool.options.map((option) => control(studio, option));
      element.replaceChildren(...controls.flatMap(({ elements }) => elements));
    }
    for (const one of controls) one.show(settings);
  });
  return element;
}

function control(studio: Studio, option: ToolOption): Control {
  const note = option.note ? [h('p', { class: 'remarks' }, option.note)] : [];
  if (option.kind === 'choice') {
    const choice = radio(option.label, 'segments', option.choices.map(({ value, text, title }) => ({ value, title, content: [text] })), (value) => studio.set(option.set(studio.settings, value)));
    return { elements: [field(option.title, choice.element), ...note], show: (settings) => choice.show(option.get(settings)) };
  }
  const text = h('span');
  const slider = h('input', {
    type: 'range', min: option.least, max: option.most, step: option.step, 'aria-label': option.label,
    oninput: () => studio.set(option.set(studio.settings, slider.valueAsNumber)),
  });
  return {
    elements: [field(option.title, slider, text), ...note],
    show(settings) {
      slider.value = String(option.get(settings));
      text.textContent = option.text(option.get(settings));
    },
  };
}
