import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { torusObj } from './meshes';
import { Lab, messages, stroke, summary } from './studio_page';

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
    await page.goto(`${url}?antialias=off&motion=off`);
    await page.waitForSelector('html[data-ready]');
    await page.setInputFiles('input[type=file]', { name: 'ring.obj', mimeType: '', buffer: Buffer.from(torusObj(10)) });
    await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'ring.obj');
    await page.evaluate(() => window.studio.bake());
    await expect.poll(() => messages(page), { timeout: 25000 }).toEqual([expect.stringContaining('is prepared')]);
    expect(readdirSync(data, { recursive: true }).some((name) => String(name).endsWith('.mimicry'))).toBe(true);
    await page.evaluate(() => window.studio.studio.set({ technique: 'mimicry' }));
    await stroke(page, [[390, 190], [400, 220], [395, 250]]);
    expect((await summary(page)).curves.map((c) => c.technique)).toEqual(['mimicry']);
    await context.close();
  });
});
