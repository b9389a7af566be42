import { parse, View } from 'vega';
import { compile } from 'vega-lite';
import type { Figure } from './figures.ts';

/** The figure, laid out but not yet drawn. */
export function view(figure: Figure): View {
  return new View(parse(compile(figure.spec).spec), { renderer: 'none' });
}
