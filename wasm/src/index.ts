import { kCoreBuild } from './builds.js';
import { coreWasm } from './core_files.js';
import factory from './core.js';
import type { Curve } from './curve.js';
import { MimicryError } from './error.js';
import { givenBytes, givenCount, givenText } from './given.js';
import { imageOf, receive, type Received, type TargetImage } from './hand_over.js';
import { compiled } from './load.js';
import { meshArrays, meshReport, putFiles, shapeList, withMesh, type MeshArrays, type MeshFile, type MeshInput, type MeshReport, type ShapeInfo } from './mesh.js';
import { codeOf, type Module } from './module.js';
import { ownTechniques, startCore, type OwnTechnique } from './own_technique.js';
import { readStrokes, writeStrokes, type RecordedStroke } from './strokes.js';
import { Target, type TargetOptions } from './target.js';
import { techniqueList, type TechniqueInfo } from './technique.js';
import type { Bytes, CompiledModule, WasmSource } from './types.js';

export { Curve, type CurvePoint, type TubeArrays } from './curve.js';
export { cornerValueAt, perCorner, type CornerValues, type FaceLabels, type MeshAttributes, type VertexValues } from './attributes.js';
export type { Received, TargetImage } from './hand_over.js';
export { kInkFrame, kInkNormal, kInkPosition, kInkStarts, kInkStride, type Ink } from './ink.js';
export { MimicryError, type Status } from './error.js';
export type { MeshArrays, MeshFile, MeshInput, MeshReport, ShapeInfo } from './mesh.js';
export { kFrameSize, kInked, kMissed, kRejected, kSimilaritySize, kStill, type OptionValue, Session, type SessionOptions } from './session.js';
export type { Answer, OwnOption, OwnTechnique, StepTarget, TechniqueStep } from './own_technique.js';
export type { SurfaceHit } from './queries.js';
export { Geodesics, type SurfacePath } from './geodesics.js';
export type { SurfacePlaces, SurfacePoints } from './surface_points.js';
export type { RecordedStroke } from './strokes.js';
export { Target, type CurveFormat, type TargetOptions } from './target.js';
export type { OptionKind, TechniqueInfo, TechniqueOption } from './technique.js';
export type { Bytes, Doubles, Floats, Integers, WasmSource } from './types.js';

export interface MimicryOptions {
  /** The core's WebAssembly file; the package's own where nothing is given. */
  wasm?: WasmSource;
}

/**
 * The core. `await mimicry.ready` before anything else. Targets, sessions and curves lie in the core's
 * memory: give each back with `dispose()`, in any order.
 *
 * All methods throw `MimicryError`, whose message is a sentence for people.
 */
export class Mimicry {
  /** Fulfilled when the core can be used; rejected where it cannot be loaded. */
  readonly ready: Promise<this>;
  private module: Module | undefined;
  private disposed = false;
  private lists: { techniques: readonly TechniqueInfo[]; shapes: readonly ShapeInfo[] } | undefined;

  constructor(options: MimicryOptions = {}) {
    this.ready = compiled(options.wasm ?? coreWasm(), { name: 'core.wasm', build: kCoreBuild }).then((code) => startCore(factory, code)).then((m) => {
      if (!this.disposed) this.module = m;
      return this;
    });
  }

  private get m(): Module {
    if (this.module) return this.module;
    throw new MimicryError('disposed', this.disposed ? 'mimicry was used after dispose()' : 'mimicry is not loaded yet; await mimicry.ready first');
  }

  private get listed() {
    this.lists ??= { techniques: techniqueList(this.m), shapes: shapeList(this.m) };
    return this.lists;
  }

  get techniques(): readonly TechniqueInfo[] { return this.listed.techniques; }
  get shapes(): readonly ShapeInfo[] { return this.listed.shapes; }

  /**
   * A technique of your own: its name is a technique's like the others from now on, in `techniques`, in sessions and in files of
   * this `Mimicry`, until its `dispose()`; of received targets too where `receive` was given
   * this `Mimicry`. At most 200.
   */
  registerTechnique(technique: OwnTechnique): void {
    ownTechniques(this.m).register(technique);
    this.lists = undefined;
  }

  /** A built-in shape; resolution 0 for its default. */
  shape(name: string, resolution = 0): MeshArrays {
    const m = this.m;
    return meshArrays(m, (args, out) =>
      m._mimicry_mesh_shape(args.put(givenText(name, "a shape's name")), givenCount(resolution, "a shape's resolution"), out));
  }

  /** A file's content; the name's ending tells the format (.obj .ply .stl .off .glb .gltf). */
  readMesh(bytes: Uint8Array | ArrayBuffer, name: string): MeshArrays {
    const m = this.m;
    const content = givenBytes(bytes, "a file's content");
    return meshArrays(m, (args, out) => m._mimicry_mesh_read(args.put(content), content.length, args.put(givenText(name, "a file's name")), out));
  }

  /**
   * A mesh with the files that it names beside it: a glTF and its buffers. Others (textures) may be among
   * them. mesh: its name among the files, where more than one is a mesh.
   */
  readMeshFiles(files: readonly MeshFile[], mesh?: string): MeshArrays {
    const m = this.m;
    return meshArrays(m, (args, out) =>
      m._mimicry_mesh_read_files(putFiles(m, args, files), files.length, mesh === undefined ? 0 : args.put(givenText(mesh, "the mesh's name")), out));
  }

  /** What a mesh is and what is odd about it. */
  validate(mesh: MeshInput): MeshReport {
    return withMesh(this.m, mesh, '', (pointer) => meshReport(this.m, pointer));
  }

  /** name: stands in messages and in files. */
  createTarget(mesh: MeshInput, name = 'mesh', options: TargetOptions = {}): Target {
    return Target.create(this.m, mesh, givenText(name, "a target's name"), options);
  }

  /**
   * A target, and curves on it, for another thread: whole, so that taking it costs no more than copying. Transfer
   * `memory.buffer` with it, and dispose of this `Mimicry`, which should hold nothing else.
   */
  handOver(target: Target, curves: readonly Curve[] = []): TargetImage {
    return imageOf(this.m, target, curves);
  }

  /**
   * What another thread hands over, in a memory of its own that goes when nothing of it is used any more. Blocks for some milliseconds
   * at a time. here: whose own techniques can be used on the target.
   */
  static async receive(image: TargetImage, here?: Mimicry): Promise<Received> {
    return receive(factory, image, here && ownTechniques(here.m));
  }

  /** The compiled code: another `Mimicry`, in a worker too, takes it as its `wasm` and starts at once. */
  get code(): CompiledModule { return codeOf(this.m); }

  /**
   * The strokes of a mimicry-strokes file. One that cannot be used is left out, and onLeftOut is told where it stood and what is wrong
   * with it; without onLeftOut it refuses the file.
   */
  readStrokes(bytes: Uint8Array | ArrayBuffer, name: string, onLeftOut?: (what: string) => void): RecordedStroke[] {
    return readStrokes(this.m, bytes, name, onLeftOut);
  }
  writeStrokes(strokes: readonly RecordedStroke[]): Bytes { return writeStrokes(this.m, strokes); }

  /** The core's memory in use, bytes. */
  get memoryBytes(): number { return this.m.HEAPU8.length; }

  /** Lets go of the core and of all memory; nothing that came from it may be used afterwards. */
  dispose(): void {
    this.disposed = true;
    this.module = undefined;
    this.lists = undefined;
  }
}
