import { messageOf, MimicryError } from './error.js';
import { builtin, isNode } from './node.js';
import type { CompiledModule, ResponseLike, UrlLike, WasmContent, WasmSource } from './types.js';

/** One of the package's two WebAssembly files. */
export interface WasmFile {
  name: 'core.wasm' | 'bake.wasm';
  /** What its section `mimicry` says: the build that the code beside it belongs to. */
  build: string;
}

const remedy = ({ name }: WasmFile) =>
  `put ${name} of the package there, tell where it is (option wasm), or import 'mimicry/compat', which has it inside`;

/** Compiles what a source gives; its errors say what to do. */
export async function compiled(source: WasmSource, file: WasmFile): Promise<CompiledModule> {
  if (typeof WebAssembly === 'undefined')
    throw new MimicryError('unsupported', 'WebAssembly is switched off here (browsers do so in their lockdown modes); allow it for this page');
  const code = await fromContent(await source, file);
  const section = WebAssembly.Module.customSections(code, 'mimicry')[0];
  const build = section ? new TextDecoder().decode(section) : 'no build of mimicry';
  if (build !== file.build)
    throw new MimicryError('invalid_input', `what was given as ${file.name} is ${build}, the code belongs to ${file.build}; take both from one version of the package, and clear old copies from caches`);
  return code;
}

async function fromContent(content: WasmContent, file: WasmFile): Promise<WebAssembly.Module> {
  if (content instanceof WebAssembly.Module) return content;
  if (content instanceof ArrayBuffer || ArrayBuffer.isView(content)) return fromBytes(content as BufferSource, 'the bytes that were given', file);
  if (typeof content === 'string') return fromPlace(content, file);
  if (typeof (content as UrlLike | null)?.href === 'string') return fromPlace((content as UrlLike).href, file);
  if (typeof (content as ResponseLike | null)?.arrayBuffer === 'function') return arriving(content as ResponseLike, file);
  throw new MimicryError('invalid_input', `option wasm: ${String(content)} is no WebAssembly; give an address, a response of fetch, bytes or a compiled module`);
}

async function fromPlace(place: string, file: WasmFile): Promise<WebAssembly.Module> {
  // A letter and a colon is a drive of Windows.
  if (isNode && (place.startsWith('file:') || !/^[a-z][a-z0-9+.-]+:/i.test(place))) {
    const { readFile } = await builtin<typeof import('node:fs/promises')>('node:fs/promises');
    const bytes = await readFile(place.startsWith('file:') ? new URL(place) : place).catch((error: unknown) => {
      throw new MimicryError('io', `${place} cannot be read (${messageOf(error)}); ${remedy(file)}`);
    });
    return fromBytes(bytes, place, file);
  }
  const response = await fetch(place).catch((error: unknown) => {
    throw new MimicryError('io', `${place} cannot be loaded (${messageOf(error)}); look whether the server can be reached and lets this page in (connect-src of the page's Content-Security-Policy, CORS), or ${remedy(file)}`);
  });
  return arriving(response, file);
}

async function arriving(response: ResponseLike, file: WasmFile): Promise<WebAssembly.Module> {
  const place = response.url || 'the response that was given';
  if (!response.ok) throw new MimicryError('io', `${place}: the server answers ${response.status} ${response.statusText}`.trimEnd() + `; ${remedy(file)}`);
  // Compiling while it arrives needs the right content type; not every server sends it.
  if (response.headers.get('content-type') !== 'application/wasm' || !WebAssembly.compileStreaming)
    return fromBytes(await response.arrayBuffer(), place, file);
  return WebAssembly.compileStreaming(response as Response).catch((error: unknown) => {
    throw refused(error, place, file);
  });
}

async function fromBytes(bytes: BufferSource, place: string, file: WasmFile): Promise<WebAssembly.Module> {
  const view = ArrayBuffer.isView(bytes) ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength) : new Uint8Array(bytes);
  const start = String.fromCharCode(...view.subarray(0, 16));
  if (!start.startsWith('\0asm'))
    throw new MimicryError('invalid_input', `${place} is not WebAssembly: it begins with ${JSON.stringify(start)}`
      + `${/^\s*</.test(start) ? ', a page that a server sends for what it does not have' : ''}; ${remedy(file)}`);
  return WebAssembly.compile(bytes).catch((error: unknown) => {
    throw refused(error, place, file);
  });
}

/** Browsers have no type for a refusal by policy, only words. */
function refused(error: unknown, place: string, file: WasmFile): MimicryError {
  const message = messageOf(error);
  if (/content security policy|\bCSP\b|unsafe-eval|disallowed by embedder/i.test(message))
    return new MimicryError('unsupported', `the page's Content-Security-Policy forbids WebAssembly (${message}); add 'wasm-unsafe-eval' to its script-src`);
  if (error instanceof RangeError) return new MimicryError('out_of_memory', `there is no memory left to load ${file.name} (${message}); close other pages`);
  return new MimicryError('invalid_input', `${place} is damaged or not WebAssembly (${message}); ${remedy(file)}`);
}
