/** Random walks between facets: one as a path over a surface, and how many bounces walks take. */

import { useMemo, useRef } from 'preact/hooks';
import type { Answer } from '../../core/ask';
import { Slider } from '../../ui/controls';
import { csv } from '../../ui/files';
import { PlotActions } from '../../ui/plot';
import { drawWalk, type Vertex } from './heightfield';

export interface WalksProps {
  walks: Answer<'lobes.walks'>;
  /** Along the plane of incidence. */
  alpha: number;
  azimuth: number;
  /** Which walk is drawn, from 1. */
  chosen: number;
  onChoose: (walk: number) => void;
}

const [WIDTH, HEIGHT] = [640, 300];

export function Walks({ walks, alpha, azimuth, chosen, onChoose }: WalksProps) {
  const count = walks.arrays.offsets.values.length - 1;
  const walk = Math.max(1, Math.min(count, Math.round(chosen)));
  const vertices = useMemo(() => verticesOf(walks, walk - 1), [walks, walk]);
  const bounces = vertices.slice(1).filter((v) => Number.isFinite(v.height)).length;
  const weight = (vertices.at(-1) as Vertex & { weight: number[] } | undefined)?.weight ?? [];
  return (
    <div class="walks">
      <div>
        <Picture vertices={vertices} alpha={alpha} azimuth={azimuth} walk={walk} />
      <div class="actions">
        <button type="button" disabled={walk <= 1} onClick={() => onChoose(walk - 1)}>
          Previous
        </button>
        <button type="button" disabled={walk >= count} onClick={() => onChoose(walk + 1)}>
          Next
        </button>
        <button type="button" onClick={() => onChoose(nextLonger(walks, walk))}>
          Next of two or more bounces
        </button>
        <span aria-live="polite">
          Walk {walk} of {count}: {bounces} {bounces === 1 ? 'bounce' : 'bounces'}, weight {weight.map((w) => w.toFixed(3)).join(', ')}
        </span>
      </div>
      <Slider label="Walk" value={walk} min={1} max={Math.max(2, count)} isInteger steps={Math.max(1, count - 1)} onInput={onChoose} />
      </div>
      <div>
        <Bounces shares={walks.value.bounces} />
        <p class="quiet">
          A Smith surface has heights and slopes, but no places. The surface drawn is one with this alpha that has the walk's heights and its facets' slopes; directions are projected onto the plane of incidence.
        </p>
      </div>
    </div>
  );
}

function verticesOf(walks: Answer<'lobes.walks'>, walk: number): (Vertex & { weight: number[] })[] {
  const { offsets, height, direction, weight } = walks.arrays;
  const [from, to] = [offsets.values[walk] ?? 0, offsets.values[walk + 1] ?? 0];
  return Array.from({ length: to - from }, (_, i) => ({
    height: height.values[from + i] as number,
    direction: [0, 1, 2].map((k) => direction.values[3 * (from + i) + k] as number) as Vertex['direction'],
    weight: [0, 1, 2].map((k) => weight.values[3 * (from + i) + k] as number),
  }));
}

/** The next walk that meets two facets or more; the first one behind the last. */
function nextLonger(walks: Answer<'lobes.walks'>, walk: number): number {
  const { offsets, height } = walks.arrays;
  const count = offsets.values.length - 1;
  for (let step = 0; step < count; step++) {
    const i = (walk + step) % count;
    const inside = Array.from(height.values.slice((offsets.values[i] ?? 0) + 1, offsets.values[i + 1])).filter(Number.isFinite);
    if (inside.length >= 2) return i + 1;
  }
  return walk;
}

function Picture({ vertices, alpha, azimuth, walk }: { vertices: Vertex[]; alpha: number; azimuth: number; walk: number }) {
  const svg = useRef<SVGSVGElement>(null);
  const drawing = useMemo(() => drawWalk(vertices, alpha, azimuth, walk), [vertices, alpha, azimuth, walk]);
  const [x0, z0] = drawing.low;
  const [x1, z1] = drawing.high;
  const scale = Math.min((WIDTH - 16) / (x1 - x0 || 1), (HEIGHT - 16) / (z1 - z0 || 1));
  const at = ([x, z]: [number, number]): [number, number] => [WIDTH / 2 + (x - (x0 + x1) / 2) * scale, HEIGHT / 2 - (z - (z0 + z1) / 2) * scale];
  const text = (points: [number, number][]) => points.map((p) => at(p).map((v) => v.toFixed(2)).join(' ')).join('L');
  const [first, last] = [drawing.profile[0], drawing.profile.at(-1)];
  const ground = first === undefined || last === undefined ? '' : `M${text(drawing.profile)}L${at([last[0], z0]).join(' ')}L${at([first[0], z0]).join(' ')}Z`;
  const inner = drawing.path.slice(1, -1);
  return (
    <div class="walk">
      <svg ref={svg} viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={`Walk ${walk} over a rough surface`} data-picture>
        <defs>
          <marker id="walk-arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">
            <path d="M0 0L8 4L0 8Z" fill="var(--series-2)" stroke="none" />
          </marker>
        </defs>
        <path d={ground} fill="var(--line)" stroke="none" opacity={0.55} />
        <path d={`M${text(drawing.profile)}`} fill="none" stroke="var(--quiet)" stroke-width={1.6} />
        {drawing.path.slice(0, -1).map((from, i) => {
          const [[ax, ay], [bx, by]] = [at(from), at(drawing.path[i + 1] as [number, number])];
          return <line key={i} x1={ax} y1={ay} x2={bx} y2={by} stroke="var(--series-2)" stroke-width={1.8} marker-end="url(#walk-arrow)" />;
        })}
        {inner.map((p, i) => {
          const [x, y] = at(p);
          return (
            <g key={i}>
              <circle cx={x} cy={y} r={4} fill="var(--series-2)" stroke="var(--card)" stroke-width={1} />
              <text x={x + 7} y={y + 14}>
                {i + 1}
              </text>
            </g>
          );
        })}
      </svg>
      <PlotActions title="Random walk" svg={() => svg.current} />
    </div>
  );
}

function Bounces({ shares }: { shares: number[] }) {
  const svg = useRef<SVGSVGElement>(null);
  const top = Math.max(...shares, 1e-9);
  const step = 440 / shares.length;
  const name = (i: number) => (i === shares.length - 1 ? 'more' : String(i + 1));
  return (
    <div class="plot">
      <h3>Share of walks by bounces</h3>
      <svg ref={svg} viewBox="0 0 480 150" role="img" aria-label={`Bounces: ${shares.map((s, i) => `${name(i)}: ${(100 * s).toFixed(1)} %`).join(', ')}`}>
        {shares.map((share, i) => (
          <g key={i}>
            <rect x={20 + i * step + 4} y={125 - (105 * share) / top} width={Math.max(1, step - 8)} height={(105 * share) / top} fill="var(--series-1)" stroke="none" />
            <text x={20 + (i + 0.5) * step} y={140} text-anchor="middle">
              {name(i)}
            </text>
            <text x={20 + (i + 0.5) * step} y={120 - (105 * share) / top} text-anchor="middle">
              {`${(100 * share).toFixed(1)} %`}
            </text>
          </g>
        ))}
      </svg>
      <PlotActions title="Bounces" svg={() => svg.current} table={() => csv(['bounces', 'share'], shares.map((s, i) => [name(i), s]))} />
    </div>
  );
}
