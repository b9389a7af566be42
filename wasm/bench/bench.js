// Times of a frame of each technique, and of closest points and first hits beside three-mesh-bvh's on the
// same queries. Runs in Node (run.mjs) and in a page (run.mjs --chromium).
import { kFrameSize, Mimicry } from 'mimicry';
import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from 'three';
import { MeshBVH } from 'three-mesh-bvh';

// Enough calls in one reading of the clock that its step (5 us in a page) does not show.
const kBatch = 50;

function statistics(times_us) {
  const sorted = Float64Array.from(times_us).sort();
  const at = (part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
  return { median: at(0.5), p99: at(0.99), largest: sorted.at(-1) };
}

/** Means of batches: three passes, the least of each. */
function batched(count, call) {
  const times = new Float64Array(Math.floor(count / kBatch)).fill(Infinity);
  for (let pass = 0; pass < 3; pass += 1)
    for (let b = 0; b < times.length; b += 1) {
      const start = performance.now();
      for (let i = 0; i < kBatch; i += 1) call(b * kBatch + i);
      times[b] = Math.min(times[b], (1000 * (performance.now() - start)) / kBatch);
    }
  return statistics(times);
}

// Mulberry32: seeded, so that every run has the same queries.
function generator(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** Points at up to `reach` from points of the surface, 3 numbers each, with a normal. */
function queriesNear(mesh, reach, count) {
  const random = generator(7);
  const { positions, faces } = mesh;
  const points = new Float64Array(3 * count);
  for (let i = 0; i < count; i += 1) {
    const f = 3 * Math.floor((random() * faces.length) / 3);
    let [a, b] = [random(), random()];
    if (a + b > 1) [a, b] = [1 - a, 1 - b];
    for (let k = 0; k < 3; k += 1) {
      const corner = (c) => positions[3 * faces[f + c] + k];
      points[3 * i + k] = corner(0) + a * (corner(1) - corner(0)) + b * (corner(2) - corner(0)) + reach * (2 * random() - 1);
    }
  }
  return points;
}

function peer(mesh) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(mesh.positions), 3));
  geometry.setIndex(new BufferAttribute(Uint32Array.from(mesh.faces), 1));
  return new MeshBVH(geometry);
}

function queries(mimicry, mesh, name, part) {
  const target = mimicry.createTarget(mesh, name);
  const bvh = peer(mesh);
  const count = 4000;
  const points = queriesNear(mesh, part * target.diagonal, count);
  const centre = target.min.map((low, k) => (low + target.max[k]) / 2);
  const point = new Vector3();
  const found = {};
  const ray = new Ray();
  const toCentre = (i) => {
    point.set(centre[0] - points[3 * i], centre[1] - points[3 * i + 1], centre[2] - points[3 * i + 2]);
    return point;
  };
  let apart = 0;
  for (let i = 0; i < count; i += 1) {
    const d = target.closestPoint(points[3 * i], points[3 * i + 1], points[3 * i + 2]).distance;
    bvh.closestPointToPoint(point.fromArray(points, 3 * i), found);
    apart = Math.max(apart, Math.abs(d - found.distance) / target.diagonal);
  }
  if (!(apart < 1e-5)) throw new Error(`${name}: the closest points differ by ${apart} of the diagonal`);
  const rows = {
    'closest point': {
      ours: batched(count, (i) => target.closestPoint(points[3 * i], points[3 * i + 1], points[3 * i + 2])),
      peer: batched(count, (i) => bvh.closestPointToPoint(point.fromArray(points, 3 * i), found)),
    },
    'first hit': {
      ours: batched(count, (i) => {
        const d = toCentre(i);
        target.firstHit(points[3 * i], points[3 * i + 1], points[3 * i + 2], d.x, d.y, d.z);
      }),
      peer: batched(count, (i) => {
        ray.direction.copy(toCentre(i)).normalize();
        ray.origin.fromArray(points, 3 * i);
        bvh.raycastFirst(ray, DoubleSide);
      }),
    },
  };
  target.dispose();
  return rows;
}

function frames(mimicry, target, strokes) {
  const rows = {};
  for (const { name, needsBake } of mimicry.techniques) {
    if (needsBake && !target.hasEmbedding) continue;
    const session = target.session(name);
    const all = strokes.map((s) => ({ ...s, list: Array.from({ length: s.frames.length / kFrameSize }, (_, i) => s.frames.subarray(i * kFrameSize, (i + 1) * kFrameSize)) }));
    const count = all.reduce((sum, s) => sum + s.list.length, 0);
    const times = new Float64Array(count).fill(Infinity);
    for (let pass = 0; pass < 3; pass += 1) {
      let at = 0;
      for (const stroke of all) {
        session.begin(stroke.modelToWorld);
        for (const frame of stroke.list) {
          const start = performance.now();
          session.add(frame);
          times[at] = Math.min(times[at], 1000 * (performance.now() - start));
          at += 1;
        }
        session.end();
      }
    }
    rows[name] = statistics(times);
    session.dispose();
  }
  return rows;
}

/** cases: { name, mesh: bytes and file name, strokes: bytes, embedding: bytes or null }. */
export async function bench(cases, options = {}) {
  const mimicry = await new Mimicry(options).ready;
  const result = { frames: {}, queries: {} };
  for (const { name, mesh, file, strokes, embedding } of cases) {
    const arrays = mimicry.readMesh(mesh, file);
    let target = mimicry.createTarget(arrays, name);
    if (embedding) target = target.withEmbedding(embedding, `${name}.mimicry`);
    result.frames[name] = frames(mimicry, target, mimicry.readStrokes(strokes, `${name}.json`));
    target.dispose();
    for (const part of [0.01, 0.1]) result.queries[`${name}, ${100 * part} %`] = queries(mimicry, arrays, name, part);
  }
  return result;
}
