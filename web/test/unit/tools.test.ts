import { Mimicry } from 'mimicry';
import { beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { kController, kHead, kPressure } from '../../src/drawing/frame';
import { shapeModel } from '../../src/engine/model';
import { XrPen } from '../../src/input/xr_pen';
import { toolSetting, withToolSetting } from '../../src/studio/settings';
import { Studio } from '../../src/studio/studio';
import type { PenSample, Tool } from '../../src/tools/tool';
import { kTools, Tools } from '../../src/tools/tools';
import { helpSections } from '../../src/ui/help';
import { NullView } from './null_view';
import { penAt } from './pen_at';

interface Seen {
  event: 'press' | 'move' | 'release' | 'cancel';
  at: number[] | null;
  pressure: number;
}

/** A whole tool: what a new one needs is this and a row in the list. It writes down what happens to it. */
function stamp(seen: Seen[]): Tool {
  const see = (event: Seen['event'], sample?: PenSample): void => {
    const hit = sample?.hit();
    seen.push({ event, at: hit ? [...hit.position] : null, pressure: sample ? sample.frame[kPressure]! : -1 });
  };
  return {
    name: 'stamp', title: 'Stamp pictures', short: 'Stamp', key: 's', icon: 'M4 16h12', samples: 'surface',
    cursor: { over: 'copy', pressed: 'none' }, hint: { page: 'Press on the model to stamp it.', headset: 'Pull the trigger to stamp' },
    size: {
      title: 'Size of the stamp', least_m: 0.001, most_m: 0.1,
      get: (settings) => toolSetting(settings, 'stamp', 'size_m', 0.02),
      set: (settings, size_m) => withToolSetting(settings, 'stamp', 'size_m', size_m),
    },
    options: [], inks: false, otherEnd: null, takes: ['shift'],
    color: () => '#123456', ring_m: (settings) => toolSetting(settings, 'stamp', 'size_m', 0.02), caption: () => 'Stamp',
    press(studio, sample) {
      studio.beginEdit('stamping');
      see('press', sample);
      return {
        move: (next) => see('move', next),
        release: () => { studio.endEdit(); see('release'); },
        cancel: () => { studio.cancelEdit(); see('cancel'); },
      };
    },
  };
}

let core: Mimicry;
let studio: Studio;
let tools: Tools;
let seen: Seen[];

beforeAll(async () => { core = await new Mimicry().ready; });
beforeEach(() => {
  studio = new Studio(core, new NullView());
  studio.open(shapeModel(core, 'sphere'));
  seen = [];
  tools = new Tools(studio);
});

describe('tools', () => {
  it('are rows that say all of themselves, each with a key of its own', () => {
    expect(kTools.length).toBeGreaterThan(0);
    for (const tool of kTools) {
      expect(tool.key, tool.name).toMatch(/^[a-z]$/);
      for (const text of [tool.name, tool.title, tool.short, tool.icon, tool.hint.page, tool.hint.headset, tool.size.title]) expect(text.length, tool.name).toBeGreaterThan(0);
      studio.set({ tool: tool.name });
      expect(tools.now).toBe(tool);
      expect(tool.caption(studio)).not.toBe('');
      expect(tool.size.get(studio.settings), tool.name).toBeGreaterThanOrEqual(tool.size.least_m);
      expect(tool.size.get(studio.settings), tool.name).toBeLessThanOrEqual(tool.size.most_m);
    }
    expect(() => tools.add({ ...kTools[0]!, name: 'another' })).toThrow(/same name or key \(d\)/);
    studio.set({ tool: 'none such' });
    expect(tools.now).toBe(kTools[0]);
  });

  it('that are added are had by their key, by the next one, in the help, and keep their size', () => {
    expect(tools.chooseByKey('s')).toBe(false);
    tools.add(stamp(seen));
    expect(tools.chooseByKey('s')).toBe(true);
    expect(tools.now.name).toBe('stamp');
    tools.chooseNext();
    expect(tools.now).toBe(kTools[0]);
    for (let i = 0; i < kTools.length; i += 1) tools.chooseNext();
    expect(tools.now.name).toBe('stamp');
    tools.resize(2);
    expect(tools.now.size.get(studio.settings)).toBeCloseTo(0.04, 12);
    tools.resize(1e6);
    expect(tools.now.size.get(studio.settings)).toBe(0.1);
    const rows = helpSections(tools.list.now).flatMap((section) => section.rows);
    expect(rows).toContainEqual([['S'], 'stamp']);
    expect(rows.find(([keys]) => keys[0] === 'thumbstick pressed')![1]).toMatch(/stamp$/);
  });

  it('resize what they write or erase with, within what can be used', () => {
    const { style, eraser_m } = studio.settings;
    tools.resize(2);
    expect(studio.settings.style).toEqual({ ...style, radius_m: 2 * style.radius_m });
    tools.choose(kTools[1]!);
    tools.resize(2);
    expect(studio.settings.eraser_m).toBe(2 * eraser_m);
    tools.resize(1e6);
    expect(studio.settings.eraser_m).toBe(tools.now.size.most_m);
  });

  it('a chosen colour takes one into use that writes', () => {
    tools.add(stamp(seen));
    tools.chooseByKey('s');
    tools.ink('#2469d6');
    expect(studio.settings).toMatchObject({ tool: 'draw', style: { color: '#2469d6' } });
  });

  it('get press, move and release of a controller, on the surface and without gaps', () => {
    const tool = stamp(seen);
    const size_m = 0.01;
    studio.set(tool.size.set(studio.settings, size_m));
    const pen = new XrPen(studio);
    const centre = studio.centre(), place = studio.state.now.modelToWorld, radius = (studio.target!.max[2]! - studio.target!.min[2]!) / 2;
    const hold = (x: number): void => {
      const at = [x * radius, 0, 1.01 * radius].map((v, k) => place[7]! * (v + centre[k]!) + place[4 + k]!);
      pen.frame.set([...at, 0, 0, 0, 1], kController);
      pen.frame.set([at[0]!, at[1]!, at[2]! + 1, 0, 0, 0, 1], kHead);
    };
    hold(-0.5);
    expect(pen.press(tool)).toBe(true);
    expect(pen.used).toBe(tool);
    hold(0.5);
    pen.move();
    pen.release();
    expect(pen.used).toBeNull();
    expect(seen.map(({ event }) => event)).toEqual(['press', ...Array.from({ length: seen.length - 2 }, () => 'move'), 'release']);
    expect(seen.length).toBeGreaterThan(10);
    const places = seen.slice(0, -1).map(({ at }) => at!);
    for (const p of places) expect(Math.hypot(...p.map((v, k) => v - centre[k]!)) / radius).toBeCloseTo(1, 1);
    // Each piece that a tool of this radius works on overlaps the one before.
    for (let i = 1; i < places.length; i += 1) {
      expect(place[7]! * Math.hypot(...places[i]!.map((v, k) => v - places[i - 1]![k]!)), String(i)).toBeLessThan(2 * size_m);
    }
  });

  it('that erase take back what they did when they are cancelled', () => {
    const draw = new XrPen(studio);
    const centre = studio.centre(), place = studio.state.now.modelToWorld, radius = (studio.target!.max[2]! - studio.target!.min[2]!) / 2;
    const at = (i: number): number[] => [0.02 * i * radius, 0, 1.05 * radius].map((v, k) => place[7]! * (v + centre[k]!) + place[4 + k]!);
    for (let i = 0; i < 20; i += 1) {
      draw.frame[0] = i / 90;
      draw.frame.set([...at(i), 0, 0, 0, 1], kController);
      if (i === 0) draw.press(kTools[0]!);
      else draw.move();
    }
    draw.release();
    const before = studio.state.now.history;
    expect(before.drawing).toHaveLength(1);
    const p = before.drawing[0]!.curve.point(10).position;
    for (const tool of kTools.slice(1)) {
      const use = tool.press(studio, penAt(studio, p))!;
      expect(studio.state.now.history.drawing, tool.name).not.toBe(before.drawing);
      use.cancel();
      expect(studio.state.now.history.drawing, tool.name).toBe(before.drawing);
      tool.press(studio, penAt(studio, p))!.release();
      expect(studio.state.now.history.past, tool.name).toHaveLength(2);
      studio.undo();
      expect(studio.state.now.history.drawing, tool.name).toBe(before.drawing);
    }
  });

  it('end what they do where the studio does something else meanwhile', () => {
    const tool = kTools[1]!;
    const use = tool.press(studio, penAt(studio, [0, 0, 1]))!;
    studio.undo();
    use.move(penAt(studio, [0, 0, 1]));
    use.release();
    expect(studio.state.now.history.past).toHaveLength(0);
  });
});
