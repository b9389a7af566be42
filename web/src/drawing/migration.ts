import type { ModelSource } from '../engine/loaded_model';
import { contentKey, Library, newDrawingId, stateKey, type Stored } from './library';
import { done, openDatabase, type Shelf } from './shelf';
import type { StoredEntry, StoredModel, DrawingContent } from './stored';

/** Before drawings had names the browser kept the open one, and one that was put away, in this database. */
const kOldName = 'mimicry-studio';

/**
 * Brings what earlier pages kept into the shelf, as drawings of their own. Returns the id of the one that
 * was open; null: there was nothing. What an earlier page in another tab writes later comes the next time.
 */
export async function migrate(shelf: Shelf, titleOf: (source: ModelSource) => string, name = kOldName): Promise<string | null> {
  if (!(await exists(name))) return null;
  const db = await openDatabase(name);
  try {
    const store = db.transaction('shelf').objectStore('shelf');
    const [keys, values] = await Promise.all([done(store.getAllKeys()), done(store.getAll())]);
    const old = new Map(keys.map((key, i) => [String(key), values[i] as unknown]));
    const put = new Map<string, unknown>();
    const away = old.get('away') as { source: ModelSource; content: DrawingContent } | null | undefined;
    if (away?.source && Array.isArray(away.content?.entries)) add(put, titleOf(away.source), { model: { name: '', source: away.source }, file: away.content }, away.content.entries.length);
    const model = old.get('model') as StoredModel | undefined;
    let open: string | null = null;
    if (model?.source) {
      const given = old.get('entries'), entries = Array.isArray(given) ? given as StoredEntry[] : [];
      open = add(put, titleOf(model.source), { model, entries, embedding: (old.get('embedding') as Uint8Array | undefined) ?? null }, entries.length, old);
    }
    if (put.size > 0) await shelf.write(put, []);
    // Only now: nothing is lost if the page ends before.
    const clearing = db.transaction('shelf', 'readwrite');
    clearing.objectStore('shelf').clear();
    await new Promise<void>((resolve, reject) => {
      clearing.oncomplete = () => resolve();
      clearing.onabort = () => reject(clearing.error);
    });
    // A page of then that is still open writes all of its drawing with its next save.
    if ('BroadcastChannel' in globalThis) {
      const channel = new BroadcastChannel(name);
      channel.postMessage(null);
      channel.close();
    }
    return open;
  } finally {
    db.close();
  }
}

function add(put: Map<string, unknown>, title: string, stored: Partial<Stored>, strokes: number, parts?: ReadonlyMap<string, unknown>): string {
  const id = newDrawingId();
  const taken = new Set([...put.values()].map((value) => (value as { name?: string } | null)?.name));
  const [key, named] = Library.entryOf(id, { name: taken.has(title) ? `${title} 2` : title, isOwn: false });
  put.set(key, named);
  put.set(stateKey(id), { strokes, changed_ms: Date.now(), model: title });
  for (const part of ['model', 'entries', 'embedding', 'file'] as const) if (stored[part]) put.set(contentKey(id, part), stored[part]);
  for (const { strokeKey, curveKey } of stored.entries ?? []) {
    for (const part of [strokeKey, curveKey]) if (parts?.has(part)) put.set(contentKey(id, part), parts.get(part));
  }
  return id;
}

async function exists(name: string): Promise<boolean> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(name);
    request.onupgradeneeded = () => request.transaction!.abort(); // it was not there, and is not made
    request.onsuccess = () => {
      const has = request.result.objectStoreNames.contains('shelf');
      request.result.close();
      resolve(has);
    };
    request.onerror = () => (request.error?.name === 'AbortError' ? resolve(false) : reject(request.error));
  });
}
