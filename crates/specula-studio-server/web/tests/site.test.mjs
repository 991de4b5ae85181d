// The exported pages: from a static server, and from disk. `SITE` is the folder; with the WebAssembly module, pages compute.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { launch, open } from './browser.mjs';
import { accessible, ask, enter, eventually, openRender } from './studio.mjs';

const site = process.env.SITE;
const hasModule = site !== undefined && existsSync(join(site, 'specula-studio.wasm.js'));
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.txt': 'text/plain' };
const skip = site === undefined ? 'SITE names no folder: cargo xtask studio exports one' : false;
const needsModule = skip || (hasModule ? false : 'exported without the WebAssembly module: cargo xtask studio --wasm FILE');

let server;
let browser;
/** Where the same pages are. */
const places = {};

before(async () => {
  if (skip) return;
  server = createServer(async (request, response) => {
    const path = normalize(new URL(request.url, 'http://x').pathname).replace(/^\/studio\/?/, '') || 'index.html';
    try {
      const bytes = await readFile(join(site, path));
      response.setHeader('content-type', TYPES[extname(path)] ?? 'application/octet-stream').end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  places['a static server'] = `http://127.0.0.1:${server.address().port}/studio/`;
  places.disk = pathToFileURL(join(site, 'index.html')).href;
  browser = await launch();
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** What the program says of a render. */
async function rendered(what, samples) {
  const { page, browser } = await enter();
  try {
    const session = await openRender(page, what);
    const { value } = await ask(page, { ask: 'render.advance', session, samples });
    await ask(page, { ask: 'render.close', session });
    return value;
  } finally {
    await browser.close();
  }
}

for (const place of ['a static server', 'disk']) {
  test(`pages open from ${place}, and say what they cannot do`, { skip }, async () => {
    const { page, messages, close } = await open(browser, places[place]);
    const limits = page.getByRole('list', { name: 'What this page cannot do' });
    await limits.getByText(/need the program/).waitFor();
    await eventually(async () => {
      assert.equal(await limits.getByText(/There is no library/).count(), hasModule ? 0 : 1);
      assert.equal(await limits.getByText(/From disk/).count(), place === 'disk' ? 1 : 0);
    });
    await accessible(page, { runOnly: ['wcag2a', 'wcag2aa'], preload: false });
    for (const id of ['samplers', 'lobes', 'render', 'proof', 'laboratory']) {
      await page.goto(`${places[place]}#/${id}`);
      await page.getByRole('heading', { level: 1 }).waitFor();
    }
    if (!hasModule) await page.goto(`${places[place]}#/render`).then(() => page.getByRole('alert').filter({ hasText: 'neither a program nor the WebAssembly module' }).waitFor());
    assert.deepEqual(messages, []);
    await close();
  });

  test(`the library computes in a worker, from ${place}`, { skip: needsModule }, async () => {
    const { page, messages, close } = await open(browser, `${places[place]}#/samplers?rain=false&elevation=30&sampler=exact`);
    await page.waitForSelector('[data-figure=p]', { timeout: 120000 });
    await eventually(async () => assert.ok(Number(await page.locator('[data-figure=p]').innerText()) > 1e-4));
    // The same samples as the program takes.
    await page.goto('about:blank');
    await page.goto(`${places[place]}#/render?scene=ball&width=48&height=27&samples=8&seed=3`);
    await page.waitForFunction(() => Number(document.querySelector('[data-render="0"] td')?.textContent) >= 8, undefined, { timeout: 120000 });
    const cells = await page.locator('[data-render="0"] td').allInnerTexts();
    const wanted = await rendered({ scene: 'ball', width: 48, height: 27, seed: 3 }, 8);
    assert.equal(cells[0].trim(), '8');
    cells[4].trim().split(' ').forEach((text, k) => assert.ok(Math.abs(Number(text) - wanted.mean[k]) < 1.5e-4, `${cells[4]} and ${wanted.mean}`));
    // The page answers while the worker computes.
    await page.getByRole('button', { name: 'Begin anew' }).click();
    await page.getByRole('button', { name: 'Pause' }).click();
    await page.getByRole('button', { name: 'Go on' }).waitFor();
    assert.deepEqual(messages, []);
    await close();
  });

  test(`WGSL is proved without a program, from ${place}`, { skip: needsModule }, async () => {
    const { page, messages, close } = await open(browser, `${places[place]}#/proof`);
    await page.getByText('All checks hold.').waitFor({ timeout: 120000 });
    assert.deepEqual(messages, []);
    await close();
  });
}
