/** What the program's laboratory does: asked for every second while it runs. */

import { useEffect, useState } from 'preact/hooks';
import { get, hasServer } from '../../core/server';

export interface Experiment {
  id: string;
  title: string;
  /** Which table or figure. */
  item: string;
  /** The source, as it is cited. */
  paper: string;
  statement: string;
}

export interface Result {
  id: string;
  title: string;
  seconds: number;
  /** What the experiment says of itself. */
  summary: string;
  /** What the source states, what was measured, and whether that holds; `null` where figures are too uncertain. */
  claims: { text: string; stated: string; measured: string; holds: boolean | null }[];
}

export interface Status {
  state: string;
  share?: number;
  what?: string;
  results?: Result[];
  /** Why the run ended early. */
  error?: string | null;
  /** Whether there is a report. */
  report?: boolean;
}

/** The experiments; `undefined` until they are known. */
export function useExperiments(): { experiments: Experiment[] | undefined; error: string | undefined } {
  const [experiments, setExperiments] = useState<Experiment[]>();
  const [error, setError] = useState<string>();
  useEffect(() => {
    if (!hasServer) return;
    get<{ experiments: Experiment[] }>('/api/lab').then(
      (found) => setExperiments(found.experiments),
      (reason: Error) => setError(reason.message),
    );
  }, []);
  return { experiments, error };
}

/** The laboratory's state; `refresh` asks at once. */
export function useStatus(): { status: Status | undefined; refresh: () => Promise<void> } {
  const [status, setStatus] = useState<Status>();
  const refresh = async () => {
    try {
      setStatus(await get<Status>('/api/lab/status'));
    } catch {
      // The program is asked again.
    }
  };
  const isRunning = status?.state === 'running';
  useEffect(() => {
    if (!hasServer) return;
    void refresh();
    const timer = setInterval(() => void refresh(), isRunning ? 500 : 5000);
    return () => clearInterval(timer);
  }, [isRunning]);
  return { status, refresh };
}
