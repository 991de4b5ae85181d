/** The plane of incidence in polar form: radius by value, the surface, the view, the light. */

import { scaleLinear } from 'd3-scale';
import { line } from 'd3-shape';
import { useRef, useState } from 'preact/hooks';
import { csv } from '../../ui/files';
import { format, PlotActions } from '../../ui/plot';
import { type Curve, figure, greatest } from './curves';
import { RADIANS } from '../../core/directions';
import { snapped } from './state';

export interface PolarProps {
  title: string;
  /** Angles from the normal, in degrees; negative: on the view's side. */
  degrees: ArrayLike<number>;
  curves: Curve[];
  isLogarithmic: boolean;
  /** The lower half, too. */
  isWhole: boolean;
  view: number;
  light: number;
  onLight: (degrees: number) => void;
}

const [WIDTH, RADIUS, CENTRE] = [480, 200, 240];
/** Powers of ten between the centre and the rim of a logarithmic radius. */
const DECADES = 4;

export function Polar(props: PolarProps) {
  const { title, degrees, curves, isLogarithmic, isWhole, view, light } = props;
  const svg = useRef<SVGSVGElement>(null);
  const [over, setOver] = useState<number | undefined>(undefined);
  const height = isWhole ? 2 * RADIUS + 52 : RADIUS + 58;
  const middle = RADIUS + 24;
  const found = greatest(curves);
  const top = found > 0 ? found * 1.02 : 1;
  const radius = (v: number) => RADIUS * (isLogarithmic ? Math.max(0, 1 + Math.log10(Math.max(v, 1e-300) / top) / DECADES) : Math.min(1, v / top));
  const point = (angle: number, r: number): [number, number] => [CENTRE + r * Math.sin(angle * RADIANS), middle - r * Math.cos(angle * RADIANS)];
  const least = isWhole ? 0 : Math.ceil(degrees.length / 4);
  const path = (values: ArrayLike<number>) =>
    line<number>()
      .defined((i) => Number.isFinite(values[i]))
      .x((i) => point(degrees[i] as number, radius(values[i] as number))[0])
      .y((i) => point(degrees[i] as number, radius(values[i] as number))[1])(Array.from({ length: Math.max(0, degrees.length - 2 * least) }, (_, i) => i + least)) ?? '';
  const rings = isLogarithmic ? Array.from({ length: DECADES }, (_, i) => 10 ** (Math.floor(Math.log10(top)) - i)).filter((v) => radius(v) > 8) : scaleLinear().domain([0, top]).ticks(4).slice(1);
  const aim = (event: PointerEvent): number | undefined => {
    const box = svg.current?.getBoundingClientRect();
    if (box === undefined) return undefined;
    const [x, y] = [((event.clientX - box.left) / box.width) * WIDTH - CENTRE, middle - ((event.clientY - box.top) / box.height) * height];
    return Math.hypot(x, y) > RADIUS + 20 ? undefined : snapped(Math.atan2(x, y) / RADIANS);
  };
  const move = (event: PointerEvent) => {
    const angle = aim(event);
    setOver(angle);
    if (angle !== undefined && (event.buttons & 1) === 1) props.onLight(angle);
  };
  const at = (angle: number) => Math.round(((angle + 180) / 360) * (degrees.length - 1));
  const ray = (angle: number, from: number, to: number) => {
    const [[x1, y1], [x2, y2]] = [point(angle, from), point(angle, to)];
    return { x1, y1, x2, y2 };
  };
  const label = (angle: number, text: string) => {
    const [x, y] = point(angle, RADIUS + 13);
    return (
      <text x={x} y={y + 4} text-anchor="middle">
        {text}
      </text>
    );
  };
  return (
    <div class="plot">
      <svg
        ref={svg}
        viewBox={`0 0 ${WIDTH} ${height}`}
        role="img"
        aria-label={title}
        style={{ cursor: 'crosshair', touchAction: 'pan-y' }}
        onPointerDown={(event) => {
          const angle = aim(event);
          if (angle !== undefined) props.onLight(angle);
        }}
        onPointerMove={move}
        onPointerLeave={() => setOver(undefined)}
      >
        <g class="grid">
          {rings.map((v) => (
            <path key={v} d={arc(middle, radius(v), isWhole)} fill="none" stroke="var(--line)" stroke-dasharray="2 3" />
          ))}
          {[-60, -30, 0, 30, 60, ...(isWhole ? [120, 150, 180, -120, -150] : [])].map((angle) => (
            <line key={angle} {...ray(angle, 0, RADIUS)} />
          ))}
        </g>
        <line x1={CENTRE - RADIUS - 18} x2={CENTRE + RADIUS + 18} y1={middle} y2={middle} stroke="var(--ink)" stroke-width={1.2} />
        {[-60, -30, 0, 30, 60].map((angle) => label(angle, `${Math.abs(angle)}°`))}
        {rings.map((v) => (
          <text key={v} x={CENTRE + radius(v)} y={middle + 14} text-anchor="middle">
            {format(v)}
          </text>
        ))}
        {curves.map((curve) => (
          <path key={curve.name} class="series" d={path(curve.values)} stroke={curve.colour} stroke-dasharray={curve.dash} />
        ))}
        <Direction name="view" rays={ray(view, 0, RADIUS)} end={point(view, RADIUS * 0.78)} isDashed={false} />
        {(isWhole || Math.abs(light) <= 90) && <Direction name="light" rays={ray(light, 0, RADIUS)} end={point(light, RADIUS * 0.9)} isDashed />}
        {over !== undefined && (isWhole || Math.abs(over) <= 90) && <line {...ray(over, 0, RADIUS)} stroke="var(--ink)" opacity={0.35} />}
      </svg>
      <ul class="legend" aria-label="Curves">
        {curves.map((curve) => (
          <li key={curve.name}>
            <svg width="26" height="8" aria-hidden="true" style={{ display: 'inline-block', width: '26px', verticalAlign: 'middle', marginRight: '.4em' }}>
              <line x1={0} x2={26} y1={4} y2={4} stroke={curve.colour} stroke-width={3} stroke-dasharray={curve.dash} />
            </svg>
            {curve.name}
            {over !== undefined && `: ${figure(curve.values[at(over)] as number)} at ${over}°`}
          </li>
        ))}
      </ul>
      <PlotActions title={title} svg={() => svg.current} table={() => csv(['curve', 'degrees', 'value'], curves.flatMap((c) => Array.from(c.values, (v, i) => [c.name, degrees[i] as number, v])))} />
    </div>
  );
}

function Direction(props: { name: string; rays: { x1: number; y1: number; x2: number; y2: number }; end: [number, number]; isDashed: boolean }) {
  const [x, y] = props.end;
  return (
    <g>
      <line {...props.rays} stroke="var(--ink)" stroke-width={1.4} stroke-dasharray={props.isDashed ? '5 4' : undefined} />
      <circle cx={x} cy={y} r={3} fill="var(--ink)" stroke="none" />
      <text x={x + (x < CENTRE ? -8 : 8)} y={y + 4} text-anchor={x < CENTRE ? 'end' : 'start'}>
        {props.name}
      </text>
    </g>
  );
}

function arc(middle: number, r: number, isWhole: boolean): string {
  const upper = `M${CENTRE - r} ${middle}A${r} ${r} 0 0 1 ${CENTRE + r} ${middle}`;
  return isWhole ? `${upper}A${r} ${r} 0 0 1 ${CENTRE - r} ${middle}` : upper;
}
