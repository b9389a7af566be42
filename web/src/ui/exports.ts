import type { CurveFormat } from '../engine/core';

/** The formats that curves are exported in. */
export const kExports: readonly { format: CurveFormat; title: string; what: string }[] = [
  { format: 'json', title: 'Curves, JSON', what: 'with edge crossings' },
  { format: 'glb', title: 'Scene, GLB', what: 'model and tubes in colour' },
  { format: 'obj', title: 'Polylines, OBJ', what: 'for modelling programs' },
  { format: 'ply', title: 'Tubes, PLY', what: 'with colours' },
  { format: 'csv', title: 'Table, CSV', what: 'a row a point' },
];
