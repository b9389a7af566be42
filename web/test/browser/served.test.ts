import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { torusObj } from './meshes';
import { Lab, downloaded, messages, stroke, summary, knowsTheHint } from './studio_page';

const kNative = process.env['MIMICRY_PROGRAM'] ?? resolve('../build/release/bin/mimicry');

describe.skipIf(!existsSync(kNative))('the page from `mimicry serve`', () => {
  let lab: Lab;
  let server: ChildProcess;
  let url: string;
  const data = mkdtempSync(join(tmpdir(), 'studio-data-'));

  beforeAll(async () => {
    lab = await Lab.start();
    server = spawn(kNative, ['serve', '--port', '0', '--studio', resolve('dist'), '--data', data], { stdio: ['ignore', 'pipe', 'inherit'] });
    url = await new Promise((found, failed) => {
      let text = '';
      server.on('exit', (code) => failed(new Error(`mimicry serve ended with ${code}: ${text}`)));
      server.stdout!.on('data', (part: Buffer) => {
        text += part.toString();
        const at = /http:\S+/.exec(text);
        if (at) found(at[0]);
      });
    });
  });
  afterAll(async () => {
    server.kill('SIGTERM');
    await lab.stop();
  });

  it('draws, and has a dropped model prepared by the server', async () => {
    const context = await lab.browser.newContext({ viewport: { width: 640, height: 480 } });
    const page = await context.newPage();
    await page.addInitScript(knowsTheHint);
    // What the server's Content-Security-Policy forbids is an error in the console.
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
    await page.goto(`${url}?antialias=off&motion=off`);
    await page.waitForSelector('html[data-ready]');
    await page.setInputFiles('input[type=file]', { name: 'ring.obj', mimeType: '', buffer: Buffer.from(torusObj(10)) });
    await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'ring.obj');
    await page.evaluate(() => window.studio.bake());
    await expect.poll(() => messages(page), { timeout: 240000 }).toContainEqual(expect.stringContaining('is prepared'));
    // The server sends a bake before it keeps it.
    await expect.poll(() => readdirSync(data, { recursive: true }).some((name) => String(name).endsWith('.mimicry'))).toBe(true);
    await page.evaluate(() => window.studio.studio.set({ technique: 'mimicry' }));
    await stroke(page, [[390, 190], [400, 220], [395, 250]]);
    await expect.poll(async () => (await summary(page)).curves.map((c) => c.technique)).toEqual(['mimicry']);
    // Files that the page offers, a model baked in the page, and a reload with what is kept.
    expect((await downloaded(page, () => page.keyboard.press('Control+s'))).bytes.length).toBeGreaterThan(1000);
    await page.evaluate(() => { window.studio.openShape('sphere'); window.studio.bake(); });
    await page.waitForFunction(() => window.studio.studio.state.now.hasEmbedding, null, { timeout: 240000 });
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    expect(errors).toEqual([]);
    await context.close();
  });

  it('stands in no frame of another page', async () => {
    const context = await lab.browser.newContext();
    const page = await context.newPage();
    await page.goto(lab.served.url); // another port: another origin
    const refused = page.waitForEvent('console', (message) => message.text().includes("frame-ancestors 'none'"));
    await page.evaluate((src) => {
      const frame = document.createElement('iframe');
      frame.src = src;
      document.body.append(frame);
    }, url);
    await refused;
    await context.close();
  });
});
