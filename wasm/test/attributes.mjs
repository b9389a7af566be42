// What meshes carry beside their geometry.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cornerValueAt, Mimicry, MimicryError, perCorner } from 'mimicry';

const mimicry = await new Mimicry().ready;
const bytesOf = (text) => new TextEncoder().encode(text);
// A square of two triangles with a seam along the diagonal.
const square = `mtllib a.mtl
o plate
v 0 0 0 1 0 0
v 1 0 0 1 0 0
v 1 1 0 1 0 0
v 0 1 0 1 0 0
vt 0 0
vt 1 0
vt 1 1
vt 0.5 0.5
vt 0.75 0.75
vt 0.5 0.75
g lower
usemtl wood
f 1/1 2/2 3/3
g upper
usemtl stone
f 1/4 3/5 4/6
`;

test('of a file come per corner and per face', () => {
  const mesh = mimicry.readMesh(bytesOf(square), 'square.obj');
  assert.equal(mesh.positions.length, 12, 'the seam splits no vertex');
  const { texcoords, colors, groups, materials, objects } = mesh.attributes;
  assert.equal(texcoords.itemSize, 2);
  assert.deepEqual([...perCorner(texcoords)], [0, 0, 1, 0, 1, 1, 0.5, 0.5, 0.75, 0.75, 0.5, 0.75]);
  assert.deepEqual([...perCorner(colors)].slice(0, 4), [1, 0, 0, 1]);
  const named = ({ names, faces }) => [...faces].map((n) => names[n]);
  assert.deepEqual([groups, materials, objects].map(named), [['lower', 'upper'], ['wood', 'stone'], ['plate', 'plate']]);
  assert.equal(mimicry.readMesh(bytesOf('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'), 'bare.obj').attributes, undefined);
  const target = mimicry.createTarget(mesh, 'square');
  assert.deepEqual(target.attributes, mesh.attributes);
  // On either side of the seam.
  const uv = new Float32Array(2);
  assert.equal(cornerValueAt(target.attributes.texcoords, target.closestPoint(0.75, 0.25, 1), uv), uv);
  assert.deepEqual([...uv], [0.75, 0.25]);
  assert.deepEqual([...cornerValueAt(target.attributes.texcoords, target.closestPoint(0, 1, 1))], [0.5, 0.75]);
  assert.deepEqual([...perCorner({ values: mesh.positions, itemSize: 3, corners: mesh.faces })].slice(9, 18), [0, 0, 0, 1, 1, 0, 0, 1, 0]);
});

test('of an engine, whose vertices are doubled at seams', () => {
  const positions = new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0]);
  const target = mimicry.createTarget({
    positions, faces: new Uint16Array([0, 1, 2, 3, 4, 5]), normals: new Float32Array(18), uvs: new Float32Array([0, 0, 1, 0, 1, 1, 0.5, 0.5, 0.75, 0.75, 0.5, 0.75]),
    colors: new Uint8Array(18).fill(51),
  }, 'square');
  assert.equal(target.report.components, 1, 'its surface is whole');
  assert.equal(new Set(target.surfaceVertices()).size, 4);
  const { texcoords, colors } = target.attributes;
  assert.deepEqual([...cornerValueAt(texcoords, target.closestPoint(0.75, 0.25, 1))], [0.75, 0.25]);
  assert.deepEqual([...cornerValueAt(texcoords, target.closestPoint(0, 1, 1))], [0.5, 0.75]);
  assert.deepEqual([...colors.values.slice(0, 4)], [...Float32Array.of(0.2, 0.2, 0.2, 1)]);
  // Without an index, and with alpha.
  const loose = mimicry.createTarget({ positions: positions.slice(0, 9), colors: new Float32Array(12).fill(0.5) }, 'loose');
  assert.deepEqual([...loose.attributes.colors.values], new Array(12).fill(0.5));
  assert.deepEqual(mimicry.createTarget({ positions: positions.slice(0, 9) }, 'bare').attributes, {});
});

test('corners without a value', () => {
  const corners = { values: Float32Array.of(1, 2), itemSize: 2, corners: Int32Array.of(0, -1, 0) };
  assert.deepEqual([...perCorner(corners)], [1, 2, NaN, NaN, 1, 2]);
  assert.deepEqual([...cornerValueAt(corners, { face: 0, barycentric: [1, 0, 0] })], [NaN, NaN]);
  assert.deepEqual([...cornerValueAt(corners, { face: 9, barycentric: [1, 0, 0] })], [NaN, NaN]);
});

test('go along with a target that is handed over', async () => {
  const worker = await new Mimicry({ wasm: mimicry.code }).ready;
  const mesh = worker.readMesh(bytesOf(square), 'square.obj');
  const image = structuredClone({ ...worker.handOver(worker.createTarget(mesh, 'square')), code: null });
  const { target } = await Mimicry.receive({ ...image, code: mimicry.code });
  assert.deepEqual(target.attributes, mesh.attributes);
});

test('that do not fit are refused by name', () => {
  const positions = new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0]);
  const texcoords = (given) => ({ attributes: { texcoords: { values: new Float32Array(6), itemSize: 2, corners: Int32Array.of(0, 1, 2), ...given } } });
  for (const [part, words] of [
    [{ uvs: [0, 0] }, /uvs of a mesh's vertices must be 6 numbers, not 2/],
    [{ colors: new Float32Array(10) }, /colors of a mesh's vertices must be 12 numbers, not 10/],
    [{ normals: [1] }, /normals of a mesh's vertices must be 9 numbers/],
    [texcoords({ itemSize: 3 }), /texcoords: itemSize must be 2, not 3/],
    [texcoords({ values: [0, 0] }), /texcoords: values must be a Float32Array/],
    [texcoords({ corners: Int32Array.of(0, 1) }), /texcoords: must be an Int32Array with a number for each corner \(3\), not 2/],
    [texcoords({ corners: Int32Array.of(0, 3, 1) }), /texcoords: corner 1 has number 3 of 3 values/],
    [{ attributes: { groups: { names: ['a'], faces: Int32Array.of(-2) } } }, /groups: face 0 has number -2 of 1 names/],
    [{ attributes: { materials: { names: 'a', faces: Int32Array.of(0) } } }, /names of a mesh's materials must be an array/],
  ])
    assert.throws(() => mimicry.createTarget({ positions, ...part }, 'odd'), (e) => {
      assert.ok(e instanceof MimicryError && e.status === 'invalid_input', `${e}`);
      assert.match(e.message, words);
      return true;
    });
});
