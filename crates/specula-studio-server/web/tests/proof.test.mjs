// The Proof page: a correct text passes, each famous mistake fails its check, faults name lines.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, beforeEach, test } from 'node:test';
import { transform } from 'esbuild';
import { accessible, at, enter, eventually, follow, reopen } from './studio.mjs';

let browser;
let page;
let messages;

before(async () => {
  ({ browser, page, messages } = await enter());
});
after(() => browser.close());
beforeEach(() => messages.splice(0));

const settled = () =>
  page.waitForFunction(() => {
    const status = document.querySelector('[role=status]');
    return status !== null && /hold|does not compile/.test(status.textContent) && document.querySelector('.is-pending') === null;
  });

async function go(query = '') {
  await follow(page, at('proof', query));
  await settled();
}

const failed = () => page.locator('tr[data-holds=false]').evaluateAll((rows) => rows.map((row) => row.dataset.check));
const editor = () => page.getByRole('textbox', { name: 'BSDF in WGSL' });

async function type(change) {
  const text = await editor().inputValue();
  const changed = change(text);
  assert.notEqual(changed, text);
  await editor().fill(changed);
  await settled();
}

test('the chi-square distribution', async () => {
  const source = await readFile(new URL('../src/pages/proof/gamma.ts', import.meta.url), 'utf8');
  const { code } = await transform(source, { loader: 'ts', format: 'esm' });
  const { chiSquareP, upperGamma, logGamma } = await import(`data:text/javascript,${encodeURIComponent(code)}`);
  const near = (found, wanted) => assert.ok(Math.abs(found - wanted) <= 1e-8 * Math.abs(wanted), `${found} is not ${wanted}`);
  near(logGamma(0.5), Math.log(Math.sqrt(Math.PI)));
  near(logGamma(101), [...Array(100)].reduce((sum, _, i) => sum + Math.log(i + 1), 0));
  // Two degrees: exp(-x / 2). Four: (1 + x / 2) exp(-x / 2). One: erfc(sqrt(x / 2)), of tables.
  for (const x of [0.1, 1, 5, 40, 300]) {
    near(chiSquareP(x, 2), Math.exp(-x / 2));
    near(chiSquareP(x, 4), (1 + x / 2) * Math.exp(-x / 2));
  }
  near(chiSquareP(3.841458820694124, 1), 0.05);
  near(chiSquareP(124.34211340400407, 100), 0.05);
  assert.equal(upperGamma(3, 0), 1);
});

for (const query of ['', '?parameters=0.05,0.05,0,0&elevation=30', '?parameters=0.1,0.8,0,0&elevation=3&azimuth=40', '?parameters=1,1,0,0&elevation=90', '?elevation=-20']) {
  test(`the correct text passes: ${query}`, async () => {
    await go(query);
    assert.deepEqual(await failed(), []);
    assert.equal(await page.locator('table[aria-label=Checks] tbody tr').count(), 7);
    assert.match(await page.getByRole('status').textContent(), /^All checks hold/);
    assert.deepEqual(messages, []);
  });
}

const MISTAKES = {
  'no-g1': ['chi-square', 'normalisation', 'furnace'],
  'no-jacobian': ['chi-square', 'normalisation', 'furnace'],
  'alpha-twice': ['chi-square', 'furnace'],
  'one-sided': ['reciprocity'],
  gain: ['energy'],
  'not-finite': ['finite values'],
};
for (const [preset, wanted] of Object.entries(MISTAKES)) {
  test(`a famous mistake fails: ${preset}`, async () => {
    await go(`?preset=${preset}`);
    const found = await failed();
    for (const check of wanted) assert.ok(found.includes(check), `${check} is not among ${found}`);
    if (['one-sided', 'gain'].includes(preset)) assert.deepEqual(found, wanted);
    assert.deepEqual(messages, []);
  });
}

test('what is typed is proved', async () => {
  await go();
  await type((text) => text.replace('return vec4f(wi, user_pdf(wo, wi));', 'return vec4f(wi, 1.02 * user_pdf(wo, wi));'));
  const found = await failed();
  assert.ok(found.includes('pdf of samples') && found.includes('furnace'), String(found));
  await reopen(page, { text: await editor().inputValue() });
  await settled();
  await eventually(async () => assert.match(await editor().inputValue(), /1\.02 \* user_pdf/));
  await page.getByRole('button', { name: 'Discard changes' }).click();
  await page.waitForFunction(() => /^All checks hold/.test(document.querySelector('[role=status]').textContent));
  assert.deepEqual(messages, []);
});

test('functions of the library are found', async () => {
  await go('?preset=library');
  assert.deepEqual(await failed(), []);
  await type((text) => text.replace('bounded_reflection_pdf', 'bounded_reflection_pfd'));
  assert.match(await page.locator('.faults').textContent(), /bounded_reflection_pfd/);
  assert.deepEqual(messages, []);
});

test("a fault names the text's own line", async () => {
  await go();
  const line = (await editor().inputValue()).split('\n').findIndex((l) => l.includes('let squared')) + 1;
  await type((text) => text.replace('let squared = dot(s, s);', 'let squared = dot(s, t);'));
  assert.match(await page.getByRole('status').textContent(), /does not compile/);
  const button = page.getByRole('button', { name: `Line ${line}`, exact: true });
  await button.click();
  const chosen = () => editor().evaluate((area) => area.value.slice(area.selectionStart, area.selectionEnd));
  await eventually(async () => assert.equal((await chosen()).trim(), 'let squared = dot(s, t);'));
  await type((text) => text.replace('fn user_pdf', 'fn user_density'));
  assert.match(await page.locator('.faults').textContent(), /no function 'user_pdf'/);
  assert.deepEqual(messages, []);
});

test('cells are saved; axe has nothing to say', async () => {
  await go();
  const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save CSV: cells' }).click()]);
  const lines = (await readFile(await file.path(), 'utf8')).trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
  assert.equal(lines.length, 2048);
  const [counted, expected] = [2, 3].map((k) => lines.reduce((sum, cells) => sum + cells[k], 0));
  assert.ok(Math.abs(counted - expected) < 6 * Math.sqrt(counted), `${counted} counted, ${expected} expected`);
  for (let i = 0; i < 2; i++) {
    await accessible(page);
    await page.getByRole('button', { name: /^Switch to/ }).click();
  }
  assert.deepEqual(messages, []);
});

test('without WebGPU the page says so', async () => {
  const context = await browser.newContext();
  const bare = await context.newPage();
  await bare.addInitScript(() => Object.defineProperty(navigator, 'gpu', { value: undefined }));
  await bare.goto(process.env.STUDIO);
  await bare.goto(at('proof'));
  await bare.getByRole('alert').filter({ hasText: 'no WebGPU' }).waitFor({ timeout: 120_000 });
  await context.close();
});
