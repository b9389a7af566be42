import { kInks, kLeastEraser_m, kLeastRadius_m, kMostEraser_m, kMostRadius_m, resized, type Settings, type Tool } from '../settings';
import type { Studio } from '../studio';
import { h, icon, kIcons } from './dom';

/** Buttons of which one is chosen; arrow keys go from one to the next. */
function radio<T>(label: string, className: string, options: readonly { value: T; title: string; content: (Node | string)[]; className?: string }[], choose: (value: T) => void): { element: HTMLElement; show(value: T): void } {
  const buttons = options.map(({ value, title, content, className: own }) =>
    h('button', { type: 'button', role: 'radio', class: own ?? '', title, 'aria-label': title, onclick: () => choose(value) }, ...content));
  const element = h('div', {
    role: 'radiogroup', 'aria-label': label, class: className,
    onkeydown: ((event: KeyboardEvent) => {
      const step = event.key === 'ArrowRight' || event.key === 'ArrowDown' ? 1 : event.key === 'ArrowLeft' || event.key === 'ArrowUp' ? -1 : 0;
      const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
      if (step === 0 || at < 0) return;
      event.preventDefault();
      event.stopPropagation();
      const next = (at + step + buttons.length) % buttons.length;
      buttons[next]!.focus();
      choose(options[next]!.value);
    }) as EventListener,
  }, ...buttons);
  return {
    element,
    show(value) {
      let any = false;
      options.forEach((option, i) => {
        const on = option.value === value;
        any ||= on;
        buttons[i]!.setAttribute('aria-checked', String(on));
        buttons[i]!.tabIndex = on ? 0 : -1;
      });
      if (!any) buttons[0]!.tabIndex = 0;
    },
  };
}

/** What the slider is for: the ink, or the eraser. It runs evenly in the logarithm of the size. */
function sizeOf({ tool, style, eraser_m }: Settings): { now: number; least: number; span: number; title: string } {
  return tool === 'draw'
    ? { now: style.radius_m, least: kLeastRadius_m, span: Math.log(kMostRadius_m / kLeastRadius_m), title: 'Thickness of the ink' }
    : { now: eraser_m, least: kLeastEraser_m, span: Math.log(kMostEraser_m / kLeastEraser_m), title: 'Size of the eraser' };
}

/** Tools, colours, size, and a sheet with what is needed less often. */
export function dock(studio: Studio): HTMLElement[] {
  const set = (part: Partial<Settings>): void => studio.set(part);
  const tools = radio<Tool>('Tool', 'inks', [
    { value: 'draw', title: 'Draw (D)', content: [icon(kIcons.draw)], className: 'button' },
    { value: 'erase curve', title: 'Erase whole curves (E)', content: [icon(kIcons.eraseCurve)], className: 'button' },
    { value: 'erase part', title: 'Erase parts of curves (R)', content: [icon(kIcons.erasePart)], className: 'button' },
  ], (tool) => set({ tool }));
  const inks = radio<string>('Colour', 'inks colors', kInks.map(({ name, color }) => ({ value: color, title: name, content: [], className: 'ink' })), (color) => set({ style: { ...studio.settings.style, color }, tool: 'draw' }));
  inks.element.querySelectorAll<HTMLElement>('.ink').forEach((button, i) => button.style.setProperty('--ink', kInks[i]!.color));

  const preview = h('i');
  const slider = h('input', {
    type: 'range', min: 0, max: 100, step: 1, 'aria-label': 'Thickness of the ink',
    oninput: () => {
      const { now, least, span } = sizeOf(studio.settings);
      set(resized(studio.settings, (least / now) * Math.exp((span * slider.valueAsNumber) / 100)));
    },
  });
  const size = h('label', { class: 'size', title: 'Size of ink or eraser ([ and ])' }, h('span', { class: 'preview' }, preview), slider);
  const more = h('button', { class: 'button', type: 'button', popovertarget: 'pen-panel', title: 'Symmetry, pen and hand', 'aria-label': 'Symmetry, pen and hand' }, icon(kIcons.mirror));
  const bar = h('div', { id: 'dock', class: 'panel', role: 'toolbar', 'aria-label': 'Drawing' }, tools.element, h('i', { class: 'divider' }), inks.element, h('i', { class: 'divider' }), size, more);

  const mirror = radio<Settings['mirror']>('Symmetry', 'segments', [
    { value: null, title: 'No symmetry', content: ['Off'] }, { value: 'x', title: 'Symmetry left and right', content: ['X'] },
    { value: 'y', title: 'Symmetry up and down', content: ['Y'] }, { value: 'z', title: 'Symmetry front and back', content: ['Z'] },
  ], (value) => set({ mirror: value }));
  const place = radio<Settings['penPlace']>('Pen on the screen', 'segments', [
    { value: 'under the pointer', title: 'Ink comes where the pointer is', content: ['Under it'] },
    { value: 'on a plane', title: 'The pen moves on a plane in front of the model, like a hand in space', content: ['On a plane'] },
  ], (penPlace) => set({ penPlace }));
  const hand = radio<Settings['hand']>('Hand that draws in a headset', 'segments', [
    { value: 'left', title: 'Left hand', content: ['Left'] }, { value: 'right', title: 'Right hand', content: ['Right'] },
  ], (value) => set({ hand: value }));
  const lift = h('input', { type: 'range', min: -5, max: 20, step: 0.5, 'aria-label': 'Height of the ink above the surface, millimetres', oninput: () => set({ style: { ...studio.settings.style, offset_m: lift.valueAsNumber / 1000 } }) });
  const liftText = h('span');
  const field = (label: string, ...controls: Node[]): HTMLElement => h('div', { class: 'field' }, h('span', {}, label), ...controls);
  const planeNote = h('p', { class: 'remarks' }, 'On a plane: the pen floats in front of the model, as a hand does in space, and the wheel moves it nearer or farther. It shows how techniques differ; ink is then not under the pointer.');
  const panel = h('div', { id: 'pen-panel', popover: 'auto', role: 'dialog', 'aria-label': 'Symmetry, pen and hand' },
    field('Symmetry', mirror.element), field('Pen and pointer', place.element), planeNote, field('Ink height', lift, liftText), field('Drawing hand (VR)', hand.element));

  studio.state.watch(({ settings }) => {
    tools.show(settings.tool);
    inks.show(settings.style.color);
    mirror.show(settings.mirror);
    place.show(settings.penPlace);
    hand.show(settings.hand);
    more.setAttribute('aria-pressed', String(settings.mirror !== null));
    const shown = sizeOf(settings);
    const at = String(Math.round((100 * Math.log(shown.now / shown.least)) / shown.span));
    if (slider.value !== at) slider.value = at;
    slider.setAttribute('aria-label', shown.title);
    slider.setAttribute('aria-valuetext', `${(2000 * shown.now).toFixed(1)} millimetres`);
    const px = 22 * Math.sqrt(shown.now / (shown.least * Math.exp(shown.span)));
    preview.style.width = preview.style.height = `${px.toFixed(1)}px`;
    preview.style.color = settings.tool === 'draw' ? settings.style.color : 'currentColor';
    lift.value = String(1000 * settings.style.offset_m);
    liftText.textContent = `${(1000 * settings.style.offset_m).toFixed(1)} mm`;
  });
  return [bar, panel];
}
