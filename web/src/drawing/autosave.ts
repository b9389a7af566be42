import type { Curve, Target } from '../engine/core';
import type { ModelSource } from '../studio';
import type { Drawing, DrawnCurve, InkStyle } from './document';
import type { DrawingContent } from './drawing_file';
import type { Range } from './kept';
import type { MirrorAxis } from './symmetry';

/** Where a drawing is kept while the page is closed. One transaction a save: a drawing is never half there. */
export interface Shelf {
  read(key: string): Promise<unknown>;
  /** All or nothing. */
  write(put: ReadonlyMap<string, unknown>, remove: readonly string[]): Promise<void>;
  /** Calls the listener when another page has written. */
  onOthers?(listener: () => void): void;
}

interface StoredEntry {
  id: string;
  mirror: MirrorAxis | null;
  style: InkStyle;
  kept: readonly Range[];
  strokeKey: string;
  curveKey: string;
}

export interface StoredModel {
  name: string;
  source: ModelSource;
}

/** A drawing that another model took the place of. */
export interface PutAway {
  source: ModelSource;
  content: DrawingContent;
}

/**
 * Keeps the drawing in the browser's storage, a stroke at a time: what was saved before is not
 * written again. Saves follow each other; of several that wait only the last is done. Where another
 * page saved in between, all is written anew: the last one that saves is kept whole.
 */
export class Autosave {
  private readonly saved = new Set<string>();
  private readonly keys = new WeakMap<Curve, string>();
  private model: ModelSource | null = null;
  private waiting: (() => Promise<void>) | null = null;
  private running: Promise<void> | null = null;
  private serial = Date.now();
  private others = false; // another page saved since we did
  private away: PutAway | null | undefined; // to be written with the next save

  /** problem: a sentence when saving fails, null when it works again. */
  constructor(private readonly shelf: Shelf, private readonly problem: (sentence: string | null) => void) {
    shelf.onOthers?.(() => (this.others = true));
  }

  save(model: StoredModel, target: Target, drawing: Drawing): void {
    this.enqueue(async () => {
      let theirs: StoredEntry[] = [];
      if (this.others) {
        // Read only then: a save when the page goes away has no time for it.
        theirs = ((await this.shelf.read('entries')) ?? []) as StoredEntry[];
        this.others = false;
        this.saved.clear();
        this.model = null;
      }
      const put = new Map<string, unknown>();
      const entries = drawing.map((drawn): StoredEntry => {
        const strokeKey = `stroke:${drawn.id}`, curveKey = this.curveKey(drawn);
        if (!this.saved.has(strokeKey)) put.set(strokeKey, drawn.stroke);
        if (!this.saved.has(curveKey)) put.set(curveKey, target.writeCurves([drawn.curve], 'json', new Uint8Array(3), 1));
        return { id: drawn.id, mirror: drawn.mirror, style: drawn.style, kept: drawn.kept, strokeKey, curveKey };
      });
      const needed = new Set(entries.flatMap((e) => [e.strokeKey, e.curveKey]));
      const remove = [...this.saved, ...theirs.flatMap((e) => [e.strokeKey, e.curveKey])].filter((key) => !needed.has(key));
      put.set('entries', entries);
      if (model.source !== this.model) {
        put.set('model', model);
        remove.push('embedding');
      }
      const { away } = this;
      if (away !== undefined) put.set('away', away);
      await this.shelf.write(put, remove);
      if (this.away === away) this.away = undefined;
      this.model = model.source;
      for (const key of put.keys()) if (key.includes(':')) this.saved.add(key);
      for (const key of remove) this.saved.delete(key);
    });
  }

  /** Keeps a drawing beside the one that is open; written with its next save, so that none is lost between. */
  putAway(away: PutAway | null): void {
    this.away = away;
  }

  async lastPutAway(): Promise<PutAway | null> {
    return ((await this.shelf.read('away')) as PutAway | null | undefined) ?? null;
  }

  saveEmbedding(bytes: Uint8Array): void {
    this.enqueue(() => this.shelf.write(new Map([['embedding', bytes]]), []), true);
  }

  /** What was saved last; null: nothing. */
  async lastModel(): Promise<{ model: StoredModel; embedding: Uint8Array | null } | null> {
    const model = (await this.shelf.read('model')) as StoredModel | undefined;
    if (!model) return null;
    const embedding = (await this.shelf.read('embedding')) as Uint8Array | undefined;
    this.model = null;
    return { model, embedding: embedding ?? null };
  }

  /** The drawing on the target, which is the saved model. `source` is the model that the studio shows for it. */
  async drawing(target: Target, source: ModelSource): Promise<Drawing> {
    const entries = ((await this.shelf.read('entries')) ?? []) as StoredEntry[];
    const drawing: DrawnCurve[] = [];
    for (const { strokeKey, curveKey, ...entry } of entries) {
      const stroke = (await this.shelf.read(strokeKey)) as DrawnCurve['stroke'] | undefined;
      const content = (await this.shelf.read(curveKey)) as Uint8Array | undefined;
      if (!stroke || !content) continue;
      const [curve] = target.readCurves(content, entry.id);
      this.keys.set(curve!, curveKey);
      this.saved.add(strokeKey).add(curveKey);
      drawing.push({ ...entry, stroke, curve: curve! });
    }
    this.model = source;
    return drawing;
  }

  /** Resolves when all that was asked for is written. */
  async settled(): Promise<void> {
    while (this.running) await this.running;
  }

  private curveKey(drawn: DrawnCurve): string {
    let key = this.keys.get(drawn.curve);
    if (!key) {
      this.serial += 1;
      key = `curve:${drawn.id}:${this.serial}`;
      this.keys.set(drawn.curve, key);
    }
    return key;
  }

  private readonly also: (() => Promise<void>)[] = [];

  private enqueue(job: () => Promise<void>, additional = false): void {
    if (additional) this.also.push(job);
    else this.waiting = job;
    this.running ??= this.run();
  }

  private async run(): Promise<void> {
    await Promise.resolve(); // a burst of changes is one save
    for (;;) {
      let job = this.waiting;
      if (job) this.waiting = null;
      else job = this.also.shift() ?? null;
      if (!job) break;
      try {
        await job();
        this.problem(null);
      } catch (error) {
        const full = error instanceof DOMException && error.name === 'QuotaExceededError';
        this.problem(full
          ? 'The browser’s storage is full, so this drawing is not kept when the page closes. Save it to a file, or free space in the browser’s settings.'
          : 'The browser does not let this page keep the drawing (a private window?). Save it to a file before you close the page.');
      }
    }
    this.running = null;
  }
}

/** A shelf in IndexedDB. */
export function indexedDbShelf(name = 'mimicry-studio'): Shelf {
  let opened: Promise<IDBDatabase> | null = null;
  const open = (): Promise<IDBDatabase> => {
    opened ??= new Promise<IDBDatabase>((resolve, reject) => {
      const request = indexedDB.open(name, 1);
      request.onupgradeneeded = () => request.result.createObjectStore('shelf');
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error);
    });
    opened.catch(() => (opened = null));
    return opened;
  };
  const channel = 'BroadcastChannel' in window ? new BroadcastChannel(name) : null;
  return {
    onOthers(listener) {
      channel?.addEventListener('message', listener);
    },
    async read(key) {
      const db = await open();
      return new Promise((resolve, reject) => {
        const request = db.transaction('shelf').objectStore('shelf').get(key);
        request.onsuccess = () => resolve(request.result);
        request.onerror = () => reject(request.error);
      });
    },
    async write(put, remove) {
      const db = await open();
      return new Promise((resolve, reject) => {
        const transaction = db.transaction('shelf', 'readwrite');
        const store = transaction.objectStore('shelf');
        for (const key of remove) store.delete(key);
        for (const [key, value] of put) store.put(value, key);
        transaction.oncomplete = () => {
          channel?.postMessage(null);
          resolve();
        };
        transaction.onabort = () => reject(transaction.error);
      });
    },
  };
}
