import { textAt, type Module } from './module.js';

export interface TechniqueOption {
  name: string;
  unit: string;
  description: string;
  /** One number, or the 3 of a vector. */
  defaults: readonly number[];
  /** Of each number. */
  lowest: number;
  highest: number;
}

export interface TechniqueInfo {
  name: string;
  /** One line. */
  description: string;
  /** Section or equation of the paper. */
  source: string;
  /** Looks at the last point too, not at the frame alone. */
  anchored: boolean;
  /** Needs a target with its embedding. */
  needsBake: boolean;
  options: readonly TechniqueOption[];
}

// Bytes of mimicry_option_info.
const kOptionBytes = 64;

function option(m: Module, at: number): TechniqueOption {
  const word = at >> 2;
  const double = (at >> 3) + 3;
  return {
    name: textAt(m, m.HEAPU32[word]!),
    unit: textAt(m, m.HEAPU32[word + 1]!),
    description: textAt(m, m.HEAPU32[word + 2]!),
    defaults: Array.from(m.HEAPF64.subarray(double, double + m.HEAP32[word + 3]!)),
    lowest: m.HEAPF64[double + 3]!,
    highest: m.HEAPF64[double + 4]!,
  };
}

export function techniqueList(m: Module): TechniqueInfo[] {
  return Array.from({ length: m._mimicry_technique_count() }, (_, i) => {
    const word = m._mimicry_technique(i) >> 2;
    const options = m.HEAPU32[word + 6]!;
    return {
      name: textAt(m, m.HEAPU32[word]!),
      description: textAt(m, m.HEAPU32[word + 1]!),
      source: textAt(m, m.HEAPU32[word + 2]!),
      anchored: m.HEAP32[word + 3] !== 0,
      needsBake: m.HEAP32[word + 4] !== 0,
      options: Array.from({ length: m.HEAP32[word + 5]! }, (_unused, k) => option(m, options + k * kOptionBytes)),
    };
  });
}
