import { h } from './dom';

export interface Radio<T> {
  element: HTMLElement;
  show(value: T): void;
}

/** Buttons of which one is chosen; arrow keys go from one to the next. */
export function radio<T>(label: string, className: string, options: readonly { value: T; title: string; content: (Node | string)[]; className?: string }[], choose: (value: T) => void): Radio<T> {
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

/** A row of a sheet: what it is, and its controls. */
export function field(label: string, ...controls: Node[]): HTMLElement {
  return h('div', { class: 'field' }, h('span', {}, label), ...controls);
}
