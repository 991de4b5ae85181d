/** Figures of renders: samples, time, noise, errors; and their way over time. */

import { useEffect, useState } from 'preact/hooks';
import { ask } from '../../core/ask';
import type { RenderCompareValue } from '../../core/protocol';
import { Choice, Panel } from '../../ui/controls';
import { format, Plot, seriesColour } from '../../ui/plot';
import { Table } from '../../ui/table';
import { LETTERS } from './layers';
import type { Turn } from './render';
import type { History } from './use_errors';

/** Milliseconds between comparisons by the library: FLIP takes time, which the renders should have. */
const PAUSE = 2000;

/** A against B by the library, now and then. */
function useCompared(a: Turn | undefined, b: Turn | undefined): RenderCompareValue | undefined {
  const [compared, setCompared] = useState<RenderCompareValue>();
  const [last, setLast] = useState({ time: 0, key: '' });
  const isAble = [a, b].every((turn) => turn?.opened !== undefined && turn.state !== undefined && !turn.by.isGpu);
  const key = isAble ? `${a?.opened?.session}:${a?.state?.samples} ${b?.opened?.session}:${b?.state?.samples}` : '';
  useEffect(() => {
    if (!isAble) {
      setCompared(undefined);
      return;
    }
    const timer = setTimeout(
      () => {
        setLast({ time: performance.now(), key });
        ask<'render.compare'>({ ask: 'render.compare', session: a?.opened?.session ?? 0, reference: b?.opened?.session ?? 0 }).then(
          ({ value }) => setCompared(value),
          () => setCompared(undefined),
        );
      },
      Math.max(0, last.time + PAUSE - performance.now()),
    );
    return () => clearTimeout(timer);
  }, [key]);
  return compared;
}

export function Figures({ turns, reference, history }: { turns: Turn[]; reference: Turn | undefined; history: History }) {
  const compared = useCompared(turns[0], reference ?? turns[1]);
  const hasReference = reference !== undefined;
  const columns = ['Samples', 'Seconds', 'Million samples a second', 'Noise', 'Mean', ...(hasReference ? ['RMSE', 'relMSE'] : [])];
  const rows: [string, Turn][] = turns.map((turn, i) => [LETTERS[i] as string, turn]);
  if (reference !== undefined) rows.push(['Reference', reference]);
  return (
    <Panel title="Figures" wide>
      <Table name="Figures of the renders" words={['Render']} numbers={columns} isFirstHidden>
        {rows.map(([name, { state, opened }], i) =>
          state === undefined || opened === undefined ? null : (
            <tr key={name} data-render={i < turns.length ? i : 'reference'}>
              <th scope="row">{name}</th>
              <td class="number">{state.samples}</td>
              <td class="number">{state.seconds.toFixed(2)}</td>
              <td class="number">{((state.samples * opened.width * opened.height) / 1e6 / Math.max(state.seconds, 1e-3)).toFixed(2)}</td>
              <td class="number">{(100 * state.noise).toFixed(2)} %</td>
              <td class="number">{state.mean.map((m) => m.toFixed(4)).join(' ')}</td>
              {hasReference && <td class="number">{i < turns.length && history.now[i] !== undefined ? format(history.now[i].rmse) : ''}</td>}
              {hasReference && <td class="number">{i < turns.length && history.now[i] !== undefined ? format(history.now[i].relMse) : ''}</td>}
            </tr>
          ),
        )}
      </Table>
      {compared !== undefined && (
        <p>
          A against {hasReference ? 'the reference' : 'B'}: RMSE {format(compared.rmse)}, relMSE {format(compared.relMse)}, of 8 x 8 blocks {format(compared.blockRmse)}, FLIP {format(compared.flip)}.
        </p>
      )}
    </Panel>
  );
}

/** RMSE against the reference over time or samples. */
export function NoiseOverTime({ history, over, onOver }: { history: History; over: string; onOver: (over: string) => void }) {
  const isTime = over === 'seconds';
  const ways = history.points.filter((way) => way.length > 0);
  const series = history.points.flatMap((way, i) => (way.length < 2 ? [] : [{ name: LETTERS[i] as string, colour: seriesColour(i), x: way.map((p) => (isTime ? p.seconds : p.samples)), y: way.map((p) => p.rmse) }]));
  const first = series[0];
  if (first !== undefined) {
    const [x0, y0] = [first.x[0] as number, first.y[0] as number];
    const x1 = Math.max(...series.flatMap((s) => Array.from(s.x)));
    series.push({ name: `1 / sqrt(${over})`, colour: 'var(--quiet)', x: [x0, x1], y: [y0, y0 * Math.sqrt(x0 / x1)], ...{ isDashed: true } });
  }
  return (
    <Panel title="Error against the reference" actions={<Choice label="Over" value={over} options={[{ value: 'seconds', label: 'Seconds' }, { value: 'samples', label: 'Samples' }]} onChange={onOver} />}>
      {series.length === 0 ? (
        <p class="quiet">{ways.length === 0 ? 'Waiting for eight samples of the reference.' : 'Waiting for samples.'}</p>
      ) : (
        <Plot title={`RMSE over ${over}`} x={isTime ? 'seconds of rendering' : 'samples per pixel'} y="RMSE" series={series} isLogarithmic isLogarithmicX />
      )}
      <p class="quiet">What the reference's own noise adds is subtracted: its variance, at most its part by the numbers of samples. A treatment with another mean than the reference stops at its difference.</p>
    </Panel>
  );
}
