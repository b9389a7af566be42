// Many points of a surface at once, as typed arrays.
import { MimicryError } from './error.js';
import { givenNumbers } from './given.js';
import type { Pointer } from './exports.js';
import type { Arguments, Module } from './module.js';

/** Where points are on a mesh: of each a face, and barycentric coordinates of its three corners. */
export interface SurfacePlaces {
  faces: ArrayLike<number>;
  /** 3 a point. */
  barycentrics: ArrayLike<number>;
}

/** What a query for many points found, in the order asked; face -1 where there is none. */
export interface SurfacePoints extends SurfacePlaces {
  faces: Int32Array;
  barycentrics: Float64Array;
  /** 3 a point, model space. */
  positions: Float64Array;
  /** Unit, 3 a point. */
  normals: Float64Array;
  /** From the query; of a ray along its direction. */
  distances: Float64Array;
}

// A mimicry_surface_point: ten doubles and two integers.
const kDoubles = 11;
export const kSurfacePointBytes = 8 * kDoubles;

export function pointsAt(m: Module, at: Pointer, count: number): SurfacePoints {
  const points: SurfacePoints = {
    faces: new Int32Array(count),
    barycentrics: new Float64Array(3 * count),
    positions: new Float64Array(3 * count),
    normals: new Float64Array(3 * count),
    distances: new Float64Array(count),
  };
  for (let i = 0; i < count; i += 1) {
    const d = (at >> 3) + kDoubles * i;
    const h = m.HEAPF64;
    points.positions.set(h.subarray(d, d + 3), 3 * i);
    points.normals.set(h.subarray(d + 3, d + 6), 3 * i);
    points.barycentrics.set(h.subarray(d + 6, d + 9), 3 * i);
    points.distances[i] = h[d + 9]!;
    points.faces[i] = m.HEAP32[2 * (d + 10)]!;
  }
  return points;
}

/** Puts places where a call reads them; how many there are. */
export function putPlaces(m: Module, args: Arguments, places: SurfacePlaces, what: string): { at: Pointer; count: number } {
  const faces = givenNumbers(places?.faces, `the faces of ${what}`);
  const count = faces.length;
  const barycentrics = givenNumbers(places.barycentrics, `the barycentrics of ${what}`, { count: 3 * count });
  if (!faces.every(Number.isInteger)) throw new MimicryError('invalid_input', `the faces of ${what} must be whole numbers`);
  const at = args.room(kSurfacePointBytes * count);
  for (let i = 0; i < count; i += 1) {
    const d = (at >> 3) + kDoubles * i;
    m.HEAPF64.fill(0, d, d + kDoubles);
    m.HEAPF64.set(barycentrics.subarray(3 * i, 3 * i + 3), d + 6);
    m.HEAP32[2 * (d + 10)] = faces[i]!;
  }
  return { at, count };
}
