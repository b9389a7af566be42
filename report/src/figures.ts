import type { TopLevelSpec } from 'vega-lite';
import type { Box, Data, Measure, Scatter } from './data.ts';

export interface Figure {
  /** Of the file and of the page's element. */
  id: string;
  spec: TopLevelSpec;
}

type Part = Record<string, unknown>;

const kFont = 'DejaVu Sans, Verdana, sans-serif';
const kInk = '#222';

const config = {
  background: '#ffffff',
  font: kFont,
  axis: {
    labelFontSize: 11, titleFontSize: 12, titleFontWeight: 'normal', titlePadding: 6,
    labelColor: kInk, titleColor: kInk, gridColor: '#e6e6e6', domainColor: '#888', tickColor: '#888',
  },
  legend: { labelFontSize: 12, titleFontSize: 12, labelColor: kInk, titleColor: kInk },
  header: { labelFontSize: 12, titleFontSize: 12, labelColor: kInk },
  view: { stroke: null },
};

// Unlike the techniques' colours.
const kTaskColors = ['#3d3d3d', '#b5447f', '#8a8a3c', '#5f9ea0'];

// Between a figure's legend and its plots; where these have titles.
const kLegend_px = 12;
const kTitle_px = 34;

// One legend for all plots of a figure.
const kShared = { legend: { color: 'shared' } };

const whole = (part: Part): TopLevelSpec =>
  ({ $schema: 'https://vega.github.io/schema/vega-lite/v6.json', config, padding: 8, ...part }) as TopLevelSpec;

const colors = (data: Data, offset: number) => ({
  field: 'method', type: 'nominal',
  scale: { domain: data.methods.map((m) => m.name), range: data.methods.map((m) => m.color) },
  legend: { title: null, orient: 'top', symbolType: 'square', columns: 7, offset },
});

// At most seven labelled places on a logarithmic axis, all of one kind.
function logTicks(low: number, high: number): number[] {
  let ticks: number[] = [];
  for (const steps of [[1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9], [1, 1.5, 2, 3, 5, 7], [1, 2, 5], [1, 3], [1]]) {
    ticks = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
      for (const s of steps) {
        const tick = Number(`${s}e${e}`);
        if (tick >= low && tick <= high) ticks.push(tick);
      }
    if (ticks.length <= 7) break;
  }
  return ticks;
}

const kNumber = { labelExpr: "datum.value >= 1e5 || datum.value < 1e-3 ? format(datum.value, '.0e') : format(datum.value, '~r')" };

/** A scale and axis, and an expression for how high a value is on it. */
interface Vertical {
  scale: Part;
  axis: Part;
  pixels: (value: string, height: number) => string;
}

// The scale and axis of one measure over these boxes.
function vertical(measure: Measure, boxes: Box[], title: string | null): Vertical {
  if (!measure.positive || boxes.length === 0) {
    const most = Math.max(0, ...boxes.map((b) => Math.max(b.p95, b.mean)));
    const least = Math.min(0, ...boxes.map((b) => Math.min(b.p5, b.mean)));
    return {
      scale: { zero: true, nice: true }, axis: { title, titleX: kAxisTitle_px, tickCount: 5 },
      pixels: (value, height) => `${height} * (${value}) / ${most - least || 1}`,
    };
  }
  const low = Math.min(...boxes.map((b) => Math.min(b.p5, b.mean)));
  const high = Math.max(...boxes.map((b) => Math.max(b.p95, b.mean)));
  const domain = [low / 1.15, high * 1.15];
  return {
    scale: { type: 'log', domain, nice: false },
    axis: { title, titleX: kAxisTitle_px, values: logTicks(domain[0]!, domain[1]!), ...kNumber },
    pixels: (value, height) => `${height} * log(${value}) / ${Math.log(domain[1]! / domain[0]!)}`,
  };
}

const tooltip = (group: string) => [
  { field: 'method', title: 'technique' },
  { field: 'group', title: group },
  { field: 'strokes' },
  ...['p5', 'q1', 'median', 'mean', 'q3', 'p95'].map((field) => ({ field, format: '.4~g' })),
];

// A plot's title as a mark: Vega places its own above whatever an axis has there, one higher than the next.
const title = (text: string): Part => ({
  data: { values: [{}] },
  mark: { type: 'text', text, align: 'left', baseline: 'alphabetic', fontSize: 13, color: kInk, aria: false },
  encoding: { x: { value: 0 }, y: { value: -14 } },
});

// Where an axis has its title, however wide its numbers are: titles below each other line up.
const kAxisTitle_px = -44;

// Boxes thinner than this hide behind their median's line; they are drawn without.
const kThin_px = 5;

// Boxes of the methods side by side: 5 to 95 % as a line, quartiles as a bar, median and mean.
function boxLayers(data: Data, y: Vertical, x: Part, group: string, size: number, height: number, legend: number): Part[] {
  const { pixels, ...scaled } = y;
  const offset = { field: 'method', type: 'nominal', sort: data.methods.map((m) => m.name) };
  const place = x.field ? { x, xOffset: offset } : { x: { ...offset, axis: null } };
  const color = colors(data, legend);
  return [
    { mark: { type: 'rule', strokeWidth: 1.2 },
      encoding: { ...place, color, y: { field: 'p5', type: 'quantitative', ...scaled }, y2: { field: 'p95' } } },
    // Keeps a box visible that has no height.
    { mark: { type: 'tick', thickness: 4, opacity: 1, size },
      encoding: { ...place, color, y: { field: 'median', type: 'quantitative', ...scaled } } },
    { mark: { type: 'bar', size },
      encoding: { ...place, color, y: { field: 'q1', type: 'quantitative', ...scaled }, y2: { field: 'q3' },
        tooltip: tooltip(group) } },
    { transform: [{ filter: `${pixels('datum.q3', height)} - ${pixels('datum.q1', height)} > ${kThin_px}` }],
      mark: { type: 'tick', color: 'white', thickness: 2, opacity: 1, size },
      encoding: { ...place, y: { field: 'median', type: 'quantitative', ...scaled } } },
    { mark: { type: 'point', shape: 'diamond', filled: true, size: Math.min(26, 1.6 * size), color: 'white', stroke: kInk, strokeWidth: 1, opacity: 1 },
      encoding: { ...place, y: { field: 'mean', type: 'quantitative', ...scaled } } },
  ];
}

// Heights of the plots.
const kBoxes_px = 190;
const kShapes_px = 130;

const barSize = (width: number, count: number) => Math.max(3, Math.min(26, (0.72 * width) / Math.max(1, count)));

function byTask(data: Data): Figure {
  const width = Math.max(150, 12 * data.methods.length * data.tasks.length);
  const columns = width > 260 ? 3 : 5;
  const plots = data.measures.map((measure) => {
    const values = data.by_task.filter((b) => b.measure === measure.id);
    const y = vertical(measure, values, null);
    const x = { field: 'group', type: 'nominal', sort: data.tasks, axis: { title: null, labelAngle: 0, ticks: false } };
    const size = barSize(width, data.methods.length * data.tasks.length);
    return {
      width, height: kBoxes_px, data: { values },
      layer: [...boxLayers(data, y, x, 'task', size, kBoxes_px, kTitle_px), title(measure.title)],
    };
  });
  return { id: 'boxes', spec: whole({ concat: plots, columns, bounds: 'flush', spacing: { row: 62, column: 58 }, resolve: kShared }) };
}

function byShape(data: Data): Figure {
  const width = Math.max(110, 11 * data.methods.length);
  const rows = data.measures
    .filter((m) => ['D_ep_mm', 'K_E', 'K_g', 'F_g', 'tau_s'].includes(m.id))
    .map((measure, at) => {
      const values = data.by_shape.filter((b) => b.measure === measure.id);
      return {
        data: { values },
        facet: {
          column: {
            field: 'group', type: 'nominal', sort: data.shapes,
            header: at === 0 ? { title: null, labelPadding: 6 } : { title: null, labels: false },
          },
        },
        spacing: 8,
        spec: {
          width, height: kShapes_px, view: { stroke: '#ddd' },
          layer: boxLayers(data, vertical(measure, values, measure.title), {}, 'shape',
            barSize(width, data.methods.length), kShapes_px, kLegend_px),
        },
      };
    });
  return { id: 'shapes', spec: whole({ vconcat: rows, spacing: 12, resolve: kShared }) };
}

function scatterPlot(data: Data, a: string, b: string, plot: Scatter): Part {
  const measure = data.measures.find((m) => m.id === plot.measure)!;
  const all = plot.points.flatMap((p) => [p.x, p.y]);
  const low = Math.min(...all) / 1.1;
  const high = Math.max(...all) * 1.1;
  const values = logTicks(low, high);
  const axis = (field: string, method: string) => ({
    field, type: 'quantitative',
    scale: { type: 'log', domain: [low, high], nice: false },
    axis: { title: method, values, ...kNumber },
  });
  const line = (points: Part[], mark: Part) => ({
    data: { values: points },
    mark: { type: 'line', ...mark },
    encoding: { x: axis('x', a), y: axis('y', b) },
  });
  const layers: Part[] = [
    line([{ x: low, y: low }, { x: high, y: high }], { color: '#888', strokeDash: [5, 4], strokeWidth: 1.2 }),
    {
      data: { values: [{ x: high, y: high }] },
      mark: { type: 'text', text: 'y = x', align: 'right', baseline: 'top', dx: -16, color: '#666', fontSize: 11, aria: false },
      encoding: { x: axis('x', a), y: axis('y', b) },
    },
    {
      data: { values: plot.points },
      mark: { type: 'point', filled: true, size: 16, opacity: 0.5, clip: true, aria: false },
      encoding: {
        x: axis('x', a), y: axis('y', b),
        color: {
          field: 'task', type: 'nominal', scale: { domain: data.tasks, range: kTaskColors },
          legend: data.tasks.length > 1 ? { title: null, orient: 'top', symbolOpacity: 1, offset: kTitle_px } : null,
        },
        tooltip: [
          { field: 'stroke' }, { field: 'task' },
          { field: 'x', title: a, format: '.4~g' }, { field: 'y', title: b, format: '.4~g' },
        ],
      },
    },
  ];
  let heading = measure.title;
  if (plot.line !== null) {
    const { slope, intercept, r } = plot.line;
    const at = (x: number) => 10 ** (intercept + slope * Math.log10(x));
    const from = Math.min(...plot.points.map((p) => p.x));
    const to = Math.max(...plot.points.map((p) => p.x));
    layers.push(line([{ x: from, y: at(from) }, { x: to, y: at(to) }], { color: '#111', strokeWidth: 2, clip: true }));
    heading += `, slope ${slope.toFixed(2)}, r = ${r.toFixed(2)}`;
  }
  return { width: 270, height: 270, layer: [...layers, title(heading)] };
}

function scatter(data: Data, pair: Data['scatter'][number]): Figure {
  return {
    id: pair.id,
    spec: whole({
      concat: pair.plots.map((plot) => scatterPlot(data, pair.a, pair.b, plot)),
      columns: 3, bounds: 'flush', spacing: { row: 90, column: 84 }, resolve: kShared,
    }),
  };
}

/** All figures of a report, in the page's order. */
export function figures(data: Data): Figure[] {
  return [...data.scatter.filter((p) => p.plots.length > 0).map((pair) => scatter(data, pair)), byTask(data), byShape(data)];
}
