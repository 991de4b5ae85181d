/** Lobes of the page as the library reads them, and answers for each of them. */

import { useEffect, useMemo, useState } from 'preact/hooks';
import { ask } from '../../core/ask';
import type { LobeKind, LobesKindsValue, LobesParseValue, Protocol } from '../../core/protocol';
import { useAnswer, type Asked } from '../../core/use_answer';
import { type LobesState, SLOTS, type Slot } from './state';
import { type LobeForm, readText } from './text';

/** A lobe that is drawn. */
export interface Layer {
  slot: Slot;
  /** A, B, C or D. */
  letter: string;
  /** The text that is drawn: the last one that the library understood. */
  lobe: string;
  form: LobeForm | undefined;
  parsed: LobesParseValue | undefined;
}

interface Parsed {
  text: string;
  value?: LobesParseValue;
  error?: string;
}

/** The library's reading of a text; `normalise` is called where the text is not in its normal form. */
function useParsed(text: string, normalise: (text: string) => void): { last: LobesParseValue | undefined; error: string | undefined } {
  const [parsed, setParsed] = useState<Parsed>({ text: '' });
  const [last, setLast] = useState<LobesParseValue>();
  useEffect(() => {
    if (text === '') {
      setLast(undefined);
      return;
    }
    const abort = new AbortController();
    ask({ ask: 'lobes.parse', lobe: text }, abort.signal).then(
      ({ value }) => {
        if (abort.signal.aborted) return;
        setParsed({ text, value });
        setLast(value);
        if (value.lobe !== text) normalise(value.lobe);
      },
      (error: Error) => {
        if (!abort.signal.aborted) setParsed({ text, error: error.message });
      },
    );
    return () => abort.abort();
  }, [text]);
  return { last, error: parsed.text === text ? parsed.error : undefined };
}

/** The kinds of lobes. */
export function useKinds(): { found: LobesKindsValue | undefined; error: string | undefined } {
  const { answer, error } = useAnswer<'lobes.kinds'>({ ask: 'lobes.kinds' });
  return { found: answer?.value, error };
}

/** The lobes of the page, and what is wrong with their texts. */
export function useLayers(state: LobesState, set: (change: Partial<LobesState>) => void, kinds: LobeKind[]): { layers: Layer[]; errors: Record<Slot, string | undefined> } {
  const readings = SLOTS.map((slot) => useParsed(state[slot], (text) => set({ [slot]: text })));
  const errors = Object.fromEntries(SLOTS.map((slot, i) => [slot, readings[i]?.error])) as Record<Slot, string | undefined>;
  const layers = SLOTS.flatMap((slot, i): Layer[] => {
    const text = state[slot];
    if (text === '') return [];
    const [parsed, isWrong] = [readings[i]?.last, errors[slot] !== undefined];
    const own = isWrong ? undefined : readText(text, kinds);
    const lobe = own !== undefined ? text : parsed?.lobe;
    if (lobe === undefined) return [];
    return [{ slot, letter: slot.toUpperCase(), lobe, form: own ?? readText(lobe, kinds), parsed }];
  });
  const key = JSON.stringify([layers.map((layer) => [layer.slot, layer.lobe, layer.parsed, layer.form?.kind.name])]);
  return { layers: useMemo(() => layers, [key]), errors };
}

/** An answer for every lobe, by slot. */
export function useEach<K extends keyof Protocol>(layers: Layer[], request: (layer: Layer) => (Protocol[K][0] & { ask: K }) | undefined): Record<Slot, Asked<K>> {
  const asked = SLOTS.map((slot) => {
    const layer = layers.find((l) => l.slot === slot);
    const found = useAnswer<K>(layer === undefined ? undefined : request(layer));
    return [slot, found] as const;
  });
  return Object.fromEntries(asked) as Record<Slot, Asked<K>>;
}
