import { Store } from '../base/store';
import type { Settings } from '../studio/settings';
import type { Studio } from '../studio/studio';
import { kDraw } from './draw';
import { kEraseCurve, kErasePart } from './erase';
import type { Tool } from './tool';

/** All tools, in the order in which they are offered. */
export const kTools: readonly Tool[] = [kDraw, kEraseCurve, kErasePart];

/** The tools of a studio, and which one is in use. */
export class Tools {
  readonly list: Store<readonly Tool[]>;

  constructor(private readonly studio: Studio, rows: readonly Tool[] = kTools) {
    this.list = new Store<readonly Tool[]>([]);
    for (const row of rows) this.add(row);
  }

  /** One more tool, from now on. */
  add(tool: Tool): void {
    const other = this.list.now.find(({ name, key }) => name === tool.name || key === tool.key);
    if (other) throw new Error(`The tools “${tool.name}” and “${other.name}” have the same name or key (${tool.key}); give the new one its own.`);
    this.list.set([...this.list.now, tool]);
  }

  /** In use. */
  get now(): Tool {
    return this.of(this.studio.settings);
  }

  /** Makes no garbage: a headset asks in each frame. */
  of({ tool }: Settings): Tool {
    const { now: list } = this.list;
    for (let i = 0; i < list.length; i += 1) if (list[i]!.name === tool) return list[i]!;
    return list[0]!;
  }

  choose(tool: Tool): void {
    this.studio.set({ tool: tool.name });
  }

  /** Takes the tool of this key into use; false: there is none. */
  chooseByKey(key: string): boolean {
    const tool = this.list.now.find((t) => t.key === key);
    if (tool) this.choose(tool);
    return tool !== undefined;
  }

  chooseNext(): void {
    const { now: list } = this.list;
    this.choose(list[(list.indexOf(this.now) + 1) % list.length]!);
  }

  /** The tool in use becomes `factor` times as large, within what it can be. */
  resize(factor: number): void {
    this.studio.set(this.sized(this.now.size.get(this.studio.settings) * factor));
  }

  /** The settings with the tool in use of this size. */
  sized(radius_m: number): Partial<Settings> {
    const { size } = this.now;
    return size.set(this.studio.settings, Math.min(size.most_m, Math.max(size.least_m, radius_m)));
  }

  /** A colour is chosen: to write with. */
  ink(color: string): void {
    const { style } = this.studio.settings;
    const writer = this.now.inks ? this.now : this.list.now.find(({ inks }) => inks);
    this.studio.set({ style: { ...style, color }, ...(writer ? { tool: writer.name } : {}) });
  }
}
