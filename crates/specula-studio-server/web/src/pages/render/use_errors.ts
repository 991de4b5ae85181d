/** Errors of renders against the reference, now and as they went. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { type Errors, errorsOf } from './errors';
import type { Turn } from './render';

/** Where a render was. */
export interface Point {
  samples: number;
  seconds: number;
  rmse: number;
}

/** Samples of the reference from which on its own noise is known well enough. */
const LEAST_SAMPLES = 8;
/** A point is kept at so many times the samples of the last. */
const STEP = 1.12;

export interface History {
  /** Of each render, its way so far. */
  points: Point[][];
  /** Of each render, as it is. */
  now: (Errors | undefined)[];
}

/** `key`: what the reference is; the way begins anew with another. */
export function useErrors(turns: Turn[], reference: Turn | undefined, key: string): History {
  const [history, setHistory] = useState<History>({ points: [], now: [] });
  const kept = useRef<{ key: string; points: Point[][] }>({ key: '', points: [] });
  const stamps = [reference, ...turns].map((turn) => `${turn?.opened?.session}:${turn?.state?.samples}`).join();
  useEffect(() => {
    if (kept.current.key !== key) kept.current = { key, points: [] };
    const { points } = kept.current;
    points.length = Math.min(points.length, turns.length);
    const now = turns.map(({ state, colour }, i): Errors | undefined => {
      const way = (points[i] ??= []);
      if ((way.at(-1)?.samples ?? 0) > (state?.samples ?? 0)) way.length = 0;
      const against = reference?.colour;
      if (state === undefined || colour === undefined || against?.length !== colour.length) return undefined;
      // Of two renders whose noise falls alike, the part of the one with fewer samples.
      const samples = reference?.state?.samples ?? 0;
      const errors = errorsOf(colour, against, reference?.variance, samples / (samples + state.samples));
      const isNext = state.samples >= STEP * (way.at(-1)?.samples ?? 0);
      if (isNext && samples >= LEAST_SAMPLES && errors.rmseAlone > 0) way.push({ samples: state.samples, seconds: state.seconds, rmse: errors.rmseAlone });
      return errors;
    });
    setHistory({ points: points.map((way) => [...way]), now });
  }, [stamps, key]);
  return history;
}
