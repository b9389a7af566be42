import { BufferAttribute, BufferGeometry, Color, GLBufferAttribute, Group, Mesh, MeshStandardMaterial, Sphere } from 'three';
import { kRingSides, stripFaces, type Tube } from './tube';

/** Rings of a buffer: some hundred strokes. The first is small, as most drawings are. */
const kRings = 1 << 15, kFirstRings = 1 << 12;
const kVertexBytes = { position: 12, normal: 8, color: 8 };

/** Where a curve's rings lie. */
export interface InkPlace {
  page: Page;
  first: number;
  count: number;
}

/**
 * The rings of finished curves, many in one buffer that is drawn at once. All rings are one strip: what joins two curves
 * has no area, as every curve begins and ends in a ring without radius. A curve that goes leaves rings in one point,
 * which show nothing, and its place to the next one. The rings are on the graphics card alone.
 */
export class InkBatch {
  readonly group = new Group();
  private readonly pages: Page[] = [];
  private readonly material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.45, metalness: 0 });
  private readonly color = new Color();

  private readonly indices = new Map<number, GLBufferAttribute>(); // by capacity; without a copy here

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** A mesh with the material of ink, and nothing else. */
  sample(): Mesh {
    const geometry = new BufferGeometry(); // shaders depend on what a vertex has
    for (const [name, size] of [['position', 3], ['normal', 4], ['color', 4]] as const) geometry.setAttribute(name, new BufferAttribute(new Float32Array(size), size));
    return new Mesh(geometry, this.material);
  }

  /** Copies what the tube shows. */
  add(tube: Tube, color: string): InkPlace {
    const count = tube.ringCount;
    let first = -1, page = this.pages.find((p) => (first = p.reserve(count)) >= 0);
    if (!page) {
      page = this.page(Math.max(this.pages.length > 0 ? kRings : kFirstRings, count));
      this.pages.push(page);
      this.group.add(page.mesh);
      first = page.reserve(count);
    }
    page.write(first, count, tube.positions, tube.normals, this.color.set(color));
    return { page, first, count };
  }

  private page(capacity: number): Page {
    const { gl } = this;
    let index = this.indices.get(capacity);
    if (!index) {
      const faces = stripFaces(kRingSides, capacity), buffer = gl.createBuffer();
      // The vertex array that is current would take it for its own.
      const current = gl.getParameter(gl.VERTEX_ARRAY_BINDING) as WebGLVertexArrayObject | null;
      gl.bindVertexArray(null);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, faces, gl.STATIC_DRAW);
      gl.bindVertexArray(current);
      index = new GLBufferAttribute(buffer, gl.UNSIGNED_INT, 1, 4, faces.length);
      this.indices.set(capacity, index);
    }
    return new Page(gl, capacity, index, this.material);
  }

  remove({ page, first, count }: InkPlace): void {
    if (count === 0) return;
    page.clear(first, count);
    if (!page.isEmpty || this.pages.length === 1) return;
    this.pages.splice(this.pages.indexOf(page), 1);
    this.group.remove(page.mesh);
    page.dispose();
  }

  /** All is gone, with the graphics card's memory. */
  forget(): void {
    for (const page of this.pages) {
      this.group.remove(page.mesh);
      page.dispose();
    }
    this.pages.length = 0;
    for (const { buffer } of this.indices.values()) this.gl.deleteBuffer(buffer);
    this.indices.clear();
  }
}

/** Numbers for a curve on their way to the graphics card; as long as the longest. */
let numbers = new Int16Array(0);
function room(count: number): Int16Array {
  if (numbers.length < count) numbers = new Int16Array(2 * count);
  return numbers;
}

/** One buffer of rings. */
class Page {
  readonly mesh: Mesh;
  private readonly buffers: Record<keyof typeof kVertexBytes, WebGLBuffer>;
  private readonly geometry = new BufferGeometry();
  private end = 0; // rings from here on were never written
  private readonly holes: { first: number; count: number }[] = []; // in order, none beside another

  constructor(private readonly gl: WebGL2RenderingContext, private readonly capacity: number, index: GLBufferAttribute, material: MeshStandardMaterial) {
    const vertices = capacity * kRingSides;
    const buffer = (bytes: number): WebGLBuffer => {
      const made = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, made);
      gl.bufferData(gl.ARRAY_BUFFER, vertices * bytes, gl.DYNAMIC_DRAW);
      return made;
    };
    const { position, normal, color } = (this.buffers = {
      position: buffer(kVertexBytes.position), normal: buffer(kVertexBytes.normal), color: buffer(kVertexBytes.color),
    });
    const set = (name: string, attribute: GLBufferAttribute): void => {
      this.geometry.setAttribute(name, attribute as unknown as BufferAttribute);
    };
    set('position', new GLBufferAttribute(position, gl.FLOAT, 3, 4, vertices));
    set('normal', new GLBufferAttribute(normal, gl.SHORT, 4, 2, vertices, true));
    set('color', new GLBufferAttribute(color, gl.UNSIGNED_SHORT, 4, 2, vertices, true));
    this.geometry.setIndex(index as unknown as BufferAttribute);
    this.geometry.boundingSphere = new Sphere();
    this.geometry.setDrawRange(0, 0);
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false; // it is everywhere on the model
  }

  get isEmpty(): boolean {
    return this.end === 0;
  }

  /** The first of so many free rings; -1 where there are not so many side by side. */
  reserve(count: number): number {
    const i = this.holes.findIndex((hole) => hole.count >= count);
    if (i >= 0) {
      const hole = this.holes[i]!, { first } = hole;
      hole.first += count;
      hole.count -= count;
      if (hole.count === 0) this.holes.splice(i, 1);
      return first;
    }
    if (this.end + count > this.capacity) return -1;
    this.end += count;
    this.showTo(this.end);
    return this.end - count;
  }

  write(first: number, count: number, positions: Float32Array, normals: Float32Array, color: Color): void {
    const vertices = count * kRingSides;
    this.send('position', first, positions, 3 * vertices);
    const words = room(4 * vertices);
    for (let v = 0; v < vertices; v += 1) for (let k = 0; k < 3; k += 1) words[4 * v + k] = Math.round(32767 * normals[3 * v + k]!);
    this.send('normal', first, words, 4 * vertices);
    const rgb = [color.r, color.g, color.b];
    const colors = new Uint16Array(words.buffer);
    for (let v = 0; v < vertices; v += 1) for (let k = 0; k < 4; k += 1) colors[4 * v + k] = Math.round(65535 * (rgb[k] ?? 1));
    this.send('color', first, colors, 4 * vertices);
  }

  clear(first: number, count: number): void {
    const numbers = 3 * count * kRingSides;
    this.send('position', first, new Float32Array(room(2 * numbers).buffer).fill(0, 0, numbers), numbers);
    let i = this.holes.findIndex((hole) => hole.first > first);
    if (i < 0) i = this.holes.length;
    this.holes.splice(i, 0, { first, count });
    for (const k of [i, i - 1]) {
      const hole = this.holes[k], after = this.holes[k + 1];
      if (!hole || !after || hole.first + hole.count !== after.first) continue;
      hole.count += after.count;
      this.holes.splice(k + 1, 1);
    }
    const last = this.holes.at(-1)!;
    if (last.first + last.count !== this.end) return;
    this.end = last.first;
    this.holes.pop();
    this.showTo(this.end);
  }

  dispose(): void {
    this.geometry.setIndex(null); // other pages have the same
    this.geometry.dispose();
    for (const buffer of Object.values(this.buffers)) this.gl.deleteBuffer(buffer);
  }

  private showTo(end: number): void {
    this.geometry.setDrawRange(0, Math.max(0, end - 1) * kRingSides * 6);
  }

  private send(name: keyof typeof kVertexBytes, first: number, data: Float32Array | Int16Array | Uint16Array, count: number): void {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[name]);
    this.gl.bufferSubData(this.gl.ARRAY_BUFFER, first * kRingSides * kVertexBytes[name], data, 0, count);
  }
}
