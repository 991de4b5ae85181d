/** Any lobe as curve and surface: values, densities, albedo, samples, proofs, random walks, code. */

import { useMemo, useRef } from 'preact/hooks';
import { link, useAddress } from '../../core/address';
import type { Answer } from '../../core/ask';
import { useSavePicture } from '../../core/keys';
import type { LobeKind } from '../../core/protocol';
import { Choice, Message, Panel, Slider, Toggle } from '../../ui/controls';
import { CopyButton } from '../../ui/copy';
import { csv, save, savePng } from '../../ui/files';
import type { Page } from '../page';
import { useEach, useKinds, useLayers } from './answers';
import { Code } from './code';
import { curvesOf, greatest } from './curves';
import { Disks } from './disk';
import { Parameters } from './parameters';
import { savePicture } from './picture';
import { Polar } from './polar';
import { Proof, Samples } from './samples';
import { Slots } from './slots';
import { activeSlot, type Channels, DEFAULTS, type LobesState, type Quantity, QUANTITIES, quantityOf, SLICE_COUNT, sliceAzimuth, type Slot, SLOTS, snapped, viewAngle, viewOf } from './state';
import { Surface } from './surface';
import { energyTreatments, numbersOf, readText, simulatedText, writeText } from './text';
import { Albedo, Cartesian, Values } from './values';
import { Walks } from './walks';

const NO_KINDS: LobeKind[] = [];
const SAMPLES = 20_000;
const ALBEDO_SAMPLES = 2000;
const DEGREES = Float64Array.from({ length: SLICE_COUNT }, (_, i) => -180 + i / 4);

function Lobes() {
  const [state, set] = useAddress('lobes', DEFAULTS);
  const { found, error } = useKinds();
  const kinds = found?.kinds ?? NO_KINDS;
  const { layers, errors } = useLayers(state, set, kinds);
  const slot = activeSlot(state);
  const active = layers.find((layer) => layer.slot === slot);
  const content = useRef<HTMLDivElement>(null);
  useSavePicture(() => {
    if (content.current !== null) void savePicture('lobes.png', content.current, layers.map((l) => ({ text: `${l.letter}: ${l.lobe}`, colour: `--series-${SLOTS.indexOf(l.slot) + 1}` })));
  });
  // Of a text that the library has yet to normalise, too.
  const form = active?.form ?? readText(state[slot], kinds);
  return (
    <div class="page lobes">
      <aside aria-label="Controls">
        <Slots state={state} active={slot} errors={errors} treatments={form === undefined ? undefined : energyTreatments(form, kinds)} set={set} />
        <div class="actions">
          <CopyButton label="Copy the link to this page" text={() => location.href} />
        </div>
        <Message text={error} />
        <h2>View</h2>
        <Slider label="Elevation" unit="degrees" hint="90: along the normal; below 0: from inside" value={state.elevation} min={-90} max={90} steps={360} onInput={(elevation) => set({ elevation })} />
        <Slider label="Azimuth" unit="degrees" value={state.azimuth} min={-180} max={180} steps={360} onInput={(azimuth) => set({ azimuth })} />
        <Slider label="Light" unit="degrees from the normal" hint="In the plane of incidence; positive: on the mirror's side" value={state.light} min={-180} max={180} steps={720} onInput={(light) => set({ light: snapped(light) })} />
        <button type="button" onClick={() => set({ light: snapped(-viewAngle(state)) })}>
          Light at the mirror's direction
        </button>
        <h2>Shown</h2>
        <Choice label="Quantity" options={QUANTITIES} value={quantityOf(state).value} onChange={(quantity) => set({ quantity })} />
        <Choice label="Colour" options={[{ value: 'luminance', label: 'Luminance' }, { value: 'rgb', label: 'RGB' }]} value={state.channels as Channels} onChange={(channels) => set({ channels })} />
        <Toggle label="Logarithmic" value={state.log} onChange={(log) => set({ log })} />
        {found !== undefined && form !== undefined && (
          <section aria-labelledby="lobe-parameters">
            <h2 id="lobe-parameters">Lobe {slot.toUpperCase()}</h2>
            <Parameters form={form} found={found} onChange={(changed) => set({ [slot]: writeText(changed), slot })} />
          </section>
        )}
      </aside>
      <div class="content" ref={content}>
        {layers.length > 0 && active !== undefined && <Panels state={state} set={set} layers={layers} active={active} kinds={kinds} />}
      </div>
    </div>
  );
}

type Layers = ReturnType<typeof useLayers>['layers'];

interface PanelsProps {
  state: LobesState;
  set: (change: Partial<LobesState>) => void;
  layers: Layers;
  active: Layers[number];
  kinds: LobeKind[];
}

function Panels({ state, set, layers, active, kinds }: PanelsProps) {
  const wo = viewOf(state);
  const slices = useEach<'lobes.slice'>(layers, ({ lobe }) => ({ ask: 'lobes.slice', lobe, wo, azimuth: sliceAzimuth(state), count: SLICE_COUNT, samples: 16 }));
  const albedos = useEach<'lobes.albedo'>(layers, ({ lobe }) => ({ ask: 'lobes.albedo', lobe, count: 33, samples: ALBEDO_SAMPLES }));
  const samples = useEach<'lobes.samples'>(layers, ({ lobe }) => ({ ask: 'lobes.samples', lobe, wo, count: SAMPLES }));
  const isWhole = layers.some((layer) => layer.parsed?.transmits === true) || wo[2] < 0;
  const [rows, columns] = gridSize(active);
  const isDeep = active.parsed?.transmits === true || wo[2] < 0;
  const grids = useEach<'lobes.grid'>([active], ({ lobe }) => ({ ask: 'lobes.grid', lobe, wo, rows: isDeep ? 2 * rows - 1 : rows, columns, sphere: isDeep }));
  const answers = <T,>(asked: Record<Slot, { answer: T | undefined }>) => Object.fromEntries(Object.entries(asked).map(([slot, { answer }]) => [slot, answer])) as Record<Slot, T | undefined>;
  const quantity = quantityOf(state).value as Quantity;
  const slicesNow = answers(slices);
  const curves = useMemo(() => curvesOf(layers, slicesNow, quantity, state.channels as Channels), [layers, ...Object.values(slicesNow), quantity, state.channels]);
  const isPending = (asked: Record<Slot, { isPending: boolean }>) => Object.values(asked).some((a) => a.isPending);
  const problem = [...Object.values(slices), ...Object.values(albedos), ...Object.values(samples), ...Object.values(grids)].find((a) => a.error !== undefined)?.error;
  const axis = quantityOf(state).axis;
  const grid = grids[active.slot].answer;
  const gridDeep = grid !== undefined && (grid.arrays.theta.values.at(-1) as number) > 2;
  const points = state.points ? samples[active.slot].answer?.arrays.wi.values.subarray(0, 3 * 4000) : undefined;
  const hasDelta = active.parsed?.isSpecular === true;
  return (
    <>
      <Message text={problem} />
      <Panel title="Plane of incidence" isPending={isPending(slices)}>
        <Polar title={`Polar plot of ${axis}`} degrees={DEGREES} curves={curves} isLogarithmic={state.log} isWhole={isWhole} view={viewAngle(state)} light={state.light} onLight={(light) => set({ light })} />
        {greatest(curves) === 0 && <p class="notice">{hasDelta ? 'The lobe is Dirac deltas only: they have no value to draw.' : 'All values are 0 here.'}</p>}
      </Panel>
      <Panel title="The same, over the angle" isPending={isPending(slices)}>
        <Cartesian title={`Plot of ${axis} over the angle`} axis={axis} degrees={DEGREES} curves={curves} isLogarithmic={state.log} isWhole={isWhole} light={state.light} />
      </Panel>
      <Panel title={`Lobe ${active.letter} in three dimensions`} isPending={grids[active.slot].isPending} actions={
          <button
            type="button"
            aria-label="Save PNG: three dimensions"
            onClick={(event) => {
              const canvas = event.currentTarget.closest('.panel')?.querySelector('canvas');
              if (canvas instanceof HTMLCanvasElement) void savePng('lobe-3d.png', canvas);
            }}
          >
            PNG
          </button>
        }>
        {grid !== undefined && <Surface label={`${active.lobe}: ${axis} as a surface; turn it by dragging`} grid={grid} quantity={quantity} isLogarithmic={state.log} wo={wo} />}
      </Panel>
      <Panel title={`Lobe ${active.letter} over all directions`} wide={gridDeep} isPending={grids[active.slot].isPending} actions={
          <>
            <Toggle label="Samples" value={state.points} onChange={(on) => set({ points: on })} />
            <button type="button" aria-label="Save CSV: all directions" onClick={() => grid !== undefined && save('directions.csv', gridCsv(grid), 'text/csv')}>
              CSV
            </button>
          </>
        }
      >
        {grid !== undefined && <Disks title={`Directions of ${active.lobe}`} axis={axis} grid={grid} quantity={quantity} isLogarithmic={state.log} wo={wo} isWhole={gridDeep} points={points} />}
      </Panel>
      <Panel title="Albedo and furnace" isPending={isPending(albedos)}>
        <Albedo state={state} layers={layers} albedos={answers(albedos)} />
      </Panel>
      <Panel title={`Values at the light, ${state.light} degrees`} isPending={isPending(slices)}>
        <Values state={state} layers={layers} slices={slicesNow} />
      </Panel>
      <Panel title="Samples" isPending={isPending(samples)}>
        <Samples layers={layers} samples={answers(samples)} count={SAMPLES} />
      </Panel>
      <Panel title="Random walks" wide={active.form?.kind.name.startsWith('multibounce-') === true}>
        <WalksOf state={state} set={set} active={active} kinds={kinds} />
      </Panel>
      <Panel title="Proof" wide>
        <Proof layer={active} wo={wo} />
      </Panel>
      <Panel title={`Lobe ${active.letter} elsewhere`} wide actions={<a href={link('lobes', { a: active.lobe })}>Link to this lobe alone</a>}>
        <Code lobe={active.lobe} language={state.language} onLanguage={(language) => set({ language })} />
      </Panel>
    </>
  );
}

function gridCsv({ arrays: { theta, phi, f_cos, pdf } }: Answer<'lobes.grid'>): string {
  const columns = phi.values.length;
  const rows = Array.from(pdf.values, (density, i) => [theta.values[Math.floor(i / columns)] as number, phi.values[i % columns] as number, ...f_cos.values.subarray(3 * i, 3 * i + 3), density]);
  return csv(['theta', 'phi', 'red', 'green', 'blue', 'pdf'], rows);
}

/** Rows of the upper hemisphere and columns of a grid: narrow lobes take finer ones, random ones coarser. */
function gridSize({ form, parsed }: Layers[number]): [number, number] {
  if (parsed?.isStochastic === true) return [31, 73];
  const alpha = Math.min(...numbersOf(form?.given['alpha'] ?? form?.given['roughness'] ?? '0.5', 2));
  return alpha < 0.1 ? [181, 361] : [73, 181];
}

function WalksOf({ state, set, active, kinds }: Omit<PanelsProps, 'layers'>) {
  const form = active.form;
  const isSimulated = form?.kind.name.startsWith('multibounce-') === true;
  const wo = viewOf(state);
  const asked = useEach<'lobes.walks'>([active], ({ lobe }) => (isSimulated ? { ask: 'lobes.walks', lobe, wo, count: 256 } : undefined))[active.slot];
  if (form === undefined || !isSimulated) {
    const simulated = form === undefined ? undefined : simulatedText(form, kinds);
    return (
      <div>
        <p class="quiet">The multi-bounce kinds walk from facet to facet. This lobe scatters without walks.</p>
        {simulated !== undefined && (
          <button type="button" onClick={() => set({ [active.slot]: simulated })}>
            Simulate its bounces
          </button>
        )}
      </div>
    );
  }
  const alpha = Math.max(...numbersOf(form.given['alpha'] ?? '0.3', 2));
  return (
    <div>
      <Message text={asked.error} />
      {asked.answer !== undefined && <Walks walks={asked.answer} alpha={alpha} azimuth={sliceAzimuth(state)} chosen={state.walk} onChoose={(walk) => set({ walk })} />}
    </div>
  );
}

export const page: Page = {
  id: 'lobes',
  title: 'Lobes',
  summary: 'Any lobe as curve and surface: value, density, albedo, random walks.',
  component: Lobes,
};
