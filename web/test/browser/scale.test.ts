import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { drawMany } from './many_strokes';
import { torusObj } from './meshes';
import { Lab, messages, type Opened } from './studio_page';

let lab: Lab;
let opened: Opened;
let page: Page;
const folder = mkdtempSync(join(tmpdir(), 'studio-'));

beforeAll(async () => { lab = await Lab.start(); });
afterAll(async () => {
  await lab.stop();
  rmSync(folder, { recursive: true });
});
afterEach(async () => {
  expect(opened.errors).toEqual([]);
  await opened.context.close();
});

async function open(): Promise<void> {
  opened = await lab.open();
  page = opened.page;
}

const draw = (count: number): Promise<number> => drawMany(page, count);

interface Picture {
  calls: number;
  /** Pixels of the strokes' colours. */
  red: number;
  blue: number;
}

/** What the next picture shows. */
function picture(): Promise<Picture> {
  return page.evaluate(() => {
    const { renderer, scene, camera } = window.studio.stage;
    renderer.render(scene, camera);
    const gl = renderer.getContext(), width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let red = 0, blue = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i]! > 2 * pixels[i + 2]!) red += 1;
      if (pixels[i + 2]! > 2 * pixels[i]!) blue += 1;
    }
    if (gl.getError() !== 0) throw new Error('the graphics driver reports an error');
    return { calls: renderer.info.render.calls, red, blue };
  });
}

describe('many strokes', () => {
  it('are drawn at once, and each can still be taken away and brought back', async () => {
    await open();
    await draw(300);
    const all = await picture();
    expect(all.calls).toBeLessThanOrEqual(20);
    expect(all.red).toBeGreaterThan(500);
    expect(all.blue).toBeGreaterThan(500);
    const change = (act: () => void): Promise<void> => page.evaluate(act);
    await change(() => { for (let k = 0; k < 300; k += 1) window.studio.studio.undo(); });
    const none = await picture();
    expect([none.red, none.blue]).toEqual([0, 0]);
    await change(() => { for (let k = 0; k < 300; k += 1) window.studio.studio.redo(); });
    await expect.poll(async () => (await picture()).red).toBe(all.red);
    // One in the middle goes; what is drawn next takes its place without touching the others.
    await change(() => {
      const { studio } = window.studio;
      const { history } = studio.state.now;
      studio.state.update({ history: { ...history, drawing: history.drawing.filter(({ style }) => style.color !== '#2469d6') } });
    });
    const without = await picture();
    expect(without.blue).toBe(0);
    expect(without.red).toBeGreaterThanOrEqual(all.red);
    await change(() => window.studio.studio.clear());
    await expect.poll(async () => (await picture()).red).toBe(0);
    await change(() => window.studio.studio.undo());
    await expect.poll(async () => (await picture()).red).toBe(without.red);
  });

  it('come back with the graphics card', async () => {
    await open();
    await draw(30);
    const before = await picture();
    expect(before.red).toBeGreaterThan(500);
    await page.evaluate(async () => {
      const { renderer } = window.studio.stage, { canvas } = renderer.getContext();
      const happens = (event: string): Promise<void> => new Promise((done) => canvas.addEventListener(event, () => done(), { once: true }));
      const lost = happens('webglcontextlost');
      renderer.forceContextLoss();
      await lost;
      await new Promise((done) => setTimeout(done)); // after the event
      const back = happens('webglcontextrestored');
      renderer.forceContextRestore();
      await back;
    });
    await expect.poll(picture).toEqual(before);
    await draw(2);
    await expect.poll(async () => (await messages(page)).join()).toMatch(/graphics driver/);
  });
});

describe('a bake that arrives', () => {
  it.skipIf(!existsSync('embeddings/hand.mimicry'))('is taken in beside the page; curves, their history and drawing go on', async () => {
    opened = await lab.open({ query: '&embeddings=on' });
    page = opened.page;
    await page.evaluate(() => {
      const target = window.studio.studio.target!;
      Object.getPrototypeOf(target).withEmbedding = () => { throw new Error('made by the page'); };
    });
    await draw(3);
    const lengths = (): Promise<number[]> => page.evaluate(() => window.studio.studio.state.now.history.drawing.map((drawn) => drawn.curve.length));
    const before = await lengths();
    expect(before).toHaveLength(3);
    await page.evaluate(() => window.studio.studio.undo());
    await page.waitForFunction(() => window.studio.studio.state.now.hasEmbedding);
    await expect.poll(lengths).toEqual(before.slice(0, 2));
    await page.evaluate(() => window.studio.studio.redo());
    await expect.poll(lengths).toEqual(before);
    await page.evaluate(() => window.studio.studio.set({ technique: 'mimicry' }));
    await draw(1);
    await expect.poll(lengths).toHaveLength(4);
    await page.evaluate(() => window.studio.autosave.settled());
  });
});

describe('large models', () => {
  it('are made ready beside the page, and their memory goes when a small one follows', async () => {
    await open();
    const file = join(folder, 'large.obj');
    writeFileSync(file, torusObj(120));
    const core = await page.evaluate(() => {
      const { core } = window.studio.studio;
      // The page itself makes nothing of it.
      core.createTarget = () => { throw new Error('made by the page'); };
      core.readMeshFiles = () => { throw new Error('read by the page'); };
      return core.memoryBytes;
    });
    await page.setInputFiles('input[type=file]', file);
    await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'large.obj');
    await expect.poll(() => page.evaluate(() => window.studio.studio.state.now.model!.faces)).toBe(86400);
    await draw(3);
    await expect.poll(() => page.evaluate(() => window.studio.studio.state.now.history.drawing.length)).toBeGreaterThan(0);
    await expect.poll(() => page.evaluate(() => window.studio.studio.core.memoryBytes)).toBe(core);
    const small = join(folder, 'small.obj');
    writeFileSync(small, torusObj(8));
    await page.evaluate(() => Object.assign(window, { before: new WeakRef(window.studio.studio.target!) }));
    await page.setInputFiles('input[type=file]', small);
    await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'small.obj');
    // Nothing holds it, so that the browser takes its memory back when it wants to.
    await expect.poll(() => page.evaluate(async () => {
      await new Promise((done) => setTimeout(done, 50));
      (window as unknown as { gc(): void }).gc();
      return (window as unknown as { before: WeakRef<object> }).before.deref() === undefined;
    })).toBe(true);
  });
});
