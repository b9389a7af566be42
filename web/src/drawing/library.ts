import type { LastWords } from './last_words';
import { isTaken, type Shelf } from './shelf';
import type { DrawingContent, StoredEntry, StoredModel } from './stored';

/*
 * Drawings on the shelf. Each key has one writer: who names a drawing does not write over who draws on it.
 *   drawing/<id>         Named: name, when it was made and deleted
 *   state/<id>           State: what the list says of its content
 *   content/<id>/model   StoredModel; embedding: its bake; entries: StoredEntry[];
 *                        stroke:<..>, curve:<..>: their parts; file: a whole DrawingContent instead of them
 *   last                 the id of the drawing that was open last
 */
export const contentKey = (id: string, part = ''): string => `content/${id}/${part}`;
export const stateKey = (id: string): string => `state/${id}`;
const nameKey = (id: string): string => `drawing/${id}`;
export const kLastKey = 'last';

export interface Named {
  name: string;
  /** Someone chose the name. */
  isOwn: boolean;
  created_ms: number;
  deleted_ms: number | null;
}

export interface State {
  strokes: number;
  changed_ms: number;
  model: string; // its title
}

/** A drawing in the list. */
export interface Listed extends Named, State {
  id: string;
}

export interface Stored {
  model: StoredModel;
  embedding: Uint8Array | null;
  entries: readonly StoredEntry[];
  parts: ReadonlyMap<string, unknown>; // by the entries' keys
  file: DrawingContent | null;
}

/** Deleted drawings can be brought back for this long; empty ones are kept for some time too. */
const kBin_ms = 7 * 24 * 3600e3, kEmpty_ms = 24 * 3600e3;

function entriesOf(given: unknown): StoredEntry[] {
  return Array.isArray(given) ? (given as (StoredEntry | null)[]).filter((entry) => typeof entry?.id === 'string') as StoredEntry[] : [];
}

let serial = 0;

export function newDrawingId(): string {
  serial += 1;
  return `${Date.now().toString(36)}-${serial}-${Math.floor(Math.random() * 36 ** 4).toString(36)}`;
}

/** The drawings of this browser, by name. */
export class Library {
  /** changed: the list is another one. */
  constructor(private readonly shelf: Shelf, private readonly changed: () => void = () => undefined) {}

  /** The last changed first. With the deleted ones that can be brought back. */
  async list(): Promise<Listed[]> {
    const [names, states] = await Promise.all([this.shelf.readAll('drawing/'), this.shelf.readAll('state/')]);
    const all: Listed[] = [];
    for (const [key, named] of names) {
      const id = key.slice('drawing/'.length);
      const state = (states.get(stateKey(id)) as State | undefined) ?? { strokes: 0, changed_ms: (named as Named).created_ms, model: '' };
      all.push({ id, ...(named as Named), ...state });
    }
    return all.sort((a, b) => b.changed_ms - a.changed_ms);
  }

  async read(id: string): Promise<Stored | null> {
    const all = await this.shelf.readAll(contentKey(id));
    const part = (name: string): unknown => all.get(contentKey(id, name));
    const model = part('model') as StoredModel | undefined;
    if (!model) return null;
    const parts = new Map([...all].map(([key, value]) => [key.slice(contentKey(id).length), value]));
    return {
      model, parts, embedding: (part('embedding') as Uint8Array | undefined) ?? null,
      entries: entriesOf(part('entries')), file: (part('file') as DrawingContent | undefined) ?? null,
    };
  }

  async modelOf(id: string): Promise<StoredModel | null> {
    return ((await this.shelf.read(contentKey(id, 'model'))) as StoredModel | undefined) ?? null;
  }

  async last(): Promise<string | null> {
    return ((await this.shelf.read(kLastKey)) as string | undefined) ?? null;
  }

  async named(id: string): Promise<Named | null> {
    return ((await this.shelf.read(nameKey(id))) as Named | undefined) ?? null;
  }

  /** What a new drawing writes of itself. */
  static entryOf(id: string, name: Pick<Named, 'name' | 'isOwn'>): [string, Named] {
    return [nameKey(id), { ...name, created_ms: Date.now(), deleted_ms: null }];
  }

  /** Writes what a page could not write any more, but for drawings that were kept since. */
  async heed(words: LastWords | null): Promise<void> {
    if (!words) return;
    const put = new Map(words.put), ids = new Set([...put.keys()].map((key) => key.split('/')[1]).filter((id) => id !== undefined));
    for (const id of ids) {
      const said = put.get(stateKey(id)) as State | undefined, kept = (await this.shelf.read(stateKey(id))) as State | undefined;
      if (!kept || (said && said.changed_ms > kept.changed_ms)) continue;
      for (const key of [...put.keys()]) if (isTaken(key, Library.keysOf(id))) put.delete(key);
      words.remove = words.remove.filter((key) => key.split('/')[1] !== id);
    }
    await this.shelf.write(put, words.remove);
  }

  async rename(id: string, name: string): Promise<void> {
    await this.change(id, { name, isOwn: true });
  }

  /** Out of the list; `bringBack` takes it in again. */
  async remove(id: string): Promise<void> {
    await this.change(id, { deleted_ms: Date.now() });
  }

  async bringBack(id: string): Promise<void> {
    await this.change(id, { deleted_ms: null });
  }

  /** Lets go of what was deleted long ago, and of drawings that nobody drew on or named. `isOpen`: in any tab. */
  async tidy(isOpen: (id: string) => Promise<boolean>): Promise<void> {
    const now = Date.now();
    for (const { id, strokes, isOwn, changed_ms, deleted_ms } of await this.list()) {
      const isGone = deleted_ms !== null && now - deleted_ms > kBin_ms;
      const isEmpty = strokes === 0 && !isOwn && now - changed_ms > kEmpty_ms;
      if ((isGone || isEmpty) && !(await isOpen(id))) await this.shelf.write(new Map(), Library.keysOf(id));
    }
  }

  /** Everything that a drawing has on the shelf. */
  static keysOf(id: string): string[] {
    return [nameKey(id), stateKey(id), contentKey(id)];
  }

  private async change(id: string, part: Partial<Named>): Promise<void> {
    const named = await this.named(id);
    if (!named) return;
    await this.shelf.write(new Map([[nameKey(id), { ...named, ...part }]]), []);
    this.changed();
  }
}
