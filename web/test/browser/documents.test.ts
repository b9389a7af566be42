import type { BrowserContext, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { torusObj } from './meshes';
import { downloaded, kAcross, Lab, messages, stroke, summary, type Opened } from './studio_page';

const kRing = [[390, 190], [400, 220], [395, 250]] as const;
const kLow = [[320, 280], [365, 285]] as const;

let lab: Lab;
let opened: Opened;
let page: Page;

beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());
beforeEach(async () => {
  opened = await lab.open(); // its storage is empty
  page = opened.page;
});
afterEach(async () => {
  expect(opened.errors).toEqual([]);
  await opened.context.close();
});

const modelName = (on = page): Promise<string | undefined> => on.evaluate(() => window.studio.studio.state.now.model?.name);
const settled = (on = page): Promise<void> => on.evaluate(() => window.studio.autosave.settled());
const count = async (on: Page): Promise<number> => (await summary(on)).curves.length;
const names = (on = page): Promise<string[]> => on.evaluate(async () => (await window.studio.documents.list()).filter((d) => d.deleted_ms === null).map((d) => d.name).sort());
const openDrawings = async (): Promise<void> => {
  await page.getByRole('button', { name: 'Save, export and more' }).click();
  await page.getByRole('button', { name: 'Drawings…' }).click();
};
const choose = (name: string, bytes: Buffer | string): Promise<void> => page.setInputFiles('input[type=file]', [{ name, mimeType: '', buffer: Buffer.from(bytes) }]);

/** Another tab of the same browser. */
async function tab(context: BrowserContext): Promise<Page> {
  const other = await context.newPage();
  await other.goto(page.url());
  await other.waitForSelector('html[data-ready]');
  return other;
}

async function reload(on: Page): Promise<void> {
  await settled(on);
  await on.reload();
  await on.waitForSelector('html[data-ready]');
}

describe('drawings', () => {
  it('are all kept, however many models are opened, and open again from the list', async () => {
    await stroke(page, kAcross);
    const hand = (await summary(page)).curves;
    await choose('ring.obj', torusObj(24));
    await expect.poll(() => modelName()).toBe('ring.obj');
    await stroke(page, kRing);
    await page.evaluate(() => window.studio.openShape('torus'));
    await stroke(page, kRing);
    await page.evaluate(() => window.studio.openShape('trefoil'));
    await reload(page);
    await expect.poll(() => modelName()).toBe('trefoil');
    await openDrawings();
    await page.getByRole('button', { name: /^Hand 1 stroke/ }).click();
    await expect.poll(() => modelName()).toBe('hand');
    await expect.poll(async () => (await summary(page)).curves).toEqual(hand);
    await openDrawings();
    await page.getByRole('button', { name: /^ring\.obj/ }).click();
    await expect.poll(() => modelName()).toBe('ring.obj');
    await expect.poll(() => count(page)).toBe(1);
    await expect.poll(names).toEqual(['Hand', 'Torus', 'ring.obj']); // the empty one is not kept
    await reload(page);
    await expect.poll(() => modelName()).toBe('ring.obj');
  });

  it('on the built-in model that the address names are opened again, and begun where there is none', async () => {
    const id = (on = page): Promise<string> => on.evaluate(() => window.studio.documents.open.now!.id);
    const named = `${page.url()}&shape=torus`;
    const go = async (on: Page, url: string): Promise<void> => {
      await on.goto(url);
      await on.waitForSelector('html[data-ready]');
    };
    await stroke(page, kAcross);
    await settled();
    await go(page, named);
    await expect.poll(async () => [await modelName(), await count(page)]).toEqual(['torus', 0]);
    const first = await id();
    await reload(page);
    await expect.poll(id).toBe(first);
    await stroke(page, kRing);
    await reload(page);
    await expect.poll(async () => [await id(), await count(page)]).toEqual([first, 1]);
    // Another one on the same model is the latest, the other model's is not looked at.
    await page.evaluate(() => window.studio.documents.fresh());
    await stroke(page, kRing);
    await stroke(page, kRing);
    await reload(page);
    await expect.poll(() => count(page)).toBe(2);
    await page.evaluate(() => window.studio.openShape('hand'));
    await settled();
    const other = await opened.context.newPage();
    await go(other, named);
    await expect.poll(async () => [await modelName(other), await count(other)]).toEqual(['torus', 2]);
    await expect.poll(() => names(other)).toEqual(['Hand', 'Torus', 'Torus 2']);
    await go(other, named.replace('torus', 'teapot'));
    await expect.poll(() => messages(other)).toEqual([expect.stringContaining('There is no built-in model “teapot”')]);
    await other.close();
  });

  it('are renamed, deleted and brought back', async () => {
    await stroke(page, kAcross);
    await openDrawings();
    await page.getByRole('button', { name: 'Rename Hand' }).click();
    await page.getByRole('textbox').fill('Five fingers');
    await page.keyboard.press('Enter');
    await page.getByRole('button', { name: 'Delete Five fingers' }).waitFor();
    await page.getByRole('button', { name: 'New drawing' }).click();
    await expect.poll(() => count(page)).toBe(0);
    await stroke(page, kLow);
    await openDrawings();
    await page.getByRole('button', { name: 'Delete Five fingers' }).click();
    await expect.poll(names).toEqual(['Hand']);
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Undo', exact: true }).last().click();
    await expect.poll(names).toEqual(['Five fingers', 'Hand']);
    // The open one too, and from the list after a reload.
    await openDrawings();
    await page.getByRole('button', { name: 'Delete Hand' }).click();
    await expect.poll(() => count(page)).toBe(0);
    await reload(page);
    await openDrawings();
    await page.getByRole('button', { name: 'Bring back' }).click();
    await page.getByRole('button', { name: /^Hand 1 stroke/ }).click();
    await expect.poll(() => count(page)).toBe(1);
  });

  it('of earlier pages are taken over: the open one and the one that was put away', async () => {
    await stroke(page, kAcross);
    await stroke(page, kLow);
    const before = await summary(page);
    await settled();
    // As pages kept it before drawings had names.
    await page.evaluate(async () => {
      const { open, library } = window.studio.documents;
      const stored = (await library.read(open.now!.id))!;
      const { history, model } = window.studio.studio.state.now;
      const strokes = JSON.parse(new TextDecoder().decode(window.studio.studio.core.writeStrokes([history.drawing[0]!.stroke])));
      const curves = JSON.parse(new TextDecoder().decode(window.studio.studio.target!.writeCurves([history.drawing[0]!.curve], 'json')));
      const { id, mirror, style, kept } = history.drawing[0]!;
      window.studio.documents.autosave.pause();
      for (const name of ['mimicry-drawings']) {
        await new Promise((done) => { const r = indexedDB.deleteDatabase(name); r.onsuccess = done; });
      }
      const db = await new Promise<IDBDatabase>((done) => {
        const request = indexedDB.open('mimicry-studio', 1);
        request.onupgradeneeded = () => request.result.createObjectStore('shelf');
        request.onsuccess = () => done(request.result);
      });
      const shelf = db.transaction('shelf', 'readwrite').objectStore('shelf');
      shelf.put({ name: model!.name, source: model!.source }, 'model');
      shelf.put(stored.entries, 'entries');
      for (const { strokeKey, curveKey } of stored.entries) for (const key of [strokeKey, curveKey]) shelf.put(stored.parts.get(key), key);
      shelf.put({ source: { shape: 'hand' }, content: { entries: [{ id, mirror, style, kept }], strokes, curves } }, 'away');
      await new Promise((done) => (shelf.transaction.oncomplete = done));
      db.close();
      sessionStorage.clear();
    });
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(async () => (await summary(page)).curves).toEqual(before.curves);
    await expect.poll(names).toEqual(['Hand', 'Hand 2']);
    await openDrawings();
    await page.getByRole('button', { name: /^Hand 1 stroke/ }).click();
    await expect.poll(() => count(page)).toBe(1);
    await reload(page);
    await expect.poll(async () => (await summary(page)).curves).toEqual(before.curves.slice(0, 1));
    await expect.poll(names).toEqual(['Hand', 'Hand 2']);
  });

  it('in a damaged file never empty the page; one with a bad stroke opens without it', async () => {
    await stroke(page, kAcross);
    await stroke(page, kLow);
    const saved = (await downloaded(page, () => page.keyboard.press('Control+s'))).bytes;
    await page.evaluate(() => window.studio.openShape('torus'));
    await stroke(page, kRing);
    const spoil = (change: (file: any) => void): Buffer => {
      const file = JSON.parse(saved.toString());
      change(file);
      return Buffer.from(JSON.stringify(file));
    };
    const bad: [string, Buffer][] = [
      ['half', saved.subarray(0, saved.length / 2)],
      ['strokes', spoil((file) => { file.strokes = {}; })],
      ['curves', spoil((file) => { file.curves.curves = 7; file.strokes.strokes = []; })],
      ['entries', spoil((file) => { file.entries = {}; })],
      ['model', spoil((file) => { file.model = { name: 'x.obj', mesh: 'AAAA' }; })],
      ['all', spoil((file) => { for (const s of file.strokes.strokes) s.frames[0].head = null; })],
    ];
    for (const [name, bytes] of bad) {
      await choose(`${name}.mimicry-drawing`, bytes);
      await expect.poll(async () => (await messages(page)).at(-1), { message: name }).toContain(`${name}.mimicry-drawing: `);
      expect([await modelName(), await count(page)], name).toEqual(['torus', 1]);
    }
    const id = JSON.parse(saved.toString()).entries[0].id;
    await choose('one.mimicry-drawing', spoil((file) => { file.strokes.strokes[0].frames[2].controller.position[1] = null; }));
    await expect.poll(() => modelName()).toBe('hand');
    await expect.poll(async () => (await summary(page)).curves.map((c) => c.id)).toEqual([JSON.parse(saved.toString()).entries[1].id]);
    await expect.poll(async () => (await messages(page)).at(-1)).toContain(id);
    await expect.poll(names).toEqual(['Hand', 'Hand 2', 'Torus']);
  });
});

describe.each(['Web Locks', 'no Web Locks'])('two tabs, with %s', (kind) => {
  beforeEach(async () => {
    if (kind === 'Web Locks') return;
    await opened.context.addInitScript(() => Object.defineProperty(Navigator.prototype, 'locks', { get: () => undefined }));
    await reload(page);
  });

  it('never overwrite each other: the second follows, and draws on a copy', async () => {
    await stroke(page, kAcross);
    await settled();
    const second = await tab(opened.context);
    await expect.poll(() => count(second)).toBe(1);
    await expect.poll(() => messages(second)).toEqual([expect.stringContaining('open in another tab')]);
    await page.bringToFront();
    await stroke(page, kLow);
    await expect.poll(() => count(second)).toBe(2);
    await page.keyboard.press('Control+z');
    await expect.poll(() => count(second)).toBe(1);
    await second.bringToFront();
    await stroke(second, kLow);
    await expect.poll(() => messages(second)).toEqual([expect.stringContaining('You draw on a copy, “Hand (copy)”')]);
    await expect.poll(() => count(second)).toBe(2);
    await settled(second);
    await page.bringToFront();
    await stroke(page, [[310, 300], [350, 300]]);
    await stroke(page, [[310, 310], [350, 310]]);
    expect([await count(page), await count(second)]).toEqual([3, 2]);
    await reload(page);
    await reload(second);
    expect([await count(page), await count(second)]).toEqual([3, 2]);
    await expect.poll(names).toEqual(['Hand', 'Hand (copy)']);
    await expect.poll(() => messages(second)).toEqual([]);
  });

  it('pass the drawing on when the one that draws is closed', async () => {
    await stroke(page, kAcross);
    await settled();
    const second = await tab(opened.context);
    await expect.poll(() => second.evaluate(() => window.studio.documents.open.now!.writes)).toBe(false);
    await page.close({ runBeforeUnload: true });
    await expect.poll(() => second.evaluate(() => window.studio.documents.open.now!.writes)).toBe(true);
    await expect.poll(() => messages(second)).toEqual([]);
    await stroke(second, kLow);
    await reload(second);
    await expect.poll(() => count(second)).toBe(2);
    await expect.poll(() => names(second)).toEqual(['Hand']);
  });

  it('an empty drawing that the first lets go of goes on in the second', async () => {
    await settled();
    const second = await tab(opened.context);
    await page.evaluate(() => window.studio.openShape('torus'));
    await expect.poll(() => second.evaluate(() => window.studio.documents.open.now!.writes)).toBe(true);
    await second.bringToFront();
    await stroke(second, kAcross);
    await stroke(second, kLow);
    await reload(second);
    expect([await modelName(second), await count(second)]).toEqual(['hand', 2]);
    await expect.poll(() => names(second)).toContain('Hand');
  });

  it('a drawing that the first deletes goes on in the second under a name of its own', async () => {
    await stroke(page, kAcross);
    await settled();
    const second = await tab(opened.context);
    await page.evaluate(() => window.studio.documents.remove(window.studio.documents.open.now!.id));
    await expect.poll(() => second.evaluate(() => window.studio.documents.open.now!.writes)).toBe(true);
    await expect.poll(async () => (await messages(second)).at(-1)).toContain('“Hand” was deleted in another tab');
    await second.bringToFront();
    await stroke(second, kLow);
    await reload(second);
    await expect.poll(() => count(second)).toBe(2);
    const kept = await second.evaluate(async () => (await window.studio.documents.list()).find((d) => d.id === window.studio.documents.open.now!.id));
    expect(kept!.deleted_ms).toBeNull();
  });

  it('the second turns the model in a copy', async () => {
    await stroke(page, kAcross);
    await settled();
    const second = await tab(opened.context);
    await second.bringToFront();
    await second.keyboard.press('u');
    await expect.poll(() => messages(second)).toEqual([expect.stringContaining('You draw on a copy')]);
    const turn = await second.evaluate(() => [...window.studio.studio.state.now.turn]);
    await reload(second);
    await expect.poll(() => second.evaluate(() => [...window.studio.studio.state.now.turn])).toEqual(turn);
    await expect.poll(() => page.evaluate(() => window.studio.studio.state.now.turn[0])).toBe(0);
  });

  it('a drawing that is open in the other is not deleted; a new name and another side up arrive', async () => {
    await stroke(page, kAcross);
    await settled();
    const second = await tab(opened.context);
    const id = await page.evaluate(() => window.studio.documents.open.now!.id);
    expect(await second.evaluate((which) => window.studio.documents.remove(which).then(() => 'gone', (error: Error) => error.message), id)).toContain('open in another tab');
    await second.evaluate((which) => window.studio.documents.rename(which, 'Palm'), id);
    await expect.poll(() => page.title()).toBe('Palm · mimicry studio');
    await stroke(page, kLow);
    await settled();
    await expect.poll(names).toEqual(['Palm']);
    await page.keyboard.press('u');
    const turn = await page.evaluate(() => [...window.studio.studio.state.now.turn]);
    expect(turn[0]).not.toBe(0);
    await expect.poll(() => second.evaluate(() => [...window.studio.studio.state.now.turn])).toEqual(turn);
    await expect.poll(() => count(second)).toBe(2);
  });
});

describe('a page that goes away', () => {
  it('keeps the stroke that is under way, and what it had no time to write', async () => {
    await stroke(page, kAcross);
    await settled();
    await page.mouse.move(...kLow[0]!);
    await page.mouse.down();
    await page.mouse.move(...kLow[1]!, { steps: 6 });
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(() => count(page)).toBe(2);
    await stroke(page, [[310, 300], [350, 300]]);
    const before = (await summary(page)).curves;
    await page.reload(); // at once
    await page.waitForSelector('html[data-ready]');
    await expect.poll(async () => (await summary(page)).curves).toEqual(before);
    await page.mouse.up();
    await expect.poll(() => page.evaluate(() => localStorage.getItem('mimicry-last-words'))).toBeNull();
  });

  it('does not write over what was drawn since', async () => {
    await stroke(page, kAcross);
    await settled();
    const words = await page.evaluate(() => {
      const { autosave } = window.studio;
      window.studio.studio.clear();
      autosave.leave();
      return localStorage.getItem('mimicry-last-words');
    });
    expect(words).not.toBeNull();
    await page.keyboard.press('Control+z');
    await stroke(page, kLow);
    await settled();
    await page.evaluate((text) => localStorage.setItem('mimicry-last-words', text!), words);
    await reload(page);
    await expect.poll(() => count(page)).toBe(2);
  });
});

describe('storage that is full', () => {
  it('loses nothing while the page is open, offers a file, and keeps all when there is room again', async () => {
    await page.evaluate(() => {
      const { put } = IDBObjectStore.prototype;
      IDBObjectStore.prototype.put = () => { throw new DOMException('full', 'QuotaExceededError'); };
      Object.assign(window, { heal: () => { IDBObjectStore.prototype.put = put; } });
    });
    await stroke(page, kAcross);
    await expect.poll(() => messages(page)).toEqual([expect.stringContaining('storage is full')]);
    const { name } = await downloaded(page, () => page.getByRole('button', { name: 'Save to a file' }).click());
    expect(name).toBe('hand.mimicry-drawing');
    await page.evaluate(() => window.studio.openShape('torus'));
    await stroke(page, kRing);
    await page.evaluate(async () => {
      const hand = (await window.studio.documents.list()).find((d) => d.name === 'Hand')!;
      await window.studio.documents.openKept(hand.id);
    });
    expect([await modelName(), await count(page)]).toEqual(['hand', 1]);
    await page.evaluate(() => (window as unknown as { heal(): void }).heal());
    await stroke(page, kLow);
    await expect.poll(() => messages(page)).not.toContainEqual(expect.stringContaining('storage is full'));
    await reload(page);
    await expect.poll(() => count(page)).toBe(2);
    await expect.poll(names).toEqual(['Hand', 'Torus']);
  });
});
