/** Directions by angles. */

import type { Vec3 } from './protocol';

export const RADIANS = Math.PI / 180;

/** The unit vector at so many degrees above the horizon, and from x to y. */
export function direction(elevation: number, azimuth: number): Vec3 {
  const cos = Math.cos(elevation * RADIANS);
  return [cos * Math.cos(azimuth * RADIANS), cos * Math.sin(azimuth * RADIANS), Math.sin(elevation * RADIANS)];
}
