import {
  BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, PlaneGeometry, Quaternion, Sphere, Vector3,
} from 'three';
import type { Corners } from '../engine/creased';

/** A target as it is shown, with whatever is drawn on it as children in model space. */
export class ModelView {
  readonly group = new Group();
  private readonly mesh: Mesh<BufferGeometry, MeshStandardMaterial>;
  private readonly mirror: Mesh<PlaneGeometry, MeshBasicMaterial>;

  constructor(clay: string) {
    this.mesh = new Mesh(noTriangles(), new MeshStandardMaterial({
      color: clay, roughness: 0.82, metalness: 0, side: DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    }));
    this.mirror = new Mesh(new PlaneGeometry(1, 1), new MeshBasicMaterial({
      color: '#3d7eff', transparent: true, opacity: 0.13, side: DoubleSide, depthWrite: false,
    }));
    this.mirror.visible = false;
    this.group.add(this.mesh, this.mirror);
  }

  set clay(color: string) {
    this.mesh.material.color.set(color);
  }

  /** Within `radius` of `centre`: looking for it takes long where there are many corners. */
  show(corners: Corners, centre: readonly number[], radius: number): void {
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute('position', new BufferAttribute(corners.positions, 3));
    this.mesh.geometry.setAttribute('normal', new BufferAttribute(corners.normals, 3));
    this.mesh.geometry.setIndex(new BufferAttribute(corners.faces, 1));
    this.mesh.geometry.boundingSphere = new Sphere(new Vector3(centre[0], centre[1], centre[2]), radius);
  }

  /** The same triangles in a second view. */
  shareWith(other: ModelView): void {
    other.mesh.geometry = this.mesh.geometry;
  }

  place(modelToWorld: Float64Array): void {
    const s = modelToWorld;
    this.group.quaternion.set(s[0]!, s[1]!, s[2]!, s[3]!);
    this.group.position.set(s[4]!, s[5]!, s[6]!);
    this.group.scale.setScalar(s[7]!);
    this.group.updateMatrixWorld();
  }

  /** The plane of symmetry through `centre`, as large as the model; null: none. */
  showMirror(axis: 'x' | 'y' | 'z' | null, centre: readonly number[], size: number): void {
    this.mirror.visible = axis !== null;
    if (!axis) return;
    this.mirror.position.set(centre[0]!, centre[1]!, centre[2]!);
    this.mirror.scale.setScalar(size);
    this.mirror.quaternion.copy(turn.setFromUnitVectors(zAxis, new Vector3(axis === 'x' ? 1 : 0, axis === 'y' ? 1 : 0, axis === 'z' ? 1 : 0)));
  }
}

/** What a model has, before there is one: the driver makes its program ready by it. */
function noTriangles(): BufferGeometry {
  const geometry = new BufferGeometry();
  for (const name of ['position', 'normal']) geometry.setAttribute(name, new BufferAttribute(new Float32Array(9), 3));
  return geometry;
}

const zAxis = new Vector3(0, 0, 1);
const turn = new Quaternion();
