import { CanvasTexture, ConeGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, MeshBasicMaterial, PlaneGeometry } from 'three';
import type { Settings } from '../settings';
import { techniqueTitle } from '../ui/technique_panel';

interface Hand {
  pose: Float64Array;
  tracked: boolean;
}

/** What is seen of the hands: a pen, a handle, and on it a card that says what the pen does. */
export class XrHands {
  readonly group = new Group();
  private readonly pen = new Group();
  private readonly handle = new Group();
  private readonly nib = new MeshStandardMaterial({ roughness: 0.4 });
  private readonly canvas = document.createElement('canvas');
  private readonly texture: CanvasTexture;
  private said: Settings | null = null;

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
    this.canvas.width = 512;
    this.canvas.height = 192;
    this.texture = new CanvasTexture(this.canvas);
    const card = new Mesh(new PlaneGeometry(0.16, 0.06), new MeshBasicMaterial({ map: this.texture, transparent: true, toneMapped: false }));
    card.position.set(0, 0.06, 0.02);
    card.rotation.x = -0.5;
    this.handle.add(grip, card);
    this.group.add(this.pen, this.handle);
    this.group.visible = false;
  }

  set visible(on: boolean) {
    this.group.visible = on;
  }

  show(pen: Hand, other: Hand, settings: Settings): void {
    place(this.pen, pen);
    place(this.handle, other);
    if (settings === this.said) return;
    this.said = settings;
    this.nib.color.set(settings.tool === 'draw' ? settings.style.color : '#ffffff');
    const title = settings.tool === 'draw' ? techniqueTitle(settings.technique) : settings.tool === 'erase curve' ? 'Erase curves' : 'Erase parts';
    this.write(title, settings.compare ? `beside: ${techniqueTitle(settings.compare)}` : `${(2000 * settings.style.radius_m).toFixed(1)} mm`, settings.style.color);
  }

  private write(title: string, second: string, color: string): void {
    const pen = this.canvas.getContext('2d')!;
    pen.clearRect(0, 0, 512, 192);
    pen.fillStyle = 'rgb(30 32 37 / 0.92)';
    pen.beginPath();
    pen.roundRect(0, 0, 512, 192, 40);
    pen.fill();
    pen.fillStyle = color;
    pen.beginPath();
    pen.arc(70, 96, 34, 0, 7);
    pen.fill();
    pen.strokeStyle = 'rgb(255 255 255 / 0.4)';
    pen.lineWidth = 3;
    pen.stroke();
    pen.fillStyle = '#fff';
    pen.font = '600 44px system-ui, sans-serif';
    pen.fillText(title, 130, 88, 360);
    pen.fillStyle = '#b9bbc0';
    pen.font = '36px system-ui, sans-serif';
    pen.fillText(second, 130, 140, 360);
    this.texture.needsUpdate = true;
  }
}

function place(group: Group, hand: Hand): void {
  group.visible = hand.tracked;
  const p = hand.pose;
  group.position.set(p[0]!, p[1]!, p[2]!);
  group.quaternion.set(p[3]!, p[4]!, p[5]!, p[6]!);
}
