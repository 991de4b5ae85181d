/** What a slice says, as curves: values by angle for each lobe, by luminance or by channel. */

import type { Answer } from '../../core/ask';
import { slotColour } from './slots';
import type { Layer } from './answers';
import type { Channels, Quantity, Slot } from './state';

/** Weights of linear sRGB in luminance. */
const LUMINANCE = [0.2126, 0.7152, 0.0722] as const;
const CHANNEL_NAMES = ['red', 'green', 'blue'] as const;
/** Strokes that tell lobes apart where colours are the channels'. */
const DASHES: Record<Slot, string | undefined> = { a: undefined, b: '7 4', c: '2 3', d: '9 3 2 3' };

export interface Curve {
  slot: Slot;
  name: string;
  colour: string;
  dash: string | undefined;
  values: Float64Array;
  error?: Float64Array;
}

/** A colour's luminance. */
export function luminance(colours: ArrayLike<number>, i: number): number {
  return LUMINANCE.reduce((sum, share, k) => sum + share * (colours[3 * i + k] as number), 0);
}

/** One value of what is shown; channel 3 is the luminance. */
export function valueOf(quantity: Quantity, channel: number, f_cos: ArrayLike<number>, pdf: ArrayLike<number>, i: number): number {
  const density = pdf[i] as number;
  if (quantity === 'pdf') return density;
  const value = channel === 3 ? luminance(f_cos, i) : (f_cos[3 * i + channel] as number);
  if (quantity === 'f_cos') return value;
  return density > 0 ? value / density : value > 0 ? Number.NaN : 0;
}

/** Curves of slices. */
export function curvesOf(layers: Layer[], slices: Record<Slot, Answer<'lobes.slice'> | undefined>, quantity: Quantity, channels: Channels): Curve[] {
  const shown = quantity === 'pdf' || channels === 'luminance' ? [3] : [0, 1, 2];
  return layers.flatMap((layer) => {
    const arrays = slices[layer.slot]?.arrays;
    if (arrays === undefined) return [];
    const { f_cos, pdf } = arrays;
    return shown.map((channel): Curve => {
      const values = Float64Array.from(pdf.values, (_, i) => valueOf(quantity, channel, f_cos.values, pdf.values, i));
      return { ...look(layer, channel), values };
    });
  });
}

/** Curves of albedos, with their errors. */
export function albedoCurves(layers: Layer[], albedos: Record<Slot, Answer<'lobes.albedo'> | undefined>, channels: Channels): Curve[] {
  return layers.flatMap((layer) => {
    const arrays = albedos[layer.slot]?.arrays;
    if (arrays === undefined) return [];
    const { albedo, error, cos } = arrays;
    return (channels === 'luminance' ? [3] : [0, 1, 2]).map((channel): Curve => {
      const at = (from: Float32Array, i: number) => (channel === 3 ? luminance(from, i) : (from[3 * i + channel] as number));
      return {
        ...look(layer, channel),
        values: Float64Array.from(cos.values, (_, i) => at(albedo.values, i)),
        error: Float64Array.from(cos.values, (_, i) => at(error.values, i)),
      };
    });
  });
}

function look(layer: Layer, channel: number): { slot: Slot; name: string; colour: string; dash: string | undefined } {
  const { slot, letter, lobe } = layer;
  if (channel === 3) return { slot, name: `${letter}: ${lobe}`, colour: slotColour(slot), dash: undefined };
  return { slot, name: `${letter} ${CHANNEL_NAMES[channel]}`, colour: `var(--channel-${channel + 1})`, dash: DASHES[slot] };
}

/** The greatest finite value. */
export function greatest(curves: { values: ArrayLike<number> }[]): number {
  let top = 0;
  for (const { values } of curves) {
    for (let i = 0; i < values.length; i++) {
      const v = values[i] as number;
      if (Number.isFinite(v) && v > top) top = v;
    }
  }
  return top;
}

/** A number for a table. */
export function figure(x: number): string {
  if (!Number.isFinite(x)) return 'not a number';
  if (x === 0) return '0';
  const size = Math.abs(x);
  return size >= 1e5 || size < 1e-4 ? x.toExponential(3) : String(Number(x.toPrecision(5)));
}
