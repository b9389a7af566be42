/*
 * What a page that goes away could not write any more, for the next one. IndexedDB drops what is under way then;
 * localStorage is written at once.
 */

export interface LastWords {
  put: Map<string, unknown>;
  remove: string[]; // keys, and prefixes that end in `/`
}

const kKey = 'mimicry-last-words';
/** Characters; browsers give an origin some five million. A stroke takes a few thousand. */
const kMost = 3e6;

const kArrays = { Float64Array, Float32Array, Uint32Array, Int32Array, Uint8Array };
type Packed = { array: keyof typeof kArrays; bytes: string };

/** False where there is no room, or storage is denied. */
export function keepLastWords({ put, remove }: LastWords): boolean {
  let size = 0;
  const pack = (_key: string, value: unknown): unknown => {
    if (!ArrayBuffer.isView(value)) return value;
    size += value.byteLength;
    if (size > kMost / 2) throw new RangeError('there is no room');
    const name = value.constructor.name as Packed['array'];
    return { array: name, bytes: base64(new Uint8Array(value.buffer, value.byteOffset, value.byteLength)) } satisfies Packed;
  };
  try {
    const text = JSON.stringify({ put: [...put], remove }, pack);
    if (text.length > kMost) return false;
    localStorage.setItem(kKey, text);
    return true;
  } catch {
    return false;
  }
}

/** null: there are none, or they are damaged. */
export function lastWords(): LastWords | null {
  try {
    const text = localStorage.getItem(kKey);
    if (!text) return null;
    const { put, remove } = JSON.parse(text, unpack) as { put: [string, unknown][]; remove: string[] };
    return { put: new Map(put), remove };
  } catch {
    return null;
  }
}

export function forgetLastWords(): void {
  try {
    localStorage.removeItem(kKey);
  } catch {
    // Denied: there are none.
  }
}

function unpack(_key: string, value: unknown): unknown {
  const { array, bytes } = (value ?? {}) as Partial<Packed>;
  if (typeof bytes !== 'string' || !array || !(array in kArrays)) return value;
  return new kArrays[array](Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0)).buffer);
}

function base64(bytes: Uint8Array): string {
  let text = '';
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text);
}
