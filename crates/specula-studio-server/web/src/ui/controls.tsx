/** Controls of pages: native inputs with labels, usable by keyboard and screen readers. */

import type { ComponentChildren } from 'preact';
import { useId, useRef, useState } from 'preact/hooks';

/** What is typed into a field, until the field's value is another than the one that it was typed over. */
export function useTyped<T>(value: T): [typed: string | undefined, type: (text: string | undefined, over: T) => void] {
  // Without effects: they come after what may have been typed already.
  const kept = useRef<{ text: string; over: T } | undefined>(undefined);
  const [, setCount] = useState(0);
  if (kept.current !== undefined && kept.current.over !== value) kept.current = undefined;
  const type = (text: string | undefined, over: T) => {
    kept.current = text === undefined ? undefined : { text, over };
    setCount((n) => n + 1);
  };
  return [kept.current?.text, type];
}

export interface SliderProps {
  label: string;
  value: number;
  min: number;
  max: number;
  /** Steps of the slider over its range; numbers typed may be any. */
  steps?: number;
  /** Even steps of the logarithm. */
  isLogarithmic?: boolean;
  isInteger?: boolean;
  unit?: string;
  hint?: string;
  disabled?: boolean;
  onInput: (value: number) => void;
}

/** A number: a slider, and a field to type it. */
export function Slider(props: SliderProps) {
  const { label, value, min, max, steps = 1000, isLogarithmic = false, isInteger = false, unit, hint, disabled = false, onInput } = props;
  const id = useId();
  const toShare = (x: number) => (isLogarithmic ? Math.log(x / min) / Math.log(max / min) : (x - min) / (max - min));
  const ofShare = (t: number) => (isLogarithmic ? min * (max / min) ** t : min + t * (max - min));
  const rounded = (x: number) => (isInteger ? Math.round(x) : Number(x.toPrecision(4)));
  const text = String(rounded(value));
  const [typed, type] = useTyped(value);
  return (
    <div class="field" title={hint}>
      <label for={id}>
        {label}
        {unit !== undefined && <span class="quiet"> ({unit})</span>}
      </label>
      <input
        id={id}
        type="number"
        step="any"
        min={min}
        max={max}
        disabled={disabled}
        value={typed ?? text}
        onInput={(event) => {
          const x = event.currentTarget.valueAsNumber;
          const isValue = Number.isFinite(x) && x >= min && x <= max;
          const given = isInteger ? Math.round(x) : x;
          type(event.currentTarget.value, isValue ? given : value);
          if (isValue) onInput(given);
        }}
        onBlur={() => type(undefined, value)}
      />
      <input
        type="range"
        aria-label={label}
        aria-valuetext={unit === undefined ? text : `${text} ${unit}`}
        min={0}
        max={steps}
        step={1}
        disabled={disabled}
        value={Math.round(toShare(value) * steps)}
        onInput={(event) => onInput(rounded(ofShare(event.currentTarget.valueAsNumber / steps)))}
      />
    </div>
  );
}

export interface Option<T extends string> {
  value: T;
  label: string;
  hint?: string;
}

/** One of a few. */
export function Choice<T extends string>(props: { label: string; options: Option<T>[]; value: T; onChange: (value: T) => void }) {
  const name = useId();
  return (
    <fieldset class="choice">
      <legend>{props.label}</legend>
      <div class="options">
        {props.options.map((option) => (
          <label key={option.value} title={option.hint}>
            <input
              type="radio"
              name={name}
              value={option.value}
              checked={option.value === props.value}
              onChange={() => props.onChange(option.value)}
            />
            {option.label}
          </label>
        ))}
      </div>
    </fieldset>
  );
}

/** One of many. */
export function Select<T extends string>(props: { label: string; options: Option<T>[]; value: T; onChange: (value: T) => void; disabled?: boolean }) {
  const id = useId();
  return (
    <div class="field">
      <label for={id}>{props.label}</label>
      <select id={id} class="whole" disabled={props.disabled ?? false} value={props.value} onChange={(event) => props.onChange(event.currentTarget.value as T)}>
        {props.options.map((option) => (
          <option key={option.value} value={option.value}>
            {option.label}
          </option>
        ))}
      </select>
    </div>
  );
}

export function Toggle(props: { label: string; value: boolean; hint?: string; onChange: (value: boolean) => void }) {
  return (
    <label class="toggle" title={props.hint}>
      <input type="checkbox" checked={props.value} onChange={(event) => props.onChange(event.currentTarget.checked)} />
      {props.label}
    </label>
  );
}

/** A line of text; `onEnter` where it is committed by Enter or by leaving the field. */
export function TextField(props: { label: string; value: string; hint?: string; onEnter: (value: string) => void }) {
  const id = useId();
  const [typed, type] = useTyped(props.value);
  return (
    <div class="field" title={props.hint}>
      <label for={id}>{props.label}</label>
      <input
        id={id}
        class="whole"
        type="text"
        spellcheck={false}
        value={typed ?? props.value}
        onInput={(event) => type(event.currentTarget.value, props.value)}
        onChange={(event) => props.onEnter(event.currentTarget.value.trim())}
      />
    </div>
  );
}

/** A part of a page. */
export function Panel(props: { title: string; actions?: ComponentChildren; wide?: boolean; isPending?: boolean; children?: ComponentChildren }) {
  const id = useId();
  const classes = ['panel', props.wide === true ? 'wide' : '', props.isPending === true ? 'is-pending' : ''].join(' ').trim();
  return (
    <section class={classes} aria-labelledby={id} aria-busy={props.isPending === true}>
      <header>
        <h2 id={id}>{props.title}</h2>
        {props.actions !== undefined && <div class="actions">{props.actions}</div>}
      </header>
      {props.children}
    </section>
  );
}

/** What went wrong, in words. */
export function Message(props: { text: string | undefined }) {
  return props.text === undefined ? null : (
    <p class="message" role="alert">
      {props.text}
    </p>
  );
}

/** How far something is; `share` in [0, 1], undefined: unknown. */
export function Progress(props: { label: string; share?: number | undefined; seconds?: number | undefined }) {
  const left = props.share !== undefined && props.seconds !== undefined && props.share > 0.02 ? (props.seconds / props.share) * (1 - props.share) : undefined;
  return (
    <div>
      <span class="quiet">
        {props.label}
        {left !== undefined && `, ${left < 90 ? `${Math.ceil(left)} s` : `${Math.ceil(left / 60)} min`} left`}
      </span>
      <progress aria-label={props.label} max={1} {...(props.share === undefined ? {} : { value: props.share })} />
    </div>
  );
}
