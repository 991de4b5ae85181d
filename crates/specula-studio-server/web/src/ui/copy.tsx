/** A button that copies a text, and says whether it could. */

import { useState } from 'preact/hooks';

export function CopyButton(props: { label: string; text: () => string; disabled?: boolean }) {
  const [said, setSaid] = useState('');
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(props.text());
      setSaid('Copied');
    } catch {
      setSaid('The browser refuses: select and copy by hand');
    }
    setTimeout(() => setSaid(''), 3000);
  };
  return (
    <>
      <button type="button" disabled={props.disabled ?? false} onClick={copy}>
        {props.label}
      </button>
      <span class="quiet" aria-live="polite" data-copied>
        {said}
      </span>
    </>
  );
}
