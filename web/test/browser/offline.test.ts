import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { BrowserContext, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, expect, it } from 'vitest';
import { serve, type Served } from './server';
import { kAcross, kWindow, Lab, messages, stroke, summary, knowsTheHint } from './studio_page';

let lab: Lab;
let served: Served;
let context: BrowserContext;
let page: Page;
const folder = mkdtempSync(join(tmpdir(), 'studio-next-'));

beforeAll(async () => {
  lab = await Lab.start();
  // Another build: another page with another worker, and one file more.
  cpSync('dist', folder, { recursive: true });
  const build = /name="build" content="(\w+)"/.exec(readFileSync(join(folder, 'index.html'), 'utf8'))![1]!;
  for (const file of ['index.html', 'sw.js']) writeFileSync(join(folder, file), readFileSync(join(folder, file), 'utf8').replace(build, 'thenextbuild').replace('"icon.svg"', '"icon.svg","assets/next.js"'));
  for (const file of ['index.html', 'sw.js']) for (const form of ['.br', '.gz']) rmSync(join(folder, file + form), { force: true }); // of the old ones
  writeFileSync(join(folder, 'assets', 'next.js'), '');
});
afterAll(async () => {
  rmSync(folder, { recursive: true });
  await lab.stop();
});
beforeEach(async () => {
  served = await serve();
  context = await lab.browser.newContext({ viewport: kWindow });
  page = await context.newPage();
  await page.addInitScript(knowsTheHint);
  await page.goto(`${served.url}?antialias=off&motion=off&embeddings=off`);
  await page.waitForSelector('html[data-ready]');
  await page.waitForFunction(() => navigator.serviceWorker.controller?.state === 'activated');
});
afterEach(async () => {
  await context.close();
  served.close();
});

const build = (): Promise<string | null> => page.getAttribute('meta[name=build]', 'content');
const caches_ = (): Promise<string[]> => page.evaluate(async () => (await caches.keys()).sort());
const reload = async (): Promise<void> => {
  await page.evaluate(() => window.studio.autosave.settled());
  await page.reload();
  await page.waitForSelector('html[data-ready]');
};

it('after the first visit the studio opens, draws and reads models without a network', async () => {
  await stroke(page, kAcross);
  served.close();
  await reload();
  await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  await stroke(page, [[320, 280], [375, 285]]);
  await expect.poll(async () => (await summary(page)).curves).toHaveLength(2);
  await page.setInputFiles('input[type=file]', { name: 'tri.obj', mimeType: '', buffer: Buffer.from('v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n') });
  await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'tri.obj');
  await expect.poll(() => messages(page)).toEqual([]);
});

it('a newer build is announced to a page that is open, and comes with a reload; the old one is let go of', async () => {
  const before = await caches_();
  expect(before).toHaveLength(1);
  await stroke(page, kAcross);
  served.move(folder);
  await page.evaluate(async () => void (await (await navigator.serviceWorker.ready).update()));
  await expect.poll(() => messages(page)).toEqual(['A newer studio is there.']);
  await expect.poll(build).not.toBe('thenextbuild');
  await page.evaluate(() => window.studio.autosave.settled());
  await page.getByRole('button', { name: 'Reload' }).click();
  await page.waitForSelector('meta[content=thenextbuild]', { state: 'attached' });
  await page.waitForSelector('html[data-ready]');
  await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  await expect.poll(caches_).toEqual(['mimicry-studio-thenextbuild']);
  await expect.poll(() => messages(page)).toEqual([]);
});

it('a reload with a network never shows the old page, announced or not', async () => {
  served.move(folder);
  await reload();
  await expect.poll(build).toBe('thenextbuild');
  await expect.poll(caches_).toEqual(['mimicry-studio-thenextbuild']);
  served.close();
  await reload();
  await expect.poll(build).toBe('thenextbuild');
});

it('the page can be installed: its manifest names it and its icons are there', async () => {
  const href = await page.getAttribute('link[rel=manifest]', 'href');
  const manifest = JSON.parse(await (await page.request.get(new URL(href!, served.url).href)).text());
  expect(manifest).toMatchObject({ name: 'mimicry studio', display: 'standalone', start_url: './' });
  for (const { src, sizes } of manifest.icons) {
    const size = await page.evaluate(async (url) => {
      const image = new Image();
      image.src = url;
      await image.decode();
      return `${image.naturalWidth}x${image.naturalHeight}`;
    }, new URL(src, served.url).href);
    if (sizes !== 'any') expect(size).toBe(sizes);
  }
});
