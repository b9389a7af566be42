// Names of measures as the page's tables have them: K_E becomes K with a lowered E. Vega's text is plain.

const kName = /(^|[^\w])([DKFTR])_(ep|sym|E|g|h|c)(?!\w)/g;

/** The markup inside an SVG text element of this size; `markup` is escaped text. */
export function typesetText(markup: string, fontSize: number): string {
  const down = (0.22 * fontSize).toFixed(1);
  const small = (0.75 * fontSize).toFixed(1);
  const parts = markup.split(kName);
  // Text, then for each name: what stands before it, its letter, its index, text.
  let out = parts[0]!;
  for (let i = 1; i < parts.length; i += 4) {
    const [before, letter, index, after] = parts.slice(i, i + 4) as [string, string, string, string];
    out += `${before}${letter}<tspan dy="${down}" font-size="${small}px">${index}</tspan>`;
    if (after !== '') out += `<tspan dy="-${down}">${after}</tspan>`;
  }
  return out;
}

/** The same in every text of an SVG file. */
export function typeset(svg: string): string {
  return svg.replace(/(<text\b[^>]*>)([^<]*)(<\/text>)/g, (whole, open: string, text: string, close: string) => {
    const size = /font-size="([\d.]+)px"/.exec(open);
    return size ? open + typesetText(text, Number(size[1])) + close : whole;
  });
}
