import { afterAll, beforeAll, expect, it } from 'vitest';
import { kAcross, Lab, stroke, summary } from './studio_page';

let lab: Lab;
beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());

/** Points of messages at which a ray from the eye meets the model, every 6 pixels. */
const covered = (): { points: number; onModel: number } => {
  const { stage, view, studio } = window.studio;
  let points = 0, onModel = 0;
  for (const message of document.querySelectorAll('.message')) {
    const { left, top, right, bottom } = message.getBoundingClientRect();
    for (let x = left; x < right; x += 6) {
      for (let y = top; y < bottom; y += 6) {
        const end = stage.camera.position.clone().set((2 * x) / innerWidth - 1, 1 - (2 * y) / innerHeight, 0.5).unproject(stage.camera);
        const from = view.model.group.worldToLocal(stage.camera.position.clone()), to = view.model.group.worldToLocal(end);
        points += 1;
        if (studio.target!.firstHit(from.x, from.y, from.z, to.x - from.x, to.y - from.y, to.z - from.z)) onModel += 1;
      }
    }
  }
  return { points, onModel };
};

it.each([[1280, 720], [640, 480], [800, 360], [390, 844], [360, 640], [768, 1024]])('messages leave the model free at %i x %i, and a stroke goes through what is beside it', async (width, height) => {
  const { context, page, errors } = await lab.open({ viewport: { width, height } });
  await page.evaluate(() => {
    window.studio.ui.messages.problem('5 of 8 strokes drawn; the others do not meet this model.');
    window.studio.ui.messages.problem('The browser’s storage is full: what you draw is kept only until this page closes. Save it to a file, or delete drawings.', { title: 'Save to a file', act: () => undefined });
  });
  await page.evaluate(() => Promise.allSettled(document.getAnimations().map((animation) => animation.finished)));
  const { points, onModel } = await page.evaluate(covered);
  expect(points).toBeGreaterThan(100);
  expect(onModel).toBe(0);
  expect(errors).toEqual([]);
  if (width === 640) {
    await stroke(page, kAcross);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  }
  await context.close();
});
