import { kInkStride, type Ink } from '../engine/core';
import { toWorld } from '../math/similarity';
import { rotate } from '../math/vec';
import type { Stage } from '../scene/stage';
import type { ThreeView } from '../scene/three_view';
import type { Studio } from '../studio/studio';

/** The smallest ring that is seen, metres. */
const kLeastRing_m = 0.006;

/** What is shown of the pen on a screen: its tip, and a ring where it draws or erases. */
export class PenMarks {
  private readonly spot = new Float64Array(3);
  private readonly normal = new Float64Array(3);

  constructor(private readonly stage: Stage, private readonly view3: ThreeView, private readonly studio: Studio) {}

  /** The tip (world; of radius 0 it is not shown) and the laser from it to the ink's end. */
  atInk(tip: Float64Array, tipRadius_m: number, ink: Ink | null): void {
    if (ink && ink.count > 0) {
      const at = (ink.count - 1) * kInkStride;
      for (let k = 0; k < 3; k += 1) {
        this.spot[k] = ink.floats[at + k]!;
        this.normal[k] = ink.floats[at + 3 + k]!;
      }
      this.toWorld();
      this.view3.pen.show(tip, tipRadius_m, this.spot, this.normal, Math.max(2 * this.studio.settings.style.radius_m, kLeastRing_m));
    } else {
      this.view3.pen.show(tip, tipRadius_m, null, this.normal, 0);
    }
    this.stage.invalidate();
  }

  /** A ring on the surface. position, normal: model space. */
  at(position: Float64Array, normal: Float64Array, radius_m: number): void {
    this.spot.set(position);
    this.normal.set(normal);
    this.toWorld();
    this.view3.pen.show(this.spot, 0, this.spot, this.normal, Math.max(radius_m, kLeastRing_m));
    this.stage.invalidate();
  }

  hide(): void {
    if (!this.view3.pen.visible) return;
    this.view3.pen.hide();
    this.stage.invalidate();
  }

  private toWorld(): void {
    const place = this.studio.state.now.modelToWorld;
    toWorld(this.spot, 0, place, this.spot, 0);
    rotate(this.normal, 0, place, 0, this.normal, 0);
  }
}
