/** Errors of a picture against another, as `render.compare` has them: means over pixels and channels. */

/** Added to the squared reference in relative errors, as in relMSE. */
const EPSILON = 0.01;

export interface Errors {
  rmse: number;
  relMse: number;
  /** Root mean square error without what the reference's own noise adds, where its variance is known; see `errorsOf`. */
  rmseAlone: number;
}

/**
 * Errors of `test`. The variance of the reference takes samples for independent, and is too large for sequences that are
 * better than that: at least this `share` of the squared differences is left to the render.
 */
export function errorsOf(test: Float32Array, reference: Float32Array, variance: Float32Array | undefined, share: number): Errors {
  let [sum, relative, own] = [0, 0, 0];
  for (let i = 0; i < test.length; i++) {
    const r = reference[i] as number;
    const square = ((test[i] as number) - r) ** 2;
    if (!Number.isFinite(square)) continue;
    sum += square;
    relative += square / (r * r + EPSILON);
    own += variance?.[i] ?? 0;
  }
  const count = Math.max(1, test.length);
  return { rmse: Math.sqrt(sum / count), relMse: relative / count, rmseAlone: Math.sqrt(Math.max(share * sum, sum - own) / count) };
}

/** Relative error of every pixel: the root of its mean over channels of `(t - r)^2 / (r^2 + 0.01)`. */
export function errorMap(test: Float32Array, reference: Float32Array): Float32Array {
  return Float32Array.from({ length: test.length / 3 }, (_, i) => {
    let sum = 0;
    for (let k = 3 * i; k < 3 * i + 3; k++) {
      const r = reference[k] as number;
      sum += ((test[k] as number) - r) ** 2 / (r * r + EPSILON);
    }
    return Number.isFinite(sum) ? Math.sqrt(sum / 3) : 0;
  });
}

/** Relative noise of every pixel: the root of its mean over channels of `variance / (mean^2 + 0.01)`. */
export function noiseMap(colour: Float32Array, variance: Float32Array): Float32Array {
  return Float32Array.from({ length: colour.length / 3 }, (_, i) => {
    let sum = 0;
    for (let k = 3 * i; k < 3 * i + 3; k++) sum += (variance[k] as number) / ((colour[k] as number) ** 2 + EPSILON);
    return Number.isFinite(sum) ? Math.sqrt(sum / 3) : 0;
  });
}
