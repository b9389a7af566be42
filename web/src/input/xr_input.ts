import { kController, kHead, kPressure, kTime, kTrigger } from '../drawing/frame';
import { kInks } from '../drawing/ink_styles';
import { kInkStride } from '../engine/core';
import { toWorld } from '../math/similarity';
import { multiply, rotate } from '../math/vec';
import type { Stage } from '../scene/stage';
import type { ThreeView } from '../scene/three_view';
import { XrHands, type HandsText } from '../scene/xr_hands';
import type { Hand } from '../studio/settings';
import type { Studio } from '../studio/studio';
import type { Tool } from '../tools/tool';
import type { Tools } from '../tools/tools';
import { carryModel, stretchModel } from './grab';
import { Hysteresis } from './hysteresis';
import { XrPen } from './xr_pen';

// Buttons of the xr-standard gamepad mapping.
const kTriggerButton = 0;
const kSqueeze = 1;
const kStick = 3;
const kFirstButton = 4; // A, X
const kSecondButton = 5; // B, Y
/** How far the stick is pushed before it counts. */
const kStickDead = 0.5;
/** Thickness changes by this factor a second at full push. */
const kStickRate = 3;
/** Where the model stands at first, from the head. */
const kBelowEyes_m = 0.05, kNearest_m = 0.4, kFarthest_m = 1.2;
const kLeastScale = 0.1, kMostScale = 20; // of the model's own size

const kHands = ['left', 'right'] as const;

interface Device {
  hand: Hand;
  /** Target ray: x, y, z, quaternion. */
  pose: Float64Array;
  before: Float64Array;
  tracked: boolean;
  trigger: Hysteresis;
  value: number;
  squeeze: Hysteresis;
  buttons: boolean[];
  stick: boolean;
  selecting: boolean; // of devices without a gamepad
  source: XRInputSource | null;
}

function device(hand: Hand): Device {
  return {
    hand, pose: new Float64Array(7), before: new Float64Array(7), tracked: false, trigger: new Hysteresis(), value: 0,
    squeeze: new Hysteresis(), buttons: [], stick: false, selecting: false, source: null,
  };
}

/** Draws with a headset's controllers. Reads poses and buttons once a frame of the headset. */
export class XrInput {
  private session: XRSession | null = null;
  private readonly devices: Record<Hand, Device> = { left: device('left'), right: device('right') };
  readonly hands: XrHands;
  private readonly pen: XrPen;
  private readonly model = new Float64Array(8);
  private baseScale = 1;
  /** Where the model stood on the page, and which it was. */
  private readonly pagePlace = new Float64Array(8);
  private pageModel: Studio['state']['now']['model'] = null;
  private placed = false;
  private grabbed = 0; // hands that held the model in the last frame
  private lastTime_ms = 0;
  private readonly tip = new Float64Array(3);
  private readonly spot = new Float64Array(3);
  private readonly normal = new Float64Array(3);
  private readonly axis = new Float64Array(3);
  /** Says something that happened; a sentence. */
  onNote: (sentence: string) => void = () => undefined;
  onEnd: () => void = () => undefined;

  constructor(private readonly stage: Stage, private readonly view: ThreeView, private readonly studio: Studio, private readonly tools: Tools) {
    this.pen = new XrPen(studio);
    this.hands = new XrHands();
    stage.scene.add(this.hands.group);
  }

  get presenting(): boolean {
    return this.session !== null;
  }

  /** Throws an Error with a sentence where the headset cannot be entered. */
  async enter(mode: 'immersive-vr' | 'immersive-ar'): Promise<void> {
    const xr = navigator.xr;
    if (!isSecureContext) throw new Error('Browsers let only pages from HTTPS into a headset. Start `mimicry serve --lan` and open the address that it prints.');
    if (!xr) throw new Error('This browser has no WebXR, with which pages reach headsets. Open this page in the headset’s own browser (`mimicry serve --lan` prints its address), or in Chrome or Edge with a headset connected.');
    let session: XRSession;
    try {
      session = await xr.requestSession(mode, { requiredFeatures: ['local-floor'], optionalFeatures: ['bounded-floor', 'hand-tracking'] });
    } catch (error) {
      const denied = error instanceof DOMException && (error.name === 'NotAllowedError' || error.name === 'SecurityError');
      throw new Error(denied
        ? 'The headset was not entered because permission was denied. Allow virtual reality for this page in the browser’s site settings, and press the button again.'
        : error instanceof DOMException && error.name === 'NotSupportedError'
          ? 'The browser found no headset. Connect one and wake it, or open this page in the headset’s own browser (`mimicry serve --lan` prints its address).'
          : 'The headset did not start. Check that it is connected and awake, and press the button again.');
    }
    this.studio.endStroke();
    this.session = session;
    this.grabbed = 0;
    this.pagePlace.set(this.studio.state.now.modelToWorld);
    this.pageModel = this.studio.state.now.model;
    this.baseScale = this.pagePlace[7]!;
    this.placed = false;
    this.hinted = true;
    for (const hand of kHands) Object.assign(this.devices[hand], device(hand));
    session.addEventListener('end', () => this.ended());
    session.addEventListener('visibilitychange', () => {
      if (session.visibilityState !== 'visible') this.stop();
    });
    session.addEventListener('selectstart', (event) => this.select(event.inputSource, true));
    session.addEventListener('selectend', (event) => this.select(event.inputSource, false));
    this.stage.enterXr(mode === 'immersive-ar');
    this.hands.visible = true;
    try {
      await this.stage.renderer.xr.setSession(session);
    } catch {
      await session.end().catch(() => undefined);
      throw new Error('The headset’s picture could not be set up. Reload the page and press the button again.');
    }
  }

  async exit(): Promise<void> {
    await this.session?.end();
  }

  /** The renderer may hear of it later, and has the headset's size until then. */
  private ended(): void {
    this.stop();
    const { xr } = this.stage.renderer;
    if (!xr.isPresenting) {
      this.leave();
      return;
    }
    const leave = (): void => {
      xr.removeEventListener('sessionend', leave);
      this.leave();
    };
    xr.addEventListener('sessionend', leave);
  }

  private leave(): void {
    this.session = null;
    this.hands.visible = false;
    this.view.pen.hide();
    // The page shows the model where it stood there.
    if (this.studio.state.now.model === this.pageModel) this.studio.place(this.pagePlace);
    this.view.showTwinInRoom(false, this.studio.state.now.modelToWorld);
    this.stage.leaveXr();
    this.onEnd();
  }

  /** The model stands before the head, facing it, a little below the eyes, near enough for the hands. */
  private standBefore(head: XRRigidTransform): void {
    const { position: p, orientation: q } = head;
    this.axis[0] = 0; this.axis[1] = 0; this.axis[2] = -1;
    rotate(this.axis, 0, [q.x, q.y, q.z, q.w], 0, this.axis, 0);
    const level = Math.hypot(this.axis[0]!, this.axis[2]!);
    // Someone who looks straight up or down stands some way.
    const x = level > 0.1 ? this.axis[0]! / level : 0, z = level > 0.1 ? this.axis[2]! / level : -1;
    const { model } = this;
    model.set(this.pagePlace);
    const yaw = Math.atan2(-x, -z);
    multiply(model, 0, [0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2)], 0, model, 0);
    const size = this.studio.target!.diagonal * model[7]!;
    const away = Math.min(kFarthest_m, Math.max(kNearest_m, 0.25 + 0.7 * size));
    const centre = this.studio.centre();
    model[4] = 0; model[5] = 0; model[6] = 0;
    toWorld(this.spot, 0, model, centre, 0);
    model[4] = p.x + away * x - this.spot[0]!;
    model[5] = p.y - kBelowEyes_m - this.spot[1]!;
    model[6] = p.z + away * z - this.spot[2]!;
    this.studio.place(model);
    this.placed = true;
  }

  /** Ends what the hands are doing and keeps it. */
  private stop(): void {
    this.pen.release();
    for (const hand of kHands) {
      this.devices[hand].trigger.held = false;
      this.devices[hand].squeeze.held = false;
      this.devices[hand].selecting = false;
    }
    this.grabbed = 0;
  }

  private select(source: XRInputSource, on: boolean): void {
    // Controllers are read from their gamepad: some systems fire `select` at press, others half-way.
    if (!source.gamepad) this.deviceOf(source).selecting = on;
  }

  private deviceOf(source: XRInputSource): Device {
    return this.devices[source.handedness === 'none' ? this.studio.settings.hand : source.handedness];
  }

  /** A frame of the headset. */
  update(time_ms: number, dt_s: number, frame: XRFrame): void {
    const space = this.stage.renderer.xr.getReferenceSpace();
    if (!this.session || !space) return;
    const viewer = frame.getViewerPose(space);
    if (viewer && !this.placed && this.studio.target) this.standBefore(viewer.transform);
    this.read(frame, space);
    const pen = this.devices[this.studio.settings.hand];
    const other = this.devices[pen.hand === 'left' ? 'right' : 'left'];

    this.grab(pen, other);
    this.sticks(pen, other, dt_s);
    if (viewer && pen.tracked) {
      const p = viewer.transform.position, q = viewer.transform.orientation, f = this.pen.frame;
      this.lastTime_ms = Math.max(this.lastTime_ms, time_ms);
      f[kTime] = this.lastTime_ms / 1000;
      f[kHead] = p.x; f[kHead + 1] = p.y; f[kHead + 2] = p.z;
      f[kHead + 3] = q.x; f[kHead + 4] = q.y; f[kHead + 5] = q.z; f[kHead + 6] = q.w;
      for (let k = 0; k < 7; k += 1) f[kController + k] = pen.pose[k]!;
      f[kTrigger] = Math.min(1, Math.max(0, pen.value));
      f[kPressure] = -1;
      for (let k = 0; k < 3; k += 1) this.tip[k] = pen.pose[k]!;
      this.point(pen);
    } else if (this.pen.used) {
      // The stroke is kept up to here; it does not go on when the controller is seen again.
      this.pen.release();
      pen.trigger.held = true;
      this.waiting = true;
      this.onNote('The controller was lost from sight; the stroke was ended and kept.');
    }
    this.view.showTwinInRoom(this.studio.settings.compare !== null, this.studio.state.now.modelToWorld);
    this.hands.show(pen, other, this.studio.settings, this.handsText);
    if (this.hinted) this.hint();
    this.show(pen);
  }

  /** The trigger must be let go before the next stroke. */
  private waiting = false;

  private read(frame: XRFrame, space: XRReferenceSpace): void {
    // Counting loops: iterators and closures would be garbage in every frame.
    for (let i = 0; i < kHands.length; i += 1) {
      const d = this.devices[kHands[i]!];
      d.before.set(d.pose);
      d.tracked = false;
      d.source = null;
    }
    const { inputSources } = this.session!;
    for (let i = 0; i < inputSources.length; i += 1) {
      const source = inputSources[i]!;
      const d = this.deviceOf(source);
      if (d.tracked) continue;
      d.source = source;
      const pose = frame.getPose(source.targetRaySpace, space);
      if (pose) {
        const p = pose.transform.position, q = pose.transform.orientation;
        const known = d.pose[3] !== 0 || d.pose[4] !== 0 || d.pose[5] !== 0 || d.pose[6] !== 0;
        d.pose[0] = p.x; d.pose[1] = p.y; d.pose[2] = p.z;
        d.pose[3] = q.x; d.pose[4] = q.y; d.pose[5] = q.z; d.pose[6] = q.w;
        if (!known) d.before.set(d.pose);
        d.tracked = true;
      }
      d.value = source.gamepad ? (source.gamepad.buttons[kTriggerButton]?.value ?? 0) : d.selecting ? 1 : 0;
    }
  }

  /** Uses the tool with the trigger. */
  private point(pen: Device): void {
    const edge = pen.trigger.update(pen.value);
    if (edge === 'release') this.waiting = false;
    if (edge === 'press' && !this.waiting) {
      if (this.pen.press(this.tools.now)) {
        this.hinted = false;
        this.hands.hint = null;
        pulse(pen.source, 0.6, 25);
      }
    } else if (pen.trigger.held) {
      this.pen.move();
    }
    if (edge === 'release') this.pen.release();
  }

  /** Until the first use the hint beside the pen says what the trigger does. */
  private hinted = false;
  private hintOf: Tool | null = null;

  private hint(): void {
    const { now } = this.tools;
    if (this.hands.hintVisible && now === this.hintOf) return;
    this.hintOf = now;
    this.hands.hint = now.hint.headset;
  }

  private readonly handsText = (): HandsText => {
    const { studio, tools } = this, { settings } = studio, tool = tools.now;
    return {
      title: tool.caption(studio),
      second: settings.compare ? `beside: ${studio.techniqueTitle(settings.compare)}` : `${(2000 * tool.size.get(settings)).toFixed(1)} mm`,
      third: `lower button: symmetry ${settings.mirror ? settings.mirror.toUpperCase() : 'off'} · upper: redo`,
      nib: tool.color(settings) ?? '#ffffff', ink: settings.style.color,
    };
  };

  /** The other hand holds the model; both hands turn and scale it. */
  private grab(pen: Device, other: Device): void {
    pen.squeeze.update(pen.source?.gamepad?.buttons[kSqueeze]?.value ?? 0);
    other.squeeze.update(other.source?.gamepad?.buttons[kSqueeze]?.value ?? 0);
    const penHolds = pen.squeeze.held && pen.tracked && !this.pen.used;
    const otherHolds = other.squeeze.held && other.tracked;
    const holds = (penHolds ? 1 : 0) + (otherHolds ? 2 : 0);
    // The first frame of a hold only remembers where the hands are.
    if (holds !== 0 && holds === this.grabbed) {
      this.model.set(this.studio.state.now.modelToWorld);
      if (holds === 3) stretchModel(this.model, pen.before, other.before, pen.pose, other.pose, kLeastScale * this.baseScale, kMostScale * this.baseScale);
      else carryModel(this.model, otherHolds ? other.before : pen.before, otherHolds ? other.pose : pen.pose);
      this.studio.place(this.model);
    }
    this.grabbed = holds;
  }

  private sticks(pen: Device, other: Device, dt_s: number): void {
    for (let i = 0; i < 2; i += 1) {
      const d = i === 0 ? pen : other;
      const pad = d.source?.gamepad;
      if (!pad) continue;
      const x = pad.axes[2] ?? 0, y = pad.axes[3] ?? 0;
      if (Math.abs(y) > kStickDead && Math.abs(y) > Math.abs(x)) {
        this.tools.resize(Math.exp(-y * dt_s * Math.log(kStickRate)));
      }
      const pushed = Math.abs(x) > 0.7 && Math.abs(x) > Math.abs(y);
      if (pushed && !d.stick) {
        if (d === pen) this.nextTechnique(Math.sign(x));
        else this.nextComparison(Math.sign(x));
      }
      d.stick = pushed;
      if (this.pushed(d, pad, kSecondButton)) {
        if (d === pen) this.studio.undo();
        else this.studio.redo();
      }
      if (this.pushed(d, pad, kFirstButton)) {
        if (d === pen) this.nextInk();
        else this.nextSymmetry();
      }
      if (this.pushed(d, pad, kStick)) this.tools.chooseNext();
    }
  }

  /** Whether a button went down since the last frame. */
  private pushed(d: Device, pad: Gamepad, number: number): boolean {
    const down = pad.buttons[number]?.pressed ?? false, before = d.buttons[number] ?? false;
    d.buttons[number] = down;
    if (down && !before) pulse(d.source, 0.3, 15);
    return down && !before;
  }

  private nextTechnique(step: number): void {
    const names = this.studio.core.techniques.map((t) => t.name).filter((name) => this.studio.offers(name));
    const at = names.indexOf(this.studio.settings.technique);
    this.studio.set({ technique: names[(at + step + names.length) % names.length]! });
  }

  private nextComparison(step: number): void {
    const names = [null, ...this.studio.core.techniques.map((t) => t.name).filter((name) => this.studio.offers(name))];
    const at = names.indexOf(this.studio.settings.compare);
    this.studio.set({ compare: names[(at + step + names.length) % names.length]! });
  }

  private nextInk(): void {
    const { style } = this.studio.settings;
    const at = kInks.findIndex(({ color }) => color === style.color);
    this.studio.set({ style: { ...style, color: kInks[(at + 1) % kInks.length]!.color } });
  }

  private nextSymmetry(): void {
    const axes = [null, 'x', 'y', 'z'] as const;
    this.studio.set({ mirror: axes[(axes.indexOf(this.studio.settings.mirror) + 1) % axes.length]! });
  }

  /** The laser from the tip: to the ink's end while drawing, else to where the spray would land. */
  private show(pen: Device): void {
    if (!pen.tracked || !this.studio.target) {
      this.view.pen.hide();
      return;
    }
    const place = this.studio.state.now.modelToWorld;
    const ink = this.studio.liveInk;
    const ring = Math.max((this.pen.used ?? this.tools.now).ring_m(this.studio.settings), 0.005);
    if (ink && ink.count > 0) {
      const at = (ink.count - 1) * kInkStride;
      for (let k = 0; k < 3; k += 1) {
        this.spot[k] = ink.floats[at + k]!;
        this.normal[k] = ink.floats[at + 3 + k]!;
      }
    } else {
      const hit = this.pen.aim();
      if (!hit) {
        this.view.pen.show(this.tip, 0.005, null, this.normal, ring);
        return;
      }
      this.spot.set(hit.position);
      this.normal.set(hit.normal);
    }
    toWorld(this.spot, 0, place, this.spot, 0);
    rotate(this.normal, 0, place, 0, this.normal, 0);
    this.view.pen.show(this.tip, 0.005, this.spot, this.normal, ring);
  }
}

/** A tick in the hand, where the controller can. */
function pulse(source: XRInputSource | null, strength: number, ms: number): void {
  const pad = source?.gamepad as (Gamepad & { hapticActuators?: readonly { pulse(value: number, ms: number): Promise<boolean> }[] }) | null | undefined;
  const actuator = pad?.hapticActuators?.[0];
  if (actuator?.pulse) void actuator.pulse(strength, ms);
}

export type { Device };
