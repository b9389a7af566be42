import { Group, Mesh, MeshStandardMaterial } from 'three';
import { widthOfPressure, type Drawing, type DrawnCurve, type InkStyle, type Width } from '../drawing/document';
import { kPressure, kFrameSize } from '../drawing/frame';
import type { Range } from '../drawing/kept';
import type { Ink } from '../engine/core';
import { InkBatch, type InkPlace } from './ink_batch';
import { kRingSides, Tube } from './tube';

/** Ink is raised by this part of its radius, so that a bit more than half of it shows. */
const kRaise = 0.25;
/** Ink of a drawing that is opened is made for so long at a time. */
const kMost_ms = 12;

interface Shown {
  drawn: DrawnCurve | null; // null: it was being drawn a moment ago
  place: InkPlace;
}
interface Live {
  tube: Tube;
  mesh: Mesh<Tube['geometry'], MeshStandardMaterial>;
  width: Width;
  color: string;
}

/**
 * The ink of a drawing, a child of a model's group. What is being drawn is a tube of its own; what is finished lies with
 * all the rest in a few buffers. What did not change is kept.
 */
export class InkView {
  readonly group = new Group();
  private readonly batch: InkBatch;
  private readonly shown = new Map<string, Shown>();
  private readonly live = new Map<number, Live>();
  private readonly idle: Live[] = [];
  private drawing: Drawing = [];
  private next = 0; // of the drawing: those before it are shown
  private waiting = 0;

  /** onMore: ink came in later than it was asked for. */
  constructor(gl: WebGL2RenderingContext, private readonly onMore: () => void) {
    this.batch = new InkBatch(gl);
    this.group.add(this.batch.group);
  }

  /** One mesh for each material that ink will have. */
  samples(): Mesh[] {
    const live = this.tube({ color: '#000000', radius_m: 1, offset_m: 0 }, 1, () => undefined);
    this.idle.push(live);
    return [live.mesh, this.batch.sample()];
  }

  begin(copy: number, style: InkStyle, modelToWorld: Float64Array, width: Width): void {
    const live = this.tube(style, modelToWorld[7]!, width);
    this.live.set(copy, live);
    this.group.add(live.mesh);
  }

  grow(copy: number, ink: Ink): void {
    const live = this.live.get(copy)!;
    live.tube.append(ink, live.width);
  }

  keep(copy: number, id: string): void {
    const live = this.live.get(copy)!;
    this.shown.set(id, { drawn: null, place: this.batch.add(live.tube, live.color) });
    this.live.delete(copy);
    this.release(live);
  }

  drop(): void {
    for (const live of this.live.values()) this.release(live);
    this.live.clear();
  }

  show(drawing: Drawing): void {
    this.drawing = drawing;
    const left = new Set(this.shown.keys());
    for (const { id } of drawing) left.delete(id);
    for (const id of left) this.remove(id);
    this.next = 0;
    this.go();
  }

  /** The graphics card has lost everything. */
  renew(): void {
    this.batch.forget();
    this.shown.clear();
    this.show(this.drawing);
  }

  /** The number of triangles, for measuring. */
  get triangles(): number {
    let sum = 0;
    for (const { place } of this.shown.values()) sum += (place.count - 1) * kRingSides * 2;
    return sum;
  }

  /** Makes what is not shown yet; of a whole drawing a part now and the rest a little later. */
  private go(): void {
    clearTimeout(this.waiting);
    this.waiting = 0;
    const until = performance.now() + kMost_ms;
    for (; this.next < this.drawing.length; this.next += 1) {
      if (performance.now() > until) {
        this.waiting = window.setTimeout(() => {
          this.go();
          this.onMore();
        });
        return;
      }
      this.update(this.drawing[this.next]!);
    }
  }

  private update(drawn: DrawnCurve): void {
    const known = this.shown.get(drawn.id);
    if (known && (known.drawn === drawn || known.drawn === null)) {
      known.drawn = drawn;
      return;
    }
    if (known) this.remove(drawn.id);
    const { frames, modelToWorld } = drawn.stroke;
    const width: Width = (frame, out) => {
      out[0] = widthOfPressure(frames[frame * kFrameSize + kPressure] ?? -1);
    };
    const made = this.tube(drawn.style, modelToWorld[7]!, width);
    made.tube.append(drawn.curve.ink, width, isWhole(drawn) ? undefined : shownIn(drawn.kept));
    this.shown.set(drawn.id, { drawn, place: this.batch.add(made.tube, made.color) });
    this.release(made);
  }

  private tube({ color, radius_m, offset_m }: InkStyle, scale: number, width: Width): Live {
    const radius = radius_m / scale, lift = offset_m / scale + kRaise * radius;
    const live = this.idle.pop();
    if (!live) {
      const tube = new Tube({ radius, lift, sides: kRingSides });
      return { tube, mesh: new Mesh(tube.geometry, new MeshStandardMaterial({ color, roughness: 0.45, metalness: 0 })), width, color };
    }
    live.tube.restart(radius, lift);
    live.mesh.material.color.set(color);
    return Object.assign(live, { width, color });
  }

  private release(live: Live): void {
    this.group.remove(live.mesh);
    this.idle.push(live);
  }

  private remove(id: string): void {
    this.batch.remove(this.shown.get(id)!.place);
    this.shown.delete(id);
  }
}

function isWhole(drawn: DrawnCurve): boolean {
  const [range] = drawn.kept;
  return drawn.kept.length === 1 && range![0] === 0 && range![1] >= drawn.stroke.frames.length / kFrameSize - 1;
}

function shownIn(kept: readonly Range[]): (from: number, to: number) => boolean {
  return (from, to) => kept.some(([first, last]) => from >= first && to <= last);
}
