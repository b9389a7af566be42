import { existsSync, readFileSync } from 'node:fs';
import { Mimicry, type MeshArrays } from 'mimicry';
import { beforeAll, describe, expect, it } from 'vitest';
import { guessTurn, kAsIs, kZUp } from '../../src/engine/up_axis';
import { quarterTurned, standing } from '../../src/math/standing';
import { rotate } from '../../src/math/vec';
import { random, unitQuaternion } from './random';

let core: Mimicry;
beforeAll(async () => { core = await new Mimicry().ready; });

/** The same shape with z up: (x, y, z) to (x, -z, y). */
function laidBack({ positions, faces }: Pick<MeshArrays, 'positions' | 'faces'>, lowest?: number): Pick<MeshArrays, 'positions' | 'faces'> {
  const out = positions.slice();
  let low = Infinity;
  for (let v = 0; v < out.length; v += 3) {
    out[v + 1] = -positions[v + 2]!;
    out[v + 2] = positions[v + 1]!;
    low = Math.min(low, out[v + 2]!);
  }
  if (lowest !== undefined) for (let v = 2; v < out.length; v += 3) out[v] = out[v]! - low + lowest;
  return { positions: out, faces };
}

describe('the up axis', () => {
  it('of glTF is y, whatever the shape', () => {
    const hand = laidBack(core.shape('hand'));
    for (const name of ['a.glb', 'b.GLTF']) expect(guessTurn(hand, name)).toBe(kAsIs);
  });

  it('is that of the flat side that a thing stands on', () => {
    // A cylinder stands on its end: around y as it is made, around z when it is laid back.
    const cylinder = core.shape('cylinder');
    for (const name of ['a.stl', 'a.obj', 'a.ply', 'a.off']) {
      expect(guessTurn(cylinder, name)).toBe(kAsIs);
      expect(guessTurn(laidBack(cylinder), name)).toBe(kZUp);
    }
  });

  it('is that along which it begins at 0, where no side tells', () => {
    const sphere = core.shape('sphere'); // rests on a point
    const raised = { ...sphere, positions: sphere.positions.map((x, i) => (i % 3 === 1 ? x + 1 : x)) };
    expect(guessTurn(raised, 'a.stl')).toBe(kAsIs);
    expect(guessTurn(laidBack(sphere, 0), 'a.obj')).toBe(kZUp);
  });

  it('is the usual one of the format where the shape tells nothing', () => {
    const names = { 'a.stl': kZUp, 'a.obj': kAsIs, 'a.ply': kAsIs, 'a.off': kAsIs };
    for (const shape of ['sphere', 'cube', 'torus']) for (const [name, turn] of Object.entries(names)) expect(guessTurn(core.shape(shape), name), shape).toBe(turn);
  });

  const kModels = '/usr/share/assimp/models';
  it.skipIf(!existsSync(kModels)).each([
    ['OBJ/spider.obj', 'y'], ['STL/Spider_binary.stl', 'z'], ['STL/Wuson.stl', 'y'], ['PLY/Wuson.ply', 'y'], ['OFF/Wuson.off', 'y'], ['OBJ/WusonOBJ.obj', 'y'],
  ])('of a file that another program wrote: %s has %s up', (file, up) => {
    const name = `${kModels}/${file}`;
    expect(guessTurn(core.readMesh(readFileSync(name), name), name)).toBe(up === 'z' ? kZUp : kAsIs);
  });

  const kStudy = '../../shared/data/study';
  it.skipIf(!existsSync(kStudy)).each([['bunny', 'z'], ['hand', 'y'], ['fertility', 'y'], ['cube', 'y'], ['trebol', 'y']])('of a scan: %s has %s up', (shape, up) => {
    const name = `${kStudy}/${shape}.obj`;
    expect(guessTurn(core.readMesh(readFileSync(name), name), name)).toBe(up === 'z' ? kZUp : kAsIs);
  });
});

describe('a model that is turned', () => {
  it('keeps the middle of its box in place', () => {
    const seed = 12, next = random(seed);
    for (let i = 0; i < 100; i += 1) {
      const centre = [next() - 0.5, next() - 0.5, next() - 0.5], where = [next(), next(), next()], scale = 0.1 + next();
      const place = standing(centre, where, unitQuaternion(next), scale), at = [...centre];
      rotate(at, 0, place, 0, at, 0);
      for (let k = 0; k < 3; k += 1) expect(scale * at[k]! + place[4 + k]!, `seed ${seed}, ${i}`).toBeCloseTo(where[k]!, 12);
    }
  });

  it('has z up after three quarters, and is back after four', () => {
    let turn: readonly number[] = kAsIs;
    for (let i = 1; i <= 4; i += 1) {
      turn = quarterTurned(turn, 'x');
      const z = [0, 0, 1];
      rotate(z, 0, [...turn], 0, z, 0);
      expect(z[1]).toBeCloseTo([0, -1, 0, 1, 0][i]!, 12);
    }
  });
});
