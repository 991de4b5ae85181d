/** Value, density and weight at one direction, and the albedo over all of them. */

import { RADIANS } from '../../core/directions';
import type { Answer } from '../../core/ask';
import { Plot, type Series } from '../../ui/plot';
import { Table } from '../../ui/table';
import type { Layer } from './answers';
import { albedoCurves, type Curve, figure } from './curves';
import { type Channels, lightIndex, type LobesState, type Slot, viewAngle } from './state';

/** The table of values at the light. */
export function Values({ state, layers, slices }: { state: LobesState; layers: Layer[]; slices: Record<Slot, Answer<'lobes.slice'> | undefined> }) {
  const i = lightIndex(state);
  return (
    <Table name="Values at the light" words={['Lobe']} numbers={['f cos: red, green, blue (1/sr)', 'pdf (1/sr)', 'Weight: red, green, blue']}>
      {layers.map(({ slot, letter }) => {
        const arrays = slices[slot]?.arrays;
        if (arrays === undefined) return null;
        const value = [0, 1, 2].map((k) => arrays.f_cos.values[3 * i + k] as number);
        const pdf = arrays.pdf.values[i] as number;
        return (
          <tr key={slot}>
            <th scope="row">{letter}</th>
            <td class="number list">{value.map(figure).join(', ')}</td>
            <td class="number">{figure(pdf)}</td>
            <td class="number list">{pdf > 0 ? value.map((v) => figure(v / pdf)).join(', ') : 'none'}</td>
          </tr>
        );
      })}
    </Table>
  );
}

/** The curves over an even axis. */
export function Cartesian(props: { title: string; axis: string; degrees: Float64Array; curves: Curve[]; isLogarithmic: boolean; isWhole: boolean; light: number }) {
  const end = props.isWhole ? 180 : 90;
  const [from, to] = [props.degrees.findIndex((d) => d >= -end), props.degrees.findLastIndex((d) => d <= end) + 1];
  const x = props.degrees.subarray(from, to);
  const series: Series[] = props.curves.map(({ name, colour, dash, values }) => ({ name, colour, ...(dash === undefined ? {} : { dash }), x, y: values.subarray(from, to) }));
  return (
    <Plot
      title={props.title}
      x="angle from the normal (degrees), mirror's side positive"
      y={props.axis}
      series={series}
      xRange={[-end, end]}
      isLogarithmic={props.isLogarithmic}
      {...(Math.abs(props.light) <= end ? { markX: props.light } : {})}
    />
  );
}

/** Directional albedo over the view's cosine; 1 is the white furnace. */
export function Albedo(props: { state: LobesState; layers: Layer[]; albedos: Record<Slot, Answer<'lobes.albedo'> | undefined> }) {
  const { state, layers, albedos } = props;
  const cos = layers.map((layer) => albedos[layer.slot]?.arrays.cos.values).find((values) => values !== undefined);
  const curves = albedoCurves(layers, albedos, state.channels as Channels);
  const series: Series[] = curves.map(({ slot, name, colour, dash, values, error }) => ({
    name,
    colour,
    ...(dash === undefined ? {} : { dash }),
    x: albedos[slot]?.arrays.cos.values ?? [],
    y: values,
    ...(error === undefined ? {} : { error }),
  }));
  const furnace: Series = { name: 'white furnace', colour: 'var(--quiet)', isDashed: true, x: [0, 1], y: [1, 1] };
  const top = curves.reduce((most, curve) => curve.values.reduce((a, b) => Math.max(a, b), most), 1);
  const mark = Math.sin((90 - Math.abs(viewAngle(state))) * RADIANS);
  if (cos === undefined) return null;
  return (
    <div>
      <Plot title="Albedo over the view" x="cosine of the view" y="albedo" series={[...series, furnace]} xRange={[0, 1]} yRange={[0, Math.max(1.05, top * 1.03)]} {...(mark >= 0 ? { markX: mark } : {})} />
      <p class="quiet">Mean weight of the lobe's own samples, views in the x-z plane. Bands: two standard deviations of the mean.</p>
    </div>
  );
}
