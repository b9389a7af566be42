import type { Core, MeshArrays, MeshReport, Target } from './core';
import { creasedCorners } from './creased';
import type { LoadedModel, ModelSource } from './loaded_model';
import { guessTurn, kAsIs } from './up_axis';

/** Faces that meet at more than this are shown with an edge. */
const kCrease_rad = (38 / 180) * Math.PI;

/** Larger files are refused before they are read. */
export const kMostFileBytes = 600e6;

/** The target of a mesh. Throws an Error with a sentence where it cannot be drawn on. */
export function makeTarget(core: Core, mesh: MeshArrays, name: string): Target {
  if (mesh.faces.length === 0) throw new Error(`${name}: there are no triangles in it; export the model as a triangle mesh`);
  try {
    return core.createTarget(mesh, name);
  } catch (error) {
    complain(core.validate(mesh), name);
    throw error;
  }
}

/** What is wrong, as people say it. */
function complain(report: MeshReport, name: string): void {
  if (report.invalidVertices > 0) {
    throw new Error(`${name}: ${count(report.invalidVertices, 'vertex has', 'vertices have')} coordinates that are not finite numbers; repair the mesh in a modelling program and export it again`);
  }
  if (!(report.diagonal > 0)) throw new Error(`${name}: all its vertices are in one place; export the model again`);
}

/** A mesh ready to be shown. */
export function prepareModel(target: Target, mesh: MeshArrays, source: ModelSource): LoadedModel {
  return {
    name: target.name, source, mesh, made: { target, curves: [], unusable: null }, corners: creasedCorners(mesh.positions, mesh.faces, kCrease_rad),
    turn: 'file' in source ? guessTurn(mesh, source.file) : kAsIs, remarks: remarks(target.report),
  };
}

export function shapeModel(core: Core, shape: string): LoadedModel {
  const mesh = core.shape(shape);
  return prepareModel(makeTarget(core, mesh, shape), mesh, { shape });
}

function remarks(report: MeshReport): string[] {
  const list: string[] = [];
  if (report.degenerateFaces > 0) list.push(`${count(report.degenerateFaces, 'face has', 'faces have')} no area.`);
  if (report.components > 1) list.push(`${report.components.toLocaleString('en')} separate parts: ink stays on the part that it starts on.`);
  return list;
}

function count(n: number, one: string, many: string): string {
  return `${n.toLocaleString('en')} ${n === 1 ? one : many}`;
}
