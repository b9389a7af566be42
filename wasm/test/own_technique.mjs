// Techniques that are written in JavaScript.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { kFrameSize, kInked, kMissed, Mimicry, MimicryError } from 'mimicry';

const mimicry = await new Mimicry().ready;
const here = [0, 0, 0, 1, 0, 0, 0, 1];
const target = mimicry.createTarget(mimicry.shape('sphere'), 'sphere');

function frame(i) {
  const numbers = new Float64Array(kFrameSize);
  numbers[0] = i / 90;
  numbers[7] = numbers[14] = 1;
  numbers.set([0.004 * i - 0.2, 0.1 * Math.sin(0.1 * i), 1.2], 8);
  numbers[15] = 1;
  numbers[16] = -1;
  return numbers;
}
const frames = Float64Array.from({ length: 60 * kFrameSize }, (_, k) => frame(Math.floor(k / kFrameSize))[k % kFrameSize]);
const closest = (step) => {
  const { target: surface, frame: f } = step;
  const hit = surface.closestPoint(f[8], f[9], f[10]);
  return hit && step.found('closest', hit);
};
/** Whatever a test wants to do in a step. */
let act = () => null;
mimicry.registerTechnique({ name: 'acting', options: [{ kind: 'boolean', name: 'on' }], memory: 2, step: (step) => act(step) });

const refused = (call, status, words) => assert.throws(call, (e) => {
  assert.ok(e instanceof MimicryError && e.status === status, `${e}`);
  assert.match(e.message, words);
  return true;
});

test('is listed with its options', () => {
  const before = mimicry.techniques.length;
  mimicry.registerTechnique({
    name: 'steady-snap', title: 'Steady snap', sentence: 'Calm.', description: 'the closest point', color: '#8A3ffc', steering: 'aimed', anchored: true,
    options: [
      { kind: 'number', name: 'tau', unit: 's', description: 'time', default: 0.1, lowest: 0.001, highest: 2 },
      { kind: 'boolean', name: 'pause', default: true },
      { kind: 'direction', name: 'nozzle', default: [0, 0, -1] },
      { kind: 'choice', name: 'start', choices: ['hand', 'head'], default: 'head' },
    ],
    step: (step) => closest(step),
  });
  assert.equal(mimicry.techniques.length, before + 1);
  const { options, ...row } = mimicry.techniques.find((t) => t.name === 'steady-snap');
  assert.deepEqual(row, { name: 'steady-snap', title: 'Steady snap', sentence: 'Calm.', description: 'the closest point', source: '-', screenNote: '', color: '#8a3ffc', steering: 'aimed', anchored: true, needsBake: false, rank: 100 });
  assert.deepEqual(options.map(({ name, kind, unit, defaults, lowest, highest, choices }) => [name, kind, unit, defaults, lowest, highest, choices]), [
    ['tau', 'number', 's', [0.1], 0.001, 2, []], ['pause', 'boolean', '', [1], 0, 1, []],
    ['nozzle', 'direction', '', [0, 0, -1], -1, 1, []], ['start', 'choice', '', [1], 0, 1, ['hand', 'head']]]);
  assert.equal(mimicry.techniques.find((t) => t.name === 'acting').title, 'acting');
});

test('draws what the same technique of the library draws', () => {
  act = (step) => closest(step);
  const [own, snap] = ['acting', 'snap'].map((name) => target.session(name).project(here, frames));
  assert.equal(own.pointCount, 60);
  assert.deepEqual(own.ink.floats.slice(), snap.ink.floats.slice());
  const session = target.session('acting');
  session.begin(here);
  for (let i = 0; i < 60; i += 1) assert.equal(session.add(frame(i)), kInked);
  session.end();
  assert.deepEqual(session.curve().ink.floats.slice(), snap.ink.floats.slice());
});

test('gets options in their order, and memory of the stroke', () => {
  const seen = [];
  const held = new Set();
  act = (step) => {
    seen.push([step.options[0], step.memory[0], step.memory[1], step.metresPerUnit, step.frame[8]]);
    for (const part of [step, step.frame, step.options, step.memory]) held.add(part);
    step.memory[0] += 1;
    step.memory[1] = step.frame[8];
    return null;
  };
  const placed = [0, 0, 0, 1, 0, 0, 0, 2]; // twice as large in the world
  const [one, two] = [target.session('acting', { options: { on: true } }), target.session('acting')];
  for (const session of [one, two]) session.begin(placed);
  for (let i = 0; i < 2; i += 1) for (const session of [one, two]) assert.equal(session.add(frame(i)), kMissed);
  const [x, y] = [frame(0)[8] / 2, frame(1)[8] / 2];
  assert.deepEqual(seen, [[1, 0, 0, 2, x], [0, 0, 0, 2, x], [1, 1, x, 2, y], [0, 1, x, 2, y]]);
  one.begin(placed);
  one.add(frame(0));
  assert.deepEqual(seen.at(-1), [1, 0, 0, 2, x], 'a stroke starts with zeros');
  assert.equal(held.size, 4, 'the same objects in every step');
});

test('a point off the target is none', () => {
  const session = target.session('acting');
  session.begin(here);
  for (const place of [{ face: -1, barycentric: [1, 0, 0] }, { face: 1e9, barycentric: [1, 0, 0] }, { face: 0.5, barycentric: [1, 0, 0] }, { face: 2 ** 40, barycentric: [1, 0, 0] },
    { face: 0, barycentric: [2, 0, 0] }, { face: 0, barycentric: [] }]) {
    act = (step) => step.found('ray', place);
    assert.equal(session.add(frame(0)), kMissed);
  }
  act = () => 'ray';
  assert.equal(session.add(frame(1)), kMissed);
});

test('what a step throws is an error of the call, and the session goes on', () => {
  const session = target.session('acting');
  session.begin(here);
  const cause = new Error('no idea');
  act = () => { throw cause; };
  assert.throws(() => session.add(frame(0)), (e) => e instanceof MimicryError && e.status === 'failed' && e.message === "technique 'acting': no idea" && e.cause === cause);
  for (const [given, words] of [[undefined, /gave undefined; give what found\(\) gave \(one of ray, closest/], ['near', /gave 'near'/], [7, /gave 7/], [Promise.resolve(null), /Promise/], [{}, /Object/]]) {
    act = () => given;
    refused(() => session.add(frame(1)), 'failed', words);
  }
  act = (step) => closest(step);
  assert.equal(session.add(frame(2)), kInked);
  let calls = 0;
  act = () => { calls += 1; throw 'words'; };
  const before = mimicry.memoryBytes;
  for (let i = 0; i < 200; i += 1) refused(() => session.project(here, frames), 'failed', /'acting': words/);
  assert.equal(calls, 200, 'the rest of a stroke is not tried');
  assert.equal(mimicry.memoryBytes, before);
  act = (step) => closest(step);
  assert.equal(session.project(here, frames).pointCount, 60);
});

test('queries are for the step alone, and nothing in use can be changed in it', () => {
  const session = target.session('acting');
  session.begin(here);
  let kept;
  act = ({ target: surface }) => {
    kept = surface;
    assert.ok(surface.diagonal > 3 && !surface.hasEmbedding);
    assert.ok(Math.abs(surface.firstHit(0, 0, 3, 0, 0, -1).distance - 2) < 1e-2);
    assert.equal(surface.closestPoint(0, 0, 3, 0.5), null);
    assert.throws(() => surface.smoothClosestPoint(0, 0, 3), /bake/);
    return null;
  };
  assert.equal(session.add(frame(0)), kMissed);
  refused(() => kept.closestPoint(0, 0, 3), 'disposed', /'acting': the target of a step was used after/);
  const other = target.session('acting');
  for (const [wrong, words] of [[() => session.dispose(), /given back/], [() => other.begin(here), /session was used/], [() => session.add(frame(1)), /session was used/],
    [() => session.ink, /session was used/], [() => target.updatePositions(mimicry.shape('sphere').positions), /vertices were moved/], [() => mimicry.handOver(target), /handed over/]]) {
    act = () => { wrong(); return null; };
    refused(() => session.add(frame(1)), 'failed', words);
  }
  act = (step) => closest(step);
  assert.equal(session.add(frame(2)), kInked);
});

test('memory grows in a step', () => {
  const session = target.session('acting');
  session.begin(here);
  const grown = [];
  act = (step) => {
    step.memory[0] = 3;
    const before = mimicry.memoryBytes;
    while (mimicry.memoryBytes === before) grown.push(mimicry.createTarget(mimicry.shape('sphere', 40), 'more'));
    return closest(step);
  };
  assert.equal(session.add(frame(0)), kInked);
  act = (step) => {
    assert.equal(step.memory[0], 3);
    return closest(step);
  };
  assert.equal(session.add(frame(1)), kInked);
  for (const used of grown) used.dispose();
});

test('what cannot be registered is refused by name', () => {
  const step = () => null;
  const option = (given) => ({ name: 'odd', step, options: [given] });
  const before = mimicry.techniques.length;
  for (const [given, words] of [
    [null, /must be an object/],
    [{ step }, /technique's name must be a text/],
    [{ name: 'odd' }, /'odd': its step must be a function/],
    [{ name: 'Odd One', step }, /'Odd One' cannot be registered: write its name/],
    [{ name: 'snap', step }, /'snap' exists already/],
    [{ name: 'odd', step, color: 'red' }, /'odd': its color must be '#rrggbb', not 'red'/],
    [{ name: 'odd', step, steering: 'pushed' }, /'odd': its steering must be 'aimed' or 'moved'/],
    [{ name: 'odd', step, title: 7 }, /'odd': its title must be a text/],
    [{ name: 'odd', step, rank: 1.5 }, /'odd': its rank must be a whole number/],
    [{ name: 'odd', step, memory: -1 }, /'odd': its memory must not be below 0/],
    [{ name: 'odd', step, memory: 131073 }, /'odd' asks for 1048584 bytes of memory/],
    [{ name: 'odd', step, options: {} }, /'odd': its options must be an array/],
    [{ name: 'odd', step, options: Array.from({ length: 65 }, (_, i) => ({ kind: 'boolean', name: `o${i}` })) }, /'odd' has 65 options/],
    [{ name: 'odd', step, options: [{ kind: 'boolean', name: 'a' }, { kind: 'boolean', name: 'a' }] }, /two options 'a'/],
    [option({ kind: 'text', name: 'a' }), /option 'a': its kind must be one of boolean, number, direction, choice, not 'text'/],
    [option({ kind: 'boolean' }), /'odd': an option's name must be a text/],
    [option({ kind: 'boolean', name: 'A b' }), /option 'A b'/],
    [option({ kind: 'number', name: 'a', default: 1, lowest: 0 }), /option 'a': its highest must be a number, not undefined/],
    [option({ kind: 'number', name: 'a', default: 3, lowest: 0, highest: 2 }), /option 'a', its default/],
    [option({ kind: 'number', name: 'a', default: 0, lowest: 2, highest: 1 }), /option 'a': its lowest value is above its highest/],
    [option({ kind: 'number', name: 'a', default: NaN, lowest: 0, highest: 1 }), /option 'a', its default/],
    [option({ kind: 'direction', name: 'a', default: [0, 0, 0] }), /option 'a', its default/],
    [option({ kind: 'direction', name: 'a', default: [1] }), /option 'a': its default must be 3 numbers/],
    [option({ kind: 'choice', name: 'a', choices: [] }), /option 'a'/],
    [option({ kind: 'choice', name: 'a', choices: ['x', 'x'] }), /option 'a' has two choices 'x'/],
    [option({ kind: 'choice', name: 'a', choices: ['x'], default: 'y' }), /option 'a': its default 'y' is none of its choices \(x\)/],
  ])
    refused(() => mimicry.registerTechnique(given), 'invalid_input', words);
  assert.equal(mimicry.techniques.length, before);
  refused(() => target.session('steady-snap', { options: { tau: 3 } }), 'invalid_input', /tau/);
  refused(() => target.session('steady-snap', { options: { tua: 1 } }), 'invalid_input', /tua/);
});

test('draws on a target that was handed over', async () => {
  act = (step) => closest(step);
  const worker = await new Mimicry({ wasm: mimicry.code }).ready;
  assert.ok(!worker.techniques.some((t) => t.name === 'acting'), 'each Mimicry has its own');
  worker.registerTechnique({ name: 'elsewhere', step: () => null });
  worker.registerTechnique({ name: 'steady-snap', step: () => null }); // with other options
  const sent = () => structuredClone({ ...worker.handOver(worker.createTarget(mimicry.shape('sphere'), 'sphere')), code: null });
  const { target: received } = await Mimicry.receive({ ...sent(), code: mimicry.code }, mimicry);
  assert.deepEqual(received.session('acting').project(here, frames).ink.floats.slice(), target.session('acting').project(here, frames).ink.floats.slice());
  mimicry.registerTechnique({ name: 'later', step: (step) => closest(step) });
  assert.equal(received.session('later').project(here, frames).pointCount, 60, 'those that are registered afterwards, too');
  for (const name of ['elsewhere', 'steady-snap']) refused(() => received.session(name), 'invalid_input', new RegExp(`'${name}' was registered in another thread`));
  const { target: alone } = await Mimicry.receive({ ...sent(), code: mimicry.code });
  refused(() => alone.session('acting'), 'invalid_input', /'acting' does not exist/);
});
