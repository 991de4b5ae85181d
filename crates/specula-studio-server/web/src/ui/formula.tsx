/** A formula: TeX as MathML. */

import temml from 'temml';
import { useMemo } from 'preact/hooks';

export function Formula(props: { tex: string; inline?: boolean }) {
  const html = useMemo(() => {
    const text = temml.renderToString(props.tex, { displayMode: props.inline !== true, throwOnError: false });
    // The pages' policy refuses styles in markup.
    return text.replace(/ style="[^"]*"/g, '');
  }, [props.tex, props.inline]);
  return props.inline === true ? <span dangerouslySetInnerHTML={{ __html: html }} /> : <div class="formula" dangerouslySetInnerHTML={{ __html: html }} />;
}
