/** Renders that take samples in turn, for the same time or to the same number of samples, and a reference that grows. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { EMPTY, Render, type Setup, type Turn } from './render';

export interface Plan {
  setups: Setup[];
  /** Rendered beside them, with other random numbers. */
  reference: Setup | undefined;
  /** `time` or `samples`: what is equal. */
  mode: string;
  isPlaying: boolean;
  /** Samples per pixel at which a render ends. */
  target: number;
}

/** Seconds of a turn, and of the first ones after a change: the page answers quickly while something is dragged. */
const SLICE = 0.15;
const FIRST_SLICE = 0.03;
/** Most samples per pixel of a turn. */
const MOST_SAMPLES = 64;
/** The reference goes on to so many times the samples of the others. */
export const REFERENCE_TIMES = 16;
/** Milliseconds between looks at renders that rest. */
const REST = 40;
/** Milliseconds after which a render that rests is asked for. */
const KEEP = 20_000;

/** Whose turn it is; none: all have what they should. */
function next(renders: Render[], { mode, target }: Plan, slice: number): Render[] {
  const able = renders.filter((render) => render.isAble);
  const open = able.filter((render) => render.samples < target);
  if (mode === 'samples') {
    const least = Math.min(...open.map((render) => render.samples));
    return open.filter((render) => render.samples === least);
  }
  const seconds = able.map((render) => render.seconds);
  // By equal time, none goes on without the others.
  if (open.length < able.length) return open.filter((render) => render.seconds < Math.max(...seconds) - slice);
  return open.filter((render) => render.seconds <= Math.min(...seconds) + slice / 2);
}

/** Samples of a turn, the same for all: as many as the slowest takes in a slice. */
function samplesOf(renders: Render[], target: number): number {
  const done = renders[0]?.samples ?? 0;
  const slowest = Math.max(...renders.map((render) => render.seconds / Math.max(1, render.samples)));
  const fitting = done === 0 ? 1 : Math.floor(SLICE / Math.max(slowest, 1e-6));
  return Math.max(1, Math.min(fitting, done, MOST_SAMPLES, target - done));
}

class Loop {
  private readonly renders: Render[] = [];
  private reference: Render | undefined;
  private isGone = false;
  private slice = FIRST_SLICE;
  private rested = 0;
  plan: Plan;

  constructor(plan: Plan, private readonly publish: (turns: Turn[], reference: Turn | undefined) => void) {
    this.plan = plan;
  }

  private tell = () => {
    if (!this.isGone) this.publish(this.renders.map((render) => render.turn), this.reference?.turn);
  };

  async run(): Promise<void> {
    while (!this.isGone) {
      if (await this.change()) continue;
      await this.round();
    }
  }

  /** Makes the renders those of the plan; whether it changed one. */
  private async change(): Promise<boolean> {
    const { setups, reference } = this.plan;
    let hasChanged = false;
    while (this.renders.length > setups.length) {
      this.renders.pop()?.close();
      hasChanged = true;
    }
    while (this.renders.length < setups.length) this.renders.push(new Render(this.tell));
    if (reference === undefined) {
      this.reference?.close();
      this.reference = undefined;
    } else this.reference ??= new Render(this.tell);
    const all: [Render, Setup][] = setups.map((setup, i) => [this.renders[i] as Render, setup]);
    if (this.reference !== undefined && reference !== undefined) all.push([this.reference, reference]);
    for (const [render, setup] of all) {
      if (render.isOf(setup)) continue;
      await render.become(setup);
      hasChanged = true;
      this.slice = FIRST_SLICE;
      if (this.isGone) return true;
    }
    if (hasChanged) this.tell();
    return hasChanged;
  }

  private async round(): Promise<void> {
    const { plan, reference } = this;
    const { mode, target } = plan;
    const turn = next(this.renders, plan, this.slice);
    const needsReference = reference !== undefined && reference.isAble && reference.samples < REFERENCE_TIMES * target;
    if (!plan.isPlaying || document.hidden || (turn.length === 0 && !needsReference)) return this.rest();
    this.rested = 0;
    const samples = samplesOf(turn, target);
    for (const render of turn) {
      await render.advance(mode === 'samples' ? { samples } : { seconds: this.slice, samples: target - render.samples });
      if (this.isGone || this.isStale()) return this.tell();
    }
    if (needsReference) await reference.advance({ seconds: this.slice * Math.max(1, turn.length), samples: REFERENCE_TIMES * target - reference.samples });
    this.slice = Math.min(SLICE, 1.5 * this.slice);
    this.tell();
  }

  private isStale(): boolean {
    return this.plan.setups.some((setup, i) => this.renders[i]?.isOf(setup) !== true);
  }

  private async rest(): Promise<void> {
    await new Promise((resolve) => setTimeout(resolve, REST));
    this.rested += REST;
    if (this.rested < KEEP) return;
    this.rested = 0;
    for (const render of [...this.renders, ...(this.reference === undefined ? [] : [this.reference])]) await render.keep();
  }

  end(): void {
    this.isGone = true;
    for (const render of this.renders) render.close();
    this.reference?.close();
  }
}

/** Renders of these setups; they stop while the page is hidden, and are closed when it goes away. */
export function useRenders(plan: Plan): { turns: Turn[]; reference: Turn | undefined } {
  const [shown, setShown] = useState<{ turns: Turn[]; reference: Turn | undefined }>({ turns: [], reference: undefined });
  const loop = useRef<Loop | undefined>(undefined);
  if (loop.current !== undefined) loop.current.plan = plan;
  useEffect(() => {
    const made = new Loop(plan, (turns, reference) => setShown({ turns, reference }));
    loop.current = made;
    const leave = () => made.end();
    addEventListener('pagehide', leave);
    void made.run();
    return () => {
      made.end();
      loop.current = undefined;
      removeEventListener('pagehide', leave);
    };
  }, []);
  return { turns: plan.setups.map((_, i) => shown.turns[i] ?? EMPTY), reference: plan.reference === undefined ? undefined : shown.reference };
}
