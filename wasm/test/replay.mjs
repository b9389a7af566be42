// replay.mjs MIMICRY PACKAGE: the same recorded strokes through the command line and through the package
// give the same curves: equal faces, positions within 1e-9 of the diagonal, and to the last bit wherever
// nothing but arithmetic and square roots is involved. (Vertex normals and tangents are weighted with the
// platform's arc cosines and cosines; the techniques on smooth points use them.)
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [program, folder] = process.argv.slice(2);
if (!existsSync(program)) {
  console.log(`skipped: ${program} is not built; cmake --build --preset release --target mimicry_cli`);
  process.exit(77);
}
const { Mimicry } = await import(pathToFileURL(join(folder, 'dist', 'index.js')));
const work = mkdtempSync(join(tmpdir(), 'mimicry-replay-'));
try {
  const at = (name) => join(work, name);
  const native = (...args) => execFileSync(program, args, { stdio: ['ignore', 'ignore', 'inherit'] });
  // A file, as shapes are made with sines of the platform's.
  native('shapes', 'hand', '--out', at('hand.obj'));
  native('simulate', at('hand.obj'), '--shape', 'hand', '--out', at('strokes.json'));
  native('bake', at('hand.obj'), '--samples', '200', '--out', at('hand.mimicry'));
  native('project', at('hand.obj'), at('strokes.json'), '--embedding', at('hand.mimicry'), '--formats', 'json', '--out', work);
  const expected = JSON.parse(readFileSync(at('curves.json'), 'utf8'));

  const mimicry = await new Mimicry().ready;
  const target = mimicry.createTarget(mimicry.readMesh(readFileSync(at('hand.obj')), 'hand.obj'), 'hand.obj');
  const baked = target.withEmbedding(readFileSync(at('hand.mimicry')), 'hand.mimicry');
  const strokes = mimicry.readStrokes(readFileSync(at('strokes.json')), 'strokes.json');
  const curves = mimicry.techniques.flatMap(({ name }) => {
    const session = baked.session(name);
    return strokes.map((s) => session.project(s.modelToWorld, s.frames).withStroke(s.id));
  });
  const got = JSON.parse(new TextDecoder().decode(baked.writeCurves(curves, 'json')));

  assert.equal(got.curves.length, expected.curves.length);
  const tolerance = 1e-9 * target.diagonal;
  const exact = new Set(['occlude', 'spraycan', 'head-centric', 'snap', 'anchored-closest', 'mimicry-planar', 'anchored-ray-plane', 'anchored-ray-transport']);
  const withoutNormals = ({ points, ...rest }) => JSON.stringify({ ...rest, points: points.map(({ normal, ...p }) => p) });
  let same = 0;
  let largest = 0;
  const different = new Set();
  got.curves.forEach((curve, i) => {
    const other = expected.curves[i];
    const label = `${other.technique}, stroke ${other.stroke}`;
    assert.equal(curve.technique, other.technique);
    if (withoutNormals(curve) === withoutNormals(other)) same += 1;
    else different.add(curve.technique);
    assert.equal(curve.points.length, other.points.length, label);
    curve.points.forEach((p, k) => {
      const q = other.points[k];
      const distance = Math.hypot(...p.position.map((x, axis) => x - q.position[axis]));
      largest = Math.max(largest, distance);
      assert.ok(distance <= tolerance, `${label}, point ${k}: ${distance} apart`);
      // On an edge either face will do.
      if (p.face !== q.face) assert.ok(Math.min(...p.bary) <= 1e-9, `${label}, point ${k}: face ${p.face}, not ${q.face}`);
    });
  });
  for (const technique of different) assert.ok(!exact.has(technique), `${technique} is not the same to the last bit`);
  console.log(`${same} of ${got.curves.length} curves are the same to the last bit; largest distance ${largest} (${[...different].join(' ')})`);
} finally {
  rmSync(work, { recursive: true });
}
