import {
  BufferAttribute, BufferGeometry, Color, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, RingGeometry, SphereGeometry, Quaternion, Vector3,
} from 'three';

/**
 * The pen's tip, the laser from it to the point that it draws at, and a ring that lies on the
 * surface there. World coordinates.
 */
export class PenView {
  readonly group = new Group();
  private readonly tip: Mesh;
  private readonly ring: Mesh;
  private readonly laser: Line;
  private readonly ends = new Float32Array(6);
  private readonly color = new MeshBasicMaterial({ toneMapped: false });
  private readonly line = new LineBasicMaterial({ transparent: true, opacity: 0.55, toneMapped: false });

  constructor() {
    this.tip = new Mesh(new SphereGeometry(1, 20, 14), this.color);
    this.ring = new Mesh(new RingGeometry(0.72, 1, 40), this.color);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(this.ends, 3));
    this.laser = new Line(geometry, this.line);
    this.laser.frustumCulled = false;
    this.group.add(this.tip, this.ring, this.laser);
    this.hide();
  }

  hide(): void {
    this.group.visible = false;
  }

  get visible(): boolean {
    return this.group.visible;
  }

  set inkColor(color: string) {
    this.color.color.set(color);
    this.line.color.copy(new Color(color));
  }

  /** tip: of the pen. point, normal: on the surface, null where there is none. sizes in metres. */
  show(tip: Float64Array, tipRadius: number, point: Float64Array | null, normal: Float64Array, ringRadius: number): void {
    this.group.visible = true;
    this.tip.visible = tipRadius > 0;
    this.tip.position.set(tip[0]!, tip[1]!, tip[2]!);
    this.tip.scale.setScalar(Math.max(1e-6, tipRadius));
    this.ring.visible = point !== null;
    this.laser.visible = point !== null && tipRadius > 0;
    if (!point) return;
    z.set(normal[0]!, normal[1]!, normal[2]!);
    this.ring.quaternion.copy(turn.setFromUnitVectors(front, z));
    this.ring.scale.setScalar(ringRadius);
    this.ring.position.set(point[0]!, point[1]!, point[2]!).addScaledVector(z, 0.15 * ringRadius);
    for (let k = 0; k < 3; k += 1) {
      this.ends[k] = tip[k]!;
      this.ends[3 + k] = point[k]!;
    }
    (this.laser.geometry.getAttribute('position') as BufferAttribute).needsUpdate = true;
  }
}

const z = new Vector3();
const front = new Vector3(0, 0, 1);
const turn = new Quaternion();
