import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import pixelmatch from 'pixelmatch';
import type { Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { emulateHeadset } from './headset';
import { Lab, stroke } from './studio_page';

/**
 * What the studio looks like, against test/browser/looks/*.png. UPDATE_LOOKS=1 writes them anew:
 * look at what changed before you commit it.
 */
const kFolder = 'test/browser/looks';
/** A pixel differs from here on (0 to 1), and a picture when this part of its pixels does: fonts and drivers differ a little. */
const kPixel = 0.15, kPart = 0.01;

let lab: Lab;
beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());

async function compare(page: Page, name: string): Promise<void> {
  await page.mouse.move(4, 300);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(null)))));
  const shot = await page.screenshot({ animations: 'disabled' });
  const file = `${kFolder}/${name}.png`;
  if (process.env['UPDATE_LOOKS'] || !existsSync(file)) {
    mkdirSync(kFolder, { recursive: true });
    writeFileSync(file, shot);
    expect(process.env['UPDATE_LOOKS'], `${file} was missing`).toBeTruthy();
    return;
  }
  const now = PNG.sync.read(shot), then = PNG.sync.read(readFileSync(file));
  expect([now.width, now.height]).toEqual([then.width, then.height]);
  const diff = new PNG({ width: now.width, height: now.height });
  const different = pixelmatch(then.data, now.data, diff.data, now.width, now.height, { threshold: kPixel });
  if (different > kPart * now.width * now.height) {
    mkdirSync('test-results', { recursive: true });
    writeFileSync(`test-results/${name}.png`, shot);
    writeFileSync(`test-results/${name}-diff.png`, PNG.sync.write(diff));
  }
  expect(different, `${different} pixels; see test-results/${name}-diff.png`).toBeLessThanOrEqual(kPart * now.width * now.height);
}

async function drawSome(page: Page, cx: number, cy: number, s: number): Promise<void> {
  await stroke(page, [[cx - 40 * s, cy + 60 * s], [cx - 10 * s, cy + 30 * s], [cx + 30 * s, cy + 50 * s], [cx + 55 * s, cy + 35 * s]], 10);
  await page.keyboard.press('6');
  await stroke(page, [[cx - 30 * s, cy + 100 * s], [cx + 10 * s, cy + 85 * s], [cx + 45 * s, cy + 95 * s]], 10);
}

describe('the studio looks right', () => {
  it('at a desk, in light and dark, with its sheets open', async () => {
    const { context, page } = await lab.open({ viewport: { width: 760, height: 520 } });
    await drawSome(page, 390, 250, 0.8);
    await compare(page, 'light');
    await page.emulateMedia({ colorScheme: 'dark' });
    await compare(page, 'dark');
    await page.keyboard.press('t');
    await compare(page, 'techniques');
    await page.keyboard.press('Escape');
    await page.emulateMedia({ colorScheme: 'light' });
    await page.keyboard.press('c');
    await compare(page, 'compare');
    await context.close();
  });

  it('on a phone', async () => {
    const { context, page } = await lab.open({ viewport: { width: 390, height: 700 }, hasTouch: true, isMobile: true });
    await drawSome(page, 200, 300, 0.6);
    await compare(page, 'phone');
    const wide = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    expect(wide[0]).toBeLessThanOrEqual(wide[1]!);
    await context.close();
  });

  it('in a headset', async () => {
    const { context, page } = await lab.open({ viewport: { width: 480, height: 360 }, prepare: emulateHeadset });
    await page.getByRole('button', { name: 'VR' }).click();
    await page.waitForFunction(() => window.studio.stage.renderer.xr.isPresenting);
    await page.evaluate(() => window.drive(40, (i) => {
      const pen = window.headset.controllers.right!, hand = window.headset.controllers.left!, t = i / 40;
      window.headset.quaternion.set(-0.06, 0, 0, 0.998);
      pen.position.set(-0.06 + 0.13 * t, 1.1 + 0.03 * Math.sin(9 * t), -0.38);
      hand.position.set(-0.2, 1.05, -0.4);
      if (i === 2) pen.updateButtonValue('trigger', 1);
    }));
    await compare(page, 'headset');
    await context.close();
  });
});
