import { existsSync } from 'node:fs';
import { chromium, type Browser, type BrowserContext, type BrowserContextOptions, type Page } from 'playwright-core';
import type { App } from '../../src/app/app';
import { kDefaults } from '../../src/studio/settings';
import { serve, type Served } from './server';

export const kWindow = { width: 640, height: 480 };

export const kChromium = '/usr/bin/chromium';

declare global {
  interface Window {
    studio: App;
  }
}

export interface Opened {
  context: BrowserContext;
  page: Page;
  /** Errors of the page that nobody caught, and what it wrote to the console as an error. */
  errors: string[];
}

/** A browser and the built page. */
export class Lab {
  private constructor(readonly browser: Browser, readonly served: Served) {}

  static async start(): Promise<Lab> {
    if (!existsSync('dist/index.html')) throw new Error('dist/ is not there; run: npm run build');
    const browser = await chromium.launch({
      executablePath: kChromium,
      args: ['--headless', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run',
        '--disable-background-networking', '--disable-component-update', '--disable-sync', '--enable-precise-memory-info', '--js-flags=--expose-gc'],
    });
    return new Lab(browser, await serve());
  }

  async stop(): Promise<void> {
    await this.browser.close();
    this.served.close();
  }

  /** The studio, ready to be drawn in. prepare: before the page's own code runs. newcomer: who sees the hint, and the model below it. */
  async open(options: BrowserContextOptions & { query?: string; newcomer?: boolean; prepare?: (page: Page) => Promise<void> } = {}): Promise<Opened> {
    const { query = '', newcomer = false, prepare, ...rest } = options;
    const context = await this.browser.newContext({ viewport: kWindow, deviceScaleFactor: 1, colorScheme: 'light', acceptDownloads: true, serviceWorkers: 'block', ...rest });
    context.setDefaultTimeout(240000); // against hangs: a busy machine takes its time
    const page = await context.newPage();
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('console', (message) => {
      // A page that is not from `mimicry serve` asks in vain whether it is.
      if (message.type() === 'error' && !message.location().url.endsWith('/api/status')) errors.push(`${message.text()} ${message.location().url}`);
    });
    if (!newcomer) await page.addInitScript(knowsTheHint);
    if (prepare) await prepare(page);
    await page.goto(`${this.served.url}?antialias=off&motion=off${query || '&embeddings=off'}`);
    await page.waitForSelector('html[data-ready]', { timeout: 240000 });
    return { context, page, errors };
  }
}

/** In a page before its own code runs: someone has drawn here before, and the model has the hint's place too. */
export function knowsTheHint(): void {
  try {
    localStorage['mimicry-studio-settings'] ??= '{"hintSeen":true}';
  } catch {
    // An empty page has no storage.
  }
}

/** As just opened: the first model, no drawing, the first settings. */
export async function reset(page: Page): Promise<void> {
  await page.evaluate(async (defaults) => {
    for (const sheet of document.querySelectorAll<HTMLElement>('[popover]')) sheet.hidePopover();
    document.querySelector<HTMLDialogElement>('dialog[open]')?.close();
    window.studio.studio.set({ ...defaults, hintSeen: true });
    window.studio.openShape('hand');
    await window.studio.autosave.settled();
    document.querySelectorAll('.message').forEach((message) => message.remove());
  }, kDefaults);
}

export interface Summary {
  curves: { id: string; technique: string; points: number; frames: number; color: string; kept: (readonly [number, number])[]; mirror: string | null; pressures: number[] }[];
  past: number;
  future: number;
  drawing: boolean;
}

/** The drawing in words that can leave the page. */
export function summary(page: Page): Promise<Summary> {
  return page.evaluate(() => {
    const { history, drawing } = window.studio.studio.state.now;
    return {
      curves: history.drawing.map((drawn) => ({
        id: drawn.id, technique: drawn.curve.technique, points: drawn.curve.pointCount, frames: drawn.stroke.frames.length / 17, color: drawn.style.color,
        kept: [...drawn.kept], mirror: drawn.mirror, pressures: Array.from({ length: drawn.stroke.frames.length / 17 }, (_, i) => drawn.stroke.frames[17 * i + 16]!),
      })),
      past: history.past.length, future: history.future.length, drawing,
    };
  });
}

/** A mouse stroke through points of the window. */
export async function stroke(page: Page, points: readonly (readonly [number, number])[], steps = 6): Promise<void> {
  await page.mouse.move(...points[0]!);
  await page.mouse.down();
  for (const point of points.slice(1)) await page.mouse.move(...point, { steps });
  await page.mouse.up();
  await page.waitForFunction(() => !window.studio.pointer.isUsing);
}

/** A stroke over the middle of the model. */
export const kAcross = [[300, 240], [320, 220], [340, 225], [365, 240]] as const;

export async function messages(page: Page): Promise<string[]> {
  return page.$$eval('#messages .message p', (list) => list.map((p) => p.textContent ?? ''));
}

/** What the page offers as a download when `act` is done. */
export async function downloaded(page: Page, act: () => Promise<void>): Promise<{ name: string; bytes: Buffer }> {
  const waiting = page.waitForEvent('download');
  await act();
  const download = await waiting;
  const parts: Buffer[] = [];
  for await (const part of await download.createReadStream()) parts.push(part as Buffer);
  return { name: download.suggestedFilename(), bytes: Buffer.concat(parts) };
}
