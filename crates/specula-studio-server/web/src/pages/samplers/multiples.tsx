/** All samplers side by side: where their samples go, and what they reject. */

import type { Sampler } from '../../core/protocol';
import { useAnswer } from '../../core/use_answer';
import { Message, Panel } from '../../ui/controls';
import { Heat } from '../../ui/heats';
import { viridis } from '../../ui/scale';
import { SAMPLERS, type SamplerState, type Setup } from './setup';

/** Cells along a side, and samples. */
const CELLS = 32;
const COUNT = 50_000;

export function Multiples({ setup, state, onChoose }: { setup: Setup; state: SamplerState; onChoose: (sampler: Sampler) => void }) {
  return (
    <Panel title="Side by side" wide>
      <div class="multiples">
        {SAMPLERS.map(({ value, label }) => (
          <One key={value} setup={{ ...setup, sampler: value }} label={label} seed={state.seed} isChosen={value === setup.sampler} onChoose={() => onChoose(value)} />
        ))}
      </div>
      <p class="quiet">Samples above the horizon on the disk of x and y, {COUNT.toLocaleString('en')} each, by the square root of their number over the largest of the sampler.</p>
    </Panel>
  );
}

function One({ setup, label, seed, isChosen, onChoose }: { setup: Setup; label: string; seed: number; isChosen: boolean; onChoose: () => void }) {
  const { answer, error, isPending } = useAnswer<'samplers.histogram'>({ ask: 'samplers.histogram', ...setup, size: CELLS, count: COUNT, seed });
  const counts = answer?.arrays.counts.values;
  const most = counts?.reduce((a, b) => Math.max(a, b), 1) ?? 1;
  return (
    <div class={isPending ? 'is-pending' : ''} data-multiple={setup.sampler}>
      <button type="button" aria-pressed={isChosen} onClick={onChoose}>
        {label}
      </button>
      <Message text={error} />
      {counts !== undefined && answer !== undefined && (
        <>
          <Heat label={`${label}, counted`} axes="x to the right, y upwards" rows={CELLS} columns={CELLS} shares={Array.from(counts, (c) => Math.sqrt(c / most))} colour={viridis} />
          <p class="quiet">
            rejected {((100 * answer.value.rejected) / COUNT).toFixed(2)} %, <span class="whole">p = {answer.value.p.toPrecision(2)}</span>
          </p>
        </>
      )}
    </div>
  );
}
