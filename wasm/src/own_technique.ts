// Techniques that are written in JavaScript.
import { messageOf, MimicryError } from './error.js';
import type { Pointer } from './exports.js';
import { givenCount, givenList, givenNumbers, givenText } from './given.js';
import { Arguments, calling, check, instantiate, stepsOf, type Factory, type Module } from './module.js';
import { PointQueries, type SurfaceHit } from './queries.js';
import { kFrameSize } from './session.js';
import { kOptionBytes, kOptionKinds } from './technique.js';

/** How a technique found a point: by a ray, as the closest point, by a smooth projection, by a walk along the surface; the others are closest points in place of smooth ones. */
export type Answer = 'ray' | 'closest' | 'smooth' | 'section' | 'outside-shell' | 'no-smooth-point' | 'replaced';
const kAnswers: readonly Answer[] = ['ray', 'closest', 'smooth', 'section', 'outside-shell', 'no-smooth-point', 'replaced']; // from 1 on
const kNoPoint = 0;

/** An option of a technique of your own. name: words of lower case letters and digits, joined by '-'. */
export type OwnOption = { name: string; unit?: string; description?: string } & (
  | { kind: 'boolean'; default?: boolean }
  | { kind: 'number'; default: number; lowest: number; highest: number }
  /** Not all zero; lowest and highest, of each number, are -1 and 1 where nothing is given. */
  | { kind: 'direction'; default: ArrayLike<number>; lowest?: number; highest?: number }
  /** default: one of the choices; the first where nothing is given. */
  | { kind: 'choice'; choices: readonly string[]; default?: string });

/** What a step looks at: one object, which the next step writes over; so are its arrays. */
export interface TechniqueStep {
  /** Only during the step. */
  readonly target: StepTarget;
  /** `kFrameSize` numbers in the target's coordinates and units. */
  readonly frame: Float64Array;
  /** At which the target is shown. */
  readonly metresPerUnit: number;
  /** The values of all options in their order: 0 or 1 of a boolean, the number of a choice, 3 numbers of a direction. */
  readonly options: Float64Array;
  /** `memory` numbers, 0 when a stroke starts; what is written is there in the stroke's next frame. */
  readonly memory: Float64Array;
  /** Sets the point, by its face and barycentric coordinates; gives `how` back. */
  found(how: Answer, place: { readonly face: number; readonly barycentric: ArrayLike<number> }): Answer;
}

/** A technique of your own. */
export interface OwnTechnique {
  /** Words of lower case letters and digits, joined by '-'; no other technique's. */
  name: string;
  /** For people; the name where nothing is given. */
  title?: string;
  /** For someone who has never read of it. */
  sentence?: string;
  /** One line, exact. */
  description?: string;
  /** Of its curves in documents and pictures, '#rrggbb'; black where nothing is given. */
  color?: string;
  /** 'moved' where nothing is given. */
  steering?: 'aimed' | 'moved';
  /** Looks at the last point too. */
  anchored?: boolean;
  /** Needs a target with its embedding, for `smoothClosestPoint`. */
  needsBake?: boolean;
  /** Those of lower rank are offered to people first; 100, after the library's, where nothing is given. */
  rank?: number;
  /** At most 64. */
  options?: readonly OwnOption[];
  /** Numbers that a stroke keeps from frame to frame, at most 131,072; they are copied in and out. */
  memory?: number;
  /**
   * Called once a frame. Gives what `found` gave, or null where there is no point; a point off the target counts as none. Should depend
   * on its argument alone, so that a recorded stroke always gives the same curve. What it throws, or gives beside these, is an error of
   * the call that adds the frame, which then is a miss.
   */
  step(step: TechniqueStep): Answer | null;
}

/** Queries of a step. They make no objects; the answer is one object that the next query writes over. */
export class StepTarget {
  /** @internal 0 outside a step. */
  pointer: Pointer = 0;
  private readonly queries: PointQueries;

  /** @internal */
  constructor(private readonly m: Module, private readonly technique: string) {
    this.queries = new PointQueries(m);
  }

  private get at(): Pointer {
    if (this.pointer === 0) throw new MimicryError('disposed', `technique '${this.technique}': the target of a step was used after the step`);
    return this.pointer;
  }

  /** Model units, of the bounding box. */
  get diagonal(): number { return this.m._mimicry_target_diagonal(this.at); }
  get hasEmbedding(): boolean { return this.m._mimicry_target_has_embedding(this.at) !== 0; }

  /** The closest point of the surface; null where there is none within `most`. */
  closestPoint(x: number, y: number, z: number, most = Infinity): SurfaceHit | null {
    return this.queries.closestPoint(this.at, x, y, z, most);
  }
  /** The first point on a ray; null where there is none. */
  firstHit(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number): SurfaceHit | null {
    return this.queries.firstHit(this.at, ox, oy, oz, dx, dy, dz);
  }
  /** The smooth closest point, of a target with its embedding; the closest point where there is none. */
  smoothClosestPoint(x: number, y: number, z: number): SurfaceHit | null {
    return this.queries.smoothClosestPoint(this.at, x, y, z);
  }
}

/** Of a technique: what another instance of the core must know of it. */
export interface OwnLayout { name: string; values: number; memory: number }

/** A registered technique with the arrays that its steps use: they are the facade's, so that no growth of the memory makes them stale. */
class Row implements TechniqueStep {
  readonly target: StepTarget;
  readonly frame = new Float64Array(kFrameSize);
  readonly options: Float64Array;
  readonly memory: Float64Array;
  metresPerUnit = 1;
  private face = -1;
  private readonly barycentric = new Float64Array(3);

  constructor(private readonly m: Module, readonly own: OwnTechnique, readonly layout: OwnLayout) {
    this.target = new StepTarget(m, layout.name);
    this.options = new Float64Array(layout.values);
    this.memory = new Float64Array(layout.memory);
  }

  found(how: Answer, { face, barycentric }: { readonly face: number; readonly barycentric: ArrayLike<number> }): Answer {
    this.face = face;
    for (let k = 0; k < 3; k += 1) this.barycentric[k] = barycentric[k]!;
    return how;
  }

  /** Makes no objects. May throw anything. */
  run(target: Pointer, frame: Pointer, metresPerUnit: number, options: Pointer, memory: Pointer, point: Pointer): number {
    this.read(this.frame, frame);
    this.read(this.options, options);
    this.read(this.memory, memory);
    this.metresPerUnit = metresPerUnit;
    this.face = -1;
    this.target.pointer = target;
    let given: unknown;
    try {
      given = this.own.step(this);
    } finally {
      this.target.pointer = 0;
    }
    const answer = given === null ? kNoPoint : kAnswers.indexOf(given as Answer) + 1;
    if (given !== null && answer === kNoPoint) throw new Error(`its step gave ${spoken(given)}; give what found() gave (one of ${kAnswers.join(', ')}), or null for no point`);
    // The memory may have grown: its views are looked up again.
    const h = this.m.HEAPF64;
    for (let i = 0; i < this.memory.length; i += 1) h[(memory >> 3) + i] = this.memory[i]!;
    for (let k = 0; k < 3; k += 1) h[(point >> 3) + 6 + k] = this.barycentric[k]!;
    // Numbers that are no face's stay so.
    this.m.HEAP32[(point >> 2) + 20] = Number.isInteger(this.face) && Math.abs(this.face) < 2 ** 31 ? this.face : -1;
    return answer;
  }

  private read(to: Float64Array, from: Pointer): void {
    const h = this.m.HEAPF64;
    for (let i = 0; i < to.length; i += 1) to[i] = h[(from >> 3) + i]!;
  }
}

function spoken(value: unknown): string {
  return typeof value === 'string' ? `'${value}'` : typeof value === 'object' ? `an object (${Object.prototype.toString.call(value).slice(8, -1)})` : String(value);
}

/** The techniques of JavaScript that one module knows. */
export class OwnTechniques {
  private readonly rows: (Row | undefined)[] = [];
  private readonly layouts: OwnLayout[] = [];
  /** Of the module whose functions a received memory uses. */
  private from: OwnTechniques | undefined;

  constructor(private readonly m: Module) {}

  get names(): readonly OwnLayout[] { return this.layouts; }

  register(own: OwnTechnique): void {
    if (typeof own !== 'object' || own === null) throw new MimicryError('invalid_input', 'a technique must be an object with a name and a step');
    const name = givenText(own.name, "a technique's name");
    if (typeof own.step !== 'function') throw new MimicryError('invalid_input', `technique '${name}': its step must be a function`);
    const memory = givenCount(own.memory ?? 0, `technique '${name}': its memory`);
    if (memory < 0) throw new MimicryError('invalid_input', `technique '${name}': its memory must not be below 0`);
    const options = givenList(own.options ?? [], `technique '${name}': its options`);
    calling(this.m, (args) => check(this.m, this.m._mimicry_wasm_technique_register(this.put(args, own, options, memory))));
    this.add(own, { name, values: options.reduce((sum, { kind }) => sum + (kind === 'direction' ? 3 : 1), 0), memory });
  }

  /** Of a memory that was handed over, whose techniques have these numbers; the functions are those of another module. */
  adopt(layouts: readonly OwnLayout[], from: OwnTechniques | undefined): void {
    for (const layout of layouts) {
      const row = from?.rows.find((theirs) => theirs?.layout.name === layout.name);
      const fits = row && row.layout.values === layout.values && row.layout.memory === layout.memory;
      this.add(fits ? row.own : undefined, layout);
    }
    this.from = from;
  }

  /** Before a technique is used: takes over one that the other module has, refuses one that is in this memory without its function. */
  require(technique: string): void {
    const number = this.layouts.findIndex(({ name }) => name === technique);
    const other = number < 0 ? this.from?.rows.find((row) => row?.layout.name === technique) : undefined;
    if (other) this.register(other.own);
    if (number >= 0 && !this.rows[number])
      throw new MimicryError('invalid_input', `technique '${technique}' was registered in another thread; register it here too, with the same options, and give this Mimicry to receive()`);
  }

  /** What the code calls. Nothing may be thrown through it: its stack would not be unwound. */
  readonly step = (number: number, target: Pointer, frame: Pointer, metresPerUnit: number, options: Pointer, memory: Pointer, point: Pointer): number => {
    const steps = stepsOf(this.m);
    const row = this.rows[number];
    if (!row || steps.failure) return kNoPoint;
    steps.running = row.layout.name;
    try {
      return row.run(target, frame, metresPerUnit, options, memory, point);
    } catch (error) {
      steps.failure = new MimicryError('failed', `technique '${row.layout.name}': ${messageOf(error)}`, { cause: error });
      return kNoPoint;
    } finally {
      steps.running = '';
    }
  };

  private add(own: OwnTechnique | undefined, layout: OwnLayout): void {
    this.layouts.push(layout);
    this.rows.push(own && new Row(this.m, own, layout));
  }

  /** A mimicry_own_technique. */
  private put(args: Arguments, own: OwnTechnique, options: readonly OwnOption[], memory: number): Pointer {
    const what = `technique '${own.name}'`;
    const color = own.color ?? '#000000';
    if (!/^#[0-9a-f]{6}$/i.test(color)) throw new MimicryError('invalid_input', `${what}: its color must be '#rrggbb', not ${spoken(color)}`);
    const steering = own.steering ?? 'moved';
    if (steering !== 'aimed' && steering !== 'moved') throw new MimicryError('invalid_input', `${what}: its steering must be 'aimed' or 'moved', not ${spoken(steering)}`);
    const text = (value: string | undefined, part: string) => args.put(givenText(value ?? '', `${what}: its ${part}`));
    const row = Uint32Array.of(
      text(own.name, 'name'), text(own.title, 'title'), text(own.sentence, 'sentence'), text(own.description, 'description'),
      this.putOptions(args, options, what), options.length,
      parseInt(color.slice(1), 16), steering === 'aimed' ? 0 : 1, own.anchored ? 1 : 0, own.needsBake ? 1 : 0,
      givenCount(own.rank ?? 100, `${what}: its rank`), 8 * memory, 0, this.rows.length);
    return args.put(new Uint8Array(row.buffer));
  }

  /** An array of mimicry_option_info. */
  private putOptions(args: Arguments, options: readonly OwnOption[], of: string): Pointer {
    const at = args.room(kOptionBytes * options.length);
    options.forEach((option, i) => {
      const name = givenText(option?.name, `${of}: an option's name`);
      const what = `${of}: option '${name}'`;
      const kind = kOptionKinds.indexOf(option.kind);
      if (kind < 0) throw new MimicryError('invalid_input', `${what}: its kind must be one of ${kOptionKinds.join(', ')}, not ${spoken(option.kind)}`);
      const { defaults, lowest, highest, choices } = numbersOf(option, what);
      const texts = [name, option.unit ?? '', option.description ?? ''].map((t) => args.put(givenText(t, `${what}: its texts`)));
      const names = choices.map((choice) => args.put(givenText(choice, `${what}: a choice`)));
      const list = args.put(Int32Array.from(names));
      // Looked up last: what was put may have let the memory grow.
      const word = (at + kOptionBytes * i) >> 2;
      this.m.HEAPU32.set([...texts, kind, 0, names.length, list, 0], word);
      this.m.HEAPF64.set([...defaults, lowest, highest], (word >> 1) + 4);
    });
    return at;
  }
}

/** In C's words: three defaults, of which other kinds use the first. */
function numbersOf(option: OwnOption, what: string): { defaults: number[]; lowest: number; highest: number; choices: readonly string[] } {
  const number = (value: unknown, part: string): number => {
    if (typeof value !== 'number') throw new MimicryError('invalid_input', `${what}: its ${part} must be a number, not ${spoken(value)}`);
    return value;
  };
  switch (option.kind) {
    case 'boolean': return { defaults: [option.default ? 1 : 0, 0, 0], lowest: 0, highest: 1, choices: [] };
    case 'number':
      return { defaults: [number(option.default, 'default'), 0, 0], lowest: number(option.lowest, 'lowest'), highest: number(option.highest, 'highest'), choices: [] };
    case 'direction':
      return { defaults: [...givenNumbers(option.default, `${what}: its default`, { count: 3 })], lowest: number(option.lowest ?? -1, 'lowest'), highest: number(option.highest ?? 1, 'highest'), choices: [] };
    case 'choice': {
      const choices = givenList(option.choices, `${what}: its choices`);
      const chosen = option.default === undefined ? 0 : choices.indexOf(option.default);
      if (chosen < 0) throw new MimicryError('invalid_input', `${what}: its default ${spoken(option.default)} is none of its choices (${choices.join(', ')})`);
      return { defaults: [chosen, 0, 0], lowest: 0, highest: choices.length - 1, choices };
    }
  }
}

const ofModules = new WeakMap<Module, OwnTechniques>();

export function ownTechniques(m: Module): OwnTechniques {
  return ofModules.get(m)!;
}

/** A core, with room for techniques of JavaScript. code: a `WebAssembly.Module`. */
export async function startCore(factory: Factory, code: object): Promise<Module> {
  let own: OwnTechniques | undefined;
  const m = await instantiate(factory, code, {
    onTechniqueStep: (number, target, frame, metresPerUnit, options, memory, point) => own!.step(number, target, frame, metresPerUnit, options, memory, point),
  });
  own = new OwnTechniques(m);
  ofModules.set(m, own);
  return m;
}
