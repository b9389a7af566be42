/** Keys and values that outlast the page. Keys are paths: `drawing/<id>`, `content/<id>/entries` and so on (drawing/library.ts). */
export interface Shelf {
  read(key: string): Promise<unknown>;
  /** All whose keys begin so, by key, in one look. */
  readAll(prefix: string): Promise<Map<string, unknown>>;
  /** All or nothing; removes first. remove: keys, and prefixes that end in `/`. */
  write(put: ReadonlyMap<string, unknown>, remove: readonly string[]): Promise<void>;
}

const kStore = 'shelf';

export function openDatabase(name: string): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(name, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(kStore);
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** A shelf in IndexedDB, opened when it is first needed. */
export function indexedDbShelf(name = 'mimicry-drawings'): Shelf {
  let opened: Promise<IDBDatabase> | null = null;
  const open = (): Promise<IDBDatabase> => {
    opened ??= openDatabase(name).then((db) => {
      // A newer page wants to change it, or the browser closed it (its data were cleared, a disk failed): the next use opens it again.
      db.onversionchange = () => {
        db.close();
        opened = null;
      };
      db.onclose = () => (opened = null);
      return db;
    });
    opened.catch(() => (opened = null));
    return opened;
  };
  return {
    async read(key) {
      return done((await open()).transaction(kStore).objectStore(kStore).get(key));
    },
    async readAll(prefix) {
      const store = (await open()).transaction(kStore).objectStore(kStore);
      const [keys, values] = await Promise.all([done(store.getAllKeys(beginning(prefix))), done(store.getAll(beginning(prefix)))]);
      return new Map(keys.map((key, i) => [String(key), values[i]]));
    },
    async write(put, remove) {
      const transaction = (await open()).transaction(kStore, 'readwrite');
      const store = transaction.objectStore(kStore);
      for (const key of remove) store.delete(key.endsWith('/') ? beginning(key) : key);
      for (const [key, value] of put) store.put(value, key);
      await new Promise<void>((resolve, reject) => {
        transaction.oncomplete = () => resolve();
        transaction.onabort = () => reject(transaction.error);
      });
    },
  };
}

export function done<T>(request: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

function beginning(prefix: string): IDBKeyRange {
  return IDBKeyRange.bound(prefix, `${prefix}\uffff`);
}

/** A shelf in memory: tests, and what waits for storage. */
export class MemoryShelf implements Shelf {
  readonly items = new Map<string, unknown>();

  read(key: string): Promise<unknown> {
    return Promise.resolve(this.items.get(key));
  }

  readAll(prefix: string): Promise<Map<string, unknown>> {
    return Promise.resolve(new Map([...this.items].filter(([key]) => key.startsWith(prefix))));
  }

  write(put: ReadonlyMap<string, unknown>, remove: readonly string[]): Promise<void> {
    for (const gone of remove) for (const key of [...this.items.keys()]) if (isTaken(key, [gone])) this.items.delete(key);
    for (const [key, value] of put) this.items.set(key, value);
    return Promise.resolve();
  }
}

/**
 * Nothing that is written gets lost while the page is open: what the storage refuses stays in memory,
 * is read from there, and goes along with the next write.
 */
export class PatientShelf implements Shelf {
  private readonly held = new Map<string, unknown>();
  private readonly gone = new Set<string>();

  constructor(private readonly inner: Shelf) {}

  /** The storage refused something, which is in memory only. */
  isWaiting = false;

  async read(key: string): Promise<unknown> {
    if (this.held.has(key)) return this.held.get(key);
    return isTaken(key, this.gone) ? undefined : this.inner.read(key);
  }

  async readAll(prefix: string): Promise<Map<string, unknown>> {
    const held = [...this.held].filter(([key]) => key.startsWith(prefix));
    let kept: Map<string, unknown>;
    try {
      kept = await this.inner.readAll(prefix);
    } catch (error) {
      if (held.length === 0) throw error;
      kept = new Map();
    }
    return new Map([...[...kept].filter(([key]) => !isTaken(key, this.gone)), ...held]);
  }

  async write(put: ReadonlyMap<string, unknown>, remove: readonly string[]): Promise<void> {
    for (const gone of remove) {
      this.gone.add(gone);
      for (const key of [...this.held.keys()]) if (isTaken(key, [gone])) this.held.delete(key);
    }
    for (const [key, value] of put) this.held.set(key, value);
    const now = new Map(this.held), without = [...this.gone];
    try {
      await this.inner.write(now, without);
    } catch (error) {
      this.isWaiting = true;
      throw error;
    }
    this.isWaiting = false;
    for (const [key, value] of now) if (this.held.get(key) === value) this.held.delete(key);
    for (const key of without) this.gone.delete(key);
  }
}

/** Whether it is among keys, and prefixes that end in `/`. */
export function isTaken(key: string, removed: Iterable<string>): boolean {
  for (const gone of removed) if (gone.endsWith('/') ? key.startsWith(gone) : key === gone) return true;
  return false;
}
