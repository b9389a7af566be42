/** Which of a curve's points are still there: [first, last] by number, in order, apart. */
export type Range = readonly [number, number];

/** Everything but the points for which `gone` says true. A part of a single point is dropped unless it was one before. */
export function without(kept: readonly Range[], gone: (point: number) => boolean): readonly Range[] {
  const left: Range[] = [];
  let changed = false;
  for (const range of kept) {
    let first = -1;
    let whole = true;
    const close = (last: number): void => {
      if (first >= 0 && last > first) left.push([first, last]);
      first = -1;
    };
    for (let i = range[0]; i <= range[1]; i += 1) {
      if (gone(i)) {
        whole = false;
        close(i - 1);
      } else if (first < 0) {
        first = i;
      }
    }
    if (whole) left.push(range);
    else close(range[1]);
    changed ||= !whole;
  }
  return changed ? left : kept;
}

/** True where a segment between points i and i + 1 is drawn. */
export function joins(kept: readonly Range[], i: number): boolean {
  for (const [first, last] of kept) if (i >= first && i < last) return true;
  return false;
}
