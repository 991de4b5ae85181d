/** What is kept of the page in its address, and what follows from it. */

import { direction, RADIANS } from '../../core/directions';
import type { Vec3 } from '../../core/protocol';

/** Places of lobes that are laid over each other. */
export const SLOTS = ['a', 'b', 'c', 'd'] as const;
export type Slot = (typeof SLOTS)[number];

/** What curves and surfaces show. */
export type Quantity = 'f_cos' | 'pdf' | 'weight';
export type Channels = 'luminance' | 'rgb';

export const DEFAULTS = {
  a: 'conductor Au alpha 0.3',
  b: '',
  c: '',
  d: '',
  /** The lobe that controls change, and of which there is one picture only. */
  slot: 'a',
  /** Of the view, in degrees: 90 is the normal. */
  elevation: 40,
  azimuth: 180,
  /** Of the light, in degrees in the plane of incidence; positive: on the mirror's side. */
  light: 50,
  quantity: 'f_cos',
  channels: 'luminance',
  log: false,
  points: false,
  language: 'specula',
  walk: 1,
};
export type LobesState = typeof DEFAULTS;

/** Directions of a slice: a quarter of a degree apart, so that a light of whole quarters is one of them. */
export const SLICE_COUNT = 1441;

/** The slot that controls change; the first one where the address names one that is empty. */
export function activeSlot(state: LobesState): Slot {
  return SLOTS.find((slot) => slot === state.slot && state[slot] !== '') ?? SLOTS.find((slot) => state[slot] !== '') ?? 'a';
}

/** Towards the viewer. */
export function viewOf(state: LobesState): Vec3 {
  return direction(state.elevation, state.azimuth).map((x) => Number(x.toPrecision(7))) as Vec3;
}

/** The azimuth of a slice: positive angles are on the mirror's side. */
export function sliceAzimuth(state: LobesState): number {
  return (state.azimuth + 180) * RADIANS;
}

/** The view's angle in the slice, in degrees. */
export function viewAngle(state: LobesState): number {
  return state.elevation - 90;
}

/** An angle of the light that is a direction of the slice. */
export function snapped(degrees: number): number {
  return Math.round(Math.min(180, Math.max(-180, degrees)) * 4) / 4;
}

/** Where a slice has the light. */
export function lightIndex(state: LobesState): number {
  return Math.round((snapped(state.light) + 180) * 4);
}

export const QUANTITIES: { value: Quantity; label: string; axis: string; hint: string }[] = [
  { value: 'f_cos', label: 'f cos', axis: 'f |cos| (1/sr)', hint: 'The lobe times the cosine of the light' },
  { value: 'pdf', label: 'pdf', axis: 'pdf (1/sr)', hint: 'Density with which the lobe samples the light' },
  { value: 'weight', label: 'weight', axis: 'f |cos| / pdf', hint: 'What a sample of this direction carries' },
];

export function quantityOf(state: LobesState): (typeof QUANTITIES)[number] {
  return QUANTITIES.find((q) => q.value === state.quantity) ?? (QUANTITIES[0] as (typeof QUANTITIES)[number]);
}
