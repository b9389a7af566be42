import { describe, expect, it } from 'vitest';
import { commit, kEmptyHistory, lastStroke, redo, undo, widthOfPressure, type DrawnCurve } from '../../src/drawing/document';
import { eraseCurve, erasePart } from '../../src/drawing/erase';
import { FrameBuffer, kFrameSize, makeFrame } from '../../src/drawing/frame';
import { joins, without } from '../../src/drawing/kept';
import { random } from './random';

/** A curve along x: frame i at x = i. */
function line(id: string, count: number, y = 0): DrawnCurve {
  const floats = new Float32Array(count * 8);
  const integers = new Int32Array(floats.buffer);
  for (let i = 0; i < count; i += 1) {
    floats.set([i, y, 0, 0, 1, 0], 8 * i);
    integers[8 * i + 6] = i;
    integers[8 * i + 7] = i === 0 ? 1 : 0;
  }
  const curve = { ink: { floats, integers, count } } as DrawnCurve['curve'];
  return {
    id, curve, mirror: null, style: { color: '#000000', radius_m: 0.001, offset_m: 0 }, kept: [[0, count - 1]],
    stroke: { id, target: 't', modelToWorld: new Float64Array(8), frames: new Float64Array(count * kFrameSize) },
  };
}

describe('kept ranges', () => {
  it('are what a list of booleans says', () => {
    const next = random(7);
    for (let i = 0; i < 200; i += 1) {
      const there = Array.from({ length: 20 }, () => true);
      let kept: readonly (readonly [number, number])[] = [[0, 19]];
      for (let step = 0; step < 4; step += 1) {
        const from = Math.floor(20 * next()), to = from + Math.floor(4 * next());
        kept = without(kept, (p) => p >= from && p <= to);
        for (let p = from; p <= Math.min(19, to); p += 1) there[p] = false;
      }
      for (let p = 0; p < 19; p += 1) expect(joins(kept, p)).toBe(there[p]! && there[p + 1]!);
    }
  });

  it('stay the same object where nothing goes', () => {
    const kept = [[0, 5]] as const;
    expect(without(kept, () => false)).toBe(kept);
  });
});

describe('erasing', () => {
  it('a part leaves the rest on both sides', () => {
    const drawing = [line('a', 11)];
    const left = erasePart(drawing, 5, 0, 0, 1.5);
    expect(left[0]!.kept).toEqual([[0, 3], [7, 10]]);
    expect(drawing[0]!.kept).toEqual([[0, 10]]);
    expect(erasePart(left, 5, 0, 0, 1.5)).toBe(left);
  });

  it('meets the straight ink between two points that are far apart', () => {
    expect(eraseCurve([line('a', 5)], 2.5, 0.1, 0, 0.2)).toEqual([]);
    expect(erasePart([line('a', 9)], 4.4, 0.1, 0, 0.2)[0]!.kept).toEqual([[0, 3], [5, 8]]);
    expect(erasePart([line('a', 9)], 4.6, 0.1, 0, 0.2)[0]!.kept).toEqual([[0, 4], [6, 8]]);
  });

  it('takes the other copies of a stroke where it is asked to, and those alone', () => {
    const drawing = [line('a', 11), line('a/x', 11, 50), line('b', 11, 60)];
    expect(erasePart(drawing, 5, 0, 0, 1.5, true).map((d) => d.kept)).toEqual([[[0, 3], [7, 10]], [[0, 3], [7, 10]], [[0, 10]]]);
    expect(erasePart(drawing, 5, 0, 0, 1.5).map((d) => d.kept)).toEqual([[[0, 3], [7, 10]], [[0, 10]], [[0, 10]]]);
    expect(eraseCurve(drawing, 5, 50, 0, 1, true).map((d) => d.id)).toEqual(['b']);
    expect(eraseCurve(drawing, 5, 50, 0, 1).map((d) => d.id)).toEqual(['a', 'b']);
  });

  it('everything of a curve takes it out', () => {
    expect(erasePart([line('a', 3)], 1, 0, 0, 5)).toEqual([]);
  });

  it('a curve takes the nearest within reach', () => {
    const drawing = [line('a', 5, 0), line('b', 5, 1)];
    expect(eraseCurve(drawing, 2, 0.8, 0, 0.5).map((d) => d.id)).toEqual(['a']);
    expect(eraseCurve(drawing, 2, 9, 0, 0.5)).toBe(drawing);
  });
});

describe('history', () => {
  it('undoes and redoes to the same drawings, and forgets the future when something new is done', () => {
    const one = [line('a', 2)], two = [...one, line('b', 2)];
    let history = commit(commit(kEmptyHistory, one, 'stroke'), two, 'stroke');
    history = undo(history);
    expect(history.drawing).toBe(one);
    expect(redo(history).drawing).toBe(two);
    history = undo(undo(undo(history)));
    expect(history.drawing).toEqual([]);
    history = commit(redo(history), [line('c', 2)], 'stroke');
    expect(history.future).toEqual([]);
    expect(redo(history)).toBe(history);
  });

  it('a commit of the same drawing is no step', () => {
    expect(commit(kEmptyHistory, kEmptyHistory.drawing, 'nothing')).toBe(kEmptyHistory);
  });

  it('the last stroke has its mirrored copies', () => {
    expect(lastStroke([line('a', 2), line('b', 2), line('b/x', 2)]).map((d) => d.id)).toEqual(['b', 'b/x']);
  });
});

describe('frames', () => {
  it('come back as they were put in, however many', () => {
    const buffer = new FrameBuffer(), frame = makeFrame();
    for (let i = 0; i < 3000; i += 1) {
      frame[0] = i;
      buffer.append(frame);
    }
    const all = buffer.take();
    expect(all.length).toBe(3000 * kFrameSize);
    for (let i = 0; i < 3000; i += 1) expect(all[i * kFrameSize]).toBe(i);
    expect(buffer.at(1234, 0)).toBe(1234);
  });

  it('without pressure have the plain width', () => {
    expect(widthOfPressure(-1)).toBe(1);
    expect(widthOfPressure(1)).toBeGreaterThan(widthOfPressure(0.2));
  });
});
