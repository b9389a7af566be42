import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import type { Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { emulateHeadset } from './headset';
import { downloaded, Lab, messages, reset, summary, type Opened } from './studio_page';

const kNative = process.env['MIMICRY_PROGRAM'] ?? resolve('../build/release/bin/mimicry');

let lab: Lab;
let opened: Opened;
let page: Page;

// A small window: its pictures are drawn by the processor.
beforeAll(async () => {
  lab = await Lab.start();
  opened = await lab.open({ viewport: kWindow, prepare: emulateHeadset });
  page = opened.page;
});
afterAll(() => lab.stop());
beforeEach(async () => {
  await reset(page);
  await enter();
});
afterEach(async () => {
  await page.evaluate(async () => {
    for (const one of Object.values(window.headset.controllers)) {
      one!.connected = true;
      for (const button of ['trigger', 'squeeze']) one!.updateButtonValue(button, 0);
    }
    await window.studio.xr.exit();
  });
  expect(opened.errors).toEqual([]);
});

const kWindow = { width: 240, height: 180 };

async function enter(): Promise<void> {
  await page.getByRole('button', { name: 'VR' }).dispatchEvent('click');
  await page.waitForFunction(() => window.studio.stage.renderer.xr.isPresenting);
}

/** A wavy stroke with the drawing hand across the model, from press to release. */
function draw(hand: 'left' | 'right' = 'right', count = 40): Promise<void> {
  return page.evaluate(([side, frames]) => {
    const controller = window.headset.controllers[side as 'left' | 'right']!;
    return window.drive(frames as number, (i) => {
      const t = i / (frames as number);
      controller.position.set(-0.06 + 0.12 * t, 1.15 + 0.02 * Math.sin(9 * t), -0.32 + 0.01 * Math.cos(7 * t));
      controller.quaternion.set(0.05 * Math.sin(5 * t), 0.05 * Math.cos(4 * t), 0, 1);
      if (i === 2) controller.updateButtonValue('trigger', 1);
      if (i === (frames as number) - 1) controller.updateButtonValue('trigger', 0);
    });
  }, [hand, count]);
}

const place = (): Promise<number[]> => page.evaluate(() => [...window.studio.studio.state.now.modelToWorld]);

describe('a headset', () => {
  it('draws with the trigger, ticks at the start, and undoes with B', async () => {
    await page.evaluate(() => window.drive(2, () => {
      for (const { gamepad } of window.studio.stage.renderer.xr.getSession()!.inputSources) {
        const [actuator] = (gamepad as unknown as { hapticActuators: { pulse(value: number, ms: number): Promise<boolean> }[] }).hapticActuators;
        actuator!.pulse = (value) => {
          Object.assign(window, { tick: value });
          return Promise.resolve(true);
        };
      }
    }));
    await draw();
    const { curves } = await summary(page);
    expect(curves).toHaveLength(1);
    expect(curves[0]!.technique).toBe('mimicry-live');
    expect(curves[0]!.frames).toBeGreaterThan(30);
    expect(curves[0]!.points).toBeGreaterThan(20);
    await expect.poll(() => page.evaluate(() => (window as unknown as { tick?: number }).tick)).toBeGreaterThan(0);
    await page.evaluate(() => {
      const b = (v: number): void => window.headset.controllers.right!.updateButtonValue('b-button', v);
      return window.drive(6, (i) => { if (i === 1) b(1); if (i === 3) b(0); });
    });
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
  });

  it('points along -z of the target ray: spraycan inks what the controller points at', async () => {
    await page.evaluate(() => window.studio.studio.set({ technique: 'spraycan' }));
    await draw();
    const off = await page.evaluate(() => {
      const { stroke, curve } = window.studio.studio.state.now.history.drawing[0]!;
      let most = 0;
      for (let i = 0; i < curve.pointCount; i += 1) {
        const p = curve.point(i), at = 17 * p.frame;
        const [x, y, z, w] = [...stroke.frames.slice(at + 11, at + 15)] as [number, number, number, number];
        const d = [-2 * (x * z + w * y), -2 * (y * z - w * x), -(1 - 2 * (x * x + y * y))];
        const m = stroke.modelToWorld;
        const v = [0, 1, 2].map((k) => m[7]! * p.position[k as 0]! + m[4 + k]! - stroke.frames[at + 8 + k]!); // the model is not turned
        const along = v[0]! * d[0]! + v[1]! * d[1]! + v[2]! * d[2]!;
        most = Math.max(most, Math.hypot(...v.map((c, k) => c - along * d[k]!)));
      }
      return most;
    });
    expect(off).toBeLessThan(1e-7); // the emulator's quaternions are unit to single precision
  });

  it('draws with the left hand for those who do', async () => {
    await page.evaluate(() => window.studio.studio.set({ hand: 'left' }));
    await draw('right');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(0);
    await draw('left');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
  });

  it('holds the model with the other hand, also while drawing: the ink stays on the model', async () => {
    const before = await place();
    await page.evaluate(() => {
      const pen = window.headset.controllers.right!, hand = window.headset.controllers.left!;
      return window.drive(40, (i) => {
        const t = i / 40;
        // Pen and model move together: in the model's eyes the pen stands nearly still.
        pen.position.set(0.1 * t, 1.15, -0.32);
        hand.position.set(-0.3 + 0.1 * t, 1.1, -0.2);
        if (i === 2) hand.updateButtonValue('squeeze', 1);
        if (i === 4) pen.updateButtonValue('trigger', 1);
        if (i === 36) pen.updateButtonValue('trigger', 0);
        if (i === 38) hand.updateButtonValue('squeeze', 0);
      });
    });
    const after = await place();
    expect(after[4]! - before[4]!).toBeCloseTo(0.1 * (36 / 40), 1);
    expect(after[7]).toBe(before[7]);
    const { length, diagonal } = await page.evaluate(() => ({ length: window.studio.studio.state.now.history.drawing[0]!.curve.length, diagonal: window.studio.studio.target!.diagonal }));
    expect(length).toBeLessThan(0.01 * diagonal);
  });

  it('turns and scales the model with both hands', async () => {
    const before = await place();
    await page.evaluate(() => {
      const a = window.headset.controllers.right!, b = window.headset.controllers.left!;
      return window.drive(24, (i) => {
        a.position.set(0.2 + 0.01 * i, 1.1, -0.3);
        b.position.set(-0.2 - 0.01 * i, 1.1, -0.3);
        if (i === 2) { a.updateButtonValue('squeeze', 1); b.updateButtonValue('squeeze', 1); }
        if (i === 20) { a.updateButtonValue('squeeze', 0); b.updateButtonValue('squeeze', 0); }
      });
    });
    const after = await place();
    expect(after[7]! / before[7]!).toBeGreaterThan(1.5);
  });

  it('the stick changes thickness and technique, its press the tool', async () => {
    const read = (): Promise<{ radius: number; technique: string; tool: string }> => page.evaluate(() => {
      const { style, technique, tool } = window.studio.studio.settings;
      return { radius: style.radius_m, technique, tool };
    });
    const before = await read();
    await page.evaluate(() => {
      const c = window.headset.controllers.right!;
      return window.drive(30, (i) => {
        if (i === 1) c.updateAxes('thumbstick', 0, -1);
        if (i === 10) c.updateAxes('thumbstick', 0, 0);
        if (i === 12) c.updateAxes('thumbstick', 1, 0);
        if (i === 16) c.updateAxes('thumbstick', 0, 0);
        if (i === 20) c.updateButtonValue('thumbstick', 1);
        if (i === 24) c.updateButtonValue('thumbstick', 0);
      });
    });
    const after = await read();
    expect(after.radius).toBeGreaterThan(before.radius);
    expect(after.technique).not.toBe(before.technique);
    expect(after.tool).toBe('erase curve');
  });

  it('the other hand’s stick puts a model beside it, with the last stroke through another technique', async () => {
    await draw();
    const flick = (x: number): Promise<void> => page.evaluate((to) => {
      const c = window.headset.controllers.left!;
      return window.drive(8, (i) => {
        if (i === 1) c.updateAxes('thumbstick', to, 0);
        if (i === 4) c.updateAxes('thumbstick', 0, 0);
      });
    }, x);
    const beside = (): Promise<unknown> => page.evaluate(() => {
      const { twin } = window.studio.view;
      return { compare: window.studio.studio.settings.compare, inRoom: twin.group.parent === window.studio.stage.scene, ink: twin.group.children.at(-1)!.children.length };
    });
    await flick(1);
    await expect.poll(beside).toMatchObject({ compare: 'occlude', inRoom: true });
    await flick(1);
    await expect.poll(beside).toEqual({ compare: 'spraycan', inRoom: true, ink: 1 });
    await flick(-1);
    await flick(-1);
    await expect.poll(beside).toMatchObject({ compare: null, inRoom: false });
  });

  it('ends the stroke when the controller is lost, keeps it, and waits for a new press', async () => {
    await page.evaluate(() => {
      const c = window.headset.controllers.right!;
      return window.drive(60, (i) => {
        c.position.set(-0.06 + 0.003 * i, 1.15, -0.32);
        if (i === 2) c.updateButtonValue('trigger', 1);
        if (i === 20) c.connected = false;
        if (i === 30) c.connected = true;
        if (i === 40) c.updateButtonValue('trigger', 0);
      });
    });
    const { curves, drawing } = await summary(page);
    expect(drawing).toBe(false);
    expect(curves).toHaveLength(1);
    expect(curves[0]!.frames).toBeLessThan(22);
    await expect.poll(() => messages(page)).toEqual([expect.stringContaining('lost from sight')]);
    await draw();
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(2);
  });

  it('leaving it while drawing keeps the stroke and shows the page again', async () => {
    await page.evaluate(() => window.drive(20, (i) => {
      const c = window.headset.controllers.right!;
      c.position.set(-0.06 + 0.003 * i, 1.15, -0.32);
      if (i === 2) c.updateButtonValue('trigger', 1);
    }));
    await page.evaluate(() => window.studio.xr.exit());
    await page.waitForFunction(() => !window.studio.stage.renderer.xr.isPresenting);
    const { curves, drawing } = await summary(page);
    expect([curves.length, drawing]).toEqual([1, false]);
    await expect.poll(() => page.$eval('canvas', (canvas) => [canvas.width, canvas.height])).toEqual([kWindow.width, kWindow.height]);
  });

  it('leaving it brings back window, camera and picture, also where the model was moved or the window resized', async () => {
    await page.evaluate(() => window.studio.xr.exit());
    await page.waitForFunction(() => !window.studio.stage.renderer.xr.isPresenting);
    const seen = (): Promise<{ aspect: number; fov: number; position: number[]; model: number[]; projection: number[]; size: number[] }> => page.evaluate(() => {
      const { camera: c, renderer } = window.studio.stage;
      return {
        aspect: c.aspect, fov: c.fov, position: c.position.toArray().map((v) => Math.round(1e9 * v) / 1e9), model: [...window.studio.studio.state.now.modelToWorld],
        projection: [...c.projectionMatrix.elements].map((v) => Math.round(1e9 * v) / 1e9), size: [renderer.domElement.width, renderer.domElement.height],
      };
    });
    // A view that is not the first one.
    const first = await seen();
    await page.evaluate(() => { window.studio.stage.rig.orbit(0.7, 0.2); window.studio.stage.rig.zoom(0.8); window.studio.stage.invalidate(); });
    await expect.poll(async () => (await seen()).position).not.toEqual(first.position);
    const before = await seen();
    await enter();
    await draw();
    await page.evaluate(() => {
      const a = window.headset.controllers.right!, b = window.headset.controllers.left!;
      return window.drive(20, (i) => {
        a.position.set(0.2 + 0.01 * i, 1.1, -0.3);
        b.position.set(-0.2 - 0.01 * i, 1.1 + 0.01 * i, -0.3);
        if (i === 2) { a.updateButtonValue('squeeze', 1); b.updateButtonValue('squeeze', 1); }
        if (i === 16) { a.updateButtonValue('squeeze', 0); b.updateButtonValue('squeeze', 0); }
      });
    });
    await page.evaluate(() => window.studio.xr.exit());
    await expect.poll(seen).toEqual(before);
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
    // Something is seen, and it is drawn on.
    await page.evaluate(() => window.studio.frameModel());
    await page.evaluate(() => {
      // On the canvas itself: the controls cover most of this window.
      const send = (type: string, x: number): unknown => document.querySelector('canvas')!.dispatchEvent(new PointerEvent(type, { pointerId: 7, pointerType: 'mouse', button: type === 'pointermove' ? -1 : 0, buttons: type === 'pointerup' ? 0 : 1, clientX: x, clientY: 90 }));
      for (const [type, x] of [['pointerdown', 118], ['pointermove', 121], ['pointermove', 124], ['pointerup', 124]] as const) send(type, x);
    });
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(2);
    await enter();
    await page.setViewportSize({ width: 300, height: 200 });
    await page.evaluate(() => window.studio.xr.exit());
    await expect.poll(async () => (await seen()).size).toEqual([300, 200]);
    await expect.poll(async () => (await seen()).aspect).toBeCloseTo(1.5, 12);
    await page.setViewportSize(kWindow);
    await expect.poll(async () => (await seen()).size).toEqual([kWindow.width, kWindow.height]);
  });

  it('has the model before the head, facing it, wherever that is', async () => {
    await page.evaluate(() => window.studio.xr.exit());
    await page.waitForFunction(() => !window.studio.stage.renderer.xr.isPresenting);
    await page.evaluate(() => {
      window.headset.position.set(1.5, 1.72, 0.8);
      window.headset.quaternion.set(0, Math.sin(-Math.PI / 4), 0, Math.cos(-Math.PI / 4)); // to the right: along +x
    });
    await enter();
    await page.evaluate(() => window.drive(4, () => undefined));
    const stands = await page.evaluate(() => {
      const { studio, view } = window.studio;
      const centre = studio.centre();
      const p = view.model.group.localToWorld(window.studio.stage.camera.position.clone().set(centre[0]!, centre[1]!, centre[2]!));
      return { p: p.toArray(), turn: [...studio.state.now.modelToWorld.slice(0, 4)] };
    });
    await page.evaluate(() => { window.headset.position.set(0, 1.2, 0); window.headset.quaternion.set(0, 0, 0, 1); });
    expect(stands.p[0]! - 1.5).toBeGreaterThan(0.35);
    expect(stands.p[0]! - 1.5).toBeLessThan(1.25);
    expect(Math.abs(stands.p[1]! - 1.72)).toBeLessThan(0.1);
    expect(stands.p[2]!).toBeCloseTo(0.8, 6);
    // The model's front, +z, looks back along -x.
    const [, y, , w] = stands.turn as [number, number, number, number];
    expect([2 * y * w, 1 - 2 * y * y]).toEqual([expect.closeTo(-1, 6), expect.closeTo(0, 6)]);
  });

  it('says how to draw until the first stroke, and has redo and symmetry on the other hand', async () => {
    const hint = (): Promise<boolean> => page.evaluate(() => window.studio.xr.hands.hintVisible);
    await page.evaluate(() => window.drive(2, () => undefined));
    await expect.poll(hint).toBe(true);
    await draw();
    await expect.poll(hint).toBe(false);
    const press = (hand: 'left' | 'right', button: string): Promise<void> => page.evaluate(([side, name]) => {
      const c = window.headset.controllers[side as 'left' | 'right']!;
      return window.drive(6, (i) => { if (i === 1) c.updateButtonValue(name!, 1); if (i === 3) c.updateButtonValue(name!, 0); });
    }, [hand, button]);
    await press('right', 'b-button');
    await expect.poll(() => summary(page)).toMatchObject({ curves: [], future: 1 });
    await press('left', 'y-button');
    await expect.poll(async () => (await summary(page)).curves).toHaveLength(1);
    const settings = (): Promise<{ mirror: string | null; color: string }> => page.evaluate(() => ({ mirror: window.studio.studio.settings.mirror, color: window.studio.studio.settings.style.color }));
    const before = await settings();
    await press('left', 'x-button');
    await expect.poll(async () => (await settings()).mirror).toBe('x');
    await press('right', 'a-button');
    await expect.poll(async () => (await settings()).color).not.toBe(before.color);
  });

  it('that is denied is answered by a sentence', async () => {
    await page.evaluate(() => window.studio.xr.exit());
    await page.evaluate(() => {
      const xr = navigator.xr!, own = xr.requestSession;
      xr.requestSession = () => {
        xr.requestSession = own;
        return Promise.reject(new DOMException('no', 'NotAllowedError'));
      };
      window.studio.enterXr('immersive-vr');
    });
    await expect.poll(() => messages(page)).toEqual([expect.stringContaining('permission was denied')]);
  });
});

describe('without a headset', () => {
  it('the menu has the button, and it says why and what to do', async () => {
    const { page: bare, context } = await lab.open();
    const press = async (): Promise<void> => {
      await bare.getByRole('button', { name: 'Save, export and more' }).click();
      await bare.getByRole('button', { name: 'Draw in a headset' }).click();
    };
    await press();
    await expect.poll(() => messages(bare)).toEqual([expect.stringMatching(/found no headset\. Connect one|no WebXR.*Open this page/)]);
    await bare.evaluate(() => Object.defineProperty(navigator, 'xr', { value: undefined, configurable: true }));
    await press();
    await expect.poll(async () => (await messages(bare)).at(-1)).toMatch(/no WebXR.*Open this page/);
    await context.close();
  });
});

describe('replay', () => {
  it.skipIf(!existsSync(kNative))('by the native program gives the same curves', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'studio-'));
    const mesh = join(folder, 'shape.obj');
    execFileSync(kNative, ['shapes', 'hand', '--out', mesh]);
    await page.evaluate(() => window.studio.xr.exit());
    await page.setInputFiles('input[type=file]', mesh);
    await page.waitForFunction(() => window.studio.studio.state.now.model?.name === 'shape.obj');
    await enter();
    const diagonal = await page.evaluate(() => window.studio.studio.target!.diagonal);
    for (const technique of ['mimicry-live', 'snap', 'anchored-closest', 'spraycan', 'occlude', 'anchored-ray-plane']) {
      await page.evaluate((name) => { window.studio.studio.clear(); window.studio.studio.set({ technique: name }); }, technique);
      await draw('right', 30);
      await expect.poll(async () => (await summary(page)).curves, { message: technique }).toHaveLength(1);
      const strokes = join(folder, 'strokes.json'), out = join(folder, technique);
      writeFileSync(strokes, (await downloaded(page, () => page.evaluate(() => window.studio.exportStrokes()))).bytes);
      const ours = JSON.parse((await downloaded(page, () => page.evaluate(() => window.studio.exportCurves('json')))).bytes.toString());
      execFileSync(kNative, ['project', mesh, strokes, '-t', technique, '-o', out]);
      const theirs = JSON.parse(readFileSync(join(out, 'curves.json'), 'utf8'));
      const [a, b] = [ours.curves[0], theirs.curves[0]];
      expect(a.points.length, technique).toBe(b.points.length);
      for (let i = 0; i < a.points.length; i += 1) {
        const [p, q] = [a.points[i], b.points[i]];
        expect(p.frame).toBe(q.frame);
        expect(Math.hypot(...[0, 1, 2].map((k) => p.position[k] - q.position[k]))).toBeLessThanOrEqual(1e-9 * diagonal);
        if (p.face !== q.face) expect(Math.min(...p.bary)).toBeLessThan(1e-9);
      }
      // Only arithmetic and square roots on both sides: equal to the bit. (Normals are weighted by angles, and mimicry-live follows normals.)
      const bits = (points: { face: number; bary: number[]; position: number[] }[]): string => JSON.stringify(points.map((one) => [one.face, one.bary, one.position]));
      if (technique !== 'mimicry-live') expect(bits(a.points), technique).toBe(bits(b.points));
    }
  });
});
