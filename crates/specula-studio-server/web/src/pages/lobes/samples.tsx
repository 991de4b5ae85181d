/** What samples of the lobes say, and proofs of one of them. */

import { useState } from 'preact/hooks';
import { type Answer, ask } from '../../core/ask';
import type { Check, Vec3 } from '../../core/protocol';
import { Message } from '../../ui/controls';
import { Heats } from '../../ui/heats';
import { Table } from '../../ui/table';
import type { Layer } from './answers';
import { figure } from './curves';
import type { Slot } from './state';

/** The table of samples by lobe. */
export function Samples({ layers, samples, count }: { layers: Layer[]; samples: Record<Slot, Answer<'lobes.samples'> | undefined>; count: number }) {
  return (
    <>
      <Table name="Samples by lobe" words={['Lobe']} numbers={['Failed', 'Albedo: red, green, blue', 'Variance of the weight']}>
        {layers.map(({ slot, letter }) => {
          const value = samples[slot]?.value;
          if (value === undefined) return null;
          return (
            <tr key={slot}>
              <th scope="row">{letter}</th>
              <td class="number">{`${((100 * value.failed) / count).toFixed(2)}\u00a0%`}</td>
              <td class="number list">{value.albedo.map((x) => x.toFixed(4)).join(', ')}</td>
              <td class="number">{figure(value.variance)}</td>
            </tr>
          );
        })}
      </Table>
      <p class="quiet">{count.toLocaleString('en')} samples of the view each. A failed sample counts as 0.</p>
    </>
  );
}

/** Samples of a proof. */
const PROOF_SAMPLES = 200_000;

/** Proves one lobe at one view, when told to. */
export function Proof({ layer, wo }: { layer: Layer; wo: Vec3 }) {
  const [proof, setProof] = useState<{ of: string; answer?: Answer<'lobes.prove'>; error?: string }>();
  const [isRunning, setRunning] = useState(false);
  const of = `${layer.lobe} ${wo.join()}`;
  const run = async () => {
    setRunning(true);
    try {
      setProof({ of, answer: await ask({ ask: 'lobes.prove', lobe: layer.lobe, wo, samples: PROOF_SAMPLES }) });
    } catch (error) {
      setProof({ of, error: error instanceof Error ? error.message : String(error) });
    }
    setRunning(false);
  };
  const current = proof?.of === of ? proof : undefined;
  const { counts, expected } = current?.answer?.arrays ?? {};
  return (
    <div>
      <div class="actions">
        <button type="button" class="main" disabled={isRunning} onClick={run}>
          {isRunning ? 'Proving' : `Prove lobe ${layer.letter} at this view`}
        </button>
        <span class="quiet">Chi-square, normalisation, furnace, reciprocity; {PROOF_SAMPLES.toLocaleString('en')} samples.</span>
      </div>
      <Message text={current?.error} />
      {current?.answer !== undefined && <Checks checks={current.answer.value.checks} />}
      {counts !== undefined && expected !== undefined && <Heats rows={counts.shape[0] ?? 0} columns={counts.shape[1] ?? 0} counts={counts.values} expected={expected.values} />}
    </div>
  );
}

function chance(p: number): string {
  if (p < 1e-300) return 'below 1e-300';
  return p < 1e-4 ? p.toExponential(1) : p.toFixed(4);
}

/** Checks as a table of words. */
export function Checks({ checks }: { checks: Check[] }) {
  return (
    <Table name="Checks" words={['Check', 'Verdict', 'Figures']} numbers={['p']}>
      {checks.map((check) => (
        <tr key={check.name} data-check={check.name} data-holds={check.holds}>
          <th scope="row">{check.name}</th>
          <td class={`verdict ${check.holds ? 'good' : 'bad'}`}>{check.holds ? 'holds' : 'does not hold'}</td>
          <td>{check.text}</td>
          <td class="number chance">{check.p === undefined ? '' : chance(check.p)}</td>
        </tr>
      ))}
    </Table>
  );
}
