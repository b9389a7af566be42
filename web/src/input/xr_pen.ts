import { kController, makeFrame } from '../drawing/frame';
import type { SurfaceHit } from '../engine/core';
import { toModel } from '../math/similarity';
import { rotate } from '../math/vec';
import type { Studio } from '../studio/studio';
import type { PenSample, Tool, ToolUse } from '../tools/tool';

/** The pen is at what is this near to its tip; farther away, where it points. */
const kReach_m = 0.03;
/** Samples of the surface between two frames of the headset, at most. */
const kMostSteps = 64;

/** The controller that holds the pen, as tools see it, and the tool that it uses. Fill `frame` before each call. */
export class XrPen implements PenSample {
  readonly frame = makeFrame();
  readonly device = 'controller';
  readonly end = 'tip';
  readonly modifiers = { shift: false, alt: false, control: false };
  private tool: Tool | null = null;
  private use: ToolUse | null = null;
  private readonly last = new Float64Array(3); // on the surface, model space, in the frame before
  private readonly now = new Float64Array(3);
  private hasLast = false;
  /** Between two frames: the sample is at the surface's nearest place. */
  private readonly between = new Float64Array(3);
  private isBetween = false;
  private readonly from = new Float64Array(3);
  private readonly axis = new Float64Array(3);

  constructor(private readonly studio: Studio) {}

  /** What it uses, from press to release. */
  get used(): Tool | null {
    return this.use && this.tool;
  }

  /** False where the tool does not want to. */
  press(tool: Tool): boolean {
    this.hasLast = false;
    this.tool = tool;
    this.use = tool.press(this.studio, this);
    if (tool.samples === 'surface') this.follow();
    return this.use !== null;
  }

  move(): void {
    if (!this.use) return;
    if (this.tool!.samples === 'space') this.use.move(this);
    else this.sweep();
  }

  release(): void {
    this.use?.release();
    this.use = null;
  }

  hit(): SurfaceHit | null {
    const target = this.studio.target!, place = this.studio.state.now.modelToWorld;
    if (this.isBetween) return target.closestPoint(this.between[0]!, this.between[1]!, this.between[2]!);
    toModel(this.from, 0, place, this.frame, kController);
    const near = target.closestPoint(this.from[0]!, this.from[1]!, this.from[2]!);
    return near && near.distance * place[7]! < kReach_m ? near : this.aim();
  }

  /** Where it points. */
  aim(): SurfaceHit | null {
    const { from, axis, frame } = this, place = this.studio.state.now.modelToWorld;
    toModel(from, 0, place, frame, kController);
    axis[0] = 0; axis[1] = 0; axis[2] = -1;
    rotate(axis, 0, frame, kController + 3, axis, 0);
    for (let k = 0; k < 3; k += 1) axis[k] = frame[kController + k]! + axis[k]!;
    toModel(axis, 0, place, axis, 0);
    return this.studio.target?.firstHit(from[0]!, from[1]!, from[2]!, axis[0]! - from[0]!, axis[1]! - from[1]!, axis[2]! - from[2]!) ?? null;
  }

  /** Samples of the surface from where it was a frame ago, in steps of the tool's radius that leave no gap. */
  private sweep(): void {
    const { last, now, between } = this;
    const hadLast = this.hasLast;
    if (!this.follow()) return;
    const radius = this.tool!.size.get(this.studio.settings) / this.studio.state.now.modelToWorld[7]!;
    const way = hadLast ? Math.hypot(now[0]! - last[0]!, now[1]! - last[1]!, now[2]! - last[2]!) : 0;
    const steps = Math.min(kMostSteps, Math.max(1, Math.ceil(way / radius)));
    this.isBetween = true;
    for (let i = 1; i < steps; i += 1) {
      for (let k = 0; k < 3; k += 1) between[k] = last[k]! + (i / steps) * (now[k]! - last[k]!);
      this.use!.move(this);
    }
    this.isBetween = false;
    this.use!.move(this);
    last.set(now);
  }

  /** Where it is now; false where that is nowhere. */
  private follow(): boolean {
    const hit = this.hit();
    if (hit) this.now.set(hit.position);
    if (hit && !this.hasLast) this.last.set(this.now);
    this.hasLast = hit !== null;
    return this.hasLast;
  }
}
