/** The studio: a bar, and the page that the address names. */

import { render } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import { link, pageOfAddress } from './core/address';
import { backend } from './core/ask';
import { SAVE_PICTURE, useKeys } from './core/keys';
import { useTheme } from './core/theme';
import { pages } from './pages/index';
import { Start } from './pages/start/index';

function App() {
  const [id, setId] = useState(pageOfAddress());
  const [theme, toggleTheme] = useTheme();
  const [hidesControls, setHidesControls] = useState(false);
  const help = useRef<HTMLDialogElement>(null);
  const page = pages.find((p) => p.id === id);
  useEffect(() => {
    const changed = () => setId(pageOfAddress());
    addEventListener('hashchange', changed);
    // The address may have changed before this listened.
    changed();
    return () => removeEventListener('hashchange', changed);
  }, []);
  useEffect(() => {
    document.title = page === undefined ? 'Specula studio' : `${page.title}, Specula studio`;
  }, [page]);
  useKeys((key) => {
    if (key === 'h' || key === 'H') setHidesControls((hides) => !hides);
    else if (key === 'f' || key === 'F') void toggleFullscreen();
    else if (key === 'p' || key === 'P') document.dispatchEvent(new Event(SAVE_PICTURE));
    else if (key === '?') help.current?.showModal();
    else {
      const chosen = pages[Number(key) - 1];
      if (chosen !== undefined) location.hash = link(chosen.id);
    }
  });
  const Component = page?.component ?? Start;
  return (
    <div class={hidesControls ? 'hides-controls' : ''}>
      <a class="skip" href="#main" onClick={(event) => (event.preventDefault(), document.getElementById('main')?.focus())}>
        To the page
      </a>
      <header class="bar">
        <a href={link('')} style={{ fontWeight: 600, textDecoration: 'none', color: 'inherit' }}>
          Specula
        </a>
        <nav aria-label="Pages">
          {pages.map((p) => (
            <a key={p.id} href={link(p.id)} aria-current={p.id === id ? 'page' : undefined}>
              {p.title}
            </a>
          ))}
        </nav>
        <div class="end">
          <span class="quiet">{backend === 'server' ? '' : backend === 'wasm' ? 'WebAssembly' : 'no library'}</span>
          <button type="button" onClick={toggleTheme} aria-label={`Switch to ${theme === 'dark' ? 'light' : 'dark'} colours`}>
            {theme === 'dark' ? 'Light' : 'Dark'}
          </button>
          <button type="button" onClick={() => help.current?.showModal()} aria-label="Keys">
            ?
          </button>
        </div>
      </header>
      <main id="main" tabIndex={-1}>
        <Component key={id} />
      </main>
      <dialog ref={help} aria-label="Keys">
        <h2>Keys</h2>
        <dl class="figures">
          <dt><kbd>H</kbd></dt><dd>hide or show the controls</dd>
          <dt><kbd>F</kbd></dt><dd>fill the screen</dd>
          <dt><kbd>P</kbd></dt><dd>save a picture</dd>
          {pages.map((p, i) => [<dt key={`${p.id}-key`}><kbd>{i + 1}</kbd></dt>, <dd key={p.id}>{p.title}</dd>])}
        </dl>
        <form method="dialog"><button class="main">Close</button></form>
      </dialog>
    </div>
  );
}

async function toggleFullscreen(): Promise<void> {
  if (document.fullscreenElement === null) await document.documentElement.requestFullscreen();
  else await document.exitFullscreen();
}

const root = document.getElementById('studio');
if (root !== null) {
  root.textContent = '';
  render(<App />, root);
}
