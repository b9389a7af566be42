import type { Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { emulateHeadset } from './headset';
import { kAcross, Lab, reset, stroke, summary, type Opened } from './studio_page';

/** A tool that writes down what happens to it stands in the page's list; the page itself knows nothing of it. */
interface Seen {
  event: string;
  device?: string;
  end?: string;
  shift?: boolean;
  onModel?: boolean;
}

let lab: Lab;
let opened: Opened;
let page: Page;
beforeAll(async () => {
  lab = await Lab.start();
  opened = await lab.open({ prepare: emulateHeadset });
  page = opened.page;
  await page.evaluate(() => {
    const seen: Seen[] = [];
    Object.assign(window, { seen });
    const { tools } = window.studio;
    const draw = tools.list.now[0]!;
    tools.add({
      ...draw, name: 'stamp', title: 'Stamp pictures', short: 'Stamp', key: 's', samples: 'surface', cursor: { over: 'copy', pressed: 'cell' },
      hint: { page: 'Press on the model to stamp it.', headset: 'Pull the trigger to stamp' },
      options: [{ kind: 'choice', title: 'Picture', label: 'Picture of the stamp', choices: [{ value: 'draw', text: 'A', title: 'Picture A' }, { value: 'stamp', text: 'B', title: 'Picture B' }], get: ({ tool }) => tool, set: () => ({}) }],
      inks: false, otherEnd: null, takes: ['shift'],
      press(_, sample) {
        const see = (event: string): unknown => seen.push({ event, device: sample.device, end: sample.end, shift: sample.modifiers.shift, onModel: sample.hit() !== null });
        see('press');
        return { move: () => { see('move'); }, release: () => { seen.push({ event: 'release' }); }, cancel: () => { seen.push({ event: 'cancel' }); } };
      },
    });
  });
});
afterAll(() => lab.stop());
beforeEach(async () => {
  await reset(page);
  await page.evaluate(() => { (window as unknown as { seen: Seen[] }).seen.length = 0; });
});
afterEach(() => { expect(opened.errors).toEqual([]); });

const seen = (): Promise<Seen[]> => page.evaluate(() => (window as unknown as { seen: Seen[] }).seen);
const cursor = (): Promise<string> => page.$eval('canvas', (canvas) => getComputedStyle(canvas).cursor);
const inUse = (): Promise<string> => page.evaluate(() => window.studio.studio.settings.tool);

describe('a tool that is added', () => {
  it('has its button, key, cursors, options and a line in the help', async () => {
    await page.keyboard.press('s');
    await expect.poll(inUse).toBe('stamp');
    const button = page.getByRole('radio', { name: 'Stamp pictures (S)' });
    await expect.poll(() => button.getAttribute('aria-checked')).toBe('true');
    await page.mouse.move(330, 240);
    await expect.poll(cursor).toBe('copy');
    await page.mouse.down();
    await expect.poll(cursor).toBe('cell');
    await page.mouse.up();
    await page.getByRole('button', { name: 'Symmetry, pen and hand' }).click();
    await expect.poll(() => page.getByRole('radiogroup', { name: 'Picture of the stamp' }).isVisible()).toBe(true);
    await expect.poll(() => page.getByRole('radiogroup', { name: 'Pen on the screen' }).count()).toBe(0);
    await page.keyboard.press('Escape');
    await page.keyboard.press('?');
    await expect.poll(() => page.locator('#help').textContent()).toContain('stamp');
    await page.keyboard.press('Escape');
    await page.keyboard.press('2');
    await expect.poll(inUse).toBe('draw');
    await button.click();
    await expect.poll(inUse).toBe('stamp');
    await page.keyboard.press('d');
    await stroke(page, kAcross);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });

  it('gets a mouse from press to release, its modifier, and Escape', async () => {
    await page.keyboard.press('s');
    await page.keyboard.down('Shift');
    await stroke(page, kAcross);
    await page.keyboard.up('Shift');
    const all = await seen();
    expect(all[0]).toEqual({ event: 'press', device: 'mouse', end: 'tip', shift: true, onModel: true });
    expect(all.at(-1)).toEqual({ event: 'release' });
    const moves = all.slice(1, -1);
    expect(moves.length).toBeGreaterThan(15); // one every 3 pixels
    for (const move of moves) expect(move).toEqual({ event: 'move', device: 'mouse', end: 'tip', shift: true, onModel: true });
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
    await page.mouse.move(330, 240);
    await page.mouse.down();
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await expect.poll(async () => (await seen()).at(-1)).toEqual({ event: 'cancel' });
  });

  it('gets the eraser end of a pen', async () => {
    await page.keyboard.press('s');
    await page.evaluate(() => {
      const canvas = document.querySelector('canvas')!;
      for (const type of ['pointerdown', 'pointerup']) canvas.dispatchEvent(new PointerEvent(type, { pointerId: 5, pointerType: 'pen', button: 5, buttons: type === 'pointerdown' ? 32 : 0, clientX: 330, clientY: 240, bubbles: true }));
    });
    expect((await seen())[0]).toMatchObject({ event: 'press', device: 'pen', end: 'eraser', onModel: true });
  });

  it('is reached and used in a headset', async () => {
    await page.getByRole('button', { name: 'VR' }).click();
    await page.waitForFunction(() => window.studio.stage.renderer.xr.isPresenting);
    const tools = await page.evaluate(() => window.studio.tools.list.now.map(({ name }) => name));
    for (let i = 1; i < tools.length; i += 1) {
      await page.evaluate(() => {
        const pen = window.headset.controllers.right!;
        return window.drive(6, (k) => pen.updateButtonValue('thumbstick', k === 1 || k === 2 ? 1 : 0));
      });
      await expect.poll(inUse).toBe(tools[i]);
    }
    await page.evaluate(() => {
      const pen = window.headset.controllers.right!;
      return window.drive(24, (k) => {
        pen.position.set(-0.06 + 0.004 * k, 1.15, -0.32);
        pen.updateButtonValue('trigger', k > 2 && k < 20 ? 1 : 0);
      });
    });
    const all = await seen();
    expect(all[0]).toMatchObject({ event: 'press', device: 'controller', end: 'tip' });
    expect(all.filter(({ event, onModel }) => event === 'move' && onModel).length).toBeGreaterThan(5);
    expect(all.at(-1)).toEqual({ event: 'release' });
    await page.evaluate(() => window.studio.xr.exit());
    await page.waitForFunction(() => !window.studio.stage.renderer.xr.isPresenting);
  });
});
