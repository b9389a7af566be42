import { PNG } from 'pngjs';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { kInks } from '../../src/settings';
import { kAcross, Lab, stroke, summary } from './studio_page';

let lab: Lab;
beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());

it.each([[1280, 640], [640, 640], [640, 480], [360, 640], [390, 480], [360, 480]])('the file menu is whole in a window of %i x %i', async (width, height) => {
  const { context, page, errors } = await lab.open({ viewport: { width, height } });
  await page.getByRole('button', { name: 'Save, export and more' }).click();
  const menu = page.locator('#files');
  const box = (await menu.boundingBox())!;
  expect(await menu.evaluate((e) => e.scrollHeight - e.clientHeight)).toBeLessThanOrEqual(0);
  expect(await menu.evaluate((e) => e.scrollWidth - e.clientWidth)).toBeLessThanOrEqual(0);
  expect([box.x >= 0, box.y >= 0, box.x + box.width <= width, box.y + box.height <= height]).toEqual([true, true, true, true]);
  for (const item of await menu.getByRole('button').all()) if (await item.isVisible()) expect((await item.boundingBox())!.height).toBeGreaterThanOrEqual(36);
  expect(errors).toEqual([]);
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
  expect((await summary(page)).curves).toHaveLength(1);
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
