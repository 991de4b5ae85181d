/** What is compared: how many treatments, and of each the sampler and what becomes of lost energy. */

import { Choice, Select, Slider } from '../../ui/controls';
import { SAMPLERS } from '../samplers/setup';
import { countOf, LETTERS, type RenderState, type Set } from './state';

export function Treatments({ state, set, energies }: { state: RenderState; set: Set; energies: string[] }) {
  const count = countOf(state);
  const own = { value: '', label: "the scene's own" };
  const energyOptions = [own, ...energies.map((e) => ({ value: e, label: e }))];
  const samplerOptions = [own, ...SAMPLERS.map(({ value, label }) => ({ value: value as string, label }))];
  return (
    <>
      <h3>Treatments</h3>
      <Slider label="Compared" value={count} min={1} max={4} steps={3} isInteger onInput={(treatments) => set({ treatments, dividers: [] })} />
      {count > 1 && (
        <Choice
          label="Equal"
          value={state.mode}
          options={[
            { value: 'time', label: 'Equal time' },
            { value: 'samples', label: 'Equal samples' },
          ]}
          onChange={(mode) => set({ mode })}
        />
      )}
      {LETTERS.slice(0, count).map((letter) => (
        <fieldset key={letter} class="treatment">
          <legend>{count === 1 ? 'Metals' : letter}</legend>
          <Select label={`Energy of metals, ${letter}`} value={state[`energy${letter}`]} options={energyOptions} onChange={(energy) => set({ [`energy${letter}`]: energy })} />
          <Select label={`Sampler of metals, ${letter}`} value={state[`sampler${letter}`]} options={samplerOptions} onChange={(sampler) => set({ [`sampler${letter}`]: sampler })} />
        </fieldset>
      ))}
      <Select
        label="Reference"
        value={LETTERS.slice(0, count).some((l) => l === state.reference) ? state.reference : 'no'}
        options={[{ value: 'no', label: 'none' }, ...LETTERS.slice(0, count).map((letter) => ({ value: letter as string, label: `another render of ${letter}` }))]}
        onChange={(reference) => set({ reference, ...(reference === 'no' && state.show === 'error' ? { show: 'picture' } : {}) })}
      />
    </>
  );
}
