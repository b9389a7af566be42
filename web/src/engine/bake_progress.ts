/** The stages of a bake in words, and which part of the time each takes (bakes of the built-in shapes, in a browser). */
const kStages: Readonly<Record<string, { words: string; part: number }>> = {
  shell: { words: 'wrapping it in a thin layer', part: 0.15 },
  samples: { words: 'choosing points on it', part: 0.01 },
  distances: { words: 'measuring distances along it', part: 0.18 },
  mds: { words: 'laying it out', part: 0.16 },
  'ls-mesh': { words: 'making it smooth', part: 0.5 },
};
/** A stage that falls back further than this has begun a new round. */
const kNewRound = 0.1;
/** Before so much is done nobody can tell how long the rest takes. */
const kLeastDone = 0.08, kLeastTime_ms = 2000;

/** One bar for a whole bake: it never runs backwards, and says how long is left. */
export class BakeProgress {
  private readonly began_ms: number;
  private done = 0;
  private stage = '';
  private last = 0; // fraction of the stage
  private from = 0;
  private to = 0;

  constructor(private readonly now: () => number = () => performance.now()) {
    this.began_ms = now();
  }

  /** What to show; `fraction` is the stage's own. */
  take(stage: string, fraction: number): { text: string; fraction: number } {
    const known = kStages[stage];
    if (known && stage !== this.stage) {
      this.stage = stage;
      this.to = endOf(stage);
      this.from = Math.min(Math.max(this.to - known.part, this.done), this.to);
    } else if (known && fraction < this.last - kNewRound) {
      this.from = this.done;
      this.to = (this.done + endOf(stage)) / 2; // and there may be more
    }
    this.last = fraction;
    this.done = Math.max(this.done, this.from + (this.to - this.from) * Math.min(1, Math.max(0, fraction)));
    const words = kStages[this.stage]?.words;
    return { text: `Preparing the model${words ? `: ${words}` : ''}${this.left()}`, fraction: this.done };
  }

  private left(): string {
    const spent_ms = this.now() - this.began_ms;
    if (this.done < kLeastDone || spent_ms < kLeastTime_ms) return '';
    const left_s = (spent_ms * (1 - this.done)) / this.done / 1000;
    if (left_s >= 90) return ` (about ${Math.round(left_s / 60)} minutes left)`;
    if (left_s >= 50) return ' (about a minute left)';
    return left_s >= 8 ? ` (about ${10 * Math.round(left_s / 10)} seconds left)` : ' (a few seconds left)';
  }
}

function endOf(stage: string): number {
  let end = 0;
  for (const [name, { part }] of Object.entries(kStages)) {
    end += part;
    if (name === stage) break;
  }
  return end;
}
