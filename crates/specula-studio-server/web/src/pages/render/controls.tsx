/** The controls of the page of renders: the scene, how it is shown, what is compared, its materials. */

import { useState } from 'preact/hooks';
import { backend } from '../../core/ask';
import type { RenderOpenValue, SceneItem } from '../../core/protocol';
import { hasServer, post } from '../../core/server';
import { Choice, Message, Select, Slider, TextField } from '../../ui/controls';
import { Drop } from './drop';
import { MaterialControls } from './material';
import { countOf, LETTERS, type Letter, type RenderState, type Set } from './state';
import { TONES, toneOf } from './tone';
import { Treatments } from './treatments';

export interface ControlsProps {
  state: RenderState;
  set: Set;
  scenes: SceneItem[];
  scene: string;
  onScene: (name: string) => void;
  problem: string | undefined;
  onProblem: (problem: string) => void;
  isPlaying: boolean;
  onPlaying: (isPlaying: boolean) => void;
  opened: RenderOpenValue | undefined;
  hasReference: boolean;
  /** The material that is chosen. */
  picked: number | undefined;
  onPick: (id: number | undefined) => void;
}

export function Controls(props: ControlsProps) {
  const { state, set, opened, isPlaying } = props;
  const [of, setOf] = useState<Letter | 'all'>('all');
  const isCompared = LETTERS.slice(0, countOf(state)).some((letter) => letter === of);
  const open = async (path: string) => {
    if (path === '') return;
    try {
      props.onScene((await post<{ name: string }>('/api/open', { path })).name);
    } catch (reason) {
      props.onProblem((reason as Error).message);
    }
  };
  return (
    <aside aria-label="Controls">
      <h1>Render</h1>
      <Select label="Scene" value={props.scene} options={props.scenes.map((s) => ({ value: s.name, label: s.title }))} onChange={props.onScene} />
      {hasServer && <TextField label="Open a file" value="" hint="A path in the folder that the studio was started in" onEnter={(path) => void open(path)} />}
      {hasServer ? <Drop onScene={props.onScene} /> : <p class="quiet">Files of your own need the program: specula studio.</p>}
      <Message text={props.problem} />
      <div class="actions">
        <button type="button" class="main" onClick={() => props.onPlaying(!isPlaying)}>
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
      <Looks state={state} set={set} hasReference={props.hasReference} />
      <Treatments state={state} set={set} energies={opened?.energies ?? []} />
      <MaterialControls state={state} set={set} materials={opened?.materials ?? []} picked={props.picked} onPick={props.onPick} of={isCompared ? of : 'all'} onOf={setOf} />
    </aside>
  );
}

/** How pictures are shown, and who renders them. */
function Looks({ state, set, hasReference }: { state: RenderState; set: Set; hasReference: boolean }) {
  const shown = [
    { value: 'picture', label: 'Picture' },
    { value: 'noise', label: 'Noise' },
    ...(hasReference ? [{ value: 'error', label: 'Error' }] : []),
  ];
  return (
    <>
      <Choice label="Show" value={state.show} options={shown} onChange={(now) => set({ show: now })} />
      <Slider label="Exposure" unit="stops" value={state.exposure} min={-8} max={8} onInput={(exposure) => set({ exposure })} />
      <Select label="Tone curve" value={toneOf(state.tone).id} options={TONES.map(({ id, name }) => ({ value: id, label: name }))} onChange={(tone) => set({ tone })} />
      <p class="quiet">{toneOf(state.tone).source}.</p>
      <Slider label="Width" unit="pixels" value={state.width} min={32} max={1920} isLogarithmic isInteger onInput={(width) => set({ width })} />
      <Slider label="Height" unit="pixels" value={state.height} min={18} max={1080} isLogarithmic isInteger onInput={(height) => set({ height })} />
      <Select
        label="Rendered by"
        value={state.by}
        options={[
          { value: 'auto', label: 'what is faster' },
          { value: 'gpu', label: 'WebGPU' },
          { value: 'processor', label: backend === 'wasm' ? 'the library in WebAssembly' : 'the library on the processor' },
        ]}
        onChange={(by) => set({ by })}
      />
    </>
  );
}
