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

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** What an assertion gives, once it holds; after so many milliseconds, what it said last. Pages may be slow. */
export async function eventually(assertion, timeout = 60_000) {
  for (const end = performance.now() + timeout; ; ) {
    try {
      return await assertion();
    } catch (error) {
      if (performance.now() > end) throw error;
    }
    await pause(50);
  }
}

/** What a reading gives, once it has given the same for so many milliseconds. */
export async function rested(read, rest = 1500) {
  let [last, since] = [await read(), performance.now()];
  for (const end = since + 120_000; performance.now() - since < rest; ) {
    await pause(50);
    const now = await read();
    if (now !== last) [last, since] = [now, performance.now()];
    assert.ok(performance.now() < end, `it changes still: ${last}`);
  }
  return last;
}

/** Follows a link of the studio; the page has read its state when this ends. */
export const follow = (page, url) =>
  page.evaluate(
    (hash) =>
      new Promise((resolve) => {
        if (location.hash === hash) return resolve();
        // Behind the page's own listeners, and what they draw.
        addEventListener('hashchange', () => setTimeout(resolve), { once: true });
        location.hash = hash;
      }),
    new URL(url).hash,
  );

/** Opens the address of the page anew, once its state has these values; `null`: none. */
export async function reopen(page, wanted) {
  await page.waitForFunction((all) => {
    const state = new URLSearchParams(location.hash.split('?')[1]);
    return Object.entries(all).every(([key, value]) => state.get(key) === value);
  }, wanted);
  const address = page.url();
  await page.goto('about:blank');
  await page.goto(address);
}

/** axe has nothing to say, once the page has all its colours. */
export async function accessible(page, options) {
  await page.evaluate(axe);
  await eventually(async () => {
    const { violations } = await page.evaluate((given) => globalThis.axe.run(document, given), options ?? {});
    assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join('; ')}`), []);
  });
}

/** Opens a render; where pages of earlier tests have as many as can be open, once the program has closed one. */
export async function openRender(page, what) {
  for (const end = performance.now() + 90_000; ; ) {
    const { value, error } = await ask(page, { ask: 'render.open', ...what });
    if (value !== undefined) return value.session;
    if (!error.includes('renders are open') || performance.now() > end) throw new Error(error);
    await pause(1000);
  }
}
