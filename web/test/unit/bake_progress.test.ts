import { describe, expect, it } from 'vitest';
import { BakeProgress } from '../../src/engine/bake_progress';
import { random } from './random';

describe('the progress of a bake', () => {
  it('only grows, whatever the stages report, and is in words', () => {
    const next = random(5);
    for (let round = 0; round < 50; round += 1) {
      const progress = new BakeProgress(() => 0);
      let before = 0;
      for (const stage of ['shell', 'samples', 'distances', 'mds', 'ls-mesh']) {
        for (let i = 0; i < 40; i += 1) {
          const { text, fraction } = progress.take(stage, next());
          expect(fraction).toBeGreaterThanOrEqual(before);
          expect(fraction).toBeLessThanOrEqual(1);
          expect(text).not.toMatch(/shell|mds|ls-mesh/);
          before = fraction;
        }
      }
      expect(before).toBeGreaterThan(0.5); // the last stage has begun
    }
  });

  it('goes on where a stage begins a new round', () => {
    const progress = new BakeProgress(() => 0);
    const first = progress.take('ls-mesh', 0.9).fraction;
    progress.take('ls-mesh', 0.1);
    expect(progress.take('ls-mesh', 0.8).fraction).toBeGreaterThan(first);
  });

  it('says how long is left when it can be told', () => {
    let now = 0;
    const progress = new BakeProgress(() => now);
    now = 500;
    expect(progress.take('shell', 0.5).text).not.toMatch(/left/);
    now = 33_000;
    // 0.33 of the whole in 33 s: 67 s are left.
    expect(progress.take('distances', 0.94).text).toMatch(/about a minute left/);
    now = 60_000;
    expect(progress.take('ls-mesh', 0.5).text).toMatch(/about 20 seconds left/);
  });
});
