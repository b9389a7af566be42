import { parse, View } from 'vega';
import { compile } from 'vega-lite';
import { typeset } from './typeset.ts';
import type { Figure } from './figures.ts';

/** The figure, laid out but not yet drawn. */
export function view(figure: Figure): View {
  return new View(parse(compile(figure.spec).spec), { renderer: 'none' });
}

/** As a file. */
export async function svgOf(plot: View): Promise<string> {
  return typeset(await plot.toSVG());
}
