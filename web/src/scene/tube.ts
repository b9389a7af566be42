import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere, Vector3 } from 'three';
import type { Width } from '../drawing/document';
import { kInkFrame, kInkStarts, kInkStride, type Ink } from '../engine/core';

export interface TubeStyle {
  radius: number; // model units
  lift: number; // model units along the surface's normal
  sides: number;
}

/** Vertices of a ring of ink. */
export const kRingSides = 8;

const kFirstRings = 256;

/** Vertices nearer than this part of the radius to the last ring are passed over. */
const kLeastStep = 0.15;

/** One strip of triangles between consecutive rings serves all tubes; it only ever grows. */
const indexOfSides = new Map<number, BufferAttribute>();

function stripIndex(sides: number, rings: number): BufferAttribute {
  const known = indexOfSides.get(sides);
  if (known && known.count >= (rings - 1) * sides * 6) return known;
  const attribute = new BufferAttribute(stripFaces(sides, rings), 1);
  indexOfSides.set(sides, attribute);
  return attribute;
}

/** The triangles between consecutive rings. */
export function stripFaces(sides: number, rings: number): Uint32Array {
  const index = new Uint32Array((rings - 1) * sides * 6);
  let at = 0;
  for (let ring = 0; ring + 1 < rings; ring += 1) {
    for (let side = 0; side < sides; side += 1) {
      const a = ring * sides + side;
      const b = ring * sides + ((side + 1) % sides);
      index[at] = a; index[at + 1] = b; index[at + 2] = a + sides;
      index[at + 3] = b; index[at + 4] = b + sides; index[at + 5] = a + sides;
      at += 6;
    }
  }
  return index;
}

/**
 * A round tube that grows at its end. Rings turn with the curve without twist (parallel transport);
 * every part begins and ends in a rounded cap whose last ring has no radius, so that one strip of
 * triangles runs through all parts. Appending makes no garbage but where the memory doubles.
 */
export class Tube {
  readonly geometry = new BufferGeometry();
  private readonly cosines: Float32Array;
  private readonly sines: Float32Array;
  private position: BufferAttribute;
  private normal: BufferAttribute;
  private capacity = 0;
  private rings = 0; // that stay: without the cap at the growing end
  private taken = 0; // ink vertices
  private firstDirty = 0;

  // The last ring: centre, radius, tangent of its piece, and the transported side vector.
  private readonly centre = new Float64Array(3);
  private readonly tangent = new Float64Array(3);
  private readonly side = new Float64Array(3);
  private readonly next = new Float64Array(3);
  private readonly step = new Float64Array(3);
  private readonly radius = new Float64Array(1);
  private readonly width = new Float64Array(1);
  private open = false; // a part has begun
  private bare = true; // ... and has one point only: it has no direction yet
  private readonly limits = new Float64Array([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);

  constructor(private style: TubeStyle) {
    this.cosines = new Float32Array(style.sides);
    this.sines = new Float32Array(style.sides);
    for (let k = 0; k < style.sides; k += 1) {
      this.cosines[k] = Math.cos((2 * Math.PI * k) / style.sides);
      this.sines[k] = Math.sin((2 * Math.PI * k) / style.sides);
    }
    this.position = new BufferAttribute(new Float32Array(0), 3);
    this.normal = this.position;
    this.geometry.boundingSphere = new Sphere(new Vector3(), 0);
    this.reserve(kFirstRings);
    this.geometry.setDrawRange(0, 0);
  }

  /** Vertices of ink that were appended so far. */
  get inkCount(): number {
    return this.taken;
  }

  /** Rings that are shown; each is as many vertices as the tube has sides. */
  get ringCount(): number {
    return this.open ? this.drawn : this.rings;
  }

  /** 3 numbers a vertex of a ring; valid until the tube grows. */
  get positions(): Float32Array {
    return this.position.array as Float32Array;
  }
  get normals(): Float32Array {
    return this.normal.array as Float32Array;
  }

  dispose(): void {
    this.geometry.setIndex(null); // other tubes have the same
    this.geometry.dispose();
  }

  /** A new, empty tube in the same memory. */
  restart(radius: number, lift: number): void {
    this.style = { ...this.style, radius, lift };
    this.drawn = 0;
    this.rings = 0;
    this.taken = 0;
    this.firstDirty = 0;
    this.open = false;
    this.bare = true;
    this.limits.fill(Infinity, 0, 3).fill(-Infinity, 3);
    this.geometry.setDrawRange(0, 0);
  }

  /**
   * Appends ink vertices from the first that was not taken yet. `width` gives a frame's width, a
   * factor of the radius; `shown`, where given, says whether the piece between two frames is drawn.
   */
  append(ink: Ink, width: Width, shown?: (from: number, to: number) => boolean): void {
    if (ink.count <= this.taken) return;
    let before = this.taken > 0 ? ink.integers[(this.taken - 1) * kInkStride + kInkFrame]! : -1;
    let point = before; // frame of the last point: crossings bear the frame that they lead to
    if (shown) for (let i = this.taken - 1; i >= 0 && point === before; i -= 1) point = ink.integers[i * kInkStride + kInkFrame]!;
    for (let i = this.taken; i < ink.count; i += 1) {
      const at = i * kInkStride;
      const frame = ink.integers[at + kInkFrame]!;
      const starts = i === 0 || ink.integers[at + kInkStarts] !== 0;
      if (frame !== before) point = before;
      width(frame, this.width);
      const visible = !shown || (starts ? shown(frame, frame) : shown(point, frame));
      if (!visible) {
        // The piece to here is gone; it may be the start of what is left.
        this.close();
        const isPoint = i + 1 >= ink.count || ink.integers[at + kInkStride + kInkFrame] !== frame;
        if (shown(frame, frame) && isPoint) this.begin(ink.floats, at);
      } else if (starts) {
        this.close();
        this.begin(ink.floats, at);
      } else {
        this.extend(ink.floats, at);
      }
      before = frame;
    }
    this.taken = ink.count;
    this.upload();
  }

  private locate(out: Float64Array, floats: Float32Array, at: number): void {
    for (let k = 0; k < 3; k += 1) {
      out[k] = floats[at + k]! + this.style.lift * floats[at + 3 + k]!;
      if (out[k]! < this.limits[k]!) {
        this.limits[k] = out[k]!;
        this.grown = true;
      }
      if (out[k]! > this.limits[k + 3]!) {
        this.limits[k + 3] = out[k]!;
        this.grown = true;
      }
    }
  }

  private grown = false; // the limits have

  private bound(): void {
    const sphere = this.geometry.boundingSphere!, l = this.limits;
    sphere.center.set((l[0]! + l[3]!) / 2, (l[1]! + l[4]!) / 2, (l[2]! + l[5]!) / 2);
    sphere.radius = Math.hypot(l[3]! - l[0]!, l[4]! - l[1]!, l[5]! - l[2]!) / 2 + 2 * this.style.radius;
    this.grown = false;
  }

  private begin(floats: Float32Array, at: number): void {
    this.locate(this.centre, floats, at);
    this.radius[0] = this.style.radius * this.width[0]!;
    this.open = true;
    this.bare = true;
    // Until there is a direction a ball stands for the point, around the surface's normal.
    for (let k = 0; k < 3; k += 1) this.tangent[k] = floats[at + 3 + k]!;
    this.chooseSide();
    this.reserve(this.rings + 8);
    const kept = this.rings;
    this.startCap();
    this.ring(Tube.kBody);
    this.endCap();
    this.rings = kept; // rewritten as soon as there is a direction
    this.drawn = kept + 5;
  }

  private extend(floats: Float32Array, at: number): void {
    if (!this.open) {
      this.begin(floats, at);
      return;
    }
    this.locate(this.next, floats, at);
    let length = 0;
    for (let k = 0; k < 3; k += 1) {
      this.step[k] = this.next[k]! - this.centre[k]!;
      length += this.step[k]! * this.step[k]!;
    }
    length = Math.sqrt(length);
    if (!(length > kLeastStep * this.style.radius)) return;
    for (let k = 0; k < 3; k += 1) this.step[k] = this.step[k]! / length;
    this.reserve(this.rings + 8);
    if (this.bare) {
      this.tangent.set(this.step);
      this.chooseSide();
      this.startCap();
      this.ring(Tube.kBody);
      this.bare = false;
    } else {
      // The ring of the last point was made with its piece's direction; it now gets the bisector.
      this.rings -= 1;
      this.bisect();
      this.ring(Tube.kBody);
      this.follow();
    }
    this.centre.set(this.next);
    this.radius[0] = this.style.radius * this.width[0]!;
    this.ring(Tube.kBody);
    const kept = this.rings;
    this.endCap();
    this.rings = kept;
    this.drawn = kept + 2;
  }

  private drawn = 0;

  private close(): void {
    if (this.open) this.rings = this.drawn;
    this.open = false;
  }

  private chooseSide(): void {
    const x = Math.abs(this.tangent[0]!), y = Math.abs(this.tangent[1]!), z = Math.abs(this.tangent[2]!);
    this.side.fill(0);
    this.side[x <= y && x <= z ? 0 : y <= z ? 1 : 2] = 1;
    this.straighten();
  }

  /** Makes the side vector square to the tangent. */
  private straighten(): void {
    const s = this.side, t = this.tangent;
    const d = s[0]! * t[0]! + s[1]! * t[1]! + s[2]! * t[2]!;
    for (let k = 0; k < 3; k += 1) s[k] = s[k]! - d * t[k]!;
    const n = Math.sqrt(s[0]! * s[0]! + s[1]! * s[1]! + s[2]! * s[2]!); // Math.hypot makes garbage
    if (n < 1e-6) {
      this.chooseSide();
      return;
    }
    for (let k = 0; k < 3; k += 1) s[k] = s[k]! / n;
  }

  /** The tangent becomes the bisector of itself and the step. */
  private bisect(): void {
    let n = 0;
    for (let k = 0; k < 3; k += 1) {
      this.tangent[k] = this.tangent[k]! + this.step[k]!;
      n += this.tangent[k]! * this.tangent[k]!;
    }
    n = Math.sqrt(n);
    if (n < 1e-6) this.tangent.set(this.step);
    else for (let k = 0; k < 3; k += 1) this.tangent[k] = this.tangent[k]! / n;
    this.straighten();
  }

  private follow(): void {
    this.tangent.set(this.step);
    this.straighten();
  }

  // What `ring` is to make: how far along the tangent, its radius (both in radii), how the normals lean along the tangent.
  private readonly shape = new Float64Array(3);
  private static readonly kTip = new Float64Array([-1, 0, -1]);
  private static readonly kShoulder = new Float64Array([-Math.SQRT1_2, Math.SQRT1_2, -Math.SQRT1_2]);
  private static readonly kBody = new Float64Array([0, 1, 0]);

  private startCap(): void {
    this.ring(Tube.kTip);
    this.ring(Tube.kShoulder);
  }

  private endCap(): void {
    for (let k = 0; k < 3; k += 1) this.shape[k] = k === 1 ? Tube.kShoulder[k]! : -Tube.kShoulder[k]!;
    this.ring(this.shape);
    for (let k = 0; k < 3; k += 1) this.shape[k] = k === 1 ? Tube.kTip[k]! : -Tube.kTip[k]!;
    this.ring(this.shape);
  }

  private ring(shape: Float64Array): void {
    const s = this.side, t = this.tangent;
    const bx = t[1]! * s[2]! - t[2]! * s[1]!, by = t[2]! * s[0]! - t[0]! * s[2]!, bz = t[0]! * s[1]! - t[1]! * s[0]!;
    const lean = shape[2]!, out = Math.sqrt(Math.max(0, 1 - lean * lean));
    const r = this.radius[0]!, radius = r * shape[1]!, along = r * shape[0]!;
    const cx = this.centre[0]! + along * t[0]!, cy = this.centre[1]! + along * t[1]!, cz = this.centre[2]! + along * t[2]!;
    const positions = this.positions, normals = this.normals;
    let at = this.rings * this.style.sides * 3;
    if (this.rings < this.firstDirty) this.firstDirty = this.rings;
    for (let k = 0; k < this.style.sides; k += 1) {
      const c = this.cosines[k]!, d = this.sines[k]!;
      const nx = c * s[0]! + d * bx, ny = c * s[1]! + d * by, nz = c * s[2]! + d * bz;
      positions[at] = cx + radius * nx;
      positions[at + 1] = cy + radius * ny;
      positions[at + 2] = cz + radius * nz;
      normals[at] = out * nx + lean * t[0]!;
      normals[at + 1] = out * ny + lean * t[1]!;
      normals[at + 2] = out * nz + lean * t[2]!;
      at += 3;
    }
    this.rings += 1;
  }

  private reserve(rings: number): void {
    if (rings <= this.capacity) return;
    const capacity = Math.max(kFirstRings, this.capacity * 2, rings);
    const size = capacity * this.style.sides * 3;
    const positions = new Float32Array(size), normals = new Float32Array(size);
    if (this.capacity > 0) {
      positions.set(this.positions);
      normals.set(this.normals);
    }
    this.dispose(); // frees the old buffers; the geometry itself goes on
    this.position = new BufferAttribute(positions, 3).setUsage(DynamicDrawUsage);
    this.normal = new BufferAttribute(normals, 3).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute('position', this.position);
    this.geometry.setAttribute('normal', this.normal);
    this.geometry.setIndex(stripIndex(this.style.sides, capacity));
    this.capacity = capacity;
    this.firstDirty = 0;
  }

  private upload(): void {
    const end = this.ringCount;
    if (end > this.firstDirty) {
      const from = this.firstDirty * this.style.sides * 3;
      const count = (end - this.firstDirty) * this.style.sides * 3;
      this.mark(this.position, from, count);
      this.mark(this.normal, from, count);
    }
    this.firstDirty = Math.max(0, this.rings - 1);
    this.geometry.setDrawRange(0, Math.max(0, end - 1) * this.style.sides * 6);
    if (this.grown) this.bound();
  }

  /** What is to be sent to the graphics card; three.js empties the attribute's list when it has done so. */
  private readonly dirty = { start: 0, count: 0 };

  private mark(attribute: BufferAttribute, start: number, count: number): void {
    if (attribute.updateRanges.length > 0) {
      const end = Math.max(this.dirty.start + this.dirty.count, start + count);
      this.dirty.start = Math.min(this.dirty.start, start);
      this.dirty.count = end - this.dirty.start;
    } else {
      this.dirty.start = start;
      this.dirty.count = count;
      attribute.updateRanges.push(this.dirty);
    }
    attribute.needsUpdate = true;
  }
}
