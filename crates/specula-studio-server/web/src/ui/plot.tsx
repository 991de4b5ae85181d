/** Plots of lines over an axis, as SVG. */

import { scaleLinear, scaleLog } from 'd3-scale';
import { line } from 'd3-shape';
import { useRef, useState } from 'preact/hooks';
import { csv, save, savePng, svgCanvas, svgText } from './files';

export interface Series {
  name: string;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  /** A CSS colour; else by the series' place. */
  colour?: string;
  isDashed?: boolean;
  /** Lengths of dashes and gaps, as in SVG. */
  dash?: string;
  /** Standard deviations: drawn as a band of two on either side. */
  error?: ArrayLike<number>;
}

export interface PlotProps {
  /** What the plot shows, for screen readers and file names. */
  title: string;
  x: string;
  y: string;
  series: Series[];
  xRange?: [number, number];
  yRange?: [number, number];
  isLogarithmic?: boolean;
  isLogarithmicX?: boolean;
  /** Shown as a vertical line. */
  markX?: number;
  height?: number;
}

const WIDTH = 480;
const MARGIN = { left: 52, right: 12, top: 10, bottom: 38 };

/** The colour of a series by its place. */
export function seriesColour(index: number): string {
  return `var(--series-${(index % 6) + 1})`;
}

function extent(values: ArrayLike<number>[], isPositive: boolean): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const array of values) {
    for (let i = 0; i < array.length; i++) {
      const v = array[i] as number;
      if (Number.isFinite(v) && (!isPositive || v > 0)) {
        low = Math.min(low, v);
        high = Math.max(high, v);
      }
    }
  }
  if (low > high) return isPositive ? [0.1, 1] : [0, 1];
  return low === high ? [isPositive ? low / 2 : low - 0.5, isPositive ? high * 2 : high + 0.5] : [low, high];
}

export function format(x: number): string {
  if (x === 0) return '0';
  const size = Math.abs(x);
  return size >= 1e5 || size < 1e-3 ? x.toExponential(1).replace('.0e', 'e').replace('e+', 'e') : String(Number(x.toPrecision(4)));
}

/** The same with all of its digits, zeros too: numbers of a column are alike. */
export function formatAlike(x: number, digits: number): string {
  const size = Math.abs(x);
  return size >= 1e5 || size < 1e-3 ? format(x) : x.toPrecision(digits);
}

export function Plot(props: PlotProps) {
  const { title, series, isLogarithmic = false, isLogarithmicX = false, height = 280 } = props;
  const svg = useRef<SVGSVGElement>(null);
  const [at, setAt] = useState<number | undefined>(undefined);
  const xRange = props.xRange ?? extent(series.map((s) => s.x), isLogarithmicX);
  const found = extent(series.map((s) => s.y), isLogarithmic);
  const yRange = props.yRange ?? (isLogarithmic ? ([Math.max(found[0], found[1] * 1e-6), found[1] * 1.2] as [number, number]) : ([Math.min(0, found[0]), found[1] * 1.05] as [number, number]));
  const x = (isLogarithmicX ? scaleLog() : scaleLinear()).domain(xRange).range([MARGIN.left, WIDTH - MARGIN.right]);
  const y = (isLogarithmic ? scaleLog() : scaleLinear()).domain(yRange).range([height - MARGIN.bottom, MARGIN.top]).clamp(true);
  const path = (xs: ArrayLike<number>, ys: ArrayLike<number>) =>
    line<number>()
      .defined((i) => Number.isFinite(ys[i]) && (!isLogarithmic || (ys[i] as number) > 0))
      .x((i) => x(xs[i] as number))
      .y((i) => y(ys[i] as number))(Array.from({ length: xs.length }, (_, i) => i)) ?? '';
  const band = (s: Series) => {
    const lower = path(s.x, Array.from(s.y, (v, i) => v - 2 * (s.error?.[i] ?? 0)));
    const upper = path(Array.from(s.x).reverse(), Array.from(s.y, (v, i) => v + 2 * (s.error?.[i] ?? 0)).reverse());
    return lower === '' || upper === '' ? '' : `${lower}L${upper.slice(1)}Z`;
  };
  const nearest = (s: Series, value: number) => {
    let best = 0;
    for (let i = 1; i < s.x.length; i++) {
      if (Math.abs((s.x[i] as number) - value) < Math.abs((s.x[best] as number) - value)) best = i;
    }
    return best;
  };
  const move = (event: PointerEvent) => {
    const box = svg.current?.getBoundingClientRect();
    if (box === undefined) return;
    const raster = ((event.clientX - box.left) / box.width) * WIDTH;
    setAt(raster >= MARGIN.left && raster <= WIDTH - MARGIN.right ? x.invert(raster) : undefined);
  };
  const xTicks = isLogarithmicX ? x.ticks(5).filter((t) => Math.abs(Math.log10(t) % 1) < 1e-9) : x.ticks(6);
  const yTicks = isLogarithmic ? y.ticks(5).filter((t) => Math.abs(Math.log10(t) % 1) < 1e-9) : y.ticks(6);
  return (
    <div class="plot">
      <svg
        ref={svg}
        viewBox={`0 0 ${WIDTH} ${height}`}
        role="img"
        aria-label={title}
        onPointerMove={move}
        onPointerLeave={() => setAt(undefined)}
      >
        <g class="grid">
          {yTicks.map((t) => (
            <line key={t} x1={MARGIN.left} x2={WIDTH - MARGIN.right} y1={y(t)} y2={y(t)} />
          ))}
        </g>
        <g class="axis">
          <line x1={MARGIN.left} x2={WIDTH - MARGIN.right} y1={height - MARGIN.bottom} y2={height - MARGIN.bottom} />
          <line x1={MARGIN.left} x2={MARGIN.left} y1={MARGIN.top} y2={height - MARGIN.bottom} />
          {xTicks.map((t) => (
            <text key={t} x={x(t)} y={height - MARGIN.bottom + 15} text-anchor="middle">
              {format(t)}
            </text>
          ))}
          {yTicks.map((t) => (
            <text key={t} x={MARGIN.left - 6} y={y(t) + 4} text-anchor="end">
              {format(t)}
            </text>
          ))}
          <text x={(MARGIN.left + WIDTH - MARGIN.right) / 2} y={height - 6} text-anchor="middle">
            {props.x}
          </text>
          <text transform={`translate(12 ${(height - MARGIN.bottom + MARGIN.top) / 2}) rotate(-90)`} text-anchor="middle">
            {props.y}
          </text>
        </g>
        {series.map((s, i) => {
          const colour = s.colour ?? seriesColour(i);
          return (
            <g key={s.name}>
              {s.error !== undefined && <path d={band(s)} fill={colour} stroke="none" opacity={0.18} />}
              <path class="series" d={path(s.x, s.y)} stroke={colour} stroke-dasharray={s.dash ?? (s.isDashed === true ? '5 4' : undefined)} />
            </g>
          );
        })}
        {props.markX !== undefined && <line x1={x(props.markX)} x2={x(props.markX)} y1={MARGIN.top} y2={height - MARGIN.bottom} stroke="var(--quiet)" stroke-dasharray="4 3" />}
        {at !== undefined && <line x1={x(at)} x2={x(at)} y1={MARGIN.top} y2={height - MARGIN.bottom} stroke="var(--ink)" opacity={0.4} />}
      </svg>
      <ul class="legend" aria-label="Series">
        {series.map((s, i) => (
          <li key={s.name}>
            <Swatch colour={s.colour ?? seriesColour(i)} isDashed={s.isDashed === true || s.dash !== undefined} />
            {s.name}
            {at !== undefined && s.x.length > 0 && `: ${format(s.y[nearest(s, at)] as number)} at ${format(s.x[nearest(s, at)] as number)}`}
          </li>
        ))}
      </ul>
      <PlotActions title={title} svg={() => svg.current} table={() => table(props)} />
    </div>
  );
}

export function Swatch(props: { colour: string; isDashed?: boolean }) {
  return <span class="swatch" style={{ borderTopColor: props.colour, borderTopStyle: props.isDashed === true ? 'dashed' : 'solid' }} />;
}

function table(props: PlotProps): string {
  const rows = props.series.flatMap((s) => Array.from(s.x, (v, i) => [s.name, v, s.y[i] as number]));
  return csv(['series', props.x, props.y], rows);
}

/** Buttons that save a plot. */
export function PlotActions(props: { title: string; svg: () => SVGSVGElement | null; table?: () => string }) {
  const name = props.title.toLowerCase().replace(/[^a-z0-9]+/g, '-');
  return (
    <div class="actions" style={{ marginTop: '.3rem' }}>
      <button
        type="button"
        aria-label={`Save SVG: ${props.title}`}
        onClick={() => {
          const svg = props.svg();
          if (svg !== null) save(`${name}.svg`, svgText(svg), 'image/svg+xml');
        }}
      >
        SVG
      </button>
      <button
        type="button"
        aria-label={`Save PNG: ${props.title}`}
        onClick={async () => {
          const svg = props.svg();
          if (svg !== null) await savePng(`${name}.png`, await svgCanvas(svg));
        }}
      >
        PNG
      </button>
      {props.table !== undefined && (
        <button type="button" aria-label={`Save CSV: ${props.title}`} onClick={() => save(`${name}.csv`, props.table?.() ?? '', 'text/csv')}>
          CSV
        </button>
      )}
    </div>
  );
}
