// What callers give, as the core takes it. What has another type but one meaning is converted; the rest is an error that names it.
import { MimicryError } from './error.js';

function refused(what: string, wanted: string, value: unknown): MimicryError {
  const length = (value as { length?: unknown } | null | undefined)?.length;
  const got = typeof value === 'string' ? JSON.stringify(value.slice(0, 40))
    : typeof value === 'object' && value !== null ? (typeof length === 'number' ? `${length} of them` : Object.prototype.toString.call(value).slice(8, -1))
    : String(value);
  return new MimicryError('invalid_input', `${what} must be ${wanted}, not ${got}`);
}

export function givenText(value: unknown, what: string): string {
  if (typeof value !== 'string') throw refused(what, 'a text', value);
  return value;
}

/** A number that counts. */
export function givenCount(value: unknown, what: string): number {
  if (!Number.isInteger(value) || Math.abs(value as number) >= 2 ** 31) throw refused(what, 'a whole number', value);
  return value as number;
}

export function givenBytes(value: unknown, what: string): Uint8Array {
  if (value instanceof Uint8Array) return value;
  if (value instanceof ArrayBuffer) return new Uint8Array(value);
  if (value instanceof DataView) return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  throw refused(what, 'bytes (a Uint8Array or an ArrayBuffer)', value);
}

export function givenList<T>(value: readonly T[], what: string): readonly T[] {
  if (!Array.isArray(value)) throw refused(what, 'an array', value);
  return value;
}

/** Any array of numbers. count: how many; per: of how many there must be a multiple. */
export function givenNumbers(value: ArrayLike<number>, what: string, { count, per }: { count?: number; per?: number } = {}): Float64Array {
  const wanted = count !== undefined ? `${count} numbers` : per !== undefined ? `${per} numbers each` : 'an array of numbers';
  const length = typeof value === 'object' ? value?.length : undefined;
  if (typeof length !== 'number' || (count !== undefined && length !== count) || (per !== undefined && length % per !== 0)) throw refused(what, wanted, value);
  return value instanceof Float64Array ? value : Float64Array.from(value);
}
