// The page of samplers, in a browser, against the library's own answers.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { accessible, ask as askIn, at, enter, eventually, rested } from './studio.mjs';

let session;

before(async () => {
  session = await enter();
});
after(() => session.browser.close());

/** Without rain, which keeps software WebGL busy. */
async function visit(state = '?', rain = false) {
  await session.page.goto('about:blank');
  await session.page.goto(at('samplers', `${state}${state === '?' ? '' : '&'}rain=${rain}`));
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
    await eventually(async () => assert.equal(await figure('p'), p.toPrecision(3)));
    assert.ok(p > 1e-4, `${sampler}: ${p}`);
    if (sampler === 'exact') assert.ok(acceptance > 0.999999);
  }
});

test('controls change the state, and the address reopens it', async () => {
  await visit();
  await session.page.getByRole('radio', { name: 'Exact' }).check({ force: true });
  await session.page.getByRole('spinbutton', { name: 'alpha x' }).fill('0.25');
  await session.page.waitForFunction(() => location.hash.includes('sampler=exact') && location.hash.includes('alpha=0.25,0.6'));
  const hash = await session.page.evaluate(() => location.hash);
  await session.page.reload();
  await session.page.waitForSelector('[data-figure=p]');
  await eventually(async () => {
    assert.equal(await session.page.getByRole('spinbutton', { name: 'alpha x' }).inputValue(), '0.25');
    assert.ok(await session.page.getByRole('radio', { name: 'Exact' }).isChecked());
    assert.equal(await session.page.evaluate(() => location.hash), hash);
  });
});

test('the address has changes at once, no more of them than browsers allow, and the last when a drag ends or the page is left', async () => {
  const { page } = session;
  await visit();
  const found = await page.evaluate(async () => {
    const field = document.querySelector('input[type=number]');
    const change = (value) => {
      field.value = String(value);
      field.dispatchEvent(new Event('input', { bubbles: true }));
    };
    const alpha = () => Number(/alpha=([^,]+)/.exec(location.hash)?.[1]);
    let [count, begun] = [0, performance.now()];
    const replace = history.replaceState.bind(history);
    history.replaceState = (...given) => (count++, replace(...given));
    const atOnce = [0.1, 0.2, 0.3].map((value) => (change(value), alpha()));
    for (let i = 0; i < 40; i++) {
      change(0.5 + i / 1000);
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    const [changes, seconds] = [count, (performance.now() - begun) / 1000];
    for (let i = 0; i < 20; i++) change(0.7 + i / 1000);
    const waiting = alpha();
    dispatchEvent(new Event('pointerup'));
    const ended = alpha();
    // Once this has been told.
    setTimeout(() => {
      for (let i = 0; i < 20; i++) change(0.8 + i / 1000);
      location.href = '/';
    }, 500);
    return { atOnce, changes, seconds, waiting, ended };
  });
  assert.deepEqual(found.atOnce, [0.1, 0.2, 0.3]);
  assert.ok(found.changes > 12 && found.changes <= 13 + found.seconds / 0.12, JSON.stringify(found));
  assert.ok(found.waiting < 0.719 && found.ended === 0.719, JSON.stringify(found));
  await page.getByRole('heading', { level: 1, name: 'Specula studio' }).waitFor();
  await page.goBack();
  await page.waitForFunction(() => location.hash.includes('alpha=0.819,'));
});

test('views below the horizon have samples, and no comparison', async () => {
  await visit();
  await session.page.getByRole('button', { name: 'Below the horizon' }).click();
  await session.page.getByText('Estimates are compared for views above the horizon.').waitFor();
  await eventually(async () => assert.match(await figure('accepted'), /^\d+, \d+$/));
});

test('a lamp changes the comparison', async () => {
  await visit('?light=lamp&lightElevation=30&lightAngle=20');
  await session.page.getByLabel('Lamp half angle').first().waitFor();
  const row = session.page.getByRole('row', { name: /^Exact/ });
  await row.waitFor();
  const { rows } = await ask({ ask: 'samplers.compare', alpha: [0.6, 0.6], wo: wo(25), lamp: { towards: [-wo(30)[0], 1.0605752387249068e-16, wo(30)[2]], angle: (20 * Math.PI) / 180 }, count: 20000, seed: 1 });
  await eventually(async () => {
    const mean = Number((await row.innerText()).split(/\s+/)[3]);
    assert.ok(Math.abs(mean - rows[3].mean) < 2e-3, `${mean} and ${rows[3].mean}`);
  });
});

const ALL = ['heitz', 'cap', 'bounded', 'exact'];

test('samples rain in, can be stopped, and are all there where motion is not wanted', async () => {
  const { page } = session;
  const count = async () => (await figure('accepted')).split(', ').reduce((sum, n) => sum + Number(n), 0);
  await visit('?', true);
  // In the page: all may have fallen before a click of the test's comes.
  await page.evaluate(async () => {
    const button = (text) => [...document.querySelectorAll('button')].find(({ textContent }) => textContent === text);
    button('Let them rain').click();
    await new Promise((resolve) => setTimeout(resolve, 300));
    button('Pause').click();
  });
  await page.getByRole('button', { name: 'Go on' }).waitFor();
  const stopped = await rested(count, 500);
  assert.ok(stopped > 0 && stopped < 4000, `${stopped}`);
  await page.getByRole('button', { name: 'Go on' }).click();
  await page.waitForFunction(() => document.querySelector('[data-figure=accepted]').textContent.split(', ').reduce((a, b) => a + Number(b), 0) === 4000);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await visit('?', true);
  await page.waitForFunction(() => document.querySelector('[data-figure=accepted]').textContent !== '');
  assert.equal(await count(), 4000);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
});

test('the legend hides parts, in the address too', async () => {
  const { page } = session;
  await visit('?');
  const pixels = () => page.locator('.space canvas').first().evaluate((canvas) => canvas.toDataURL().length);
  const legend = page.getByRole('button', { name: /Accepted samples/ });
  await eventually(async () => assert.match(await figure('accepted'), /^\d+, \d+$/));
  const before = await rested(pixels);
  await legend.click();
  await page.waitForFunction(() => location.hash.includes('hides=accepted'));
  await eventually(async () => assert.ok((await pixels()) < 0.8 * before));
  await page.reload();
  await eventually(async () => assert.equal(await legend.getAttribute('aria-pressed'), 'false'));
});

test('a sample is read out by its number and below the pointer', async () => {
  const { page } = session;
  await visit('?sample=7');
  const { arrays } = await askIn(page, { ask: 'samplers.samples', sampler: 'bounded', alpha: [0.6, 0.6], wo: wo(25), count: 4000, seed: 1 });
  const theta = (Math.acos(arrays.wi[3 * 6 + 2]) * 180) / Math.PI;
  await page.waitForFunction((text) => document.querySelector('[data-figure=sample]').textContent.includes(text), `Sample 7: wi at theta ${theta.toFixed(1)}`);
  const box = await page.locator('.space').first().boundingBox();
  await page.mouse.move(box.x + 0.42 * box.width, box.y + 0.4 * box.height);
  await page.waitForFunction(() => !document.querySelector('[data-figure=sample]').textContent.includes('Sample 7:'));
});

test('all samplers are side by side, as the library counts them', async () => {
  await visit();
  for (const sampler of ALL) {
    const { rejected } = await ask({ ask: 'samplers.histogram', sampler, alpha: [0.6, 0.6], wo: wo(25), size: 32, count: 50000, seed: 1 });
    await session.page.locator(`[data-multiple=${sampler}]`).getByText(`rejected ${((100 * rejected) / 50000).toFixed(2)} %`).waitFor();
  }
  await session.page.locator('[data-multiple=exact] button').click();
  await session.page.waitForFunction(() => location.hash.includes('sampler=exact'));
});

test('presets of the paper and its supplement', async () => {
  const { page } = session;
  await visit();
  for (const [group, name, wanted] of [['Supplement, figure 1', 'c', 'alpha=1.5,0.2'], ['Figure 3: regions', '5', 'alpha=1,0.2'], ['Figure 5: along the normal', '0.7', 'elevation=90']]) {
    await page.getByRole('group', { name: group }).getByRole('button', { name, exact: true }).click();
    await page.waitForFunction((text) => location.hash.includes(text), wanted);
  }
  await page.getByRole('img', { name: 'Densities of samplers and white lobes' }).waitFor();
});

test("samples of the exported WGSL have the library's density, for every sampler, below the horizon too", async () => {
  const { page } = session;
  await visit('?seed=3&alpha=0.9,0.4');
  const check = async (what) => {
    await page.getByRole('button', { name: 'Check in WebGPU' }).click();
    await page.waitForSelector('[data-figure=gpu-p]', { timeout: 120000 });
    const p = Number(await figure('gpu-p'));
    assert.ok(p > 1e-4, `${what}: ${p}`);
  };
  for (const sampler of ['Heitz', 'Cap', 'Bounded', 'Exact']) {
    await page.getByRole('radio', { name: sampler }).check({ force: true });
    await page.waitForFunction(() => document.querySelector('[data-figure=gpu-p]') === null);
    await check(sampler);
  }
  await page.getByRole('spinbutton', { name: /^Elevation/ }).fill('-20');
  await page.waitForFunction(() => document.querySelector('[data-figure=gpu-p]') === null);
  await check('below the horizon');
});

test('nothing is said on the console, and axe has nothing to say', async () => {
  await visit();
  await accessible(session.page, { runOnly: ['wcag2a', 'wcag2aa'] });
  assert.deepEqual(session.messages, []);
});
