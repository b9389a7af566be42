// node open_page.mjs CHROMIUM PAGE [PICTURE.png]: opens a report in Chromium without a network and prints as JSON what
// went wrong, what it asked for, and the plots that it drew.
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const [program, page, picture] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: program, args: ['--no-sandbox', '--disable-gpu'] });
try {
  const context = await browser.newContext({ offline: true, viewport: { width: 1280, height: 900 } });
  const tab = await context.newPage();
  const errors = [];
  const requests = [];
  tab.on('pageerror', (error) => errors.push(error.message));
  tab.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) errors.push(message.text());
  });
  tab.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url())) requests.push(request.url());
  });
  await tab.goto(pathToFileURL(page).href);
  await tab.waitForFunction(() => document.body.dataset.drawn !== undefined, undefined, { timeout: 300000 });
  const result = await tab.evaluate(() => ({
    drawn: document.body.dataset.drawn,
    plots: [...document.querySelectorAll('[data-figure]')].map((place) => ({
      id: place.dataset.figure,
      marks: place.querySelectorAll('svg path').length,
      width: place.getBoundingClientRect().width,
    })),
    pictures: [...document.images].map((image) => image.naturalWidth),
    overflow: document.documentElement.scrollWidth - window.innerWidth,
  }));
  const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('.save a')]);
  const saved = download.suggestedFilename();
  if (picture !== undefined) await tab.screenshot({ path: picture, fullPage: true });
  console.log(JSON.stringify({ ...result, saved, errors, requests }));
} finally {
  await browser.close();
}
