import type { Curve, Target } from '../engine/core';
import type { Drawing } from './document';
import { forgetLastWords, keepLastWords, type LastWords } from './last_words';
import { contentKey, kLastKey, Library, stateKey, type Named, type State } from './library';
import { isTaken, type Shelf } from './shelf';
import type { StoredEntry, StoredModel } from './stored';

/**
 * Keeps the open drawing, a stroke at a time: what was kept before is not written again. What is to be
 * written is taken when it is asked for, so that the drawing may be closed at once; writes follow each
 * other, and a burst of changes is one.
 */
export class Autosave {
  private open: { id: string; title: string; saved: Set<string> } | null = null;
  private readonly keys = new WeakMap<Curve, string>();
  private readonly put = new Map<string, unknown>();
  private readonly remove = new Set<string>();
  private running: Promise<void> | null = null;
  private serial = Date.now();
  private writing: LastWords = { put: new Map(), remove: [] };
  private hasLastWords = false;

  /** problem: a sentence when saving fails, null when it works. written: drawings that were. */
  constructor(private readonly shelf: Shelf, private readonly problem: (sentence: string | null) => void, private readonly written: (ids: readonly string[]) => void = () => undefined) {}

  /** Saves are of this new drawing from now on. */
  begin(id: string, name: Pick<Named, 'name' | 'isOwn'>, model: StoredModel, title: string): void {
    this.open = { id, title, saved: new Set() };
    const [key, named] = Library.entryOf(id, name);
    this.write([[key, named], [contentKey(id, 'model'), model], [kLastKey, id]]);
  }

  /** Saves are of this drawing, whose parts are kept under `known`; null: none are kept. */
  resume(id: string, title: string, known: readonly StoredEntry[]): void {
    this.open = { id, title, saved: new Set(known.flatMap((e) => [e.strokeKey, e.curveKey])) };
    this.write([[kLastKey, id]]);
  }

  pause(): void {
    this.open = null;
  }

  /** A curve that is kept under this key already. */
  isKept(curve: Curve, key: string): void {
    this.keys.set(curve, key);
  }

  save(target: Target, drawing: Drawing): void {
    const { open } = this;
    if (!open) return;
    const put: [string, unknown][] = [];
    const keep = (key: string, value: () => unknown): void => {
      if (open.saved.has(key)) return;
      open.saved.add(key);
      put.push([contentKey(open.id, key), value()]);
    };
    const entries = drawing.map((drawn): StoredEntry => {
      const strokeKey = `stroke:${drawn.id}`, curveKey = this.curveKey(drawn.id, drawn.curve);
      keep(strokeKey, () => drawn.stroke);
      keep(curveKey, () => target.writeCurves([drawn.curve], 'packed'));
      return { id: drawn.id, mirror: drawn.mirror, style: drawn.style, kept: drawn.kept, strokeKey, curveKey };
    });
    const needed = new Set(entries.flatMap((e) => [e.strokeKey, e.curveKey]));
    const gone = [...open.saved].filter((key) => !needed.has(key));
    for (const key of gone) open.saved.delete(key);
    const state: State = { strokes: drawing.filter((drawn) => drawn.mirror === null).length, changed_ms: Date.now(), model: open.title };
    this.write([...put, [contentKey(open.id, 'entries'), entries], [stateKey(open.id), state], [kLastKey, open.id]], [...gone, 'file'].map((key) => contentKey(open.id, key)));
  }

  saveModel(model: StoredModel): void {
    if (this.open) this.write([[contentKey(this.open.id, 'model'), model]]);
  }

  saveEmbedding(bytes: Uint8Array): void {
    if (this.open) this.write([[contentKey(this.open.id, 'embedding'), bytes]]);
  }

  /** Lets go of a drawing for good. */
  discard(id: string): void {
    for (const key of this.put.keys()) if (key.includes(`/${id}/`) || key.endsWith(`/${id}`)) this.put.delete(key);
    this.write([], Library.keysOf(id));
  }

  /** Resolves when all that was asked for is written, or was refused. */
  async settled(): Promise<void> {
    while (this.running) await this.running;
  }

  /** The page goes away: what is not written yet is kept for the next one (`lastWords`). */
  leave(): void {
    const before = [...this.writing.put].filter(([key]) => !isTaken(key, this.remove));
    const words = { put: new Map([...before, ...this.put]), remove: [...this.writing.remove, ...this.remove] };
    if (words.put.size + words.remove.length > 0) this.hasLastWords = keepLastWords(words);
  }

  private curveKey(id: string, curve: Curve): string {
    let key = this.keys.get(curve);
    if (!key) {
      this.serial += 1;
      key = `curve:${id}:${this.serial}`;
      this.keys.set(curve, key);
    }
    return key;
  }

  private write(put: readonly [string, unknown][], remove: readonly string[] = []): void {
    for (const key of remove) {
      this.put.delete(key);
      this.remove.add(key);
    }
    for (const [key, value] of put) {
      this.remove.delete(key);
      this.put.set(key, value);
    }
    this.running ??= this.run();
  }

  private async run(): Promise<void> {
    await Promise.resolve(); // a burst of changes is one
    while (this.put.size > 0 || this.remove.size > 0) {
      const put = new Map(this.put), remove = [...this.remove];
      this.writing = { put, remove };
      this.put.clear();
      this.remove.clear();
      try {
        await this.shelf.write(put, remove);
        this.problem(null);
        this.written([...new Set([...put.keys()].map((key) => key.split('/')[1]).filter((id) => id !== undefined))]);
      } catch (error) {
        const full = error instanceof DOMException && error.name === 'QuotaExceededError';
        this.problem(full
          ? 'The browser’s storage is full: what you draw is kept only until this page closes. Save it to a file, or delete drawings.'
          : 'The browser does not let this page keep the drawing (a private window?). Save it to a file before you close the page.');
      }
      this.writing = { put: new Map(), remove: [] };
    }
    if (this.hasLastWords) forgetLastWords(); // the page is still there
    this.hasLastWords = false;
    this.running = null;
  }
}
