import { Store } from '../base/store';
import { carryFrame } from '../drawing/carry';
import type { LooseCurve } from '../drawing/curve_file';
import { commit, kEmptyHistory, lastStroke, reachable, redo, undo, widthOfPressure, type Drawing, type DrawnCurve, type History, type InkStyle, type Stroke } from '../drawing/document';
import { FrameBuffer, kPressure, makeFrame } from '../drawing/frame';
import { mirrorFrame, mirrorPlane, type MirrorAxis, type Plane } from '../drawing/symmetry';
import { kInked, type Core, type Curve, type MeshArrays, type RecordedStroke, type Session, type Ink, type Target, type TechniqueInfo } from '../engine/core';
import type { LoadedModel, ModelSource } from '../engine/loaded_model';
import { techniquesOf } from '../engine/techniques';
import { toWorld } from '../math/similarity';
import { quarterTurned, standing } from '../math/standing';
import { kDefaults, type Settings } from './settings';
import type { StudioView } from './view';

export interface StudioState {
  settings: Settings;
  history: History;
  model: { name: string; source: ModelSource; faces: number; remarks: readonly string[] } | null;
  hasEmbedding: boolean;
  drawing: boolean; // a stroke is being drawn
  modelToWorld: Float64Array;
  /** How the model was turned to stand upright: a unit quaternion. */
  turn: readonly number[];
}

/** The techniques' option with which a pen inside the object draws at the surface that it went through. */
const kDippedPen = 'dipped-pen';

/** Where a new model stands: in front of someone who stands at the origin. */
export const kCentre: readonly [number, number, number] = [0, 1.15, -0.55];

/**
 * The studio without a picture: a model, a drawing with its history, and the stroke that is being
 * drawn. Everything a page, a headset or a test does goes through here.
 */
export class Studio {
  readonly state: Store<StudioState>;
  target: Target | null = null;
  private loaded: LoadedModel | null = null;
  private readonly sessions = new Map<string, Session>();
  private readonly curves = new Set<Curve>();
  private readonly frames = [new FrameBuffer(), new FrameBuffer()];
  private readonly mirrored = makeFrame();
  private live: { technique: string; style: InkStyle; mirror: MirrorAxis | null; plane: Plane | null; id: string; place: Float64Array; sessions: Session[] } | null = null;
  private editing: { before: Drawing; label: string } | null = null;
  private serial = 0;

  constructor(readonly core: Core, private readonly view: StudioView, settings: Settings = kDefaults) {
    this.state = new Store<StudioState>({
      settings: core.techniques.some((t) => t.name === settings.technique) ? settings : { ...settings, technique: kDefaults.technique },
      history: kEmptyHistory, model: null, hasEmbedding: false, drawing: false,
      modelToWorld: new Float64Array([0, 0, 0, 1, ...kCentre, 1]), turn: [0, 0, 0, 1],
    });
    this.state.watch((now, before) => {
      if (now.history.drawing !== before.history.drawing) this.view.showDrawing(now.history.drawing);
    });
  }

  /** In the order in which they are offered; those that a page registers with the core among them. */
  get techniques(): readonly TechniqueInfo[] {
    return techniquesOf(this.core);
  }

  get settings(): Settings {
    return this.state.now.settings;
  }

  set(part: Partial<Settings>): void {
    const before = this.settings;
    this.state.update({ settings: { ...before, ...part } });
    if (part.compare !== undefined && part.compare !== before.compare) this.replay();
  }

  // Models ------------------------------------------------------------------------------------

  /** Shows another model, whose target is the studio's from now on; the drawing begins anew. */
  open(model: LoadedModel, turn = model.turn): void {
    const { target } = model.made;
    this.settle();
    this.forgetAll();
    this.target?.dispose();
    this.target = target;
    this.loaded = model;
    const place = standing(this.centre(), kCentre, turn, model.mesh.metresPerUnit);
    this.view.showModel(model, target);
    this.view.place(place);
    this.state.update({
      history: kEmptyHistory, hasEmbedding: target.hasEmbedding, modelToWorld: place, turn,
      model: { name: model.name, source: model.source, faces: model.mesh.faces.length / 3, remarks: [...model.remarks, ...target.notes] },
    });
    if (!this.offers(this.settings.technique)) this.set({ technique: kDefaults.technique });
  }

  get mesh(): MeshArrays | null {
    return this.loaded?.mesh ?? null;
  }

  /** The open model with its bake; every curve moves there. */
  embed(target: Target): void {
    const from = this.target;
    if (!from) return;
    this.endStroke();
    target.adopt([...this.curves], from);
    this.closeSessions();
    this.replayed?.dispose();
    this.replayed = null;
    from.dispose();
    this.target = target;
    this.state.update({ hasEmbedding: true });
    this.replay();
  }

  /** The model moves, is turned or scaled; ink goes with it. */
  place(modelToWorld: Float64Array): void {
    this.state.now.modelToWorld.set(modelToWorld);
    this.view.place(this.state.now.modelToWorld);
  }

  /** Turns the model by a quarter where it stands: around the axis from left to right, or toward the viewer. */
  turnModel(axis: 'x' | 'z'): void {
    this.standAs(quarterTurned(this.state.now.turn, axis));
  }

  /** Turns the model where it stands. */
  standAs(turn: readonly number[]): void {
    if (!this.target) return;
    this.settle();
    const { modelToWorld } = this.state.now, centre = this.centre(), where = [0, 0, 0];
    toWorld(where, 0, modelToWorld, centre, 0);
    this.place(standing(centre, where, turn, modelToWorld[7]!));
    this.state.update({ turn });
  }

  technique(name: string): TechniqueInfo {
    return this.techniques.find((t) => t.name === name) ?? this.techniques[0]!;
  }

  /** Of a curve too, which may come from a page that has more techniques. */
  techniqueTitle(name: string): string {
    return this.techniques.find((t) => t.name === name)?.title ?? name;
  }

  /** Whether the technique works on this model as it is. */
  offers(name: string): boolean {
    return !this.technique(name).needsBake || this.state.now.hasEmbedding;
  }

  // Strokes -----------------------------------------------------------------------------------

  get isDrawing(): boolean {
    return this.live !== null;
  }

  /** Starts a stroke with the technique, colour, size and symmetry of the settings. */
  beginStroke(): void {
    if (!this.target || this.live) return;
    this.settle();
    const { technique, style, mirror } = this.settings;
    const place = this.state.now.modelToWorld.slice();
    const plane = this.symmetryPlane();
    const sessions = [this.session(technique, 0)];
    if (plane) sessions.push(this.session(technique, 1));
    this.serial += 1;
    const id = `stroke-${Date.now().toString(36)}-${this.serial}`;
    this.live = { technique, style: { ...style }, mirror, plane, id, place, sessions };
    sessions.forEach((session, copy) => {
      const buffer = this.frames[copy]!;
      buffer.clear();
      session.begin(place);
      this.view.beginInk(copy, style, place, (frame, out) => {
        out[0] = widthOfPressure(buffer.at(frame, kPressure));
      });
    });
    this.state.update({ drawing: true });
  }

  /** One more frame; true where the pen found a point. Makes no garbage. */
  addFrame(frame: Float64Array): boolean {
    const live = this.live;
    if (!live) return false;
    // A model that is moved while it is drawn on takes the stroke along: frames are stored as if it had stayed.
    this.asPlacedAtStart(frame);
    let inked = false;
    for (let copy = 0; copy < live.sessions.length; copy += 1) {
      let own = this.placed;
      if (copy > 0) {
        mirrorFrame(this.mirrored, this.placed, live.plane!);
        own = this.mirrored;
      }
      this.frames[copy]!.append(own);
      const session = live.sessions[copy]!;
      const status = session.add(own);
      if (copy === 0) inked = status === kInked;
      if (status === kInked) this.view.growInk(copy, session.ink);
    }
    return inked;
  }

  /** The ink of the stroke that is being drawn. */
  get liveInk(): Ink | null {
    return this.live?.sessions[0]?.ink ?? null;
  }

  /** Ends the stroke and keeps what was drawn. */
  endStroke(): void {
    const live = this.live;
    if (!live) return;
    this.live = null;
    const added: DrawnCurve[] = [];
    live.sessions.forEach((session, copy) => {
      session.end();
      if (session.ink.count === 0) return;
      const id = copy === 0 ? live.id : `${live.id}/${live.mirror}`;
      const curve = this.own(session.curve(), id);
      const stroke: Stroke = { id, target: this.state.now.model!.name, modelToWorld: live.place, frames: this.frames[copy]!.take() };
      added.push({ id, stroke, mirror: copy === 0 ? null : live.mirror, style: live.style, kept: [[0, this.frames[copy]!.count - 1]], curve });
      this.view.keepInk(copy, id);
    });
    this.view.dropInk();
    this.state.update({
      drawing: false,
      history: added.length > 0 ? commit(this.state.now.history, [...this.state.now.history.drawing, ...added], 'stroke') : this.state.now.history,
    });
    this.sweep();
    this.replay();
  }

  /** Drops the stroke that is being drawn: what looked like one was another gesture. */
  cancelStroke(): void {
    const live = this.live;
    if (!live) return;
    this.live = null;
    for (const session of live.sessions) session.end();
    this.view.dropInk();
    this.state.update({ drawing: false });
  }

  // Edits -------------------------------------------------------------------------------------

  /** Changes until `endEdit` are one step of the history. */
  beginEdit(label: string): void {
    this.settle();
    this.editing = { before: this.state.now.history.drawing, label };
  }

  /** A change of the edit that is under way; nothing where none is. */
  edit(change: (drawing: Drawing) => Drawing): void {
    if (!this.editing) return;
    const { history } = this.state.now, drawing = change(history.drawing);
    if (drawing !== history.drawing) this.state.update({ history: { ...history, drawing } });
  }

  endEdit(): void {
    const { editing } = this;
    if (!editing) return;
    this.editing = null;
    const { history } = this.state.now;
    this.state.update({ history: commit({ ...history, drawing: editing.before }, history.drawing, editing.label) });
    this.sweep();
  }

  /** The drawing is as it was before `beginEdit`. */
  cancelEdit(): void {
    const { editing } = this;
    if (!editing) return;
    this.editing = null;
    this.state.update({ history: { ...this.state.now.history, drawing: editing.before } });
  }

  /** Ends what is under way, and keeps it. */
  private settle(): void {
    this.endStroke();
    this.endEdit();
  }

  undo(): void {
    this.settle();
    this.state.update({ history: undo(this.state.now.history) });
    this.replay();
  }

  redo(): void {
    this.settle();
    this.state.update({ history: redo(this.state.now.history) });
    this.replay();
  }

  clear(): void {
    this.settle();
    if (this.state.now.history.drawing.length === 0) return;
    this.state.update({ history: commit(this.state.now.history, [], 'clearing') });
    this.replay();
  }

  /** The last stroke, drawn anew with another technique. */
  redrawLast(technique: string): void {
    const last = lastStroke(this.state.now.history.drawing);
    if (last.length === 0 || !this.offers(technique)) return;
    if (last.some((drawn) => drawn.stroke.frames.length === 0)) throw new Error('The last curve came without its recorded stroke: it cannot be redrawn.');
    this.settle();
    const redrawn = new Map(last.map((drawn) => [drawn, { ...drawn, curve: this.own(this.project(technique, drawn.stroke), drawn.id) }]));
    const drawing = this.state.now.history.drawing.map((drawn) => redrawn.get(drawn) ?? drawn);
    this.state.update({ history: commit(this.state.now.history, drawing, `redrawing with ${technique}`) });
    this.sweep();
  }

  /** Strokes of a file, through the technique of the settings. Returns how many left a curve. */
  importStrokes(strokes: readonly RecordedStroke[]): number {
    this.settle();
    const added: DrawnCurve[] = [];
    const taken = new Set(this.state.now.history.drawing.map((drawn) => drawn.id));
    for (const stroke of strokes) {
      let id = stroke.id;
      for (let k = 2; taken.has(id); k += 1) id = `${stroke.id}-${k}`;
      const curve = this.project(this.settings.technique, stroke);
      if (curve.ink.count === 0) {
        curve.dispose();
        continue;
      }
      taken.add(id);
      added.push({
        id, stroke: { ...stroke, id }, mirror: null, style: { ...this.settings.style },
        kept: [[0, stroke.frames.length / 17 - 1]], curve: this.own(curve, id),
      });
    }
    if (added.length > 0) this.state.update({ history: commit(this.state.now.history, [...this.state.now.history.drawing, ...added], 'import') });
    this.replay();
    return added.length;
  }

  /** Curves of a file. They have no strokes: their recordings are empty. */
  importCurves(curves: readonly LooseCurve[]): void {
    this.settle();
    const taken = new Set(this.state.now.history.drawing.map((drawn) => drawn.id));
    const added = curves.map(({ curve, modelToWorld }): DrawnCurve => {
      const root = curve.stroke || 'curve';
      let id = root;
      for (let k = 2; taken.has(id); k += 1) id = `${root}-${k}`;
      taken.add(id);
      const stroke: Stroke = { id, target: this.state.now.model!.name, modelToWorld, frames: new Float64Array(0) };
      return { id, stroke, mirror: null, style: { ...this.settings.style }, kept: [[0, Math.max(0, curve.frames.at(-1) ?? 0)]], curve: this.own(curve, id) };
    });
    if (added.length > 0) this.state.update({ history: commit(this.state.now.history, [...this.state.now.history.drawing, ...added], 'import') });
    this.replay();
  }

  /** A drawing that was saved. */
  restore(drawing: Drawing): void {
    this.editing = null;
    for (const drawn of drawing) this.curves.add(drawn.curve);
    this.state.update({ history: { ...kEmptyHistory, drawing } });
    this.sweep();
    this.replay();
  }

  /** A recorded stroke from first frame to last. */
  project(technique: string, stroke: Pick<RecordedStroke, 'modelToWorld' | 'frames'>): Curve {
    const session = this.session(technique, 0);
    session.begin(stroke.modelToWorld);
    for (let at = 0; at < stroke.frames.length; at += 17) session.add(stroke.frames.subarray(at, at + 17));
    session.end();
    return session.curve();
  }

  // Comparing ---------------------------------------------------------------------------------

  /** Starts comparing with a technique that is steered otherwise than the one in use, which tells most; or stops. */
  toggleCompare(): void {
    const { compare, technique } = this.settings;
    const { steering } = this.technique(technique);
    const other = this.techniques.find((t) => t.steering !== steering && this.offers(t.name)) ?? this.techniques.find((t) => t.name !== technique);
    this.set({ compare: compare === null ? (other?.name ?? null) : null });
  }

  private replayed: Curve | null = null;

  /** Shows the last stroke through the technique that it is compared with. */
  private replay(): void {
    const { compare } = this.settings;
    const last = lastStroke(this.state.now.history.drawing)[0] ?? null;
    const before = this.replayed;
    this.replayed = compare && last && last.stroke.frames.length > 0 && this.offers(compare) && !this.live ? this.project(compare, last.stroke) : null;
    this.view.showReplay(this.replayed, last);
    before?.dispose();
  }

  // Inside ------------------------------------------------------------------------------------

  /** The plane of symmetry where the model stands now, world; null: there is none. */
  symmetryPlane(): Plane | null {
    const { mirror } = this.settings;
    return mirror && this.target ? mirrorPlane(mirror, this.centre(), this.state.now.modelToWorld) : null;
  }

  centre(): number[] {
    const { min, max } = this.target!;
    return [0, 1, 2].map((k) => (min[k]! + max[k]!) / 2);
  }

  private readonly placed = makeFrame();

  private asPlacedAtStart(frame: Float64Array): void {
    const now = this.state.now.modelToWorld, start = this.live!.place;
    this.placed.set(frame);
    for (let k = 0; k < 8; k += 1) {
      if (now[k] !== start[k]) {
        carryFrame(this.placed, now, start);
        return;
      }
    }
  }

  private session(technique: string, copy: number): Session {
    const key = `${technique}/${copy}`;
    let session = this.sessions.get(key);
    if (!session) {
      // A hand in space goes through surfaces: what it draws then starts where it went in.
      const dips = this.technique(technique).options.some(({ name }) => name === kDippedPen);
      session = this.target!.session(technique, dips ? { options: { [kDippedPen]: true } } : {});
      this.sessions.set(key, session);
    }
    return session;
  }

  private own(curve: Curve, id: string): Curve {
    const named = curve.withStroke(id);
    curve.dispose();
    this.curves.add(named);
    return named;
  }

  /** Frees curves that no state of the history shows any more. */
  private sweep(): void {
    const needed = reachable(this.state.now.history);
    for (const curve of this.curves) {
      if (needed.has(curve)) continue;
      this.curves.delete(curve);
      curve.dispose();
    }
  }

  private closeSessions(): void {
    for (const session of this.sessions.values()) session.dispose();
    this.sessions.clear();
  }

  private forgetAll(): void {
    this.closeSessions();
    this.replayed?.dispose();
    this.replayed = null;
    for (const curve of this.curves) curve.dispose();
    this.curves.clear();
  }
}
