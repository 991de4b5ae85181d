/** Tone curves: from linear colours of a scene to those of a display, both linear sRGB. */

import type { Rgb } from '../../core/protocol';

export interface Tone {
  id: string;
  name: string;
  /** Where the formula is from. */
  source: string;
  curve: (colour: Rgb) => Rgb;
}

type Matrix = readonly [Rgb, Rgb, Rgb];

/** Rows of a matrix times a colour. */
function times(rows: Matrix, [r, g, b]: Rgb): Rgb {
  const row = ([x, y, z]: Rgb) => x * r + y * g + z * b;
  return [row(rows[0]), row(rows[1]), row(rows[2])];
}

const each = ([r, g, b]: Rgb, change: (x: number) => number): Rgb => [change(r), change(g), change(b)];
const clamped = (x: number) => Math.min(1, Math.max(0, x));

/** Hill's fit of the ACES reference and output transforms, for sRGB. */
const ACES_IN: Matrix = [
  [0.59719, 0.35458, 0.04823],
  [0.076, 0.90834, 0.01566],
  [0.0284, 0.13383, 0.83777],
];
const ACES_OUT: Matrix = [
  [1.60475, -0.53108, -0.07367],
  [-0.10208, 1.10813, -0.00605],
  [-0.00327, -0.07276, 1.07602],
];
const acesFit = (x: number) => (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.432951) + 0.238081);

const REC2020_OF_SRGB: Matrix = [
  [0.6274, 0.3293, 0.0433],
  [0.0691, 0.9195, 0.0113],
  [0.0164, 0.088, 0.8956],
];
const SRGB_OF_REC2020: Matrix = [
  [1.6605, -0.5876, -0.0728],
  [-0.1246, 1.1329, -0.0083],
  [-0.0182, -0.1006, 1.1187],
];
const AGX_INSET: Matrix = [
  [0.856627153315983, 0.0951212405381588, 0.0482516061458583],
  [0.137318972929847, 0.761241990602591, 0.101439036467562],
  [0.11189821299995, 0.0767994186031903, 0.811302368396859],
];
const AGX_OUTSET: Matrix = [
  [1.1271005818144368, -0.11060664309660323, -0.016493938717834573],
  [-0.1413297634984383, 1.157823702216272, -0.016493938717834257],
  [-0.14132976349843826, -0.11060664309660294, 1.2519364065950405],
];
/** Of the logarithm that AgX takes: middle grey 0.18, 10 stops below it and 6.5 above. */
const AGX_LOW = -12.47393;
const AGX_HIGH = 4.026069;

function agxContrast(x: number): number {
  return -0.00232 + x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5)))));
}

function agx(colour: Rgb): Rgb {
  const inset = times(AGX_INSET, times(REC2020_OF_SRGB, colour));
  const bent = each(inset, (x) => agxContrast(clamped((Math.log2(Math.max(x, 1e-10)) - AGX_LOW) / (AGX_HIGH - AGX_LOW))));
  return times(SRGB_OF_REC2020, each(times(AGX_OUTSET, bent), (x) => Math.max(0, x) ** 2.2));
}

function neutral([r, g, b]: Rgb): Rgb {
  const [start, desaturation] = [0.8 - 0.04, 0.15];
  const least = Math.min(r, g, b);
  const offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
  const shifted = each([r, g, b], (x) => x - offset);
  const peak = Math.max(...shifted);
  if (peak < start) return shifted;
  const room = 1 - start;
  const bent = 1 - (room * room) / (peak + room - start);
  const grey = 1 - 1 / (desaturation * (peak - bent) + 1);
  return each(shifted, (x) => ((x * bent) / peak) * (1 - grey) + bent * grey);
}

export const TONES: readonly Tone[] = [
  { id: 'linear', name: 'Linear', source: 'Values above 1 are cut off', curve: (colour) => colour },
  { id: 'reinhard', name: 'Reinhard', source: 'Reinhard et al. 2002, "Photographic tone reproduction for digital images", eq. 3, by channel', curve: (colour) => each(colour, (x) => x / (1 + Math.max(0, x))) },
  { id: 'aces', name: 'ACES, fitted', source: "Hill's fit of ACES 1.0 for sRGB (Microsoft MiniEngine, BakingLab)", curve: (colour) => times(ACES_OUT, each(times(ACES_IN, each(colour, (x) => Math.max(0, x))), acesFit)) },
  { id: 'agx', name: 'AgX', source: "Sobotka's AgX as of Blender and Filament, curve fitted by Wrensch 2023", curve: agx },
  { id: 'neutral', name: 'Khronos neutral', source: 'Khronos PBR Neutral Tone Mapper, 2024', curve: neutral },
];

/** The tone curve of this name; the linear one where there is none. */
export const toneOf = (id: string): Tone => TONES.find((tone) => tone.id === id) ?? (TONES[0] as Tone);
