/** The text form of lobes: read where it is in its normal form, written from values by key, changed by rules. */

import type { LobeKind, Parameter } from '../../core/protocol';

/** A lobe as a kind and what is given of it, values as in the text form. */
export interface LobeForm {
  kind: LobeKind;
  given: Record<string, string>;
}

/** Reads a text whose values are one word each; `undefined`: the library must read it. */
export function readText(text: string, kinds: LobeKind[]): LobeForm | undefined {
  const words = text.trim().split(/\s+/);
  const kind = kinds.find((k) => k.name === words[0]);
  if (kind === undefined) return undefined;
  const given: Record<string, string> = {};
  let at = 1;
  const metal = kind.parameters.find((p) => p.type === 'metal');
  if (metal !== undefined && /^[A-Z]/.test(words[1] ?? '')) {
    given[metal.key] = words[1] as string;
    at = 2;
  }
  for (; at < words.length; at += 2) {
    const [key, value] = [words[at] as string, words[at + 1]];
    const parameter = kind.parameters.find((p) => p.key === key);
    if (parameter === undefined || value === undefined || key in given || !fits(parameter, value)) return undefined;
    given[key] = value;
  }
  return { kind, given };
}

function fits(parameter: Parameter, value: string): boolean {
  const numbers = value.split(',').map(Number);
  const areNumbers = value !== '' && numbers.every(Number.isFinite);
  switch (parameter.type) {
    case 'number':
    case 'count':
      return areNumbers && numbers.length === 1;
    case 'alpha':
      return areNumbers && numbers.length <= 2;
    case 'colour':
      return areNumbers && (numbers.length === 1 || numbers.length === 3);
    case 'metal':
      return /^[A-Z]/.test(value) || (areNumbers && (numbers.length === 1 || numbers.length === 3));
    case 'choice':
      return parameter.choices?.includes(value) === true;
    case 'flag':
      return value === 'true' || value === 'false';
  }
}

/** The text of a form, in its normal form: what is as by default is left out. */
export function writeText({ kind, given }: LobeForm): string {
  const metals: string[] = [];
  const pairs: string[] = [];
  for (const { key, type, default: usual } of kind.parameters) {
    const value = given[key];
    // A tint needs its reflectance beside it.
    if (value === undefined || (value === usual && !(type === 'metal' && given['tint'] !== undefined))) continue;
    if (type === 'metal' && /^[A-Z]/.test(value)) metals.push(value);
    else pairs.push(`${key} ${value}`);
  }
  return [kind.name, ...metals, ...pairs].join(' ');
}

/** Numbers as the text form has them: equal ones are one. */
export function numbersText(values: number[]): string {
  const short = values.map((x) => plain(Number(x.toPrecision(6))));
  return short.every((x) => x === short[0]) ? (short[0] ?? '0') : short.join(',');
}

/** A number without an exponent. */
function plain(x: number): string {
  const text = String(x);
  return text.includes('e') ? x.toFixed(12).replace(/\.?0+$/, '') : text;
}

/** The numbers of a value; of a grey, all three. */
export function numbersOf(text: string, count: number): number[] {
  const numbers = text.split(',').map(Number);
  return Array.from({ length: count }, (_, i) => numbers[Math.min(i, numbers.length - 1)] ?? 0);
}

/** Ways to say a reflectance; one excludes the others. */
const REFLECTANCES = [['reflectance'], ['conductor_eta', 'conductor_k'], ['f0', 'f82_tint']];
/** What a value is given with, where it may not stand alone. */
const TOGETHER: Record<string, Record<string, string>> = {
  conductor_eta: { conductor_k: '3' },
  conductor_k: { conductor_eta: '1' },
  f82_tint: { f0: '0.8' },
};


/** A form with a value changed; `undefined`: taken back. What cannot stand beside it goes, what it needs comes. */
export function withValue({ kind, given }: LobeForm, key: string, value: string | undefined): LobeForm {
  const changed = { ...given };
  if (value === undefined) {
    delete changed[key];
    const group = REFLECTANCES.find((keys) => keys[0] === key || (key === 'conductor_k' && keys.includes(key)));
    for (const other of group ?? []) delete changed[other];
    return { kind, given: changed };
  }
  changed[key] = value;
  const hasMetals = kind.parameters.some((p) => p.type === 'metal');
  if (hasMetals && key === 'tint' && !REFLECTANCES.some(([first]) => first !== undefined && first in changed)) changed['reflectance'] = '1';
  if (hasMetals && REFLECTANCES.some((keys) => keys.includes(key))) {
    for (const keys of REFLECTANCES) if (!keys.includes(key)) for (const other of keys) delete changed[other];
    for (const [other, usual] of Object.entries(TOGETHER[key] ?? {})) changed[other] ??= usual;
  }
  return { kind, given: changed };
}

/** A form of another kind: keeps what both understand. */
export function withKind(form: LobeForm | undefined, kind: LobeKind): LobeForm {
  const given: Record<string, string> = {};
  for (const parameter of kind.parameters) {
    const value = form?.given[parameter.key];
    if (value !== undefined && fits(parameter, value)) given[parameter.key] = value;
    else if (parameter.doc.includes('must be given')) given[parameter.key] = '0.3';
  }
  if (kind.name === 'layered' && given['albedo'] === undefined && given['reflectance'] === undefined) given['albedo'] = '0.5';
  return { kind, given };
}

/** A rough metal with each treatment of the energy that one bounce loses; `undefined`: not a rough metal. */
export function energyTreatments(form: LobeForm, kinds: LobeKind[]): string[] | undefined {
  const single = kinds.find((k) => k.name === 'conductor');
  const simulated = kinds.find((k) => k.name === 'multibounce-conductor');
  const isMetal = form.kind === single || form.kind === simulated;
  if (!isMetal || single === undefined || simulated === undefined) return undefined;
  const base = withKind(form, single);
  const energies = [undefined, 'turquin', 'kulla-conty'].map((energy) => writeText(withValue(base, 'energy', energy)));
  return [...energies, writeText(withKind(form, simulated))];
}

/** The kind that simulates the bounces of a form's, with its parameters; `undefined`: there is none. */
export function simulatedText(form: LobeForm, kinds: LobeKind[]): string | undefined {
  const kind = kinds.find((k) => k.name === `multibounce-${form.kind.name}`);
  return kind === undefined ? undefined : writeText(withKind(form, kind));
}
