import { existsSync } from 'node:fs';
import type { CDPSession, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { kAcross, kWindow, Lab, messages, reset, stroke, summary, type Opened } from './studio_page';

let lab: Lab;
let opened: Opened;
let page: Page;
let session: CDPSession;

beforeAll(async () => {
  lab = await Lab.start();
  opened = await lab.open({ hasTouch: true });
  page = opened.page;
  session = await opened.context.newCDPSession(page);
});
afterAll(() => lab.stop());
beforeEach(() => reset(page));
afterEach(() => { expect(opened.errors).toEqual([]); });

interface Camera { position: number[]; turn: number[] }
const camera = (): Promise<Camera> => page.evaluate(() => {
  const { camera: c } = window.studio.stage;
  return { position: c.position.toArray(), turn: c.quaternion.toArray() };
});
const distance = (): Promise<number> => page.evaluate(() => window.studio.stage.rig.distance);

/** The ink of the last curve in the window. */
const inkInWindow = (): Promise<[number, number][]> => page.evaluate(() => {
  const { stage, studio, view } = window.studio;
  const { ink } = studio.state.now.history.drawing.at(-1)!.curve;
  return Array.from({ length: ink.count }, (_, i) => {
    const v = view.model.group.localToWorld(stage.camera.position.clone().set(ink.floats[8 * i]!, ink.floats[8 * i + 1]!, ink.floats[8 * i + 2]!)).project(stage.camera);
    return [((v.x + 1) / 2) * innerWidth, ((1 - v.y) / 2) * innerHeight] as [number, number];
  });
});

/** Fingers as the browser reports them. */
async function touch(type: 'touchStart' | 'touchMove' | 'touchEnd', points: [number, number][]): Promise<void> {
  await session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
}

interface More { button?: number; buttons?: number; pressure?: number }
type Sent = [type: 'pointerdown' | 'pointermove' | 'pointerup' | 'pointercancel', id: number, kind: 'pen' | 'touch', x: number, y: number, more?: More];

/** Events of pens and hands in the order in which they come, `gap_ms` apart. */
async function send(events: readonly Sent[], gap_ms = 0): Promise<void> {
  for (const event of events) {
    await page.evaluate(([type, pointerId, pointerType, clientX, clientY, more]) => {
      document.querySelector('canvas')!.dispatchEvent(new PointerEvent(type, {
        pointerId, pointerType, clientX, clientY, bubbles: true, pressure: 0.5, button: type === 'pointermove' ? -1 : 0, buttons: type === 'pointerup' ? 0 : 1, ...more,
      }));
    }, event);
    if (gap_ms > 0) await page.waitForTimeout(gap_ms);
  }
}

const kPen = 40, kPalm = 50;
/** A pen from left to right over the model. */
const penMoves = (from: number, to: number, more: More = {}): Sent[] =>
  Array.from({ length: 8 }, (_, i): Sent => ['pointermove', kPen, 'pen', from + ((to - from) * (i + 1)) / 8, 240, more]);

/** All techniques work on the first model. */
async function prepare(): Promise<void> {
  await page.setInputFiles('input[type=file]', 'embeddings/hand.mimicry');
  await page.waitForFunction(() => window.studio.studio.state.now.hasEmbedding);
  await page.evaluate(() => document.querySelectorAll('.message').forEach((message) => message.remove()));
}

describe('on a screen', () => {
  it('ink comes where the pointer is, with every technique, also zoomed in', async () => {
    if (existsSync('embeddings/hand.mimicry')) await prepare();
    const techniques = await page.evaluate(() => window.studio.studio.core.techniques.filter((t) => window.studio.studio.offers(t.name)).map((t) => t.name));
    for (const zoomed of [false, true]) {
      if (zoomed) {
        await page.mouse.move(330, 240);
        await page.mouse.wheel(0, -700);
      }
      for (const technique of techniques) {
        await page.evaluate((name) => { window.studio.studio.clear(); window.studio.studio.set({ technique: name }); }, technique);
        await stroke(page, [[310, 240], [340, 238], [365, 240]], 5);
        const ink = await inkInWindow();
        expect(ink.length, technique).toBeGreaterThan(1);
        expect(Math.hypot(ink[0]![0] - 310, ink[0]![1] - 240), `${technique} starts`).toBeLessThan(1.5);
        if (technique === 'mimicry-planar') continue; // it says why: below
        expect(Math.hypot(ink.at(-1)![0] - 365, ink.at(-1)![1] - 240), `${technique} ends`).toBeLessThan(4);
      }
    }
  }, 240000);

  it('a technique that leaves little ink says so, and why', async () => {
    const lengths: number[] = [];
    const way = 3 * 60;
    for (const technique of ['mimicry-planar', 'snap']) {
      await page.evaluate((name) => { window.studio.studio.set({ technique: name }); document.querySelectorAll('.message').forEach((m) => m.remove()); }, technique);
      await stroke(page, [[305, 232], [364, 240], [306, 248], [364, 256]], 8);
      const ink = await inkInWindow();
      let length = 0;
      for (let i = 1; i < ink.length; i += 1) length += Math.hypot(ink[i]![0] - ink[i - 1]![0], ink[i]![1] - ink[i - 1]![1]);
      lengths.push(length / way);
      await expect.poll(() => messages(page), { message: `${technique} ${length}` }).toEqual(length < 0.5 * way ? [expect.stringMatching(/drew little of this stroke: .* choose another technique/)] : []);
    }
    expect(lengths[1]).toBeGreaterThan(0.9);
    // Whatever the stroke, the sentence knows what the technique needs.
    await page.evaluate(() => window.studio.pointer.pen.onLittleInk('mimicry-planar'));
    await expect.poll(async () => (await messages(page)).at(-1)).toMatch(/Mimicry planar.*needs a hand that moves in space/);
  });

  it('the pen on a plane draws as fast in the window from near as from far', async () => {
    await page.evaluate(() => window.studio.studio.set({ penPlace: 'on a plane', technique: 'occlude' }));
    const part = async (): Promise<number> => page.evaluate(() => {
      const { stroke: drawn } = window.studio.studio.state.now.history.drawing.at(-1)!;
      const c = window.studio.stage.camera.position, t = [8, 9, 10].map((k) => drawn.frames[k]!);
      const { curve } = window.studio.studio.state.now.history.drawing.at(-1)!;
      const p = curve.point(0).position, m = drawn.modelToWorld;
      const q = [0, 1, 2].map((k) => m[7]! * p[k as 0]! + m[4 + k]!);
      return Math.hypot(t[0]! - c.x, t[1]! - c.y, t[2]! - c.z) / Math.hypot(q[0]! - c.x, q[1]! - c.y, q[2]! - c.z);
    });
    await stroke(page, kAcross);
    const far = await part();
    await page.mouse.move(330, 240);
    await page.mouse.wheel(0, -700);
    await stroke(page, kAcross);
    await expect.poll(part).toBeCloseTo(far, 2);
  });

  it('a pointer that leaves the model and comes back draws under the pointer again', async () => {
    await stroke(page, [[340, 240], [620, 240], [340, 240], [345, 262]], 20);
    const [x, y] = (await inkInWindow()).at(-1)!;
    expect(Math.hypot(x - 345, y - 262)).toBeLessThan(4);
  });
});

// Before any pen is seen: then they only navigate.
describe('fingers anywhere', () => {
  const both = async (from: [number, number][], steps: [number, number][][]): Promise<void> => {
    await touch('touchStart', [from[0]!]);
    await touch('touchStart', from);
    for (const points of steps) await touch('touchMove', points);
    await touch('touchEnd', []);
  };
  const steps = (a: (t: number) => [number, number], b: (t: number) => [number, number]): [number, number][][] => Array.from({ length: 10 }, (_, i) => [a((i + 1) / 10), b((i + 1) / 10)]);

  it('two together turn the view over the model', async () => {
    const before = await camera(), far = await distance();
    await both([[310, 240], [350, 240]], steps((t) => [310 + 60 * t, 240], (t) => [350 + 60 * t, 240]));
    await expect.poll(async () => (await camera()).turn).not.toEqual(before.turn);
    await expect.poll(distance).toBeCloseTo(far, 9);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });

  it('two apart zoom, move and twist the picture', async () => {
    const far = await distance(), before = await camera();
    await both([[320, 240], [340, 240]], steps((t) => [320 - 40 * t, 240], (t) => [340 + 40 * t, 240]));
    await expect.poll(async () => far / (await distance())).toBeCloseTo(5, 1);
    await expect.poll(async () => (await camera()).turn.map((v, k) => Math.abs(v - before.turn[k]!) < 1e-9)).toEqual([true, true, true, true]);
    await page.keyboard.press('f');
    const start = await camera();
    const quarter = (t: number, phase: number): [number, number] => [330 + 50 * Math.cos(phase + (t * Math.PI) / 2), 240 + 50 * Math.sin(phase + (t * Math.PI) / 2)];
    await both([quarter(0, 0), quarter(0, Math.PI)], steps((t) => quarter(t, 0), (t) => quarter(t, Math.PI)));
    // A quarter turn about the camera's axis: the quaternions' product has half that angle.
    await expect.poll(async () => Math.abs((await camera()).turn.reduce((sum, v, k) => sum + v * start.turn[k]!, 0))).toBeCloseTo(Math.cos(Math.PI / 4), 1);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });

  it('a tap with two undoes, with three redoes', async () => {
    await stroke(page, kAcross);
    const tap = async (count: number): Promise<void> => {
      const points = Array.from({ length: count }, (_, i): [number, number] => [300 + 40 * i, 240]);
      await page.evaluate((all) => {
        const canvas = document.querySelector('canvas')!;
        for (const type of ['pointerdown', 'pointerup']) {
          all.forEach(([x, y], i) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: 60 + i, pointerType: 'touch', clientX: x, clientY: y, button: 0, buttons: type === 'pointerup' ? 0 : 1 })));
        }
      }, points);
    };
    await tap(2);
    await expect.poll(() => summary(page)).toMatchObject({ curves: [], future: 1 });
    await tap(3);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });

  it('ten at once are harmless, and the next one draws', async () => {
    const ten = (t: number): [number, number][] => Array.from({ length: 10 }, (_, i) => [260 + 15 * i + 10 * t, 220 + (i % 3) * 20 - 7 * t * i]);
    for (let i = 1; i <= 10; i += 1) await touch('touchStart', ten(0).slice(0, i));
    for (let i = 1; i <= 5; i += 1) await touch('touchMove', ten(i / 5));
    await touch('touchEnd', []);
    await expect.poll(() => summary(page)).toMatchObject({ curves: [], drawing: false, past: 0 });
    const finite = await page.evaluate(() => window.studio.stage.camera.matrixWorld.elements.every(Number.isFinite));
    expect(finite).toBe(true);
    await page.keyboard.press('f');
    await touch('touchStart', [[310, 240]]);
    for (let i = 1; i <= 10; i += 1) await touch('touchMove', [[310 + 5 * i, 240]]);
    await touch('touchEnd', []);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });
});

describe('a pen', () => {
  it('beats the fingers that came before, and palms neither cut nor cancel its stroke', async () => {
    await send([['pointerdown', kPalm, 'touch', 330, 260], ['pointermove', kPalm, 'touch', 334, 262],
      ['pointerdown', kPen, 'pen', 300, 240], ...penMoves(300, 330), ['pointerdown', kPalm + 1, 'touch', 360, 300], ['pointermove', kPalm, 'touch', 350, 270],
      ['pointerup', kPalm + 1, 'touch', 360, 300], ...penMoves(330, 360), ['pointercancel', kPalm, 'touch', 350, 270], ...penMoves(360, 370), ['pointerup', kPen, 'pen', 370, 240]]);
    const { curves, past } = await summary(page);
    expect([curves.length, past]).toEqual([1, 1]);
    expect(curves[0]!.frames).toBe(25);
  });

  it('was seen: fingers only navigate; a hand beside it does nothing', async () => {
    await send([['pointermove', kPen, 'pen', 300, 240, { buttons: 0 }]]);
    const before = await camera();
    await send([['pointerdown', kPalm, 'touch', 330, 240], ['pointermove', kPalm, 'touch', 380, 240], ['pointerup', kPalm, 'touch', 380, 240]]);
    await expect.poll(camera).toEqual(before);
    await page.waitForTimeout(500); // the pen has gone
    await send([['pointerdown', kPalm, 'touch', 330, 240], ['pointermove', kPalm, 'touch', 380, 240], ['pointerup', kPalm, 'touch', 380, 240]]);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
    await expect.poll(camera).not.toEqual(before);
  });

  it('with its eraser end erases, whatever the tool', async () => {
    await stroke(page, [[300, 240], [365, 240]], 20);
    await send([['pointerdown', kPen, 'pen', 330, 230, { button: 5, buttons: 32 }], ['pointermove', kPen, 'pen', 330, 250, { buttons: 32 }], ['pointerup', kPen, 'pen', 330, 250, { button: 5, buttons: 0 }]]);
    const { curves } = await summary(page);
    expect(curves).toHaveLength(1);
    expect(curves[0]!.kept).toHaveLength(2);
    await expect.poll(() => page.evaluate(() => window.studio.studio.settings.tool)).toBe('draw');
  });

  it('starts at what is pressed on, wherever that is and however it leans', async () => {
    for (const shape of ['hand', 'trefoil', 'noisy-cube']) {
      const far = await page.evaluate(async (name) => {
        const { studio, stage } = window.studio;
        if (!studio.core.shapes.some((s) => s.name === name)) return { presses: 0, worst: NaN };
        window.studio.openShape(name);
        stage.rig.jump();
        const canvas = document.querySelector('canvas')!;
        let presses = 0, worst = 0;
        for (let i = 0; i < 120; i += 1) {
          const x = 270 + ((i * 37) % 110), y = 170 + ((i * 29) % 140);
          const eye = stage.camera.position, m = studio.state.now.modelToWorld;
          const to = eye.clone().set((2 * x) / innerWidth - 1, 1 - (2 * y) / innerHeight, 0.5).unproject(stage.camera).sub(eye);
          const seen = studio.target!.firstHit((eye.x - m[4]!) / m[7]!, (eye.y - m[5]!) / m[7]!, (eye.z - m[6]!) / m[7]!, to.x, to.y, to.z);
          if (!seen) continue;
          const p = [...seen.position];
          studio.set({ technique: ['spraycan', 'occlude', 'mimicry-live', 'anchored-ray-plane', 'snap', 'head-centric'][presses % 6]! });
          for (const type of ['pointerdown', 'pointerup']) {
            canvas.dispatchEvent(new PointerEvent(type, { pointerId: 80, pointerType: 'pen', pressure: 0.5, tiltX: 50 - (i % 100), tiltY: (i * 7) % 50, button: 0, buttons: type === 'pointerup' ? 0 : 1, clientX: x, clientY: y }));
          }
          const drawn = studio.state.now.history.drawing.at(-1);
          if (!drawn) return { presses, worst: Infinity, at: [x, y, studio.settings.technique] };
          const q = drawn.curve.point(0).position;
          worst = Math.max(worst, Math.hypot(...p.map((v, k) => v - q[k as 0]!)) / studio.target!.diagonal);
          presses += 1;
          studio.undo();
        }
        return { presses, worst };
      }, shape);
      if (shape === 'hand') expect(far.presses, JSON.stringify(far)).toBeGreaterThan(30);
      if (far.presses > 0) expect(far.worst, `${shape} ${JSON.stringify(far)}`).toBeLessThan(1e-4);
    }
  });

  it('that tells no pressure and no tilt draws at full width', async () => {
    // A fresh page: pressures that were seen are remembered.
    const { page: fresh, context } = await lab.open();
    const own = page;
    page = fresh;
    try {
      await send([['pointerdown', kPen, 'pen', 300, 240, { pressure: 0 }], ...penMoves(300, 360, { pressure: 0 }), ['pointerup', kPen, 'pen', 360, 240]]);
      await page.evaluate(() => {
        const canvas = document.querySelector('canvas')!;
        for (const [type, x] of [['pointerdown', 320], ['pointermove', 330], ['pointermove', 340], ['pointerup', 340]] as const) {
          const event = new PointerEvent(type, { pointerId: 41, pointerType: 'pen', clientX: x, clientY: 270, button: type === 'pointermove' ? -1 : 0, buttons: 1 });
          for (const name of ['pressure', 'tiltX', 'tiltY']) Object.defineProperty(event, name, { value: undefined });
          canvas.dispatchEvent(event);
        }
      });
      const { curves } = await summary(fresh);
      expect(curves.map((c) => [...new Set(c.pressures)])).toEqual([[-1], [-1]]);
    } finally {
      page = own;
      await context.close();
    }
  });
});

describe('keys', () => {
  it('Alt, Ctrl and Space with a drag turn the view, whatever has the focus, and press no button', async () => {
    for (const key of ['Alt', 'Control', 'Space']) {
      for (const focus of ['canvas', 'button[aria-label="Undo"]', '#dock [role=radio]', 'input[type=range]', '#technique']) {
        if (key === 'Space') await stroke(page, kAcross);
        const { curves } = await summary(page);
        await page.locator(focus).first().focus();
        const before = await camera();
        await page.keyboard.down(key);
        await stroke(page, kAcross);
        await page.keyboard.up(key);
        await expect.poll(async () => (await camera()).turn, { message: `${key} ${focus}` }).not.toEqual(before.turn);
        await expect.poll(async () => (await summary(page)).curves.length, { message: `${key} ${focus}` }).toBe(curves.length);
        await expect.poll(() => page.locator('#techniques').isVisible()).toBe(false);
        await page.keyboard.press('f');
      }
    }
  }, 240000);

  it('Space does not stick after the window lost the focus', async () => {
    await page.locator('canvas').focus();
    await page.keyboard.down('Space');
    await page.evaluate(() => window.dispatchEvent(new Event('blur')));
    await stroke(page, kAcross);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
    await page.keyboard.up('Space');
  });

  it('Escape drops the stroke and what is being erased', async () => {
    await page.mouse.move(300, 240);
    await page.mouse.down();
    await page.mouse.move(340, 240, { steps: 8 });
    await page.keyboard.press('Escape');
    await page.mouse.move(360, 240, { steps: 4 });
    await page.mouse.up();
    await expect.poll(() => summary(page)).toMatchObject({ curves: [], drawing: false, past: 0 });
    await stroke(page, [[300, 240], [365, 240]], 20);
    await page.keyboard.press('e');
    await page.mouse.move(330, 240);
    await page.mouse.down();
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await expect.poll(() => summary(page)).toMatchObject({ past: 1, drawing: false });
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });

  it('Ctrl Z works wherever the focus is, and on other scripts', async () => {
    await page.keyboard.press('c');
    for (const focus of ['#techniques input', '#halves select', '#dock [role=radio]', 'input[type=range]', 'canvas']) {
      await stroke(page, [[150, 240], [175, 230]]);
      await expect.poll(async () => (await summary(page)).curves, { message: focus }).toHaveLength(1);
      if (focus.startsWith('#techniques')) await page.keyboard.press('t');
      await page.locator(focus).first().focus();
      await page.keyboard.press('Control+z');
      await expect.poll(async () => (await summary(page)).curves, { message: focus }).toHaveLength(0);
      if (focus.startsWith('#techniques')) await page.keyboard.press('Escape');
    }
    await stroke(page, [[150, 240], [175, 230]]);
    await page.evaluate(() => window.dispatchEvent(new KeyboardEvent('keydown', { key: 'я', code: 'KeyZ', ctrlKey: true })));
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });
});

describe('zoom', () => {
  /** The point of the model under the pointer. */
  const under = (x: number, y: number): Promise<number[] | null> => page.evaluate(([px, py]) => {
    const { stage, studio } = window.studio;
    const w = stage.split ? innerWidth / 2 : innerWidth;
    const left = stage.split && px! > w ? w : 0;
    const eye = stage.camera.position, m = studio.state.now.modelToWorld;
    const to = eye.clone().set((2 * (px! - left)) / w - 1, 1 - (2 * py!) / innerHeight, 0.5).unproject(stage.camera).sub(eye);
    const hit = studio.target!.firstHit((eye.x - m[4]!) / m[7]!, (eye.y - m[5]!) / m[7]!, (eye.z - m[6]!) / m[7]!, to.x, to.y, to.z);
    return hit && [...hit.position];
  }, [x, y]);

  it('goes to the pointer, in either half of a comparison too', async () => {
    for (const [x, compare] of [[350, false], [150, true], [490, true]] as const) {
      await page.evaluate((on) => window.studio.studio.set({ compare: on ? 'snap' : null }), compare);
      await page.keyboard.press('f');
      await page.waitForFunction((on) => window.studio.stage.split === on, compare);
      const before = await under(x, 250), far = await distance();
      await page.mouse.move(x, 250);
      await page.mouse.wheel(0, -400);
      await expect.poll(async () => (await distance()) / far).toBeLessThan(0.7);
      const after = await under(x, 250);
      const diagonal = await page.evaluate(() => window.studio.studio.target!.diagonal);
      expect(Math.hypot(...before!.map((v, k) => v - after![k]!)) / diagonal).toBeLessThan(0.08);
    }
  });

  it('by a trackpad’s pinch goes as far as the fingers', async () => {
    const far = await distance();
    await page.evaluate(() => {
      // Fingers that go twice as far apart, as browsers report it.
      for (let i = 0; i < 20; i += 1) document.querySelector('canvas')!.dispatchEvent(new WheelEvent('wheel', { deltaY: (-100 * Math.log(2)) / 20, ctrlKey: true, clientX: 320, clientY: 240, cancelable: true }));
    });
    await expect.poll(async () => far / (await distance())).toBeCloseTo(2, 6);
  });
});

describe('the eraser', () => {
  it('leaves no gaps between events that are far apart', async () => {
    for (let i = 0; i < 5; i += 1) await stroke(page, [[305 + 12 * i, 225], [305 + 12 * i, 255]], 10);
    await page.keyboard.press('e');
    await stroke(page, [[300, 240], [362, 240]], 1);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
    await expect.poll(async () => (await summary(page)).past).toBe(6);
  });

  it('has a size, by slider and key, and takes mirrored copies', async () => {
    await page.keyboard.press('m');
    await stroke(page, [[335, 240], [365, 240]], 20);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(2);
    await page.keyboard.press('r');
    const before = await page.evaluate(() => window.studio.studio.settings.eraser_m);
    await page.keyboard.press(']');
    await expect.poll(() => page.evaluate(() => window.studio.studio.settings.eraser_m)).toBeGreaterThan(before);
    await page.getByRole('slider', { name: 'Size of the eraser' }).fill('20');
    await expect.poll(() => page.evaluate(() => window.studio.studio.settings.eraser_m)).toBeLessThan(before);
    await stroke(page, [[350, 235], [350, 245]], 4);
    const { curves } = await summary(page);
    expect(curves.map((c) => c.kept.length)).toEqual([2, 2]);
    expect(curves[0]!.kept).toEqual(curves[1]!.kept);
    await page.keyboard.press('e');
    await stroke(page, [[340, 235], [340, 245]], 4);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });
});

describe('the graphics driver', () => {
  it('may be reset in mid-stroke: the stroke goes on and nothing is lost', async () => {
    await page.mouse.move(300, 240);
    await page.mouse.down();
    await page.mouse.move(330, 240, { steps: 8 });
    await page.evaluate(() => Object.assign(window, { loss: window.studio.stage.renderer.getContext().getExtension('WEBGL_lose_context') }));
    await page.evaluate(() => (window as unknown as { loss: WEBGL_lose_context }).loss.loseContext());
    await expect.poll(() => messages(page)).toEqual([expect.stringContaining('drawing is safe')]);
    await page.mouse.move(350, 240, { steps: 8 });
    await page.evaluate(() => (window as unknown as { loss: WEBGL_lose_context }).loss.restoreContext());
    await page.waitForFunction(() => !window.studio.stage.renderer.getContext().isContextLost());
    await page.mouse.move(365, 240, { steps: 8 });
    await page.mouse.up();
    const { curves } = await summary(page);
    expect(curves).toHaveLength(1);
    expect(curves[0]!.frames).toBeGreaterThanOrEqual(25);
    const ink = await inkInWindow();
    expect(Math.hypot(ink.at(-1)![0] - 365, ink.at(-1)![1] - 240)).toBeLessThan(4);
    // And it is seen: vermilion where the pen was in each third.
    await expect.poll(() => page.evaluate(() => {
      const { stage } = window.studio;
      stage.renderer.render(stage.scene, stage.camera);
      const gl = stage.renderer.getContext(), out = new Uint8Array(4 * 61 * 9);
      gl.readPixels(302, innerHeight - 244, 61, 9, gl.RGBA, gl.UNSIGNED_BYTE, out);
      const red = (x: number): boolean => Array.from({ length: 9 }, (_, y) => 4 * (61 * y + x)).some((at) => out[at]! > 1.6 * out[at + 1]!);
      return [10, 35, 55].map(red);
    })).toEqual([true, true, true]);
  });
});

describe('small windows', () => {
  it('every control is reachable at 480 px height and 360 px width', async () => {
    for (const size of [{ width: 360, height: 480 }, { width: 360, height: 740 }, { width: 800, height: 360 }]) {
      await page.setViewportSize(size);
      const hidden = await page.evaluate(() => {
        const all = [...document.querySelectorAll<HTMLElement>('#top button, #bottom > button, #dock button, #dock input')].filter((e) => !e.hidden && !e.classList.contains('only-wide') && !e.classList.contains('only-narrow'));
        return all.filter((e) => {
          const r = e.getBoundingClientRect();
          const x = r.left + r.width / 2, y = r.top + r.height / 2;
          const top = document.elementFromPoint(x, y);
          return r.width === 0 || r.left < 0 || r.top < 0 || r.right > innerWidth + 0.5 || r.bottom > innerHeight + 0.5 || !top || !(e.contains(top) || top.contains(e));
        }).map((e) => e.getAttribute('aria-label') ?? e.textContent);
      });
      expect(hidden, JSON.stringify(size)).toEqual([]);
      for (const [opener, sheet] of [['Symmetry, pen and hand', '#pen-panel'], ['Save, export and more', '#files']] as const) {
        await page.getByRole('button', { name: opener }).click();
        for (const control of await page.locator(`${sheet} button, ${sheet} input`).all()) {
          if (!(await control.isVisible())) continue;
          await control.scrollIntoViewIfNeeded();
          const box = (await control.boundingBox())!;
          expect(box.x >= 0 && box.y >= 0 && box.x + box.width <= size.width && box.y + box.height <= size.height, `${sheet} ${await control.textContent()}`).toBe(true);
        }
        await page.keyboard.press('Escape');
      }
    }
    await page.setViewportSize(kWindow);
  }, 240000);
});
