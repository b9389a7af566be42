import { calling, check, made, takeBytes, textAt, type Module } from './module.js';
import { MimicryError } from './error.js';
import { givenBytes, givenList, givenNumbers, givenText } from './given.js';
import type { Bytes } from './types.js';
import { kFrameSize, kSimilaritySize } from './session.js';

/** A recorded stroke: what the devices did, on one target. */
export interface RecordedStroke {
  id: string;
  /** Name of the mesh that was drawn on. */
  target: string;
  /** `kSimilaritySize` numbers. */
  modelToWorld: Float64Array;
  /** `kFrameSize` numbers a frame. */
  frames: Float64Array;
}

export function readStrokes(m: Module, bytes: Uint8Array | ArrayBuffer, name: string, onLeftOut?: (what: string) => void): RecordedStroke[] {
  const content = givenBytes(bytes, "a file's content");
  const strokes = made(m, (args, out) => m._mimicry_strokes_read(args.put(content), content.length, args.put(givenText(name, "a file's name")), out));
  try {
    for (let i = 0; i < m._mimicry_strokes_left_out_count(strokes); i += 1) {
      const what = textAt(m, m._mimicry_strokes_left_out(strokes, i));
      if (!onLeftOut) throw new MimicryError('invalid_input', what);
      onLeftOut(what);
    }
    return Array.from({ length: m._mimicry_strokes_count(strokes) }, (_, i) =>
      calling(m, (args) => {
        const count = m._mimicry_strokes_frame_count(strokes, i);
        const placed = args.room(8 * kSimilaritySize);
        const frames = args.room(8 * kFrameSize * count);
        check(m, m._mimicry_strokes_placement(strokes, i, placed));
        check(m, m._mimicry_strokes_frames(strokes, i, frames));
        return {
          id: textAt(m, m._mimicry_strokes_id(strokes, i)),
          target: textAt(m, m._mimicry_strokes_target(strokes, i)),
          modelToWorld: m.HEAPF64.slice(placed >> 3, (placed >> 3) + kSimilaritySize),
          frames: m.HEAPF64.slice(frames >> 3, (frames >> 3) + kFrameSize * count),
        };
      }));
  } finally {
    m._mimicry_strokes_destroy(strokes);
  }
}

export function writeStrokes(m: Module, list: readonly RecordedStroke[]): Bytes {
  const strokes = made(m, (_, out) => m._mimicry_strokes_create(out));
  try {
    for (const s of givenList(list, 'the strokes')) {
      const frames = givenNumbers(s?.frames, "a stroke's frames", { per: kFrameSize });
      const placed = givenNumbers(s.modelToWorld, "a stroke's modelToWorld", { count: kSimilaritySize });
      calling(m, (args) =>
        check(m, m._mimicry_strokes_append(strokes, args.put(givenText(s.id, "a stroke's id")), args.put(givenText(s.target, "a stroke's target")),
          args.put(placed), args.put(frames), frames.length / kFrameSize)));
    }
    return takeBytes(m, made(m, (_, out) => m._mimicry_strokes_write(strokes, out)));
  } finally {
    m._mimicry_strokes_destroy(strokes);
  }
}
