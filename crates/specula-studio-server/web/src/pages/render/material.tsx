/** The material of a surface: its text, and a slider for each of its numbers. */

import { Select, Slider, TextField } from '../../ui/controls';
import type { RenderOpenValue } from '../../core/protocol';
import { countOf, editsKey, editsOf, LETTERS, type Letter, type RenderState, type Set, withEdit } from './state';

type Material = RenderOpenValue['materials'][number];

/** Texts to begin with. */
const EXAMPLES = ['conductor Au alpha 0.2', 'conductor Cu alpha 0.5 0.1', 'conductor 0.9 alpha 0.3', 'dielectric 1.5 alpha 0.1', 'diffuse 0.8 0.2 0.1', 'coateddiffuse 0.2 0.4 0.7 eta 1.5 alpha 0.1', 'coatedconductor Al eta 1.5 alpha 0.2'];
/** Ranges of numbers after a word. */
const RANGES: Record<string, { min: number; max: number; isLogarithmic: boolean }> = {
  alpha: { min: 0.001, max: 1, isLogarithmic: true },
  roughness: { min: 0, max: 1, isLogarithmic: false },
  eta: { min: 1, max: 3, isLogarithmic: false },
  dielectric: { min: 1, max: 3, isLogarithmic: false },
};
const SHARE = { min: 0, max: 1, isLogarithmic: false };

interface Numbered {
  /** Its place among the words. */
  at: number;
  value: number;
  label: string;
  word: string;
}

/** The numbers of a text, by the word that they follow. */
function numbersIn(text: string): Numbered[] {
  const words = text.split(/\s+/);
  const found: Numbered[] = [];
  let [word, first] = ['', 0];
  words.forEach((w, at) => {
    if (/^[a-z]/i.test(w)) [word, first] = /^[A-Z]/.test(w) ? [word, at + 1] : [w, at + 1];
    else if (w !== '' && Number.isFinite(Number(w))) found.push({ at, value: Number(w), label: String(at - first), word });
  });
  return found.map((number) => {
    const count = found.filter((other) => other.word === number.word).length;
    const isColour = count === 3 && RANGES[number.word] === undefined;
    const part = count === 1 ? '' : isColour ? ` ${['red', 'green', 'blue'][Number(number.label)]}` : ` ${'xyz'[Number(number.label)]}`;
    const name = RANGES[number.word] === undefined ? 'reflectance' : number.word === 'dielectric' ? 'eta' : number.word;
    return { ...number, label: `${name}${part}` };
  });
}

export function MaterialControls(props: { state: RenderState; set: Set; materials: Material[]; picked: number | undefined; onPick: (id: number | undefined) => void; of: Letter | 'all'; onOf: (of: Letter | 'all') => void }) {
  const { state, set, materials, picked, onPick, of, onOf } = props;
  const chosen = materials.find((m) => m.id === picked);
  const key = editsKey(of);
  const compared = LETTERS.slice(0, countOf(state));
  const edited = (text: string) => editsOf(text).find((e) => e.material === picked)?.text;
  const text = edited(state[key]) ?? edited(state.edits) ?? chosen?.text ?? '';
  const change = (now: string) => {
    if (chosen !== undefined) set({ [key]: withEdit(state[key], chosen.id, now.replace(/;/g, ' ')) });
  };
  return (
    <>
      <h3>Materials</h3>
      <p class="quiet">Click a surface in the picture to choose its material.</p>
      <Select label="Material" value={String(picked ?? '')} options={[{ value: '', label: 'none' }, ...materials.map((m) => ({ value: String(m.id), label: `${m.name} (${m.kind})` }))]} onChange={(id) => onPick(id === '' ? undefined : Number(id))} />
      {chosen !== undefined && (
        <>
          {compared.length > 1 && (
            <Select label="Changes are of" value={of} options={[{ value: 'all', label: 'all treatments' }, ...compared.map((letter) => ({ value: letter, label: `${letter} alone` }))]} onChange={(now) => onOf(now as Letter | 'all')} />
          )}
          <TextField label="As text" hint="conductor Au alpha 0.3; empty: the scene's own" value={text} onEnter={change} />
          <Select label="Another" value="" options={[{ value: '', label: 'choose' }, ...EXAMPLES.map((example) => ({ value: example, label: example }))]} onChange={(example) => example !== '' && change(example)} />
          <Sliders text={text} onChange={change} />
          {edited(state[key]) !== undefined && (
            <button type="button" onClick={() => change('')}>
              {of === 'all' ? "The scene's own" : 'As in all'}
            </button>
          )}
        </>
      )}
    </>
  );
}

function Sliders({ text, onChange }: { text: string; onChange: (text: string) => void }) {
  const words = text.split(/\s+/);
  return (
    <>
      {numbersIn(text).map(({ at, value, label, word }) => {
        const { min, max, isLogarithmic } = RANGES[word] ?? SHARE;
        const isWithin = value >= min && value <= max;
        return isWithin ? <Slider key={`${at} ${label}`} label={label} value={value} min={min} max={max} isLogarithmic={isLogarithmic} onInput={(x) => onChange(words.map((w, i) => (i === at ? String(x) : w)).join(' '))} /> : null;
      })}
    </>
  );
}
