/** The scene with its changes, as text to copy. */

import { useState } from 'preact/hooks';
import { useAnswer } from '../../core/use_answer';
import { Choice, Message } from '../../ui/controls';
import { CopyButton } from '../../ui/copy';
import { save } from '../../ui/files';

/** Most letters that are shown. */
const SHOWN = 4000;

/** `stamp`: changes with what the session renders. */
export function SceneText({ session, stamp }: { session: number; stamp: string }) {
  const [isOpen, setOpen] = useState(false);
  return (
    <details class="panel wide" open={isOpen} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>Scene as text</summary>
      {isOpen && <Text key={stamp} session={session} />}
    </details>
  );
}

function Text({ session }: { session: number }) {
  const [kind, setKind] = useState<'command' | 'pbrt'>('command');
  return (
    <>
      <Choice
        label="Form"
        value={kind}
        options={[
          { value: 'command', label: 'Command line' },
          { value: 'pbrt', label: 'pbrt-v4' },
        ]}
        onChange={setKind}
      />
      <Form key={kind} session={session} kind={kind} />
    </>
  );
}

function Form({ session, kind }: { session: number; kind: 'command' | 'pbrt' }) {
  const { answer, error } = useAnswer<'render.scene'>({ ask: 'render.scene', session, format: kind });
  const text = answer?.value.text;
  return (
    <>
      <Message text={error} />
      {text !== undefined && (
        <>
          <pre tabIndex={0} aria-label="The scene as text" class="scene-text">
            {text.length > SHOWN ? `${text.slice(0, SHOWN)}\n(${(text.length - SHOWN).toLocaleString('en')} letters more)` : text}
          </pre>
          <div class="actions">
            <CopyButton label="Copy" text={() => text} />
            {kind === 'pbrt' && (
              <button type="button" onClick={() => save('scene.pbrt', text, 'text/plain')}>
                Save
              </button>
            )}
          </div>
        </>
      )}
    </>
  );
}
