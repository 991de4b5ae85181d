// The page of samplers, in a browser, against the library's own answers.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { addAxe, ask as askIn, at, enter } from './studio.mjs';

let session;

before(async () => {
  session = await enter();
});
after(() => session.browser.close());

async function visit(state = '') {
  await session.page.goto('about:blank');
  await session.page.goto(at('samplers', state));
  await session.page.waitForSelector('[data-figure=p]');
}

const figure = (name) => session.page.locator(`[data-figure=${name}]`).innerText();

/** The value of a request's answer. */
const ask = async (request) => (await askIn(session.page, request)).value;

const wo = (degrees) => [Math.cos((degrees * Math.PI) / 180), 0, Math.sin((degrees * Math.PI) / 180)];

test('figures are those of the library, and no sampler fails its density', async () => {
  for (const sampler of ['heitz', 'cap', 'bounded', 'exact']) {
    await visit(`?sampler=${sampler}&elevation=30`);
    const setup = { sampler, alpha: [0.6, 0.6], wo: wo(30) };
    const { acceptance } = await ask({ ask: 'samplers.describe', ...setup });
    const { p } = await ask({ ask: 'samplers.histogram', ...setup, size: 48, count: 20000, seed: 1 });
    await session.page.waitForFunction((text) => document.querySelector('[data-figure=acceptance]')?.textContent === text, `${(100 * acceptance).toFixed(2)} %`);
    assert.equal(await figure('p'), p.toPrecision(3));
    assert.ok(p > 1e-4, `${sampler}: ${p}`);
    if (sampler === 'exact') assert.ok(acceptance > 0.999999);
  }
});

test('controls change the state, and the address reopens it', async () => {
  await visit();
  await session.page.getByLabel('Exact').check({ force: true });
  await session.page.getByRole('spinbutton', { name: 'alpha x' }).fill('0.25');
  await session.page.waitForFunction(() => location.hash.includes('sampler=exact') && location.hash.includes('alpha=0.25,0.6'));
  const hash = await session.page.evaluate(() => location.hash);
  await session.page.reload();
  await session.page.waitForSelector('[data-figure=p]');
  assert.equal(await session.page.getByRole('spinbutton', { name: 'alpha x' }).inputValue(), '0.25');
  assert.equal(await session.page.evaluate(() => location.hash), hash);
});

test('views below the horizon have samples, and no comparison', async () => {
  await visit();
  await session.page.getByRole('button', { name: 'Below the horizon' }).click();
  await session.page.getByText('Estimates are compared for views above the horizon.').waitFor();
  assert.match(await figure('accepted'), /^\d+, \d+$/);
});

test('a lamp changes the comparison', async () => {
  await visit('?light=lamp&lightElevation=30&lightAngle=20');
  await session.page.getByLabel('Lamp half angle').first().waitFor();
  const row = session.page.getByRole('row', { name: /^Exact/ });
  await row.waitFor();
  const { rows } = await ask({ ask: 'samplers.compare', alpha: [0.6, 0.6], wo: wo(25), lamp: { towards: [-wo(30)[0], 1.0605752387249068e-16, wo(30)[2]], angle: (20 * Math.PI) / 180 }, count: 20000, seed: 1 });
  const mean = Number((await row.innerText()).split(/\s+/)[3]);
  assert.ok(Math.abs(mean - rows[3].mean) < 2e-3, `${mean} and ${rows[3].mean}`);
});

test('nothing is said on the console, and axe has nothing to say', async () => {
  await visit();
  await addAxe(session.page);
  const found = await session.page.evaluate(() => globalThis.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa'] }));
  assert.deepEqual(found.violations.map((v) => `${v.id}: ${v.nodes[0].html}`), []);
  assert.deepEqual(session.messages, []);
});
