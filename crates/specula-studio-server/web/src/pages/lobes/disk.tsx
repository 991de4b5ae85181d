/** A hemisphere as a disk of colours: the angle from the normal is the distance from the centre. */

import { useEffect, useMemo, useRef } from 'preact/hooks';
import type { Answer } from '../../core/ask';
import type { Vec3 } from '../../core/protocol';
import { useThemeChange } from '../../core/theme';
import { savePng } from '../../ui/files';
import { viridis } from '../../ui/scale';
import { figure, valueOf } from './curves';
import type { Quantity } from './state';

export interface DisksProps {
  title: string;
  /** What colours stand for. */
  axis: string;
  grid: Answer<'lobes.grid'>;
  quantity: Quantity;
  isLogarithmic: boolean;
  wo: Vec3;
  /** The lower hemisphere, too. */
  isWhole: boolean;
  /** Directions of samples, drawn as points. */
  points?: Float32Array | undefined;
}

const SIDE = 400;
const RIM = SIDE / 2 - 6;
const DECADES = 4;

/** Values on a grid of angles. */
interface Field {
  rows: number;
  columns: number;
  /** Of the last row. */
  end: number;
  values: Float32Array;
  top: number;
}

export function Disks(props: DisksProps) {
  const { title, axis, grid, quantity, isLogarithmic, isWhole } = props;
  const field = useMemo((): Field => {
    const { theta, phi, f_cos, pdf } = grid.arrays;
    const values = Float32Array.from(pdf.values, (_, i) => valueOf(quantity, 3, f_cos.values, pdf.values, i));
    const top = values.reduce((most, v) => (Number.isFinite(v) ? Math.max(most, v) : most), 0);
    return { rows: theta.values.length, columns: phi.values.length, end: theta.values.at(-1) as number, values, top: top > 0 ? top : 1 };
  }, [grid, quantity]);
  return (
    <div>
      <div class="disks">
        <Disk {...props} field={field} isUpper title={`${title}, above`} />
        {isWhole && <Disk {...props} field={field} isUpper={false} title={`${title}, below`} />}
      </div>
      <Scale axis={axis} low={isLogarithmic ? field.top * 10 ** -DECADES : 0} high={field.top} />
    </div>
  );
}

function Disk(props: DisksProps & { field: Field; isUpper: boolean }) {
  const { field, isLogarithmic, wo, points, isUpper, title } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const theme = useThemeChange();
  useEffect(() => {
    const context = canvas.current?.getContext('2d');
    if (context === null || context === undefined) return;
    paint(context, field, isLogarithmic, isUpper);
    rings(context, wo, isUpper);
    if (points !== undefined) scatter(context, points, isUpper);
  }, [field, isLogarithmic, wo.join(), points, isUpper, theme]);
  return (
    <figure>
      <canvas ref={canvas} width={SIDE} height={SIDE} role="img" aria-label={title} data-picture />
      <figcaption>
        {isUpper ? 'Above the surface' : 'Below the surface'}{' '}
        <button type="button" aria-label={`Save PNG: ${title}`} onClick={() => canvas.current !== null && savePng(`${title.toLowerCase().replace(/[^a-z0-9]+/g, '-')}.png`, canvas.current)}>
          PNG
        </button>
      </figcaption>
    </figure>
  );
}

/** Viridis at 256 shares, as pixels. */
const PALETTE = Uint8Array.from(Array.from({ length: 256 }, (_, i) => viridis(i / 255)).flat());

/** Of each pixel: its distance from the centre (1: the rim) and its azimuth in turns. */
const PLACES = (() => {
  const places = new Float32Array(2 * SIDE * SIDE);
  for (let i = 0; i < SIDE * SIDE; i++) {
    const [dx, dy] = [((i % SIDE) + 0.5 - SIDE / 2) / RIM, (SIDE / 2 - Math.floor(i / SIDE) - 0.5) / RIM];
    places[2 * i] = Math.hypot(dx, dy);
    places[2 * i + 1] = (Math.atan2(dy, dx) / (2 * Math.PI) + 1) % 1;
  }
  return places;
})();

function paint(context: CanvasRenderingContext2D, field: Field, isLogarithmic: boolean, isUpper: boolean): void {
  const image = context.createImageData(SIDE, SIDE);
  const { data } = image;
  const { rows, columns, end, values, top } = field;
  for (let k = 0; k < SIDE * SIDE; k++) {
    const r = PLACES[2 * k] as number;
    if (r > 1) continue;
    const theta = isUpper ? (r * Math.PI) / 2 : Math.PI * (1 - r / 2);
    const row = Math.min((theta / end) * (rows - 1), rows - 1.0001);
    const column = (PLACES[2 * k + 1] as number) * (columns - 1);
    const [i, j] = [Math.floor(row), Math.floor(column)];
    const [a, b, at] = [row - i, column - j, i * columns + j];
    const above = (1 - b) * (values[at] as number) + b * (values[at + 1] as number);
    const below = (1 - b) * (values[at + columns] as number) + b * (values[at + columns + 1] as number);
    const v = (1 - a) * above + a * below;
    const share = isLogarithmic ? 1 + Math.log10(Math.max(v, 1e-30) / top) / DECADES : v / top;
    const colour = 3 * Math.round(255 * Math.min(1, Math.max(0, share || 0)));
    data[4 * k] = PALETTE[colour] as number;
    data[4 * k + 1] = PALETTE[colour + 1] as number;
    data[4 * k + 2] = PALETTE[colour + 2] as number;
    data[4 * k + 3] = 255 * Math.min(1, (1 - r) * RIM);
  }
  context.clearRect(0, 0, SIDE, SIDE);
  context.putImageData(image, 0, 0);
}

function place(w: ArrayLike<number>, at = 0): [number, number] {
  const [x, y, z] = [w[at] as number, w[at + 1] as number, w[at + 2] as number];
  const r = (Math.acos(Math.min(1, Math.abs(z))) / (Math.PI / 2)) * RIM;
  const length = Math.hypot(x, y) || 1;
  return [SIDE / 2 + (r * x) / length, SIDE / 2 - (r * y) / length];
}

/** Circles at 30 and 60 degrees, the rim, the view and the mirror's direction. */
function rings(context: CanvasRenderingContext2D, wo: Vec3, isUpper: boolean): void {
  const style = getComputedStyle(document.documentElement);
  context.lineWidth = 1;
  context.strokeStyle = 'rgb(255 255 255 / .35)';
  context.fillStyle = 'rgb(255 255 255 / .85)';
  context.font = '15px system-ui, "DejaVu Sans", sans-serif';
  for (const degrees of [30, 60]) {
    context.beginPath();
    context.arc(SIDE / 2, SIDE / 2, (degrees / 90) * RIM, 0, 2 * Math.PI);
    context.stroke();
    context.fillText(`${degrees}°`, SIDE / 2 + 3, SIDE / 2 - (degrees / 90) * RIM + 16);
  }
  context.strokeStyle = style.getPropertyValue('--quiet');
  context.beginPath();
  context.arc(SIDE / 2, SIDE / 2, RIM, 0, 2 * Math.PI);
  context.stroke();
  if (wo[2] >= 0 !== isUpper) return;
  mark(context, place(wo), 'view', true);
  mark(context, place([-wo[0], -wo[1], wo[2]]), 'mirror', false);
}

function mark(context: CanvasRenderingContext2D, [x, y]: [number, number], text: string, isFull: boolean): void {
  context.lineWidth = 2;
  context.strokeStyle = '#fff';
  context.fillStyle = '#fff';
  context.beginPath();
  context.arc(x, y, 5, 0, 2 * Math.PI);
  if (isFull) context.fill();
  else context.stroke();
  context.textAlign = x > SIDE * 0.8 ? 'right' : 'left';
  context.strokeStyle = 'rgb(0 0 0 / .55)';
  context.lineWidth = 3;
  const left = context.textAlign === 'right' ? x - 10 : x + 10;
  context.strokeText(text, left, y + 5);
  context.fillText(text, left, y + 5);
  context.textAlign = 'left';
}

function scatter(context: CanvasRenderingContext2D, points: Float32Array, isUpper: boolean): void {
  context.fillStyle = 'rgb(255 255 255 / .6)';
  for (let i = 0; i + 2 < points.length; i += 3) {
    const z = points[i + 2] as number;
    if (z === 0 || z > 0 !== isUpper) continue;
    const [x, y] = place(points, i);
    context.fillRect(x - 0.7, y - 0.7, 1.4, 1.4);
  }
}

/** What colours stand for. */
export function Scale({ axis, low, high, colour = viridis }: { axis: string; low: number; high: number; colour?: (share: number) => [number, number, number] }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const context = canvas.current?.getContext('2d');
    if (context === null || context === undefined) return;
    const image = context.createImageData(256, 1);
    for (let x = 0; x < 256; x++) image.data.set([...colour(low < 0 ? x / 127.5 - 1 : x / 255), 255], 4 * x);
    context.putImageData(image, 0, 0);
  }, [low < 0]);
  return (
    <div class="scale">
      {figure(Number(low.toPrecision(3)))}
      <canvas ref={canvas} width={256} height={1} aria-hidden="true" />
      {figure(Number(high.toPrecision(3)))} <span class="quiet">{axis}</span>
    </div>
  );
}
