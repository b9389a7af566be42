import { CanvasTexture, ConeGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, MeshBasicMaterial, PlaneGeometry } from 'three';

interface Hand {
  pose: Float64Array;
  tracked: boolean;
}

/** What the card on the other hand says. */
export interface HandsText {
  title: string;
  second: string;
  third: string;
  /** Of the nib, and of the dot on the card. */
  nib: string;
  ink: string;
}

/** What is seen of the hands: a pen, a handle, and on it a card that says what the pen does. */
export class XrHands {
  readonly group = new Group();
  private readonly pen = new Group();
  private readonly handle = new Group();
  private readonly nib = new MeshStandardMaterial({ roughness: 0.4 });
  private readonly card = new Card(0.16, 512, 240);
  private readonly hintCard = new Card(0.2, 640, 96);
  private said: object | null = null;

  constructor() {
    const body = new MeshStandardMaterial({ color: '#3a3d44', roughness: 0.6 });
    const cone = new Mesh(new ConeGeometry(0.008, 0.03, 20), this.nib);
    cone.rotation.x = -Math.PI / 2;
    cone.position.z = 0.015;
    const shaft = new Mesh(new CylinderGeometry(0.008, 0.01, 0.1, 20), body);
    shaft.rotation.x = -Math.PI / 2;
    shaft.position.z = 0.08;
    this.pen.add(cone, shaft);
    const grip = new Mesh(new CylinderGeometry(0.012, 0.014, 0.11, 20), body);
    grip.rotation.x = -Math.PI / 2;
    grip.position.z = 0.05;
    this.card.mesh.position.set(0, 0.07, 0.02);
    this.card.mesh.rotation.x = -0.5;
    this.handle.add(grip, this.card.mesh);
    this.hintCard.mesh.position.set(0, 0.06, 0.02);
    this.hintCard.mesh.rotation.x = -0.5;
    this.pen.add(this.hintCard.mesh);
    this.hint = null;
    this.group.add(this.pen, this.handle);
    this.group.visible = false;
  }

  set visible(on: boolean) {
    this.group.visible = on;
  }

  /** A sentence beside the pen; null: none. */
  set hint(text: string | null) {
    this.hintCard.mesh.visible = text !== null;
    if (text === null) return;
    this.hintCard.clear();
    this.hintCard.line(text, 32, 60, 36, '#fff', 576);
    this.hintCard.done();
  }

  get hintVisible(): boolean {
    return this.hintCard.mesh.visible;
  }

  /** A card is written when `state`, an object, is another one. */
  show(pen: Hand, other: Hand, state: object, text: () => HandsText): void {
    place(this.pen, pen);
    place(this.handle, other);
    if (state === this.said) return;
    this.said = state;
    const { card } = this, { title, second, third, nib, ink } = text();
    this.nib.color.set(nib);
    card.clear();
    card.dot(70, 80, 34, ink);
    card.line(title, 130, 74, 44, '#fff', 360);
    card.line(second, 130, 126, 36, '#b9bbc0', 360);
    card.line(third, 36, 196, 28, '#b9bbc0', 450);
    card.done();
  }
}

/** A card with text in the room. width_m: in the room; the picture's size in pixels. */
class Card {
  private readonly canvas = document.createElement('canvas');
  private readonly texture: CanvasTexture;
  readonly mesh: Mesh;

  constructor(width_m: number, width: number, height: number) {
    this.canvas.width = width;
    this.canvas.height = height;
    this.texture = new CanvasTexture(this.canvas);
    this.mesh = new Mesh(new PlaneGeometry(width_m, (width_m * height) / width), new MeshBasicMaterial({ map: this.texture, transparent: true, toneMapped: false }));
  }

  clear(): void {
    const pen = this.canvas.getContext('2d')!;
    const { width, height } = this.canvas;
    pen.clearRect(0, 0, width, height);
    pen.fillStyle = 'rgb(30 32 37 / 0.92)';
    pen.beginPath();
    pen.roundRect(0, 0, width, height, 40);
    pen.fill();
  }

  dot(x: number, y: number, radius: number, color: string): void {
    const pen = this.canvas.getContext('2d')!;
    pen.fillStyle = color;
    pen.beginPath();
    pen.arc(x, y, radius, 0, 7);
    pen.fill();
    pen.strokeStyle = 'rgb(255 255 255 / 0.4)';
    pen.lineWidth = 3;
    pen.stroke();
  }

  line(text: string, x: number, y: number, size: number, color: string, most: number): void {
    const pen = this.canvas.getContext('2d')!;
    pen.fillStyle = color;
    pen.font = `600 ${size}px system-ui, sans-serif`;
    pen.fillText(text, x, y, most);
  }

  done(): void {
    this.texture.needsUpdate = true;
  }
}

function place(group: Group, hand: Hand): void {
  group.visible = hand.tracked;
  const p = hand.pose;
  group.position.set(p[0]!, p[1]!, p[2]!);
  group.quaternion.set(p[3]!, p[4]!, p[5]!, p[6]!);
}
