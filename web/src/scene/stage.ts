import {
  AmbientLight, Color, DirectionalLight, Group, HemisphereLight, PerspectiveCamera, Scene, SRGBColorSpace, Vector3, WebGLRenderer, type Camera, type Object3D,
} from 'three';
import { CameraRig } from './camera_rig';
import { RoomFloor } from './room_floor';

export interface Look {
  background: string;
  floor: string;
  clay: string;
}

export const kLooks: Record<'light' | 'dark', Look> = {
  light: { background: '#efece6', floor: '#d9d4ca', clay: '#e2dacd' },
  dark: { background: '#17191d', floor: '#23262c', clay: '#a9a7a3' },
};

/** Of the picture's height, in degrees. */
const kFov = 35;

/** Below this part of the height, the width says how far away the camera stands. */
const kNarrow = 0.7;

/** Less than this part of the height that controls leave free is too little for a picture. */
const kLeastFree = 0.25;

/** Why there is no picture: a sentence for people. */
export class NoGraphics extends Error {}

/**
 * Renderer, scene, camera, lights. Draws when something changed, and while a headset asks for
 * frames. The right half may show a second scene through the same camera (`twin`).
 */
export class Stage {
  readonly renderer: WebGLRenderer;
  readonly scene = new Scene();
  readonly twin = new Scene();
  readonly camera = new PerspectiveCamera(kFov, 1, 0.01, 100);
  readonly rig = new CameraRig(this.camera);
  /** What stands in the world whatever the camera does. */
  readonly world = new Group();
  split = false;
  /** Called before each picture with the seconds since the last one; true: another one is wanted. */
  onFrame: (dt_s: number, time_ms: number, xr: XRFrame | null) => boolean = () => false;
  onContext: (lost: boolean) => void = () => undefined;
  /** What lies on the graphics card alone is to be made anew. */
  onRestored: () => void = () => undefined;

  private dirty = true;
  private last_ms = 0;
  private readonly key = new DirectionalLight('#fff4e4', 2.2);
  private readonly twinKey = new DirectionalLight('#fff4e4', 2.2);
  private width = 1;
  private height = 1;

  constructor(private readonly canvas: HTMLCanvasElement, antialias: boolean) {
    // Its buffers are made once, in the size that they will have.
    const parent = canvas.parentElement!, ratio = Math.min(window.devicePixelRatio, 2);
    canvas.width = Math.max(1, Math.floor(parent.clientWidth * ratio));
    canvas.height = Math.max(1, Math.floor(parent.clientHeight * ratio));
    try {
      this.renderer = new WebGLRenderer({ canvas, antialias, alpha: true, powerPreference: 'high-performance' });
    } catch {
      throw new NoGraphics(
        'This browser shows no WebGL 2 graphics. Switch on hardware acceleration in its settings, or open the page in a current Chrome, Firefox, Safari or Edge.');
    }
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.debug.checkShaderErrors = import.meta.env.DEV; // asking waits for the driver
    this.renderer.xr.enabled = true;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    for (const [scene, key] of [[this.scene, this.key], [this.twin, this.twinKey]] as const) {
      scene.add(new HemisphereLight('#f6f8ff', '#8d8072', 1.45), new AmbientLight('#ffffff', 0.2), key, key.target);
    }
    this.scene.add(this.world);
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.onContext(true);
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.onContext(false);
      this.onRestored();
      this.invalidate();
    });
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
    this.renderer.setAnimationLoop((time, frame) => this.tick(time, frame ?? null));
  }

  setLook(look: Look): void {
    this.look = look;
    this.scene.background = new Color(look.background);
    this.twin.background = new Color(look.background);
    this.invalidate();
  }

  private look: Look = kLooks.light;
  private readonly floor = new RoomFloor();

  /** Someone stands in the scene: a floor under the feet, or the room through the glasses. */
  enterXr(seeThrough: boolean): void {
    if (seeThrough) {
      this.scene.background = null;
      return;
    }
    this.floor.look(this.look.floor, this.look === kLooks.dark);
    this.scene.add(this.floor.group);
  }

  /** The renderer has left the headset: window, camera and picture are as they were. */
  leaveXr(): void {
    this.scene.remove(this.floor.group);
    this.setLook(this.look);
    // The headset wrote its own pose and projection into the camera, and the window may have another size.
    this.camera.fov = kFov;
    this.camera.scale.setScalar(1);
    this.resize(true);
  }

  /** The driver makes ready for these while the page does other things; it takes its time. */
  warm(objects: Object3D): void {
    this.renderer.compile(this.scene, this.camera);
    this.renderer.compile(objects, this.camera, this.scene);
  }

  /** A new picture is wanted. */
  invalidate(): void {
    this.dirty = true;
  }

  private resize(anew = false): void {
    const parent = this.canvas.parentElement!;
    const width = Math.max(1, parent.clientWidth), height = Math.max(1, parent.clientHeight);
    if ((!anew && width === this.width && height === this.height) || this.renderer.xr.isPresenting) return;
    this.width = width;
    this.height = height;
    this.renderer.setSize(width, height, false);
    this.onResize();
    this.fitCamera();
    this.tick(performance.now(), null);
  }

  onResize: () => void = () => undefined;

  get aspect(): number {
    return (this.split ? this.width / 2 : this.width) / this.height;
  }

  /** Pixels at the top and bottom of the window that the page's controls cover. */
  private covered = { top: 0, bottom: 0 };

  cover(top: number, bottom: number): void {
    // A very low window is not covered: its controls float over the picture.
    const least = kLeastFree * this.height;
    this.covered = this.height - top - bottom < least ? { top: 0, bottom: 0 } : { top, bottom };
    this.fitCamera();
  }

  /** The camera's axis meets the window this far above its middle, in half heights. */
  get axisY(): number {
    return (this.covered.bottom - this.covered.top) / this.height;
  }

  /** How much of the window's height is free. */
  get freeHeight(): number {
    return 1 - (this.covered.top + this.covered.bottom) / this.height;
  }

  /** Window, halves and what is covered: a view that was framed for others is to be framed anew. */
  get framing(): string {
    return [this.width, this.height, this.split, this.covered.top, this.covered.bottom].join();
  }

  private narrow = kNarrow;

  private fitCamera(): void {
    const width = this.split ? this.width / 2 : this.width;
    this.camera.aspect = this.aspect;
    // What is seen of the model stays in sight where the picture becomes narrow (a turned phone, two halves).
    const narrow = Math.min(kNarrow, this.aspect);
    this.rig.scale(this.narrow / narrow);
    this.narrow = narrow;
    this.camera.setViewOffset(width, this.height, 0, (this.covered.bottom - this.covered.top) / 2, width, this.height);
    this.invalidate();
  }

  private tick(time_ms: number, frame: XRFrame | null): void {
    const dt_s = Math.min(0.1, Math.max(0, (time_ms - this.last_ms) / 1000));
    this.last_ms = time_ms;
    const presenting = this.renderer.xr.isPresenting;
    const more = this.onFrame(dt_s, time_ms, frame);
    if (!presenting) {
      if (this.camera.aspect !== this.aspect) this.fitCamera();
      if (this.rig.update(dt_s)) this.dirty = true;
    }
    if (!presenting && !this.dirty && !more) return;
    this.dirty = false;
    this.light(presenting ? this.renderer.xr.getCamera() : this.camera);
    if (this.split && !presenting) {
      const half = Math.floor(this.width / 2);
      this.renderer.setScissorTest(true);
      this.renderer.setViewport(0, 0, half, this.height);
      this.renderer.setScissor(0, 0, half, this.height);
      this.renderer.render(this.scene, this.camera);
      this.renderer.setViewport(half, 0, this.width - half, this.height);
      this.renderer.setScissor(half, 0, this.width - half, this.height);
      this.renderer.render(this.twin, this.camera);
      this.renderer.setScissorTest(false);
      this.renderer.setViewport(0, 0, this.width, this.height);
    } else {
      this.renderer.render(this.scene, this.camera);
    }
  }

  /** The key light comes over the viewer's left shoulder. */
  private light(camera: Camera): void {
    direction.set(-0.55, 0.85, 1.15).applyQuaternion(camera.quaternion);
    for (const key of [this.key, this.twinKey]) {
      key.target.position.copy(this.world.position);
      key.position.copy(this.world.position).add(direction);
    }
  }
}

const direction = new Vector3();
