/** A BSDF in WGSL put to the proof: chi-square, normalisation, furnace, reciprocity, finite values. */

import { useAddress } from '../../core/address';
import { direction } from '../../core/directions';
import { Message, Panel, Select, Slider } from '../../ui/controls';
import { csv, save } from '../../ui/files';
import { Heats } from '../../ui/heats';
import { Checks } from '../lobes/samples';
import type { Page } from '../page';
import { Editor } from './editor';
import { PRESETS, type Preset } from './presets';
import { COLUMNS, ROWS } from './prover';
import { useProof } from './use_proof';

const DEFAULTS = {
  preset: 'ggx',
  /** The text, where it is not the preset's. */
  text: '',
  elevation: 40,
  azimuth: 0,
  parameters: [0.4, 0.25, 0, 0],
  /** Powers of two of samples a thread. */
  samples: 6,
  seed: 1,
};

function Proof() {
  const [state, set] = useAddress('proof', DEFAULTS);
  const preset = PRESETS.find((p) => p.id === state.preset) ?? (PRESETS[0] as Preset);
  const text = state.text === '' ? preset.text : state.text;
  const parameters = [0, 1, 2, 3].map((i) => state.parameters[i] ?? 0) as [number, number, number, number];
  const each = 2 ** Math.max(4, Math.min(10, Math.round(state.samples)));
  const proof = useProof(text, state.text !== '', { wo: direction(state.elevation, state.azimuth), parameters, seed: state.seed, each });
  const { verdict, faults } = proof;
  const broken = verdict?.checks.filter((check) => !check.holds).length ?? 0;
  return (
    <div class="page lobes">
      <aside aria-label="Controls">
        <h1>Proof</h1>
        <Select label="Text to begin with" options={PRESETS.map((p) => ({ value: p.id, label: p.name }))} value={preset.id} onChange={(id) => set({ preset: id, text: '' })} />
        <p class="quiet">{preset.doc}</p>
        {state.text !== '' && (
          <button type="button" onClick={() => set({ text: '' })}>
            Discard changes
          </button>
        )}
        <h2>View</h2>
        <Slider label="Elevation" unit="degrees" value={state.elevation} min={-90} max={90} steps={360} onInput={(elevation) => set({ elevation })} />
        <Slider label="Azimuth" unit="degrees" value={state.azimuth} min={-180} max={180} steps={360} onInput={(azimuth) => set({ azimuth })} />
        <h2>parameters: vec4f</h2>
        {(['x', 'y', 'z', 'w'] as const).map((name, i) => (
          <Slider
            key={name}
            label={i === 0 ? 'parameters.x (alpha x)' : i === 1 ? 'parameters.y (alpha y)' : `parameters.${name}`}
            value={parameters[i] as number}
            min={i < 2 ? 0.01 : 0}
            max={i < 2 ? 2 : 4}
            isLogarithmic={i < 2}
            onInput={(x) => set({ parameters: parameters.map((value, k) => (k === i ? x : value)) })}
          />
        ))}
        <h2>Samples</h2>
        <Slider label="Samples" unit="powers of two" hint="A test of more samples finds smaller faults" value={Math.log2(8192 * each)} min={17} max={23} steps={6} isInteger onInput={(power) => set({ samples: power - 13 })} />
        <button type="button" onClick={() => set({ seed: state.seed + 1 })}>
          Other random numbers
        </button>
      </aside>
      <div class="content">
        <Panel title="BSDF in WGSL" wide>
          <Editor text={text} faults={faults} onText={(typed) => set({ text: typed === preset.text ? '' : typed })} />
          <Interface />
        </Panel>
        <Panel
          title="Verdict"
          wide
          isPending={proof.isPending}
          actions={
            verdict !== undefined && (
              <button type="button" aria-label="Save CSV: cells" onClick={() => save('proof.csv', csv(['row', 'column', 'counted', 'expected'], Array.from(verdict.counts, (count, i) => [Math.floor(i / COLUMNS), i % COLUMNS, count, verdict.expected[i] as number])), 'text/csv')}>
                CSV
              </button>
            )
          }
        >
          <p role="status">
            {faults.length > 0 ? 'The text does not compile.' : verdict === undefined ? (proof.error === undefined ? 'Compiling.' : '') : broken === 0 ? 'All checks hold.' : `${broken} of ${verdict.checks.length} checks ${broken === 1 ? 'does' : 'do'} not hold.`}
          </p>
          <Message text={proof.error} />
          {verdict !== undefined && (
            <>
              <Checks checks={verdict.checks} />
              <p class="quiet">
                Compiled in {proof.compileTime.toFixed(0)} ms, run in {proof.runTime.toFixed(0)} ms, in single precision. Densities are integrated over each cell by the midpoint rule, 32 x 32 points, or 256 x 256 for the cells that need them most; what a rule of half as many says otherwise is allowed for. Dirac deltas cannot be proved here.
              </p>
            </>
          )}
        </Panel>
        {verdict !== undefined && (
          <Panel title="Samples by direction" wide isPending={proof.isPending}>
            <Heats rows={ROWS} columns={COLUMNS} counts={verdict.counts} expected={verdict.expected} axes="theta downwards from 0 to 180 degrees, phi to the right from 0 to 360" />
            <p class="quiet">Theta downwards from 0 to 180 degrees, phi to the right from 0 to 360 degrees. Colours by the square root of the count.</p>
          </Panel>
        )}
      </div>
    </div>
  );
}

function Interface() {
  return (
    <details class="interface">
      <summary>What the text defines, and what it may use</summary>
      <dl class="figures">
        <dt>
          <code>fn user_eval(wo: vec3f, wi: vec3f) -&gt; vec3f</code>
        </dt>
        <dd>f |cos| in 1/sr; 0 where there is nothing</dd>
        <dt>
          <code>fn user_pdf(wo: vec3f, wi: vec3f) -&gt; f32</code>
        </dt>
        <dd>density of the samples in 1/sr</dd>
        <dt>
          <code>fn user_sample(wo: vec3f, u: vec3f) -&gt; vec4f</code>
        </dt>
        <dd>wi, and its density; a density of 0: the sample failed</dd>
        <dt>
          <code>parameters: vec4f</code>
        </dt>
        <dd>the page's sliders</dd>
      </dl>
      <p class="quiet">
        Directions are unit, in the local frame, z along the normal; both point away from the surface. u is uniform in [0, 1)^3. Functions of the exported library, such as bounded_sample_direction, may be called by their names. Names that begin with proof_ are taken.
      </p>
    </details>
  );
}

export const page: Page = {
  id: 'proof',
  title: 'Proof',
  summary: 'A BSDF of yours in WGSL: chi-square, normalisation, furnace, reciprocity.',
  component: Proof,
};
