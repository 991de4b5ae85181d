import { link } from '../../core/address';
import { backend } from '../../core/ask';
import { pages } from '../index';

/** What there is. */
export function Start() {
  return (
    <div class="content start">
      <h1>Specula studio</h1>
      <p>Rough metal and glass as they are computed: samplers, lobes and renders, by the library that the program renders with.</p>
      <ul class="cards">
        {pages.map((page) => (
          <li key={page.id}>
            <a href={link(page.id)}>{page.title}</a>
            <span>{page.summary}</span>
          </li>
        ))}
      </ul>
      <p class="quiet">
        {backend === 'server' && 'The program on this machine computes.'}
        {backend === 'wasm' && 'This page computes by itself, in WebAssembly and, where the browser has it, WebGPU.'}
        {backend === 'none' && 'This page has neither a program nor WebAssembly: only what WebGPU computes works.'} Press <kbd>?</kbd> for the keys.
      </p>
    </div>
  );
}
