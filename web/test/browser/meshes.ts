/** Text of a torus around z as OBJ: 6 n^2 faces. */
export function torusObj(n: number): string {
  const lines: string[] = [];
  const around = 3 * n;
  for (let i = 0; i < around; i += 1) {
    for (let j = 0; j < n; j += 1) {
      const a = (2 * Math.PI * i) / around, b = (2 * Math.PI * j) / n;
      const r = 0.8 + 0.32 * Math.cos(b);
      lines.push(`v ${(r * Math.cos(a)).toFixed(9)} ${(r * Math.sin(a)).toFixed(9)} ${(0.32 * Math.sin(b)).toFixed(9)}`);
    }
  }
  const at = (i: number, j: number): number => (i % around) * n + (j % n) + 1;
  for (let i = 0; i < around; i += 1) {
    for (let j = 0; j < n; j += 1) {
      lines.push(`f ${at(i, j)} ${at(i + 1, j)} ${at(i + 1, j + 1)}`, `f ${at(i, j)} ${at(i + 1, j + 1)} ${at(i, j + 1)}`);
    }
  }
  return lines.join('\n') + '\n';
}
