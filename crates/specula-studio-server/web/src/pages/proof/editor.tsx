/** A text with the numbers of its lines; lines with faults are marked. */

import { useEffect, useRef } from 'preact/hooks';
import type { Fault } from './prover';

export interface EditorProps {
  text: string;
  faults: Fault[];
  onText: (text: string) => void;
}

export function Editor({ text, faults, onText }: EditorProps) {
  const area = useRef<HTMLTextAreaElement>(null);
  const gutter = useRef<HTMLPreElement>(null);
  const count = text.split('\n').length;
  const marked = new Set(faults.map((fault) => fault.line));
  const follow = () => {
    if (area.current !== null && gutter.current !== null) gutter.current.scrollTop = area.current.scrollTop;
  };
  useEffect(follow, [text]);
  const goTo = (line: number) => {
    const element = area.current;
    if (element === null) return;
    const before = text.split('\n').slice(0, line - 1);
    const start = before.reduce((sum, l) => sum + l.length + 1, 0);
    element.focus();
    element.setSelectionRange(start, start + (text.split('\n')[line - 1] ?? '').length);
    element.scrollTop = Math.max(0, (line - 6) * Number.parseFloat(getComputedStyle(element).lineHeight));
  };
  return (
    <div>
      <div class="editor">
        <pre ref={gutter} aria-hidden="true">
          {Array.from({ length: count }, (_, i) => (
            <span key={i} class={marked.has(i + 1) ? 'bad' : undefined}>{`${marked.has(i + 1) ? '▸' : ''}${i + 1}\n`}</span>
          ))}
        </pre>
        <textarea
          ref={area}
          class="code"
          aria-label="BSDF in WGSL"
          aria-invalid={faults.length > 0}
          aria-describedby={faults.length > 0 ? 'proof-faults' : undefined}
          spellcheck={false}
          autocomplete="off"
          wrap="off"
          value={text}
          onInput={(event) => onText(event.currentTarget.value)}
          onScroll={follow}
        />
      </div>
      {faults.length > 0 && (
        <ul id="proof-faults" class="faults" role="alert" aria-label="Faults of the text">
          {faults.map((fault, i) => (
            <li key={i}>
              {fault.line !== undefined && (
                <button type="button" onClick={() => goTo(fault.line as number)}>
                  Line {fault.line}
                </button>
              )}{' '}
              <code>{fault.text}</code>
            </li>
          ))}
        </ul>
      )}
    </div>
  );
}
