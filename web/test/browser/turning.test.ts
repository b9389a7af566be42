import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { downloaded, Lab, messages, stroke, summary } from './studio_page';

let lab: Lab;
beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());

/** A tetrahedron on its face in the plane of x and y: as printing programs write it. */
const kStanding = [[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, -0.3, 2]];
const stl = (): string => ['solid t', ...[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].flatMap((face) =>
  ['facet normal 0 0 0', 'outer loop', ...face.map((v) => `vertex ${kStanding[v]!.join(' ')}`), 'endloop', 'endfacet']), 'endsolid t'].join('\n');

/** Where the model's z points in the world. */
const up = (page: Page): Promise<number[]> => page.evaluate(() => {
  const { view, stage } = window.studio;
  const z = stage.camera.position.clone().set(0, 0, 1).applyQuaternion(view.model.group.quaternion);
  return [z.x, z.y, z.z].map((x) => Math.round(x) + 0);
});
const reload = async (page: Page): Promise<void> => {
  await page.evaluate(() => window.studio.autosave.settled());
  await page.reload();
  await page.waitForSelector('html[data-ready]');
};

it('a model with z up stands, U and the menu turn it, and the drawing keeps it so', async () => {
  const { context, page, errors } = await lab.open();
  await page.setInputFiles('input[type=file]', { name: 'cone.stl', mimeType: '', buffer: Buffer.from(stl()) });
  await expect.poll(() => messages(page)).toEqual(['cone.stl is taken to have z up.']);
  await expect.poll(() => up(page)).toEqual([0, 1, 0]);
  await stroke(page, [[300, 260], [330, 255], [350, 260]]);
  const before = await summary(page);
  expect(before.curves).toHaveLength(1);
  await page.keyboard.press('u');
  await expect.poll(() => up(page)).toEqual([0, 0, 1]);
  await page.getByRole('button', { name: 'Save, export and more' }).click();
  await page.getByRole('button', { name: 'Turn by 90°' }).click();
  await expect.poll(() => up(page)).toEqual([0, -1, 0]);
  await page.keyboard.press('Shift+u');
  await expect.poll(() => up(page)).toEqual([-1, 0, 0]);
  await reload(page);
  await expect.poll(() => up(page)).toEqual([-1, 0, 0]);
  await expect.poll(async () => (await summary(page)).curves).toEqual(before.curves);
  const saved = await downloaded(page, () => page.keyboard.press('Control+s'));
  await page.evaluate(() => window.studio.openShape('torus'));
  await expect.poll(() => up(page)).toEqual([0, 0, 1]);
  await page.setInputFiles('input[type=file]', { name: saved.name, mimeType: '', buffer: saved.bytes });
  await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'cone.stl');
  await expect.poll(() => up(page)).toEqual([-1, 0, 0]);
  // Ink is drawn on the model as it stands.
  const [x, y] = await page.evaluate(() => {
    const { stage, view } = window.studio;
    const middle = view.model.group.localToWorld(stage.camera.position.clone().set(0, 0, 1)).project(stage.camera);
    return [((middle.x + 1) / 2) * innerWidth, ((1 - middle.y) / 2) * innerHeight];
  });
  await stroke(page, [[x!, y!], [x! + 8, y! + 4], [x! + 16, y!]]);
  await expect.poll(async () => (await summary(page)).curves).toHaveLength(2);
  expect(errors).toEqual([]);
  await context.close();
});
