import { Autosave, indexedDbShelf, type PutAway } from './drawing/autosave';
import { colorBytes, drawingContent, isDrawing, kDrawingEnding, keptCurves, readDrawing, readDrawingModel, writeDrawing } from './drawing/drawing_file';
import type { Core, CurveFormat } from './engine/core';
import { loadModel, warmLoader } from './engine/loader';
import { shapeModel } from './engine/model';
import { prepareEmbedding } from './engine/prepare';
import { Keyboard } from './input/keyboard';
import { PointerInput } from './input/pointer_input';
import { XrInput } from './input/xr_input';
import { Stage } from './scene/stage';
import { ThreeView } from './scene/three_view';
import { kDefaults, readSettings, settingsStorage, writeSettings } from './settings';
import { Studio, type LoadedModel, type ModelSource } from './studio';
import type { Actions } from './ui/actions';
import { buildInterface, shapeTitle, type Interface } from './ui/interface';

export const kFirstShape = 'hand';
const kMeshEndings = /\.(obj|ply|stl|off|glb|gltf)$/i;
const kOwnEndings = new RegExp(`\\.(mimicry|json)$|\\${kDrawingEnding}$`, 'i');
/** What models come with: it can be chosen together with them. */
const kCompanionEndings = '.bin,.mtl,.png,.jpg,.jpeg,.webp,.ktx2';

/** Everything on the page, put together. */
export class App implements Actions {
  readonly stage: Stage;
  readonly view: ThreeView;
  readonly studio: Studio;
  readonly pointer: PointerInput;
  readonly xr: XrInput;
  readonly ui: Interface;
  readonly autosave: Autosave;
  private saving = false; // not before the last drawing is back
  private away: PutAway | null = null;
  private loading: AbortController | null = null;
  private baking: AbortController | null = null;
  private readonly settings = settingsStorage();
  private readonly picker = document.createElement('input');

  constructor(private readonly core: Core, root: HTMLElement, canvas: HTMLCanvasElement, private readonly options: { antialias: boolean; embeddings: boolean }) {
    this.stage = new Stage(canvas, options.antialias);
    this.view = new ThreeView(this.stage);
    this.studio = new Studio(core, this.view, readSettings(this.settings));
    this.pointer = new PointerInput(canvas, this.stage, this.view, this.studio);
    this.xr = new XrInput(this.stage, this.view, this.studio);
    this.ui = buildInterface(root, this.studio, this);
    new Keyboard(canvas, this.stage, this.studio, this.pointer, this, () => this.ui.help.showModal());
    this.autosave = new Autosave(indexedDbShelf(), (sentence) => sentence && this.ui.messages.problem(sentence));
    this.stage.onFrame = (dt_s, time_ms, frame) => {
      if (frame) this.xr.update(time_ms, dt_s, frame);
      return frame !== null;
    };
    this.stage.onContext = (lost) => {
      this.pointer.release();
      if (lost) this.ui.messages.problem('The graphics driver was reset; the picture comes back by itself and the drawing is safe. If it does not, reload the page.');
    };
    this.stage.onResize = () => this.cover();
    this.xr.onNote = (sentence) => this.ui.messages.note(sentence);
    this.xr.onEnd = () => this.frameModel();
    this.follow();
    this.files(root);
  }

  /** Tells the camera what the controls leave free. */
  private cover(): void {
    const halves = document.getElementById('halves')!;
    this.stage.cover(document.getElementById('top')!.offsetHeight + 16 + (halves.hidden ? 0 : 40), document.getElementById('bottom')!.offsetHeight + 22);
  }

  /** Settings and drawing to where they are kept and shown. */
  private follow(): void {
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const theme = (): void => {
      const chosen = this.studio.settings.theme;
      const isDark = chosen === 'system' ? dark.matches : chosen === 'dark';
      document.documentElement.dataset['theme'] = isDark ? 'dark' : 'light';
      this.view.dark = isDark;
    };
    dark.addEventListener('change', theme);
    theme();
    this.studio.state.watch((now, before) => {
      if (now.settings !== before.settings || now === before) {
        if (now.settings.theme !== before.settings.theme) theme();
        this.view.pen.inkColor = now.settings.tool === 'draw' ? now.settings.style.color : '#8a8378';
        this.view.showMirror(now.settings.mirror);
        this.stage.split = now.settings.compare !== null;
        this.cover();
        writeSettings(this.settings, now.settings);
        this.stage.invalidate();
      }
      if (this.saving && (now.history.drawing !== before.history.drawing || now.model !== before.model)) this.save();
      if (before.drawing && !now.drawing && now.settings.mirror && now.history.drawing.length === before.history.drawing.length + 1) {
        this.ui.messages.note('The mirrored copy does not meet the model there.');
      }
      if (now.history.drawing.length > 0 && !now.settings.hintSeen) this.studio.set({ hintSeen: true });
    });
    // What is being drawn when the page goes away is kept.
    const leave = (): void => {
      if (document.visibilityState === 'hidden') this.pointer.release();
    };
    document.addEventListener('visibilitychange', leave);
    window.addEventListener('pagehide', () => this.pointer.release());
  }

  private save(): void {
    const { model, history } = this.studio.state.now;
    if (model && this.studio.target) this.autosave.save({ name: model.name, source: model.source }, this.studio.target, history.drawing);
  }

  /** The drawing of last time, or the first model. */
  async start(): Promise<void> {
    const shape = new URLSearchParams(location.search).get('shape');
    let restored = false, failed = false;
    try {
      this.setAway(await this.autosave.lastPutAway());
      const last = shape ? null : await this.autosave.lastModel();
      if (last) {
        restored = await this.restore(last.model.source, last.embedding);
      }
    } catch (error) {
      failed = true;
      this.ui.messages.problem(`The drawing of last time could not be opened (${sentence(error)}). Reload the page to try again; what you draw now takes its place.`);
    }
    if (!restored) this.show(shapeModel(this.core, this.core.shapes.some((s) => s.name === shape) ? shape! : kFirstShape));
    this.saving = true;
    if (!restored && !failed) this.save();
    warmLoader();
    void this.offerXr();
  }

  private async restore(source: ModelSource, embedding: Uint8Array | null): Promise<boolean> {
    const model = await this.modelOf(source);
    // A technique that needs the bake comes back with it.
    const { technique } = this.studio.settings;
    const resume = (): void => {
      if (this.studio.offers(technique) && this.studio.settings.technique === kDefaults.technique) this.studio.set({ technique });
    };
    this.show(model, false);
    if (embedding) {
      this.attempt(() => this.studio.addEmbedding(embedding, 'the prepared model'));
      resume();
    } else if ('shape' in source) {
      void this.fetchEmbedding(source.shape).then(resume);
    }
    this.studio.restore(await this.autosave.drawing(this.studio.target!, model.source));
    return true;
  }

  private async offerXr(): Promise<void> {
    const offered = async (mode: XRSessionMode): Promise<boolean> => {
      try {
        return (await navigator.xr?.isSessionSupported(mode)) ?? false;
      } catch {
        return false;
      }
    };
    const update = async (): Promise<void> => this.ui.showXr(await offered('immersive-vr'), await offered('immersive-ar'));
    navigator.xr?.addEventListener?.('devicechange', () => void update());
    await update();
  }

  // Models and files --------------------------------------------------------------------------

  private async modelOf(source: ModelSource): Promise<LoadedModel> {
    return 'shape' in source ? shapeModel(this.core, source.shape) : this.load(source.file, source.bytes);
  }

  private show(model: LoadedModel, fetchEmbedding = true): void {
    this.baking?.abort();
    this.studio.endStroke();
    const { model: before, history } = this.studio.state.now;
    const away = before && history.drawing.length > 0 ? { source: before.source, content: drawingContent(this.core, this.studio.target!, history.drawing) } : null;
    this.studio.open(model);
    if (away) {
      this.setAway(away);
      this.autosave.putAway(away);
      this.ui.messages.note(`The drawing on ${sourceTitle(away.source)} is put away; “Previous drawing” in the menu brings it back.`);
    }
    this.view.frame(this.studio.state.now.modelToWorld);
    if (fetchEmbedding && 'shape' in model.source) void this.fetchEmbedding(model.source.shape);
  }

  /** A built-in model's bake, if the server has it: after the first picture, when there is time. */
  private async fetchEmbedding(shape: string): Promise<void> {
    if (!this.options.embeddings || !__EMBEDDINGS__.includes(shape)) return;
    await new Promise((resolve) => ('requestIdleCallback' in window ? requestIdleCallback(resolve, { timeout: 3000 }) : setTimeout(resolve, 1000)));
    try {
      const response = await fetch(`embeddings/${shape}.mimicry`);
      if (!response.ok) return;
      const bytes = new Uint8Array(await response.arrayBuffer());
      const { model } = this.studio.state.now;
      if (this.studio.state.now.hasEmbedding || !model || !('shape' in model.source) || model.source.shape !== shape) return;
      await this.whenIdle();
      this.studio.addEmbedding(bytes, `${shape}.mimicry`);
    } catch {
      // Without it the techniques that need it wait for a bake.
    }
  }

  /** Between strokes. */
  private whenIdle(): Promise<void> {
    return new Promise((resolve) => {
      const stop = this.studio.state.watch((now) => {
        if (!now.drawing) queueMicrotask(() => { stop(); resolve(); });
      });
    });
  }

  openShape(name: string): void {
    this.attempt(() => {
      this.show(shapeModel(this.core, name));
      this.ui.messages.say(`${shapeTitle(name)} is open.`);
    });
  }

  /** The drawing that is put away; the open one takes its place. */
  openPrevious(): void {
    const { away } = this;
    if (!away) return;
    void (async () => {
      try {
        this.show(await this.modelOf(away.source));
        this.studio.restore(readDrawing(this.core, this.studio.target!, away.content, 'the previous drawing'));
        if (this.away !== away) return;
        this.setAway(null);
        this.autosave.putAway(null);
        this.save();
      } catch (error) {
        if (!(error instanceof DOMException && error.name === 'AbortError')) this.ui.messages.problem(sentence(error));
      }
    })();
  }

  private setAway(away: PutAway | null): void {
    this.away = away;
    this.ui.showPrevious(away && sourceTitle(away.source));
  }

  private files(root: HTMLElement): void {
    this.picker.type = 'file';
    this.picker.multiple = true;
    this.picker.hidden = true;
    this.picker.accept = `.obj,.ply,.stl,.off,.glb,.gltf,.mimicry,.json,${kDrawingEnding},${kCompanionEndings}`;
    this.picker.addEventListener('change', () => {
      this.openFiles(this.picker.files ?? []);
      this.picker.value = '';
    });
    root.append(this.picker);
    let depth = 0;
    window.addEventListener('dragenter', (event) => {
      event.preventDefault();
      depth += 1;
      this.ui.showDrop(true);
    });
    window.addEventListener('dragleave', () => {
      depth -= 1;
      if (depth <= 0) this.ui.showDrop(false);
    });
    window.addEventListener('dragover', (event) => event.preventDefault());
    window.addEventListener('drop', (event) => {
      event.preventDefault();
      depth = 0;
      this.ui.showDrop(false);
      if (event.dataTransfer) this.openFiles(event.dataTransfer.files);
    });
  }

  chooseFiles(): void {
    this.picker.click();
  }

  openFiles(given: Iterable<File>): void {
    // Models first: strokes and bakes that come along belong on them. Buffers and textures go with them.
    const rank = (file: File): number => (kMeshEndings.test(file.name) ? 0 : 1);
    const files = [...given].sort((a, b) => rank(a) - rank(b));
    const hasModel = files.some((file) => kMeshEndings.test(file.name));
    const beside = hasModel ? files.filter((file) => !kMeshEndings.test(file.name) && !kOwnEndings.test(file.name)) : [];
    void (async () => {
      for (const file of files.filter((f) => !beside.includes(f))) {
        try {
          await this.openFile(file, beside);
        } catch (error) {
          if (!(error instanceof DOMException && error.name === 'AbortError')) this.ui.messages.problem(sentence(error));
        }
      }
    })();
  }

  private async openFile(file: File, beside: readonly File[]): Promise<void> {
    if (kMeshEndings.test(file.name)) {
      const model = await this.load(file.name, file, beside);
      this.show(model);
      this.ui.messages.say(`${file.name} is open.`);
      return;
    }
    if (file.size > 1e9) throw new Error(`${file.name}: ${(file.size / 1e9).toFixed(1)} GB is more than a browser can hold; split it`);
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.mimicry$/i.test(file.name)) {
      this.studio.addEmbedding(bytes, file.name);
      this.autosave.saveEmbedding(bytes);
      this.ui.messages.note('The model is prepared: all techniques work on it.');
    } else if (isDrawing(bytes)) {
      const { source, rest } = readDrawingModel(bytes, file.name);
      if ('shape' in source && !this.core.shapes.some((s) => s.name === source.shape)) {
        throw new Error(`${file.name}: a drawing on “${source.shape}”, a model that this page does not have; reload it to get a newer page`);
      }
      this.show(await this.modelOf(source));
      this.studio.restore(readDrawing(this.core, this.studio.target!, rest, file.name));
    } else if (/\.json$/i.test(file.name)) {
      const strokes = this.core.readStrokes(bytes, file.name, (what) => this.ui.messages.note(`Left out: ${what}`));
      const drawn = this.studio.importStrokes(strokes);
      this.ui.messages.note(drawn === strokes.length ? `${plural(drawn, 'stroke')} drawn.` : `${drawn} of ${plural(strokes.length, 'stroke')} drawn; the others do not meet this model.`);
    } else {
      throw new Error(`${file.name}: not a kind of file that the studio opens; it takes models (OBJ, PLY, STL, OFF, GLB), drawings, recorded strokes (JSON) and .mimicry files`);
    }
  }

  private async load(name: string, content: Blob | Uint8Array, beside: readonly File[] = []): Promise<LoadedModel> {
    this.loading?.abort();
    const controller = (this.loading = new AbortController());
    const work = this.ui.messages.work(`Reading ${name}`, () => controller.abort());
    try {
      return await loadModel(name, content, beside, (stage, fraction) => work.progress(stage, fraction), controller.signal);
    } finally {
      work.done();
    }
  }

  saveDrawing(): void {
    const { model, history } = this.studio.state.now;
    if (!model || history.drawing.length === 0) return;
    this.attempt(() => this.download(writeDrawing(this.core, this.studio.target!, model.source, history.drawing), kDrawingEnding));
  }

  exportCurves(format: CurveFormat): void {
    this.attempt(() => {
      const { curves, styles } = keptCurves(this.studio.state.now.history.drawing);
      try {
        this.download(this.studio.target!.writeCurves(curves, format, colorBytes(styles)), `-curves.${format}`);
      } finally {
        for (const curve of curves) curve.dispose();
      }
    });
  }

  exportStrokes(): void {
    this.attempt(() => this.download(this.core.writeStrokes(this.studio.state.now.history.drawing.map((drawn) => drawn.stroke)), '-strokes.json'));
  }

  private download(bytes: Uint8Array, ending: string): void {
    const name = this.studio.state.now.model!.name.replace(/\.[^.]+$/, '').replace(/[^\w-]+/g, '-') || 'drawing';
    const url = URL.createObjectURL(new Blob([bytes as Uint8Array<ArrayBuffer>]));
    const link = document.createElement('a');
    link.href = url;
    link.download = name + ending;
    link.click();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
    this.ui.messages.say(`${link.download} is saved.`);
  }

  // Edits and view ----------------------------------------------------------------------------

  undo(): void {
    const label = this.studio.state.now.history.past.at(-1)?.label;
    this.pointer.release();
    this.studio.undo();
    if (label) this.ui.messages.say(`Undone: ${label}.`);
  }

  redo(): void {
    const label = this.studio.state.now.history.future[0]?.label;
    this.pointer.release();
    this.studio.redo();
    if (label) this.ui.messages.say(`Done again: ${label}.`);
  }

  clear(): void {
    this.studio.clear();
    this.ui.messages.note('The drawing is cleared; undo brings it back.');
  }

  redrawLast(): void {
    this.attempt(() => this.studio.redrawLast(this.studio.settings.technique));
  }

  frameModel(): void {
    if (this.studio.target) this.view.frame(this.studio.state.now.modelToWorld);
  }

  bake(): void {
    const { mesh } = this.studio;
    if (!mesh || this.baking) return;
    document.getElementById('techniques')?.hidePopover();
    const controller = (this.baking = new AbortController());
    const model = this.studio.state.now.model;
    const work = this.ui.messages.work('Preparing the model', () => controller.abort());
    void (async () => {
      try {
        const bytes = await prepareEmbedding(mesh, model!.source, controller.signal, (stage, fraction) => work.progress(`Preparing the model: ${stage}`, fraction));
        if (this.studio.state.now.model !== model) return;
        await this.whenIdle();
        this.studio.addEmbedding(bytes, 'the prepared model');
        this.autosave.saveEmbedding(bytes);
        this.ui.messages.note('The model is prepared: all techniques work on it now.');
      } catch (error) {
        if (!controller.signal.aborted) this.ui.messages.problem(sentence(error));
      } finally {
        work.done();
        this.baking = null;
      }
    })();
  }

  enterXr(mode: 'immersive-vr' | 'immersive-ar'): void {
    void this.xr.enter(mode).catch((error: unknown) => this.ui.messages.problem(sentence(error)));
  }

  private attempt(act: () => void): void {
    try {
      act();
    } catch (error) {
      this.ui.messages.problem(sentence(error));
    }
  }
}

function sentence(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

function sourceTitle(source: ModelSource): string {
  return 'shape' in source ? shapeTitle(source.shape) : source.file;
}

function plural(n: number, noun: string): string {
  return `${n} ${noun}${n === 1 ? '' : 's'}`;
}
