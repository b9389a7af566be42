/** A 6-DoF sample as numbers in one array, the way the core takes it: world, metres, y up, right-handed. */
export const kFrameSize = 17;
export const kTime = 0;
/** x, y, z, then the quaternion x, y, z, w. */
export const kHead = 1;
/** The pen's tip; devices point along -z. */
export const kController = 8;
export const kTrigger = 15;
/** Below 0 where the device has none. */
export const kPressure = 16;

export function makeFrame(): Float64Array {
  const frame = new Float64Array(kFrameSize);
  frame[kHead + 6] = 1;
  frame[kController + 6] = 1;
  frame[kTrigger] = 1;
  frame[kPressure] = -1;
  return frame;
}

/** Frames one after the other; memory doubles, so that appending makes no garbage but rarely. */
export class FrameBuffer {
  private data = new Float64Array(1024 * kFrameSize);
  count = 0;

  clear(): void {
    this.count = 0;
  }

  append(frame: Float64Array): void {
    const at = this.count * kFrameSize;
    if (at + kFrameSize > this.data.length) {
      const larger = new Float64Array(this.data.length * 2);
      larger.set(this.data);
      this.data = larger;
    }
    this.data.set(frame, at);
    this.count += 1;
  }

  at(frame: number, word: number): number {
    return this.data[frame * kFrameSize + word]!;
  }

  /** A copy, `count` times 17 numbers. */
  take(): Float64Array {
    return this.data.slice(0, this.count * kFrameSize);
  }
}
