import type { Curve, MeshArrays, Target } from './core';
import type { Corners } from './creased';

/** Where a model came from, so that it can be had again. */
export type ModelSource = { shape: string } | { file: string; bytes: Uint8Array };

/** A model that was read and looked at in a worker. */
export interface LoadedModel {
  name: string;
  source: ModelSource;
  mesh: MeshArrays;
  corners: Corners;
  /** How it stands upright, by what its file or shape tells: a unit quaternion. */
  turn: readonly number[];
  /** What a user should know about the mesh, as sentences. */
  remarks: readonly string[];
  /** What is drawn on, and the curves that were kept with it (null: it cannot be read); why its bake is of no use, if so. */
  made: { target: Target; curves: readonly (Curve | null)[]; unusable: string | null };
}

export function shapeTitle(name: string): string {
  return name.charAt(0).toUpperCase() + name.slice(1).replaceAll('-', ' ');
}

export function modelTitle(source: ModelSource): string {
  return 'shape' in source ? shapeTitle(source.shape) : source.file;
}
