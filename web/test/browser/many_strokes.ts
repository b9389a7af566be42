import type { Page } from 'playwright-core';

/** Strokes of 150 frames all over the first model, each on another path, in three colours. Returns how many curves there are then. */
export function drawMany(page: Page, count: number): Promise<number> {
  return page.evaluate(async (n) => {
    const { studio, autosave } = window.studio;
    const frame = new Float64Array(17);
    frame.set([0, 1.15, 0.3, 0, 0, 0, 1], 1);
    frame.set([0, 0, 0, 1], 11);
    frame[15] = 1;
    frame[16] = -1;
    for (let more = 0; more < n; more += 1) {
      const curve = studio.state.now.history.drawing.length, a = 0.3 * curve;
      studio.set({ style: { ...studio.settings.style, color: ['#d6401f', '#2469d6', '#fbfaf7'][curve % 3]! } });
      studio.beginStroke();
      for (let i = 0; i < 150; i += 1) {
        const t = i / 150;
        frame[0] = curve * 10 + i / 90;
        frame[8] = 0.03 + 0.05 * Math.sin(4 * t + a);
        frame[9] = 1.08 + 0.06 * Math.cos(3 * t + 1.7 * a);
        frame[10] = -0.42;
        studio.addFrame(frame);
      }
      studio.endStroke();
      if (more % 20 === 19) await autosave.settled();
    }
    await autosave.settled();
    return studio.state.now.history.drawing.length;
  }, count);
}
