/** The sphere of reflections and the one of the stretched space: regions, samples that rain in, the view. */

import { useEffect, useMemo, useState } from 'preact/hooks';
import { Mesh, MeshBasicMaterial, type Object3D, SphereGeometry } from 'three';
import { RADIANS } from '../../core/directions';
import type { Vec3 } from '../../core/protocol';
import { useThemeChange } from '../../core/theme';
import { type Asked, useAnswer } from '../../core/use_answer';
import { Message, Panel, Slider } from '../../ui/controls';
import { format, Swatch } from '../../ui/plot';
import { Space, themeColour } from '../../ui/space';
import { Clock, rain, wantsStillness } from './rain';
import { angles, type SamplerState, type Setup } from './setup';
import { outline, sphere, view } from './sphere';

/** Most samples that are drawn. */
const DRAWN = 4000;
const PARTS = [
  ['cap', 'Cap', '--series-1'],
  ['bounded_cap', 'Bounded cap', '--series-2'],
  ['exact', 'Exact region', '--series-3'],
  ['accepted', 'Accepted samples (small)', '--ink'],
  ['rejected', 'Rejected samples (large)', '--bad'],
] as const;
const LABELS: { text: string; at: Vec3 }[] = [
  { text: 'x', at: [1.12, 0, 0] },
  { text: 'y', at: [0, 1.12, 0] },
  { text: 'n', at: [0, 0, 1.12] },
];

interface Props {
  setup: Setup;
  state: SamplerState;
  set: (change: Partial<SamplerState>) => void;
}

type Samples = Asked<'samplers.samples'>;

/** The clock of the rain; begins anew with another sampler or other random numbers, and when it is asked to. */
function useClock(key: string, isWanted: boolean): { clock: Clock; again: () => void; toggle: () => void; isPaused: boolean } {
  const [times, setTimes] = useState(0);
  const clock = useMemo(() => new Clock(!isWanted || (times === 0 && wantsStillness())), [key, isWanted, times]);
  const [, setTick] = useState(0);
  const toggle = () => {
    if (clock.isStopped) clock.goOn();
    else clock.stop();
    setTick((n) => n + 1);
  };
  return { clock, again: () => setTimes((n) => n + 1), toggle, isPaused: clock.isStopped };
}

export function Spheres({ setup, state, set }: Props) {
  const theme = useThemeChange();
  const regions = useAnswer<'samplers.regions'>({ ask: 'samplers.regions', alpha: setup.alpha, wo: setup.wo, count: 256 });
  const samples = useAnswer<'samplers.samples'>({ ask: 'samplers.samples', ...setup, count: Math.min(state.count, DRAWN), seed: state.seed });
  const described = useAnswer<'samplers.describe'>({ ask: 'samplers.describe', ...setup });
  const { clock, again, toggle, isPaused } = useClock(`${setup.sampler} ${state.seed}`, state.rain);
  const hidden = new Set(state.hides.split(',').filter((name) => name !== ''));
  const [onSphere, stretched] = useMemo(() => {
    const draw = (isStretched: boolean) => {
      const parts: Object3D[] = [...sphere()];
      const drawn = samples.answer?.arrays;
      if (drawn !== undefined) {
        const where = (isStretched ? drawn.stretched : drawn.wi).values;
        const accepted = drawn.accepted.values;
        if (!hidden.has('accepted')) parts.push(rain(where, (i) => accepted[i] === 1, '--ink', 1.8, clock));
        if (!hidden.has('rejected')) parts.push(rain(where, (i) => accepted[i] !== 1, '--bad', 4.5, clock));
      }
      for (const [name, , colour] of PARTS.slice(0, 3)) {
        const found = regions.answer?.arrays[(isStretched ? name : `${name}_wi`) as 'cap'];
        if (found !== undefined && !hidden.has(name)) parts.push(outline(found.values, colour));
      }
      const centre = isStretched ? described.answer?.value.stretched : setup.wo;
      return centre === undefined ? parts : parts.concat(view(centre));
    };
    return [draw(false), draw(true)];
  }, [samples.answer, regions.answer, described.answer, theme, clock, state.hides]);
  const [near, setNear] = useState<number>();
  const probed = near ?? (state.sample > 0 ? state.sample - 1 : undefined);
  const marks = useMemo(() => [false, true].map((isStretched) => mark(samples, probed, isStretched)), [samples.answer, probed, theme]);
  const animate = useMemo(() => () => clock.runs, [clock, isPaused]);
  return (
    <>
      <Panel title="Reflections" isPending={samples.isPending} actions={<RainActions clock={clock} isPaused={isPaused} again={again} toggle={toggle} />}>
        <Message text={samples.error ?? regions.error} />
        <Space
          label="The unit sphere with sampled reflections, outlines of the regions and the view"
          contents={onSphere}
          marks={marks[0] ?? []}
          labels={LABELS}
          animate={animate}
          draggable={['view']}
          onDrag={(_, point) => set(angles(point))}
          onHover={(point) => setNear(nearest(samples, point, false))}
        />
        <Legend hidden={hidden} onHide={(hides) => set({ hides: hides.join(',') })} />
      </Panel>
      <Panel title="Stretched space" isPending={samples.isPending}>
        <Space label="The same samples in the space where the surface is a hemisphere" contents={stretched} marks={marks[1] ?? []} labels={LABELS} animate={animate} onHover={(point) => setNear(nearest(samples, point, true))} />
        <Readout samples={samples} probed={probed} state={state} set={set} />
        <Counts samples={samples} clock={clock} acceptance={described.answer?.value.acceptance} />
      </Panel>
    </>
  );
}

function RainActions({ clock, isPaused, again, toggle }: { clock: Clock; isPaused: boolean; again: () => void; toggle: () => void }) {
  const [isOver, setOver] = useState(clock.isOver);
  useEffect(() => {
    setOver(clock.isOver);
    if (clock.isOver) return;
    const timer = setInterval(() => setOver(clock.isOver), 200);
    return () => clearInterval(timer);
  }, [clock]);
  return (
    <>
      <button type="button" disabled={isOver} onClick={toggle}>
        {isPaused ? 'Go on' : 'Pause'}
      </button>
      <button type="button" onClick={again}>
        Let them rain
      </button>
    </>
  );
}

/** A ball at a sample. */
function mark(samples: Samples, i: number | undefined, isStretched: boolean): Object3D[] {
  const drawn = samples.answer?.arrays;
  if (drawn === undefined || i === undefined || i >= drawn.pdf.values.length) return [];
  const where = (isStretched ? drawn.stretched : drawn.wi).values;
  const ball = new Mesh(new SphereGeometry(0.03, 16, 12), new MeshBasicMaterial({ color: themeColour('--series-5') }));
  ball.position.set(where[3 * i] as number, where[3 * i + 1] as number, where[3 * i + 2] as number);
  return [ball];
}

/** The sample nearest to a point of the sphere, where one is near. */
function nearest(samples: Samples, point: Vec3 | undefined, isStretched: boolean): number | undefined {
  const drawn = samples.answer?.arrays;
  if (drawn === undefined || point === undefined) return undefined;
  const where = (isStretched ? drawn.stretched : drawn.wi).values;
  let [best, cosine] = [-1, 0.995];
  for (let i = 0; i < where.length / 3; i++) {
    const dot = point[0] * (where[3 * i] as number) + point[1] * (where[3 * i + 1] as number) + point[2] * (where[3 * i + 2] as number);
    if (dot > cosine) [best, cosine] = [i, dot];
  }
  return best < 0 ? undefined : best;
}

function Readout({ samples, probed, state, set }: { samples: Samples; probed: number | undefined; state: SamplerState; set: Props['set'] }) {
  const drawn = samples.answer?.arrays;
  const count = drawn?.pdf.values.length ?? 1;
  const text = () => {
    if (drawn === undefined || probed === undefined || probed >= count) return 'Point at a sample, or choose its number.';
    const [x, y, z] = [0, 1, 2].map((k) => drawn.wi.values[3 * probed + k] as number) as Vec3;
    const [theta, phi] = [Math.acos(Math.max(-1, Math.min(1, z))), Math.atan2(y, x)].map((a) => (a / RADIANS).toFixed(1));
    const isAccepted = drawn.accepted.values[probed] === 1;
    return `Sample ${probed + 1}: wi at theta ${theta}, phi ${phi} degrees; ${isAccepted ? `pdf ${format(drawn.pdf.values[probed] as number)} 1/sr` : 'below the horizon: rejected'}.`;
  };
  return (
    <>
      <Slider label="Sample" hint="0: none" value={Math.min(state.sample, count)} min={0} max={count} isInteger onInput={(sample) => set({ sample })} />
      <p data-figure="sample">{text()}</p>
    </>
  );
}

function Counts({ samples, clock, acceptance }: { samples: Samples; clock: Clock; acceptance: number | undefined }) {
  const accepted = samples.answer?.arrays.accepted.values;
  const [, setTick] = useState(0);
  useEffect(() => {
    const timer = setInterval(() => {
      if (!clock.isOver) setTick((n) => n + 1);
    }, 100);
    return () => clearInterval(timer);
  }, [clock]);
  const fallen = accepted === undefined ? 0 : clock.fallen(accepted.length);
  let above = 0;
  for (let i = 0; i < fallen; i++) above += accepted?.[i] ?? 0;
  return (
    <dl class="figures">
      <dt>Drawn: accepted, rejected</dt>
      <dd data-figure="accepted">{accepted === undefined ? '' : `${above}, ${fallen - above}`}</dd>
      <dt>Accepted, by quadrature</dt>
      <dd data-figure="acceptance">{acceptance === undefined ? '' : `${(100 * acceptance).toFixed(2)} %`}</dd>
    </dl>
  );
}

function Legend({ hidden, onHide }: { hidden: Set<string>; onHide: (hidden: string[]) => void }) {
  return (
    <>
      <ul class="legend toggles" aria-label="Legend">
        {PARTS.map(([name, label, colour]) => (
          <li key={name}>
            <button type="button" class="plain" aria-pressed={!hidden.has(name)} onClick={() => onHide(hidden.has(name) ? [...hidden].filter((h) => h !== name) : [...hidden, name])}>
              <Swatch colour={`var(${colour})`} /> {label}
            </button>
          </li>
        ))}
      </ul>
      <p class="quiet">Drag the ball of the arrow to turn the view.</p>
    </>
  );
}
