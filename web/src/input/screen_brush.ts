import type { Studio } from '../studio/studio';
import type { PenSample, Tool, ToolUse } from '../tools/tool';
import type { PenMarks } from './pen_marks';
import type { At, PointerRay } from './pointer_ray';
import { ScreenSample } from './screen_sample';
import type { ScreenUse } from './screen_use';

/** Between two events there is a sample each time the pointer has moved this far. */
const kStep_px = 3;

/** Tools that work on the surface: samples under the pointer, without gaps however far apart events are. */
export class ScreenBrush implements ScreenUse {
  private readonly sample: ScreenSample;
  private readonly tip = new Float64Array(3);
  private readonly last = { clientX: 0, clientY: 0 };
  private readonly now = { clientX: 0, clientY: 0 };
  private tool: Tool | null = null;
  private use: ToolUse | null = null;

  constructor(private readonly ray: PointerRay, private readonly marks: PenMarks, private readonly studio: Studio) {
    this.sample = new ScreenSample(ray);
  }

  press(event: PointerEvent, tool: Tool, end: PenSample['end']): boolean {
    this.sample.end = end;
    this.tool = tool;
    if (!this.look(event, event)) return false;
    this.use = tool.press(this.studio, this.sample);
    this.last.clientX = event.clientX;
    this.last.clientY = event.clientY;
    return this.use !== null;
  }

  move(event: PointerEvent): void {
    const { last, now } = this;
    const dx = event.clientX - last.clientX, dy = event.clientY - last.clientY;
    const steps = Math.max(1, Math.ceil(Math.hypot(dx, dy) / kStep_px));
    for (let i = 1; i <= steps; i += 1) {
      now.clientX = last.clientX + (dx * i) / steps;
      now.clientY = last.clientY + (dy * i) / steps;
      if (this.look(event, now)) this.use?.move(this.sample);
    }
    last.clientX = event.clientX;
    last.clientY = event.clientY;
  }

  wheel(): boolean {
    return false;
  }

  release(): void {
    this.use?.release();
    this.use = null;
  }

  cancel(): void {
    this.use?.cancel();
    this.use = null;
  }

  /** The sample under `at`; false where the model is not there. */
  private look(event: PointerEvent, at: At): boolean {
    this.ray.aim(at);
    const hit = this.ray.hit();
    if (!hit) return false;
    const { settings, state } = this.studio, { eye, direction } = this.ray.view;
    const distance = hit.distance * state.now.modelToWorld[7]!;
    for (let k = 0; k < 3; k += 1) this.tip[k] = eye[k]! + distance * direction[k]!;
    this.marks.at(hit.position, hit.normal, this.tool!.ring_m(settings));
    this.sample.take(event, this.tip, event.timeStamp);
    return true;
  }
}
