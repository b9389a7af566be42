import type { MeshAttributes } from './attributes.js';
import { Curve } from './curve.js';
import { MimicryError } from './error.js';
import type { Pointer } from './exports.js';
import type { MeshReport } from './mesh.js';
import { codeOf, requireNoStep, type Factory, type Module } from './module.js';
import { ownTechniques, startCore, type OwnLayout, type OwnTechniques } from './own_technique.js';
import { Target } from './target.js';
import type { Bytes, CompiledModule } from './types.js';

/** A target with all that lies in the memory of its module; plain data for `postMessage`. */
export interface TargetImage {
  code: CompiledModule;
  /** The memory up to its last byte that is not 0; transfer its buffer. */
  memory: Bytes;
  /** Size of the whole memory, bytes. */
  memoryBytes: number;
  target: Pointer;
  curves: Pointer[];
  name: string;
  report: MeshReport;
  vertexCount: number;
  attributes: MeshAttributes;
  /** Techniques of JavaScript that the memory knows, by their numbers; their functions stay in their thread. */
  ownTechniques: readonly OwnLayout[];
}

export interface Received {
  target: Target;
  curves: Curve[];
}

/** Copied without a pause: a page goes on drawing in between. */
const kSlice = 8 << 20;

export function imageOf(m: Module, target: Target, curves: readonly Curve[]): TargetImage {
  requireNoStep(m, 'a target was handed over');
  return {
    code: codeOf(m), memory: m.HEAPU8.slice(0, usedBytes(m)), memoryBytes: m.HEAPU8.length,
    target: target.addressIn(m), curves: curves.map((curve) => curve.addressIn(m)), name: target.name, report: target.report, vertexCount: target.vertexCount, attributes: target.attributes,
    ownTechniques: [...ownTechniques(m).names],
  };
}

/**
 * A new instance of the same code with the same memory. At rest all that an instance knows lies in its memory: its
 * stack is empty, its table of functions is the code's.
 */
export async function receive(factory: Factory, image: TargetImage, own?: OwnTechniques): Promise<Received> {
  if (!(image?.memory instanceof Uint8Array)) throw new MimicryError('invalid_input', 'what was received is not what handOver() gave; send that with postMessage');
  const m = await startCore(factory, image.code);
  // The only way to let the memory grow that the glue takes notice of.
  if (m.HEAPU8.length < image.memoryBytes && m._malloc(image.memoryBytes) === 0) {
    throw new MimicryError('out_of_memory', `${image.name}: there is no memory left for ${image.memoryBytes} bytes; use a smaller model or close something else`);
  }
  for (let at = 0; at < image.memory.length; at += kSlice) {
    if (at > 0) await new Promise((resolve) => setTimeout(resolve));
    m.HEAPU8.set(image.memory.subarray(at, at + kSlice), at);
  }
  ownTechniques(m).adopt(image.ownTechniques ?? [], own);
  return {
    target: new Target(m, image.target, image.name, image.report, image.vertexCount, image.attributes),
    curves: image.curves.map((pointer) => new Curve(m, pointer)),
  };
}

function usedBytes(m: Module): number {
  let used = m.HEAPU32.length;
  while (used > 0 && m.HEAPU32[used - 1] === 0) used -= 1;
  return 4 * used;
}
