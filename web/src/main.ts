import { Mimicry } from 'mimicry';
import { App } from './app/app';
import { keepOffline } from './offline/register';
import { NoGraphics, Stage } from './scene/stage';

const root = document.getElementById('studio')!;
const options = new URLSearchParams(location.search);

async function main(): Promise<void> {
  const loading = document.createElement('div');
  loading.id = 'loading';
  loading.textContent = 'Loading…';
  const holder = document.createElement('main');
  holder.id = 'stage';
  const canvas = document.createElement('canvas');
  canvas.tabIndex = 0;
  canvas.setAttribute('role', 'application');
  canvas.setAttribute('aria-label', 'The model. Arrow keys turn it; Enter puts the pen down in the middle, arrow keys draw, Enter lifts it. Press ? for all keys.');
  holder.append(canvas);
  root.append(holder, loading);
  try {
    // The graphics driver starts while the core is fetched and compiled.
    const core = new Mimicry().ready;
    core.catch(() => undefined);
    const stage = new Stage(canvas, options.get('antialias') !== 'off');
    if (options.get('motion') === 'off' || matchMedia('(prefers-reduced-motion: reduce)').matches) stage.rig.instant = true;
    const app = new App(await core, root, canvas, stage, options.get('embeddings') !== 'off');
    await app.start();
    // For tests and the curious.
    Object.assign(window, { studio: app });
    document.documentElement.dataset['ready'] = 'true';
    void keepOffline(() => app.ui.messages.offer('A newer studio is there.', { title: 'Reload', act: () => location.reload() }));
  } catch (error) {
    const sentence = error instanceof NoGraphics ? error.message
      : `The studio could not start: ${error instanceof Error ? error.message : String(error)}. Reload the page; if that does not help, use a current browser.`;
    const fatal = document.createElement('div');
    fatal.className = 'fatal';
    fatal.setAttribute('role', 'alert');
    fatal.append(Object.assign(document.createElement('p'), { textContent: sentence }));
    root.append(fatal);
  } finally {
    loading.remove();
  }
}

void main();
