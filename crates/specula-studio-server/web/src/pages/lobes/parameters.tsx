/** Controls of a lobe, made from the parameters of its kind. */

import type { LobeKind, LobesKindsValue, Parameter } from '../../core/protocol';
import { Choice, Select, Slider, Toggle } from '../../ui/controls';
import { ColourField } from './colour_field';
import { type LobeForm, numbersOf, numbersText, withKind, withValue } from './text';

/** Ranges of sliders where the library's have no end, or are too wide to be of use. */
const RANGES: Record<string, [number, number]> = {
  eta: [0.4, 3],
  ior: [0, 3],
  thickness: [0, 4],
  max_depth: [0, 32],
  alpha: [0.001, 2],
  base_alpha: [0.001, 2],
};

export interface ParametersProps {
  form: LobeForm;
  found: LobesKindsValue;
  onChange: (form: LobeForm) => void;
}

export function Parameters({ form, found, onChange }: ParametersProps) {
  const { kind, given } = form;
  const isMain = (p: Parameter) => p.default !== null || given[p.key] !== undefined || p.type === 'alpha' || p.key === 'energy';
  const parts = (parameters: Parameter[]) =>
    parameters.map((parameter) => (
      <Control key={parameter.key} parameter={parameter} form={form} found={found} set={(value) => onChange(withValue(form, parameter.key, value))} />
    ));
  const others = kind.parameters.filter((p) => !isMain(p));
  return (
    <div>
      <Select
        label="Kind"
        options={found.kinds.map((k: LobeKind) => ({ value: k.name, label: k.name }))}
        value={kind.name}
        onChange={(name) => {
          const next = found.kinds.find((k) => k.name === name);
          if (next !== undefined) onChange(withKind(form, next));
        }}
      />
      <p class="quiet">{kind.doc}</p>
      {parts(kind.parameters.filter(isMain))}
      {others.length > 0 && (
        <details>
          <summary>More parameters</summary>
          {parts(others)}
        </details>
      )}
    </div>
  );
}

interface ControlProps {
  parameter: Parameter;
  form: LobeForm;
  found: LobesKindsValue;
  /** `undefined`: not given. */
  set: (value: string | undefined) => void;
}

const words = (key: string) => key.replaceAll('_', ' ');

function Control({ parameter, form, found, set }: ControlProps) {
  const { key, type, default: usual, doc } = parameter;
  const given = form.given[key];
  const mustBe = doc.includes('must be given');
  const isOptional = usual === null && !mustBe && type !== 'choice';
  const start = usual ?? (type === 'alpha' ? '0.3' : type === 'count' ? '8' : '0.5');
  return (
    <div class="parameter">
      {isOptional && <Toggle label={words(key)} value={given !== undefined} hint={doc} onChange={(isGiven) => set(isGiven ? start : undefined)} />}
      {(!isOptional || given !== undefined) && <Value parameter={parameter} text={given ?? start} isGiven={given !== undefined} found={found} set={set} />}
      <p class="doc">{doc}</p>
    </div>
  );
}

interface ValueProps {
  parameter: Parameter;
  text: string;
  isGiven: boolean;
  found: LobesKindsValue;
  set: (value: string | undefined) => void;
}

function Value({ parameter, text, isGiven, found, set }: ValueProps) {
  const { key, type, doc } = parameter;
  const label = words(key);
  switch (type) {
    case 'number':
    case 'count': {
      const value = Number(text);
      const [min, max] = range(parameter, [value]);
      return <Slider label={label} hint={doc} value={value} min={min} max={max} isInteger={type === 'count'} onInput={(x) => set(numbersText([x]))} />;
    }
    case 'alpha':
      return <AlphaValue parameter={parameter} text={text} set={set} />;
    case 'colour':
      return <ColourField label={label} text={text} onChange={set} />;
    case 'choice':
      return <ChoiceValue parameter={parameter} text={text} isGiven={isGiven} set={set} />;
    case 'flag':
      return <Toggle label={label} value={text === 'true'} onChange={(is) => set(String(is))} />;
    case 'metal':
      return <MetalValue label={label} text={text} found={found} set={set} />;
  }
}

function range({ key, low = 0, high }: Parameter, values: number[]): [number, number] {
  const [min, max] = RANGES[key] ?? [low, high ?? 1];
  return [Math.max(low, Math.min(min, ...values)), Math.min(high ?? Infinity, Math.max(max, ...values))];
}

function AlphaValue({ parameter, text, set }: { parameter: Parameter; text: string; set: (value: string) => void }) {
  const [x, y] = numbersOf(text, 2) as [number, number];
  const isTwo = text.includes(',');
  const [min, max] = range(parameter, [x, y]);
  const label = words(parameter.key);
  // Two equal alphas stay two while the toggle says so.
  const two = (a: number, b: number) => set(a === b ? `${numbersText([a])},${numbersText([b])}` : numbersText([a, b]));
  return (
    <div>
      <Slider label={isTwo ? `${label} x` : label} value={x} min={min} max={max} isLogarithmic onInput={(a) => (isTwo ? two(a, y) : set(numbersText([a])))} />
      {isTwo && <Slider label={`${label} y`} value={y} min={min} max={max} isLogarithmic onInput={(b) => two(x, b)} />}
      <Toggle label={parameter.key === 'alpha' ? 'Anisotropic' : `Anisotropic ${label}`} value={isTwo} onChange={(now) => (now ? two(x, Number((x / 3).toPrecision(3))) : set(numbersText([x])))} />
    </div>
  );
}

function ChoiceValue({ parameter, text, isGiven, set }: { parameter: Parameter; text: string; isGiven: boolean; set: (value: string | undefined) => void }) {
  const label = words(parameter.key);
  const none = { value: '', label: 'none' };
  const options = (parameter.choices ?? []).map((choice) => ({ value: choice, label: choice }));
  const all = parameter.default === null ? [none, ...options] : options;
  const value = parameter.default === null && !isGiven ? '' : text;
  const change = (chosen: string) => set(chosen === '' ? undefined : chosen);
  const isShort = all.length <= 3 && all.map((o) => o.label).join('').length < 22;
  return isShort ? <Choice label={label} options={all} value={value} onChange={change} /> : <Select label={label} options={all} value={value} onChange={change} />;
}

function MetalValue({ label, text, found, set }: { label: string; text: string; found: LobesKindsValue; set: (value: string) => void }) {
  const isMetal = /^[A-Z]/.test(text);
  const metals = found.metals.map(({ symbol, name }) => ({ value: symbol, label: `${symbol}: ${name}` }));
  return (
    <div>
      <Select label={label} options={[{ value: '', label: 'constant colour' }, ...metals]} value={isMetal ? text : ''} onChange={(chosen) => set(chosen === '' ? '1' : chosen)} />
      {!isMetal && <ColourField label={`${label}, colour`} text={text} onChange={set} />}
    </div>
  );
}
