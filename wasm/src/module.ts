import { messageOf, MimicryError, type Status } from './error.js';
import type { Exports, Pointer } from './exports.js';
import type { Bytes, CompiledModule, Doubles, Integers } from './types.js';

/** Emscripten's module. Its views are new objects after memory has grown: they are looked up at each use. */
export interface Module extends Exports {
  HEAPU8: Bytes;
  HEAP32: Integers;
  HEAPU32: ReturnType<typeof Uint32Array.of>;
  HEAPF32: ReturnType<typeof Float32Array.of>;
  HEAPF64: Doubles;
  _malloc(size: number): Pointer;
  _free(pointer: Pointer): void;
}

export interface ModuleHooks {
  instantiateWasm(imports: any, done: (instance: any) => void): object;
  onBakeProgress?(stage: string, fraction: number): number;
  onTechniqueStep?(number: number, target: Pointer, frame: Pointer, metresPerUnit: number, options: Pointer, memory: Pointer, point: Pointer): number;
}

/** What emscripten's glue exports. */
export type Factory = (hooks: ModuleHooks) => Promise<Module>;

const kStatus: readonly Status[] = ['failed', 'invalid_input', 'io', 'unsupported', 'cancelled', 'out_of_memory', 'failed'];

/** A module ready for use. code: a `WebAssembly.Module`. */
export async function instantiate(factory: Factory, code: object, calls: Omit<ModuleHooks, 'instantiateWasm'> = {}): Promise<Module> {
  return new Promise<Module>((resolve, reject) => {
    const refuse = (error: unknown) => reject(error instanceof RangeError
      ? new MimicryError('out_of_memory', `there is no memory left to start WebAssembly (${messageOf(error)}); close other pages`)
      : new MimicryError('failed', `WebAssembly could not be started: ${messageOf(error)}`));
    const hooks: ModuleHooks = {
      ...calls,
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(code as WebAssembly.Module, imports).then(done, refuse);
        return {};
      },
    };
    factory(hooks).then((m) => {
      codes.set(m, code);
      ofModules.set(m, { running: '', failure: null });
      resolve(m);
    }, refuse);
  });
}

const codes = new WeakMap<Module, object>();

/** The compiled code that a module runs. */
export function codeOf(m: Module): CompiledModule {
  return codes.get(m) as CompiledModule;
}

/** Of a module's calls of techniques of JavaScript: whose step is running, '' for none, and what one threw. */
export interface Steps { running: string; failure: MimicryError | null }
const ofModules = new WeakMap<Module, Steps>();

export function stepsOf(m: Module): Steps {
  return ofModules.get(m)!;
}

/** In a step the code is in the middle of a frame: what it uses then must not go, move or be entered again. */
export function requireNoStep(m: Module, what: string): void {
  const { running } = stepsOf(m);
  if (running !== '') throw new MimicryError('invalid_input', `${what} while a step of technique '${running}' runs; do it after the session's call`);
}

/** What a step threw since the last call of this. */
export function takeFailure(m: Module): MimicryError | null {
  const steps = stepsOf(m);
  const { failure } = steps;
  steps.failure = null;
  return failure;
}

const kDecoder = new TextDecoder();
const kEncoder = new TextEncoder();

/** The text at an address, up to its 0. */
export function textAt(m: Module, pointer: Pointer): string {
  if (pointer === 0) return '';
  return kDecoder.decode(m.HEAPU8.subarray(pointer, m.HEAPU8.indexOf(0, pointer)));
}

export function check(m: Module, status: number): void {
  if (status === 0) return;
  // Functions of the C interface by their names here.
  const message = textAt(m, m._mimicry_last_error()).replace('(mimicry_bake)', "with bake() of 'mimicry/bake'").replace('(mimicry_target_with_embedding)', 'with target.withEmbedding()');
  throw new MimicryError(kStatus[status] ?? 'failed', message);
}

type Put = Uint8Array | Float64Array | Int32Array | string;

/** Memory for the arguments of one call, given back by `end`. */
export class Arguments {
  private readonly held: Pointer[] = [];
  constructor(private readonly m: Module) {}

  room(bytes: number): Pointer {
    const pointer = this.m._malloc(Math.max(bytes, 8));
    if (pointer === 0) throw new MimicryError('out_of_memory', `there is no memory left for ${bytes} bytes; use a smaller file or close something else`);
    this.held.push(pointer);
    return pointer;
  }

  put(data: Put): Pointer {
    const bytes = typeof data === 'string' ? kEncoder.encode(data + '\0') : new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
    const pointer = this.room(bytes.length);
    this.m.HEAPU8.set(bytes, pointer);
    return pointer;
  }

  end(): void {
    for (const pointer of this.held) this.m._free(pointer);
  }
}

/** Runs a call with its arguments in memory. */
export function calling<T>(m: Module, body: (args: Arguments) => T): T {
  const args = new Arguments(m);
  try {
    return body(args);
  } finally {
    args.end();
  }
}

/** The object that a call makes through its last argument. */
export function made(m: Module, call: (args: Arguments, out: Pointer) => number): Pointer {
  return calling(m, (args) => {
    const out = args.room(4);
    check(m, call(args, out));
    return m.HEAPU32[out >> 2]!;
  });
}

/** The content of a mimicry_bytes, copied; the object is destroyed. */
export function takeBytes(m: Module, bytes: Pointer): Bytes {
  const data = m._mimicry_bytes_data(bytes);
  const copy = m.HEAPU8.slice(data, data + m._mimicry_bytes_size(bytes));
  m._mimicry_bytes_destroy(bytes);
  return copy;
}

/** Something in the module's memory that is given back once. */
export abstract class Handle {
  /** kind: for messages; names of classes do not outlive minifiers. */
  constructor(protected m: Module, private pointer: Pointer, private readonly kind: string) {}

  /** @internal */
  get at(): Pointer {
    if (this.pointer === 0) throw new MimicryError('disposed', `a ${this.kind} was used after dispose()`);
    return this.pointer;
  }

  /** @internal Where it is in a core's memory. */
  addressIn(m: Module): Pointer {
    if (this.m !== m) throw new MimicryError('invalid_input', `a ${this.kind} of another Mimicry was given; use one Mimicry for all that belongs together`);
    return this.at;
  }

  /** Gives its memory back; a second time does nothing. Must not be used afterwards. */
  dispose(): void {
    if (this.pointer === 0) return;
    requireNoStep(this.m, `a ${this.kind} was given back`);
    this.destroy(this.pointer);
    this.pointer = 0;
  }

  /** @internal Each is what the other was. */
  protected exchange(other: Handle): void {
    [this.m, other.m] = [other.m, this.m];
    [this.pointer, other.pointer] = [other.pointer, this.pointer];
  }

  protected abstract destroy(pointer: Pointer): void;
}
