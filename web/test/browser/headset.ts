import type { XRDevice } from 'iwer';
import type { Page } from 'playwright-core';

declare global {
  interface Window {
    headset: XRDevice;
    /** Does `step(i)` before each of `count` frames of the headset. */
    drive(count: number, step: (i: number) => void): Promise<void>;
  }
}

/** Before the page's code runs: a headset with two controllers (IWER), and `drive` to move them. */
export async function emulateHeadset(page: Page): Promise<void> {
  await page.addInitScript({ path: 'node_modules/iwer/build/iwer.min.js' });
  await page.addInitScript(() => {
    const { XRDevice: Device, metaQuest3 } = (window as unknown as { IWER: typeof import('iwer') }).IWER;
    const device = new Device(metaQuest3);
    device.installRuntime({ forceInstall: true });
    device.stereoEnabled = false;
    device.position.set(0, 1.2, 0);
    device.controllers.left!.position.set(-0.3, 1.1, -0.2);
    device.controllers.right!.position.set(0.1, 1.2, -0.2);
    window.headset = device;
    window.drive = (count, step) => new Promise((resolve) => {
      const { stage } = window.studio;
      const own = stage.onFrame;
      let i = 0;
      stage.onFrame = (dt, time, frame) => {
        const more = own(dt, time, frame);
        if (frame) {
          if (i < count) step(i);
          i += 1;
          if (i > count + 1) {
            stage.onFrame = own;
            resolve();
          }
        }
        return more;
      };
    });
  });
}
