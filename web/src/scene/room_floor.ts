import { BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial } from 'three';

/** The floor fades from here to there, metres from where one stands: an edge would be a circle around the eye, and look like a hill. */
const kClear_m = 1.5, kGone_m = 14;
const kLines_m = 0.5, kGridGone_m = 7;

/** A flat floor with lines, that goes over into the background. */
export class RoomFloor {
  readonly group = new Group();
  private readonly ground = new Mesh(discs(), new MeshBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }));
  private readonly grid = new LineSegments(lines(), new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }));

  constructor() {
    this.grid.position.y = 0.002;
    this.ground.renderOrder = -2;
    this.grid.renderOrder = -1;
    this.group.add(this.ground, this.grid);
  }

  /** floor: its colour; the lines are darker or lighter, as the background asks. */
  look(floor: string, isDark: boolean): void {
    this.ground.material.color.set(floor);
    this.grid.material.color.copy(new Color(floor)).lerp(new Color(isDark ? '#ffffff' : '#000000'), 0.3);
  }
}

/** How much of the floor is seen at a distance; smooth at both ends. */
function seen(distance: number, gone: number): number {
  const t = Math.min(1, Math.max(0, (distance - kClear_m) / (gone - kClear_m)));
  return (1 - t) ** 2 * (1 + 2 * t);
}

/** Rings around the origin in the plane y = 0, facing up. */
export function discs(rings = 28, around = 48): BufferGeometry {
  const positions: number[] = [], colors: number[] = [], faces: number[] = [];
  for (let i = 0; i <= rings; i += 1) {
    const radius = kGone_m * (i / rings) ** 1.5; // finer where one stands
    for (let j = 0; j < around; j += 1) {
      const angle = (2 * Math.PI * j) / around;
      positions.push(radius * Math.cos(angle), 0, radius * Math.sin(angle));
      colors.push(1, 1, 1, seen(radius, kGone_m));
      const a = (i - 1) * around + j, b = (i - 1) * around + ((j + 1) % around);
      if (i > 0) faces.push(a, b, a + around, b, b + around, a + around);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colors), 4));
  geometry.setIndex(faces);
  return geometry;
}

function lines(): BufferGeometry {
  const positions: number[] = [], colors: number[] = [];
  const count = Math.ceil(kGridGone_m / kLines_m);
  const corner = (x: number, z: number): void => {
    positions.push(x, 0, z);
    colors.push(1, 1, 1, 0.6 * seen(Math.hypot(x, z), kGridGone_m));
  };
  for (let i = -count; i <= count; i += 1) {
    for (let j = -count; j < count; j += 1) {
      const a = i * kLines_m, b = j * kLines_m, c = (j + 1) * kLines_m;
      corner(a, b); corner(a, c);
      corner(b, a); corner(c, a);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colors), 4));
  return geometry;
}
