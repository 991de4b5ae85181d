/** Answers as state of a component: the latest request wins, the last answer stays until the next one is there. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { ask, type Answer, type Ask } from './ask';
import type { Protocol } from './protocol';

export interface Asked<K extends Ask> {
  /** The last answer; of an earlier request while `isPending`. */
  answer: Answer<K> | undefined;
  error: string | undefined;
  isPending: boolean;
}

/** Asks whenever the request changes (compared as JSON); `undefined`: asks nothing. One request is on its way at most. */
export function useAnswer<K extends Ask>(request: (Protocol[K][0] & { ask: K }) | undefined): Asked<K> {
  const [asked, setAsked] = useState<Asked<K>>({ answer: undefined, error: undefined, isPending: false });
  const text = request === undefined ? undefined : JSON.stringify(request);
  const wanted = useRef<string | undefined>(undefined);
  const isBusy = useRef(false);
  const isGone = useRef(false);
  wanted.current = text;
  useEffect(() => {
    isGone.current = false;
    return () => {
      isGone.current = true;
    };
  }, []);
  useEffect(() => {
    const run = async () => {
      if (isBusy.current) return;
      isBusy.current = true;
      let done: string | undefined;
      while (!isGone.current && wanted.current !== undefined && wanted.current !== done) {
        done = wanted.current;
        setAsked((before) => ({ ...before, isPending: true }));
        try {
          const answer = await ask<K>(JSON.parse(done));
          if (!isGone.current) setAsked({ answer, error: undefined, isPending: wanted.current !== done });
        } catch (error) {
          const words = error instanceof Error ? error.message : String(error);
          if (!isGone.current) setAsked((before) => ({ ...before, error: words, isPending: wanted.current !== done }));
        }
      }
      isBusy.current = false;
    };
    void run();
  }, [text]);
  return asked;
}
