export type Edge = 'press' | 'release' | null;

/** A trigger that is pressed above one value and released below a lower one: no flutter in between. */
export class Hysteresis {
  held = false;

  constructor(private readonly on = 0.55, private readonly off = 0.35) {}

  update(value: number): Edge {
    if (!this.held && value >= this.on) {
      this.held = true;
      return 'press';
    }
    if (this.held && value <= this.off) {
      this.held = false;
      return 'release';
    }
    return null;
  }
}
