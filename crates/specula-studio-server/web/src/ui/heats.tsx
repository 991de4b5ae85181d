/** Counts in cells, what is expected of them, and the difference in standard deviations. */

import { useEffect, useRef } from 'preact/hooks';
import { diverging, viridis } from './scale';

export interface HeatsProps {
  /** Cells downwards. */
  rows: number;
  /** Cells of azimuth. */
  columns: number;
  counts: ArrayLike<number>;
  expected: ArrayLike<number>;
  /** What rows and columns are. */
  axes?: string;
}

export function Heats({ rows, columns, counts, expected, axes = 'cos theta downwards from 1, phi to the right' }: HeatsProps) {
  const size = rows * columns;
  const most = (values: ArrayLike<number>) => Array.from(values).reduce((a, b) => Math.max(a, b), 0) || 1;
  const top = Math.max(most(counts), most(expected));
  const root = (values: ArrayLike<number>) => Array.from({ length: size }, (_, i) => Math.sqrt(Math.max(0, values[i] as number) / top));
  const residual = Array.from({ length: size }, (_, i) => {
    const [found, wanted] = [counts[i] as number, expected[i] as number];
    return (found - wanted) / Math.sqrt(Math.max(wanted, 1));
  });
  return (
    <div class="heats">
      <Heat axes={axes} label="Counted" rows={rows} columns={columns} shares={root(counts)} colour={viridis} />
      <Heat axes={axes} label="Expected" rows={rows} columns={columns} shares={root(expected)} colour={viridis} />
      <Heat axes={axes} label="Difference, in standard deviations: blue -5, white 0, orange 5" rows={rows} columns={columns} shares={residual.map((r) => r / 5)} colour={diverging} />
    </div>
  );
}

export function Heat(props: { label: string; axes: string; rows: number; columns: number; shares: number[]; colour: (share: number) => [number, number, number] }) {
  const { label, axes, rows, columns, shares, colour } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const context = canvas.current?.getContext('2d');
    if (context === null || context === undefined) return;
    const image = context.createImageData(columns, rows);
    shares.forEach((share, i) => image.data.set([...colour(share), 255], 4 * i));
    context.putImageData(image, 0, 0);
  }, [shares]);
  return (
    <figure>
      <canvas ref={canvas} style={{ aspectRatio: `${columns} / ${rows}`, height: 'auto' }} width={columns} height={rows} role="img" aria-label={`${label}: ${axes}`} />
      <figcaption>{label}</figcaption>
    </figure>
  );
}
