/** Renders that take samples in turn, for the same time or to the same number of samples. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { ask } from '../../core/ask';
import type { Camera, MaterialEdit, RenderAdvanceValue, RenderOpenValue } from '../../core/protocol';

/** What is rendered. */
export interface Setup {
  scene: string;
  size: [number, number];
  energy: string;
  camera: Camera | undefined;
  edits: MaterialEdit[];
  seed: number;
}

export interface Turn {
  opened: RenderOpenValue | undefined;
  state: RenderAdvanceValue | undefined;
  colour: Float32Array | undefined;
  error: string | undefined;
}

const EMPTY: Turn = { opened: undefined, state: undefined, colour: undefined, error: undefined };
/** Seconds of a turn. */
const SLICE = 0.15;

/** Milliseconds between looks at a render that rests. */
const REST = 100;
/** Milliseconds after which a render that rests is asked for: the program closes those that nobody asks for in a minute. */
const KEEP = 20_000;

/** Lets the program know that a render is still wanted. */
async function keep(session: number): Promise<void> {
  await ask<'render.pick'>({ ask: 'render.pick', session, x: 0, y: 0 }).catch(() => undefined);
}

/** Renders of these setups; they stop while the page is hidden, and are closed when it goes away. */
export function useRenders(setups: Setup[], mode: string, isPlaying: boolean, target: number): Turn[] {
  const [turns, setTurns] = useState<Turn[]>(setups.map(() => EMPTY));
  const playing = useRef(isPlaying);
  playing.current = isPlaying;
  const goal = useRef(target);
  goal.current = target;
  const key = JSON.stringify([setups, mode]);
  useEffect(() => {
    let isGone = false;
    const now = setups.map(() => ({ ...EMPTY }));
    const publish = () => {
      if (!isGone) setTurns(now.map((turn) => ({ ...turn })));
    };
    const close = () => {
      for (const turn of now) if (turn.opened !== undefined) void ask<'render.close'>({ ask: 'render.close', session: turn.opened.session }, undefined, true).catch(() => undefined);
    };
    let rested = 0;
    const run = async () => {
      for (const [i, setup] of setups.entries()) {
        const turn = now[i] as Turn;
        try {
          const { scene, size, energy, camera, edits, seed } = setup;
          const given = { ...(energy === '' ? {} : { energy }), ...(camera === undefined ? {} : { camera }), edits, seed };
          turn.opened = (await ask<'render.open'>({ ask: 'render.open', scene, width: size[0], height: size[1], ...given })).value;
        } catch (error) {
          turn.error = (error as Error).message;
        }
        if (isGone) return close();
        publish();
      }
      while (!isGone) {
        const able = now.filter((turn) => turn.opened !== undefined && turn.error === undefined);
        const open = able.filter((turn) => (turn.state?.samples ?? 0) < goal.current);
        // By equal time, none goes on without the others.
        const isDone = mode === 'time' ? open.length < able.length : open.length === 0;
        if (!playing.current || document.hidden || isDone || open.length === 0) {
          await new Promise((resolve) => setTimeout(resolve, REST));
          rested += REST;
          if (rested >= KEEP) {
            rested = 0;
            for (const turn of able) await keep(turn.opened?.session ?? 0);
          }
          continue;
        }
        rested = 0;
        const least = Math.min(...open.map((turn) => turn.state?.samples ?? 0));
        for (const turn of open) {
          const session = turn.opened?.session ?? 0;
          const amount = mode === 'samples' ? { samples: Math.max(1, Math.min(least, 8)) } : { seconds: SLICE };
          if (mode === 'samples' && (turn.state?.samples ?? 0) > least) continue;
          try {
            const { value, arrays } = await ask<'render.advance'>({ ask: 'render.advance', session, ...amount, wants: ['colour'] });
            turn.state = value;
            turn.colour = arrays.colour?.values;
          } catch (error) {
            turn.error = (error as Error).message;
          }
          if (isGone) return close();
        }
        publish();
      }
      // Whoever ended this loop from outside has not closed them.
      close();
    };
    const leave = () => {
      isGone = true;
      close();
    };
    addEventListener('pagehide', leave);
    // Sliders that move open nothing: the last place counts.
    const timer = setTimeout(() => void run(), 200);
    return () => {
      isGone = true;
      clearTimeout(timer);
      removeEventListener('pagehide', leave);
    };
  }, [key]);
  return turns;
}
