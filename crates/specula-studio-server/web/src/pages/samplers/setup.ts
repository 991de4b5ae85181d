/** The state of the page of samplers, and its presets. */

import { RADIANS } from '../../core/directions';
import type { Sampler, Vec3 } from '../../core/protocol';

export const SAMPLERS: { value: Sampler; label: string; hint: string }[] = [
  { value: 'heitz', label: 'Heitz', hint: 'Heitz 2018' },
  { value: 'cap', label: 'Cap', hint: 'Spherical caps, Dupuy and Benyoub 2023' },
  { value: 'bounded', label: 'Bounded', hint: 'Bounded caps, Tokuyoshi and Eto 2024' },
  { value: 'exact', label: 'Exact', hint: 'Exactly the reflections above the surface' },
];

export const DEFAULTS = {
  sampler: 'bounded' as string,
  alpha: [0.6, 0.6] as number[],
  /** Of the view, in degrees: above the horizon, and from x to y. */
  elevation: 25,
  azimuth: 0,
  count: 20000,
  seed: 1,
  light: 'uniform' as string,
  lightElevation: 40,
  lightAzimuth: 180,
  lightAngle: 10,
  /** Samples fall one after the other. */
  rain: true,
  /** What is not drawn, by name. */
  hides: '',
  /** The sample that is read out, from 1; 0: none. */
  sample: 0,
};
export type SamplerState = typeof DEFAULTS;

/** A surface, a view and a sampler. */
export interface Setup {
  sampler: Sampler;
  alpha: [number, number];
  wo: Vec3;
}

interface Preset {
  name: string;
  state: Partial<SamplerState>;
}

const at = (name: string, x: number, y: number, elevation: number, azimuth = 0): Preset => ({ name, state: { alpha: [x, y], elevation, azimuth } });

/** Figures of Tokuyoshi and Eto 2024 and of its supplement; of figures 3 and 5 the views that the laboratory takes. */
export const PRESETS: { group: string; presets: Preset[] }[] = [
  {
    group: 'Supplement, figure 1',
    presets: [at('a', 0.7, 0.4, 72.54), at('b', 0.7, 0.8, 47.87, 63.43), at('c', 1.5, 0.2, 34.45, 104.04), at('d', 1.6, 1.3, 68.87, 123.69)],
  },
  {
    group: 'Figure 3: regions',
    presets: [at('1', 0.3, 0.3, 30), at('2', 0.8, 0.8, 60), at('3', 1, 1, 90), at('4', 0.8, 0.4, 45, 40), at('5', 1, 0.2, 30, 70), at('6', 1.5, 1.2, 45, 40)],
  },
  { group: 'Figure 5: along the normal', presets: [at('0.4', 0.4, 0.4, 90), at('0.7', 0.7, 0.7, 90), at('1', 1, 1, 90)] },
  { group: 'Others', presets: [at('Rough, grazing', 1, 1, 10), at('Smooth, grazing', 0.2, 0.2, 10), at('Below the horizon', 0.6, 0.6, -20)] },
];

/** Elevation and azimuth of a direction, in tenths of degrees. */
export function angles([x, y, z]: Vec3): { elevation: number; azimuth: number } {
  const azimuth = Math.round((10 * Math.atan2(y, x)) / RADIANS) / 10;
  return { elevation: Math.round((10 * Math.asin(Math.min(1, Math.max(-1, z)))) / RADIANS) / 10, azimuth: azimuth < 0 ? azimuth + 360 : azimuth };
}
