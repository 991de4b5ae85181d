/** Samplers of visible normals: where their samples go, what they reject, whether their density is what it says. */

import { useAddress } from '../../core/address';
import { direction, RADIANS } from '../../core/directions';
import type { Sampler } from '../../core/protocol';
import { useAnswer } from '../../core/use_answer';
import { Choice, Message, Panel, Select, Slider, Toggle } from '../../ui/controls';
import { Formula } from '../../ui/formula';
import { Heats } from '../../ui/heats';
import { format, formatAlike } from '../../ui/plot';
import { Table } from '../../ui/table';
import type { Page } from '../page';
import { GpuCheck } from './gpu_check';
import { Multiples } from './multiples';
import { DEFAULTS, PRESETS, SAMPLERS, type SamplerState, type Setup } from './setup';
import { Slice } from './slice';
import { Spheres } from './spheres';

/** Cells of the histogram along a side. */
const CELLS = 48;

type Set = (change: Partial<SamplerState>) => void;

function Samplers() {
  const [state, set] = useAddress('samplers', DEFAULTS);
  const setup = {
    sampler: (SAMPLERS.some((s) => s.value === state.sampler) ? state.sampler : 'bounded') as Sampler,
    alpha: [state.alpha[0] ?? 0.6, state.alpha[1] ?? state.alpha[0] ?? 0.6] as [number, number],
    wo: direction(state.elevation, state.azimuth),
  };
  return (
    <div class="page">
      <Controls state={state} set={set} />
      <div class="content">
        <Spheres setup={setup} state={state} set={set} />
        <Multiples setup={setup} state={state} onChoose={(sampler) => set({ sampler })} />
        <Density setup={setup} state={state} />
        <Comparison setup={setup} state={state} />
        <Slice setup={setup} />
        <GpuCheck setup={setup} seed={state.seed} />
        <Formulas setup={setup} />
      </div>
    </div>
  );
}

function Controls({ state, set }: { state: SamplerState; set: Set }) {
  const [x, y] = [state.alpha[0] ?? 0.6, state.alpha[1] ?? 0.6];
  return (
    <aside aria-label="Controls">
      <h1>Samplers</h1>
      <Choice label="Sampler" options={SAMPLERS} value={state.sampler as Sampler} onChange={(sampler) => set({ sampler })} />
      <Slider label="alpha x" value={x} min={0.01} max={2} isLogarithmic onInput={(v) => set({ alpha: [v, y] })} />
      <Slider label="alpha y" value={y} min={0.01} max={2} isLogarithmic onInput={(v) => set({ alpha: [x, v] })} />
      <h3>View</h3>
      <Slider label="Elevation" unit="degrees" value={state.elevation} min={-90} max={90} onInput={(elevation) => set({ elevation })} />
      <Slider label="Azimuth" unit="degrees" value={state.azimuth} min={0} max={360} onInput={(azimuth) => set({ azimuth })} />
      <h3>Samples</h3>
      <Slider label="Count" value={state.count} min={100} max={1e6} isLogarithmic isInteger onInput={(count) => set({ count })} />
      <Toggle label="Samples rain in" value={state.rain} onChange={(isRaining) => set({ rain: isRaining })} />
      <Slider label="Seed" value={state.seed} min={1} max={1000} isInteger onInput={(seed) => set({ seed })} />
      <h3>Light, for the comparison</h3>
      <Select
        label="Light"
        value={state.light}
        options={[
          { value: 'uniform', label: 'From everywhere' },
          { value: 'lamp', label: 'A lamp' },
        ]}
        onChange={(light) => set({ light })}
      />
      {state.light === 'lamp' && (
        <>
          <Slider label="Lamp elevation" unit="degrees" value={state.lightElevation} min={1} max={90} onInput={(v) => set({ lightElevation: v })} />
          <Slider label="Lamp azimuth" unit="degrees" value={state.lightAzimuth} min={0} max={360} onInput={(v) => set({ lightAzimuth: v })} />
          <Slider label="Lamp half angle" unit="degrees" value={state.lightAngle} min={1} max={90} onInput={(v) => set({ lightAngle: v })} />
        </>
      )}
      <h3>Presets</h3>
      {PRESETS.map(({ group, presets }) => (
        <div key={group} role="group" aria-label={group}>
          <p class="quiet">{group}</p>
          <div class="actions">
            {presets.map((preset) => (
              <button key={preset.name} type="button" onClick={() => set(preset.state)}>
                {preset.name}
              </button>
            ))}
          </div>
        </div>
      ))}
    </aside>
  );
}

interface Part {
  setup: Setup;
  state: SamplerState;
}

function Density({ setup, state }: Part) {
  const { answer, error, isPending } = useAnswer<'samplers.histogram'>({ ask: 'samplers.histogram', ...setup, size: CELLS, count: state.count, seed: state.seed });
  const value = answer?.value;
  return (
    <Panel title="Histogram and density" wide isPending={isPending}>
      <Message text={error} />
      {answer !== undefined && (
        <Heats rows={CELLS} columns={CELLS} counts={answer.arrays.counts.values} expected={answer.arrays.expected.values} axes="x of the reflection to the right, y upwards" />
      )}
      {value !== undefined && (
        <p>
          Chi-square {format(value.chiSquare)} of {value.degrees} degrees, p = <span data-figure="p">{value.p.toPrecision(3)}</span>:{' '}
          <span class={value.p < 1e-4 ? 'bad' : 'good'}>{value.p < 1e-4 ? 'the samples do not have this density' : 'nothing against the density'}</span>. Rejected {value.rejected}, expected{' '}
          {value.expectedRejected.toFixed(0)}.
        </p>
      )}
    </Panel>
  );
}

function Comparison({ setup, state }: Part) {
  const lamp = state.light === 'lamp' ? { towards: direction(state.lightElevation, state.lightAzimuth), angle: state.lightAngle * RADIANS } : {};
  const isAbove = setup.wo[2] > 0;
  const { answer, error, isPending } = useAnswer<'samplers.compare'>(
    isAbove ? { ask: 'samplers.compare', alpha: setup.alpha, wo: setup.wo, lamp, count: Math.min(state.count, 200_000), seed: state.seed } : undefined,
  );
  const rows = isAbove ? (answer?.value.rows ?? []) : [];
  const best = Math.min(...rows.map((row) => row.variance));
  return (
    <Panel title="All samplers" isPending={isPending}>
      <Message text={isAbove ? error : undefined} />
      {!isAbove && <p class="quiet">Estimates are compared for views above the horizon.</p>}
      <Table name="All samplers" words={['Sampler']} numbers={['Accepted', 'Mean', 'Variance', 'Over the best', 'ns']}>
        {rows.map((row) => (
          <tr key={row.sampler}>
            <th scope="row">{SAMPLERS.find((s) => s.value === row.sampler)?.label}</th>
            <td class="number">{(100 * row.acceptance).toFixed(1)} %</td>
            <td class="number">{row.mean.toFixed(4)}</td>
            <td class="number">{formatAlike(row.variance, 4)}</td>
            <td class="number">{best > 0 ? (row.variance / best).toFixed(2) : ''}</td>
            <td class="number">{row.nanoseconds?.toFixed(0) ?? ''}</td>
          </tr>
        ))}
      </Table>
      <p class="quiet">An estimator of white metal under the chosen light: the mean is the same, its noise is not.</p>
    </Panel>
  );
}

function Formulas({ setup }: Pick<Part, 'setup'>) {
  const { answer, error } = useAnswer<'samplers.describe'>({ ask: 'samplers.describe', ...setup });
  return (
    <Panel title="Formulas, with these numbers" wide>
      <Message text={error} />
      {answer?.value.formulas.map((formula) => (
        <div key={formula.id}>
          <h3>{formula.name}</h3>
          <Formula tex={formula.tex} />
          <Formula tex={formula.numbers} />
          <p class="quiet">{formula.source}</p>
        </div>
      ))}
    </Panel>
  );
}

export const page: Page = {
  id: 'samplers',
  title: 'Samplers',
  summary: 'Where each sampler of visible normals puts its samples, what it rejects, and whether its density is what it says.',
  component: Samplers,
};
