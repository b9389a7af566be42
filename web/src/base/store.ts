/** A value that tells who listens when it has been replaced. */
export class Store<T> {
  private readonly listeners = new Set<(now: T, before: T) => void>();

  constructor(private value: T) {}

  get now(): T {
    return this.value;
  }

  set(next: T): void {
    if (next === this.value) return;
    const before = this.value;
    this.value = next;
    for (const listener of this.listeners) listener(next, before);
  }

  update(part: Partial<T>): void {
    this.set({ ...this.value, ...part });
  }

  /** Calls the listener now and whenever the value is replaced; returns how to stop. */
  watch(listener: (now: T, before: T) => void): () => void {
    this.listeners.add(listener);
    listener(this.value, this.value);
    return () => this.listeners.delete(listener);
  }
}
