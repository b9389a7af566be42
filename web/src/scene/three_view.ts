import { Group } from 'three';
import type { Drawing, DrawnCurve, InkStyle, Width } from '../drawing/document';
import type { Curve, Target, Ink } from '../engine/core';
import type { LoadedModel } from '../engine/loaded_model';
import type { StudioView } from '../studio/view';
import { fittingDistance } from './camera_rig';
import { InkView } from './ink_view';
import { ModelView } from './model_view';
import { PenView } from './pen_view';
import { kLooks, type Stage } from './stage';

/** The studio's picture: the model with its ink, and beside it, when comparing, the model with the replayed stroke. */
export class ThreeView implements StudioView {
  readonly model: ModelView;
  readonly twin: ModelView;
  readonly pen = new PenView();
  readonly ink: InkView;
  private readonly replay: InkView;
  private size = 1;
  private centre: number[] = [0, 0, 0];
  private points: ArrayLike<number> = []; // of the model

  constructor(private readonly stage: Stage) {
    const gl = stage.renderer.getContext() as WebGL2RenderingContext;
    this.ink = new InkView(gl, () => stage.invalidate());
    this.replay = new InkView(gl, () => stage.invalidate());
    stage.onRestored = () => {
      this.ink.renew();
      this.replay.renew();
    };
    this.model = new ModelView(kLooks.light.clay);
    this.twin = new ModelView(kLooks.light.clay);
    this.model.group.add(this.ink.group);
    this.twin.group.add(this.replay.group);
    stage.world.add(this.model.group);
    stage.scene.add(this.pen.group);
    stage.twin.add(this.twin.group);
    stage.warm(new Group().add(...this.ink.samples()));
  }

  set dark(dark: boolean) {
    const look = dark ? kLooks.dark : kLooks.light;
    this.stage.setLook(look);
    this.model.clay = look.clay;
    this.twin.clay = look.clay;
  }

  showModel(model: LoadedModel, target: Target): void {
    this.drop();
    this.ink.show([]);
    this.replay.show([]);
    this.size = target.diagonal;
    this.centre = [0, 1, 2].map((k) => (target.min[k]! + target.max[k]!) / 2);
    this.points = model.corners.positions;
    this.model.show(model.corners, this.centre, this.size / 2);
    this.model.shareWith(this.twin);
    this.stage.invalidate();
  }

  place(modelToWorld: Float64Array): void {
    this.model.place(modelToWorld);
    this.besides.set(modelToWorld);
    if (this.inRoom) this.besides[4]! += 0.85 * this.size * modelToWorld[7]!;
    this.twin.place(this.besides);
    this.stage.invalidate();
  }

  private readonly besides = new Float64Array(8);
  private inRoom = false;

  /** In a headset there are no halves: the model with the replayed stroke stands to the right of the other. */
  showTwinInRoom(on: boolean, modelToWorld: Float64Array): void {
    if (this.inRoom === on) return;
    this.inRoom = on;
    (on ? this.stage.scene : this.stage.twin).add(this.twin.group);
    this.place(modelToWorld);
  }

  /** Looks at the whole model, in what the page's controls leave free. O(#V) */
  frame(modelToWorld: Float64Array, yaw = 0.35, pitch = 0.18): void {
    const s = modelToWorld, { camera, rig, aspect, freeHeight } = this.stage;
    const p = this.model.group.localToWorld(this.model.group.position.clone().set(this.centre[0]!, this.centre[1]!, this.centre[2]!));
    camera.aspect = aspect;
    const half = Math.tan((camera.fov / 360) * Math.PI);
    const least = fittingDistance(this.points, this.model.group.matrixWorld, p, yaw, pitch, half * aspect, half * freeHeight);
    rig.frame(p.x, p.y, p.z, (this.size / 2) * s[7]! * 0.9, yaw, pitch, freeHeight, least);
    this.framedFor = this.stage.framing;
    this.stage.invalidate();
  }

  private framedFor = '';

  /** Whether it was framed for another window, or other controls, and nobody has moved the view since. */
  get wantsFraming(): boolean {
    return !this.stage.rig.isMoved && this.framedFor !== this.stage.framing;
  }

  showMirror(axis: 'x' | 'y' | 'z' | null): void {
    this.model.showMirror(axis, this.centre, this.size * 0.9);
    this.stage.invalidate();
  }

  beginInk(copy: number, style: InkStyle, modelToWorld: Float64Array, width: Width): void {
    this.ink.begin(copy, style, modelToWorld, width);
  }

  growInk(copy: number, ink: Ink): void {
    this.ink.grow(copy, ink);
    this.stage.invalidate();
  }

  keepInk(copy: number, id: string): void {
    this.ink.keep(copy, id);
  }

  dropInk(): void {
    this.drop();
  }

  private drop(): void {
    this.ink.drop();
    this.stage.invalidate();
  }

  showDrawing(drawing: Drawing): void {
    this.ink.show(drawing);
    this.stage.invalidate();
  }

  showReplay(curve: Curve | null, drawn: DrawnCurve | null): void {
    this.replay.show([]);
    if (curve && drawn) this.replay.show([{ ...drawn, curve }]);
    this.stage.invalidate();
  }
}
