/** For each vertex the lowest number with an equal position: files repeat positions at seams. -0 is 0. O(#V). */
export function equalPlaces(positions: Float64Array): Uint32Array {
  const count = positions.length / 3;
  let size = 16;
  while (size < 2 * count) size *= 2;
  const slots = new Int32Array(size).fill(-1);
  const places = new Uint32Array(count);
  const number = new Float64Array(3);
  const word = new Int32Array(number.buffer);
  for (let v = 0; v < count; v += 1) {
    for (let k = 0; k < 3; k += 1) number[k] = positions[3 * v + k]! + 0;
    let hash = 0;
    for (let i = 0; i < 6; i += 1) {
      hash = Math.imul(hash ^ word[i]!, 0x9e3779b1);
      hash ^= hash >>> 15;
    }
    let slot = hash & (size - 1);
    let found = slots[slot]!;
    while (found >= 0 && (positions[3 * found] !== number[0] || positions[3 * found + 1] !== number[1] || positions[3 * found + 2] !== number[2])) {
      slot = (slot + 1) & (size - 1);
      found = slots[slot]!;
    }
    if (found < 0) slots[slot] = found = v;
    places[v] = found;
  }
  return places;
}
