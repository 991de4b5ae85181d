/** Texts to begin with: a correct one, and famous mistakes. */

import ggx from './ggx.wgsl';
import library from './library.wgsl';

export interface Preset {
  id: string;
  name: string;
  /** What is wrong with it. */
  doc: string;
  text: string;
}

function changed(from: string, to: string): string {
  if (!ggx.includes(from)) throw new Error(`the example has no '${from}'`);
  return ggx.replace(from, to);
}

export const PRESETS: Preset[] = [
  { id: 'ggx', name: 'GGX, correct', doc: 'Visible normals by spherical caps, one bounce.', text: ggx },
  {
    id: 'no-g1',
    name: 'pdf without its G1',
    doc: 'The density is that of all normals, not of the visible ones.',
    text: changed('masking(wo) * distribution(m) * dot(wo, m) / wo.z', 'distribution(m) * dot(wo, m) / wo.z'),
  },
  {
    id: 'no-jacobian',
    name: 'Jacobian dropped',
    doc: 'The density is of normals, not of directions: 1 / (4 wo . m) is missing.',
    text: changed('return visible / (4.0 * dot(wo, m));', 'return visible;'),
  },
  {
    id: 'alpha-twice',
    name: 'Alpha squared twice',
    doc: 'The sampler takes alpha for a roughness, and squares it.',
    text: changed('let alpha = parameters.xy;', 'let alpha = parameters.xy * parameters.xy;'),
  },
  {
    id: 'one-sided',
    name: 'Not reciprocal',
    doc: "The reflectance is at the view's angle to the surface, not to the facet.",
    text: changed('return reflectance(dot(wo, m))', 'return reflectance(wo.z)'),
  },
  {
    id: 'gain',
    name: 'Energy gained',
    doc: 'A 2 in place of the 4: the lobe reflects twice what it may.',
    text: changed('/ (4.0 * wo.z)', '/ (2.0 * wo.z)'),
  },
  {
    id: 'not-finite',
    name: 'Not a number at the horizon',
    doc: 'A square root of what is below 0 near the horizon.',
    text: changed('return reflectance(dot(wo, m))', 'return sqrt(wi.z - 1e-3) * 1.001 * reflectance(dot(wo, m))'),
  },
  { id: 'library', name: "The library's bounded caps", doc: 'Calls functions of the exported shaders.', text: library },
];
