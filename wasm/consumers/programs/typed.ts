import { cornerValueAt, kFrameSize, Mimicry, MimicryError, type Curve, type Ink, type MeshArrays, type MeshAttributes, type MeshInput, type OwnTechnique, type RecordedStroke, type Session, type Target, type TechniqueInfo } from 'mimicry';
import { bake, bakeHere, type BakeJobOptions } from 'mimicry/bake';
import * as compat from 'mimicry/compat';

export async function draw(wasm: ArrayBuffer, file: Uint8Array): Promise<Uint8Array> {
  const mimicry: Mimicry = await new Mimicry({ wasm }).ready;
  const mesh: MeshArrays = mimicry.readMesh(file, 'bunny.obj');
  const other: MeshInput = { positions: new Float32Array(9), faces: new Uint16Array([0, 1, 2]) };
  const target: Target = mimicry.createTarget(mesh, 'bunny', { join: true });
  mimicry.createTarget(other, 'triangle').dispose();
  mimicry.createTarget({ positions: other.positions }).dispose();
  const attributes: MeshAttributes = target.attributes;
  mimicry.createTarget({ ...other, uvs: new Float32Array(6), colors: null, normals: new Float32Array(9), attributes }, 'painted').dispose();
  const own: OwnTechnique = {
    name: 'nearest',
    options: [{ kind: 'number', name: 'reach', default: 1, lowest: 0, highest: 2 }, { kind: 'choice', name: 'side', choices: ['front', 'back'], default: 'back' }],
    memory: 1,
    step(step) {
      const hit = step.target.closestPoint(step.frame[8]!, step.frame[9]!, step.frame[10]!, step.options[0]);
      if (hit && attributes.texcoords) cornerValueAt(attributes.texcoords, hit);
      return hit && step.found('closest', hit);
    },
  };
  mimicry.registerTechnique(own);
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
