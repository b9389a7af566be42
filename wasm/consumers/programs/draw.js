import { kFrameSize, Mimicry } from 'mimicry';
import { bake } from 'mimicry/bake';

/**
 * What a program does with the package: it draws on a square, where the closest point of (x, y, z) is (x, y, 0); it bakes a
 * sphere, and draws on that.
 */
export async function draw(options = {}) {
  const mimicry = await new Mimicry(options.core).ready;
  const square = mimicry.createTarget({ positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], faces: [0, 1, 2, 0, 2, 3] }, 'square');
  const here = new Float64Array([0, 0, 0, 1, 0, 0, 0, 1]);
  const frames = new Float64Array(40 * kFrameSize);
  for (let i = 0; i < 40; i += 1) {
    const frame = frames.subarray(i * kFrameSize, (i + 1) * kFrameSize);
    frame[0] = i / 90;
    frame[7] = frame[14] = frame[15] = 1;
    // No sine: browsers differ in its last bits.
    frame.set([0.02 * i - 0.4, 0.001 * (i - 20) * (i - 20), 1.2], 8);
  }
  const flat = square.session('snap').project(here, frames);
  const mesh = mimicry.shape('sphere', 2);
  const stages = [];
  const bytes = await bake(mesh, { samples: 20, onProgress: (stage) => stages.push(stage), ...options.bake });
  const sphere = mimicry.createTarget(mesh, 'sphere').withEmbedding(bytes, 'sphere.mimicry');
  const round = sphere.session('mimicry').project(here, frames);
  const positions = (curve) => Array.from({ length: curve.pointCount }, (_, i) => curve.point(i).position);
  return { flat: positions(flat), bytes: bytes.length, stages: stages.length, round: positions(round) };
}
