/** The state of the page of renders, as its address has it. */

import type { Camera, MaterialEdit } from '../../core/protocol';
import type { Setup } from './render';

export const DEFAULTS = {
  scene: '',
  width: 480,
  height: 270,
  /** How many are compared. */
  treatments: 1,
  mode: 'time',
  energyA: '',
  energyB: 'none',
  energyC: 'kulla-conty',
  energyD: 'multibounce=specula',
  samplerA: '',
  samplerB: '',
  samplerC: '',
  samplerD: '',
  /** Between A and B, B and C, C and D; none: even parts. */
  dividers: [] as number[],
  exposure: 0,
  tone: 'linear',
  samples: 256,
  seed: 1,
  /** Eye, target, up, field of view. */
  camera: [] as number[],
  /** `number=text`, separated by semicolons; of all, and of one alone. */
  edits: '',
  editsA: '',
  editsB: '',
  editsC: '',
  editsD: '',
  by: 'auto',
  /** Whose treatment the reference has; `no`: there is none. */
  reference: 'no',
  show: 'picture',
  /** The inspected pixel: column and row. */
  pixel: [] as number[],
};
export type RenderState = typeof DEFAULTS;
export type Set = (change: Partial<RenderState>) => void;
export type Letter = 'A' | 'B' | 'C' | 'D';
export const LETTERS: readonly Letter[] = ['A', 'B', 'C', 'D'];

/** The reference takes other random numbers. */
const OTHER_SEED = 1_000_003;

export function cameraOf(numbers: number[]): Camera | undefined {
  if (numbers.length !== 10) return undefined;
  const at = (i: number) => numbers.slice(i, i + 3) as [number, number, number];
  return { eye: at(0), target: at(3), up: at(6), fovDegrees: numbers[9] as number };
}

export const numbersOf = (camera: Camera) => [...camera.eye, ...camera.target, ...camera.up, camera.fovDegrees];

export function editsOf(text: string): MaterialEdit[] {
  const parts = text.split(';').map((part) => /^(\d+)=(.+)$/.exec(part.trim()));
  return parts.flatMap((found) => (found === null ? [] : [{ material: Number(found[1]), text: found[2] as string }]));
}

/** Edits with one more; an empty text takes it back. */
export function withEdit(edits: string, material: number, text: string): string {
  const others = editsOf(edits).filter((e) => e.material !== material);
  const all = text === '' ? others : [...others, { material, text }];
  return all.map((e) => `${e.material}=${e.text}`).join(';');
}

/** The key of the edits of one treatment, or of all. */
export const editsKey = (of: Letter | 'all') => (of === 'all' ? ('edits' as const) : (`edits${of}` as const));

/** How many are compared, whatever the address says. */
export const countOf = (state: RenderState) => Math.max(1, Math.min(4, Math.round(state.treatments)));

/** Places of the dividers: even parts where the address has none. */
export function dividersOf(state: RenderState): number[] {
  const count = countOf(state);
  const isWhole = state.dividers.length === count - 1 && state.dividers.every((d, i) => d >= (state.dividers[i - 1] ?? 0) && d <= 1);
  return isWhole ? state.dividers : Array.from({ length: count - 1 }, (_, i) => (i + 1) / count);
}

/** What is rendered of a treatment. */
export function setupOf(state: RenderState, scene: string, letter: Letter): Setup {
  const own = editsOf(state[`edits${letter}`]);
  const shared = editsOf(state.edits).filter((edit) => !own.some((other) => other.material === edit.material));
  return {
    scene,
    size: [Math.max(1, Math.round(state.width)), Math.max(1, Math.round(state.height))],
    energy: state[`energy${letter}`],
    sampler: state[`sampler${letter}`],
    camera: cameraOf(state.camera),
    edits: [...shared, ...own],
    seed: state.seed,
    by: state.by,
  };
}

/** What the reference renders; `undefined`: there is none. */
export function referenceOf(state: RenderState, scene: string): Setup | undefined {
  const letter = LETTERS.slice(0, countOf(state)).find((l) => l === state.reference);
  if (letter === undefined) return undefined;
  return { ...setupOf(state, scene, letter), seed: state.seed + OTHER_SEED };
}
