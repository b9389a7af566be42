import type { Pointer } from './exports.js';
import type { Module } from './module.js';

/** 4-byte words of an ink vertex. */
export const kInkStride = 8;
export const kInkPosition = 0;
export const kInkNormal = 3;
export const kInkFrame = 6;
export const kInkStarts = 7;

/**
 * What is drawn: a curve's points and every edge that it crosses, in order, `kInkStride` words each over
 * the same memory: `floats` has position (3, model) and normal (3, unit), `integers` the number of the
 * stroke's frame that the piece leads to, and 1 where it is not joined to the vertex before.
 */
export interface Ink {
  readonly floats: Float32Array;
  readonly integers: Int32Array;
  readonly count: number;
}

/** The module's own memory: new arrays only after it has moved or grown. */
export class InkView implements Ink {
  floats: Float32Array = new Float32Array(0);
  integers: Int32Array = new Int32Array(0);
  count = 0;
  private at: Pointer = 0;

  look(m: Module, at: Pointer, count: number): this {
    this.count = count;
    if (at !== this.at || this.floats.buffer !== m.HEAPF32.buffer) {
      this.at = at;
      this.floats = new Float32Array(m.HEAPF32.buffer, at);
      this.integers = new Int32Array(m.HEAPF32.buffer, at);
    }
    return this;
  }
}

/** A copy of its own. */
export function copiedInk(m: Module, at: Pointer, count: number): Ink {
  const floats = m.HEAPF32.slice(at >> 2, (at >> 2) + kInkStride * count);
  return { floats, integers: new Int32Array(floats.buffer), count };
}
