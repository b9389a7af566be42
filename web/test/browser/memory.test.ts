import type { Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Lab } from './studio_page';

let lab: Lab;
beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());

/** Bytes in a thousand frames: an object a frame, even the smallest, would be 12,000. */
const kMost = 4000;

interface Node {
  callFrame: { functionName: string; url: string };
  selfSize: number;
  children: Node[];
}

/** Starts a stroke of the studio and defines `frames(n)`, which goes on drawing it, around the model. */
async function begin(page: Page): Promise<void> {
  await page.evaluate(() => {
    const { studio } = window.studio;
    const frame = new Float64Array(17);
    frame.set([0, 0, 1.2, 0.3, 0, 0, 0, 1]);
    frame.set([0, 0, 0, 1], 11);
    frame[15] = 1;
    frame[16] = -1;
    let i = 0;
    studio.beginStroke();
    Object.assign(window, {
      frames: (count: number) => {
        for (let end = i + count; i < end; i += 1) {
          frame[0] = i / 90;
          frame[8] = 0.05 * Math.sin(0.031 * i);
          frame[9] = 1.15 + 0.05 * Math.cos(0.023 * i);
          frame[10] = -0.35;
          studio.addFrame(frame);
        }
      },
    });
  });
}

describe('memory', () => {
  it('a thousand frames of drawing make no garbage', async () => {
    const { page, context } = await lab.open();
    // The code is compiled: before that, numbers are objects.
    await begin(page);
    await page.evaluate(() => {
      for (let k = 0; k < 20; k += 1) (window as unknown as { frames(n: number): void }).frames(500);
      window.studio.studio.endStroke();
    });
    // What doubles its memory has done so.
    await begin(page);
    await page.evaluate(() => (window as unknown as { frames(n: number): void }).frames(1040));
    const session = await context.newCDPSession(page);
    await session.send('HeapProfiler.enable');
    let least = Infinity, who = '';
    // Code that the browser has not yet compiled, or throws away, makes objects of numbers: the best of a few rounds is our own doing.
    for (let round = 0; round < 6 && least > kMost; round += 1) {
      await session.send('HeapProfiler.collectGarbage');
      await session.send('HeapProfiler.startSampling', { samplingInterval: 64, includeObjectsCollectedByMajorGC: true, includeObjectsCollectedByMinorGC: true } as never);
      await page.evaluate(() => (window as unknown as { frames(n: number): void }).frames(1000));
      const { profile } = (await session.send('HeapProfiler.stopSampling')) as unknown as { profile: { head: Node } };
      const ours = new Map<string, number>();
      const walk = (node: Node): void => {
        const { functionName, url } = node.callFrame;
        if (url.includes('/assets/') && node.selfSize > 0) ours.set(functionName, (ours.get(functionName) ?? 0) + node.selfSize);
        node.children.forEach(walk);
      };
      walk(profile.head);
      const total = [...ours.values()].reduce((a, b) => a + b, 0);
      if (total < least) [least, who] = [total, JSON.stringify([...ours])];
    }
    expect(least, who).toBeLessThan(kMost);
    await context.close();
  });

  it('what was undone and cleared is given back', async () => {
    const { page, context } = await lab.open();
    const used = (): Promise<number> => page.evaluate(async () => {
      // The second one takes what the first one's sweep let go of.
      for (let k = 0; k < 2; k += 1) {
        await new Promise((done) => setTimeout(done, 200));
        (window as unknown as { gc(): void }).gc();
      }
      return (performance as unknown as { memory: { usedJSHeapSize: number } }).memory.usedJSHeapSize;
    });
    await begin(page);
    // Within the page: each call from here would leave its own code behind.
    const round = (): Promise<void> => page.evaluate(async () => {
      const { studio, autosave } = window.studio;
      for (let k = 0; k < 10; k += 1) {
        (window as unknown as { frames(n: number): void }).frames(500);
        studio.endStroke();
        await autosave.settled();
        studio.undo();
        await autosave.settled();
        studio.beginStroke();
      }
    });
    // Ten strokes' frames alone are 0.7 MB, their tubes more. The browser's own memory settles in a few rounds; a leak never would.
    let least = Infinity;
    for (let k = 0; k < 8 && least > 0.3e6; k += 1) {
      const before = await used();
      await round();
      least = Math.min(least, (await used()) - before);
    }
    expect(least).toBeLessThan(0.3e6);
    await context.close();
  });
});
