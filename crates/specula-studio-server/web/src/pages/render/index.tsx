/** Progressive renders: one, or two side by side at equal time or equal samples. */

import { useEffect, useState } from 'preact/hooks';
import { useAddress } from '../../core/address';
import { ask } from '../../core/ask';
import { useSavePicture } from '../../core/keys';
import type { Camera, MaterialEdit, RenderCompareValue, SceneItem } from '../../core/protocol';
import { hasServer, post } from '../../core/server';
import { Choice, Message, Panel, Progress, Select, Slider, TextField } from '../../ui/controls';
import { save } from '../../ui/files';
import { format } from '../../ui/plot';
import type { Page } from '../page';
import { dolly, orbit, pan } from './camera';
import { Picture } from './canvas';
import { type Setup, type Turn, useRenders } from './session';

const DEFAULTS = {
  scene: '',
  width: 480,
  height: 270,
  energyA: '',
  energyB: 'none',
  isCompared: false,
  mode: 'time',
  divider: 0.5,
  exposure: 0,
  samples: 256,
  seed: 1,
  /** Eye, target, up, field of view. */
  camera: [] as number[],
  /** `number=text`, separated by semicolons. */
  edits: '',
};

function cameraOf(numbers: number[]): Camera | undefined {
  if (numbers.length !== 10) return undefined;
  const at = (i: number) => numbers.slice(i, i + 3) as [number, number, number];
  return { eye: at(0), target: at(3), up: at(6), fovDegrees: numbers[9] as number };
}

const numbersOf = (camera: Camera) => [...camera.eye, ...camera.target, ...camera.up, camera.fovDegrees];

function editsOf(text: string): MaterialEdit[] {
  const parts = text.split(';').map((part) => /^(\d+)=(.+)$/.exec(part.trim()));
  return parts.flatMap((found) => (found === null ? [] : [{ material: Number(found[1]), text: found[2] as string }]));
}

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
  const [problem, setProblem] = useState<string>();
  const { scenes, refresh, error } = useScenes();
  const scene = scenes.some((s) => s.name === state.scene) ? state.scene : ((scenes.find((s) => s.from === 'given') ?? scenes[0])?.name ?? '');
  const setup = (energy: string): Setup => ({
    scene,
    size: [state.width, state.height],
    energy,
    camera: cameraOf(state.camera),
    edits: editsOf(state.edits),
    seed: state.seed,
  });
  const setups = scene === '' ? [] : state.isCompared ? [setup(state.energyA), setup(state.energyB)] : [setup(state.energyA)];
  const turns = useRenders(setups, state.mode, isPlaying, state.samples);
  const first = turns[0]?.opened;
  const camera = cameraOf(state.camera) ?? first?.camera ?? undefined;
  const move = (now: Camera) => set({ camera: numbersOf(now) });
  const materials = first?.materials ?? [];
  const edit = (material: number, text: string) => {
    const others = editsOf(state.edits).filter((e) => e.material !== material);
    const all = text === '' ? others : [...others, { material, text }];
    set({ edits: all.map((e) => `${e.material}=${e.text}`).join(';') });
  };
  const pick = async (x: number, y: number) => {
    if (first === undefined) return;
    try {
      const { value } = await ask<'render.pick'>({ ask: 'render.pick', session: first.session, x, y });
      setPicked(value.hit?.material);
    } catch (reason) {
      setProblem((reason as Error).message);
    }
  };
  const open = async (path: string) => {
    if (path === '') return;
    try {
      const { name } = await post<{ name: string }>('/api/open', { path });
      setProblem(undefined);
      refresh();
      set({ scene: name, camera: [], edits: '' });
    } catch (reason) {
      setProblem((reason as Error).message);
    }
  };
  const done = Math.min(...turns.map((turn) => turn.state?.samples ?? 0), state.samples);
  const chosen = materials.find((m) => m.id === picked);
  const energies = [{ value: '', label: "the scene's own" }, ...(first?.energies ?? []).map((e) => ({ value: e, label: e }))];
  return (
    <div class="page">
      <aside aria-label="Controls">
        <h1>Render</h1>
        <Select label="Scene" value={scene} options={scenes.map((s) => ({ value: s.name, label: s.title }))} onChange={(name) => set({ scene: name, camera: [], edits: '' })} />
        {hasServer && <TextField label="Open a file" value="" hint="A path in the folder that the studio was started in" onEnter={(path) => void open(path)} />}
        <Message text={problem ?? error} />
        <div class="actions">
          <button type="button" class="main" onClick={() => setPlaying(!isPlaying)}>
            {isPlaying ? 'Pause' : 'Go on'}
          </button>
          <button type="button" onClick={() => set({ seed: state.seed + 1 })}>
            Begin anew
          </button>
          <button type="button" disabled={state.camera.length === 0} onClick={() => set({ camera: [] })}>
            The scene's view
          </button>
        </div>
        <Slider label="Samples per pixel" value={state.samples} min={1} max={4096} isLogarithmic isInteger onInput={(samples) => set({ samples })} />
        <Slider label="Exposure" unit="stops" value={state.exposure} min={-8} max={8} onInput={(exposure) => set({ exposure })} />
        <Select label="Energy of metals, A" value={state.energyA} options={energies} onChange={(energyA) => set({ energyA })} />
        <Choice
          label="Compare"
          value={state.isCompared ? state.mode : 'no'}
          options={[
            { value: 'no', label: 'A alone' },
            { value: 'time', label: 'Equal time' },
            { value: 'samples', label: 'Equal samples' },
          ]}
          onChange={(mode) => set(mode === 'no' ? { isCompared: false } : { isCompared: true, mode })}
        />
        {state.isCompared && (
          <>
            <Select label="Energy of metals, B" value={state.energyB} options={energies} onChange={(energyB) => set({ energyB })} />
            <Slider label="Divider" value={state.divider} min={0} max={1} onInput={(divider) => set({ divider })} />
          </>
        )}
        <h3>Materials</h3>
        <p class="quiet">Click a surface in the picture to choose its material.</p>
        <Select
          label="Material"
          value={String(picked ?? '')}
          options={[{ value: '', label: 'none' }, ...materials.map((m) => ({ value: String(m.id), label: `${m.name} (${m.kind})` }))]}
          onChange={(id) => setPicked(id === '' ? undefined : Number(id))}
        />
        {chosen !== undefined && (
          <TextField
            label="As text"
            hint="conductor Au alpha 0.3; empty: the scene's own"
            value={editsOf(state.edits).find((e) => e.material === chosen.id)?.text ?? chosen.text ?? ''}
            onEnter={(text) => edit(chosen.id, text)}
          />
        )}
      </aside>
      <div class="content">
        <Panel title={state.isCompared ? 'A left, B right' : 'Picture'} wide actions={first === undefined ? undefined : <Saves session={first.session} failed={setProblem} />}>
          {turns.map((turn, i) => (turn.error === undefined ? null : <Message key={i} text={turn.error} />))}
          <div class="layers">
            {turns.map((turn, i) => (
              <Picture
                key={i}
                label={i === 0 ? 'Render A' : 'Render B'}
                width={turn.opened?.width ?? state.width}
                height={turn.opened?.height ?? state.height}
                colour={turn.colour}
                exposure={state.exposure}
                from={i === 0 ? 0 : state.divider}
                onTurn={(dx, dy, isPan) => {
                  if (camera !== undefined) move(isPan ? pan(camera, -dx / 600, dy / 600) : orbit(camera, dx / 250, dy / 250));
                }}
                onZoom={(steps) => {
                  if (camera !== undefined) move(dolly(camera, 1.1 ** steps));
                }}
                onPick={(x, y) => void pick(x, y)}
              />
            ))}
          </div>
          <Progress label={`${done} of ${state.samples} samples per pixel`} share={done / state.samples} />
        </Panel>
        <Figures turns={turns} />
      </div>
    </div>
  );
}

function Saves({ session, failed }: { session: number; failed: (problem: string) => void }) {
  const get = async (kind: 'exr' | 'png') => {
    try {
      const { value, arrays } = await ask<'render.save'>({ ask: 'render.save', session, format: kind });
      save(value.name, arrays.file.values as BlobPart, kind === 'png' ? 'image/png' : 'image/x-exr');
    } catch (reason) {
      failed((reason as Error).message);
    }
  };
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

function Figures({ turns }: { turns: Turn[] }) {
  const [compared, setCompared] = useState<RenderCompareValue>();
  const [a, b] = turns;
  useEffect(() => {
    if (a?.opened === undefined || b?.opened === undefined || a.state === undefined || b.state === undefined) {
      setCompared(undefined);
      return;
    }
    ask<'render.compare'>({ ask: 'render.compare', session: a.opened.session, reference: b.opened.session }).then(
      ({ value }) => setCompared(value),
      () => setCompared(undefined),
    );
  }, [a?.state?.samples, b?.state?.samples]);
  return (
    <Panel title="Figures" wide>
      <div class="scroll">
        <table>
          <thead>
            <tr>
              {['', 'Samples', 'Seconds', 'Million samples a second', 'Noise', 'Mean'].map((name) => (
                <th key={name} scope="col" class={name === '' ? '' : 'number'}>
                  {name === '' ? <span class="hidden-visually">Render</span> : name}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {turns.map(({ state, opened }, i) =>
              state === undefined || opened === undefined ? null : (
                <tr key={i} data-render={i}>
                  <th scope="row">{'AB'[i]}</th>
                  <td class="number">{state.samples}</td>
                  <td class="number">{state.seconds.toFixed(2)}</td>
                  <td class="number">{((state.samples * opened.width * opened.height) / 1e6 / Math.max(state.seconds, 1e-3)).toFixed(2)}</td>
                  <td class="number">{(100 * state.noise).toFixed(2)} %</td>
                  <td class="number">{state.mean.map((m) => m.toFixed(4)).join(' ')}</td>
                </tr>
              ),
            )}
          </tbody>
        </table>
      </div>
      {compared !== undefined && (
        <p>
          A against B: RMSE {format(compared.rmse)}, relMSE {format(compared.relMse)}, of 8 x 8 blocks {format(compared.blockRmse)}, FLIP {format(compared.flip)}.
        </p>
      )}
    </Panel>
  );
}

export const page: Page = {
  id: 'render',
  title: 'Render',
  summary: 'A scene, progressive; two renders side by side at equal time.',
  component: Render,
};
