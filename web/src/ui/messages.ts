import { h, icon, kIcons } from './dom';

/** Sentences at the top of the page: what went wrong and what to do, and work in progress. */
export class Messages {
  readonly element = h('div', { id: 'messages' });
  /** What happened, for those who do not see it. */
  readonly live = h('div', { class: 'sr', role: 'status', 'aria-live': 'polite' });

  say(text: string): void {
    this.live.textContent = '';
    requestAnimationFrame(() => (this.live.textContent = text));
  }

  /** A sentence that goes after a while. */
  note(text: string): void {
    const element = this.add(text, 'note');
    setTimeout(() => element.remove(), 6000);
  }

  /** A sentence that stays until it is closed. The same one is not shown twice. */
  problem(text: string): void {
    for (const other of this.element.querySelectorAll('.problem p')) if (other.textContent === text) return;
    this.add(text, 'problem', h('button', { class: 'button', type: 'button', 'aria-label': 'Close this message', onclick: (e: Event) => (e.currentTarget as Element).parentElement!.remove() }, icon(kIcons.close)));
  }

  /** Work in progress, until `done` is called. */
  work(text: string, cancel: (() => void) | null): { progress(text: string, fraction: number | null): void; done(): void } {
    const bar = h('progress', { max: 1, 'aria-label': text });
    const element = this.add(text, 'work', bar, cancel && h('button', { class: 'button', type: 'button', onclick: () => cancel() }, 'Cancel'));
    const paragraph = element.querySelector('p')!;
    return {
      progress: (now, fraction) => {
        if (paragraph.textContent !== now) paragraph.textContent = now;
        if (fraction === null) bar.removeAttribute('value');
        else bar.value = fraction;
      },
      done: () => element.remove(),
    };
  }

  private add(text: string, kind: string, ...more: (Node | null)[]): HTMLElement {
    const element = h('div', { class: `message panel ${kind}`, role: kind === 'problem' ? 'alert' : 'status' }, h('p', {}, text), ...more);
    this.element.append(element);
    while (this.element.children.length > 4) this.element.firstElementChild!.remove();
    return element;
  }
}
