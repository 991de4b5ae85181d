/** A colour in linear sRGB: the browser's chooser, and its numbers. */

import { TextField } from '../../ui/controls';
import { numbersOf, numbersText } from './text';

/** Linear in [0, 1] to sRGB. */
export function encoded(x: number): number {
  const c = Math.min(1, Math.max(0, x));
  return c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
}

/** sRGB in [0, 1] to linear. */
export function decoded(x: number): number {
  return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
}

function hex(text: string): string {
  const bytes = numbersOf(text, 3).map((x) => Math.round(255 * encoded(x)));
  return `#${bytes.map((b) => b.toString(16).padStart(2, '0')).join('')}`;
}

function linear(colour: string): string {
  const bytes = [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16));
  return numbersText(bytes.map((b) => Number(decoded(b / 255).toPrecision(4))));
}

export function ColourField(props: { label: string; text: string; onChange: (text: string) => void }) {
  return (
    <div class="colour-field">
      <input type="color" aria-label={`${props.label}: choose`} value={hex(props.text)} onInput={(event) => props.onChange(linear(event.currentTarget.value))} />
      <TextField
        label={props.label}
        value={props.text}
        hint="Linear sRGB: three numbers, or one for a grey"
        onEnter={(text) => {
          const numbers = text.split(/[\s,]+/).map(Number);
          if ((numbers.length === 1 || numbers.length === 3) && numbers.every(Number.isFinite)) props.onChange(numbersText(numbers));
        }}
      />
    </div>
  );
}
