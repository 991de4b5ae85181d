import { link } from '../../core/address';
import { backend } from '../../core/ask';
import { pages } from '../index';

/** What this page cannot do where it is, in words. */
function limits(): string[] {
  const found: string[] = [];
  const isFromDisk = location.protocol === 'file:';
  if (backend !== 'server') found.push('Files of your own and the laboratory need the program: specula studio.');
  if (backend === 'wasm') found.push('The library runs in WebAssembly, in one thread: an eighth as fast as a thread of the program.');
  if (backend === 'none') found.push('There is no library: this page was exported without its WebAssembly module. Nothing is computed.');
  if (isFromDisk) found.push('From disk, a link to a state of a page is a link to this file: others can open it only with the folder.');
  if (!isSecureContext) found.push('This address is neither https nor of this machine: browsers give such pages no WebGPU and no clipboard.');
  else if (navigator.gpu === undefined) found.push('This browser has no WebGPU: proofs of WGSL and checks of the exported shader do not run.');
  return found;
}

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
        {backend === 'wasm' && 'This page computes by itself, in WebAssembly and, where the browser has it, WebGPU.'} Press <kbd>?</kbd> for the keys.
      </p>
      {limits().length > 0 && (
        <ul class="quiet" aria-label="What this page cannot do">
          {limits().map((text) => (
            <li key={text}>{text}</li>
          ))}
        </ul>
      )}
    </div>
  );
}
