import { Vector3 } from 'three';
import { kInkStride } from '../engine/core';
import type { Stage } from '../scene/stage';
import type { ThreeView } from '../scene/three_view';
import type { Studio } from '../studio/studio';
import type { PenSample, Tool, ToolUse } from '../tools/tool';
import type { PenMarks } from './pen_marks';
import type { PointerRay } from './pointer_ray';
import { PlanePen } from './screen_frame';
import { ScreenSample } from './screen_sample';
import type { ScreenUse } from './screen_use';

/**
 * How far the tip stays on the eye's side of what is under the pointer, as a part of the diagonal: on the surface for every technique,
 * which draws there wherever the pen leans, and on no account behind it.
 */
const kTipGap = 1e-6;
/** The ball at the tip of a pen on its plane. */
const kTip_m = 0.006;
/** A pen that comes back to the model farther away than this part of the diagonal starts another stroke. */
const kLeap = 0.05;
/** A stroke whose ink is shorter than this part of the pointer's way is worth a word; of ways that are long enough to tell. */
const kLittle = 0.5, kWayThatTells_px = 40;

/** Tools that the pen uses in space: each event becomes a sample, on the surface or on a plane in front of it. */
export class ScreenPen implements ScreenUse {
  private readonly plane = new PlanePen();
  private readonly sample: ScreenSample;
  private readonly tip = new Float64Array(3);
  private readonly lastTip = new Float64Array(3);
  private last: PointerEvent | null = null;
  private away = false; // from the model
  private way_px = 0; // of the pointer, over the model
  private tool: Tool | null = null;
  private use: ToolUse | null = null;
  /** A stroke left little of the pointer's motion. */
  onLittleInk: (technique: string) => void = () => undefined;

  constructor(private readonly ray: PointerRay, private readonly marks: PenMarks, private readonly stage: Stage, private readonly view3: ThreeView, private readonly studio: Studio) {
    this.sample = new ScreenSample(ray);
  }

  private get onPlane(): boolean {
    return this.studio.settings.penPlace === 'on a plane';
  }

  /** The target's diagonal in the world. */
  private get diagonal(): number {
    return this.studio.target!.diagonal * this.studio.state.now.modelToWorld[7]!;
  }

  press(event: PointerEvent, tool: Tool, end: PenSample['end']): boolean {
    this.ray.aim(event);
    const hit = this.ray.hit();
    if (!hit) return false;
    this.plane.press(this.ray.view, hit.distance * this.studio.state.now.modelToWorld[7]!, this.diagonal);
    this.sample.end = end;
    this.tool = tool;
    this.away = false;
    this.start();
    this.put(event, event.timeStamp);
    return this.use !== null;
  }

  move(event: PointerEvent): void {
    // All samples since the last event, where the device is faster than the screen.
    const samples = event.getCoalescedEvents?.() ?? [];
    if (samples.length === 0) this.put(event, event.timeStamp);
    else for (const sample of samples) this.put(sample, sample.timeStamp);
  }

  /** Moves the plane that the pen is on. */
  wheel(steps: number): boolean {
    if (!this.onPlane || !this.last) return false;
    this.plane.wheel(steps);
    this.put(this.last, performance.now());
    return true;
  }

  release(): void {
    const drawn = this.studio.isDrawing ? this.inkLength_px() : Infinity; // it may have been dropped
    const { technique } = this.studio.settings;
    this.use?.release();
    this.use = null;
    if (this.way_px >= kWayThatTells_px && drawn < kLittle * this.way_px) this.onLittleInk(technique);
  }

  cancel(): void {
    this.use?.cancel();
    this.use = null;
  }

  /** The next sample is the first of a use. */
  private start(): void {
    this.use = null;
    this.way_px = 0;
    this.last = null;
  }

  private put(event: PointerEvent, time_ms: number): void {
    const { ray, tip } = this;
    ray.aim(event);
    const { eye, direction } = ray.view;
    const hit = ray.hit();
    if (this.onPlane) {
      this.plane.tip(tip, 0, ray.view);
    } else {
      // Beside the model there is nothing under the pointer: the stroke waits.
      if (!hit) {
        this.away = true;
        this.last = event;
        return;
      }
      const distance = hit.distance * this.studio.state.now.modelToWorld[7]!;
      const along = distance - Math.min(kTipGap * this.diagonal, 0.5 * distance);
      for (let k = 0; k < 3; k += 1) tip[k] = eye[k]! + along * direction[k]!;
      if (this.away && Math.hypot(tip[0]! - this.lastTip[0]!, tip[1]! - this.lastTip[1]!, tip[2]! - this.lastTip[2]!) > kLeap * this.diagonal) {
        this.use?.release();
        this.start();
      }
      this.away = false;
      this.lastTip.set(tip);
    }
    const isFirst = this.last === null;
    if (hit && this.last) this.way_px += Math.hypot(event.clientX - this.last.clientX, event.clientY - this.last.clientY);
    this.last = event;
    this.sample.take(event, tip, time_ms);
    if (isFirst) this.use = this.tool!.press(this.studio, this.sample);
    else this.use?.move(this.sample);
    this.marks.atInk(tip, this.onPlane ? kTip_m : 0, this.studio.liveInk);
  }

  /** How long the live ink is in the window. */
  private inkLength_px(): number {
    const ink = this.studio.liveInk!;
    const { clientWidth, clientHeight } = this.stage.renderer.domElement;
    const width = this.stage.split ? clientWidth / 2 : clientWidth;
    let sum = 0, x0 = 0, y0 = 0;
    for (let i = 0; i < ink.count; i += 1) {
      const at = i * kInkStride;
      spot.set(ink.floats[at]!, ink.floats[at + 1]!, ink.floats[at + 2]!);
      this.view3.model.group.localToWorld(spot).project(this.stage.camera);
      const x = (spot.x * width) / 2, y = (spot.y * clientHeight) / 2;
      if (i > 0) sum += Math.hypot(x - x0, y - y0);
      x0 = x;
      y0 = y;
    }
    return sum;
  }
}

const spot = new Vector3();
