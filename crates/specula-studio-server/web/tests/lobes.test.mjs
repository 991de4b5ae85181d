// The Lobes page: controls, values as the library says them, exports, the address.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, beforeEach, test } from 'node:test';
import { accessible, ask as askIn, at, enter, eventually, follow, reopen } from './studio.mjs';

let browser;
let page;
let messages;

before(async () => {
  ({ browser, page, messages } = await enter());
});
after(() => browser.close());
beforeEach(() => messages.splice(0));

const settled = () =>
  page.waitForFunction(() => document.querySelectorAll('table[aria-label="Values at the light"] tbody tr').length > 0 && document.querySelector('.is-pending') === null);

async function go(query = '') {
  await follow(page, at(''));
  await follow(page, at('lobes', query));
  await settled();
}

const ask = (request) => askIn(page, request);
const text = (letter) => page.getByLabel(`Text of lobe ${letter}`);
const hasText = (wanted) => page.waitForFunction((t) => document.querySelector('.lobe-slot textarea').value === t, wanted);
/** A field has this value, once the page has drawn it. */
const has = (field, wanted) => eventually(async () => assert.equal(await field.inputValue(), wanted));
const near = (found, wanted, tolerance = 1e-4) => assert.ok(Math.abs(found - wanted) <= tolerance * Math.max(1e-3, Math.abs(wanted)), `${found} is not ${wanted}`);
const wo = (elevation, azimuth) => {
  const [e, a] = [(elevation * Math.PI) / 180, (azimuth * Math.PI) / 180];
  return [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)].map((x) => Number(x.toPrecision(7)));
};

async function download(press) {
  const [file] = await Promise.all([page.waitForEvent('download'), press()]);
  return { name: file.suggestedFilename(), bytes: await readFile(await file.path()) };
}

test('text and controls stay in step', async () => {
  await go();
  await text('A').fill('conductor  Cu alpha 0.1 0.4 energy turquin');
  await text('A').press('Enter');
  await hasText('conductor Cu alpha 0.1,0.4 energy turquin');
  await has(page.getByLabel('Kind', { exact: true }), 'conductor');
  await has(page.getByLabel('reflectance', { exact: true }), 'Cu');
  await has(page.getByLabel('alpha x').first(), '0.1');
  await has(page.getByLabel('energy', { exact: true }), 'turquin');
  await page.getByLabel('alpha y').first().fill('0.2');
  await hasText('conductor Cu alpha 0.1,0.2 energy turquin');
  await page.getByLabel('energy', { exact: true }).selectOption('');
  await page.getByLabel('Anisotropic').uncheck();
  await hasText('conductor Cu alpha 0.1');
  await page.getByLabel('Kind', { exact: true }).selectOption('dielectric');
  await hasText('dielectric alpha 0.1');
  await page.getByLabel('eta').first().fill('1.7');
  await hasText('dielectric alpha 0.1 eta 1.7');
  await settled();
  await page.getByRole('img', { name: /below$/ }).waitFor();
  assert.deepEqual(messages, []);
});

test('values and albedo are those of the library', async () => {
  await go('?a=conductor+Au+alpha+0.25&elevation=30&azimuth=20&light=41.25');
  const slice = await ask({ ask: 'lobes.slice', lobe: 'conductor Au alpha 0.25', wo: wo(30, 20), azimuth: (200 * Math.PI) / 180, count: 1441 });
  const i = (41.25 + 180) * 4;
  const numbers = async (table) => (await page.locator(`table[aria-label="${table}"] tbody td`).allTextContents()).map((cell) => cell.split(',').map(Number));
  await eventually(async () => {
    const shown = await numbers('Values at the light');
    assert.deepEqual(shown.map((values) => values.length), [3, 1, 3]);
    shown[0].forEach((value, k) => near(value, slice.arrays.f_cos[3 * i + k]));
    near(shown[1][0], slice.arrays.pdf[i]);
    shown[2].forEach((value, k) => near(value, slice.arrays.f_cos[3 * i + k] / slice.arrays.pdf[i]));
  });

  const samples = await ask({ ask: 'lobes.samples', lobe: 'conductor Au alpha 0.25', wo: wo(30, 20), count: 20_000 });
  await eventually(async () => {
    const shown = await numbers('Samples by lobe');
    assert.equal(shown[1]?.length, 3);
    shown[1].forEach((value, k) => near(value, samples.value.albedo[k], 1e-3));
  });

  await page.getByText('RGB', { exact: true }).click();
  const albedo = await ask({ ask: 'lobes.albedo', lobe: 'conductor Au alpha 0.25', count: 33, samples: 2000 });
  const green = await eventually(async () => {
    const { bytes } = await download(() => page.getByRole('button', { name: 'Save CSV: Albedo over the view' }).click());
    const lines = bytes.toString().split('\n').filter((line) => line.startsWith('A green'));
    assert.equal(lines.length, 33);
    return lines.map((line) => line.split(',').map(Number));
  });
  green.forEach(([, x, y], k) => {
    near(x, albedo.arrays.cos[k]);
    near(y, albedo.arrays.albedo[3 * k + 1]);
  });
  assert.deepEqual(messages, []);
});

test('bad text shows the words of the library, and keeps the last lobe', async () => {
  await go('?a=conductor+Au+alpha+0.3');
  const before = await page.locator('table[aria-label="Values at the light"]').textContent();
  await text('A').fill('conductor Au alpha 0.3 roughnes 2');
  await text('A').press('Enter');
  const { error } = await ask({ ask: 'lobes.parse', lobe: 'conductor Au alpha 0.3 roughnes 2' });
  const alert = page.locator('.lobe-slot').getByRole('alert');
  await eventually(async () => assert.equal(await alert.textContent(), error));
  assert.match(error, /roughnes/);
  assert.equal(await page.locator('table[aria-label="Values at the light"]').textContent(), before);
  assert.deepEqual(messages, []);
});

test('quantity, scale and view change the curves; the light is set in the plot', async () => {
  await go('?a=dielectric+alpha+0.3');
  const plot = page.getByRole('img', { name: /^Polar plot/ });
  const curve = async () => {
    await settled();
    return plot.locator('path.series').first().getAttribute('d');
  };
  const seen = new Set([await curve()]);
  const changes = [
    () => page.getByText('pdf', { exact: true }).first().click(),
    () => page.getByText('weight', { exact: true }).first().click(),
    () => page.getByLabel('Logarithmic').check(),
    () => page.getByLabel('Elevation').first().fill('-35'),
  ];
  for (const change of changes) {
    await change();
    const now = await eventually(async () => {
      const found = await curve();
      assert.ok(!seen.has(found), 'the curve changes');
      return found;
    });
    seen.add(now);
  }
  const box = await plot.boundingBox();
  await plot.click({ position: { x: box.width / 2, y: 40 } });
  await page.getByRole('heading', { name: /^Values at the light, -?0(\.\d+)? degrees/ }).waitFor();
  assert.deepEqual(messages, []);
});

test('energy treatments are laid over each other; the address reopens the page', async () => {
  await go('?a=conductor+Au+alpha+0.6,0.2&elevation=25&log=true');
  await page.getByRole('button', { name: 'Compare energy treatments' }).click();
  const wanted = ['conductor Au alpha 0.6,0.2', 'conductor Au alpha 0.6,0.2 energy turquin', 'conductor Au alpha 0.6,0.2 energy kulla-conty', 'multibounce-conductor Au alpha 0.6,0.2'];
  const texts = () => page.locator('.lobe-slot textarea').evaluateAll((inputs) => inputs.map((input) => input.value));
  await eventually(async () => assert.deepEqual(await texts(), wanted));
  await page.getByLabel('Controls change lobe C').check();
  await page.getByRole('button', { name: 'Remove lobe B' }).click();
  await eventually(async () => assert.deepEqual(await texts(), wanted.filter((_, i) => i !== 1)));
  await reopen(page, { slot: 'c', a: wanted[0], b: null, c: wanted[2], d: wanted[3] });
  await settled();
  await eventually(async () => {
    assert.deepEqual(await texts(), wanted.filter((_, i) => i !== 1));
    assert.ok(await page.getByLabel('Controls change lobe C').isChecked());
    assert.equal(await page.getByLabel('Elevation').first().inputValue(), '25');
    assert.ok(await page.getByLabel('Logarithmic').isChecked());
  });
  assert.deepEqual(messages, []);
});

test('walks are stepped through', async () => {
  await go('?a=multibounce-conductor+Au+alpha+0.7');
  const status = page.locator('[aria-live=polite]').filter({ hasText: 'Walk' });
  const says = (words) => eventually(async () => assert.match(await status.textContent(), words));
  await says(/^Walk 1 of 256: \d+ bounce/);
  await page.getByRole('button', { name: 'Next of two or more bounces' }).click();
  await says(/: ([2-9]|\d\d) bounces/);
  await eventually(async () => assert.equal(await page.locator('.walk svg circle').count(), Number(/: (\d+) bounces/.exec(await status.textContent())[1])));
  await page.getByRole('img', { name: /^Bounces: 1: / }).waitFor();
  assert.deepEqual(messages, []);
});

test('a lobe is proved', async () => {
  await go('?a=conductor+Au+alpha+0.4');
  await page.getByRole('button', { name: /^Prove lobe A/ }).click();
  await page.locator('table[aria-label=Checks]').waitFor();
  const { value } = await ask({ ask: 'lobes.prove', lobe: 'conductor Au alpha 0.4', wo: wo(40, 180), samples: 200_000 });
  const shown = await page.locator('table[aria-label=Checks] tbody tr').evaluateAll((rows) => rows.map((row) => [row.dataset.check, row.children[1].textContent, row.children[2].textContent]));
  assert.deepEqual(shown, value.checks.map((check) => [check.name, check.holds ? 'holds' : 'does not hold', check.text]));
  assert.ok(value.checks.every((check) => check.holds));
  assert.deepEqual(messages, []);
});

test('exports give files', async () => {
  await go('?a=conductor+Au+alpha+0.3');
  const svg = await download(() => page.getByRole('button', { name: /^Save SVG: Polar/ }).click());
  assert.match(svg.name, /\.svg$/);
  assert.match(svg.bytes.toString(), /^<svg [\s\S]*stroke="rgb/);
  const png = await download(() => page.getByRole('button', { name: /^Save PNG: Polar/ }).click());
  assert.equal(png.bytes.subarray(1, 4).toString(), 'PNG');
  const csv = await download(() => page.getByRole('button', { name: /^Save CSV: Polar/ }).click());
  assert.equal(csv.bytes.toString().trim().split('\n').length, 1442);
  const grid = await download(() => page.getByRole('button', { name: 'Save CSV: all directions' }).click());
  assert.equal(grid.bytes.toString().trim().split('\n').length, 73 * 181 + 1);
  const space = await download(() => page.getByRole('button', { name: 'Save PNG: three dimensions' }).click());
  assert.equal(space.bytes.subarray(1, 4).toString(), 'PNG');
  await page.locator('h1').click();
  const whole = await download(() => page.keyboard.press('p'));
  assert.ok(whole.bytes.length > 20_000);
  for (const [language, ending] of [['pbrt', 'pbrt'], ['wgsl', 'wgsl'], ['python', 'py']]) {
    await page.getByLabel('Language').selectOption(language);
    const { value } = await ask({ ask: 'lobes.code', lobe: 'conductor Au alpha 0.3', language });
    await page.waitForFunction((wanted) => document.querySelector('pre.code')?.textContent === wanted, value.text);
    const file = await download(() => page.getByRole('button', { name: 'Download' }).click());
    assert.equal(file.name, `lobe.${ending}`);
    assert.equal(file.bytes.toString(), value.text);
  }
  assert.deepEqual(messages, []);
});

test('nothing for axe to say', async () => {
  await go('?a=conductor+Au+alpha+0.3&b=dielectric+alpha+0.1');
  for (let i = 0; i < 2; i++) {
    await settled();
    await accessible(page);
    await page.getByRole('button', { name: /^Switch to/ }).click();
  }
  assert.deepEqual(messages, []);
});
