import { h, icon, kIcons } from './dom';

/** A button in a message. */
export interface Remedy {
  title: string;
  act(): void;
}

/** How long a note stays, and one that offers something. */
const kNote_ms = 6000, kOffer_ms = 12000;

/** Sentences beside the model: what went wrong and what to do, and work in progress. */
export class Messages {
  readonly element = h('div', { id: 'messages' });
  /** What happened, for those who do not see it. */
  readonly live = h('div', { class: 'sr', role: 'status', 'aria-live': 'polite' });

  say(text: string): void {
    this.live.textContent = '';
    requestAnimationFrame(() => (this.live.textContent = text));
  }

  /** A sentence that goes after a while. */
  note(text: string, remedy: Remedy | null = null): void {
    const element = this.add(text, 'note', remedy && this.button(remedy, () => element.remove()));
    setTimeout(() => element.remove(), remedy ? kOffer_ms : kNote_ms);
  }

  /** A sentence that stays until it is closed, by hand or with what this returns. The same one is not shown twice. */
  problem(text: string, remedy: Remedy | null = null): () => void {
    for (const other of this.element.querySelectorAll('.problem')) if (other.querySelector('p')?.textContent === text) return () => other.remove();
    const element = this.add(text, 'problem', remedy && this.button(remedy, () => undefined),
      this.closing(() => element.remove()));
    return () => element.remove();
  }

  /** Something that can be had when it suits; stays until it is taken or closed. */
  offer(text: string, remedy: Remedy): void {
    for (const other of this.element.querySelectorAll('.standing p')) if (other.textContent === text) return;
    const close = this.standing(text, remedy);
    this.element.lastElementChild!.append(this.closing(close));
  }

  /** A sentence that holds until the function that it returns is called. */
  standing(text: string, remedy: Remedy): () => void {
    const element = this.add(text, 'standing', this.button(remedy, () => undefined));
    return () => element.remove();
  }

  private closing(close: () => void): HTMLElement {
    return h('button', { class: 'button', type: 'button', 'aria-label': 'Close this message', onclick: () => close() }, icon(kIcons.close));
  }

  private button({ title, act }: Remedy, then: () => void): HTMLElement {
    return h('button', { class: 'button outlined', type: 'button', onclick: () => { then(); act(); } }, title);
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
    const passing = this.element.querySelectorAll('.note, .problem');
    for (let i = 0; i < passing.length - 4; i += 1) passing[i]!.remove();
    return element;
  }
}
