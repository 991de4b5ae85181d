// The page of renders, in a browser.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { at, enter } from './studio.mjs';

const SMALL = 'scene=ball&width=96&height=54';
let session;

before(async () => {
  session = await enter();
});
after(() => session.browser.close());

async function visit(state) {
  await session.page.goto('about:blank');
  await session.page.goto(at('render', `?${state}`));
  await session.page.waitForSelector('[data-render="0"]');
}

/** The cells of a render's row. */
const row = async (i) => (await session.page.locator(`[data-render="${i}"] td`).allInnerTexts()).map((text) => text.trim());

test('a render takes the samples that it is asked for, and its mean is that of other random numbers', async () => {
  const means = [];
  for (const seed of [1, 2]) {
    await visit(`${SMALL}&samples=64&seed=${seed}`);
    await session.page.waitForFunction(() => Number(document.querySelector('[data-render="0"] td')?.textContent) >= 64);
    means.push((await row(0))[4].split(' ').map(Number));
  }
  for (let k = 0; k < 3; k++) assert.ok(Math.abs(means[0][k] / means[1][k] - 1) < 0.03, JSON.stringify(means));
});

test('two renders have equal samples', async () => {
  await visit(`${SMALL}&samples=32&isCompared=true&mode=samples&energyB=turquin`);
  await session.page.waitForFunction(() => [0, 1].every((i) => Number(document.querySelector(`[data-render="${i}"] td`)?.textContent) >= 32));
  assert.equal((await row(0))[0], (await row(1))[0]);
  await session.page.getByText(/A against B: RMSE/).waitFor();
});

test('two renders have equal time', async () => {
  await visit(`${SMALL}&samples=4096&isCompared=true&mode=time&energyB=turquin`);
  await session.page.waitForFunction(() => [0, 1].every((i) => Number(document.querySelector(`[data-render="${i}"]`)?.children[2]?.textContent) > 1.5), undefined, { timeout: 20000 });
  const [a, b] = [Number((await row(0))[1]), Number((await row(1))[1])];
  assert.ok(Math.abs(a / b - 1) < 0.3, `${a} and ${b}`);
});

test('equal time ends at equal time', async () => {
  await visit(`${SMALL}&samples=40&isCompared=true&mode=time&energyB=turquin&scene=orbs`);
  await session.page.waitForFunction(() => [0, 1].some((i) => Number(document.querySelector(`[data-render="${i}"] td`)?.textContent) >= 40));
  await session.page.waitForTimeout(1500);
  const [a, b] = [Number((await row(0))[1]), Number((await row(1))[1])];
  assert.ok(Math.abs(a - b) < 0.6, `${a} and ${b}`);
});

test('a drag turns the camera, and the address keeps it', async () => {
  await visit(`${SMALL}&samples=4`);
  const box = await session.page.locator('canvas.picture').boundingBox();
  await session.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await session.page.mouse.down();
  await session.page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2, { steps: 4 });
  await session.page.mouse.up();
  await session.page.waitForFunction(() => location.hash.includes('camera='));
});

test('a click picks a material, whose text changes the picture', async () => {
  await visit(`${SMALL}&samples=16`);
  await session.page.waitForFunction(() => Number(document.querySelector('[data-render="0"] td')?.textContent) >= 16);
  const before = (await row(0))[4];
  const box = await session.page.locator('canvas.picture').boundingBox();
  await session.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await session.page.getByLabel('As text').fill('diffuse 0.9 0.05 0.05');
  await session.page.getByLabel('As text').press('Enter');
  await session.page.waitForFunction(() => location.hash.includes('edits='));
  await session.page.waitForFunction((text) => {
    const cells = [...document.querySelectorAll('[data-render="0"] td')].map((c) => c.textContent);
    return Number(cells[0]) >= 16 && cells[4] !== text;
  }, before);
});

test('what is no scene and no material is said in words', async () => {
  await visit(`${SMALL}&samples=4`);
  await session.page.getByLabel('Open a file').fill('../../etc/passwd');
  await session.page.getByLabel('Open a file').press('Enter');
  await session.page.getByRole('alert').filter({ hasText: 'no file in the folder' }).waitFor();
  await session.page.goto('about:blank');
  await session.page.goto(at('render', `?${SMALL}&edits=0=plaster`));
  await session.page.getByRole('alert').filter({ hasText: 'plaster' }).waitFor();
});

test('pictures are saved', async () => {
  await visit(`${SMALL}&samples=4`);
  for (const name of ['EXR', 'PNG']) {
    const [download] = await Promise.all([session.page.waitForEvent('download'), session.page.getByRole('button', { name, exact: true }).click()]);
    assert.ok(download.suggestedFilename().endsWith(name.toLowerCase()));
  }
});
