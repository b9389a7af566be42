import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { ElementHandle, Page } from 'puppeteer-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { FirefoxLab, type FirefoxPage } from './firefox';
import { torusObj } from './meshes';

// What a person does first, in Firefox: the rest of the page is the same code, tried in Chromium.

let lab: FirefoxLab;
let opened: FirefoxPage;
let page: Page;
const folder = mkdtempSync(join(tmpdir(), 'firefox-'));

beforeAll(async () => { lab = await FirefoxLab.start(); });
afterAll(async () => {
  await lab?.stop();
  rmSync(folder, { recursive: true });
});
beforeEach(async () => {
  opened = await lab.open();
  page = opened.page;
});
afterEach(async () => {
  expect(opened.errors).toEqual([]);
  await opened.context.close();
});

/** Curves of the drawing, by the number of their points. */
const curves = (): Promise<number[]> => page.evaluate(() => window.studio.studio.state.now.history.drawing.map((drawn) => drawn.curve.pointCount));
const count = async (): Promise<number> => (await curves()).length;

async function stroke(points: readonly (readonly [number, number])[]): Promise<void> {
  await page.mouse.move(...points[0]!);
  await page.mouse.down();
  for (const point of points.slice(1)) await page.mouse.move(...point, { steps: 6 });
  await page.mouse.up();
}

const kAcross = [[300, 240], [320, 220], [340, 225], [365, 240]] as const;

describe('in Firefox the studio', () => {
  it('opens and draws, and undoes', async () => {
    await stroke(kAcross);
    await expect.poll(count).toBe(1);
    await expect.poll(async () => (await curves())[0]).toBeGreaterThan(5);
    await page.keyboard.down('Control');
    await page.keyboard.press('z');
    await page.keyboard.up('Control');
    await expect.poll(count).toBe(0);
    await page.click('button[aria-label="Redo"]');
    await expect.poll(count).toBe(1);
  });

  it('shows ink, finished and live', async () => {
    const red = (): Promise<number> => page.evaluate(() => {
      const { renderer, scene, camera } = window.studio.stage;
      renderer.render(scene, camera);
      const gl = renderer.getContext(), width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
      const pixels = new Uint8Array(4 * width * height);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      let found = 0;
      for (let i = 0; i < pixels.length; i += 4) if (pixels[i]! > 2 * pixels[i + 2]!) found += 1;
      return gl.getError() === 0 ? found : -1;
    });
    await expect.poll(red).toBe(0);
    await page.mouse.move(300, 240);
    await page.mouse.down();
    await page.mouse.move(340, 225, { steps: 8 });
    await expect.poll(red).toBeGreaterThan(20);
    await page.mouse.up();
    await expect.poll(count).toBe(1);
    await expect.poll(red).toBeGreaterThan(20);
  });

  it('brings the drawing back when it is reloaded', async () => {
    await stroke(kAcross);
    await stroke([[320, 280], [365, 285]]);
    await expect.poll(count).toBe(2);
    const before = await curves();
    await page.evaluate(() => window.studio.autosave.settled());
    await page.reload();
    await page.waitForSelector('html[data-ready]', { timeout: 240000 });
    await expect.poll(curves).toEqual(before);
    await stroke([[330, 250], [350, 260]]);
    await expect.poll(count).toBe(3);
  });

  it('opens models and refuses what is none', async () => {
    const model = join(folder, 'ring.obj'), bad = join(folder, 'bad.obj');
    writeFileSync(model, torusObj(20));
    writeFileSync(bad, 'nothing');
    const input = (await page.$('input[type=file]')) as ElementHandle<HTMLInputElement>;
    await input.uploadFile(model);
    await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'ring.obj');
    await input.uploadFile(bad);
    await page.waitForFunction(() => /bad\.obj/.test(document.querySelector('#messages .problem')?.textContent ?? ''));
    await expect.poll(() => page.evaluate(() => window.studio.studio.state.now.model?.faces)).toBe(2400);
    await page.evaluate(() => {
      const { studio } = window.studio;
      const frame = new Float64Array(17);
      frame.set([0, 1.15, 0.3, 0, 0, 0, 1], 1);
      frame.set([0, 0, 0, 1], 11);
      studio.beginStroke();
      for (let i = 0; i < 50; i += 1) {
        frame.set([0.2 + 0.001 * i, 1.15, -0.3], 8);
        frame[0] = i / 90;
        studio.addFrame(frame);
      }
      studio.endStroke();
    });
    await expect.poll(count).toBe(1);
  });

  it('draws with one finger, and turns the view with two', async () => {
    const camera = (): Promise<string> => page.evaluate(() => window.studio.stage.camera.matrixWorld.elements.join());
    const before = await camera();
    const finger = await page.touchscreen.touchStart(300, 240);
    for (let i = 1; i <= 8; i += 1) await finger.move(300 + 6 * i, 240 - 2 * i);
    await finger.end();
    await expect.poll(count).toBe(1);
    await expect.poll(camera).toBe(before);
    const [one, two] = [await page.touchscreen.touchStart(300, 240), await page.touchscreen.touchStart(360, 240)];
    for (let i = 1; i <= 6; i += 1) {
      await one.move(300 - 6 * i, 240);
      await two.move(360 + 6 * i, 240);
    }
    await one.end();
    await two.end();
    await expect.poll(camera).not.toBe(before);
    await expect.poll(count).toBe(1);
  });
});
