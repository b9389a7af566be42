import { toModel, toWorld } from '../math/similarity';
import { conjugate, multiply } from '../math/vec';
import { kController, kHead } from './frame';

const turn = new Float64Array(4);

/** Turns a frame that was taken with the model at `from` into the same one seen from a model at `to`. In place. */
export function carryFrame(frame: Float64Array, from: Float64Array, to: Float64Array): void {
  conjugate(turn, 0, from, 0);
  multiply(turn, 0, to, 0, turn, 0);
  for (let at = kHead; at <= kController; at += kController - kHead) {
    toModel(frame, at, from, frame, at);
    toWorld(frame, at, to, frame, at);
    multiply(frame, at + 3, turn, 0, frame, at + 3);
  }
}
