import type { Pointer } from './exports.js';
import { check, type Module } from './module.js';
import { kSurfacePointBytes } from './surface_points.js';

/** A point on a target, model space; one object that the target's next query writes over. */
export interface SurfaceHit {
  readonly position: Float64Array;
  /** Unit, interpolated between the vertices. */
  readonly normal: Float64Array;
  readonly barycentric: Float64Array;
  /** From the query; of a ray along its direction. */
  distance: number;
  face: number;
}

// A query's two vectors, then a mimicry_surface_point of ten doubles and two integers.
const kQueryBytes = 6 * 8;

/** Queries for one point, which make no objects: numbers go through one place in the module's memory, and come back in one object. */
export class PointQueries {
  private readonly room: Pointer;
  private readonly hit = { position: new Float64Array(3), normal: new Float64Array(3), barycentric: new Float64Array(3), distance: 0, face: -1 };
  private hint = -1;

  constructor(private readonly m: Module) {
    this.room = m._malloc(kQueryBytes + kSurfacePointBytes);
  }

  free(): void {
    this.m._free(this.room);
  }

  closestPoint(target: Pointer, x: number, y: number, z: number, most: number): SurfaceHit | null {
    this.ask(x, y, z);
    check(this.m, this.m._mimicry_target_closest_point(target, this.room, most, this.hint, this.room + kQueryBytes));
    const found = this.found();
    if (found) this.hint = found.face;
    return found;
  }

  firstHit(target: Pointer, ox: number, oy: number, oz: number, dx: number, dy: number, dz: number): SurfaceHit | null {
    this.ask(ox, oy, oz);
    const q = this.room >> 3;
    const h = this.m.HEAPF64;
    h[q + 3] = dx; h[q + 4] = dy; h[q + 5] = dz;
    check(this.m, this.m._mimicry_target_first_hit(target, this.room, this.room + 24, this.room + kQueryBytes));
    return this.found();
  }

  smoothClosestPoint(target: Pointer, x: number, y: number, z: number): SurfaceHit | null {
    this.ask(x, y, z);
    check(this.m, this.m._mimicry_target_smooth_closest_points(target, this.room, 1, 0, this.room + kQueryBytes, 0));
    return this.found();
  }

  private ask(x: number, y: number, z: number): void {
    const q = this.room >> 3;
    const h = this.m.HEAPF64;
    h[q] = x; h[q + 1] = y; h[q + 2] = z;
  }

  private found(): SurfaceHit | null {
    const at = this.room + kQueryBytes;
    const d = at >> 3;
    const h = this.m.HEAPF64;
    const hit = this.hit;
    hit.face = this.m.HEAP32[(at >> 2) + 20]!;
    if (hit.face < 0) return null;
    for (let k = 0; k < 3; k += 1) {
      hit.position[k] = h[d + k]!;
      hit.normal[k] = h[d + 3 + k]!;
      hit.barycentric[k] = h[d + 6 + k]!;
    }
    hit.distance = h[d + 9]!;
    return hit;
  }
}
