/** What src/lab/report_data.cpp writes; all numbers are computed there. */
export interface Method {
  name: string;
  color: string;
}

export interface Measure {
  id: string;
  /** With the unit: "K_E (rad/m)". */
  title: string;
  /** The values of all methods and groups are positive: a logarithmic axis can show them. */
  positive: boolean;
}

/** 5th percentile, quartiles, 95th percentile and mean. */
export interface Box {
  measure: string;
  method: string;
  /** The task or the shape. */
  group: string;
  strokes: number;
  p5: number;
  q1: number;
  median: number;
  q3: number;
  p95: number;
  mean: number;
}

export interface Scatter {
  measure: string;
  /** One pair of strokes: x of method a, y of method b. */
  points: { x: number; y: number; task: string; stroke: string }[];
  /** log10 y = intercept + slope log10 x; null for fewer than three pairs. */
  line: { slope: number; intercept: number; r: number } | null;
}

export interface Data {
  methods: Method[];
  tasks: string[];
  shapes: string[];
  measures: Measure[];
  by_task: Box[];
  by_shape: Box[];
  scatter: { id: string; a: string; b: string; plots: Scatter[] }[];
}
