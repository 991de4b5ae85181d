// The studio that the tests visit, at the address that `specula studio` printed: `STUDIO`.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { launch, open } from './browser.mjs';

const address = process.env.STUDIO;
const axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** A browser with a page of the studio, which the token has let in. */
export async function enter() {
  assert.ok(address, 'STUDIO holds the address that the program printed');
  const browser = await launch();
  return { browser, ...(await open(browser, address)) };
}

/** The address of a page of the studio, with its state. */
export const at = (page, state = '') => `${new URL(address).origin}/#/${page}${state}`;

/** Asks the library as pages do; arrays as lists, of bytes their number alone. */
export function ask(page, request) {
  return page.evaluate(async (body) => {
    const response = await fetch('/api/ask', { method: 'POST', headers: { 'content-type': 'application/json', 'x-specula': '1' }, body: JSON.stringify(body) });
    const buffer = await response.arrayBuffer();
    const length = new DataView(buffer).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    const arrays = {};
    for (const { name, type, shape, offset } of head.arrays ?? []) {
      const count = shape.reduce((a, b) => a * b, 1);
      if (type === 'u8') arrays[name] = count;
      else arrays[name] = Array.from(new (type === 'u32' ? Uint32Array : Float32Array)(buffer, 4 + length + offset, count));
    }
    return { value: head.value, error: head.error, arrays };
  }, request);
}

/** Puts axe into a page: `axe.run()` there. */
export const addAxe = (page) => page.evaluate(axe);

/** Opens a render; where pages of earlier tests have as many as can be open, once the program has closed one. */
export async function openRender(page, what) {
  for (const end = performance.now() + 90_000; ; ) {
    const { value, error } = await ask(page, { ask: 'render.open', ...what });
    if (value !== undefined) return value.session;
    if (!error.includes('renders are open') || performance.now() > end) throw new Error(error);
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
}
