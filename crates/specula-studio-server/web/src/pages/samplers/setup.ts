/** The state of the page of samplers, and its presets. */

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

/** Views and widths with which the papers draw their figures. */
export const PRESETS: { name: string; state: Partial<SamplerState> }[] = [
  { name: 'Rough, steep', state: { alpha: [1, 1], elevation: 60, azimuth: 0 } },
  { name: 'Rough, grazing', state: { alpha: [1, 1], elevation: 10, azimuth: 0 } },
  { name: 'Smooth, grazing', state: { alpha: [0.2, 0.2], elevation: 10, azimuth: 0 } },
  { name: 'Anisotropic', state: { alpha: [0.8, 0.15], elevation: 20, azimuth: 45 } },
  { name: 'Below the horizon', state: { alpha: [0.6, 0.6], elevation: -20, azimuth: 0 } },
];

const RADIANS = Math.PI / 180;

export function direction(elevation: number, azimuth: number): Vec3 {
  const cos = Math.cos(elevation * RADIANS);
  return [cos * Math.cos(azimuth * RADIANS), cos * Math.sin(azimuth * RADIANS), Math.sin(elevation * RADIANS)];
}

/** Elevation and azimuth of a direction, in whole degrees. */
export function angles([x, y, z]: Vec3): { elevation: number; azimuth: number } {
  const azimuth = Math.round(Math.atan2(y, x) / RADIANS);
  return { elevation: Math.round(Math.asin(Math.min(1, Math.max(-1, z))) / RADIANS), azimuth: azimuth < 0 ? azimuth + 360 : azimuth };
}
