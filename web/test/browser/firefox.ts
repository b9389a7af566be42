import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync } from 'node:fs';
import puppeteer, { type Browser, type BrowserContext, type Page } from 'puppeteer-core';
import { serve, type Served } from './server';
import { knowsTheHint, kWindow } from './studio_page';

const kFirefox = '/usr/bin/firefox-esr';

export interface FirefoxPage {
  context: BrowserContext;
  page: Page;
  /** Errors of the page that nobody caught, and what it wrote to the console as an error. */
  errors: string[];
}

/** Debian's Firefox, over WebDriver BiDi, and the built page. Firefox draws WebGL with a screen only: it gets one of its own. */
export class FirefoxLab {
  private constructor(private readonly screen: ChildProcess, private readonly browser: Browser, readonly served: Served) {}

  static async start(): Promise<FirefoxLab> {
    if (!existsSync('dist/index.html')) throw new Error('dist/ is not there; run: npm run build');
    const screen = spawn('Xvfb', ['-displayfd', '1', '-screen', '0', '1280x1024x24', '-nolisten', 'tcp'], { stdio: ['ignore', 'pipe', 'ignore'] });
    const display = await new Promise<string>((done, fail) => {
      screen.on('error', fail);
      screen.stdout!.once('data', (number: Buffer) => done(`:${String(number).trim()}`));
    });
    const browser = await puppeteer.launch({
      browser: 'firefox', executablePath: kFirefox, headless: false, timeout: 240000, env: { ...process.env, DISPLAY: display },
      extraPrefsFirefox: { 'webgl.force-enabled': true, 'dom.w3c_touch_events.enabled': 1, 'app.update.enabled': false },
    });
    return new FirefoxLab(screen, browser, await serve());
  }

  async stop(): Promise<void> {
    await this.browser.close();
    this.served.close();
    this.screen.kill();
  }

  /** The studio, ready to be drawn in. */
  async open(): Promise<FirefoxPage> {
    const context = await this.browser.createBrowserContext();
    const page = await context.newPage();
    await page.setViewport(kWindow);
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error' && !message.text().includes('api/status')) errors.push(message.text());
    });
    await page.evaluateOnNewDocument(knowsTheHint);
    await page.goto(`${this.served.url}?antialias=off&motion=off&embeddings=off`);
    await page.waitForSelector('html[data-ready]', { timeout: 240000 });
    return { context, page, errors };
  }
}
