/** The laboratory: the papers' tables and figures, run from here. */

import { useState } from 'preact/hooks';
import { useAddress } from '../../core/address';
import { hasServer, post } from '../../core/server';
import { Choice, Message, Panel, Progress } from '../../ui/controls';
import { Table } from '../../ui/table';
import type { Page } from '../page';
import { type Experiment, type Result, type Status, useExperiments, useStatus } from './status';

/** Where the server has the report. */
const REPORT = '/lab/report/';

function Laboratory() {
  const [state, set] = useAddress('laboratory', { quality: 'draft', chosen: '' });
  const { experiments, error } = useExperiments();
  const { status, refresh } = useStatus();
  const [problem, setProblem] = useState<string>();
  const chosen = new Set(state.chosen.split(' ').filter((id) => id !== ''));
  const choose = (id: string, isChosen: boolean) => {
    if (isChosen) chosen.add(id);
    else chosen.delete(id);
    set({ chosen: [...chosen].join(' ') });
  };
  const act = async (path: string, body: unknown) => {
    try {
      await post(path, body);
      setProblem(undefined);
    } catch (reason) {
      setProblem((reason as Error).message);
    }
    await refresh();
  };
  if (!hasServer) {
    return (
      <div class="content start">
        <h1>Laboratory</h1>
        <p class="notice">Experiments run in the program: start <code>specula studio</code>.</p>
      </div>
    );
  }
  const isRunning = status?.state === 'running';
  const papers = [...new Set((experiments ?? []).map((e) => e.paper))];
  return (
    <div class="page">
      <aside aria-label="Experiments">
        <h1>Laboratory</h1>
        <p class="quiet">Each experiment measures one table or figure, and computes which of its source's claims hold.</p>
        <Choice
          label="Quality"
          value={state.quality}
          options={[
            { value: 'draft', label: 'Draft', hint: 'Seconds each' },
            { value: 'paper', label: 'Paper', hint: 'As the papers have it: minutes each' },
          ]}
          onChange={(quality) => set({ quality })}
        />
        <div class="actions">
          <button
            type="button"
            class="main"
            disabled={isRunning || chosen.size === 0}
            onClick={() => act('/api/lab/run', { ids: [...chosen], quality: state.quality, seed: 1 })}
          >
            Run {chosen.size === 0 ? '' : chosen.size}
          </button>
          <button type="button" disabled={!isRunning} onClick={() => act('/api/lab/stop', {})}>
            Stop
          </button>
        </div>
        <Message text={problem ?? error} />
        {papers.map((paper) => (
          <Group key={paper} name={paper} experiments={(experiments ?? []).filter((e) => e.paper === paper)} chosen={chosen} choose={choose} />
        ))}
      </aside>
      <div class="content">
        <Running status={status} />
        <Results results={status?.results ?? []} />
        {status?.report === true && (
          <Panel title="Report" wide actions={<a href={REPORT} target="_blank" rel="noopener">Open alone</a>}>
            <iframe key={status.results?.length} class="report" title="Report" src={REPORT} />
          </Panel>
        )}
      </div>
    </div>
  );
}

function Group(props: { name: string; experiments: Experiment[]; chosen: Set<string>; choose: (id: string, isChosen: boolean) => void }) {
  if (props.experiments.length === 0) return null;
  return (
    <fieldset class="choice">
      <legend>
        <h3>{props.name}</h3>
      </legend>
      {props.experiments.map((experiment) => (
        <label key={experiment.id} class="experiment" title={experiment.statement}>
          <input
            type="checkbox"
            checked={props.chosen.has(experiment.id)}
            onChange={(event) => props.choose(experiment.id, event.currentTarget.checked)}
          />
          <span>
            {experiment.item}: {experiment.title}
          </span>
        </label>
      ))}
    </fieldset>
  );
}

function Running(props: { status: Status | undefined }) {
  const { status } = props;
  return (
    <Panel title="Now" wide>
      {status?.state !== 'running' ? <p class="quiet">Nothing runs. Choose experiments, and press Run.</p> : <Progress label={status.what ?? ''} share={status.share} />}
      <Message text={props.status?.error ?? undefined} />
    </Panel>
  );
}

function Results(props: { results: Result[] }) {
  if (props.results.length === 0) return null;
  const word = (holds: boolean | null) => (holds === null ? 'open' : holds ? 'holds' : 'does not hold');
  const colour = (holds: boolean | null) => (holds === null ? 'quiet' : holds ? 'good' : 'bad');
  return (
    <Panel title="Claims" wide>
      <Table name="Experiments" words={['Experiment', 'Claim', 'Stated', 'Measured', 'Verdict']} numbers={['Seconds']}>
        {props.results.flatMap((result) =>
          result.claims.map((claim, i) => (
            <tr key={`${result.id}-${i}`}>
              <td>{i === 0 ? result.id : ''}</td>
              <td>{claim.text}</td>
              <td>{claim.stated}</td>
              <td>{claim.measured}</td>
              <td class={colour(claim.holds)}>{word(claim.holds)}</td>
              <td class="number">{i === 0 ? result.seconds.toFixed(1) : ''}</td>
            </tr>
          )),
        )}
      </Table>
    </Panel>
  );
}

export const page: Page = {
  id: 'laboratory',
  title: 'Laboratory',
  summary: 'Tables and figures of the papers, run from here.',
  component: Laboratory,
};
