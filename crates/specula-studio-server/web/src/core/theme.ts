/** Light or dark: the system's, or what the user chose. */

import { useEffect, useState } from 'preact/hooks';

export type Theme = 'light' | 'dark';
const KEY = 'specula-theme';
const system = matchMedia('(prefers-color-scheme: dark)');

function stored(): Theme | undefined {
  try {
    const found = localStorage.getItem(KEY);
    return found === 'light' || found === 'dark' ? found : undefined;
  } catch {
    return undefined;
  }
}

/** Sent to `document` when colours of the theme have changed. */
export const THEME_CHANGED = 'specula-theme';

export function useTheme(): [Theme, () => void] {
  const [theme, setTheme] = useState<Theme>(stored() ?? (system.matches ? 'dark' : 'light'));
  document.documentElement.dataset['theme'] = theme;
  useEffect(() => {
    document.dispatchEvent(new Event(THEME_CHANGED));
  }, [theme]);
  useEffect(() => {
    const follow = () => {
      if (stored() === undefined) setTheme(system.matches ? 'dark' : 'light');
    };
    system.addEventListener('change', follow);
    return () => system.removeEventListener('change', follow);
  }, []);
  const toggle = () => {
    const now = theme === 'dark' ? 'light' : 'dark';
    try {
      localStorage.setItem(KEY, now);
    } catch {
      // Pages from disk may store nothing.
    }
    setTheme(now);
  };
  return [theme, toggle];
}

/** A number that changes with the theme: a dependency for what draws its colours itself. */
export function useThemeChange(): number {
  const [changes, setChanges] = useState(0);
  useEffect(() => {
    const count = () => setChanges((n) => n + 1);
    document.addEventListener(THEME_CHANGED, count);
    return () => document.removeEventListener(THEME_CHANGED, count);
  }, []);
  return changes;
}
