/** Scales of colour for pictures of numbers. */

const VIRIDIS = [
  [0.27773, 0.00541, 0.3341],
  [0.10509, 1.40461, 1.38459],
  [-0.33086, 0.21485, 0.0951],
  [-4.63423, -5.7991, -19.33244],
  [6.22827, 14.17993, 56.69055],
  [4.77638, -13.74515, -65.35303],
  [-5.43546, 4.64585, 26.31244],
] as const;

/** Viridis at a share in [0, 1], as bytes of sRGB: a polynomial fitted to it. */
export function viridis(share: number): [number, number, number] {
  const t = Math.min(1, Math.max(0, Number.isFinite(share) ? share : 0));
  const channel = (k: 0 | 1 | 2) => VIRIDIS.reduceRight((sum, c) => sum * t + c[k], 0);
  return [0, 1, 2].map((k) => Math.round(255 * Math.min(1, Math.max(0, channel(k as 0 | 1 | 2))))) as [number, number, number];
}

/** Blue, white, orange at a share in [-1, 1], as bytes of sRGB. */
export function diverging(share: number): [number, number, number] {
  const t = Math.min(1, Math.max(-1, Number.isFinite(share) ? share : 0));
  const end = t < 0 ? [0, 88, 160] : [190, 84, 0];
  return end.map((c) => Math.round(247 + (c - 247) * Math.abs(t) ** 0.8)) as [number, number, number];
}
