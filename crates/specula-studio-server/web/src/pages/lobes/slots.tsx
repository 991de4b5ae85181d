/** The list of lobes that are laid over each other: their texts, and which one the controls change. */

import { useId } from 'preact/hooks';
import { useTyped } from '../../ui/controls';
import { seriesColour } from '../../ui/plot';
import { type LobesState, SLOTS, type Slot } from './state';

export interface SlotsProps {
  state: LobesState;
  active: Slot;
  errors: Record<Slot, string | undefined>;
  /** Texts of each energy treatment; `undefined`: the lobe has none. */
  treatments: string[] | undefined;
  set: (change: Partial<LobesState>) => void;
}

/** The colour of a lobe by its place. */
export function slotColour(slot: Slot): string {
  return seriesColour(SLOTS.indexOf(slot));
}

export function Slots({ state, active, errors, treatments, set }: SlotsProps) {
  const used = SLOTS.filter((slot) => state[slot] !== '');
  const free = SLOTS.find((slot) => state[slot] === '');
  const remove = (slot: Slot) => set({ [slot]: '', slot: slot === active ? (used.find((other) => other !== slot) ?? 'a') : active });
  return (
    <div>
      <h1>Lobes</h1>
      {used.map((slot) => (
        <SlotRow
          key={slot}
          slot={slot}
          text={state[slot]}
          error={errors[slot]}
          isActive={slot === active}
          onChoose={() => set({ slot })}
          onText={(text) => set({ [slot]: text, slot })}
          {...(used.length > 1 ? { onRemove: () => remove(slot) } : {})}
        />
      ))}
      <div class="actions">
        <button type="button" disabled={free === undefined} onClick={() => free !== undefined && set({ [free]: state[active], slot: free })}>
          Add a lobe
        </button>
        <button
          type="button"
          disabled={treatments === undefined}
          title="None, Turquin, Kulla-Conty, and the simulated bounces, laid over each other"
          onClick={() => {
            const [a = '', b = '', c = '', d = ''] = treatments ?? [];
            set({ a, b, c, d, slot: 'a' });
          }}
        >
          Compare energy treatments
        </button>
      </div>
    </div>
  );
}

interface RowProps {
  slot: Slot;
  text: string;
  error: string | undefined;
  isActive: boolean;
  onChoose: () => void;
  onText: (text: string) => void;
  onRemove?: () => void;
}

function SlotRow({ slot, text, error, isActive, onChoose, onText, onRemove }: RowProps) {
  const id = useId();
  const letter = slot.toUpperCase();
  const [typed, type] = useTyped(text);
  const enter = () => {
    const now = (typed ?? text).trim().replace(/\s+/g, ' ');
    if (now === '') type(undefined, text);
    else if (now !== text) onText(now);
  };
  return (
    <div class="lobe-slot" data-active={isActive}>
      <header>
        <label>
          <input type="radio" name="lobe-slot" checked={isActive} onChange={onChoose} aria-label={`Controls change lobe ${letter}`} />
          <span class="lobe-key" style={{ borderTopColor: slotColour(slot) }} />
          {letter}
        </label>
        {onRemove !== undefined && (
          <button type="button" aria-label={`Remove lobe ${letter}`} onClick={onRemove}>
            Remove
          </button>
        )}
      </header>
      <label class="hidden-visually" for={id}>
        Text of lobe {letter}
      </label>
      <textarea
        id={id}
        class="code"
        rows={1}
        spellcheck={false}
        autocomplete="off"
        value={typed ?? text}
        aria-invalid={error !== undefined}
        aria-describedby={error === undefined ? undefined : `${id}-error`}
        onFocus={() => !isActive && onChoose()}
        onInput={(event) => type(event.currentTarget.value, text)}
        onChange={enter}
        onKeyDown={(event) => {
          if (event.key !== 'Enter') return;
          event.preventDefault();
          enter();
        }}
      />
      {error !== undefined && (
        <p class="message" role="alert" id={`${id}-error`}>
          {error}
        </p>
      )}
    </div>
  );
}
