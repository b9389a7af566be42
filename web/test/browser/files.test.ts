import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { torusObj } from './meshes';
import { downloaded, kAcross, Lab, messages, reset, stroke, summary, type Opened } from './studio_page';

/** On the torus. */
const kRing = [[390, 190], [400, 220], [395, 250]] as const;

let lab: Lab;
let opened: Opened;
let page: Page;

beforeAll(async () => { lab = await Lab.start(); });
afterAll(() => lab.stop());
beforeAll(async () => {
  opened = await lab.open();
  page = opened.page;
});
beforeEach(() => reset(page));
afterEach(() => { expect(opened.errors).toEqual([]); });

async function choose(...files: { name: string; bytes: Buffer | string }[]): Promise<void> {
  await page.setInputFiles('input[type=file]', files.map(({ name, bytes }) => ({ name, mimeType: '', buffer: Buffer.from(bytes) })));
}

async function drop(name: string, text: string): Promise<void> {
  const transfer = await page.evaluateHandle(([n, t]) => {
    const data = new DataTransfer();
    data.items.add(new File([t!], n!));
    return data;
  }, [name, text]);
  await page.dispatchEvent('body', 'dragenter', { dataTransfer: transfer });
  await page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
}

const modelName = (): Promise<string | undefined> => page.evaluate(() => window.studio.studio.state.now.model?.name);
const menu = async (item: string): Promise<void> => {
  await page.getByRole('button', { name: 'Save, export and more' }).click();
  await page.getByRole('button', { name: item }).click();
};
const settled = (): Promise<void> => page.evaluate(() => window.studio.autosave.settled());

describe('models', () => {
  it('a dropped OBJ is drawn on at once', async () => {
    await drop('ring.obj', torusObj(24));
    await expect.poll(modelName).toBe('ring.obj');
    await stroke(page, kRing);
    await expect.poll(async () => (await summary(page)).curves[0]!.points).toBeGreaterThan(5);
    await expect.poll(() => messages(page)).toEqual([]);
  });

  it('an 86,400-face OBJ too', async () => {
    await choose({ name: 'large.obj', bytes: torusObj(120) });
    await expect.poll(modelName).toBe('large.obj');
    await stroke(page, kRing);
    await expect.poll(async () => (await summary(page)).curves[0]!.points).toBeGreaterThan(5);
  });

  it('STL, PLY and the built-in shapes are read', async () => {
    await choose({ name: 'tri.stl', bytes: 'solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n' });
    await expect.poll(modelName).toBe('tri.stl');
    await choose({ name: 'tri.ply', bytes: 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' });
    await expect.poll(modelName).toBe('tri.ply');
    await page.getByTitle('Choose or open a model').click();
    await page.getByRole('button', { name: 'Trefoil' }).click();
    await expect.poll(modelName).toBe('trefoil');
  });

  it('a glTF opens with the files that it names, and stays', async () => {
    const gltf = JSON.stringify({
      asset: { version: '2.0' },
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      accessors: [{ bufferView: 0, count: 3, componentType: 5126, type: 'VEC3' }],
      bufferViews: [{ buffer: 0, byteLength: 36 }],
      buffers: [{ uri: 'corner%201.bin', byteLength: 36 }],
      images: [{ uri: 'wood.png' }],
    });
    const bin = Buffer.from(new Float32Array([-1, -1, 0, 1, -1, 0, 0, 1, 0]).buffer);
    await choose({ name: 'corner.gltf', bytes: gltf });
    await expect.poll(async () => (await messages(page)).at(-1)).toMatch(/corner\.gltf.*corner 1\.bin.*together/);
    await choose({ name: 'corner 1.bin', bytes: bin }, { name: 'wood.png', bytes: 'x' }, { name: 'corner.gltf', bytes: gltf });
    await expect.poll(modelName).toBe('corner.gltf');
    await stroke(page, kAcross);
    await expect.poll(async () => (await summary(page)).curves[0]!.points).toBeGreaterThan(5);
    await settled();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(() => modelName()).toBe('corner.gltf');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });

  it('what cannot be used is answered by a sentence, and nothing is lost', async () => {
    await stroke(page, kAcross);
    const bad = [
      { name: 'text.obj', bytes: 'this is not a mesh\n', says: /text\.obj/ },
      { name: 'nan.obj', bytes: 'v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n', says: /nan\.obj/ },
      { name: 'cut.glb', bytes: 'glTF\u0002\0\0\0', says: /cut\.glb/ },
      { name: 'empty.ply', bytes: '', says: /empty\.ply: the file is empty/ },
      { name: 'photo.jpg', bytes: 'x', says: /photo\.jpg: not a kind of file that the studio opens/ },
      { name: 'points.ply', bytes: 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n', says: /points\.ply: .*(triangle|face)/ },
      { name: 'none.obj', bytes: 'v 0 0 0\nv 1 0 0\nv 0 1 0\n', says: /none\.obj: .*(triangle|face)/ },
      { name: 'cut.json', bytes: '{"format": "mimicry-curves", "version": 1, "curves": [', says: /cut\.json: the file is cut off/ },
      { name: 'other.json', bytes: '{"format": "other"}', says: /other\.json/ },
      { name: 'wrong.mimicry', bytes: 'MIMICRY?', says: /wrong\.mimicry/ },
      { name: 'new.mimicry-drawing', bytes: '{"format":"mimicry-drawing","version":1,"model":{"shape":"teapot"},"entries":[],"strokes":{},"curves":{}}', says: /new\.mimicry-drawing: a drawing on “teapot”/ },
      { name: 'empty.mimicry-drawing', bytes: '', says: /empty\.mimicry-drawing: the drawing file is empty; saving it was interrupted/ },
      { name: 'empty.json', bytes: '', says: /empty\.json: the file is empty; export it again/ },
      { name: 'empty.obj', bytes: '', says: /empty\.obj: the file is empty; export it again/ },
      { name: 'other.mimicry-drawing', bytes: 'PK', says: /other\.mimicry-drawing: not a mimicry drawing, or its beginning is damaged/ },
      { name: 'half.mimicry-drawing', bytes: '{"format":"mimicry-drawing","version":1,', says: /half\.mimicry-drawing: the file is cut off/ },
    ];
    for (const { name, bytes, says } of bad) {
      await choose({ name, bytes });
      await expect.poll(async () => (await messages(page)).at(-1), { message: name }).toMatch(says);
    }
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
    await expect.poll(() => modelName()).toBe('hand');
  });

  it('a file of 2 GB is refused before it is read', async () => {
    await page.evaluate(() => {
      const file = new File(['v'], 'huge.obj');
      Object.defineProperty(file, 'size', { value: 2e9 });
      window.studio.openFiles([file]);
    });
    await expect.poll(() => messages(page)).toEqual([expect.stringContaining('huge.obj: 2.0 GB is more than a browser can hold')]);
  });

  it('reading can be cancelled', async () => {
    await page.evaluate((text) => {
      window.studio.openFiles([new File([text], 'slow.obj')]);
      document.querySelector<HTMLButtonElement>('.work button')!.click();
    }, torusObj(60));
    await expect.poll(() => messages(page)).toEqual([]);
    await expect.poll(() => modelName()).toBe('hand');
  });
});

describe('drawings', () => {
  it('are there again after a reload, to the bit, erased parts gone', async () => {
    await page.keyboard.press('m');
    await stroke(page, kAcross);
    await page.keyboard.press('2');
    await stroke(page, [[320, 280], [375, 285]]);
    await page.keyboard.press('r');
    await stroke(page, [[345, 282], [348, 282]]);
    const state = (): Promise<unknown> => page.evaluate(() => window.studio.studio.state.now.history.drawing.map((d) => ({ id: d.id, kept: d.kept, style: d.style, mirror: d.mirror, ink: [...d.curve.ink.integers], frames: [...d.stroke.frames] })));
    const before = await state();
    await settled();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(state).toEqual(before);
  });

  it('on an opened file come back with the file; what is being drawn when the page goes is kept', async () => {
    await drop('ring.obj', torusObj(24));
    await expect.poll(modelName).toBe('ring.obj');
    await page.mouse.move(...kRing[0]!);
    await page.mouse.down();
    await page.mouse.move(...kRing[1]!, { steps: 6 });
    await page.evaluate(() => window.dispatchEvent(new Event('pagehide')));
    await settled();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(() => modelName()).toBe('ring.obj');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });

  it('are saved to a file and opened from it', async () => {
    await drop('ring.obj', torusObj(24));
    await expect.poll(modelName).toBe('ring.obj');
    await stroke(page, kRing);
    const saved = await downloaded(page, () => page.keyboard.press('Control+s'));
    expect(saved.name).toBe('ring.mimicry-drawing');
    const before = await summary(page);
    await page.getByTitle('Choose or open a model').click();
    await page.getByRole('button', { name: 'Torus', exact: true }).click();
    await expect.poll(modelName).toBe('torus');
    await choose(saved);
    await expect.poll(modelName).toBe('ring.obj');
    await expect.poll(async () => (await summary(page)).curves).toEqual(before.curves);
  });

  it('come back without their bake where it cannot be read any more', async () => {
    await stroke(page, kAcross);
    const before = await summary(page);
    await page.evaluate(() => window.studio.autosave.saveEmbedding(new Uint8Array([1, 2, 3])));
    await settled();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(async () => (await summary(page)).curves).toEqual(before.curves);
    await expect.poll(() => messages(page)).toEqual([expect.stringContaining('the prepared model')]);
  });

  it('are exported in every format', async () => {
    await stroke(page, kAcross);
    const looks: Record<string, (bytes: Buffer) => boolean> = {
      'Curves, JSON': (b) => JSON.parse(b.toString()).format === 'mimicry-curves',
      'Scene, GLB': (b) => b.subarray(0, 4).toString() === 'glTF',
      'Polylines, OBJ': (b) => /^l /m.test(b.toString()),
      'Tubes, PLY': (b) => b.toString('latin1').startsWith('ply\nformat binary_little_endian'),
      'Table, CSV': (b) => b.toString().startsWith('curve,stroke,'),
      'Recorded strokes': (b) => JSON.parse(b.toString()).format === 'mimicry-strokes',
    };
    let glb: Buffer = Buffer.alloc(0);
    for (const [item, right] of Object.entries(looks)) {
      const { name, bytes } = await downloaded(page, () => menu(item));
      expect(name).toMatch(/^hand-(curves\.(json|glb|obj|ply|csv)|strokes\.json)$/);
      expect(right(bytes), item).toBe(true);
      if (name.endsWith('.glb')) glb = bytes;
    }
    await choose({ name: 'scene.glb', bytes: glb });
    await expect.poll(modelName).toBe('scene.glb');
    await expect.poll(async () => (await messages(page)).at(-1)).toContain('its ink is opened as part of the model');
  });

  it('export their erased curves in parts', async () => {
    await stroke(page, kAcross, 20);
    await page.evaluate(() => {
      const { studio, tools } = window.studio;
      const { ink } = studio.state.now.history.drawing[0]!.curve;
      const at = 8 * Math.floor(ink.count / 2);
      studio.set({ tool: 'erase part', eraser_m: 0.02 * studio.target!.diagonal * studio.state.now.modelToWorld[7]! });
      tools.now.press(studio, {
        frame: new Float64Array(17), device: 'mouse', end: 'tip', modifiers: { shift: false, alt: false, control: false },
        hit: () => studio.target!.closestPoint(ink.floats[at]!, ink.floats[at + 1]!, ink.floats[at + 2]!),
      })!.release();
    });
    const { bytes } = await downloaded(page, () => menu('Curves, JSON'));
    expect(JSON.parse(bytes.toString()).curves.map((c: { stroke: string }) => c.stroke.replace(/^.*\./, '.'))).toEqual(['.1', '.2']);
  });

  it('recorded strokes are drawn again by the technique in use, to the same points', async () => {
    await stroke(page, kAcross, 12);
    const strokes = await downloaded(page, () => menu('Recorded strokes'));
    const points = (await summary(page)).curves[0]!.points;
    await menu('Clear the drawing');
    await choose({ name: 'strokes.json', bytes: strokes.bytes });
    await expect.poll(async () => (await summary(page)).curves.map((c) => c.points)).toEqual([points]);
  });

  it('of another model are announced', async () => {
    await stroke(page, kAcross, 12);
    const strokes = await downloaded(page, () => menu('Recorded strokes'));
    await menu('Clear the drawing');
    await choose({ name: 'own.json', bytes: strokes.bytes });
    await expect.poll(async () => (await messages(page)).at(-1)).toBe('1 stroke drawn.');
    await page.evaluate(() => window.studio.openShape('torus'));
    await choose({ name: 'other.json', bytes: strokes.bytes });
    await expect.poll(async () => (await messages(page)).at(-1)).toContain('other.json was recorded on “hand”; on “torus”');
  });

  it('that were exported as curves come back on their own model; for others the page says what can be done', async () => {
    await stroke(page, kAcross, 12);
    const ink = (): Promise<number[][]> => page.evaluate(() => window.studio.studio.state.now.history.drawing.map((d) => [...d.curve.ink.integers]));
    const before = await ink();
    const json = await downloaded(page, () => menu('Curves, JSON'));
    const obj = await downloaded(page, () => menu('Polylines, OBJ'));
    const csv = await downloaded(page, () => menu('Table, CSV'));
    await menu('Clear the drawing');
    await choose(json);
    await expect.poll(async () => (await messages(page)).at(-1)).toMatch(/1 curve added\. .*without recorded strokes/);
    await expect.poll(ink).toEqual(before);
    await page.evaluate(() => { window.studio.studio.set({ compare: 'spraycan' }); window.studio.redrawLast(); });
    await expect.poll(async () => (await messages(page)).at(-1)).toContain('without its recorded stroke');
    await settled();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(ink).toEqual(before);
    for (const file of [obj, csv]) {
      await choose(file);
      await expect.poll(async () => (await messages(page)).at(-1)).toContain(`${file.name}: it has curves for other programs`);
    }
    await expect.poll(ink).toEqual(before);
    await page.evaluate(() => window.studio.openShape('torus'));
    await choose({ name: 'c.json', bytes: json.bytes });
    await expect.poll(async () => (await messages(page)).at(-1)).toMatch(/c\.json: curves on “hand” \(.*\), and “torus” is open; open that model/);
    await expect.poll(ink).toEqual([]);
  });

  it('whose ink is as thick as the model are shown thinner, and the page says so', async () => {
    await stroke(page, kAcross, 12);
    const saved = await downloaded(page, () => menu('Save the drawing'));
    const file = JSON.parse(saved.bytes.toString());
    file.entries[0].style.radius_m = 1e6;
    await choose({ name: 'thick.mimicry-drawing', bytes: JSON.stringify(file) });
    await expect.poll(() => messages(page)).toEqual([expect.stringMatching(/^thick\.mimicry-drawing: the ink of 1 curve .*shown with the usual one/)]);
    await expect.poll(() => page.evaluate(() => window.studio.studio.state.now.history.drawing[0]!.style.radius_m)).toBe(0.003);
  });
});

describe('preparing', () => {
  it('runs beside drawing, can be cancelled, and switches the other techniques on', async () => {
    await drop('ring.obj', torusObj(8));
    await expect.poll(modelName).toBe('ring.obj');
    const mimicry = page.getByRole('radio', { name: /^Mimicry (?!live)/ }).first();
    const start = async (): Promise<void> => {
      await page.keyboard.press('t');
      await expect.poll(() => mimicry.isDisabled()).toBe(true);
      await page.getByRole('button', { name: 'Prepare this model' }).click();
    };
    await page.evaluate(() => {
      window.studio.bake();
      document.querySelector<HTMLButtonElement>('.work button')!.click();
    });
    await expect.poll(() => messages(page)).toEqual([]);
    await start();
    await stroke(page, kRing);
    await expect.poll(() => messages(page), { timeout: 240000 }).toEqual([expect.stringContaining('is prepared')]);
    await page.keyboard.press('t');
    await page.locator('input[value=mimicry]').check();
    await page.keyboard.press('Escape');
    await stroke(page, kRing);
    await expect.poll(async () => (await summary(page)).curves.map((c) => c.technique)).toEqual(['mimicry-live', 'mimicry']);
    await settled();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await expect.poll(() => page.evaluate(() => [window.studio.studio.state.now.hasEmbedding, window.studio.studio.settings.technique])).toEqual([true, 'mimicry']);
    await expect.poll(async () => (await summary(page)).curves.map((c) => c.technique)).toEqual(['mimicry-live', 'mimicry']);
  });
});

describe('a .mimicry file', () => {
  it('switches the techniques on that need it, on its own model only', async () => {
    const torus = { name: 'torus.mimicry', bytes: readFileSync('embeddings/torus.mimicry') };
    await choose(torus);
    await expect.poll(async () => (await messages(page)).at(-1)).toMatch(/of another mesh/);
    await page.evaluate(() => window.studio.openShape('torus'));
    await choose(torus);
    await page.waitForFunction(() => window.studio.studio.state.now.hasEmbedding);
    await page.evaluate(() => {
      window.studio.studio.set({ technique: 'snap-smooth' });
      document.querySelectorAll('.message').forEach((message) => message.remove()); // they float over the model
    });
    await stroke(page, kRing);
    await expect.poll(async () => (await summary(page)).curves.map((c) => c.technique)).toEqual(['snap-smooth']);
  });
});

describe('a built-in model', () => {
  it('is prepared already: its bake comes after the first stroke is possible', async () => {
    const { page: fresh, context, errors } = await lab.open({ query: '&embeddings=on' });
    await expect.poll(() => fresh.evaluate(() => window.studio.studio.state.now.hasEmbedding)).toBe(false);
    await stroke(fresh, kAcross);
    await fresh.waitForFunction(() => window.studio.studio.state.now.hasEmbedding);
    await fresh.keyboard.press('t');
    await fresh.locator('input[value=mimicry]').check();
    await fresh.keyboard.press('Escape');
    await stroke(fresh, [[320, 280], [375, 285]]);
    await expect.poll(async () => (await summary(fresh)).curves.map((c) => c.technique)).toEqual(['mimicry-live', 'mimicry']);
    await fresh.evaluate(() => window.studio.autosave.settled());
    await fresh.reload();
    await fresh.waitForSelector('html[data-ready]');
    await fresh.waitForFunction(() => window.studio.studio.settings.technique === 'mimicry');
    expect(errors).toEqual([]);
    await context.close();
  });
});

describe('a browser without', () => {
  it('WebGL 2 is told so', async () => {
    const context = await lab.browser.newContext();
    const bare = await context.newPage();
    await bare.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; });
    await bare.goto(lab.served.url);
    await expect.poll(() => bare.locator('.fatal').textContent()).toContain('no WebGL 2');
    await context.close();
  });

  it('leave to store anything draws all the same, and says that nothing is kept', async () => {
    const { page: strict, context } = await lab.open({
      prepare: async (fresh) => void (await fresh.addInitScript(() => {
        for (const name of ['localStorage', 'indexedDB']) Object.defineProperty(window, name, { get() { throw new DOMException('denied', 'SecurityError'); } });
      })),
    });
    await reset(strict); // a newcomer's model has less room
    await stroke(strict, kAcross);
    await expect.poll(async () => (await summary(strict)).curves).toHaveLength(1);
    await expect.poll(() => messages(strict)).toEqual([expect.stringContaining('does not let this page keep the drawing')]);
    await context.close();
  });

  it('a picture for a moment keeps the drawing, and gets the picture back', async () => {
    await stroke(page, kAcross);
    await page.evaluate(async () => {
      const lose = window.studio.stage.renderer.getContext().getExtension('WEBGL_lose_context')!;
      lose.loseContext();
      await new Promise((done) => setTimeout(done, 100));
      lose.restoreContext();
    });
    await expect.poll(() => messages(page)).toEqual([expect.stringContaining('the drawing is safe')]);
    await stroke(page, [[320, 280], [375, 285]]);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(2);
    opened.errors.length = 0; // three.js tells the console of the loss
  });
});
