// The README's pen for three.js, built as a page's program is, on a mesh that stands turned and scaled in the world.
import assert from 'node:assert/strict';
import { readFileSync, symlinkSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import * as esbuild from 'esbuild';
import { fresh, here, run } from './harness.mjs';

const main = `import * as THREE from 'three';
import { Pen } from './pen.js';
import { inTexture, paintable } from './paint.js';

const scene = new THREE.Scene();
const results = {};
for (const [name, geometry] of [['indexed', new THREE.SphereGeometry(1, 96, 64)], ['not indexed', new THREE.IcosahedronGeometry(1, 12)]]) {
  const mesh = new THREE.Mesh(geometry);
  mesh.position.set(1, 2, 3);
  mesh.rotation.set(0.3, 0.4, 0.5);
  mesh.scale.setScalar(0.25);
  scene.add(mesh);
  const [head, hand] = [new THREE.Object3D(), new THREE.Object3D()];
  scene.add(head, hand);
  head.position.set(1, 2, 5);
  const pen = new Pen(mesh, 'snap');
  pen.press();
  for (let i = 0; i < 60; i += 1) {
    hand.position.set(1 + 0.004 * (i - 30), 2, 3.5);
    pen.move(i / 90, head, hand);
  }
  const line = [...pen.line.geometry.getAttribute('position').array];
  const tube = pen.release(0.02);
  scene.updateMatrixWorld(true);
  const corner = new THREE.Vector3();
  // In the world: the distance from the sphere's middle, of the ink and of the tube.
  const distances = (array, object) => Array.from({ length: array.length / 3 }, (_, i) => corner.fromArray(array, 3 * i).applyMatrix4(object.matrixWorld).distanceTo(mesh.position));
  const ray = new THREE.Raycaster(new THREE.Vector3(1.05, 2, 5), new THREE.Vector3(0, 0, -1));
  results[name] = {
    ink: distances(line, mesh), tube: distances(tube.geometry.getAttribute('position').array, tube),
    ends: [line.slice(0, 3), line.slice(-3)].map((p) => corner.fromArray(p).applyMatrix4(mesh.matrixWorld).toArray()),
    hit: ray.intersectObject(tube).length, parts: mesh.children.length,
  };
}
// A grid of two by two, the vertices of its triangles apart: u and v are (x + 1) / 2 and (y + 1) / 2.
const plane = paintable(new THREE.PlaneGeometry(2, 2, 2, 2).toNonIndexed(), 'plane');
const frames = new Float64Array(20 * 17);
for (let i = 0; i < 20; i += 1) frames.set([i / 90, 0, 0, 3, 0, 0, 0, 1, 0.05 * i - 0.5, 0.3, 0.1, 0, 0, 0, 1, 1, -1], 17 * i);
const curve = plane.session('snap').project([0, 0, 0, 1, 0, 0, 0, 1], frames);
const texture = { components: plane.report.components, points: inTexture(plane, curve).map((uv) => [...uv]) };
console.log(JSON.stringify({ results, texture }));
`;

test('draws on meshes of three.js with an index and without', async () => {
  const readme = readFileSync(join(here, '../README.md'), 'utf8');
  const pen = /```js\n(import \* as THREE[^]*?)```/.exec(readme)[1];
  const paint = /```js\n(import \{ Mimicry, cornerValueAt[^]*?)```/.exec(readme)[1];
  const folder = fresh('three', { 'pen.js': pen, 'paint.js': paint, 'main.js': main });
  symlinkSync(join(here, 'node_modules/three'), join(folder, 'node_modules/three'));
  await esbuild.build({ absWorkingDir: folder, entryPoints: ['main.js'], bundle: true, outfile: 'out.mjs', format: 'esm', platform: 'node' });
  const { results, texture } = JSON.parse(run(folder, 'node', 'out.mjs'));
  assert.deepEqual(Object.keys(results), ['indexed', 'not indexed']);
  for (const [name, { ink, tube, ends, hit, parts }] of Object.entries(results)) {
    assert.ok(ink.length >= 2 * 59, name);
    // On facets of a sphere of 0.25 m; the tube's radius is 0.02 of the model's units.
    for (const d of ink) assert.ok(d > 0.249 && d < 0.25 + 1e-6, `${name}: ink at ${d}`);
    for (const d of tube) assert.ok(d > 0.243 && d < 0.2555, `${name}: tube at ${d}`);
    // The closest point is toward the pen, from the middle.
    [-30, 29].forEach((i, end) => {
      const [x, z] = [0.004 * i, 0.5];
      const toward = [1 + (0.25 * x) / Math.hypot(x, z), 2, 3 + (0.25 * z) / Math.hypot(x, z)];
      assert.ok(Math.hypot(...toward.map((v, k) => v - ends[end][k])) < 0.01, `${name}: an end at ${ends[end]}, not ${toward}`);
    });
    assert.ok(hit > 0, `${name}: the tube is seen from outside`);
    assert.equal(parts, 1, 'the tube is in the place of the line');
  }
  assert.equal(texture.components, 1, 'drawn across the seams');
  assert.equal(texture.points.length, 20);
  texture.points.forEach(([u, v], i) => assert.ok(Math.abs(u - (0.025 * i + 0.25)) < 1e-6 && Math.abs(v - 0.65) < 1e-6, `point ${i} at ${[u, v]}`));
});
