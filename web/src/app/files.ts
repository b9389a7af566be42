import { plural, sentence } from '../base/text';
import { readCurveFile } from '../drawing/curve_file';
import { colorBytes, formatOf, isDrawing, kDrawingEnding, keptCurves, readDrawingModel, writeDrawing } from '../drawing/drawing_file';
import type { CurveFormat } from '../engine/core';
import type { LoadedModel, ModelSource } from '../engine/loaded_model';
import type { Companions, Loader } from '../engine/loader';
import { shapeModel } from '../engine/model';
import type { Documents } from '../studio/documents';
import type { Studio } from '../studio/studio';
import type { Interface } from '../ui/interface';

const kMeshEndings = /\.(obj|ply|stl|off|glb|gltf)$/i;
const kOwnEndings = new RegExp(`\\.(mimicry|json)$|\\${kDrawingEnding}$`, 'i');
/** What models come with: it can be chosen together with them. */
const kCompanionEndings = '.bin,.mtl,.png,.jpg,.jpeg,.webp,.ktx2';

/** How much of a file is looked at to know what it is. */
const kStart = 1 << 16;
const kNotBack = 'it has curves for other programs, and no triangles to draw on; the studio reads curves back from “Curves, JSON” and from saved drawings';

/** Files in and out: dropped, chosen, saved. */
export class Files {
  private loading: AbortController | null = null;
  private readonly picker = document.createElement('input');

  constructor(
    root: HTMLElement, private readonly studio: Studio, private readonly documents: Documents, private readonly ui: Interface, private readonly loader: Loader,
    private readonly turn: (axis: 'x' | 'z') => void,
  ) {
    this.picker.type = 'file';
    this.picker.multiple = true;
    this.picker.hidden = true;
    this.picker.accept = `.obj,.ply,.stl,.off,.glb,.gltf,.mimicry,.json,${kDrawingEnding},${kCompanionEndings}`;
    this.picker.addEventListener('change', () => {
      this.open(this.picker.files ?? []);
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
      if (event.dataTransfer) this.open(event.dataTransfer.files);
    });
  }

  choose(): void {
    this.picker.click();
  }

  open(given: Iterable<File>): void {
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

  /** A model that was kept or comes with a drawing. */
  async modelOf(source: ModelSource, companions: Companions = {}): Promise<LoadedModel> {
    if ('file' in source) return this.load(source.file, source.bytes, [], companions);
    // A shape takes no longer here; what comes with it does.
    if (!companions.embedding && !companions.curves?.length) return shapeModel(this.studio.core, source.shape);
    return this.loader.shape(source.shape, { signal: new AbortController().signal }, companions);
  }

  /** The bake of the open model; false where another one is open by the time that it is made ready. */
  async embed(bytes: Uint8Array, name: string, signal = new AbortController().signal): Promise<boolean> {
    const { model } = this.studio.state.now;
    const target = await this.loader.withEmbedding(this.studio.mesh!, model!.name, { name, bytes }, { signal });
    await this.whenIdle();
    if (this.studio.state.now.model !== model) return false;
    this.studio.embed(target);
    return true;
  }

  /** Between strokes. */
  private whenIdle(): Promise<void> {
    return new Promise((resolve) => {
      const stop = this.studio.state.watch((now) => {
        if (!now.drawing) queueMicrotask(() => { stop(); resolve(); });
      });
    });
  }

  private async openFile(file: File, beside: readonly File[]): Promise<void> {
    if (file.size === 0) throw new Error(`${file.name}: ${file.name.endsWith(kDrawingEnding) ? 'the drawing file is empty; saving it was interrupted, so save it again or use another copy' : 'the file is empty; export it again'}`);
    if (kMeshEndings.test(file.name)) {
      const start = async (bytes = kStart): Promise<string> => new TextDecoder().decode(await file.slice(0, bytes).arrayBuffer());
      let model: LoadedModel;
      try {
        model = await this.load(file.name, file, beside);
      } catch (error) {
        if (/\.obj$/i.test(file.name) && hasLinesOnly(await start())) throw new Error(`${file.name}: ${kNotBack}`);
        throw error;
      }
      this.documents.openModel(model);
      if (model.turn[3] !== 1) this.ui.messages.note(`${file.name} is taken to have z up.`, { title: 'Turn it (U)', act: () => this.turn('x') });
      if (/\.ply$/i.test(file.name) && /^property int curve\r?$/m.test(await start())) this.ui.messages.note(`${file.name} holds curves as tubes; they are opened as a model. The studio reads curves back from “Curves, JSON” and from saved drawings.`);
      if (/\.glb$/i.test(file.name) && (await start(1 << 22)).includes('"generator":"mimicry"')) this.ui.messages.note(`${file.name} is a scene of this studio: its ink is opened as part of the model. The studio reads curves back from “Curves, JSON” and from saved drawings.`);
      this.ui.messages.say(`${file.name} is open.`);
      return;
    }
    if (file.size > 1e9) throw new Error(`${file.name}: ${(file.size / 1e9).toFixed(1)} GB is more than a browser can hold; split it`);
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.mimicry$/i.test(file.name)) {
      if (!(await this.embed(bytes, file.name))) return;
      this.documents.autosave.saveEmbedding(bytes);
      this.ui.messages.note('The model is prepared: all techniques work on it.');
    } else if (isDrawing(bytes)) {
      await this.openDrawing(bytes, file.name);
    } else if (file.name.endsWith(kDrawingEnding)) {
      throw new Error(`${file.name}: not a mimicry drawing, or its beginning is damaged; use another copy`);
    } else if (formatOf(bytes) === 'mimicry-curves') {
      this.openCurves(bytes, file.name);
    } else if (/\.json$/i.test(file.name)) {
      this.openStrokes(bytes, file.name);
    } else if (/\.csv$/i.test(file.name)) {
      throw new Error(`${file.name}: ${kNotBack}`);
    } else {
      throw new Error(`${file.name}: not a kind of file that the studio opens; it takes models (OBJ, PLY, STL, OFF, GLB), drawings, recorded strokes (JSON) and .mimicry files`);
    }
  }

  private async openDrawing(bytes: Uint8Array, name: string): Promise<void> {
    const { model: stored, title, rest } = readDrawingModel(bytes, name);
    const { source } = stored;
    if ('shape' in source && !this.studio.core.shapes.some((s) => s.name === source.shape)) {
      throw new Error(`${name}: a drawing on “${source.shape}”, a model that this page does not have; reload it to get a newer page`);
    }
    let model: LoadedModel;
    try {
      model = await this.modelOf(source);
    } catch (error) {
      if (error instanceof DOMException) throw error;
      throw new Error(`${name}: the model in it cannot be read (${sentence(error)}); use another copy`);
    }
    this.documents.openContent(model, stored, rest, title, name);
  }

  private openStrokes(bytes: Uint8Array, name: string): void {
    const { messages } = this.ui;
    const strokes = this.studio.core.readStrokes(bytes, name, (what) => messages.note(`Left out: ${what}`));
    const drawn = this.studio.importStrokes(strokes);
    messages.note(drawn === strokes.length ? `${plural(drawn, 'stroke')} drawn.` : `${drawn} of ${plural(strokes.length, 'stroke')} drawn; the others do not meet this model.`);
    const here = this.studio.state.now.model!.name;
    const elsewhere = [...new Set(strokes.map((stroke) => stroke.target))].filter((target) => target && !isSameModel(target, here));
    if (elsewhere.length > 0) messages.note(`${name} was recorded on ${elsewhere.slice(0, 3).map((target) => `“${target}”`).join(', ')}; on “${here}” the curves may lie elsewhere. Open that model and drop the strokes again to have them as they were.`);
  }

  /** Curves that were exported, on the model that they were drawn on. */
  private openCurves(bytes: Uint8Array, name: string): void {
    const { curves, onto, leftOut } = readCurveFile(this.studio.target!, bytes, name);
    const here = this.studio.state.now.model!;
    if (onto.vertices !== this.studio.mesh!.positions.length / 3 || onto.faces !== here.faces) {
      for (const { curve } of curves) curve.dispose();
      throw new Error(`${name}: curves on “${onto.name}” (${onto.vertices.toLocaleString('en')} vertices, ${onto.faces.toLocaleString('en')} triangles), and “${here.name}” is open; open that model and drop the curves again`);
    }
    this.studio.importCurves(curves);
    this.ui.messages.note(`${plural(curves.length, 'curve')} added${leftOut > 0 ? `; ${leftOut} could not be read` : ''}. They come without recorded strokes, so other techniques cannot redraw them.`);
  }

  private async load(name: string, content: Blob | Uint8Array, beside: readonly File[] = [], companions: Companions = {}): Promise<LoadedModel> {
    this.loading?.abort();
    const controller = (this.loading = new AbortController());
    const work = this.ui.messages.work(`Reading ${name}`, () => controller.abort());
    try {
      return await this.loader.file(name, content, beside, { signal: controller.signal, onProgress: (stage, fraction) => work.progress(stage, fraction) }, companions);
    } finally {
      work.done();
    }
  }

  saveDrawing(): void {
    const { model, history } = this.studio.state.now;
    if (!model || history.drawing.length === 0) return;
    const open = this.documents.open.now;
    this.download(writeDrawing(this.studio.core, this.studio.target!, this.documents.storedModel()!, history.drawing, open?.isOwn ? open.name : undefined), kDrawingEnding);
  }

  exportCurves(format: CurveFormat): void {
    const { curves, styles } = keptCurves(this.studio.state.now.history.drawing);
    try {
      this.download(this.studio.target!.writeCurves(curves, format, colorBytes(styles)), `-curves.${format}`);
    } finally {
      for (const curve of curves) curve.dispose();
    }
  }

  exportStrokes(): void {
    const strokes = this.studio.state.now.history.drawing.map((drawn) => drawn.stroke).filter((stroke) => stroke.frames.length > 0);
    if (strokes.length === 0) throw new Error('These curves came without recorded strokes; “Curves, JSON” saves them');
    this.download(this.studio.core.writeStrokes(strokes), '-strokes.json');
  }

  private download(bytes: Uint8Array, ending: string): void {
    const open = this.documents.open.now;
    const title = open?.isOwn ? open.name : this.studio.state.now.model!.name.replace(/\.[^.]+$/, '');
    const name = title.replace(/[^\p{L}\p{N}_-]+/gu, '-') || 'drawing';
    const url = URL.createObjectURL(new Blob([bytes as Uint8Array<ArrayBuffer>]));
    const link = document.createElement('a');
    link.href = url;
    link.download = name + ending;
    link.click();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
    this.ui.messages.say(`${link.download} is saved.`);
  }
}

function hasLinesOnly(obj: string): boolean {
  return /^l\s/m.test(obj) && !/^f\s/m.test(obj);
}

/** Names of models are files' or shapes' names: folders, endings and case say nothing. */
function isSameModel(a: string, b: string): boolean {
  const bare = (name: string): string => name.toLowerCase().replace(/^.*[/\\]/, '').replace(/^shape:/, '').replace(/\.[a-z0-9]+$/, '');
  return bare(a) === bare(b);
}
