import type { CDPSession, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { kAcross, kWindow, Lab, reset, stroke, summary, type Opened } from './studio_page';

let lab: Lab;
let opened: Opened;
let page: Page;

beforeAll(async () => {
  lab = await Lab.start();
  opened = await lab.open({ hasTouch: true });
  page = opened.page;
});
afterAll(() => lab.stop());
beforeEach(() => reset(page));
afterEach(() => { expect(opened.errors).toEqual([]); });

const cdp = (): Promise<CDPSession> => opened.context.newCDPSession(page);
const press = (name: string): Promise<void> => page.getByRole('button', { name, exact: true }).click();
const camera = (): Promise<number[]> => page.evaluate(() => window.studio.stage.camera.matrixWorld.elements.slice());

describe('mouse', () => {
  it('draws on the model, one gesture after opening', async () => {
    await stroke(page, kAcross);
    const { curves, drawing } = await summary(page);
    expect(drawing).toBe(false);
    expect(curves).toHaveLength(1);
    expect(curves[0]).toMatchObject({ technique: 'mimicry-live', mirror: null });
    expect(curves[0]!.points).toBeGreaterThan(10);
    expect(new Set(curves[0]!.pressures)).toEqual(new Set([-1]));
  });

  it('keeps the pen on a plane in front of the model where that is asked for, and the wheel moves it', async () => {
    await page.keyboard.press('p');
    await page.mouse.move(300, 240);
    await page.mouse.down();
    await page.mouse.move(320, 225, { steps: 4 });
    await page.mouse.wheel(0, 300);
    await page.mouse.move(345, 225, { steps: 4 });
    await page.mouse.up();
    const depths = await page.evaluate(() => {
      const { stroke: drawn } = window.studio.studio.state.now.history.drawing[0]!;
      const camera = window.studio.stage.camera, m = camera.matrixWorld.elements;
      const out: number[] = [];
      for (let i = 0; i < drawn.frames.length; i += 17) {
        let d = 0;
        for (let k = 0; k < 3; k += 1) d += (drawn.frames[i + 8 + k]! - m[12 + k]!) * -m[8 + k]!;
        out.push(d);
      }
      return out;
    });
    const first = depths[0]!, last = depths.at(-1)!;
    expect(Math.abs(depths[3]! - first)).toBeLessThan(1e-9);
    // The gap is 0.04 of the distance; three steps of an eighth of it.
    expect((first - last) / first).toBeCloseTo(((3 / 8) * 0.04) / 0.96, 3);
  });

  it('beside the model turns the view, with Shift moves it, with the wheel zooms', async () => {
    const start = await camera();
    await stroke(page, [[60, 200], [120, 220]]);
    const turned = await camera();
    expect(turned.slice(0, 3)).not.toEqual(start.slice(0, 3));
    await page.keyboard.down('Shift');
    await stroke(page, [[340, 240], [370, 240]]);
    await page.keyboard.up('Shift');
    const moved = await camera();
    expect(moved.slice(0, 11)).toEqual(turned.slice(0, 11));
    expect(moved.slice(12)).not.toEqual(turned.slice(12));
    await page.mouse.wheel(0, -300);
    await expect.poll(camera).not.toEqual(moved);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });

  it('with the right button or the space bar turns the view over the model too', async () => {
    await page.mouse.move(340, 240);
    await page.mouse.down({ button: 'right' });
    await page.mouse.move(390, 240, { steps: 4 });
    await page.mouse.up({ button: 'right' });
    await page.keyboard.down('Space');
    await stroke(page, kAcross);
    await page.keyboard.up('Space');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });

  it('undoes and redoes, by button and by key', async () => {
    await stroke(page, kAcross);
    await stroke(page, [[320, 280], [365, 285]]);
    await press('Undo');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
    await page.keyboard.press('Control+z');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
    await expect.poll(() => page.getByRole('button', { name: 'Undo', exact: true }).isDisabled()).toBe(true);
    await page.keyboard.press('Control+Shift+z');
    await press('Redo');
    const { curves, future } = await summary(page);
    expect(curves).toHaveLength(2);
    expect(future).toBe(0);
  });

  it('erases a whole curve, and part of one', async () => {
    await stroke(page, kAcross, 20);
    await stroke(page, [[320, 280], [375, 285]], 20);
    // Where ink is seen: the curve's own points, in the window.
    const at = async (curve: number, part: number): Promise<[number, number]> => page.evaluate(([c, p]) => {
      const { stage, studio, view } = window.studio;
      const { ink } = studio.state.now.history.drawing[c!]!.curve;
      const i = Math.floor(p! * (ink.count - 1)) * 8;
      const v = view.model.group.localToWorld(stage.camera.position.clone().set(ink.floats[i]!, ink.floats[i + 1]!, ink.floats[i + 2]!)).project(stage.camera);
      return [((v.x + 1) / 2) * innerWidth, ((1 - v.y) / 2) * innerHeight] as [number, number];
    }, [curve, part]);
    await page.keyboard.press('r');
    const middle = await at(0, 0.5);
    await stroke(page, [middle, middle]);
    let now = await summary(page);
    expect(now.curves[0]!.kept).toHaveLength(2);
    expect(now.past).toBe(3);
    await page.keyboard.press('e');
    const other = await at(1, 0.5);
    await stroke(page, [other, other]);
    now = await summary(page);
    expect(now.curves).toHaveLength(1);
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    now = await summary(page);
    expect(now.curves).toHaveLength(2);
    expect(now.curves[0]!.kept).toHaveLength(1);
  });

  it('draws in the chosen colour, thickness and technique', async () => {
    await page.getByRole('radio', { name: 'Blue' }).click();
    await page.keyboard.press(']');
    await page.keyboard.press('t');
    await page.getByRole('radio', { name: /Spraycan/ }).check();
    await page.keyboard.press('Escape');
    await stroke(page, kAcross);
    const { curves } = await summary(page);
    expect(curves[0]).toMatchObject({ technique: 'spraycan', color: '#2469d6' });
  });

  it('draws the mirror image with symmetry, and undoes both at once', async () => {
    await page.keyboard.press('m');
    await stroke(page, kAcross);
    const { curves } = await summary(page);
    expect(curves.map((c) => c.mirror)).toEqual([null, 'x']);
    expect(curves[1]!.points).toBeGreaterThan(3);
    await page.keyboard.press('Control+z');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });

  it('redraws the last stroke with another technique', async () => {
    await stroke(page, kAcross);
    await page.keyboard.press('t');
    await page.getByRole('radio', { name: /Occlude/ }).check();
    await press('Redraw the last stroke with it');
    const { curves } = await summary(page);
    expect(curves).toHaveLength(1);
    expect(curves[0]!.technique).toBe('occlude');
  });

  it('shows the last stroke through another technique beside it', async () => {
    await stroke(page, kAcross);
    await page.keyboard.press('c');
    await page.getByRole('combobox').selectOption('snap');
    const half = await page.evaluate(() => ({ split: window.studio.stage.split, children: window.studio.view.twin.group.children.at(-1)!.children.length }));
    expect(half).toEqual({ split: true, children: 1 });
    await stroke(page, [[150, 240], [175, 230]]); // in the left half
    await stroke(page, [[470, 240], [495, 230]]); // and in the right one
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(3);
  });

  it('ends the stroke and keeps it when the window is resized or loses the focus', async () => {
    await page.mouse.move(300, 240);
    await page.mouse.down();
    await page.mouse.move(320, 225, { steps: 5 });
    await page.setViewportSize({ width: 700, height: 560 });
    await page.mouse.move(330, 235, { steps: 5 });
    await page.evaluate(() => window.dispatchEvent(new Event('blur')));
    const { curves, drawing } = await summary(page);
    expect(drawing).toBe(false);
    expect(curves).toHaveLength(1);
    await page.mouse.up();
    const size = await page.$eval('canvas', (canvas) => [canvas.width, canvas.height]);
    expect(size).toEqual([700, 560]);
    await stroke(page, [[350, 330], [380, 320]]);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(2);
    await page.setViewportSize(kWindow);
  });
});

describe('keyboard', () => {
  it('draws with Enter and the arrows, and turns the view with the arrows alone', async () => {
    await page.locator('canvas').focus();
    const start = await camera();
    await page.keyboard.press('Enter');
    for (let i = 0; i < 8; i += 1) await page.keyboard.press('ArrowRight');
    await expect.poll(async () => (await summary(page)).drawing).toBe(true);
    await page.keyboard.press('Enter');
    const { curves } = await summary(page);
    expect(curves).toHaveLength(1);
    expect(curves[0]!.points).toBeGreaterThan(5);
    await expect.poll(camera).toEqual(start);
    await page.keyboard.press('ArrowRight');
    await expect.poll(camera).not.toEqual(start);
  });

  it('lifts the pen before it undoes', async () => {
    await page.locator('canvas').focus();
    for (const undo of [true, false]) {
      await page.keyboard.press('Enter');
      for (let i = 0; i < 8; i += 1) await page.keyboard.press('ArrowRight');
      if (undo) await page.keyboard.press('Control+z');
      await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
    }
    await page.keyboard.press('Enter');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });

  it('reaches every control, and the help names the keys', async () => {
    await page.keyboard.press('?');
    await expect.poll(() => page.getByRole('dialog', { name: 'Drawing in the studio' }).isVisible()).toBe(true);
    await page.keyboard.press('Escape');
    const names = new Set<string>();
    for (let i = 0; i < 24; i += 1) {
      await page.keyboard.press('Tab');
      names.add(await page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent ?? ''));
    }
    for (const name of ['Save, export and more', 'Draw (D)', 'Vermilion', 'Thickness of the ink', 'Symmetry, pen and hand']) expect([...names]).toContain(name);
    const unnamed = await page.$$eval('button, input, select, canvas', (all) => all.filter((e) => !(e.getAttribute('aria-label') || e.textContent?.trim() || e.closest('label')?.textContent?.trim() || (e as HTMLElement).hidden)).map((e) => e.outerHTML));
    expect(unnamed).toEqual([]);
  });
});

describe('fingers', () => {
  const touch = async (session: CDPSession, type: 'touchStart' | 'touchMove' | 'touchEnd', points: [number, number][]): Promise<void> => {
    await session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  };

  it('one draws on the model and turns beside it, two zoom and leave no ink', async () => {
    const session = await cdp();
    await touch(session, 'touchStart', [[300, 240]]);
    for (let i = 1; i <= 10; i += 1) await touch(session, 'touchMove', [[300 + 6 * i, 240 - 2 * i]]);
    await touch(session, 'touchEnd', []);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
    const start = await camera();
    await touch(session, 'touchStart', [[60, 250]]);
    await touch(session, 'touchMove', [[120, 250]]);
    await touch(session, 'touchEnd', []);
    const turned = await camera();
    expect(turned).not.toEqual(start);
    await touch(session, 'touchStart', [[310, 250]]);
    await touch(session, 'touchStart', [[310, 250], [370, 250]]);
    for (let i = 1; i <= 5; i += 1) await touch(session, 'touchMove', [[310 - 10 * i, 250], [370 + 10 * i, 250]]);
    await touch(session, 'touchEnd', []);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
    await expect.poll(camera).not.toEqual(turned);
  });
});

describe('pen', () => {
  it('draws with its pressure and tilt; a finger then only turns the view', async () => {
    const session = await cdp();
    const send = (type: 'mousePressed' | 'mouseMoved' | 'mouseReleased', x: number, y: number, force: number): Promise<unknown> =>
      session.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1, pointerType: 'pen', force, tiltX: 40, tiltY: 0 });
    await send('mousePressed', 300, 240, 0.2);
    for (let i = 1; i <= 10; i += 1) await send('mouseMoved', 300 + 6 * i, 240 - 2 * i, 0.2 + 0.07 * i);
    await send('mouseReleased', 360, 220, 0);
    const { curves } = await summary(page);
    expect(curves).toHaveLength(1);
    expect(curves[0]!.pressures[0]).toBeCloseTo(0.2, 5);
    expect(curves[0]!.pressures.at(-1)).toBeGreaterThan(0.6);
    const pointing = await page.evaluate(() => {
      const { frames } = window.studio.studio.state.now.history.drawing[0]!.stroke;
      return { head: [...frames.slice(4, 8)], pen: [...frames.slice(11, 15)] };
    });
    expect(pointing.pen).not.toEqual(pointing.head);
    await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x: 310, y: 250, id: 0 }] });
    await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [{ x: 370, y: 250, id: 0 }] });
    await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });
});
