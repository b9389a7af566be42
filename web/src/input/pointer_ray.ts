import { Vector3 } from 'three';
import { directionToModel, toModel } from '../math/similarity';
import type { Stage } from '../scene/stage';
import type { Studio } from '../studio/studio';
import { makeView } from './screen_frame';

/** Radians a window height. */
export const kOrbitSpeed = 5.5;

export interface At {
  clientX: number;
  clientY: number;
}

/** The ray through the pointer: in the world, and seen from the model. */
export class PointerRay {
  readonly view = makeView();
  private readonly origin = new Float64Array(3);
  private readonly towards = new Float64Array(3);

  constructor(private readonly canvas: HTMLCanvasElement, private readonly stage: Stage, private readonly studio: Studio) {}

  /** Where a point of the window lies in the picture that it belongs to (a half, when comparing): -1 to 1, right and up. */
  picture(x: number, y: number): readonly [number, number] {
    // The canvas fills the window.
    const { clientWidth, clientHeight } = this.canvas;
    const width = this.stage.split ? clientWidth / 2 : clientWidth;
    const left = this.stage.split && x > width ? width : 0;
    return [(2 * (x - left)) / width - 1, 1 - (2 * y) / clientHeight];
  }

  /** Takes camera and pointer as they are now. */
  aim(at: At): void {
    const { camera } = this.stage;
    const v = this.view;
    camera.position.toArray(v.eye as unknown as number[]);
    ray.set(...this.picture(at.clientX, at.clientY), 0.5).unproject(camera).sub(camera.position).normalize();
    v.direction[0] = ray.x; v.direction[1] = ray.y; v.direction[2] = ray.z;
    ray.set(0, 0, -1).applyQuaternion(camera.quaternion);
    v.forward[0] = ray.x; v.forward[1] = ray.y; v.forward[2] = ray.z;
    ray.set(0, 1, 0).applyQuaternion(camera.quaternion);
    v.up[0] = ray.x; v.up[1] = ray.y; v.up[2] = ray.z;
    const place = this.studio.state.now.modelToWorld;
    toModel(this.origin, 0, place, v.eye, 0);
    directionToModel(this.towards, 0, place, v.direction, 0);
  }

  /** What is under the pointer, model space; `distance` from the eye. */
  hit(): ReturnType<NonNullable<Studio['target']>['firstHit']> {
    const { origin: o, towards: d } = this;
    return this.studio.target?.firstHit(o[0]!, o[1]!, o[2]!, d[0]!, d[1]!, d[2]!) ?? null;
  }
}

const ray = new Vector3();
