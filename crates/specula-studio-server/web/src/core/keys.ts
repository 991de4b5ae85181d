/** Keys: H hides the controls, F fills the screen, P saves a picture, digits choose pages, ? lists them. */

import { useEffect } from 'preact/hooks';

/** Sent to `document` when the user asks for a picture of the page; pages with a picture listen. */
export const SAVE_PICTURE = 'specula-save-picture';

/** Calls `handle` for keys that no field takes. */
export function useKeys(handle: (key: string) => void): void {
  useEffect(() => {
    const down = (event: KeyboardEvent) => {
      const target = event.target as HTMLElement;
      const isTyped = target.isContentEditable || ['TEXTAREA', 'SELECT'].includes(target.tagName);
      const isField = target.tagName === 'INPUT' && !['checkbox', 'radio', 'range'].includes((target as HTMLInputElement).type);
      if (event.ctrlKey || event.metaKey || event.altKey || isTyped || isField) return;
      handle(event.key);
    };
    addEventListener('keydown', down);
    return () => removeEventListener('keydown', down);
  });
}

/** Calls `save` when the user asks for a picture. */
export function useSavePicture(save: () => void): void {
  useEffect(() => {
    document.addEventListener(SAVE_PICTURE, save);
    return () => document.removeEventListener(SAVE_PICTURE, save);
  });
}
