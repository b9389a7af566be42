import type { Pointer } from './exports.js';
import { calling, check, Handle, type Module } from './module.js';
import { putPlaces, type SurfacePlaces } from './surface_points.js';

export interface SurfacePath {
  /** Model units. */
  length: number;
  /** Number of the source that it starts at. */
  source: number;
  /** 3 a vertex, model space: the ends, and where it crosses an edge. */
  positions: Float64Array;
}

// A mimicry_path_point: position, t, half-edge and a word without use.
const kPathDoubles = 5;

/** Exact distances on a target's surface from the nearest of some points. Keeps its target alive. */
export class Geodesics extends Handle {
  /** @internal */
  constructor(m: Module, pointer: Pointer, private readonly vertexCount: number) {
    super(m, pointer, 'search for distances');
  }

  protected override destroy(pointer: Pointer): void {
    this.m._mimicry_geodesics_destroy(pointer);
  }

  /** False on meshes on which the search gave up: distances are upper bounds then. */
  get areExact(): boolean { return this.m._mimicry_geodesics_are_exact(this.at) !== 0; }

  /** Model units; Infinity where no source reaches a point. */
  distances(points: SurfacePlaces): Float64Array {
    return calling(this.m, (args) => {
      const { at, count } = putPlaces(this.m, args, points, 'the points');
      const out = args.room(8 * count);
      check(this.m, this.m._mimicry_geodesics_distances(this.at, at, count, out));
      return this.m.HEAPF64.slice(out >> 3, (out >> 3) + count);
    });
  }

  /** Of the mesh's vertices; Infinity also where no face uses one. */
  vertexDistances(): Float64Array {
    return calling(this.m, (args) => {
      const out = args.room(8 * this.vertexCount);
      check(this.m, this.m._mimicry_geodesics_vertex_distances(this.at, out, this.vertexCount));
      return this.m.HEAPF64.slice(out >> 3, (out >> 3) + this.vertexCount);
    });
  }

  /** The shortest path from the nearest source to a point; null where none reaches it. */
  path(face: number, barycentric: ArrayLike<number>): SurfacePath | null {
    const m = this.m;
    return calling(m, (args) => {
      const { at } = putPlaces(m, args, { faces: [face], barycentrics: barycentric }, "the path's end");
      const out = args.room(16);
      check(m, m._mimicry_geodesics_find_path(this.at, at, out, out + 8));
      const count = m._mimicry_geodesics_path_count(this.at);
      if (count === 0) return null;
      const positions = new Float64Array(3 * count);
      const first = m._mimicry_geodesics_path(this.at) >> 3;
      for (let i = 0; i < count; i += 1) {
        const from = first + kPathDoubles * i;
        positions.set(m.HEAPF64.subarray(from, from + 3), 3 * i);
      }
      return { length: m.HEAPF64[out >> 3]!, source: m.HEAP32[(out + 8) >> 2]!, positions };
    });
  }
}
