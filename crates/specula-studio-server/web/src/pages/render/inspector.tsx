/** What is in a pixel: of every render its value, luminance and standard deviation. */

import { luminance } from '../../core/colour';
import type { Rgb } from '../../core/protocol';
import { Panel, Slider } from '../../ui/controls';
import { formatAlike } from '../../ui/plot';
import { Table } from '../../ui/table';
import { LETTERS } from './layers';
import type { Turn } from './render';

export interface InspectorProps {
  turns: Turn[];
  reference: Turn | undefined;
  /** Column and row, from the top left. */
  pixel: [number, number];
  isHovered: boolean;
  onPixel: (pixel: [number, number]) => void;
}

/** Of a picture's array, the pixel's colour. */
function at(values: Float32Array | undefined, width: number, [x, y]: [number, number]): Rgb | undefined {
  const i = 3 * (y * width + x);
  return values === undefined || i + 2 >= values.length ? undefined : [values[i] as number, values[i + 1] as number, values[i + 2] as number];
}

export function Inspector({ turns, reference, pixel, isHovered, onPixel }: InspectorProps) {
  const opened = turns[0]?.opened;
  const [width, height] = [opened?.width ?? 1, opened?.height ?? 1];
  const rows: [string, Turn][] = turns.map((turn, i) => [LETTERS[i] as string, turn]);
  if (reference !== undefined) rows.push(['Reference', reference]);
  const place: [number, number] = [Math.min(width - 1, Math.max(0, Math.round(pixel[0]))), Math.min(height - 1, Math.max(0, Math.round(pixel[1])))];
  return (
    <Panel title="Pixel">
      <Slider label="Column" value={place[0]} min={0} max={width - 1} steps={Math.max(1, width - 1)} isInteger onInput={(x) => onPixel([x, place[1]])} />
      <Slider label="Row" value={place[1]} min={0} max={height - 1} steps={Math.max(1, height - 1)} isInteger onInput={(y) => onPixel([place[0], y])} />
      <Table name="Values of the pixel" words={['Render']} numbers={['Red', 'Green', 'Blue', 'Luminance', 'Deviation']} isFirstHidden>
        {rows.map(([name, { colour, variance, state }]) => {
          const value = at(colour, width, place);
          const spread = at(variance, width, place);
          if (value === undefined || state === undefined) return null;
          return (
            <tr key={name} data-pixel={name}>
              <th scope="row">{name}</th>
              {[...value, luminance(value)].map((v, k) => (
                <td key={k} class="number">
                  {formatAlike(v, 3)}
                </td>
              ))}
              <td class="number">{spread === undefined || state.samples < 2 ? '' : formatAlike(luminance(spread.map(Math.sqrt) as Rgb), 2)}</td>
            </tr>
          );
        })}
      </Table>
      <p class="quiet">{isHovered ? 'Below the pointer.' : 'The pixel that was clicked, or chosen here.'} Linear sRGB; the deviation is the standard deviation of the mean luminance, estimated from the samples.</p>
    </Panel>
  );
}
