import type { Stage } from '../scene/stage';
import { kOrbitSpeed, type PointerRay } from './pointer_ray';

/** A finger: where it came down, where it is, and up to where the view has followed it. */
export interface Finger {
  readonly x0: number;
  readonly y0: number;
  x: number;
  y: number;
  fromX: number;
  fromY: number;
}

export function fingerAt(x: number, y: number): Finger {
  return { x0: x, y0: y, x, y, fromX: x, fromY: y };
}

/** Fingers that have moved less than this have not yet said what they want; a tap stays below it. */
const kDecided_px = 10;
const kTap_ms = 300;

/**
 * Several fingers, anywhere. Two that move together turn the view; two that move apart, together
 * or around each other take hold of the picture: it is moved, scaled and turned with them. Three
 * move the view. A tap is for whoever asks.
 */
export class Fingers {
  private mode: 'undecided' | 'turn' | 'hold' = 'undecided';
  private most = 0; // fingers that were down at once
  private still = true;
  private started_ms = 0;
  private lastMoved: Finger | null = null;

  constructor(private readonly ray: PointerRay, private readonly stage: Stage, private readonly canvas: HTMLCanvasElement) {}

  /** One more finger is down; count: with it. */
  down(count: number, time_ms: number): void {
    if (count <= 2) {
      this.mode = 'undecided';
      this.most = 0;
      this.still = true;
      this.lastMoved = null;
      this.started_ms = time_ms;
    }
    this.most = Math.max(this.most, count);
  }

  /** How many fingers tapped, now that all are up; 0 where it was no tap. */
  tapped(time_ms: number): number {
    return this.still && time_ms - this.started_ms < kTap_ms ? this.most : 0;
  }

  /** One of the fingers has moved; in the order in which they came down. */
  move(fingers: readonly Finger[], moved: Finger): void {
    const [a, b] = fingers;
    if (Math.hypot(moved.x - moved.x0, moved.y - moved.y0) > kDecided_px) this.still = false;
    if (!a || !b || (moved !== a && moved !== b)) return;
    if (fingers.length === 2 && this.mode === 'undecided') this.mode = this.decide(a, b, moved);
    if (fingers.length === 2 && this.mode === 'undecided') return;
    const h = this.canvas.clientHeight;
    const dx = (a.x - a.fromX + b.x - b.fromX) / 2 / h, dy = (a.y - a.fromY + b.y - b.fromY) / 2 / h;
    const { rig } = this.stage;
    if (fingers.length > 2) rig.pan(dx, dy);
    else if (this.mode === 'turn') rig.orbit(-kOrbitSpeed * dx, kOrbitSpeed * dy);
    else this.hold(a, b, dx, dy);
    for (const finger of [a, b]) {
      finger.fromX = finger.x;
      finger.fromY = finger.y;
    }
  }

  /** The picture follows: what was under the fingers stays there. */
  private hold(a: Finger, b: Finger, dx: number, dy: number): void {
    const x0 = a.fromX - b.fromX, y0 = a.fromY - b.fromY, x1 = a.x - b.x, y1 = a.y - b.y;
    const before = Math.hypot(x0, y0), after = Math.hypot(x1, y1);
    const { rig } = this.stage;
    rig.pan(dx, dy);
    if (before < 8 || after < 8) return;
    const [cx, cy] = this.ray.picture((a.x + b.x) / 2, (a.y + b.y) / 2);
    rig.zoom(before / after, cx, cy - this.stage.axisY);
    // Down is positive in the window.
    rig.roll(Math.atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1));
  }

  /** Both fingers have gone the same way: turn. One has gone against the other or around it: hold. */
  private decide(a: Finger, b: Finger, moved: Finger): 'undecided' | 'turn' | 'hold' {
    const ax = a.x - a.x0, ay = a.y - a.y0, bx = b.x - b.x0, by = b.y - b.y0;
    const la = Math.hypot(ax, ay), lb = Math.hypot(bx, by);
    const again = this.lastMoved === moved;
    this.lastMoved = moved;
    if (Math.max(la, lb) < kDecided_px) return 'undecided';
    // Events come one finger at a time: the other's may follow, unless this one's come twice in a row.
    if (Math.min(la, lb) < kDecided_px / 2) return again ? 'hold' : 'undecided';
    return ax * bx + ay * by > 0.5 * la * lb ? 'turn' : 'hold';
  }
}
