import { Mimicry } from 'mimicry';
import { beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { Autosave } from '../../src/drawing/autosave';
import type { Drawing } from '../../src/drawing/document';
import { keptCurves, readDrawing, readDrawingModel, writeDrawing } from '../../src/drawing/drawing_file';
import { kController, kHead, kPressure, makeFrame } from '../../src/drawing/frame';
import { Library } from '../../src/drawing/library';
import { recover } from '../../src/drawing/recover';
import { MemoryShelf, PatientShelf } from '../../src/drawing/shelf';
import type { RecordedStroke } from '../../src/engine/core';
import { makeTarget, shapeModel } from '../../src/engine/model';
import { Studio } from '../../src/studio/studio';
import { kErasePart } from '../../src/tools/erase';
import { NullView } from './null_view';
import { penAt } from './pen_at';
import { random } from './random';

let core: Mimicry;
let view: NullView;
let studio: Studio;

beforeAll(async () => { core = await new Mimicry().ready; });
beforeEach(() => {
  view = new NullView();
  studio = new Studio(core, view);
  studio.open(shapeModel(core, 'sphere'));
});

/** A stroke 3 cm in front of the sphere, to the right. */
function draw(from = -0.05, to = 0.05, y = 0, count = 30, pressure: (i: number) => number = () => -1): void {
  const frame = makeFrame();
  const place = studio.state.now.modelToWorld;
  const [cx, cy, cz] = [place[4]!, place[5]!, place[6]!]; // the sphere is centred
  studio.beginStroke();
  for (let i = 0; i < count; i += 1) {
    frame[0] = i / 90;
    frame.set([cx, cy, cz + 1], kHead);
    frame.set([cx + from + ((to - from) * i) / (count - 1), cy + y, cz + place[7]! + 0.03], kController);
    frame[kPressure] = pressure(i);
    studio.addFrame(frame);
  }
  studio.endStroke();
}

describe('studio', () => {
  it('draws strokes, one step of the history each', () => {
    draw();
    draw(0.05, -0.05, 0.04);
    const { history } = studio.state.now;
    expect(history.drawing).toHaveLength(2);
    expect(history.past).toHaveLength(2);
    expect(view.kept).toEqual(history.drawing.map((d) => d.id));
    expect(view.live.size).toBe(0);
    expect(view.drawing).toBe(history.drawing);
    for (const drawn of history.drawing) {
      expect(drawn.curve.stroke).toBe(drawn.id);
      expect(drawn.curve.pointCount).toBe(30);
      expect(drawn.stroke.frames.length).toBe(30 * 17);
    }
  });

  it('a stroke that meets nothing leaves no trace', () => {
    studio.set({ technique: 'spraycan' });
    const frame = makeFrame();
    frame.set([0, 50, 0], kController);
    studio.beginStroke();
    studio.addFrame(frame);
    studio.endStroke();
    expect(studio.state.now.history.past).toHaveLength(0);
    expect(view.live.size).toBe(0);
  });

  it('a pen that dips into the model draws on the side that it went into', () => {
    const { target } = studio;
    const centre = studio.centre(), place = studio.state.now.modelToWorld;
    const radius = (target!.max[2]! - target!.min[2]!) / 2;
    for (const { name, needsBake } of core.techniques) {
      if (needsBake) continue;
      studio.clear();
      studio.set({ technique: name });
      studio.beginStroke();
      for (let i = 0; i < 10; i += 1) {
        const frame = makeFrame();
        frame[0] = i / 90;
        const pen = [0.1 * radius * (i / 10), 0, 0.8 * radius].map((v, k) => place[7]! * (v + centre[k]!) + place[4 + k]!);
        frame.set(pen, kController);
        frame.set([pen[0]!, pen[1]!, pen[2]! + 1], kHead);
        studio.addFrame(frame);
      }
      studio.endStroke();
      const { curve } = studio.state.now.history.drawing[0]!;
      for (let i = 0; i < curve.pointCount; i += 1) expect(curve.point(i).position[2] - centre[2]!, name).toBeGreaterThan(0.5 * radius);
    }
  });

  it('a cancelled stroke leaves none either', () => {
    studio.beginStroke();
    studio.cancelStroke();
    expect(studio.isDrawing).toBe(false);
    expect(studio.state.now.history.past).toHaveLength(0);
  });

  it('frames that cannot be used are passed over', () => {
    studio.beginStroke();
    const frame = makeFrame();
    frame[kController] = NaN;
    expect(studio.addFrame(frame)).toBe(false);
    studio.endStroke();
    expect(studio.state.now.drawing).toBe(false);
  });

  it('mirrored copies are projected anew and lie mirrored', () => {
    studio.set({ mirror: 'x' });
    draw(0.02, 0.1);
    const [own, copy] = studio.state.now.history.drawing;
    expect(copy!.mirror).toBe('x');
    const n = own!.curve.pointCount;
    expect(copy!.curve.pointCount).toBe(n);
    for (let i = 0; i < n; i += 1) {
      const p = own!.curve.point(i).position, q = copy!.curve.point(i).position;
      // The sphere's triangles are not mirror images of each other: as near as their flatness.
      expect(Math.hypot(p[0] + q[0], p[1] - q[1], p[2] - q[2])).toBeLessThan(0.01);
    }
    studio.undo();
    expect(studio.state.now.history.drawing).toHaveLength(0);
    studio.redo();
    expect(studio.state.now.history.drawing).toHaveLength(2);
  });

  it('switching techniques holds from the next stroke on', () => {
    draw();
    studio.set({ technique: 'snap' });
    draw(0.05, -0.05, 0.04);
    expect(studio.state.now.history.drawing.map((d) => d.curve.technique)).toEqual(['mimicry-live', 'snap']);
    studio.redrawLast('anchored-closest');
    expect(studio.state.now.history.drawing.map((d) => d.curve.technique)).toEqual(['mimicry-live', 'anchored-closest']);
    studio.undo();
    expect(studio.state.now.history.drawing.at(-1)!.curve.technique).toBe('snap');
  });

  it('compares the last stroke, and stops', () => {
    studio.set({ compare: 'spraycan' });
    expect(view.replayed).toBe(null);
    draw();
    expect(view.replayed).toBe('spraycan');
    studio.set({ compare: 'snap' });
    expect(view.replayed).toBe('snap');
    studio.undo();
    expect(view.replayed).toBe(null);
    studio.redo();
    studio.set({ compare: null });
    expect(view.replayed).toBe(null);
  });

  it('lists a technique that the page registers, and draws with it', async () => {
    const own = await new Mimicry().ready;
    const here = new Studio(own, view);
    const before = here.techniques.length;
    own.registerTechnique({
      name: 'nearest', title: 'Nearest', sentence: 'Draws at the closest point.', rank: -1, color: '#8a3ffc',
      options: [{ kind: 'choice', name: 'start', choices: ['hand', 'head'] }],
      step: (step) => {
        const hit = step.target.closestPoint(step.frame[8]!, step.frame[9]!, step.frame[10]!);
        return hit && step.found('closest', hit);
      },
    });
    expect(here.techniques).toHaveLength(before + 1);
    expect(here.techniques[0]!.name).toBe('nearest'); // by its rank
    expect(here.techniqueTitle('nearest')).toBe('Nearest');
    expect(here.technique('nearest').options.map(({ name, choices }) => [name, choices])).toEqual([['start', ['hand', 'head']]]);
    here.open(shapeModel(own, 'sphere'));
    expect(here.offers('nearest')).toBe(true);
    studio = here;
    studio.set({ technique: 'nearest' });
    draw();
    expect(studio.state.now.history.drawing.map(({ curve }) => [curve.technique, curve.pointCount])).toEqual([['nearest', 30]]);
  });

  it('techniques that need a bake are offered with one only', () => {
    expect(studio.offers('mimicry')).toBe(false);
    expect(studio.offers('mimicry-live')).toBe(true);
    expect(() => studio.target!.withEmbedding(new Uint8Array([1, 2, 3]), 'bad.mimicry')).toThrow(/bad\.mimicry/);
    expect(studio.offers('mimicry')).toBe(false);
  });

  it('a stroke while the model moves is the one that the model saw', () => {
    draw();
    const still = studio.state.now.history.drawing[0]!;
    const frame = makeFrame();
    const start = studio.state.now.modelToWorld.slice();
    studio.beginStroke();
    for (let i = 0; i < 30; i += 1) {
      const place = start.slice();
      place[4] = start[4]! + 0.01 * i;
      studio.place(place);
      frame[0] = i / 90;
      frame.set([start[4]! + 0.01 * i, start[5]!, start[6]! + 1], kHead);
      frame.set([start[4]! + 0.01 * i - 0.05 + (0.1 * i) / 29, start[5]!, start[6]! + start[7]! + 0.03], kController);
      studio.addFrame(frame);
    }
    studio.endStroke();
    const moved = studio.state.now.history.drawing[1]!;
    for (let i = 0; i < 30; i += 1) {
      const p = still.curve.point(i).position, q = moved.curve.point(i).position;
      expect(Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2])).toBeLessThan(1e-12);
    }
  });

  it('a model that cannot be drawn on leaves everything as it was', () => {
    draw();
    const before = studio.state.now;
    expect(() => makeTarget(core, { positions: new Float64Array([0, 0, 0, 1, NaN, 0, 0, 1, 0]), faces: new Int32Array([0, 1, 2]), metresPerUnit: 1 }, 'nan.obj')).toThrow(/nan\.obj: 1 vertex has/);
    expect(() => makeTarget(core, { positions: new Float64Array(9), faces: new Int32Array(0), metresPerUnit: 1 }, 'points.ply')).toThrow(/points\.ply: there are no triangles/);
    expect(studio.state.now).toBe(before);
  });

  it('recorded strokes are imported under ids of their own', () => {
    draw();
    const strokes = core.readStrokes(core.writeStrokes(studio.state.now.history.drawing.map((d) => d.stroke)), 's.json');
    expect(studio.importStrokes(strokes)).toBe(1);
    const [a, b] = studio.state.now.history.drawing;
    expect(b!.id).toBe(`${a!.id}-2`);
    expect([...b!.curve.ink.integers]).toEqual([...a!.curve.ink.integers]);
  });

  it('erasing from press to release is one step, and what was erased is not exported', () => {
    draw(-0.1, 0.1, 0, 60);
    const p = studio.state.now.history.drawing[0]!.curve.point(30).position;
    studio.set({ eraser_m: 0.02 * studio.state.now.modelToWorld[7]! });
    const use = kErasePart.press(studio, penAt(studio, p))!;
    use.move(penAt(studio, [p[0] + 0.03, p[1], p[2]]));
    use.release();
    expect(studio.state.now.history.past).toHaveLength(2);
    const { curves } = keptCurves(studio.state.now.history.drawing);
    expect(curves).toHaveLength(2);
    expect(curves[0]!.pointCount + curves[1]!.pointCount).toBeLessThan(60);
    for (const curve of curves) curve.dispose();
    studio.undo();
    expect(studio.state.now.history.drawing[0]!.kept).toHaveLength(1);
  });
});

/** How far the nearest vertex of the tube is, by the GLB file's second mesh (the first is the model). */
function thickness(glb: Uint8Array, at: readonly number[]): number {
  const view = new DataView(glb.buffer, glb.byteOffset);
  const jsonBytes = view.getUint32(12, true);
  const file = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + jsonBytes)));
  const accessor = file.accessors[file.meshes[1].primitives[0].attributes.POSITION];
  const start = 28 + jsonBytes + file.bufferViews[accessor.bufferView].byteOffset;
  let nearest = Infinity;
  for (let v = 0; v < accessor.count; v += 1) {
    const x = [0, 4, 8].map((k) => view.getFloat32(start + 12 * v + k, true));
    nearest = Math.min(nearest, Math.hypot(x[0]! - at[0]!, x[1]! - at[1]!, x[2]! - at[2]!));
  }
  return nearest;
}

describe('exported tubes', () => {
  it('are as thick as the ink at each point, each curve by its own style', () => {
    studio.set({ style: { ...studio.settings.style, radius_m: 0.001 } });
    draw(-0.05, 0.05, 0, 30, (i) => i / 29);
    studio.set({ style: { ...studio.settings.style, radius_m: 0.004 } });
    draw(-0.05, 0.05, 0.04);
    const { curves } = keptCurves(studio.state.now.history.drawing);
    const scale = studio.state.now.modelToWorld[7]!;
    const of = (curve: (typeof curves)[number]) => studio.target!.writeCurves([curve], 'glb');
    for (const point of [0, 15, 29]) {
      const pressed = 0.001 * (0.35 + (1.3 * point) / 29);
      expect((scale * thickness(of(curves[0]!), curves[0]!.point(point).position)) / pressed).toBeCloseTo(1, 1);
      expect((scale * thickness(of(curves[1]!), curves[1]!.point(point).position)) / 0.004).toBeCloseTo(1, 1);
    }
    for (const curve of curves) curve.dispose();
  });
});

describe('an exported scene', () => {
  it('has the ink at its height, with its width, on a model with normals', () => {
    const offset_m = 0.02, radius_m = 0.003;
    studio.set({ style: { ...studio.settings.style, radius_m, offset_m } });
    draw(-0.05, 0.05, 0, 30, (i) => i / 29);
    const { curves } = keptCurves(studio.state.now.history.drawing);
    const glb = studio.target!.writeCurves(curves, 'glb');
    const scale = studio.state.now.modelToWorld[7]!;
    for (const point of [0, 15, 29]) {
      const { position, normal } = curves[0]!.point(point);
      const raised = position.map((x, k) => x + (offset_m / scale) * normal[k]!);
      expect((scale * thickness(glb, raised)) / (radius_m * (0.35 + (1.3 * point) / 29))).toBeCloseTo(1, 1);
    }
    const view = new DataView(glb.buffer, glb.byteOffset);
    const file = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + view.getUint32(12, true))));
    const { POSITION, NORMAL } = file.meshes[0].primitives[0].attributes;
    expect(file.accessors[NORMAL].count).toBe(file.accessors[POSITION].count);
    for (const curve of curves) curve.dispose();
  });
});

describe('drawing files', () => {
  it('hold everything', () => {
    studio.set({ mirror: 'x' });
    draw();
    const { history, model } = studio.state.now;
    const bytes = writeDrawing(core, studio.target!, model!, history.drawing, 'Two');
    const { model: stored, title, rest } = readDrawingModel(bytes, 'd.mimicry-drawing');
    expect([stored.source, title]).toEqual([{ shape: 'sphere' }, 'Two']);
    const { drawing: read, remarks } = readDrawing(core, studio.target!, rest, 'd.mimicry-drawing');
    expect(remarks).toEqual([]);
    expect(read.map(({ curve, ...d }) => ({ ...d, ink: [...curve.ink.integers] }))).toEqual(history.drawing.map(({ curve, ...d }) => ({ ...d, ink: [...curve.ink.integers] })));
  });

  it('that are damaged or of another kind are refused with a sentence', () => {
    const text = (s: string): Uint8Array => new TextEncoder().encode(s);
    expect(() => readDrawingModel(text('{"format":'), 'x')).toThrow(/x: the file is cut off/);
    expect(() => readDrawingModel(text('{"format":"mimicry-drawing","version":9}'), 'x')).toThrow(/version 9/);
    const rest = '"format":"mimicry-drawing","version":1,"entries":[],"strokes":{},"curves":{}';
    expect(() => readDrawingModel(text('{"format":"mimicry-drawing","version":1}'), 'x')).toThrow(/x: the file is cut off/);
    expect(() => readDrawingModel(text(`{${rest}}`), 'x')).toThrow(/which model/);
    expect(() => readDrawingModel(text(`{${rest},"model":{"name":"a.obj","mesh":"%"}}`), 'x')).toThrow(/x: the file is cut off/);
  });
});

describe('a damaged drawing file', () => {
  /** A drawing of three strokes as JSON, spoilt. */
  function spoilt(change: (file: any) => void): Uint8Array {
    draw();
    draw(0.05, -0.05, 0.04);
    draw(-0.04, 0.05, 0.08);
    const file = JSON.parse(new TextDecoder().decode(writeDrawing(core, studio.target!, studio.state.now.model!, studio.state.now.history.drawing)));
    change(file);
    return new TextEncoder().encode(JSON.stringify(file));
  }
  const open = (bytes: Uint8Array) => readDrawing(core, studio.target!, readDrawingModel(bytes, 'd').rest, 'd');
  const ids = (): string[] => studio.state.now.history.drawing.map((d) => d.id);

  it('is opened without its bad stroke, which is named', () => {
    const { drawing, remarks } = open(spoilt((file) => { file.strokes.strokes[1].frames[3].head.position[0] = 'x'; }));
    expect(drawing.map((d) => d.id)).toEqual([ids()[0], ids()[2]]);
    expect(remarks).toEqual([expect.stringContaining(ids()[1]!)]);
  });

  it('without a stroke of the list too', () => {
    const { drawing, remarks } = open(spoilt((file) => { file.strokes.strokes.splice(1, 1); }));
    expect(drawing.map((d) => d.id)).toEqual([ids()[0], ids()[2]]);
    expect(remarks).toEqual([expect.stringContaining(ids()[1]!)]);
  });

  it.each<[string, (file: any) => void]>([
    ['a face that is not there', (file) => { file.curves.curves[1].points[2].face = 1e9; }],
    ['a point without its place', (file) => { delete file.curves.curves[1].points[2].bary; }],
    ['no curve', (file) => { file.curves.curves.splice(1, 1); }],
  ])('has its bad curve drawn anew from the stroke: %s', (_, change) => {
    const { drawing, remarks } = open(spoilt(change));
    const now = studio.state.now.history.drawing;
    expect(drawing.map((d) => [...d.curve.ink.integers])).toEqual(now.map((d) => [...d.curve.ink.integers]));
    expect(remarks).toEqual([expect.stringContaining(ids()[1]!)]);
  });

  it('all of whose curves are of another mesh has them drawn anew', () => {
    const { drawing, remarks } = open(spoilt((file) => { file.curves.target.vertices += 1; }));
    expect(drawing).toHaveLength(3);
    expect(remarks).toEqual([expect.stringContaining('3 curves')]);
  });

  it.each<[string, (entry: any) => void]>([
    ['colour', (entry) => { entry.style.color = 'url(x)'; }], ['radius', (entry) => { entry.style.radius_m = -1; }],
    ['parts', (entry) => { entry.kept = [[5, 2]]; }], ['parts', (entry) => { entry.kept = 'all'; }], ['style', (entry) => { delete entry.style; }],
  ])('shows a curve whole whose %s cannot be read', (_, change) => {
    const { drawing, remarks } = open(spoilt((file) => change(file.entries[1])));
    expect(drawing).toHaveLength(3);
    expect(drawing[1]!.kept).toEqual([[0, 29]]);
    expect(drawing[1]!.style.radius_m).toBeGreaterThan(0);
    expect(remarks).toEqual([expect.stringContaining(ids()[1]!)]);
  });

  it.each<[string, unknown]>([['0', 0], ['negative', -0.003], ['no number', 'thick'], ['none', undefined], ['not finite', 1e999], ['more than the model', 5]])('shows ink of a thickness that is %s as thick as usual, in its colour', (_, radius_m) => {
    const { drawing, remarks } = open(spoilt((file) => { file.entries[1].style.radius_m = radius_m; file.entries[1].style.color = '#2469d6'; file.entries[1].kept = [[2, 9]]; }));
    expect(drawing).toHaveLength(3);
    expect(drawing[1]).toMatchObject({ style: { color: '#2469d6', radius_m: 0.003 }, kept: [[2, 9]] });
    expect(remarks).toEqual([expect.stringContaining(`the ink of 1 curve (${ids()[1]})`)]);
    for (const other of [0, 2]) expect(drawing[other]!.style).toEqual(studio.state.now.history.drawing[other]!.style);
  });

  it('shows ink that is far from the surface on it', () => {
    const { drawing, remarks } = open(spoilt((file) => { file.entries[1].style.offset_m = -40; }));
    expect(drawing[1]!.style).toEqual({ ...studio.settings.style, offset_m: 0 });
    expect(remarks).toHaveLength(1);
  });

  it('shows ink as thick as the studio can draw it as it is', () => {
    const { drawing, remarks } = open(spoilt((file) => { file.entries[1].style.radius_m = 0.012; file.entries[1].style.offset_m = 0.02; }));
    expect(drawing[1]!.style).toMatchObject({ radius_m: 0.012, offset_m: 0.02 });
    expect(remarks).toEqual([]);
  });

  it('of which nothing can be read is refused', () => {
    expect(() => open(spoilt((file) => { for (const s of file.strokes.strokes) s.frames = 'gone'; }))).toThrow(/none of its 3 strokes/);
    expect(() => open(spoilt((file) => { file.entries = null; }))).toThrow(/cut off or damaged/);
  });

  it('never throws anything but a sentence, wherever it is cut or a byte of it is another', () => {
    const bytes = spoilt(() => undefined);
    const seed = 4711, next = random(seed);
    for (let i = 0; i < 60; i += 1) {
      const bad = i % 2 === 0 ? bytes.slice(0, Math.floor(next() * bytes.length)) : bytes.slice();
      if (i % 2 === 1) bad[Math.floor(next() * bad.length)] = 32 + Math.floor(next() * 90);
      try {
        const { drawing } = open(bad);
        for (const { curve } of drawing) curve.dispose();
      } catch (error) {
        expect(error, `seed ${seed}, ${i}`).toBeInstanceOf(Error);
        expect((error as Error).message, `seed ${seed}, ${i}`).toMatch(/^d: /);
      }
    }
  });
});

describe('autosave', () => {
  const content = (drawing: Drawing) => drawing.map(({ curve, ...d }) => ({ ...d, ink: [...curve.ink.integers] }));
  const save = async (autosave: Autosave): Promise<void> => {
    autosave.save(studio.target!, studio.state.now.history.drawing);
    await autosave.settled();
  };

  it('keeps a drawing, and writes only what is new', async () => {
    const shelf = new MemoryShelf(), writes: string[][] = [];
    const autosave = new Autosave({ read: (k) => shelf.read(k), readAll: (k) => shelf.readAll(k), write: (put, remove) => { writes.push([...put.keys()]); return shelf.write(put, remove); } }, () => undefined);
    const { model } = studio.state.now;
    autosave.begin('a', { name: 'Sphere', isOwn: false }, { name: model!.name, source: model!.source }, 'Sphere');
    draw();
    await save(autosave);
    draw(0.05, -0.05, 0.04);
    await save(autosave);
    expect(writes.at(-1)!.filter((key) => key.includes(':'))).toHaveLength(2);
    studio.undo();
    await save(autosave);
    expect([...shelf.items.keys()].filter((key) => key.includes('stroke:'))).toHaveLength(1);
    studio.redo();
    await save(autosave);

    const library = new Library(shelf);
    const stored = (await library.read('a'))!;
    expect(stored.model.source).toEqual({ shape: 'sphere' });
    const { drawing } = recover(studio.target!, stored.entries.map((entry) => ({
      ...entry, stroke: stored.parts.get(entry.strokeKey) as RecordedStroke, curve: () => studio.target!.readCurves(stored.parts.get(entry.curveKey) as Uint8Array, 'a')[0]!,
    })), 'a');
    expect(content(drawing)).toEqual(content(studio.state.now.history.drawing));
    expect(await library.list()).toMatchObject([{ id: 'a', name: 'Sphere', strokes: 2, model: 'Sphere' }]);
    expect(await library.last()).toBe('a');
  });

  it('a drawing is renamed, deleted and brought back while it is drawn on', async () => {
    const shelf = new MemoryShelf(), library = new Library(shelf), autosave = new Autosave(shelf, () => undefined);
    autosave.begin('a', { name: 'Sphere', isOwn: false }, { name: 'sphere', source: { shape: 'sphere' } }, 'Sphere');
    await autosave.settled();
    await library.rename('a', 'Planet');
    draw();
    await save(autosave);
    expect((await library.list())[0]).toMatchObject({ name: 'Planet', isOwn: true, strokes: 1, deleted_ms: null });
    await library.remove('a');
    expect((await library.list())[0]!.deleted_ms).toBeGreaterThan(0);
    await library.tidy(() => Promise.resolve(false)); // not before a week is over
    await library.bringBack('a');
    expect((await library.list())[0]!.deleted_ms).toBe(null);
    autosave.discard('a');
    await autosave.settled();
    expect([...shelf.items.keys()]).toEqual(['last']);
  });

  it('loses only what is damaged of what is kept', async () => {
    const shelf = new MemoryShelf(), library = new Library(shelf), autosave = new Autosave(shelf, () => undefined);
    autosave.begin('a', { name: 'A', isOwn: false }, { name: 'sphere', source: { shape: 'sphere' } }, 'Sphere');
    for (const y of [0, 0.04, 0.08, 0.12]) draw(-0.05, 0.05, y);
    await save(autosave);
    const ids = studio.state.now.history.drawing.map((d) => d.id);
    const curveOf = (id: string): string => [...shelf.items.keys()].find((key) => key.includes(`curve:${id}:`))!;
    shelf.items.set(`content/a/stroke:${ids[0]}`, { id: ids[0], frames: 'no' });
    shelf.items.delete(`content/a/stroke:${ids[1]}`);
    shelf.items.delete(curveOf(ids[2]!));
    (shelf.items.get('content/a/entries') as unknown[]).push(null);
    const stored = (await library.read('a'))!;
    const { drawing, remarks } = recover(studio.target!, stored.entries.map((entry) => ({
      ...entry, stroke: (stored.parts.get(entry.strokeKey) as RecordedStroke | undefined) ?? null, curve: () => studio.target!.readCurves(stored.parts.get(entry.curveKey) as Uint8Array, 'a')[0]!,
    })), 'A');
    expect(content(drawing)).toEqual(content(studio.state.now.history.drawing.slice(2)));
    expect(remarks).toEqual([expect.stringContaining(`2 strokes (${ids[0]}, ${ids[1]})`), expect.stringContaining(ids[2]!)]);
  });

  it('says when the storage is full, goes on, and loses nothing of any drawing', async () => {
    const said: (string | null)[] = [];
    let full = true;
    const shelf = new MemoryShelf();
    const patient = new PatientShelf({ read: (k) => shelf.read(k), readAll: (k) => shelf.readAll(k), write: (put, remove) => (full ? Promise.reject(new DOMException('no', 'QuotaExceededError')) : shelf.write(put, remove)) });
    const autosave = new Autosave(patient, (s) => said.push(s)), library = new Library(patient);
    autosave.begin('a', { name: 'A', isOwn: false }, { name: 'sphere', source: { shape: 'sphere' } }, 'Sphere');
    draw();
    await save(autosave);
    expect(said.at(-1)).toMatch(/storage is full/);
    expect(patient.isWaiting).toBe(true);
    autosave.begin('b', { name: 'B', isOwn: false }, { name: 'sphere', source: { shape: 'sphere' } }, 'Sphere');
    await save(autosave);
    expect((await library.list()).map((d) => d.name).sort()).toEqual(['A', 'B']);
    expect((await library.read('a'))!.entries).toHaveLength(1);
    full = false;
    await save(autosave);
    expect([said.at(-1), patient.isWaiting]).toEqual([null, false]);
    expect((await new Library(shelf).read('a'))!.parts.size).toBeGreaterThan(2);
  });
});
