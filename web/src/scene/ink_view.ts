import { Group, Mesh, MeshStandardMaterial } from 'three';
import { kPressure, kFrameSize } from '../drawing/frame';
import { widthOfPressure, type Drawing, type DrawnCurve, type InkStyle } from '../drawing/document';
import type { Range } from '../drawing/kept';
import { Tube, type Ink, type Width } from './tube';

const kSides = 8;
/** Ink is raised by this part of its radius, so that a bit more than half of it shows. */
const kRaise = 0.25;

interface Shown {
  drawn: DrawnCurve | null; // null: it is being drawn
  tube: Tube;
  mesh: Mesh;
}

/** The tubes of a drawing, children of a model's group. Keeps what did not change. */
export class InkView {
  readonly group = new Group();
  private readonly shown = new Map<string, Shown>();
  private readonly live: (Shown & { width: Width })[] = [];
  private readonly materials = new Map<string, MeshStandardMaterial>();

  begin(copy: number, style: InkStyle, modelToWorld: Float64Array, width: Width): void {
    const { tube, mesh } = this.make(style, modelToWorld[7]!);
    this.live[copy] = { drawn: null, tube, mesh, width };
    this.group.add(mesh);
  }

  grow(copy: number, ink: Ink): void {
    const live = this.live[copy]!;
    live.tube.append(ink, live.width);
  }

  keep(copy: number, id: string): void {
    this.shown.set(id, this.live[copy]!);
    delete this.live[copy];
  }

  drop(): void {
    for (const live of this.live) if (live) this.remove(live);
    this.live.length = 0;
  }

  show(drawing: Drawing): void {
    const left = new Set(this.shown.keys());
    for (const drawn of drawing) {
      left.delete(drawn.id);
      const known = this.shown.get(drawn.id);
      if (known && (known.drawn === drawn || known.drawn === null)) {
        known.drawn = drawn;
        continue;
      }
      if (known) this.remove(known);
      this.shown.set(drawn.id, this.build(drawn));
    }
    for (const id of left) {
      this.remove(this.shown.get(id)!);
      this.shown.delete(id);
    }
  }

  /** The number of triangles, for measuring. */
  get triangles(): number {
    let sum = 0;
    for (const { tube } of this.shown.values()) sum += tube.geometry.drawRange.count / 3;
    return sum;
  }

  private build(drawn: DrawnCurve): Shown {
    const { tube, mesh } = this.make(drawn.style, drawn.stroke.modelToWorld[7]!);
    const { frames } = drawn.stroke;
    const width: Width = (frame, out) => {
      out[0] = widthOfPressure(frames[frame * kFrameSize + kPressure] ?? -1);
    };
    tube.append(drawn.curve.ink, width, isWhole(drawn) ? undefined : shownIn(drawn.kept));
    this.group.add(mesh);
    return { drawn, tube, mesh };
  }

  private make(style: InkStyle, scale: number): { tube: Tube; mesh: Mesh } {
    const radius = style.radius_m / scale;
    const tube = new Tube({ radius, lift: style.offset_m / scale + kRaise * radius, sides: kSides });
    return { tube, mesh: new Mesh(tube.geometry, this.material(style.color)) };
  }

  private material(color: string): MeshStandardMaterial {
    let material = this.materials.get(color);
    if (!material) {
      material = new MeshStandardMaterial({ color, roughness: 0.45, metalness: 0 });
      this.materials.set(color, material);
    }
    return material;
  }

  private remove(shown: Shown): void {
    this.group.remove(shown.mesh);
    shown.tube.dispose();
  }
}

function isWhole(drawn: DrawnCurve): boolean {
  const [range] = drawn.kept;
  return drawn.kept.length === 1 && range![0] === 0 && range![1] >= drawn.stroke.frames.length / kFrameSize - 1;
}

function shownIn(kept: readonly Range[]): (from: number, to: number) => boolean {
  return (from, to) => kept.some(([first, last]) => from >= first && to <= last);
}
