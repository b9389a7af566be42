import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { afterAll, beforeAll, it } from 'vitest';
import { drawMany } from '../test/browser/many_strokes';
import { torusObj } from '../test/browser/meshes';
import { Lab, type Opened } from '../test/browser/studio_page';

/** The studio's figures in docs/performance.md: npm run figures, on an idle machine. */
let lab: Lab;
beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());

const middle = (list: number[], part = 0.5): number => [...list].sort((a, b) => a - b)[Math.floor(part * (list.length - 1))]!;
const say = (what: string, value: string): void => console.log(`${what.padEnd(60)} ${value}`);

/** The longest task of the page's main thread from now on, ms. */
async function watchTasks({ page }: Opened): Promise<() => Promise<number>> {
  await page.evaluate(() => {
    const tasks: number[] = ((window as unknown as { tasks: number[] }).tasks = []);
    new PerformanceObserver((list) => tasks.push(...list.getEntries().map((entry) => entry.duration))).observe({ type: 'longtask' });
  });
  return async () => page.evaluate(async () => {
    await new Promise((done) => setTimeout(done, 500));
    return Math.max(0, ...(window as unknown as { tasks: number[] }).tasks);
  });
}

it('opening', async () => {
  const cold: number[] = [], again: number[] = [];
  let sent = 0;
  for (let i = 0; i < 5; i += 1) {
    const context = await lab.browser.newContext({ viewport: { width: 1280, height: 800 } });
    const page = await context.newPage();
    const before = lab.served.sent();
    const ready = async (act: () => Promise<unknown>): Promise<number> => {
      const start = performance.now();
      await act();
      await page.waitForSelector('html[data-ready]');
      return performance.now() - start;
    };
    cold.push(await ready(() => page.goto(`${lab.served.url}?embeddings=off`)));
    sent = lab.served.sent() - before;
    again.push(await ready(() => page.reload()));
    await context.close();
  }
  say('page transfer until a stroke is possible, as it was packed', `${(sent / 1000).toFixed(0)} kB`);
  say('from opening to first stroke possible, median of 5 (least)', `${middle(cold).toFixed(0)} (${Math.min(...cold).toFixed(0)}) ms`);
  say('from reloading to first stroke possible, median of 5 (least)', `${middle(again).toFixed(0)} (${Math.min(...again).toFixed(0)}) ms`);
});

it('300 strokes', async () => {
  const opened = await lab.open({ viewport: { width: 1280, height: 800 } });
  const { page, context } = opened;
  const used = (): Promise<number> => page.evaluate(async () => {
    for (let k = 0; k < 3; k += 1) {
      await new Promise((done) => setTimeout(done, 300));
      (window as unknown as { gc(): void }).gc();
    }
    return (performance as unknown as { memory: { usedJSHeapSize: number } }).memory.usedJSHeapSize;
  });
  await drawMany(page, 10);
  const before = await used();
  const strokes = await drawMany(page, 300);
  say('heap of a stroke of 150 frames, with its arrays', `${(((await used()) - before) / 300 / 1000).toFixed(1)} kB`);
  say(`draw calls of a picture with ${strokes} strokes`, String(await page.evaluate(() => {
    const { renderer, scene, camera } = window.studio.stage;
    renderer.render(scene, camera);
    return renderer.info.render.calls;
  })));
  await page.addInitScript(() => {
    const tasks: number[] = ((window as unknown as { tasks: number[] }).tasks = []);
    new PerformanceObserver((list) => tasks.push(...list.getEntries().map((entry) => entry.duration))).observe({ type: 'longtask', buffered: true });
  });
  const times: number[] = [], longest: number[] = [];
  for (let i = 0; i < 5; i += 1) {
    const start = performance.now();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    times.push(performance.now() - start);
    longest.push(await page.evaluate(async () => {
      await new Promise((done) => setTimeout(done, 1000));
      return Math.max(0, ...(window as unknown as { tasks: number[] }).tasks);
    }));
    if (await page.evaluate(() => window.studio.studio.state.now.history.drawing.length) !== strokes) throw new Error('strokes are missing');
  }
  say('reloading them, to first stroke possible, median of 5 (least)', `${middle(times).toFixed(0)} (${Math.min(...times).toFixed(0)}) ms`);
  say('the longest task of the main thread meanwhile, median (least)', `${middle(longest).toFixed(0)} (${Math.min(...longest).toFixed(0)}) ms`);
  await context.close();
});

it.each([86400, 500000, 908000])('dropping %i faces', async (faces) => {
  const opened = await lab.open({ viewport: { width: 1280, height: 800 } });
  const { page, context } = opened;
  const folder = mkdtempSync(join(tmpdir(), 'figures-'));
  const obj = torusObj(Math.round(Math.sqrt(faces / 6)));
  const times: number[] = [];
  const longest = await watchTasks(opened);
  for (let i = 0; i < 3; i += 1) {
    const name = `large-${i}.obj`;
    writeFileSync(join(folder, name), obj);
    await page.evaluate(() => window.addEventListener('change', () => performance.mark('dropped'), { capture: true, once: true }));
    await page.setInputFiles('input[type=file]', join(folder, name));
    times.push(await page.evaluate(async (n) => {
      while (window.studio.studio.state.now.model?.name !== n) await new Promise((done) => setTimeout(done, 1));
      return performance.now() - performance.getEntriesByName('dropped').at(-1)!.startTime;
    }, name));
  }
  say(`OBJ of ${faces.toLocaleString('en')} faces (${(obj.length / 1e6).toFixed(0)} MB): from drop to first stroke, median of 3`, `${middle(times).toFixed(0)} ms`);
  say('the longest task of the main thread meanwhile', `${(await longest()).toFixed(0)} ms`);
  await context.close();
  rmSync(folder, { recursive: true });
});

it('event to ink', async () => {
  const { page, context } = await lab.open({ viewport: { width: 1280, height: 800 } });
  await page.mouse.move(600, 400);
  await page.mouse.down();
  const { times, late } = await page.evaluate(async () => {
    const canvas = document.querySelector('canvas')!, { studio } = window.studio;
    const times: number[] = [];
    let late = 0;
    for (let i = 1; i <= 120; i += 1) {
      await new Promise(requestAnimationFrame);
      const before = studio.liveInk!.count, start = performance.now();
      canvas.dispatchEvent(new PointerEvent('pointermove', { pointerId: 1, pointerType: 'mouse', isPrimary: true, buttons: 1, clientX: 600 + i, clientY: 400 + 20 * Math.sin(i / 9), bubbles: true }));
      times.push(performance.now() - start);
      if (studio.liveInk!.count === before) late += 1;
    }
    return { times, late };
  });
  await page.mouse.up();
  say('from a pointer event to its ink in the next picture, median (largest)', `${middle(times).toFixed(1)} (${Math.max(...times).toFixed(1)}) ms; ${late} of ${times.length} came later`);
  await context.close();
});

it('a hundred curves', async () => {
  const { page, context } = await lab.open({ viewport: { width: 1280, height: 800 } });
  const { frames, pictures, points, triangles } = await page.evaluate(async () => {
    const app = window.studio, { studio, stage } = app;
    const frame = new Float64Array(17);
    frame.set([0, 1.15, 0.3, 0, 0, 0, 1], 1);
    frame.set([0, 0, 0, 1], 11);
    frame[15] = 1;
    frame[16] = -1;
    const frames: number[] = [], pictures: number[][] = [];
    const gl = stage.renderer.getContext(), pixel = new Uint8Array(4);
    for (let curve = 0; curve < 100; curve += 1) {
      studio.beginStroke();
      const start = performance.now();
      for (let i = 0; i < 500; i += 1) {
        frame[0] = curve * 10 + i / 90;
        const t = i / 500, a = 0.3 * curve;
        frame[8] = 0.03 + 0.05 * Math.sin(6 * t + a);
        frame[9] = 1.08 + 0.06 * Math.cos(4 * t + 1.7 * a);
        frame[10] = -0.42;
        studio.addFrame(frame);
      }
      frames.push((performance.now() - start) / 500); // the clock is too coarse for one
      studio.endStroke();
      if (curve % 25 === 24 || curve === 0) {
        const times: number[] = [], drawn: number[] = [];
        for (let i = 0; i < 12; i += 1) {
          const start = performance.now();
          stage.renderer.render(stage.scene, stage.camera);
          times.push(performance.now() - start); // the page's part: the commands
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
          drawn.push(performance.now() - start); // and the drawing, by the processor here
          await new Promise(requestAnimationFrame);
        }
        const middle = (list: number[]): number => list.sort((a, b) => a - b)[6]!;
        pictures.push([curve + 1, middle(times), middle(drawn)]);
      }
    }
    return { frames, pictures, points: studio.state.now.history.drawing.map((drawn) => drawn.curve.pointCount), triangles: app.view.ink.triangles };
  });
  say('a frame in the page (session, curve, tube), mean, curves 1-10', `${(1000 * middle(frames.slice(0, 10))).toFixed(0)} µs`);
  say('the same, curves 91-100', `${(1000 * middle(frames.slice(90))).toFixed(0)} µs`);
  for (const [count, ms, drawn] of pictures) say(`picture with ${count} curves: page; with software drawing`, `${ms!.toFixed(1)}; ${drawn!.toFixed(0)} ms`);
  say('curves; points of the smallest, the middle one', `${points.length}; ${Math.min(...points)}, ${middle(points)}`);
  say('triangles of ink', String(triangles));
  await context.close();
});

it('size of what is fetched later', async () => {
  const { readFileSync, readdirSync } = await import('node:fs');
  for (const name of readdirSync('dist/assets')) say(name, `${(gzipSync(readFileSync(`dist/assets/${name}`)).length / 1000).toFixed(0)} kB gzip`);
});
