// The facade, as it is installed.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { kFrameSize, kInked, kInkStride, kRejected, Mimicry, MimicryError } from 'mimicry';
import { bake, bakeHere } from 'mimicry/bake';

const mimicry = new Mimicry();
assert.throws(() => mimicry.shape('sphere'), /await mimicry\.ready/);
assert.equal(await mimicry.ready, mimicry);
const here = new Float64Array([0, 0, 0, 1, 0, 0, 0, 1]);

function frames(count) {
  const all = new Float64Array(count * kFrameSize);
  for (let i = 0; i < count; i += 1) {
    const frame = all.subarray(i * kFrameSize, (i + 1) * kFrameSize);
    frame[0] = i / 90;
    frame[7] = frame[14] = 1;
    frame.set([0.004 * i - 0.2, 0.1 * Math.sin(0.1 * i), 1.2], 8);
    frame[15] = 1;
    frame[16] = -1;
  }
  return all;
}

const bytesOf = (text) => new TextEncoder().encode(text);
const textOf = (bytes) => new TextDecoder().decode(bytes);

test('lists techniques and shapes', () => {
  const live = mimicry.techniques.find((t) => t.name === 'mimicry-live');
  assert.equal(live.needsBake, false);
  assert.equal(live.anchored, true);
  assert.ok(live.description.length > 10);
  const nozzle = live.options.find((o) => o.name === 'nozzle');
  assert.deepEqual(nozzle.defaults.map((x) => x + 0), [0, 0, -1]);
  assert.deepEqual([nozzle.kind, nozzle.choices], ['direction', []]);
  assert.deepEqual([live.title, live.color, live.steering, live.rank], ['Mimicry live', '#009e73', 'moved', 0]);
  assert.ok(live.sentence.startsWith('Follows your hand'));
  assert.equal(live.options.find((o) => o.name === 'soft-anchor').kind, 'boolean');
  assert.deepEqual(mimicry.techniques.filter((t) => t.steering === 'aimed').map((t) => t.name), ['spraycan']);
  assert.ok(mimicry.techniques.find((t) => t.name === 'mimicry-planar').screenNote.includes('hand'));
  assert.ok(nozzle.lowest < nozzle.highest);
  assert.ok(mimicry.shapes.some((s) => s.name === 'hand' && s.mostResolution > s.leastResolution));
});

test('finds many points, distances and paths', () => {
  const target = mimicry.createTarget(mimicry.shape('sphere', 12), 'sphere');
  const points = target.closestPoints([0, 0, 2, 2, 0, 0, 0, NaN, 0]);
  assert.deepEqual([...points.faces].map((f) => f >= 0), [true, true, false]);
  assert.ok(Math.abs(points.positions[2] - 1) < 0.02 && Math.abs(points.distances[0] - 1) < 0.02);
  const one = target.closestPoint(2, 0, 0);
  assert.deepEqual([...points.positions.slice(3, 6)], [...one.position]);
  const hits = target.firstHits([0, 0, 5, 5, 5, 5], [0, 0, -1, 0, 0, 1]);
  assert.ok(hits.faces[0] >= 0 && hits.faces[1] === -1);
  const sources = { faces: points.faces.subarray(0, 1), barycentrics: points.barycentrics.subarray(0, 3) };
  const geodesics = target.geodesics(sources);
  assert.equal(geodesics.areExact, true);
  const [quarter] = geodesics.distances({ faces: points.faces.subarray(1, 2), barycentrics: points.barycentrics.subarray(3, 6) });
  assert.ok(Math.abs(quarter - Math.PI / 2) < 0.02);
  assert.equal(geodesics.vertexDistances().length, target.vertexCount);
  const path = geodesics.path(points.faces[1], points.barycentrics.subarray(3, 6));
  assert.ok(Math.abs(path.length - quarter) < 1e-9 && path.source === 0 && path.positions.length > 12);
  assert.throws(() => geodesics.distances({ faces: [1e6], barycentrics: [1, 0, 0] }), /point 0/);
  assert.throws(() => target.geodesics({ faces: [0.5], barycentrics: [1, 0, 0] }), /whole numbers/);
  assert.throws(() => target.smoothClosestPoints([0, 0, 1]), /bake/);
  target.updatePositions(Float64Array.from(mimicry.shape('sphere', 12).positions, (x) => 2 * x));
  assert.ok(Math.abs(target.closestPoint(0, 0, 5).position[2] - 2) < 0.04);
  assert.throws(() => geodesics.vertexDistances(), /moved/);
  for (const used of [geodesics, target]) used.dispose();
});

test('reads meshes and says what they are', () => {
  const mesh = mimicry.readMesh(bytesOf('v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n'), 'corner.obj');
  assert.deepEqual([...mesh.positions], [0, 0, 0, 1, 0, 0, 0, 2, 0]);
  assert.deepEqual([...mesh.faces], [0, 1, 2]);
  const report = mimicry.validate(mesh);
  assert.equal(report.area, 1);
  assert.deepEqual(report.boxMax, [1, 2, 0]);
  assert.deepEqual([report.faces, report.boundaryLoops, report.manifold, report.closed], [1, 1, true, false]);
  assert.ok(Number.isNaN(report.volume));
});

test('reads a glTF with the file of its buffer', () => {
  const gltf = JSON.stringify({
    asset: { version: '2.0' },
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ bufferView: 0, count: 3, componentType: 5126, type: 'VEC3' }],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    buffers: [{ uri: 'data/corner%201.bin', byteLength: 36 }],
    images: [{ uri: 'wood.png' }],
  });
  const bin = { name: 'corner 1.bin', bytes: new Uint8Array(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer) };
  const wood = { name: 'wood.png', bytes: bytesOf('not looked at') };
  const mesh = mimicry.readMeshFiles([wood, bin, { name: 'corner.gltf', bytes: bytesOf(gltf) }]);
  assert.deepEqual([...mesh.positions], [0, 0, 0, 1, 0, 0, 0, 1, 0]);
  assert.throws(() => mimicry.readMesh(bytesOf(gltf), 'corner.gltf'), (e) => e.status === 'io' && /corner\.gltf.*corner 1\.bin/.test(e.message));
  assert.throws(() => mimicry.readMeshFiles([wood, bin]), /no mesh among the files/);
  const two = [bin, { name: 'a.gltf', bytes: bytesOf(gltf) }, { name: 'b.gltf', bytes: bytesOf(gltf) }];
  assert.throws(() => mimicry.readMeshFiles(two), /a\.gltf and b\.gltf/);
  assert.equal(mimicry.readMeshFiles(two, 'b.gltf').faces.length, 3);
});

test('errors are sentences with a status', () => {
  for (const [call, status, words] of [
    [() => mimicry.readMesh(bytesOf('hello'), 'notes.txt'), 'unsupported', /notes\.txt/],
    [() => mimicry.readMesh(bytesOf('v 0 0 x'), 'bad.obj'), 'invalid_input', /bad\.obj.*1/],
    [() => mimicry.shape('teapot'), 'invalid_input', /sphere/],
    [() => mimicry.createTarget({ positions: new Float64Array([0, 0, NaN]), faces: new Int32Array([0, 0, 0]) }, 'nan.obj'), 'invalid_input', /nan\.obj/],
    [() => mimicry.readStrokes(bytesOf('{'), 's.json'), 'invalid_input', /s\.json/],
  ])
    assert.throws(call, (e) => e instanceof MimicryError && e.status === status && words.test(e.message));
});

test('draws frame by frame as all at once, and edits', () => {
  const target = mimicry.createTarget(mimicry.shape('sphere'), 'sphere');
  const session = target.session('mimicry-live', { options: { nozzle: [0, 0, -1] } });
  assert.throws(() => target.session('mimicry-live', { options: { colour: 1 } }), /colour/);
  const all = frames(100);
  assert.equal(session.add(all.subarray(0, kFrameSize)), kRejected);
  session.begin(here);
  let seen = 0;
  for (let i = 0; i < 100; i += 1) {
    assert.equal(session.add(all.subarray(i * kFrameSize, (i + 1) * kFrameSize)), kInked);
    const { count, floats, integers } = session.ink;
    assert.ok(count > seen);
    for (let v = seen; v < count; v += 1) {
      assert.equal(integers[v * kInkStride + 6], i);
      assert.ok(Math.abs(Math.hypot(...floats.subarray(v * kInkStride, v * kInkStride + 3)) - 1) < 1e-2);
    }
    seen = count;
  }
  session.end();
  const curve = session.curve();
  const again = session.project(here, all);
  const json = (c) => textOf(target.writeCurves([c], 'json'));
  assert.equal(json(curve), json(again));
  assert.deepEqual(curve.ink.floats, again.ink.floats);
  assert.equal(curve.pointCount, 100);
  assert.deepEqual([...curve.frames.subarray(0, 3)], [0, 1, 2]);
  assert.equal(curve.resample(10).pointCount, 10);
  assert.equal(curve.slice(10, 30).pointCount, 20);
  assert.ok(curve.close().closed);
  assert.ok(curve.simplify(0.01).pointCount < 50);
  assert.ok(curve.smooth(0.5, 3).length <= curve.length);
  const tube = curve.tube(0.01, 8);
  assert.equal(tube.positions.length, tube.normals.length);
  assert.ok(tube.faces.length > 300);
  const thick = curve.withRadii(new Float64Array(100).fill(0.02));
  assert.deepEqual(target.writeCurves([thick], 'glb', undefined, 0.01), target.writeCurves([curve], 'glb', undefined, 0.02));
  assert.throws(() => curve.withRadii(new Float64Array(99)), /99 radii/);
  const [read] = target.readCurves(target.writeCurves([curve.withStroke('s7')], 'json'), 'c.json');
  assert.deepEqual([read.stroke, read.technique, read.pointCount], ['s7', 'mimicry-live', 100]);
  for (const format of ['obj', 'csv', 'ply', 'glb', 'obj-polylines', 'ply-lines', 'glb-lines', 'packed']) assert.ok(target.writeCurves([curve], format).length > 500);
  const [kept] = target.readCurves(target.writeCurves([curve], 'packed'), 'kept');
  assert.equal(json(kept), json(curve));
  target.dispose();
  assert.ok(curve.length > 0, 'a curve keeps its target');
  curve.dispose();
  curve.dispose();
  assert.throws(() => curve.length, /dispose/);
});

test('a target goes to another thread with its memory, and curves move between targets', async () => {
  const worker = await new Mimicry({ wasm: mimicry.code }).ready;
  const mesh = worker.shape('sphere');
  const first = worker.createTarget(mesh, 'sphere');
  const session = first.session('mimicry-live');
  const draw = (on) => on.project(here, frames(100));
  const curve = draw(session);
  assert.equal(curve.pointCount, 100);
  // As postMessage does it.
  const image = structuredClone({ ...worker.handOver(first, [curve]), code: null });
  const text = textOf(first.writeCurves([curve], 'json'));
  const { target, curves: [received] } = await Mimicry.receive({ ...image, code: mimicry.code });
  worker.dispose();
  assert.equal(textOf(target.writeCurves([received], 'json')), text);
  // It is alive: it draws the same, and grows.
  const again = draw(target.session('mimicry-live'));
  assert.deepEqual(again.ink.floats, received.ink.floats);
  const copies = Array.from({ length: 200 }, () => again.withStroke('copy'));
  assert.equal(copies.at(-1).length, again.length);
  const other = mimicry.createTarget(mesh, 'sphere');
  other.adopt([received, again], target);
  target.dispose();
  assert.equal(textOf(other.writeCurves([received], 'json')), text);
  assert.equal(again.length, received.length);
  assert.throws(() => mimicry.createTarget(mimicry.shape('torus'), 'ring').adopt([received], other), /another|drawn on a mesh/);
  assert.ok(received.length > 0, 'it stays where it was');
});

test('queries', () => {
  const target = mimicry.createTarget(mimicry.shape('sphere'), 'sphere');
  const hit = target.firstHit(0, 0, 3, 0, 0, -1);
  assert.ok(Math.abs(hit.distance - 2) < 1e-2 && Math.abs(hit.normal[2] - 1) < 1e-2);
  assert.equal(target.firstHit(0, 0, 3, 0, 0, 1), null);
  assert.ok(Math.abs(target.closestPoint(0, 2, 0).distance - 1) < 1e-2);
  assert.equal(target.closestPoint(0, 2, 0, 0.5), null);
  assert.equal(target.vertexNormals().length, mimicry.shape('sphere').positions.length);
});

test('strokes come back', () => {
  const stroke = { id: 'a', target: 'sphere', modelToWorld: here, frames: frames(5) };
  assert.deepEqual(mimicry.readStrokes(mimicry.writeStrokes([stroke]), 's.json'), [stroke]);
  const file = new TextDecoder().decode(mimicry.writeStrokes([stroke, { ...stroke, id: 'b' }]));
  const faulty = bytesOf(file.replace('"trigger"', '"tr"'));
  const leftOut = [];
  assert.deepEqual(mimicry.readStrokes(faulty, 's.json', (what) => leftOut.push(what)).map((s) => s.id), ['b']);
  assert.match(leftOut.join(), /^s\.json: stroke 0: .*frame 0/);
  assert.throws(() => mimicry.readStrokes(faulty, 's.json'), /frame 0/);
});

test('bakes, and draws with it', async () => {
  const mesh = mimicry.shape('sphere', 6);
  const target = mimicry.createTarget(mesh, 'sphere');
  assert.throws(() => target.session('mimicry'), /bake/);
  const stages = new Set();
  const bytes = await bakeHere(mesh, { samples: 60, onProgress: (stage) => stages.add(stage) });
  assert.ok(stages.has('shell') && stages.has('mds'));
  const baked = target.withEmbedding(bytes, 'sphere.mimicry');
  assert.ok(baked.hasEmbedding && !target.hasEmbedding);
  assert.equal(baked.session('mimicry').project(here, frames(50)).pointCount, 50);
});

test('what is given in another type is read where it has one meaning', () => {
  const text = 'v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n';
  const mesh = mimicry.readMesh(bytesOf(text).buffer, 'corner.obj');
  const given = { positions: new Float32Array(mesh.positions), faces: new Uint16Array(mesh.faces) };
  assert.deepEqual(mimicry.validate(given), mimicry.validate(mesh));
  assert.deepEqual(mimicry.validate({ positions: [...mesh.positions], faces: [...mesh.faces] }), mimicry.validate(mesh));
  assert.deepEqual(mimicry.validate({ positions: mesh.positions }), mimicry.validate(mesh));
  const target = mimicry.createTarget(mimicry.shape('sphere', 4));
  const session = target.session('snap');
  const curve = session.project(here, frames(9));
  const same = session.project([...here], [...frames(9)]);
  assert.deepEqual(same.ink.floats, curve.ink.floats);
  assert.equal(session.project(new Float32Array(here), new Float32Array(frames(9))).pointCount, 9);
  session.begin([...here]);
  assert.equal(session.add([...frames(1)]), kInked);
  assert.deepEqual(target.writeCurves([curve], 'ply', [1, 2, 3]), target.writeCurves([curve], 'ply', Uint8Array.of(1, 2, 3)));
});

test('what cannot be understood is named, in every function', async () => {
  const target = mimicry.createTarget(mimicry.shape('sphere', 4), 'sphere');
  const session = target.session('snap');
  const curve = session.project(here, frames(9));
  const other = await new Mimicry().ready;
  const foreign = other.createTarget(other.shape('sphere', 4)).session('snap').project(here, frames(9));
  for (const [call, words] of [
    [() => mimicry.shape(), /shape's name must be a text, not undefined/],
    [() => mimicry.shape('sphere', 2.5), /resolution must be a whole number, not 2\.5/],
    [() => mimicry.readMesh('v 0 0 0', 'a.obj'), /content must be bytes .* not "v 0 0 0"/],
    [() => mimicry.readMesh(bytesOf('v 0 0 0')), /file's name must be a text/],
    [() => mimicry.readMeshFiles(), /files must be an array/],
    [() => mimicry.readMeshFiles([{}]), /content of a file must be bytes/],
    [() => mimicry.validate(null), /positions .* must be 3 numbers each, not undefined/],
    [() => mimicry.validate({ positions: [0, 0], faces: [] }), /positions .* must be 3 numbers each, not 2 of them/],
    [() => mimicry.validate({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], faces: [0, 1, 1.5] }), /face 0 refers to vertex -1/],
    [() => mimicry.createTarget({ positions: 'abc', faces: [] }, 'x'), /positions .* not "abc"/],
    [() => mimicry.createTarget(mimicry.shape('sphere', 4), 7), /target's name must be a text, not 7/],
    [() => mimicry.readStrokes('{}', 's.json'), /must be bytes/],
    [() => mimicry.writeStrokes([{}]), /stroke's frames/],
    [() => mimicry.writeStrokes([{ id: 'a', target: 'b', modelToWorld: [1], frames: [] }]), /modelToWorld must be 8 numbers, not 1/],
    [() => target.session(), /technique's name/],
    [() => target.session('mimicry'), /bake it with bake\(\) of 'mimicry\/bake' or load its \.mimicry file with target\.withEmbedding\(\)/],
    [() => target.session('mimicry-live', { options: { nozzle: undefined } }), /option 'nozzle' must be an array of numbers, not undefined/],
    [() => target.withEmbedding(undefined), /must be bytes/],
    [() => target.writeCurves([curve], 'fbx'), /no format fbx for curves; choose one of json, obj/],
    [() => target.writeCurves([curve], 'ply', Uint8Array.of(1)), /colors must be 3 numbers, not 1/],
    [() => target.writeCurves([null], 'obj'), /must be curves of this package/],
    [() => target.writeCurves([foreign], 'obj'), /of another Mimicry/],
    [() => target.readCurves(), /must be bytes/],
    [() => mimicry.handOver(target, [foreign]), /of another Mimicry/],
    [() => Mimicry.receive({}), /not what handOver\(\) gave/],
    [() => session.begin(), /modelToWorld must be 8 numbers/],
    [() => session.add(frames(2)), /frame must be 17 numbers, not 34/],
    [() => session.project(here, new Float64Array(18)), /frames must be 17 numbers each, not 18/],
    [() => curve.point(9), /no point 9 in a curve of 9/],
    [() => curve.point(-1), /no point -1/],
    [() => curve.slice(0, NaN), /end of the points must be a whole number, not NaN/],
    [() => curve.resample(), /number of points must be a whole number/],
    [() => curve.withStroke(), /stroke's id/],
    [() => curve.withRadii([1]), /1 radii for a curve of 9/],
    [() => curve.tube(NaN), /radius/],
    [() => bake(null), /positions/],
    [() => bake(mimicry.shape('sphere', 2), { samples: 20.5 }), /samples must be a whole number/],
    [() => bake(mimicry.shape('sphere', 2), { worker: {} }), /option worker: give a Worker/],
    [() => bakeHere(mimicry.shape('sphere', 2), { wasm: 7 }), /option wasm: 7/],
  ])
    await assert.rejects(async () => call(), (e) => {
      assert.ok(e instanceof MimicryError && e.status === 'invalid_input', `${call}: ${e}`);
      assert.match(e.message, words);
      return true;
    });
  other.dispose();
});

test('memory grows under a session in use, and comes back', () => {
  const target = mimicry.createTarget(mimicry.shape('sphere'), 'sphere');
  const session = target.session('snap');
  session.begin(here);
  const frame = frames(1);
  session.add(frame);
  const before = mimicry.memoryBytes;
  const others = [];
  while (mimicry.memoryBytes === before) others.push(target.session('snap'));
  session.add(frame);
  const { floats, integers, count } = session.ink;
  assert.ok(count >= 2 && floats.length > 0 && integers[kInkStride + 6] === 1);
  for (const other of others) other.dispose();
  const grown = mimicry.memoryBytes;
  for (let i = 0; i < 50; i += 1) target.session('snap').dispose();
  assert.equal(mimicry.memoryBytes, grown);
});

test('is gone after dispose()', () => {
  mimicry.dispose();
  assert.throws(() => mimicry.shape('sphere'), /dispose/);
});
