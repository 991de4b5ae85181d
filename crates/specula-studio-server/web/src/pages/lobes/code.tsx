/** The lobe in words of other programs. */

import type { Language } from '../../core/protocol';
import { useAnswer } from '../../core/use_answer';
import { Message, Select } from '../../ui/controls';
import { CopyButton } from '../../ui/copy';
import { save } from '../../ui/files';

export const LANGUAGES: { value: Language; label: string; ending: string }[] = [
  { value: 'specula', label: 'Specula, text form', ending: 'txt' },
  { value: 'pbrt', label: 'pbrt-v4 scene', ending: 'pbrt' },
  { value: 'mitsuba', label: 'Mitsuba 3 scene', ending: 'xml' },
  { value: 'rust', label: 'Rust', ending: 'rs' },
  { value: 'python', label: 'Python', ending: 'py' },
  { value: 'c', label: 'C', ending: 'c' },
  { value: 'cpp', label: 'C++ (exported shaders)', ending: 'cpp' },
  { value: 'wgsl', label: 'WGSL', ending: 'wgsl' },
  { value: 'hlsl', label: 'HLSL', ending: 'hlsl' },
  { value: 'glsl', label: 'GLSL', ending: 'glsl' },
  { value: 'metal', label: 'Metal', ending: 'metal' },
];

export function Code({ lobe, language, onLanguage }: { lobe: string; language: string; onLanguage: (language: Language) => void }) {
  const chosen = LANGUAGES.find((l) => l.value === language) ?? (LANGUAGES[0] as (typeof LANGUAGES)[number]);
  const { answer, error, isPending } = useAnswer<'lobes.code'>({ ask: 'lobes.code', lobe, language: chosen.value });
  const text = error === undefined ? answer?.value.text : undefined;
  // While another text is on its way, this one is not what was asked for.
  const isThere = text !== undefined && !isPending;
  return (
    <div aria-busy={isPending}>
      <div class="actions">
        <Select label="Language" options={LANGUAGES} value={chosen.value} onChange={onLanguage} />
        <button type="button" disabled={!isThere} onClick={() => save(`lobe.${chosen.ending}`, text ?? '', 'text/plain')}>
          Download
        </button>
        <CopyButton label="Copy" text={() => text ?? ''} disabled={!isThere} />
      </div>
      <Message text={error} />
      {text !== undefined && (
        <pre class="code" tabIndex={0} role="region" aria-label={`The lobe in ${chosen.label}`}>
          {text}
        </pre>
      )}
    </div>
  );
}
