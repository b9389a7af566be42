import type { Studio } from '../studio';
import type { PenMarks } from './pen_marks';
import type { At, PointerRay } from './pointer_ray';

/** Between two events the eraser is put down each time it has moved this far. */
const kStep_px = 3;

/** Erases under the pointer, without gaps however far apart events are. */
export class ScreenEraser {
  private readonly last = { clientX: 0, clientY: 0 };
  private readonly now = { clientX: 0, clientY: 0 };

  constructor(private readonly ray: PointerRay, private readonly marks: PenMarks, private readonly studio: Studio) {}

  /** Starts where the model is under the pointer; false where it is not. end: the pen's eraser end, which erases whatever the tool. */
  press(event: At, end: boolean): boolean {
    this.ray.aim(event);
    if (!this.ray.hit()) return false;
    const { tool } = this.studio.settings;
    this.studio.beginErase(end && tool === 'draw' ? 'erase part' : tool);
    this.last.clientX = event.clientX;
    this.last.clientY = event.clientY;
    this.put(event);
    return true;
  }

  move(event: At): void {
    const { last, now } = this;
    const dx = event.clientX - last.clientX, dy = event.clientY - last.clientY;
    const steps = Math.max(1, Math.ceil(Math.hypot(dx, dy) / kStep_px));
    for (let i = 1; i <= steps; i += 1) {
      now.clientX = last.clientX + (dx * i) / steps;
      now.clientY = last.clientY + (dy * i) / steps;
      this.put(now);
    }
    last.clientX = event.clientX;
    last.clientY = event.clientY;
  }

  private put(at: At): void {
    this.ray.aim(at);
    const hit = this.ray.hit();
    if (!hit) return;
    const radius_m = this.studio.settings.eraser_m;
    const { position: p } = hit;
    this.studio.eraseAt(p[0]!, p[1]!, p[2]!, radius_m / this.studio.state.now.modelToWorld[7]!);
    this.marks.at(hit.position, hit.normal, radius_m);
  }
}
