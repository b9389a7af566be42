import { sentence } from '../base/text';
import type { Autosave } from '../drawing/autosave';
import type { Core, CurveFormat } from '../engine/core';
import { kEmbeddings } from '../engine/embeddings';
import { shapeTitle, type ModelSource } from '../engine/loaded_model';
import { Loader } from '../engine/loader';
import { shapeModel } from '../engine/model';
import { prepareEmbedding } from '../engine/prepare';
import { littleInk } from '../engine/techniques';
import { Keyboard } from '../input/keyboard';
import { PointerInput } from '../input/pointer_input';
import { XrInput } from '../input/xr_input';
import type { Stage } from '../scene/stage';
import { ThreeView } from '../scene/three_view';
import type { Actions } from '../studio/actions';
import { Documents } from '../studio/documents';
import { readSettings, settingsStorage, writeSettings } from '../studio/settings';
import { Studio } from '../studio/studio';
import { Tools } from '../tools/tools';
import { drawingsPanel } from '../ui/drawings_panel';
import { buildInterface, type Interface } from '../ui/interface';
import { speakStrokes } from '../ui/spoken';
import { followTabs } from '../ui/tab_notes';
import { Files } from './files';

export const kFirstShape = 'hand';
/** The pen's marks where its tool has no colour. */
const kNoInk = '#8a8378';
/** Between the controls and the model. */
const kGap_px = 4;

/** Everything on the page, put together. */
export class App implements Actions {
  readonly view: ThreeView;
  readonly studio: Studio;
  readonly tools: Tools;
  readonly pointer: PointerInput;
  readonly xr: XrInput;
  readonly ui: Interface;
  readonly documents: Documents;
  readonly files: Files;
  private baking: AbortController | null = null;
  private readonly settings = settingsStorage();

  constructor(private readonly core: Core, root: HTMLElement, canvas: HTMLCanvasElement, readonly stage: Stage, private readonly embeddings: boolean) {
    const loader = new Loader(core);
    loader.warm();
    this.view = new ThreeView(this.stage);
    this.studio = new Studio(core, this.view, readSettings(this.settings));
    this.tools = new Tools(this.studio);
    this.pointer = new PointerInput(canvas, this.stage, this.view, this.studio, this.tools);
    this.xr = new XrInput(this.stage, this.view, this.studio, this.tools);
    this.ui = buildInterface(root, this.studio, this.tools, this);
    new Keyboard(canvas, this.stage, this.studio, this.tools, this.pointer, this, () => this.ui.help.showModal());
    const { messages } = this.ui;
    let closeWarning = (): void => undefined;
    this.documents = new Documents(this.studio, {
      modelOf: (source, companions) => this.files.modelOf(source, companions),
      shown: (model, hasBake) => this.shown(model.source, hasBake),
      note: (text) => messages.note(text),
      problem: (text) => messages.problem(text),
      unsaved: (text) => {
        closeWarning();
        if (text) closeWarning = messages.problem(text, { title: 'Save to a file', act: () => this.saveDrawing() });
      },
    });
    this.files = new Files(root, this.studio, this.documents, this.ui, loader, (axis) => this.turnModel(axis));
    root.append(drawingsPanel(this.documents, messages));
    followTabs(this.documents, messages);
    speakStrokes(this.studio, messages);
    this.stage.onFrame = (dt_s, time_ms, frame) => {
      if (frame) this.xr.update(time_ms, dt_s, frame);
      return frame !== null;
    };
    // Ink is computed beside the graphics: a stroke goes on, and is seen when they are back.
    this.stage.onContext = (lost) => {
      if (lost) this.ui.messages.problem('The graphics driver was reset; the picture comes back by itself and the drawing is safe. If it does not, reload the page.');
    };
    this.pointer.onUndo = () => this.undo();
    this.pointer.onRedo = () => this.redo();
    this.pointer.pen.onLittleInk = (technique) => this.ui.messages.note(littleInk(this.studio.technique(technique)));
    this.stage.onResize = () => {
      this.cover(true);
      this.fit();
    };
    this.xr.onNote = (sentence) => this.ui.messages.note(sentence);
    this.xr.onEnd = () => this.ui.messages.say('You left the headset; everything is kept.');
    this.follow();
  }

  get autosave(): Autosave {
    return this.documents.autosave;
  }

  /** What the hint covered when the view was framed: it goes with the first stroke, and the model stays where it is. */
  private hintBottom = 0;

  /** Tells the camera what the controls leave free. anew: the hint as it is now. */
  private cover(anew = false): void {
    const element = (id: string): HTMLElement => document.getElementById(id)!;
    const under = (id: string): number => (element(id).hidden ? 0 : element(id).getBoundingClientRect().bottom + kGap_px);
    this.hintBottom = anew ? under('hint') : Math.max(this.hintBottom, under('hint'));
    this.stage.cover(Math.max(under('top'), under('halves'), this.hintBottom), element('bottom').offsetHeight + 22);
  }

  /** A view that nobody moved shows the whole model, whatever the window and the controls become. */
  private fit(): void {
    const isBusy = this.pointer.isUsing || this.stage.renderer.xr.isPresenting;
    if (this.studio.target && !isBusy && this.view.wantsFraming) this.view.frame(this.studio.state.now.modelToWorld);
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
        this.view.pen.inkColor = this.tools.now.color(now.settings) ?? kNoInk;
        this.view.showMirror(now.settings.mirror);
        this.stage.split = now.settings.compare !== null;
        this.cover();
        if (now.settings.compare !== before.settings.compare) this.fit();
        if (now !== before) writeSettings(this.settings, now.settings);
        this.stage.invalidate();
      }
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
    window.addEventListener('pagehide', () => {
      this.pointer.release();
      this.documents.autosave.leave();
    });
  }

  /** The drawing of last time, or the first model; `?shape=` in the address: the same of that model. */
  async start(): Promise<void> {
    const shape = new URLSearchParams(location.search).get('shape');
    const known = this.core.shapes.some((s) => s.name === shape) ? shape : null;
    if (shape !== null && known === null) this.ui.messages.problem(`There is no built-in model “${shape}”. The button at the top left lists them.`);
    if (!(await this.documents.start(known))) this.documents.openModel(shapeModel(this.core, known ?? kFirstShape));
    void this.offerXr();
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

  /** Another model is shown. */
  private async shown(source: ModelSource, hasBake: boolean): Promise<void> {
    this.baking?.abort();
    this.frameModel();
    if (!hasBake && 'shape' in source) await this.fetchEmbedding(source.shape);
  }

  /** A built-in model's bake, if the server has it: after the first picture, when there is time. */
  private async fetchEmbedding(shape: string): Promise<void> {
    const url = this.embeddings ? kEmbeddings.get(shape) : undefined;
    if (!url) return;
    await new Promise((resolve) => ('requestIdleCallback' in window ? requestIdleCallback(resolve, { timeout: 3000 }) : setTimeout(resolve, 1000)));
    try {
      const response = await fetch(url);
      if (!response.ok) return;
      const bytes = new Uint8Array(await response.arrayBuffer());
      const { model } = this.studio.state.now;
      if (this.studio.state.now.hasEmbedding || !model || !('shape' in model.source) || model.source.shape !== shape) return;
      await this.files.embed(bytes, `${shape}.mimicry`);
    } catch {
      // Without it the techniques that need it wait for a bake.
    }
  }

  openShape(name: string): void {
    this.attempt(() => {
      this.documents.openModel(shapeModel(this.core, name));
      this.ui.messages.say(`${shapeTitle(name)} is open.`);
    });
  }

  openFiles(files: Iterable<File>): void {
    this.files.open(files);
  }

  chooseFiles(): void {
    this.files.choose();
  }

  showDrawings(): void {
    document.getElementById('drawings')?.showPopover();
  }

  saveDrawing(): void {
    this.attempt(() => this.files.saveDrawing());
  }

  exportCurves(format: CurveFormat): void {
    this.attempt(() => this.files.exportCurves(format));
  }

  exportStrokes(): void {
    this.attempt(() => this.files.exportStrokes());
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
    this.cover(true);
    if (this.studio.target) this.view.frame(this.studio.state.now.modelToWorld);
  }

  turnModel(axis: 'x' | 'z'): void {
    this.pointer.release();
    this.studio.turnModel(axis);
    this.frameModel();
    this.ui.messages.say('The model is turned by 90 degrees.');
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
        const bytes = await prepareEmbedding(mesh, model!.source, controller.signal, (text, fraction) => work.progress(text, fraction));
        if (this.studio.state.now.model !== model || !(await this.files.embed(bytes, 'the prepared model', controller.signal))) return;
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

  say(sentence: string): void {
    this.ui.messages.say(sentence);
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
