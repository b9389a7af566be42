import type { Stage } from '../scene/stage';
import type { ThreeView } from '../scene/three_view';
import type { Studio } from '../studio/studio';
import type { Modifier, PenSample, Tool } from '../tools/tool';
import type { Tools } from '../tools/tools';
import { fingerAt, Fingers, type Finger } from './fingers';
import { PenMarks } from './pen_marks';
import { kOrbitSpeed, PointerRay } from './pointer_ray';
import { ScreenBrush } from './screen_brush';
import { ScreenPen } from './screen_pen';
import type { ScreenUse } from './screen_use';

type Gesture = 'tool' | 'orbit' | 'pan' | 'fingers' | null;

/** A second finger that comes this soon after the first: what began was no stroke. */
const kTogether_ms = 250;
/** A finger that has moved less has not drawn. */
const kRest_px = 10;
/** A stroke of a palm that came before its pen; longer ones were meant. */
const kPalm_ms = 1000;
/** Fingers that come while a pen was near this short a time ago belong to its hand. */
const kPenNear_ms = 400;
/** Of PointerEvent.buttons. */
const kEraserEnd = 32;
/** Notches of a wheel that turn at once, at most; and what an event of a trackpad's pinch may say. */
const kMostNotches = 8, kMostPinch = 30;

/**
 * Mouse, pen and fingers on the canvas. Pressing on the model uses the tool, beside it turns the
 * view; several fingers, the right or middle button and held keys navigate; the wheel zooms, and
 * is the tool's first while that is used. A pen comes before fingers: once one was seen they only
 * navigate, and while it draws or is near they are a resting hand and do nothing.
 */
export class PointerInput {
  /** While the space bar is held. */
  navigate = false;
  /** Whether something was navigated with a held key. */
  navigated = false;
  /** Whether the mouse is over the picture. */
  over = false;
  onUndo: () => void = () => undefined;
  onRedo: () => void = () => undefined;
  readonly pen: ScreenPen;
  private readonly uses: Readonly<Record<Tool['samples'], ScreenUse>>;
  private use: ScreenUse; // while the gesture is the tool's
  private readonly ray: PointerRay;
  private readonly marks: PenMarks;
  private readonly fingers: Fingers;
  private gesture: Gesture = null;
  private active = -1; // pointer that draws or navigates
  private activeType = '';
  private readonly at = { x: 0, y: 0 }; // the active pointer
  private readonly touches = new Map<number, Finger>(); // that count; a resting hand does not
  private penSeen = false;
  private pen_ms = -Infinity; // when it was last near
  private pressed_ms = 0;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly stage: Stage, view3: ThreeView, private readonly studio: Studio, private readonly tools: Tools) {
    this.ray = new PointerRay(canvas, stage, studio);
    this.marks = new PenMarks(stage, view3, studio);
    this.pen = new ScreenPen(this.ray, this.marks, stage, view3, studio);
    this.uses = { space: this.pen, surface: new ScreenBrush(this.ray, this.marks, studio) };
    this.use = this.pen;
    this.fingers = new Fingers(this.ray, stage, canvas);
    canvas.addEventListener('pointerdown', (e) => this.down(e));
    canvas.addEventListener('pointermove', (e) => this.move(e));
    canvas.addEventListener('pointerup', (e) => this.up(e));
    canvas.addEventListener('pointercancel', (e) => this.up(e));
    canvas.addEventListener('lostpointercapture', (e) => this.up(e));
    canvas.addEventListener('pointerenter', () => { this.over = true; });
    canvas.addEventListener('pointerleave', () => { this.over = false; this.hover(null); });
    canvas.addEventListener('wheel', (e) => this.wheel(e), { passive: false });
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    this.followSafariPinch();
    studio.state.watch(() => {
      const { cursor } = tools.now;
      canvas.style.setProperty('--over-model', cursor.over);
      canvas.style.setProperty('--pressed', cursor.pressed);
    });
    window.addEventListener('blur', () => {
      this.navigate = false; // its key may come up elsewhere
      this.release();
    });
  }

  /** A tool is pressed on the model. */
  get isUsing(): boolean {
    return this.gesture === 'tool';
  }

  /** Ends what is going on and keeps it. */
  release(): void {
    this.finish();
    this.touches.clear();
    this.marks.hide();
  }

  /** Ends what is going on and drops it; false where nothing is. */
  cancel(): boolean {
    if (!this.isUsing) return false;
    this.give(true);
    this.touches.clear();
    this.marks.hide();
    return true;
  }

  /** Another gesture takes over: what was drawn or erased is dropped, where it was a mistake, or kept. */
  private give(dropped: boolean): void {
    if (dropped && this.isUsing) this.use.cancel();
    this.finish();
  }

  private finish(): void {
    const { gesture } = this;
    this.set(null);
    this.active = -1;
    if (gesture === 'tool') this.use.release();
  }

  private set(gesture: Gesture): void {
    this.gesture = gesture;
    this.canvas.dataset['gesture'] = gesture ?? '';
  }

  private down(event: PointerEvent): void {
    if (this.stage.renderer.xr.isPresenting) return;
    this.canvas.focus({ preventScroll: true });
    try {
      this.canvas.setPointerCapture(event.pointerId);
    } catch {
      // Synthetic pointers cannot be captured.
    }
    if (event.pointerType === 'touch') this.touch(event);
    else this.press(event);
  }

  private touch(event: PointerEvent): void {
    const resting = (this.gesture !== null && this.activeType !== 'touch') || event.timeStamp - this.pen_ms < kPenNear_ms;
    if (resting) return;
    this.touches.set(event.pointerId, fingerAt(event.clientX, event.clientY));
    this.fingers.down(this.touches.size, event.timeStamp);
    if (this.touches.size === 1) {
      if (this.gesture === null) this.begin(event, this.penSeen);
    } else if (this.gesture !== 'fingers') {
      // Soon after the first, or while that rests: what began was the start of this.
      const [first] = this.touches.values();
      const rested = Math.hypot(first!.x - first!.x0, first!.y - first!.y0) < kRest_px;
      this.give(event.timeStamp - this.pressed_ms < kTogether_ms || rested);
      this.marks.hide();
      this.activeType = 'touch';
      this.set('fingers');
    }
  }

  private press(event: PointerEvent): void {
    if (event.pointerType === 'pen') {
      this.sawPen(event);
      if (this.gesture !== null && this.activeType === 'touch') {
        // The hand came before its pen.
        this.give(event.timeStamp - this.pressed_ms < kPalm_ms);
      }
      this.touches.clear();
    }
    if (this.gesture === null) this.begin(event, false);
  }

  private sawPen(event: PointerEvent): void {
    this.penSeen = true;
    this.pen_ms = event.timeStamp;
  }

  /** The first pointer: uses the tool on the model, navigates beside it or where it is told to. */
  private begin(event: PointerEvent, onlyNavigates: boolean): void {
    this.active = event.pointerId;
    this.activeType = event.pointerType;
    this.pressed_ms = event.timeStamp;
    this.at.x = event.clientX;
    this.at.y = event.clientY;
    this.stage.rig.jump();
    const end = event.pointerType === 'pen' && (event.button === 5 || (event.buttons & kEraserEnd) !== 0);
    const { now } = this.tools, tool = end ? (now.otherEnd ?? now) : now;
    const isHeld = (modifier: Modifier, key: boolean): boolean => key && !tool.takes.includes(modifier);
    const held = this.navigate || isHeld('alt', event.altKey) || isHeld('control', event.ctrlKey || event.metaKey);
    if (event.button === 1 || isHeld('shift', event.shiftKey)) this.set('pan');
    else if (onlyNavigates || held || (event.button !== 0 && !end)) this.set('orbit');
    else this.set(this.take(event, tool, end ? 'eraser' : 'tip') ? 'tool' : 'orbit');
    if (held) this.navigated = true;
  }

  private take(event: PointerEvent, tool: Tool, end: PenSample['end']): boolean {
    this.use = this.uses[tool.samples];
    return this.use.press(event, tool, end);
  }

  private move(event: PointerEvent): void {
    if (event.pointerType === 'pen') this.sawPen(event);
    const finger = this.touches.get(event.pointerId);
    const { clientX: x, clientY: y } = event;
    if (finger) {
      finger.x = x;
      finger.y = y;
    }
    if (this.gesture === 'fingers') {
      if (!finger) return;
      this.fingers.move([...this.touches.values()], finger);
      this.stage.invalidate();
      return;
    }
    if (event.pointerId !== this.active) {
      if (this.gesture === null && event.buttons === 0) this.hover(event);
      return;
    }
    const dx = x - this.at.x, dy = y - this.at.y;
    const h = this.canvas.clientHeight;
    if (this.gesture === 'orbit') this.stage.rig.orbit((-kOrbitSpeed * dx) / h, (kOrbitSpeed * dy) / h);
    if (this.gesture === 'pan') this.stage.rig.pan(dx / h, dy / h);
    if (this.gesture === 'tool') this.use.move(event);
    this.at.x = x;
    this.at.y = y;
    this.stage.invalidate();
  }

  private up(event: PointerEvent): void {
    if (event.pointerType === 'pen') this.sawPen(event);
    const wasFinger = this.touches.delete(event.pointerId);
    if (this.gesture === 'fingers') {
      // The last one that is left does nothing more.
      if (!wasFinger || this.touches.size > 0) return;
      this.finish();
      const taps = event.type === 'pointerup' ? this.fingers.tapped(event.timeStamp) : 0;
      if (taps === 2) this.onUndo();
      if (taps === 3) this.onRedo();
      return;
    }
    if (event.pointerId !== this.active) return;
    this.finish();
    this.hover(event.pointerType === 'mouse' ? event : null);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    let factor: number;
    if (event.ctrlKey && event.deltaMode === WheelEvent.DOM_DELTA_PIXEL) {
      // A trackpad's pinch: browsers send a hundred times the logarithm of how much fingers have closed.
      factor = Math.exp(clamp(event.deltaY, kMostPinch) / 100);
    } else {
      const notches = event.deltaY / (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 3 : 100);
      if (this.isUsing && this.use.wheel(notches)) return;
      factor = Math.exp(0.12 * clamp(notches, kMostNotches));
    }
    this.zoomAt(factor, event.clientX, event.clientY);
  }

  private zoomAt(factor: number, x: number, y: number): void {
    const [cx, cy] = this.ray.picture(x, y);
    this.stage.rig.zoom(factor, cx, cy - this.stage.axisY);
    this.stage.invalidate();
  }

  /** Safari has events of its own for a trackpad's pinch, and for fingers, which are pointers already. */
  private followSafariPinch(): void {
    let before = 1;
    const follow = (event: Event): void => {
      event.preventDefault();
      const { scale, clientX, clientY } = event as Event & { scale: number } & MouseEvent;
      if (event.type === 'gesturechange' && this.touches.size === 0 && scale > 0) this.zoomAt(before / scale, clientX, clientY);
      before = scale;
    };
    for (const type of ['gesturestart', 'gesturechange']) this.canvas.addEventListener(type, follow);
  }

  /** Where the tool would start. */
  private hover(event: PointerEvent | null): void {
    if (this.stage.renderer.xr.isPresenting) return; // the hand's pen is shown
    if (!event || event.pointerType === 'touch' || !this.studio.target) {
      this.marks.hide();
      return;
    }
    this.ray.aim(event);
    const hit = this.ray.hit();
    this.canvas.dataset['over'] = hit ? 'model' : '';
    if (!hit) {
      this.marks.hide();
      return;
    }
    this.marks.at(hit.position, hit.normal, this.tools.now.ring_m(this.studio.settings));
  }
}

function clamp(value: number, most: number): number {
  return Math.min(most, Math.max(-most, value));
}
