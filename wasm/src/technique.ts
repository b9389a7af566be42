import { textAt, type Module } from './module.js';

/** What values an option takes: 0 or 1; a number from lowest to highest; three numbers, not all zero; the number of one of its choices. */
export type OptionKind = 'boolean' | 'number' | 'direction' | 'choice';

export interface TechniqueOption {
  name: string;
  unit: string;
  description: string;
  kind: OptionKind;
  /** One number, or the 3 of a direction. */
  defaults: readonly number[];
  /** Of each number. */
  lowest: number;
  highest: number;
  /** Names of a choice's values, in their order; empty for other kinds. */
  choices: readonly string[];
}

export interface TechniqueInfo {
  name: string;
  /** For people. */
  title: string;
  /** For someone who has never read of it. */
  sentence: string;
  /** One line, exact. */
  description: string;
  /** Section or equation of the paper. */
  source: string;
  /** Why a pen on a screen draws little with it; empty where it does not. */
  screenNote: string;
  /** Of its curves in documents and pictures: '#rrggbb'. */
  color: string;
  /** Whether people turn the wrist, as the point is where the controller points, or move the hand. */
  steering: 'aimed' | 'moved';
  /** Looks at the last point too, not at the frame alone. */
  anchored: boolean;
  /** Needs a target with its embedding. */
  needsBake: boolean;
  /** Those of lower rank are offered to people first. */
  rank: number;
  options: readonly TechniqueOption[];
}

// Bytes of mimicry_option_info.
export const kOptionBytes = 72;
export const kOptionKinds: readonly OptionKind[] = ['boolean', 'number', 'direction', 'choice'];

function option(m: Module, at: number): TechniqueOption {
  const word = at >> 2;
  const double = (at >> 3) + 4;
  const choices = m.HEAPU32[word + 6]! >> 2;
  return {
    name: textAt(m, m.HEAPU32[word]!),
    unit: textAt(m, m.HEAPU32[word + 1]!),
    description: textAt(m, m.HEAPU32[word + 2]!),
    kind: kOptionKinds[m.HEAP32[word + 3]!]!,
    defaults: Array.from(m.HEAPF64.subarray(double, double + m.HEAP32[word + 4]!)),
    lowest: m.HEAPF64[double + 3]!,
    highest: m.HEAPF64[double + 4]!,
    choices: Array.from({ length: m.HEAP32[word + 5]! }, (_, i) => textAt(m, m.HEAPU32[choices + i]!)),
  };
}

export function techniqueList(m: Module): TechniqueInfo[] {
  return Array.from({ length: m._mimicry_technique_count() }, (_, i) => {
    const word = m._mimicry_technique(i) >> 2;
    const text = (member: number) => textAt(m, m.HEAPU32[word + member]!);
    const options = m.HEAPU32[word + 12]!;
    return {
      name: text(0),
      title: text(1),
      sentence: text(2),
      description: text(3),
      source: text(4),
      screenNote: text(5),
      color: `#${m.HEAPU32[word + 6]!.toString(16).padStart(6, '0')}`,
      steering: m.HEAP32[word + 7] === 0 ? 'aimed' : 'moved',
      anchored: m.HEAP32[word + 8] !== 0,
      needsBake: m.HEAP32[word + 9] !== 0,
      rank: m.HEAP32[word + 10]!,
      options: Array.from({ length: m.HEAP32[word + 11]! }, (_unused, k) => option(m, options + k * kOptionBytes)),
    };
  });
}
