import { makeFrame } from '../drawing/frame';
import type { SurfaceHit } from '../engine/core';
import type { PenDevice, PenSample } from '../tools/tool';
import type { PointerRay } from './pointer_ray';
import { screenFrame } from './screen_frame';

/** A mouse, pen or finger as tools see it. */
export class ScreenSample implements PenSample {
  readonly frame = makeFrame();
  device: PenDevice = 'mouse';
  end: PenSample['end'] = 'tip';
  readonly modifiers = { shift: false, alt: false, control: false };
  private time_ms = 0;
  private feelsPressure = false;

  constructor(private readonly ray: PointerRay) {}

  hit(): SurfaceHit | null {
    return this.ray.hit();
  }

  /** What the event tells of the device, with the pen's tip at `tip` (world), at which the ray was aimed. */
  take(event: PointerEvent, tip: Float64Array, time_ms: number): void {
    this.device = event.pointerType === 'pen' || event.pointerType === 'touch' ? event.pointerType : 'mouse';
    this.modifiers.shift = event.shiftKey;
    this.modifiers.alt = event.altKey;
    this.modifiers.control = event.ctrlKey || event.metaKey;
    this.time_ms = Math.max(this.time_ms, time_ms);
    const isPen = this.device === 'pen';
    screenFrame(this.frame, this.ray.view, tip, this.time_ms / 1000, isPen ? this.pressure(event) : -1, isPen ? event.tiltX || 0 : 0, isPen ? event.tiltY || 0 : 0);
  }

  /** 0 to 1; below 0 of pens that do not tell: they report nothing, or 0 while they touch. */
  private pressure(event: PointerEvent): number {
    const { pressure } = event;
    if (pressure > 0) this.feelsPressure = true;
    return this.feelsPressure && Number.isFinite(pressure) ? Math.min(1, Math.max(0, pressure)) : -1;
  }
}
