/** Colours: linear sRGB. */

import type { Rgb } from './protocol';

/** Luminance, by the weights of Rec. 709. */
export const luminance = ([r, g, b]: Rgb): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** Shares of the encoding's table. */
const STEPS = 4096;
const TABLE = Uint8ClampedArray.from({ length: STEPS + 1 }, (_, i) => {
  const v = i / STEPS;
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
});
/** Below this the table is too coarse. */
const DARK = 0.01;

/** A byte of sRGB (IEC 61966-2-1) for a linear value. */
export function encoded(x: number): number {
  if (x >= 1) return 255;
  if (x >= DARK) return TABLE[Math.round(x * STEPS)] as number;
  if (!(x > 0)) return 0;
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
}
