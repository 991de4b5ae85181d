/** Progressive renders: one, or up to four beside each other at equal time or equal samples. */

import { useEffect, useMemo, useState } from 'preact/hooks';
import { useAddress } from '../../core/address';
import { ask } from '../../core/ask';
import { useSavePicture } from '../../core/keys';
import type { Camera, SceneItem } from '../../core/protocol';
import { Message, Panel, Progress } from '../../ui/controls';
import { save, savePng } from '../../ui/files';
import type { Page } from '../page';
import { dolly, orbit, pan } from './camera';
import { MAP_DECADES } from './canvas';
import { Controls } from './controls';
import { errorMap, noiseMap } from './errors';
import { exr } from './exr';
import { Figures, NoiseOverTime } from './figures';
import { Inspector } from './inspector';
import { Layers } from './layers';
import type { Turn } from './render';
import { SceneText } from './scene_text';
import { useRenders } from './schedule';
import { cameraOf, countOf, DEFAULTS, dividersOf, LETTERS, numbersOf, referenceOf, setupOf } from './state';
import { useErrors } from './use_errors';

function useScenes(): { scenes: SceneItem[]; refresh: () => void; error: string | undefined } {
  const [scenes, setScenes] = useState<SceneItem[]>([]);
  const [error, setError] = useState<string>();
  const refresh = () => {
    ask<'render.scenes'>({ ask: 'render.scenes' }).then(
      ({ value }) => setScenes(value.scenes),
      (reason: Error) => setError(reason.message),
    );
  };
  useEffect(refresh, []);
  return { scenes, refresh, error };
}

function Render() {
  const [state, set] = useAddress('render', DEFAULTS);
  const [isPlaying, setPlaying] = useState(true);
  const [picked, setPicked] = useState<number>();
  const [hovered, setHovered] = useState<[number, number]>();
  const [over, setOver] = useState('seconds');
  const [problem, setProblem] = useState<string>();
  const { scenes, refresh, error } = useScenes();
  const scene = scenes.some((s) => s.name === state.scene) ? state.scene : ((scenes.find((s) => s.from === 'given') ?? scenes[0])?.name ?? '');
  const letters = LETTERS.slice(0, countOf(state));
  const setups = scene === '' ? [] : letters.map((letter) => setupOf(state, scene, letter));
  const referenceSetup = scene === '' ? undefined : referenceOf(state, scene);
  const { turns, reference } = useRenders({ setups, reference: referenceSetup, mode: state.mode, isPlaying, target: state.samples });
  const history = useErrors(turns, reference, JSON.stringify(referenceSetup));
  const first = turns[0]?.opened;
  const maps = useMaps(turns, reference, state.show);
  const camera = cameraOf(state.camera) ?? first?.camera ?? undefined;
  const move = (now: Camera) => set({ camera: numbersOf(now) });
  const show = (name: string) => {
    setProblem(undefined);
    refresh();
    set({ scene: name, camera: [], edits: '', editsA: '', editsB: '', editsC: '', editsD: '' });
  };
  const pick = async (x: number, y: number) => {
    set({ pixel: [x, y] });
    if (first === undefined) return;
    try {
      const { value } = await ask<'render.pick'>({ ask: 'render.pick', session: first.session, x, y });
      setPicked(value.hit?.material);
    } catch (reason) {
      setProblem((reason as Error).message);
    }
  };
  const done = Math.min(...turns.map((turn) => turn.state?.samples ?? 0), state.samples);
  const pixel: [number, number] = hovered ?? [state.pixel[0] ?? Math.floor((first?.width ?? state.width) / 2), state.pixel[1] ?? Math.floor((first?.height ?? state.height) / 2)];
  return (
    <div class="page">
      <Controls
        state={state}
        set={set}
        scenes={scenes}
        scene={scene}
        onScene={show}
        problem={problem ?? error}
        onProblem={setProblem}
        isPlaying={isPlaying}
        onPlaying={setPlaying}
        opened={first}
        hasReference={reference !== undefined}
        picked={picked}
        onPick={setPicked}
      />
      <div class="content">
        <Panel title={letters.length > 1 ? `Pictures: ${letters.join(', ')} from the left` : 'Picture'} wide actions={first === undefined ? undefined : <Saves turn={turns[0] as Turn} failed={setProblem} />}>
          {turns.map((turn, i) => (turn.error === undefined ? null : <Message key={i} text={turn.error} />))}
          <Layers
            turns={turns}
            maps={maps}
            size={[state.width, state.height]}
            exposure={state.exposure}
            tone={state.tone}
            dividers={dividersOf(state)}
            onDividers={(dividers) => set({ dividers })}
            onTurn={(dx, dy, isPan) => {
              if (camera !== undefined) move(isPan ? pan(camera, -dx / 600, dy / 600) : orbit(camera, dx / 250, dy / 250));
            }}
            onZoom={(steps) => {
              if (camera !== undefined) move(dolly(camera, 1.1 ** steps));
            }}
            onPick={(x, y) => void pick(x, y)}
            onHover={setHovered}
          />
          {state.show !== 'picture' && <Scale what={state.show === 'error' ? 'Relative error against the reference' : 'Relative standard deviation'} />}
          <Progress label={`${done} of ${state.samples} samples per pixel`} share={done / state.samples} />
          <Who turns={turns} />
        </Panel>
        <Figures turns={turns} reference={reference} history={history} />
        <Inspector turns={turns} reference={reference} pixel={pixel} isHovered={hovered !== undefined} onPixel={(now) => set({ pixel: now })} />
        {reference !== undefined && <NoiseOverTime history={history} over={over} onOver={setOver} />}
        {first !== undefined && <SceneText session={first.session} stamp={JSON.stringify(setups[0])} />}
      </div>
    </div>
  );
}

/** Maps of errors or noise, where they are shown. */
function useMaps(turns: Turn[], reference: Turn | undefined, show: string): (Float32Array | undefined)[] {
  const stamps = turns.flatMap(({ colour, variance }) => [colour, variance]);
  return useMemo(
    () =>
      turns.map(({ colour, variance }) => {
        if (colour === undefined) return undefined;
        if (show === 'noise' && variance !== undefined) return noiseMap(colour, variance);
        if (show === 'error' && reference?.colour?.length === colour.length) return errorMap(colour, reference.colour);
        return undefined;
      }),
    [show, reference?.colour, ...stamps, ...Array(8 - stamps.length).fill(undefined)],
  );
}

/** Colours of maps. */
function Scale({ what }: { what: string }) {
  return (
    <div class="map-scale">
      <div class="ramp" aria-hidden="true" />
      <div class="ticks quiet">
        {Array.from({ length: MAP_DECADES + 1 }, (_, i) => (
          <span key={i}>{100 * 10 ** (i - MAP_DECADES)} %</span>
        ))}
      </div>
      <p class="quiet">{what}, by pixel: root of the mean over channels of the square over (value squared + 0.01).</p>
    </div>
  );
}

/** Who takes the samples; how long a shader has been compiled. */
function Who({ turns }: { turns: Turn[] }) {
  const compiling = turns.find((turn) => turn.compiling !== undefined)?.compiling;
  const [now, setNow] = useState(0);
  useEffect(() => {
    if (compiling === undefined) return;
    const timer = setInterval(() => setNow(performance.now()), 250);
    return () => clearInterval(timer);
  }, [compiling]);
  const words = [...new Set(turns.map((turn) => turn.by.words))].filter((text) => text !== '');
  return (
    <>
      {compiling !== undefined && <Progress label={`Compiling ${compiling.what}: ${Math.max(0, Math.round((now - compiling.since) / 1000))} s`} />}
      <p class="quiet" data-by={turns.some((turn) => turn.by.isGpu) ? 'gpu' : 'processor'}>
        {words.map((text) => (text.endsWith('.') ? text : `${text}.`)).join(' ')}
      </p>
    </>
  );
}

function Saves({ turn, failed }: { turn: Turn; failed: (problem: string) => void }) {
  const { opened, colour, by } = turn;
  const fromLibrary = async (kind: 'exr' | 'png') => {
    const { value, arrays } = await ask<'render.save'>({ ask: 'render.save', session: opened?.session ?? 0, format: kind });
    save(value.name, arrays.file.values as BlobPart, kind === 'png' ? 'image/png' : 'image/x-exr');
  };
  const fromPage = async (kind: 'exr' | 'png') => {
    if (opened === undefined || colour === undefined) throw new Error('there is no picture yet');
    if (kind === 'exr') save('render.exr', exr(opened.width, opened.height, colour), 'image/x-exr');
    const canvas = document.querySelector<HTMLCanvasElement>('canvas.picture');
    if (kind === 'png' && canvas !== null) await savePng('render.png', canvas);
  };
  const get = (kind: 'exr' | 'png') => (by.isGpu ? fromPage(kind) : fromLibrary(kind)).catch((reason: Error) => failed(reason.message));
  useSavePicture(() => void get('png'));
  return (
    <>
      <button type="button" onClick={() => void get('exr')}>
        EXR
      </button>
      <button type="button" onClick={() => void get('png')}>
        PNG
      </button>
    </>
  );
}

export const page: Page = {
  id: 'render',
  title: 'Render',
  summary: 'A scene, progressive; up to four treatments beside each other, with errors against a growing reference.',
  component: Render,
};
