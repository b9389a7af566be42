import { Curve } from './curve.js';
import type { Pointer } from './exports.js';
import { InkView, type Ink } from './ink.js';
import { MimicryError } from './error.js';
import { givenNumbers, givenText } from './given.js';
import { calling, check, Handle, made, requireNoStep, takeFailure, type Module } from './module.js';

/**
 * Numbers of a frame: time in seconds, head position (3) and orientation (4: x, y, z, w), controller
 * position (3, the pen's tip) and orientation (4), trigger (0 to 1), pressure (0 to 1, below 0 for none).
 * World: right-handed, y up, metres; devices point along their -z axis.
 */
export const kFrameSize = 17;
/** Numbers of a similarity: rotation (4: x, y, z, w), translation (3), scale. */
export const kSimilaritySize = 8;

/** What became of a frame. */
export const kInked = 0;
export const kMissed = 1;
export const kStill = 2;
export const kRejected = 3;

/** Of an option (`TechniqueOption`): a boolean may be true or false; a choice is the number of its value. */
export type OptionValue = number | boolean | ArrayLike<number>;

export interface SessionOptions {
  /** The technique's options by name. */
  options?: Readonly<Record<string, OptionValue>>;
  /** A frame without a point breaks the curve; otherwise it is bridged, as in the paper. */
  splitAtMisses?: boolean;
  /** Frames whose pen moved less are passed over. */
  minimumMotion_m?: number;
}

/** Draws strokes on one target with one technique. Keeps its target alive. */
export class Session extends Handle {
  private readonly view = new InkView();
  private readonly room: Pointer; // a frame, then its status

  constructor(m: Module, pointer: Pointer, readonly technique: string, options: SessionOptions) {
    super(m, pointer, 'session');
    this.room = m._malloc(8 * kFrameSize + 8);
    try {
      for (const [name, value] of Object.entries(options.options ?? {})) this.setOption(name, value);
      if (options.splitAtMisses !== undefined) this.setSplitAtMisses(options.splitAtMisses);
      if (options.minimumMotion_m !== undefined) this.setMinimumMotion(options.minimumMotion_m);
    } catch (error) {
      this.dispose();
      throw error;
    }
  }

  /** @internal */
  override get at(): Pointer {
    requireNoStep(this.m, 'a session was used');
    return super.at;
  }

  /** What a technique of JavaScript threw comes before what the code says. */
  private settle(status: number): void {
    const failure = takeFailure(this.m);
    if (failure) throw failure;
    check(this.m, status);
  }

  protected override destroy(pointer: Pointer): void {
    this.m._free(this.room);
    this.m._mimicry_session_destroy(pointer);
  }

  /** From the next stroke on, as all settings. */
  setOption(name: string, values: OptionValue): void {
    const numbers = givenNumbers(typeof values === 'number' || typeof values === 'boolean' ? [Number(values)] : values, `option '${name}'`);
    calling(this.m, (args) =>
      check(this.m, this.m._mimicry_session_set_option(this.at, args.put(givenText(name, "an option's name")), args.put(numbers), numbers.length)));
  }
  setSplitAtMisses(split: boolean): void {
    check(this.m, this.m._mimicry_session_set_split_at_misses(this.at, split ? 1 : 0));
  }
  setMinimumMotion(metres: number): void {
    check(this.m, this.m._mimicry_session_set_minimum_motion(this.at, metres));
  }

  /** Starts a stroke; the last one's ink is forgotten. modelToWorld: `kSimilaritySize` numbers. */
  begin(modelToWorld: ArrayLike<number>): void {
    const placed = givenNumbers(modelToWorld, 'modelToWorld', { count: kSimilaritySize });
    calling(this.m, (args) => check(this.m, this.m._mimicry_session_begin(this.at, args.put(placed))));
  }

  /** frame: `kFrameSize` numbers. Makes no objects. What became of it: `kInked` and so on. */
  add(frame: ArrayLike<number>): number {
    if (frame?.length !== kFrameSize) throw new MimicryError('invalid_input', `a frame must be ${kFrameSize} numbers, not ${frame?.length}`);
    const { at } = this;
    this.m.HEAPF64.set(frame, this.room >> 3);
    const status = this.room + 8 * kFrameSize;
    this.settle(this.m._mimicry_session_add(at, this.room, status));
    return this.m.HEAP32[status >> 2]!;
  }

  end(): void {
    this.settle(this.m._mimicry_session_end(this.at));
  }

  /** All ink of the stroke so far; new ink comes at its end. Always the same object; its arrays are valid until the next call of anything here. */
  get ink(): Ink {
    return this.view.look(this.m, this.m._mimicry_session_ink(this.at), this.m._mimicry_session_ink_count(this.at));
  }

  /** The curve so far, copied. */
  curve(): Curve {
    return new Curve(this.m, made(this.m, (_, out) => this.m._mimicry_session_curve(this.at, out)));
  }

  /** A whole recorded stroke at once; frames that cannot be used are an error here. frames: `kFrameSize` numbers each. */
  project(modelToWorld: ArrayLike<number>, frames: ArrayLike<number>): Curve {
    const placed = givenNumbers(modelToWorld, 'modelToWorld', { count: kSimilaritySize });
    const numbers = givenNumbers(frames, 'frames', { per: kFrameSize });
    return new Curve(this.m, made(this.m, (args, out) => {
      const status = this.m._mimicry_session_project(this.at, args.put(placed), args.put(numbers), numbers.length / kFrameSize, out);
      const failure = takeFailure(this.m);
      if (failure) {
        this.m._mimicry_curve_destroy(this.m.HEAPU32[out >> 2]!);
        throw failure;
      }
      return status;
    }));
  }
}
