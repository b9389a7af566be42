import { kFrameSize, Mimicry, MimicryError, type Curve, type Ink, type MeshArrays, type MeshInput, type RecordedStroke, type Session, type Target, type TechniqueInfo } from 'mimicry';
import { bake, bakeHere, type BakeJobOptions } from 'mimicry/bake';
import * as compat from 'mimicry/compat';

export async function draw(wasm: ArrayBuffer, file: Uint8Array): Promise<Uint8Array> {
  const mimicry: Mimicry = await new Mimicry({ wasm }).ready;
  const mesh: MeshArrays = mimicry.readMesh(file, 'bunny.obj');
  const other: MeshInput = { positions: new Float32Array(9), faces: new Uint16Array([0, 1, 2]) };
  const target: Target = mimicry.createTarget(mesh, 'bunny', { join: true });
  mimicry.createTarget(other, 'triangle').dispose();
  mimicry.createTarget({ positions: other.positions }).dispose();
  const session: Session = target.session('mimicry-live', { options: { nozzle: [0, 0, -1] } });
  session.begin(new Float64Array(8));
  const status: number = session.add(new Float64Array(kFrameSize));
  const ink: Ink = session.ink;
  const curve: Curve = session.curve();
  const stroke: RecordedStroke = { id: String(status), target: 'bunny', modelToWorld: new Float64Array(8), frames: new Float64Array(ink.count) };
  const techniques: readonly TechniqueInfo[] = mimicry.techniques;
  const jobs: BakeJobOptions = { samples: techniques.length, onProgress: (stage: string, fraction: number) => void [stage, fraction] };
  const baked: Target = target.withEmbedding(await bake(mesh, jobs), 'bunny.mimicry');
  await bakeHere(other).catch((error: unknown) => {
    if (error instanceof MimicryError && error.status === 'cancelled') return;
    throw error;
  });
  const all: compat.Mimicry = new compat.Mimicry();
  all.dispose();
  mimicry.writeStrokes([stroke]);
  return baked.writeCurves([curve], 'glb');
}
