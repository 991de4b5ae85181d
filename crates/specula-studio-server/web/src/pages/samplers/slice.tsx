/** Densities of the samplers beside the lobe that they sample, in the plane of incidence: figure 5 of the paper. */

import { RADIANS } from '../../core/directions';
import type { Answer } from '../../core/ask';
import type { Vec3 } from '../../core/protocol';
import { useAnswer } from '../../core/use_answer';
import { Message, Panel } from '../../ui/controls';
import { Plot, type Series } from '../../ui/plot';
import type { Setup } from './setup';

const COUNT = 361;

/** The values of one lobe in the plane. */
function useSlice(setup: Setup, words: string) {
  const { alpha, wo } = setup;
  const azimuth = Math.hypot(wo[0], wo[1]) < 1e-9 ? 0 : Math.atan2(wo[1], wo[0]);
  return useAnswer<'lobes.slice'>({ ask: 'lobes.slice', lobe: `conductor reflectance 1 alpha ${alpha[0]},${alpha[1]} ${words}`, wo: wo as Vec3, azimuth, count: COUNT });
}

/** Curves above the horizon, of what `value` takes from the answer. */
function curve(answer: Answer<'lobes.slice'>, value: (i: number) => number): Pick<Series, 'x' | 'y'> {
  const theta = answer.arrays.theta.values;
  const above = Array.from(theta, (_, i) => i).filter((i) => Math.abs(theta[i] as number) < Math.PI / 2);
  return { x: above.map((i) => (theta[i] as number) / RADIANS), y: above.map(value) };
}

export function Slice({ setup }: { setup: Setup }) {
  const pdfs = { 'Cap and Heitz, pdf': useSlice(setup, 'sampler cap'), 'Bounded, pdf': useSlice(setup, 'sampler bounded'), 'Exact, pdf': useSlice(setup, 'sampler exact') };
  const lobes = { 'Turquin, f cos': useSlice(setup, 'energy turquin'), 'Kulla-Conty, f cos': useSlice(setup, 'energy kulla-conty'), 'One bounce, f cos': pdfs['Cap and Heitz, pdf'] };
  const asked = [...Object.values(pdfs), ...Object.values(lobes)];
  const series: Series[] = [];
  for (const [name, { answer }] of Object.entries(pdfs)) {
    if (answer !== undefined) series.push({ name, colour: `var(--series-${series.length + 1})`, ...curve(answer, (i) => answer.arrays.pdf.values[i] as number) });
  }
  for (const [name, { answer }] of Object.entries(lobes)) {
    if (answer !== undefined) series.push({ name, colour: `var(--series-${series.length + 1})`, isDashed: true, ...curve(answer, (i) => answer.arrays.f_cos.values[3 * i] as number) });
  }
  return (
    <Panel title="Density and lobe in the plane of incidence" isPending={asked.some((a) => a.isPending)}>
      <Message text={asked.find((a) => a.error !== undefined)?.error} />
      {series.length > 0 && <Plot title="Densities of samplers and white lobes" x="angle of reflection, degrees" y="1/sr" series={series} xRange={[-90, 90]} />}
      <p class="quiet">As in figure 5 of Tokuyoshi and Eto 2024: white metal. Where a density is far below the lobe, weights are large.</p>
    </Panel>
  );
}
