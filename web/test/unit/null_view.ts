import type { Drawing } from '../../src/drawing/document';
import type { StudioView } from '../../src/studio/view';

/** Shows nothing and remembers what it was asked to show. */
export class NullView implements StudioView {
  drawing: Drawing = [];
  kept: string[] = [];
  live = new Set<number>();
  inkCalls = 0;
  replayed: string | null = null;
  showModel(): void { this.drawing = []; }
  place(): void {}
  beginInk(copy: number): void { this.live.add(copy); }
  growInk(): void { this.inkCalls += 1; }
  keepInk(copy: number, id: string): void { this.live.delete(copy); this.kept.push(id); }
  dropInk(): void { this.live.clear(); }
  showDrawing(drawing: Drawing): void { this.drawing = drawing; }
  showReplay(curve: { technique: string } | null): void { this.replayed = curve?.technique ?? null; }
}
