/**
 * A drawing of a random walk: a profile of a rough surface that has the walk's heights and slopes.
 *
 * A Smith surface is heights and slopes without places. So a Gaussian profile is drawn at random, with the slopes that
 * alpha asks for, and conditioned (simple kriging) to have the walk's heights and its facets' slopes where the walk
 * meets it; of several, the one that the path crosses least is taken.
 */

import type { Vec3 } from '../../core/protocol';

export interface Vertex {
  height: number;
  direction: Vec3;
}

export interface Drawing {
  /** The surface, from left to right. */
  profile: [number, number][];
  /** Where light comes from, each bounce, and where it leaves to. */
  path: [number, number][];
  /** Side of the picture that shows it. */
  low: [number, number];
  high: [number, number];
}

/** Points of the profile. */
const POINTS = 480;
const TRIES = 64;
const WAVES = 24;
/** Of correlation. A Gaussian surface of heights s and slopes alpha / sqrt 2 has 2 s / alpha; here s is alpha. */
const LENGTH = 2;

function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = state;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** A walk's directions in the plane of the drawing: along the plane of incidence, and up. */
function flat(direction: Vec3, azimuth: number): [number, number] {
  return [direction[0] * Math.cos(azimuth) + direction[1] * Math.sin(azimuth), direction[2]];
}

/** The drawing of a walk: its vertices (the first one is where light comes in), alpha, a seed. */
export function drawWalk(vertices: Vertex[], alpha: number, azimuth: number, seed: number): Drawing {
  const unit = alpha;
  const directions = vertices.map((v) => flat(v.direction, azimuth));
  const inside = vertices.slice(1).filter((v) => Number.isFinite(v.height));
  const heights = inside.map((v) => v.height * unit);
  const places = [0];
  for (let i = 1; i < heights.length; i++) {
    const [dx, dz] = directions[i] as [number, number];
    const rise = (heights[i] as number) - (heights[i - 1] as number);
    const run = Math.abs(dz) > 1e-3 ? (rise * dx) / dz : Math.sign(dx) * LENGTH;
    places.push((places[i - 1] as number) + Math.max(-8 * LENGTH, Math.min(8 * LENGTH, run)));
  }
  const margin = Math.max(1.6 * LENGTH, 0.2 * (Math.max(...places) - Math.min(...places)));
  const [left, right] = [Math.min(...places) - margin, Math.max(...places) + margin];
  const slopes = heights.map((_, i) => facetSlope(directions[i] as [number, number], directions[i + 1] as [number, number] | undefined, alpha));
  const drawn = profileThrough(places, heights, slopes, left, right, unit, seed, directions);
  const peak = Math.max(...drawn.map(([, z]) => z), ...heights) + 1.6 * unit;
  const path: [number, number][] = places.map((x, i) => [x, heights[i] as number]);
  const reach = (from: [number, number], [dx, dz]: [number, number]): [number, number] => {
    const far = Math.min(dz > 1e-4 ? (peak - from[1]) / dz : Infinity, dx > 0 ? (right - from[0]) / dx : dx < 0 ? (left - from[0]) / dx : Infinity);
    return [from[0] + far * dx, from[1] + far * dz];
  };
  const first = path[0] ?? [0, 0];
  const into = directions[0] ?? [0, -1];
  const last = path.at(-1) ?? [0, 0];
  const out = directions[directions.length - 1] ?? [0, 1];
  const bottom = Math.min(...drawn.map(([, z]) => z), ...heights) - 0.8 * unit;
  const whole = [reach(first, [-into[0], -into[1]]), ...path, ...(path.length > 0 && directions.length > 1 ? [out[1] > 0 ? reach(last, out) : down(last, out, bottom)] : [])];
  return { profile: drawn, path: whole, low: [left, bottom], high: [right, peak] };
}

function down(from: [number, number], [dx, dz]: [number, number], bottom: number): [number, number] {
  const far = dz < -1e-4 ? (bottom - from[1]) / dz : 0;
  return [from[0] + far * dx, from[1] + far * dz];
}

/** Slope of the facet that turns one direction into the next by reflection, in the drawing's plane. */
function facetSlope(into: [number, number], out: [number, number] | undefined, alpha: number): number {
  if (out === undefined) return 0;
  const [x, z] = [out[0] - into[0], out[1] - into[1]];
  const most = 3 * alpha;
  return z > 1e-3 ? Math.max(-most, Math.min(most, -x / z)) : 0;
}

/** A random profile with these heights and slopes at these places. */
function profileThrough(places: number[], heights: number[], slopes: number[], left: number, right: number, unit: number, seed: number, directions: [number, number][]): [number, number][] {
  const length = LENGTH;
  // Covariance s^2 exp(-(d / l)^2): slopes have variance 2 (s / l)^2, which is alpha^2 / 2.
  const s2 = (unit * length * 0.5) ** 2 || 1e-12;
  const k = (d: number) => s2 * Math.exp(-((d / length) ** 2));
  const k1 = (d: number) => (-2 * d * k(d)) / length ** 2;
  const k2 = (d: number) => k(d) * ((4 * d * d) / length ** 4 - 2 / length ** 2);
  const n = places.length;
  const matrix = Array.from({ length: 2 * n }, (_, i) =>
    Array.from({ length: 2 * n }, (_, j) => {
      const d = (places[i % n] as number) - (places[j % n] as number);
      const value = i < n ? (j < n ? k(d) : -k1(d)) : j < n ? k1(d) : -k2(d);
      return i === j ? value * 1.001 : value;
    }),
  );
  let [best, fewest] = [[] as [number, number][], Infinity];
  const xs = Array.from({ length: POINTS }, (_, i) => left + ((right - left) * i) / (POINTS - 1));
  const mean = heights.reduce((sum, h) => sum + h, 0) / Math.max(1, n);
  for (let attempt = 0; attempt < TRIES; attempt++) {
    const next = random(seed * 977 + attempt);
    const waves = Array.from({ length: WAVES }, () => {
      const normal = Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());
      return [(normal * Math.SQRT2) / length, 2 * Math.PI * next()] as const;
    });
    const size = Math.sqrt((2 * s2) / WAVES);
    const h = (x: number) => mean + size * waves.reduce((sum, [w, p]) => sum + Math.cos(w * x + p), 0);
    const h1 = (x: number) => -size * waves.reduce((sum, [w, p]) => sum + w * Math.sin(w * x + p), 0);
    const wanted = [...places.map((x, i) => (heights[i] as number) - h(x)), ...places.map((x, i) => (slopes[i] as number) - h1(x))];
    const weights = solved(matrix, wanted);
    const profile = xs.map((x): [number, number] => {
      let z = h(x);
      for (let i = 0; i < n; i++) {
        const d = x - (places[i] as number);
        z += (weights[i] as number) * k(d) - (weights[n + i] as number) * k1(d);
      }
      return [x, z];
    });
    const crossed = crossings(profile, places, heights, directions);
    if (crossed < fewest) [best, fewest] = [profile, crossed];
    if (fewest === 0) break;
  }
  return best;
}

/** Solves a linear system, by elimination with pivots. */
function solved(matrix: number[][], right: number[]): number[] {
  const rows = matrix.map((row, i) => [...row, right[i] as number]);
  const n = rows.length;
  for (let c = 0; c < n; c++) {
    let pivot = c;
    for (let r = c + 1; r < n; r++) if (Math.abs(rows[r]?.[c] ?? 0) > Math.abs(rows[pivot]?.[c] ?? 0)) pivot = r;
    [rows[c], rows[pivot]] = [rows[pivot] as number[], rows[c] as number[]];
    const own = rows[c] as number[];
    for (let r = 0; r < n; r++) {
      const other = rows[r] as number[];
      if (r === c || own[c] === 0) continue;
      const factor = (other[c] as number) / (own[c] as number);
      for (let j = c; j <= n; j++) other[j] = (other[j] as number) - factor * (own[j] as number);
    }
  }
  return rows.map((row, i) => ((row[i] as number) === 0 ? 0 : (row[n] as number) / (row[i] as number)));
}

/** How many points of the profile stand above the path that passes over them. */
function crossings(profile: [number, number][], places: number[], heights: number[], directions: [number, number][]): number {
  const ends = [...places.map((x, i): [number, number] => [x, heights[i] as number])];
  const [into, out] = [directions[0] ?? [0, -1], directions.at(-1) ?? [0, 1]];
  const first = ends[0];
  const last = ends.at(-1);
  if (first === undefined || last === undefined) return 0;
  const all = [[first[0] - 100 * into[0], first[1] - 100 * into[1]] as [number, number], ...ends, ...(out[1] > 0 ? [[last[0] + 100 * out[0], last[1] + 100 * out[1]] as [number, number]] : [])];
  let count = 0;
  for (let i = 0; i + 1 < all.length; i++) {
    const [[x0, z0], [x1, z1]] = [all[i], all[i + 1]] as [[number, number], [number, number]];
    for (const [x, z] of profile) {
      const t = (x - x0) / (x1 - x0 || 1e-12);
      if (t > 0.02 && t < 0.98 && z > z0 + t * (z1 - z0)) count += 1;
    }
  }
  return count;
}
