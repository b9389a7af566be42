import type { Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { kInks } from '../../src/drawing/ink_styles';
import { kAcross, Lab, stroke, summary } from './studio_page';

let lab: Lab;
beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());

it.each([[1280, 640], [640, 640], [640, 480], [360, 640], [390, 480], [360, 480]])('the file menu is whole in a window of %i x %i', async (width, height) => {
  const { context, page, errors } = await lab.open({ viewport: { width, height } });
  await page.getByRole('button', { name: 'Save, export and more' }).click();
  const menu = page.locator('#files');
  const box = (await menu.boundingBox())!;
  await expect.poll(() => menu.evaluate((e) => e.scrollHeight - e.clientHeight)).toBeLessThanOrEqual(0);
  await expect.poll(() => menu.evaluate((e) => e.scrollWidth - e.clientWidth)).toBeLessThanOrEqual(0);
  expect([box.x >= 0, box.y >= 0, box.x + box.width <= width, box.y + box.height <= height]).toEqual([true, true, true, true]);
  for (const item of await menu.getByRole('button').all()) if (await item.isVisible()) expect((await item.boundingBox())!.height).toBeGreaterThanOrEqual(36);
  expect(errors).toEqual([]);
  await context.close();
});

it('the list of techniques shows one that is registered while the page is open, and a model from the worker is drawn on with it', async () => {
  const { context, page, errors } = await lab.open();
  await page.evaluate(() => window.studio.openFiles([new File(['v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n'], 'plate.obj')]));
  await expect.poll(() => page.evaluate(() => window.studio.studio.mesh?.positions.length)).toBe(12);
  await page.evaluate(() => window.studio.studio.core.registerTechnique({
    name: 'nearest', title: 'Nearest', sentence: 'Draws at the closest point.', color: '#8a3ffc', rank: 0,
    step: (step) => {
      const hit = step.target.closestPoint(step.frame[8]!, step.frame[9]!, step.frame[10]!);
      return hit && step.found('closest', hit);
    },
  }));
  await page.locator('#technique').click();
  const choices = page.locator('#techniques .choice');
  expect(await choices.count()).toBe(await page.evaluate(() => window.studio.studio.core.techniques.length));
  await choices.filter({ hasText: 'Nearest' }).click();
  await page.keyboard.press('Escape');
  await expect.poll(() => page.locator('#technique b').textContent()).toBe('Nearest');
  await stroke(page, kAcross);
  await expect.poll(() => page.evaluate(() => window.studio.studio.state.now.history.drawing.map(({ curve }) => curve.technique))).toEqual(['nearest']);
  expect(errors).toEqual([]);
  await context.close();
});

/** Pixels of the window by which the model reaches under the hint, the controls or the edge; 0: it is whole and free. */
function covered(page: Page): Promise<number> {
  return page.evaluate(() => {
    const { stage, view, studio } = window.studio;
    const spot = stage.camera.position.clone(), { positions } = studio.mesh!;
    let left = Infinity, right = -Infinity, up = Infinity, down = -Infinity;
    for (let at = 0; at < positions.length; at += 3) {
      view.model.group.localToWorld(spot.set(positions[at]!, positions[at + 1]!, positions[at + 2]!)).project(stage.camera);
      const width = stage.split ? innerWidth / 2 : innerWidth;
      const x = ((spot.x + 1) / 2) * width, y = ((1 - spot.y) / 2) * innerHeight;
      left = Math.min(left, x); right = Math.max(right, x - width + innerWidth); up = Math.min(up, y); down = Math.max(down, y);
    }
    let most = Math.max(0, -left, right - innerWidth, -up, down - innerHeight);
    for (const element of document.querySelectorAll<HTMLElement>('#hint, #top > *, #halves > *, #bottom > *')) {
      const box = element.getBoundingClientRect();
      if (box.width === 0) continue;
      most = Math.max(most, box.top < innerHeight / 2 ? box.bottom - up : down - box.top);
    }
    return most;
  });
}

it('the model is whole between hint and controls in any window, also one that is resized, until someone moves the view', async () => {
  const { context, page, errors } = await lab.open({ newcomer: true, viewport: { width: 360, height: 480 } });
  await expect.poll(() => page.locator('#hint').isVisible()).toBe(true);
  for (const shape of ['hand', 'torus', 'cube']) {
    await page.evaluate((name) => window.studio.openShape(name), shape);
    for (const [width, height] of [[360, 480], [1280, 800], [360, 740], [800, 360], [640, 480], [360, 480]] as const) {
      await page.setViewportSize({ width, height });
      await expect.poll(() => covered(page), { message: `${shape}, ${width} x ${height}` }).toBeLessThanOrEqual(1);
    }
  }
  // Of two halves too.
  await page.setViewportSize({ width: 1000, height: 640 });
  await page.keyboard.press('c');
  await expect.poll(() => covered(page)).toBeLessThanOrEqual(1);
  await page.keyboard.press('c');
  await expect.poll(() => covered(page)).toBeLessThanOrEqual(1);
  const looks = (): Promise<number[]> => page.evaluate(() => window.studio.stage.camera.quaternion.toArray());
  const first = await looks();
  await page.keyboard.press('ArrowLeft');
  await expect.poll(looks).not.toEqual(first);
  const moved = await looks();
  await page.setViewportSize({ width: 500, height: 600 });
  await expect.poll(() => page.$eval('canvas', (canvas) => canvas.width)).toBe(500);
  await expect.poll(looks).toEqual(moved);
  await page.keyboard.press('f');
  await expect.poll(looks).toEqual(first);
  await expect.poll(() => covered(page)).toBeLessThanOrEqual(1);
  expect(errors).toEqual([]);
  await context.close();
});

it('the model stays where it is when the hint goes with the first stroke', async () => {
  const { context, page } = await lab.open({ newcomer: true, viewport: { width: 640, height: 640 } });
  const seen = (): Promise<number[]> => page.evaluate(() => {
    const { camera } = window.studio.stage;
    return [...camera.position.toArray(), ...camera.projectionMatrix.elements];
  });
  const before = await seen();
  const [x, y] = await page.evaluate(() => {
    const { studio, stage, view } = window.studio, centre = studio.centre();
    const spot = view.model.group.localToWorld(stage.camera.position.clone().set(centre[0]!, centre[1]!, centre[2]!)).project(stage.camera);
    return [((spot.x + 1) / 2) * innerWidth, ((1 - spot.y) / 2) * innerHeight + 25];
  }) as [number, number];
  await stroke(page, [[x, y], [x + 30, y + 10]]);
  await expect.poll(() => page.locator('#hint').isVisible()).toBe(false);
  await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  await expect.poll(seen).toEqual(before);
  await context.close();
});

it('strokes from the keyboard are read out', async () => {
  const { context, page, errors } = await lab.open();
  const live = page.locator('.sr[aria-live]');
  await page.locator('canvas').focus();
  await page.keyboard.press('Enter');
  await expect.poll(() => live.textContent()).toBe('Pen down.');
  for (let i = 0; i < 8; i += 1) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  await expect.poll(() => live.textContent()).toMatch(/^Stroke 1: [\d.]+ centimetres with Mimicry live\.$/);
  await page.keyboard.press('Control+z');
  await expect.poll(() => live.textContent()).toBe('Undone: stroke.');
  for (let i = 0; i < 60; i += 1) await page.keyboard.press('Shift+=');
  await page.evaluate(() => { window.studio.stage.rig.pan(3, 0); window.studio.stage.rig.jump(); });
  await page.keyboard.press('Enter');
  await expect.poll(() => live.textContent()).toContain('The model is not in the middle');
  expect(errors).toEqual([]);
  await context.close();
});

it('swatches keep their colours where the system forces its own', async () => {
  const { context, page } = await lab.open({ viewport: { width: 1000, height: 640 } });
  await page.emulateMedia({ forcedColors: 'active' });
  for (const { name, color } of kInks) {
    const { data, width, height } = PNG.sync.read(await page.getByRole('radio', { name, exact: true }).screenshot());
    const at = 4 * (Math.floor(height / 2) * width + Math.floor(width / 2));
    expect(`#${[...data.subarray(at, at + 3)].map((c) => c.toString(16).padStart(2, '0')).join('')}`, name).toBe(color);
  }
  await stroke(page, kAcross);
  await context.close();
});
