import { describe, expect, it } from 'vitest';
import { kController, kHead, makeFrame } from '../../src/drawing/frame';
import { clampRadius } from '../../src/drawing/ink_styles';
import { Hysteresis } from '../../src/input/hysteresis';
import { makeView, PlanePen, screenFrame } from '../../src/input/screen_frame';
import { rotate } from '../../src/math/vec';
import { kDefaults, readSettings, toolSetting, withToolSetting, writeSettings } from '../../src/studio/settings';

function towards(x: number, y: number): ReturnType<typeof makeView> {
  const view = makeView();
  const n = Math.hypot(x, y, 1);
  view.direction.set([x / n, y / n, -1 / n]);
  return view;
}

describe('the pen on a screen', () => {
  it('stays on a plane that faces the camera, the gap in front of what was pressed', () => {
    const pen = new PlanePen(), tip = new Float64Array(3);
    const view = towards(0.2, 0.1);
    pen.press(view, 2, 100);
    pen.tip(tip, 0, view);
    expect(Math.hypot(...tip)).toBeCloseTo(1.92, 12);
    const depth = tip[2];
    for (const [x, y] of [[0, 0], [-0.4, 0.3], [0.9, -0.9]] as const) {
      pen.tip(tip, 0, towards(x, y));
      expect(tip[2]).toBeCloseTo(depth!, 12);
    }
  });

  it('never lands behind the eye, however far the wheel brings it', () => {
    const pen = new PlanePen(), tip = new Float64Array(3);
    pen.press(towards(0, 0), 0.1, 5);
    pen.wheel(1000);
    pen.tip(tip, 0, towards(0, 0));
    expect(tip[2]).toBeLessThan(0);
  });

  it('moves ink as fast in the window however near the model is looked at, and stays near a model that is far away', () => {
    const pen = new PlanePen(), tip = new Float64Array(3);
    for (const distance of [0.1, 0.4, 0.8]) {
      pen.press(towards(0, 0), distance, 1);
      pen.tip(tip, 0, towards(0, 0));
      expect(-tip[2]! / distance).toBeCloseTo(0.96, 12);
    }
    pen.press(towards(0, 0), 20, 1);
    pen.tip(tip, 0, towards(0, 0));
    expect(20 + tip[2]!).toBeCloseTo(0.25, 12);
  });

  it('has a head that looks where the pointer is', () => {
    const frame = makeFrame(), view = towards(0.3, -0.2), axis = [0, 0, 0];
    screenFrame(frame, view, new Float64Array(3), 0, -1, 0, 0);
    rotate(axis, 0, frame, kHead + 3, [0, 0, -1], 0);
    for (let k = 0; k < 3; k += 1) expect(axis[k]).toBeCloseTo(view.direction[k]!, 12);
  });

  it('points along the ray, and leans with the pen', () => {
    const frame = makeFrame(), view = towards(0.3, 0), tip = new Float64Array([1, 2, 3]);
    const axis = [0, 0, 0];
    const pointing = (tiltX: number, tiltY: number): number[] => {
      screenFrame(frame, view, tip, 7, 0.4, tiltX, tiltY);
      rotate(axis, 0, frame, kController + 3, [0, 0, -1], 0);
      return [...axis];
    };
    const straight = pointing(0, 0);
    for (let k = 0; k < 3; k += 1) expect(straight[k]).toBeCloseTo(view.direction[k]!, 12);
    expect(pointing(40, 0)[0]).toBeLessThan(straight[0]!);
    expect(pointing(0, 40)[1]).toBeGreaterThan(straight[1]!);
    expect([...frame.subarray(kController, kController + 3)]).toEqual([1, 2, 3]);
    expect([...frame.subarray(kHead, kHead + 3)]).toEqual([0, 0, 0]);
    expect([frame[0], frame[15], frame[16]]).toEqual([7, 1, 0.4]);
  });
});

describe('trigger', () => {
  it('does not flutter between its two values', () => {
    const trigger = new Hysteresis(0.55, 0.35);
    const edges = [0, 0.5, 0.56, 0.5, 0.4, 0.56, 0.36, 0.34, 0.5, 1].map((v) => trigger.update(v));
    expect(edges).toEqual([null, null, 'press', null, null, null, null, 'release', null, 'press']);
  });
});

describe('settings', () => {
  const storage = (text: string | null): Pick<Storage, 'getItem'> => ({ getItem: () => text });

  it('come back as they were, but for tool and comparison', () => {
    let kept = '';
    const chosen = { ...kDefaults, mirror: 'y' as const, technique: 'snap', style: { color: '#2469d6', radius_m: 0.002, offset_m: 0.001 }, tool: 'erase part' as const, compare: 'snap' };
    writeSettings({ setItem: (_, value) => { kept = value; } }, chosen);
    expect(readSettings(storage(kept))).toEqual({ ...chosen, tool: 'draw', compare: null });
  });

  it('are the defaults where nothing, nonsense or something else was kept', () => {
    for (const text of [null, '', '{', '7', '[]', '{"tool": 3, "style": {"color": "red"}, "mirror": "w"}']) expect(readSettings(storage(text))).toEqual(kDefaults);
  });

  it('survive a storage that is off', () => {
    expect(readSettings({ getItem: () => { throw new Error('denied'); } })).toEqual(kDefaults);
    expect(() => writeSettings({ setItem: () => { throw new Error('full'); } }, kDefaults)).not.toThrow();
  });

  it('of a page that drew on a plane by default draw under the pointer', () => {
    expect(readSettings(storage('{"penPlace": "in front"}')).penPlace).toBe('under the pointer');
    expect(readSettings(storage('{"penPlace": "on a plane"}')).penPlace).toBe('on a plane');
  });

  it('of tools come back too, and of another kind are not taken', () => {
    let kept = '';
    const chosen = { ...kDefaults, ...withToolSetting(kDefaults, 'stamp', 'size_m', 0.01) };
    writeSettings({ setItem: (_, value) => { kept = value; } }, chosen);
    const read = readSettings(storage(kept));
    expect(toolSetting(read, 'stamp', 'size_m', 0.5)).toBe(0.01);
    expect(toolSetting(read, 'stamp', 'size_m', 'large')).toBe('large');
    expect(toolSetting(read, 'another', 'size_m', 0.5)).toBe(0.5);
    for (const ofTools of ['7', '[]', '{"stamp": 1}', '{"stamp": {"size_m": null}}']) expect(readSettings(storage(`{"ofTools": ${ofTools}}`)).ofTools).toEqual({});
  });

  it('radii are held within what can be drawn', () => {
    expect(clampRadius(1)).toBeLessThan(0.02);
    expect(clampRadius(0)).toBeGreaterThan(0);
  });
});
