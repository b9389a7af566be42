import { Store } from '../base/store';
import { sentence } from '../base/text';
import { Autosave } from '../drawing/autosave';
import type { Drawing } from '../drawing/document';
import { readDrawing } from '../drawing/drawing_file';
import { forgetLastWords, lastWords } from '../drawing/last_words';
import { Library, newDrawingId, type Listed, type Named, type Stored } from '../drawing/library';
import { migrate } from '../drawing/migration';
import { recover, type Part, type Recovered } from '../drawing/recover';
import { indexedDbShelf, PatientShelf } from '../drawing/shelf';
import type { DrawingContent, StoredEntry, StoredModel } from '../drawing/stored';
import { Claims, Tabs, type Claim } from '../drawing/tabs';
import type { Curve, RecordedStroke, Target } from '../engine/core';
import { modelTitle, type LoadedModel, type ModelSource } from '../engine/loaded_model';
import type { Companions } from '../engine/loader';
import { kAsIs } from '../engine/up_axis';
import { kDefaults } from './settings';
import type { Studio, StudioState } from './studio';

/** The drawing that is open. */
export interface OpenDocument {
  id: string;
  name: string;
  isOwn: boolean; // someone chose the name
  /** This tab keeps it. False: another tab draws on it, and this one follows. */
  writes: boolean;
}

/** What the drawings need of the page around them. */
export interface Host {
  modelOf(source: ModelSource, companions: Companions): Promise<LoadedModel>;
  /** Another model is shown. Resolves when its bake is there, where the page brings one. */
  shown(model: LoadedModel, hasBake: boolean): Promise<void>;
  note(sentence: string): void;
  problem(sentence: string): void;
  /** Saving fails; null: it works. */
  unsaved(sentence: string | null): void;
}

const kTabKey = 'mimicry-drawing';

/** The drawings of this browser, and which one is open in this tab. Everything is checked before anything is replaced. */
export class Documents {
  readonly open = new Store<OpenDocument | null>(null);
  /** Counts up when the list is another one. */
  readonly listed = new Store(0);
  readonly library: Library;
  readonly autosave: Autosave;
  private readonly shelf = new PatientShelf(indexedDbShelf());
  private readonly tabs = new Tabs();
  private readonly claims = new Claims(this.tabs);
  private claim: Claim | null = null;
  private names = new Set<string>();
  private isSwitching = false;
  private keptEntries: readonly StoredEntry[] = [];
  private readonly keptCurves = new Map<string, Curve>(); // of the drawing that is followed, by key
  private askedToPersist = false;

  constructor(private readonly studio: Studio, private readonly host: Host) {
    this.library = new Library(this.shelf, () => {
      this.tabs.tell({ listed: true });
      this.listed.set(this.listed.now + 1);
    });
    this.autosave = new Autosave(this.shelf, (sentence) => this.host.unsaved(sentence), (ids) => this.tabs.tell({ saved: ids }));
    studio.state.watch((now, before) => this.changed(now, before));
    this.tabs.listen((word) => {
      if ('listed' in word) void this.heardOfList();
      if ('saved' in word && word.saved.includes(this.open.now?.id ?? '')) void this.follow();
    });
    addEventListener('beforeunload', (event) => {
      if (this.shelf.isWaiting && this.studio.state.now.history.drawing.length > 0) event.preventDefault();
    });
  }

  /**
   * The drawing that this tab had, or the last one; of a built-in model, where one is asked for. False: there is none that can be
   * opened.
   */
  async start(shape: string | null = null): Promise<boolean> {
    let id: string | null = null;
    try {
      id = await migrate(this.shelf, modelTitle);
      await this.library.heed(lastWords());
      forgetLastWords();
      if (shape !== null) id = await this.latestOn(shape);
      else id ??= tabDrawing() ?? (await this.library.last());
      this.names = new Set((await this.library.list()).map((drawing) => drawing.name));
      if (!id || !(await this.library.named(id))) return false;
    } catch (error) {
      // Storage that is denied is told of when the first drawing cannot be kept.
      if (!(error instanceof DOMException)) this.host.problem(sentence(error));
      return false;
    }
    try {
      await this.openKept(id);
      void this.library.tidy((other) => this.claims.isHeld(other)).catch(() => undefined);
      return true;
    } catch (error) {
      this.host.problem(`The drawing of last time could not be opened (${sentence(error)}). It stays in the list of drawings; reload the page to try again.`);
      return false;
    }
  }

  /** The drawing on a built-in model that this tab had, or the latest one. */
  private async latestOn(shape: string): Promise<string | null> {
    const own = tabDrawing(), title = modelTitle({ shape });
    // What nobody drew on yet says no model in the list.
    const list = (await this.library.list()).filter(({ deleted_ms, model }) => deleted_ms === null && (model === title || model === ''));
    for (const { id, strokes, isOwn } of [...list.filter((d) => d.id === own), ...list.filter((d) => d.id !== own)]) {
      const source = (await this.library.modelOf(id))?.source;
      if (!source || !('shape' in source) || source.shape !== shape) continue;
      // Another tab's empty one is no drawing to follow.
      if (strokes > 0 || isOwn || id === own || !(await this.claims.isHeld(id))) return id;
    }
    return null;
  }

  async list(): Promise<Listed[]> {
    const list = await this.library.list();
    this.names = new Set(list.map((drawing) => drawing.name));
    return list.filter(({ id, strokes, isOwn }) => strokes > 0 || isOwn || id === this.open.now?.id);
  }

  /** A new drawing on a model. */
  openModel(model: LoadedModel): void {
    this.leave();
    this.show(model, [], model.turn);
    this.begin(modelTitle(model.source), this.storedModel()!);
    void this.host.shown(model, false);
  }

  /** A new, empty drawing on the model that is open. */
  fresh(): void {
    const { model } = this.studio.state.now;
    if (!model) return;
    const before = this.open.now;
    this.leave();
    this.quietly(() => this.studio.restore([]));
    this.begin(modelTitle(model.source), this.storedModel()!);
    if (before) void this.copyBake(before.id);
  }

  /** A drawing of the list. Rejects where it cannot be opened: the open one stays. */
  async openKept(id: string): Promise<void> {
    if (id === this.open.now?.id) return;
    await this.autosave.settled();
    const [named, stored] = await Promise.all([this.library.named(id), this.library.read(id)]);
    if (!named || !stored) throw new Error('that drawing is not in this browser any more');
    // The worker reads its curves: of many strokes that takes long.
    const files = stored.entries.map((entry) => stored.parts.get(entry.curveKey) as Uint8Array);
    const model = await this.host.modelOf(stored.model.source, {
      embedding: stored.embedding && { name: 'the prepared model', bytes: stored.embedding }, curves: files,
    });
    const read = new Map(stored.entries.map((entry, i) => [entry.curveKey, model.made.curves[i] ?? null]));
    let recovered: Recovered;
    try {
      recovered = this.content(model.made.target, stored, named, read);
    } catch (error) {
      model.made.target.dispose();
      throw error;
    }
    const claim = await this.claims.claim(id, () => void this.freed(id));
    const { technique } = this.studio.settings;
    this.leave();
    this.show(model, recovered.drawing, stored.model.turn);
    this.take(claim, { id, name: named.name, isOwn: named.isOwn, writes: claim.isMine });
    if (claim.isMine) this.autosave.resume(id, modelTitle(model.source), stored.entries);
    else this.autosave.pause();
    this.remember(stored.entries, recovered.drawing);
    for (const remark of recovered.remarks) this.host.problem(remark);
    if (model.made.unusable) this.host.problem(model.made.unusable);
    // A technique that needs the bake comes back with it.
    const resume = (): void => {
      if (this.studio.offers(technique) && this.studio.settings.technique === kDefaults.technique) this.studio.set({ technique });
    };
    resume();
    void this.host.shown(model, this.studio.state.now.hasEmbedding).then(resume);
  }

  /** A drawing of a file, as a new one in the list. Throws where it cannot be read: the open one stays. */
  openContent(model: LoadedModel, stored: StoredModel, content: DrawingContent, title: string | null, fileName: string): void {
    const { target } = model.made;
    let recovered: Recovered;
    try {
      recovered = readDrawing(this.studio.core, target, content, fileName);
    } catch (error) {
      target.dispose();
      throw error;
    }
    this.leave();
    this.show(model, recovered.drawing, stored.turn);
    this.begin(title ?? modelTitle(model.source), this.storedModel()!, title !== null);
    this.autosave.save(this.studio.target!, recovered.drawing);
    for (const remark of recovered.remarks) this.host.problem(remark);
    void this.host.shown(model, false);
  }

  async rename(id: string, name: string): Promise<void> {
    const now = this.open.now;
    if (now?.id === id) this.open.set({ ...now, name, isOwn: true });
    await this.autosave.settled();
    await this.library.rename(id, name);
  }

  /** Out of the list; resolves with what takes it back. Rejects where another tab has it open. */
  async remove(id: string): Promise<() => Promise<void>> {
    const wasOpen = this.open.now?.id === id;
    if (!(wasOpen && this.open.now?.writes) && (await this.claims.isHeld(id))) throw new Error('That drawing is open in another tab; close that tab first.');
    await this.autosave.settled();
    await this.library.remove(id); // before other tabs that show it hear that this one has left
    if (wasOpen) this.fresh();
    return async () => {
      await this.library.bringBack(id);
      if (wasOpen) await this.openKept(id);
    };
  }

  /** This tab goes on with a copy of what it shows. */
  copy(): void {
    const before = this.open.now, { model, history } = this.studio.state.now;
    if (!before || !model) return;
    this.claim?.release();
    this.begin(`${before.name} (copy)`, this.storedModel()!);
    this.autosave.save(this.studio.target!, history.drawing);
    void this.copyBake(before.id);
    this.host.note(`You draw on a copy, “${this.open.now!.name}”. The other tab keeps “${before.name}”.`);
  }

  // Inside ------------------------------------------------------------------------------------

  private changed(now: StudioState, before: StudioState): void {
    if (this.isSwitching || !this.open.now) return;
    if (now.turn !== before.turn) {
      if (!this.open.now.writes) return this.copy();
      this.autosave.saveModel(this.storedModel()!);
    }
    if (now.history.drawing === before.history.drawing) return;
    if (!this.open.now.writes) return this.copy();
    this.autosave.save(this.studio.target!, now.history.drawing);
    if (this.askedToPersist) return;
    this.askedToPersist = true;
    void navigator.storage?.persist?.().catch(() => false);
  }

  /** What is drawn belongs to the drawing that is open no more; an empty one nobody named is let go of. */
  private leave(): void {
    this.studio.endStroke();
    const before = this.open.now;
    const { claim } = this;
    if (before?.writes && !before.isOwn && this.studio.state.now.history.drawing.length === 0) {
      this.autosave.discard(before.id);
      void this.autosave.settled().then(() => claim?.release()); // who follows it sees that it is gone
    } else {
      claim?.release();
    }
    this.claim = null;
    this.open.set(null);
    this.keptCurves.clear();
  }

  private show(model: LoadedModel, drawing: Drawing, turn: readonly number[] = kAsIs): void {
    this.quietly(() => {
      this.studio.open(model, turn);
      this.studio.restore(drawing);
    });
  }

  /** The model that is open, as it is kept. */
  storedModel(): StoredModel | null {
    const { model, turn } = this.studio.state.now;
    return model && { name: model.name, source: model.source, turn: [...turn] };
  }

  private begin(title: string, model: StoredModel, isOwn = false): void {
    let name = title;
    for (let k = 2; this.names.has(name); k += 1) name = `${title} ${k}`;
    this.names.add(name);
    const id = newDrawingId();
    this.autosave.begin(id, { name, isOwn }, model, modelTitle(model.source));
    this.take(null, { id, name, isOwn, writes: true });
    void this.claims.claim(id, () => undefined).then((claim) => {
      if (this.open.now?.id === id) this.claim = claim;
      else claim.release();
    });
  }

  private take(claim: Claim | null, open: OpenDocument): void {
    this.claim = claim;
    this.open.set(open);
    this.listed.set(this.listed.now + 1);
    try {
      sessionStorage.setItem(kTabKey, open.id);
    } catch {
      // Where it is denied the last drawing of all tabs is opened.
    }
  }

  private async copyBake(from: string): Promise<void> {
    const { id } = this.open.now!;
    const stored = await this.library.read(from).catch(() => null);
    if (stored?.embedding && this.open.now?.id === id) this.autosave.saveEmbedding(stored.embedding);
  }

  /** The other tab saved: this one shows the same. */
  private async follow(): Promise<void> {
    const { open } = this;
    if (!open.now || open.now.writes || this.studio.isDrawing) return;
    const { id } = open.now;
    const stored = await this.library.read(id).catch(() => null);
    if (!stored || open.now?.id !== id || open.now.writes || this.studio.isDrawing) return;
    const { drawing } = this.content(this.studio.target!, stored, open.now);
    this.remember(stored.entries, drawing);
    const { turn } = stored.model, now = this.studio.state.now.turn;
    this.quietly(() => {
      if (turn?.some((x, k) => x !== now[k])) this.studio.standAs(turn);
      this.studio.restore(drawing);
    });
  }

  /** The tab that wrote has gone: this one writes, or goes on with a drawing of its own where that one is no more. */
  private async freed(id: string): Promise<void> {
    const words = lastWords();
    if (words) await this.library.heed(words).then(forgetLastWords, () => undefined);
    const named = await this.library.named(id).catch(() => null);
    await this.follow();
    const now = this.open.now;
    if (now?.id !== id || now.writes) return;
    // A stroke that is under way goes into a copy: what the other tab did last was not looked at.
    if (this.studio.isDrawing) return;
    if (!named || named.deleted_ms !== null) {
      this.claim?.release();
      if (!named) this.names.delete(now.name);
      this.begin(now.name, this.storedModel()!, now.isOwn);
      const { drawing } = this.studio.state.now.history;
      if (drawing.length > 0) this.autosave.save(this.studio.target!, drawing);
      if (named) this.host.note(`“${now.name}” was deleted in another tab. Here it goes on as “${this.open.now!.name}”.`);
      return;
    }
    this.autosave.resume(id, modelTitle(this.studio.state.now.model!.source), this.keptEntries);
    this.open.set({ ...now, writes: true });
  }

  private async heardOfList(): Promise<void> {
    this.listed.set(this.listed.now + 1);
    const now = this.open.now;
    const named = now && (await this.library.named(now.id).catch(() => null));
    if (named && this.open.now?.id === now.id && named.name !== this.open.now.name) this.open.set({ ...this.open.now, name: named.name, isOwn: named.isOwn });
  }

  /** read: its curves by key, where they were read before; null: they cannot be. */
  private content(target: Target, stored: Stored, { name }: Pick<Named, 'name'>, read: ReadonlyMap<string, Curve | null> = this.keptCurves): Recovered {
    if (stored.file) return readDrawing(this.studio.core, target, stored.file, name);
    const parts = stored.entries.map((entry): Part => ({
      ...entry,
      stroke: (stored.parts.get(entry.strokeKey) as RecordedStroke | undefined) ?? null,
      curve: () => {
        const curve = read.get(entry.curveKey) ?? target.readCurves(stored.parts.get(entry.curveKey) as Uint8Array, entry.id)[0]!;
        this.autosave.isKept(curve, entry.curveKey);
        return curve;
      },
    }));
    return recover(target, parts, name);
  }

  /** What the drawing's curves are kept under: those that stay are not read again where it is followed. */
  private remember(entries: readonly StoredEntry[], drawing: Drawing): void {
    this.keptEntries = entries;
    this.keptCurves.clear();
    const byId = new Map(drawing.map((drawn) => [drawn.id, drawn.curve]));
    for (const { id, curveKey } of entries) {
      const curve = byId.get(id);
      if (curve) this.keptCurves.set(curveKey, curve);
    }
  }

  private quietly(act: () => void): void {
    this.isSwitching = true;
    try {
      act();
    } finally {
      this.isSwitching = false;
    }
  }
}

function tabDrawing(): string | null {
  try {
    return sessionStorage.getItem(kTabKey);
  } catch {
    return null;
  }
}
