import { kPressure, makeFrame } from '../drawing/frame';
import type { Stage } from '../scene/stage';
import type { ThreeView } from '../scene/three_view';
import { kInkStride } from '../scene/tube';
import type { Studio } from '../studio';
import { directionToModel, toModel, toWorld } from '../math/similarity';
import { rotate } from '../math/vec';
import { Vector3 } from 'three';
import { kDepthStep, kPenDepth, makeView, PlanePen, screenFrame } from './plane_pen';

type Gesture = 'draw' | 'erase' | 'orbit' | 'pan' | 'pinch' | null;

/** How near a curve must be to a click to be erased: this part of the diagonal, at least the ink's radius. */
const kEraserReach = 0.02;
const kOrbitSpeed = 5.5; // radians a window height

/**
 * Mouse, pen and fingers on the canvas. Pressing on the model draws or erases, beside it turns the
 * view; a second finger, the right or middle button and the space bar navigate; the wheel zooms, and
 * moves the pen's plane while it draws. Where a pen was seen, fingers only navigate: palms rest.
 */
export class PointerInput {
  /** While the space bar is held. */
  navigate = false;
  private gesture: Gesture = null;
  private active = -1; // pointer that draws or orbits
  private penSeen = false;
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private readonly view = makeView();
  private readonly pen = new PlanePen();
  private readonly frame = makeFrame();
  private readonly tip = new Float64Array(3);
  private readonly origin = new Float64Array(3);
  private readonly towards = new Float64Array(3);
  private readonly spot = new Float64Array(3);
  private readonly spotNormal = new Float64Array(3);
  private lastTime_ms = 0;
  private depth_m = 1;
  private last: PointerEvent | null = null;
  private pressed_ms = 0;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly stage: Stage, private readonly view3: ThreeView, private readonly studio: Studio) {
    canvas.addEventListener('pointerdown', (e) => this.down(e));
    canvas.addEventListener('pointermove', (e) => this.move(e));
    canvas.addEventListener('pointerup', (e) => this.up(e));
    canvas.addEventListener('pointercancel', (e) => this.up(e));
    canvas.addEventListener('lostpointercapture', (e) => this.up(e));
    canvas.addEventListener('pointerleave', () => this.hover(null));
    canvas.addEventListener('wheel', (e) => this.wheel(e), { passive: false });
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    window.addEventListener('blur', () => this.release());
  }

  get busy(): boolean {
    return this.gesture !== null;
  }

  /** Ends what is going on and keeps it. */
  release(): void {
    if (this.gesture === 'draw') this.studio.endStroke();
    if (this.gesture === 'erase') this.studio.endErase();
    this.gesture = null;
    this.active = -1;
    this.pointers.clear();
    this.hidePen();
  }

  private down(event: PointerEvent): void {
    if (this.stage.renderer.xr.isPresenting) return;
    this.canvas.focus({ preventScroll: true });
    if (event.pointerType === 'pen') this.penSeen = true;
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    try {
      this.canvas.setPointerCapture(event.pointerId);
    } catch {
      // Synthetic pointers cannot be captured.
    }
    if (this.pointers.size === 2 && event.pointerType === 'touch') {
      // A second finger soon after the first: what began was the start of a pinch.
      if (this.gesture === 'draw') {
        if (event.timeStamp - this.pressed_ms < 250) this.studio.cancelStroke();
        else this.studio.endStroke();
      }
      if (this.gesture === 'erase') this.studio.endErase();
      this.gesture = 'pinch';
      this.hidePen();
      return;
    }
    if (this.gesture !== null) return;
    this.active = event.pointerId;
    this.last = event;
    this.pressed_ms = event.timeStamp;
    const palm = event.pointerType === 'touch' && this.penSeen;
    if (event.button === 1 || (event.button === 0 && event.shiftKey)) this.gesture = 'pan';
    else if (event.button !== 0 || this.navigate || palm || !this.begin(event)) this.gesture = 'orbit';
    this.canvas.dataset['gesture'] = this.gesture ?? '';
  }

  /** Draws or erases where the model is under the pointer; false where it is not. */
  private begin(event: PointerEvent): boolean {
    this.stage.rig.jump();
    this.aim(event);
    const hit = this.hit();
    if (!hit) return false;
    const { studio } = this;
    if (studio.settings.tool === 'draw') {
      const scale = studio.state.now.modelToWorld[7]!;
      this.depth_m = hit.distance * scale;
      this.pen.press(this.view, this.depth_m, kPenDepth * studio.target!.diagonal * scale);
      studio.beginStroke();
      this.gesture = 'draw';
      this.draw(event);
    } else {
      studio.beginErase();
      this.gesture = 'erase';
      this.erase();
    }
    return true;
  }

  private move(event: PointerEvent): void {
    const known = this.pointers.get(event.pointerId);
    if (!known) {
      if (this.gesture === null && event.buttons === 0) this.hover(event);
      return;
    }
    const dx = event.clientX - known.x, dy = event.clientY - known.y;
    if (this.gesture === 'pinch') {
      this.pinch(event, known);
    } else if (event.pointerId === this.active) {
      const h = this.canvas.clientHeight;
      if (this.gesture === 'orbit') this.stage.rig.orbit((-kOrbitSpeed * dx) / h, (kOrbitSpeed * dy) / h);
      if (this.gesture === 'pan') this.stage.rig.pan(dx / h, dy / h);
      if (this.gesture === 'draw') {
        // All samples since the last event, where the device is faster than the screen.
        const samples = event.getCoalescedEvents?.() ?? [];
        if (samples.length === 0) this.draw(event);
        else for (const sample of samples) this.draw(sample);
      }
      if (this.gesture === 'erase') {
        this.aim(event);
        this.erase();
      }
      this.last = event;
      this.stage.invalidate();
    }
    known.x = event.clientX;
    known.y = event.clientY;
  }

  private up(event: PointerEvent): void {
    if (!this.pointers.delete(event.pointerId)) return;
    if (this.gesture === 'pinch') {
      if (this.pointers.size === 0) this.gesture = null;
    } else if (event.pointerId === this.active) {
      if (this.gesture === 'draw') this.studio.endStroke();
      if (this.gesture === 'erase') this.studio.endErase();
      this.gesture = null;
      this.active = -1;
      this.hover(event.pointerType === 'mouse' ? event : null);
    }
    this.canvas.dataset['gesture'] = this.gesture ?? '';
  }

  private pinch(event: PointerEvent, known: { x: number; y: number }): void {
    if (this.pointers.size !== 2) return;
    let other = known;
    for (const [id, at] of this.pointers) if (id !== event.pointerId) other = at;
    const before = Math.hypot(known.x - other.x, known.y - other.y);
    const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
    const h = this.canvas.clientHeight, w = this.canvas.clientWidth;
    const cx = (event.clientX + other.x) / w - 1, cy = 1 - (event.clientY + other.y) / h - this.stage.axisY;
    if (before > 8 && after > 8) this.stage.rig.zoom(before / after, cx, cy);
    // Half the motion of one finger is the motion of both; sideways it turns, as with one finger beside the model.
    const dx = (event.clientX - known.x) / 2, dy = (event.clientY - known.y) / 2;
    this.stage.rig.pan(dx / h, dy / h);
    this.stage.invalidate();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const steps = event.deltaY / (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 3 : 100);
    if (this.gesture === 'draw' && this.last && this.studio.settings.penPlace === 'in front') {
      const step = kDepthStep * this.studio.target!.diagonal * this.studio.state.now.modelToWorld[7]!;
      this.pen.depth = Math.max(0.02 * this.depth_m, this.pen.depth - steps * step);
      this.sample(this.last, performance.now());
      return;
    }
    const { clientWidth, clientHeight } = this.canvas;
    this.stage.rig.zoom(Math.exp(0.12 * Math.max(-8, Math.min(8, steps))), (2 * event.clientX) / clientWidth - 1, 1 - (2 * event.clientY) / clientHeight - this.stage.axisY);
    this.stage.invalidate();
  }

  /** The camera and the ray through the pointer, world; and the ray seen from the model. */
  private aim(event: { clientX: number; clientY: number }): void {
    const { camera } = this.stage;
    // The canvas fills the window.
    const { clientWidth, clientHeight } = this.canvas;
    const width = this.stage.split ? clientWidth / 2 : clientWidth;
    const left = this.stage.split && event.clientX > width ? width : 0;
    const v = this.view;
    camera.position.toArray(v.eye as unknown as number[]);
    camera.quaternion.toArray(v.eyeOrientation as unknown as number[]);
    ray.set((2 * (event.clientX - left)) / width - 1, 1 - (2 * event.clientY) / clientHeight, 0.5).unproject(camera).sub(camera.position).normalize();
    v.direction[0] = ray.x; v.direction[1] = ray.y; v.direction[2] = ray.z;
    ray.set(0, 0, -1).applyQuaternion(camera.quaternion);
    v.forward[0] = ray.x; v.forward[1] = ray.y; v.forward[2] = ray.z;
    ray.set(0, 1, 0).applyQuaternion(camera.quaternion);
    v.up[0] = ray.x; v.up[1] = ray.y; v.up[2] = ray.z;
    const place = this.studio.state.now.modelToWorld;
    toModel(this.origin, 0, place, v.eye, 0);
    directionToModel(this.towards, 0, place, v.direction, 0);
  }

  private hit(): ReturnType<NonNullable<Studio['target']>['firstHit']> {
    const { origin: o, towards: d } = this;
    return this.studio.target?.firstHit(o[0]!, o[1]!, o[2]!, d[0]!, d[1]!, d[2]!) ?? null;
  }

  private draw(event: PointerEvent): void {
    this.sample(event, event.timeStamp);
  }

  private sample(event: PointerEvent, time_ms: number): void {
    this.aim(event);
    this.lastTime_ms = Math.max(this.lastTime_ms, time_ms);
    this.pen.tip(this.tip, 0, this.view);
    if (this.studio.settings.penPlace === 'on the surface') {
      const hit = this.hit();
      if (hit) toWorld(this.tip, 0, this.studio.state.now.modelToWorld, hit.position, 0);
    }
    const pen = event.pointerType === 'pen';
    screenFrame(this.frame, this.view, this.tip, this.lastTime_ms / 1000, pen ? event.pressure : -1, pen ? event.tiltX : 0, pen ? event.tiltY : 0);
    this.frame[kPressure] = Math.min(1, this.frame[kPressure]!);
    this.studio.addFrame(this.frame);
    this.showPen();
  }

  private erase(): void {
    const hit = this.hit();
    const diagonal = this.studio.target!.diagonal;
    if (!hit) return;
    const { position: p } = hit;
    this.studio.eraseAt(p[0]!, p[1]!, p[2]!, kEraserReach * diagonal);
    this.showSpot(hit.position, hit.normal, kEraserReach * diagonal * this.studio.state.now.modelToWorld[7]!, 0);
  }

  /** Where a stroke would start. */
  private hover(event: PointerEvent | null): void {
    if (!event || event.pointerType === 'touch' || !this.studio.target) {
      this.hidePen();
      return;
    }
    this.aim(event);
    const hit = this.hit();
    this.canvas.dataset['over'] = hit ? 'model' : '';
    if (!hit) {
      this.hidePen();
      return;
    }
    const { settings } = this.studio;
    const scale = this.studio.state.now.modelToWorld[7]!;
    const eraser = settings.tool !== 'draw';
    this.showSpot(hit.position, hit.normal, eraser ? kEraserReach * this.studio.target.diagonal * scale : Math.max(2 * settings.style.radius_m, 0.006), 0);
  }

  /** The pen's tip and the laser to the end of the ink. */
  private showPen(): void {
    const ink = this.studio.liveInk;
    const { style, penPlace } = this.studio.settings;
    const inFront = penPlace === 'in front';
    if (!ink || ink.count === 0) {
      this.view3.pen.show(this.tip, inFront ? 0.006 : 0, null, this.spotNormal, 0);
      return;
    }
    const at = (ink.count - 1) * kInkStride;
    const place = this.studio.state.now.modelToWorld;
    for (let k = 0; k < 3; k += 1) {
      this.spot[k] = ink.floats[at + k]!;
      this.spotNormal[k] = ink.floats[at + 3 + k]!;
    }
    toWorld(this.spot, 0, place, this.spot, 0);
    rotate(this.spotNormal, 0, place, 0, this.spotNormal, 0);
    this.view3.pen.show(this.tip, inFront ? 0.006 : 0, this.spot, this.spotNormal, Math.max(2 * style.radius_m, 0.006));
    this.stage.invalidate();
  }

  private showSpot(position: Float64Array, normal: Float64Array, radius_m: number, tipRadius: number): void {
    const place = this.studio.state.now.modelToWorld;
    toWorld(this.spot, 0, place, position, 0);
    rotate(this.spotNormal, 0, place, 0, normal, 0);
    this.view3.pen.show(this.spot, tipRadius, this.spot, this.spotNormal, radius_m);
    this.stage.invalidate();
  }

  private hidePen(): void {
    if (!this.view3.pen.visible) return;
    this.view3.pen.hide();
    this.stage.invalidate();
  }
}

const ray = new Vector3();
