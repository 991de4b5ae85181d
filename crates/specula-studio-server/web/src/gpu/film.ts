/** Sums of samples of a picture, in double precision: its mean, the variance of the mean, its noise. */

import type { Rgb } from '../core/protocol';
import { luminance } from '../core/colour';

/** Numbers of a pixel's sums: values and weight, squares and rays, samples that are not finite. */
const SUMS = 12;
/** As of `specula-render/src/film/noise.rs`: what carries a pixel whose variance is known, and how many may be left out. */
const CARRIERS = 4;
const ONE_IN = 200;
const DARKEST = 0.01;

export class Film {
  private readonly sums: Float64Array;
  private samples = 0;
  invalid = 0;
  /** Means, red, green, blue by pixel. */
  readonly colour: Float32Array;
  /** Variance of the means; 0 where it is not known. */
  readonly variance: Float32Array;

  constructor(width: number, height: number) {
    this.sums = new Float64Array(7 * width * height);
    this.colour = new Float32Array(3 * width * height);
    this.variance = new Float32Array(3 * width * height);
  }

  /** Adds the sums of so many samples of every pixel; returns the rays that they took. */
  add(more: Float32Array, samples: number): number {
    const { sums, colour, variance } = this;
    this.samples += samples;
    const n = this.samples;
    let rays = 0;
    for (let i = 0; i < colour.length / 3; i++) {
      const [from, to] = [SUMS * i, 7 * i];
      for (let k = 0; k < 7; k++) sums[to + k] += more[from + k] as number;
      rays += more[from + 7] as number;
      this.invalid += more[from + 8] as number;
      const weight = Math.max(sums[to + 3] as number, 1e-12);
      for (let k = 0; k < 3; k++) {
        const mean = (sums[to + k] as number) / weight;
        colour[3 * i + k] = mean;
        // The filter's weight is close to 1 for every sample: it is taken for even.
        const spread = Math.max(0, (sums[to + 4 + k] as number) / n - ((sums[to + k] as number) / n) ** 2);
        variance[3 * i + k] = n < 2 ? 0 : ((n / weight) ** 2 * spread) / (n - 1);
      }
    }
    return rays;
  }

  /** The picture's mean and its noise, as the library estimates it. */
  figures(): { mean: Rgb; noise: number } {
    const mean: Rgb = [0, 0, 0];
    const pixels = this.colour.length / 3;
    for (let i = 0; i < this.colour.length; i++) mean[(i % 3) as 0] += (this.colour[i] as number) / pixels;
    return { mean, noise: this.samples < 2 ? 1 : noiseOf(this.colour, this.variance, luminance(mean)) };
  }
}

/** Relative error of a pixel, root mean square over all whose variance is known. */
function noiseOf(colour: Float32Array, variance: Float32Array, brightness: number): number {
  if (brightness <= 0) return 0;
  const pixels = colour.length / 3;
  const unknown: number[] = [];
  let sum = 0;
  for (let i = 0; i < pixels; i++) {
    const at = (values: Float32Array, change: (x: number) => number): Rgb => [0, 1, 2].map((k) => change(values[3 * i + k] as number)) as Rgb;
    const y = luminance(at(colour, (x) => x));
    const v = luminance(at(variance, Math.sqrt)) ** 2;
    const error = v / (brightness * (Math.max(0, y) + DARKEST * brightness));
    sum += error;
    if (y * y < CARRIERS * v) unknown.push(error);
  }
  const left = unknown.sort((a, b) => b - a).slice(0, Math.floor(pixels / ONE_IN));
  const rest = sum - left.reduce((a, b) => a + b, 0);
  return Math.sqrt(Math.max(0, rest) / Math.max(1, pixels - left.length));
}
