// The book's tour, docs/guide/tour.md, followed as a person would, with a stopwatch: what it names is pressed, what it
// promises is looked for.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { enter, eventually } from './studio.mjs';

const GUIDE = new URL('../../../../docs/guide/tour.md', import.meta.url);
/** Words a minute of a reader, and seconds of the tour. */
const READING = 200;
const LIMIT = 300;

let page;
let browser;
let messages;
/** What the page and the reader are told at each step. */
let steps;
/** What was pressed, chosen or typed since the step began. */
let done;
const seconds = [];

before(async () => {
  const text = await readFile(GUIDE, 'utf8');
  steps = [...text.matchAll(/^\d\. \*\*(.+?)\.\*\*([\s\S]+?)(?=^\d\. |^$)/gm)].map(([, title, rest]) => ({ title, rest: rest.replace(/\s+/g, ' ') }));
  ({ browser, page, messages } = await enter());
});
after(() => browser.close());

/** A step of the tour: all that its text names is used, in its order, and nothing else. */
function step(title, follow) {
  test(`the tour: ${title}`, async () => {
    const { rest } = steps.find((s) => s.title === title);
    const begin = performance.now();
    done = [];
    await open(title);
    await follow(rest);
    const named = [...rest.matchAll(/\*(.+?)\*|`(.+?)`/g)].map(([, word, typed]) => word ?? typed);
    assert.deepEqual(done, named);
    seconds.push({ title, seconds: (performance.now() - begin) / 1000, words: rest.trim().split(' ').length });
  });
}

async function open(name) {
  done.push(name);
  await page.getByRole('navigation').getByRole('link', { name, exact: true }).click();
  await page.getByRole('heading', { level: 1, name, exact: true }).waitFor();
}
async function press(name) {
  done.push(name);
  await page.getByRole('button', { name, exact: true }).click();
}
async function choose(name) {
  done.push(name);
  await page.locator('label').getByText(name, { exact: true }).click();
}
async function select(label, option) {
  done.push(label, option);
  await page.getByLabel(label, { exact: true }).selectOption({ label: option });
}
async function drag(box, by) {
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + by, y, { steps: 8 });
  await page.mouse.up();
}

const drawn = async () => (await page.locator('[data-figure=accepted]').innerText()).split(', ').map(Number);
const allDrawn = () =>
  page.waitForFunction(() => document.querySelector('[data-figure=accepted]')?.textContent.split(', ').reduce((sum, n) => sum + Number(n), 0) >= 4000);
const verdicts = () => page.locator('table[aria-label=Checks] tr[data-check]').evaluateAll((rows) => rows.map((row) => [row.dataset.check, row.dataset.holds === 'true']));

step('Samplers', async () => {
  await choose('Heitz');
  await press('Let them rain');
  await allDrawn();
  assert.ok((await drawn())[1] > 0, 'some are lost');
  await choose('Exact');
  await page.waitForFunction(() => /^\d+, 0$/.test(document.querySelector('[data-figure=accepted]').textContent));
  await press('Check in WebGPU');
  await page.locator('p', { has: page.locator('[data-figure=gpu-p]') }).getByText('nothing against the density').waitFor();
});

step('Lobes', async () => {
  const typed = 'conductor Au alpha 0.5';
  done.push(typed);
  await page.getByLabel('Text of lobe A').click();
  await page.keyboard.press('Control+A');
  await page.keyboard.type(typed, { delay: 30 });
  await page.keyboard.press('Enter');
  await press('Compare energy treatments');
  await page.waitForFunction(() => document.querySelectorAll('table[aria-label="Samples by lobe"] tbody tr').length === 4);
  const albedo = async () => (await page.locator('table[aria-label="Samples by lobe"] tbody tr').allInnerTexts()).map((row) => Number(row.split('\t')[2].split(',')[0]));
  await eventually(async () => {
    const found = await albedo();
    assert.ok(found.slice(1).every((a) => a > found[0] + 0.01), `${found}`);
  });
  await press('Prove lobe A at this view');
  await page.locator('table[aria-label=Checks]').waitFor();
  const held = await verdicts();
  assert.ok(held.length >= 4 && held.every(([, holds]) => holds), JSON.stringify(held));
});

/** Red of the pictures' means, as they are at one moment. */
const means = () => page.locator('tr[data-render]').evaluateAll((rows) => rows.map((row) => Number(row.querySelectorAll('td')[4].textContent.split(' ')[0])));
const samplesOf = (i, count) => page.waitForFunction(([row, least]) => Number(document.querySelector(`[data-render="${row}"] td`)?.textContent) >= least, [i, count]);

step('Render', async () => {
  await select('Scene', 'Furnace: white metal in white light');
  await samplesOf(0, 1);
  await drag(await page.locator('canvas.picture').boundingBox(), 60);
  await page.waitForFunction(() => location.hash.includes('camera='));
  done.push('Compared', '2');
  await page.getByRole('spinbutton', { name: 'Compared' }).fill('2');
  await select('Energy of metals, A', 'none');
  await select('Energy of metals, B', 'turquin');
  await page.waitForFunction(() => ['energyA=none', 'energyB=turquin'].every((part) => location.hash.includes(part)));
  await samplesOf(1, 2);
  await drag(await page.getByRole('separator').boundingBox(), -80);
  await page.waitForFunction(() => Number(document.querySelector('[role=separator]').getAttribute('aria-valuenow')) < 45);
  await eventually(async () => {
    const [a, b] = await means();
    // The surround's radiance is 0.5.
    assert.ok(a < 0.98 * b && Math.abs(b - 0.5) < 0.01, `${a} and ${b}`);
  });
});

const proved = (words) => page.getByRole('status').filter({ hasText: words }).waitFor();

step('Proof', async () => {
  await proved('All checks hold.');
  await select('Text to begin with', 'pdf without its G1');
  await proved('3 of 7 checks do not hold.');
  const broken = (await verdicts()).filter(([, holds]) => !holds).map(([check]) => check);
  assert.deepEqual(broken, ['chi-square', 'normalisation', 'furnace']);
});

step('Laboratory', async () => {
  await choose('fig. 3: bounds of reflections in the space of unit roughness');
  done.push('Run');
  await page.getByRole('button', { name: 'Run 1', exact: true }).click();
  const rows = page.locator('table[aria-label=Experiments] tbody tr');
  await rows.first().waitFor();
  await eventually(async () => {
    const held = await rows.evaluateAll((all) => all.map((row) => row.children[4].textContent));
    assert.ok(held.length > 0 && held.every((word) => word === 'holds'), `${held}`);
  });
});

test('the tour takes five minutes: its steps, and its words at the pace of a reader', () => {
  assert.deepEqual(seconds.map((s) => s.title), steps.map((s) => s.title));
  const reading = (words) => (60 * words) / READING;
  const total = seconds.reduce((sum, s) => sum + s.seconds + reading(s.words), 0);
  for (const s of seconds) console.log(`${s.title}: ${s.seconds.toFixed(1)} s of the page, ${reading(s.words).toFixed(0)} s of reading`);
  assert.ok(total < LIMIT, `${total} s`);
  assert.deepEqual(messages, []);
});
