/** The state of a page in its address, so that a link reopens it: `#/samplers?alpha=0.3,0.1&sampler=cap`. */

import { useCallback, useEffect, useMemo, useState } from 'preact/hooks';

/** What is kept of a page: by key, a number, a word, a flag, or numbers. */
export type State = Record<string, string | number | boolean | number[]>;

function split(): [string, URLSearchParams] {
  const [path = '', query = ''] = location.hash.replace(/^#\/?/, '').split('?', 2);
  return [path, new URLSearchParams(query)];
}

/** The page that the address names. */
export function pageOfAddress(): string {
  return split()[0];
}

/** A link to a page, with state that differs from its defaults. */
export function link(page: string, state: State = {}): string {
  const query = Object.entries(state).map(([key, value]) => `${key}=${encode(value)}`);
  return `#/${page}${query.length > 0 ? `?${query.join('&')}` : ''}`;
}

function encode(value: State[string]): string {
  const text = Array.isArray(value) ? value.map((x) => short(x)).join(',') : typeof value === 'number' ? short(value) : String(value);
  return encodeURIComponent(text).replace(/%2C/g, ',').replace(/%20/g, '+');
}

const short = (x: number) => String(Number(x.toPrecision(6)));

function read<S extends State>(defaults: S): S {
  const [, query] = split();
  const state: State = { ...defaults };
  for (const [key, fallback] of Object.entries(defaults)) {
    const text = query.get(key);
    if (text === null) continue;
    if (typeof fallback === 'string') state[key] = text;
    else if (typeof fallback === 'boolean') state[key] = text === 'true';
    else {
      const numbers = text.split(',').map(Number);
      const isNumbers = numbers.every(Number.isFinite);
      if (Array.isArray(fallback)) state[key] = isNumbers ? numbers : fallback;
      else state[key] = isNumbers && numbers.length === 1 ? (numbers[0] as number) : fallback;
    }
  }
  return state as S;
}

/**
 * Changes of the address at once, and milliseconds in which one more is allowed: browsers refuse a page that changes it a
 * hundred times in ten seconds.
 */
const AT_ONCE = 12;
const PAUSE = 120;

/** Events that end a change, or come before the address is copied or the page is left. */
const ENDS = ['pointerup', 'keyup', 'blur', 'pagehide'];

/** Keeps the address up to date: at once; after pauses where changes are many, as in a drag. */
class Writer {
  private wanted: string | undefined;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** Changes that are allowed, as of `time`; below 0 after ends that did not wait. */
  private allowed = AT_ONCE;
  private time = performance.now();

  constructor(private readonly page: string) {}

  write(address: string): void {
    this.wanted = address;
    if (this.timer !== undefined) return;
    const now = performance.now();
    this.allowed = Math.min(AT_ONCE, this.allowed + (now - this.time) / PAUSE);
    this.time = now;
    if (this.allowed >= 1) return this.flush();
    this.timer = setTimeout(() => {
      this.timer = undefined;
      if (this.wanted !== undefined) this.write(this.wanted);
    }, Math.ceil((1 - this.allowed) * PAUSE));
  }

  /** Writes what waits; nothing where another page is there already. */
  flush = (): void => {
    if (this.wanted !== undefined && pageOfAddress() === this.page) {
      history.replaceState(null, '', this.wanted);
      this.allowed -= 1;
    }
    this.wanted = undefined;
  };

  /** Forgets what waits: the address was changed by someone else. */
  drop(): void {
    this.wanted = undefined;
  }
}

/** The state of a page, kept in the address; `set` merges. Use it once in a page, at its root. */
export function useAddress<S extends State>(page: string, defaults: S): [S, (change: Partial<S>) => void] {
  const [state, setState] = useState<S>(() => read(defaults));
  const writer = useMemo(() => new Writer(page), [page]);
  useEffect(() => {
    const changed = () => {
      writer.drop();
      if (pageOfAddress() === page) setState(read(defaults));
    };
    addEventListener('hashchange', changed);
    for (const end of ENDS) addEventListener(end, writer.flush);
    return () => {
      removeEventListener('hashchange', changed);
      for (const end of ENDS) removeEventListener(end, writer.flush);
      writer.drop();
    };
  }, [page]);
  const set = useCallback(
    (change: Partial<S>) =>
      setState((before) => {
        const now = { ...before, ...change };
        const kept = Object.entries(now).filter(([key, value]) => String(value) !== String(defaults[key]));
        writer.write(link(page, Object.fromEntries(kept)));
        return now;
      }),
    [page],
  );
  return [state, set];
}
