/** A table with a line of heads, which scrolls sideways where it is wider than its place. */

import type { ComponentChildren } from 'preact';

export interface TableProps {
  /** What it shows, for screen readers. */
  name: string;
  /** Heads of the first columns, whose cells are words. */
  words: string[];
  /** Heads of the columns behind them, whose cells are numbers. */
  numbers: string[];
  /** Whether the first head is for screen readers alone. */
  isFirstHidden?: boolean;
  /** Rows. */
  children: ComponentChildren;
}

export function Table({ name, words, numbers, isFirstHidden = false, children }: TableProps) {
  return (
    <div class="scroll" role="region" tabIndex={0} aria-label={`${name}, a table`}>
      <table aria-label={name}>
        <thead>
          <tr>
            {words.map((head, i) => (
              <th key={head} scope="col">
                {i === 0 && isFirstHidden ? <span class="hidden-visually">{head}</span> : head}
              </th>
            ))}
            {numbers.map((head) => (
              <th key={head} scope="col" class="number">
                {head}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>{children}</tbody>
      </table>
    </div>
  );
}
