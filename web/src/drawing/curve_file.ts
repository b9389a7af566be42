import type { Curve, Target } from '../engine/core';

/** A curve without the stroke that it came from. */
export interface LooseCurve {
  curve: Curve;
  /** Where the model stood: rotation, translation, scale. */
  modelToWorld: Float64Array;
}

interface CurveFile {
  target?: { name?: unknown; vertices?: unknown; faces?: unknown };
  curves?: { model_to_world?: { rotation?: number[]; translation?: number[]; scale?: number } }[];
}

/**
 * The curves of a mimicry-curves file, one by one: those that cannot be read on the target are counted. onto: the mesh that they
 * are said to be on. Throws a sentence where it is no such file, or where it says that it is on the target and no curve can be read.
 */
export function readCurveFile(target: Target, content: Uint8Array, name: string): { curves: LooseCurve[]; onto: { name: string; vertices: number; faces: number }; leftOut: number } {
  let file: CurveFile;
  try {
    file = JSON.parse(new TextDecoder().decode(content)) as CurveFile;
  } catch {
    throw new Error(`${name}: the file is cut off or damaged; use another copy`);
  }
  const given = Array.isArray(file.curves) ? file.curves : [];
  const onto = { name: String(file.target?.name ?? 'another model'), vertices: Number(file.target?.vertices), faces: Number(file.target?.faces) };
  if (given.length === 0 || !Number.isInteger(onto.vertices) || !Number.isInteger(onto.faces)) throw new Error(`${name}: there are no curves in it; use another copy`);
  const curves: LooseCurve[] = [];
  for (const one of given) {
    try {
      const place = one.model_to_world ?? {};
      const modelToWorld = new Float64Array([...(place.rotation ?? [0, 0, 0, 1]), ...(place.translation ?? [0, 0, 0]), place.scale ?? 1]);
      const [curve] = target.readCurves(new TextEncoder().encode(JSON.stringify({ ...file, curves: [one] })), name);
      if (modelToWorld.length === 8 && modelToWorld.every(Number.isFinite) && modelToWorld[7]! > 0) curves.push({ curve: curve!, modelToWorld });
      else curve!.dispose();
    } catch {
      // Counted.
    }
  }
  return { curves, onto, leftOut: given.length - curves.length };
}
