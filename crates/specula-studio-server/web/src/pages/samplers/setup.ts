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
};
export type SamplerState = typeof DEFAULTS;

/** The panels of figure 1 of the supplement of Tokuyoshi and Eto 2024, the view of their figure 5, and others. */
export const PRESETS: { name: string; state: Partial<SamplerState> }[] = [
  { name: 'Supplement, fig. 1 a', state: { alpha: [0.7, 0.4], elevation: 72.54, azimuth: 0 } },
  { name: 'fig. 1 b', state: { alpha: [0.7, 0.8], elevation: 47.87, azimuth: 63.43 } },
  { name: 'fig. 1 c', state: { alpha: [1.5, 0.2], elevation: 34.45, azimuth: 104.04 } },
  { name: 'fig. 1 d', state: { alpha: [1.6, 1.3], elevation: 68.87, azimuth: 123.69 } },
  { name: 'Along the normal', state: { alpha: [1, 1], elevation: 90, azimuth: 0 } },
  { name: 'Rough, grazing', state: { alpha: [1, 1], elevation: 10, azimuth: 0 } },
  { name: 'Smooth, grazing', state: { alpha: [0.2, 0.2], elevation: 10, azimuth: 0 } },
  { name: 'Below the horizon', state: { alpha: [0.6, 0.6], elevation: -20, azimuth: 0 } },
];

/** Elevation and azimuth of a direction, in tenths of degrees. */
export function angles([x, y, z]: Vec3): { elevation: number; azimuth: number } {
  const azimuth = Math.round((10 * Math.atan2(y, x)) / RADIANS) / 10;
  return { elevation: Math.round((10 * Math.asin(Math.min(1, Math.max(-1, z)))) / RADIANS) / 10, azimuth: azimuth < 0 ? azimuth + 360 : azimuth };
}
