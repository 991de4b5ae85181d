/** What the numbers of a run say, as checks in words. */

import type { Check } from '../../core/protocol';
import { chiSquareP } from './gamma';
import { CELLS, type Numbers } from './prover';

export interface Verdict {
  checks: Check[];
  counts: Float64Array;
  expected: Float64Array;
}

/** Below this chance a test fails. */
const LEAST_P = 1e-4;
/** Standard deviations of means that are taken for equal. */
const MOST_Z = 4.5;
/** Samples that a cell of the chi-square should expect. */
const LEAST_EXPECTED = 10;
/** What sums in single precision may be off by. */
const ROUNDING = 2e-4;

const percent = (share: number) => `${Number((100 * share).toPrecision(3))} %`;
const short = (x: number) => String(Number(x.toPrecision(4)));
const many = (n: number) => n.toLocaleString('en');

/** Largest difference, kept as the bits of a float. */
function ofBits(bits: number): number {
  return new Float32Array(new Uint32Array([bits]).buffer)[0] as number;
}

/** All checks of a run. */
export function verdictOf(numbers: Numbers): Verdict {
  const { samples, counts, fine, coarse } = numbers;
  const found = Float64Array.from(counts.subarray(0, CELLS));
  const expected = Float64Array.from({ length: CELLS }, (_, i) => samples * (fine[4 * i + 3] as number));
  const doubt = Float64Array.from({ length: CELLS }, (_, i) => samples * Math.abs((fine[4 * i + 3] as number) - (coarse[4 * i + 3] as number)));
  const at = (place: number) => counts[CELLS + place] as number;
  const failed = at(0) + at(4);
  const checks = [
    chiSquare(found, expected, doubt, failed, samples),
    normalisation(expected, doubt, failed, samples),
    ownDensity(at(1), ofBits(at(2)), at(3), samples - failed),
    furnace(numbers),
    energy(numbers),
    reciprocity(at(5), at(6), ofBits(at(7))),
    finite(at(8) + at(4), at(9)),
  ];
  return { checks, counts: found, expected };
}

function chiSquare(found: Float64Array, expected: Float64Array, doubt: Float64Array, failed: number, samples: number): Check {
  const pool = { found: 0, expected: 0, doubt: 0 };
  const cells: { found: number; expected: number; doubt: number }[] = [];
  const take = (cell: { found: number; expected: number; doubt: number }) => {
    if (cell.expected >= LEAST_EXPECTED) cells.push(cell);
    else {
      pool.found += cell.found;
      pool.expected += Math.max(0, cell.expected);
      pool.doubt += cell.doubt;
    }
  };
  found.forEach((count, i) => take({ found: count, expected: expected[i] as number, doubt: doubt[i] as number }));
  const total = expected.reduce((a, b) => a + b, 0);
  take({ found: failed, expected: samples - total, doubt: doubt.reduce((a, b) => a + b, 0) });
  if (pool.expected >= LEAST_EXPECTED || cells.length === 0) cells.push(pool);
  else {
    const least = cells.reduce((a, b) => (b.expected < a.expected ? b : a));
    least.found += pool.found;
    least.expected += pool.expected;
    least.doubt += pool.doubt;
  }
  const statistic = cells.reduce((sum, c) => sum + (c.found - c.expected) ** 2 / (Math.max(c.expected, 1) + c.doubt ** 2), 0);
  const degrees = Math.max(1, cells.length - 1);
  const p = chiSquareP(statistic, degrees);
  return { name: 'chi-square', holds: p > LEAST_P, text: `${many(samples)} samples in ${cells.length} cells: ${short(statistic)} for ${degrees} degrees of freedom`, p };
}

function normalisation(expected: Float64Array, doubt: Float64Array, failed: number, samples: number): Check {
  const density = expected.reduce((a, b) => a + b, 0) / samples;
  const share = failed / samples;
  const error = Math.sqrt((share * (1 - share)) / samples);
  const tolerance = MOST_Z * error + doubt.reduce((a, b) => a + b, 0) / samples + ROUNDING;
  const sum = density + share;
  return {
    name: 'normalisation',
    holds: Math.abs(sum - 1) <= tolerance,
    text: `the density integrates to ${density.toFixed(5)}, ${percent(share)} of the samples fail: together ${sum.toFixed(5)}`,
  };
}

function ownDensity(differing: number, largest: number, notUnit: number, drawn: number): Check {
  const parts = [];
  if (differing > 0) parts.push(`${percent(differing / Math.max(1, drawn))} of the samples have another density than user_pdf; largest relative difference ${short(largest)}`);
  if (notUnit > 0) parts.push(`${percent(notUnit / Math.max(1, drawn))} of the directions are not unit`);
  return { name: 'pdf of samples', holds: parts.length === 0, text: parts.length === 0 ? 'samples have the density that user_pdf says, within 0.1 %' : parts.join('; ') };
}

const CHANNELS = [0, 1, 2] as const;

/** The albedo by the fine rule, and what it may be off by. */
function albedo({ fine, coarse }: Numbers): { value: number[]; doubt: number[] } {
  const sum = (from: Float32Array, k: number) => Array.from({ length: CELLS }, (_, i) => from[4 * i + k] as number).reduce((a, b) => a + b, 0);
  const value = CHANNELS.map((k) => sum(fine, k));
  return { value, doubt: CHANNELS.map((k) => Math.abs((value[k] as number) - sum(coarse, k)) + ROUNDING * (value[k] as number)) };
}

function furnace(numbers: Numbers): Check {
  const { samples, weight, squares } = numbers;
  const { value, doubt } = albedo(numbers);
  const means = CHANNELS.map((k) => weight[k] / samples);
  const apart = CHANNELS.map((k) => {
    const mean = means[k] as number;
    const error = Math.sqrt(Math.max(0, squares[k] / samples - mean * mean) / samples);
    return Math.max(0, Math.abs(mean - (value[k] as number)) - (doubt[k] as number)) / Math.max(error, 1e-12);
  });
  const list = (xs: number[]) => xs.map((x) => x.toFixed(4)).join(', ');
  return { name: 'furnace', holds: Math.max(...apart) <= MOST_Z, text: `albedo by samples ${list(means)}; by quadrature of user_eval ${list(value)}` };
}

function energy(numbers: Numbers): Check {
  const { value, doubt } = albedo(numbers);
  const most = Math.max(...value);
  const holds = CHANNELS.every((k) => (value[k] as number) <= 1 + (doubt[k] as number));
  return { name: 'energy', holds, text: holds ? `at most ${percent(most)} of the light returns` : `${percent(most)} of the light returns: more than came` };
}

function reciprocity(pairs: number, unequal: number, largest: number): Check {
  if (pairs === 0) return { name: 'reciprocity', holds: true, text: 'no pair of directions has a value: nothing to compare' };
  const text = `${many(pairs)} pairs on one side: largest relative difference ${short(largest)}`;
  return { name: 'reciprocity', holds: unequal === 0, text: unequal === 0 ? text : `${text}; above 1 % for ${percent(unequal / pairs)}` };
}

function finite(invalid: number, first: number): Check {
  const name = 'finite values';
  if (invalid === 0) return { name, holds: true, text: 'no value is negative, infinite or not a number, at grazing views neither' };
  const cosine = [1, 0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, -0.3][Math.floor(first / 2048)];
  const where = first === 0xffffffff ? 'at this view' : `the first at a view of cosine ${cosine}, azimuth ${45 * (Math.floor(first / 256) % 8)} degrees`;
  return { name, holds: false, text: `${many(invalid)} values are negative, infinite or not a number; ${where}` };
}
