/** The proof of a text, kept up to date: the newest text and view win, the last verdict stays until the next. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { type Compiled, compile, type Fault, prove, type Question } from './prover';
import { type Verdict, verdictOf } from './verdict';

export interface Proof {
  verdict: Verdict | undefined;
  faults: Fault[];
  /** What hinders the proof itself. */
  error: string | undefined;
  /** The newest text and view have no verdict yet. */
  isPending: boolean;
  /** Milliseconds of the last compilation and of the last run. */
  compileTime: number;
  runTime: number;
}

/** Milliseconds without a change before a text is compiled. */
const PAUSE = 350;

const START: Proof & { of: string } = { of: '', verdict: undefined, faults: [], error: undefined, isPending: false, compileTime: 0, runTime: 0 };

/** `isTyped`: the text changes by letters, so that a pause is waited for. */
export function useProof(text: string, isTyped: boolean, question: Question): Proof {
  const key = JSON.stringify([text, question]);
  const [proof, setProof] = useState(START);
  const wanted = useRef({ text, question, key });
  wanted.current = { text, question, key };
  const compiled = useRef<Compiled | undefined>(undefined);
  const isBusy = useRef(false);
  const isGone = useRef(false);
  const lastText = useRef<string | undefined>(undefined);
  useEffect(() => {
    isGone.current = false;
    return () => {
      isGone.current = true;
    };
  }, []);
  useEffect(() => {
    const change = (now: Partial<typeof START>) => {
      if (!isGone.current) setProof((before) => ({ ...before, ...now }));
    };
    const run = async () => {
      if (isBusy.current) return;
      isBusy.current = true;
      let done: string | undefined;
      while (!isGone.current && done !== wanted.current.key) {
        const now = wanted.current;
        done = now.key;
        try {
          if (compiled.current === undefined || compiled.current.text !== now.text || compiled.current.on.lost !== undefined) {
            const begun = performance.now();
            const made = await compile(now.text);
            if (Array.isArray(made)) {
              compiled.current = undefined;
              change({ of: done, faults: made, verdict: undefined, error: undefined });
              continue;
            }
            compiled.current = made;
            change({ faults: [], compileTime: performance.now() - begun });
          }
          const begun = performance.now();
          const verdict = verdictOf(await prove(compiled.current, now.question));
          change({ of: done, verdict, faults: [], error: undefined, runTime: performance.now() - begun });
        } catch (error) {
          compiled.current = undefined;
          change({ of: done, error: error instanceof Error ? error.message : String(error), verdict: undefined });
        }
      }
      isBusy.current = false;
    };
    const isNewText = lastText.current !== undefined && lastText.current !== text;
    lastText.current = text;
    const timer = setTimeout(() => void run(), isNewText && isTyped ? PAUSE : 30);
    return () => clearTimeout(timer);
  }, [key]);
  return { ...proof, isPending: proof.of !== key };
}
