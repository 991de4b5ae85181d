// The page of renders, in a browser.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { byCommandLine, needsProgram, saved } from './program.mjs';
import { accessible, ask as askIn, at, enter, eventually, openRender, rested } from './studio.mjs';

const SMALL = 'scene=ball&width=96&height=54';
let session;

before(async () => {
  session = await enter();
});
after(() => session.browser.close());

async function visit(state) {
  await session.page.goto('about:blank');
  await session.page.goto(at('render', `?${state}`));
  await session.page.waitForSelector('[data-render="0"]', { timeout: 180000 });
}

const ask = (request) => askIn(session.page, request);

/** The cells of all rows, as they are at one moment. */
const rows = () => session.page.locator('tr[data-render]').evaluateAll((all) => all.map((one) => [...one.querySelectorAll('td')].map((cell) => cell.textContent.trim())));

/** The cells of a render's row. */
const row = async (i) => (await rows())[i];

/** The address has, or has not, this part. */
const inAddress = (part, has = true) => session.page.waitForFunction(([text, wanted]) => decodeURIComponent(location.hash).includes(text) === wanted, [part, has]);

/** Waits until a render has so many samples. */
const samples = (i, count, timeout = 180000) => session.page.waitForFunction(([render, least]) => Number(document.querySelector(`[data-render="${render}"] td`)?.textContent) >= least, [String(i), count], { timeout });

const colourOf = (cells) => cells[4].split(' ').map(Number);

/** The mean colour that a row shows. */
const mean = async (i) => colourOf(await row(i));

test('a render takes the samples that it is asked for, and its mean is that of other random numbers', async () => {
  const means = [];
  for (const seed of [1, 2]) {
    await visit(`${SMALL}&samples=64&seed=${seed}`);
    await samples(0, 64);
    means.push(await mean(0));
  }
  for (let k = 0; k < 3; k++) assert.ok(Math.abs(means[0][k] / means[1][k] - 1) < 0.03, JSON.stringify(means));
});

test('two renders have equal samples', async () => {
  await visit(`${SMALL}&samples=32&treatments=2&mode=samples&energyB=turquin`);
  for (const i of [0, 1]) await samples(i, 32);
  await eventually(async () => assert.deepEqual((await rows()).map(([count]) => count), ['32', '32']));
  await session.page.getByText(/A against B: RMSE/).waitFor();
});

test('two renders have equal time', async () => {
  await visit(`${SMALL}&samples=4096&treatments=2&mode=time&energyB=turquin`);
  await session.page.waitForFunction(() => [0, 1].every((i) => Number(document.querySelector(`[data-render="${i}"]`)?.children[2]?.textContent) > 1.5), undefined, { timeout: 180000 });
  const [a, b] = (await rows()).map((cells) => Number(cells[1]));
  assert.ok(Math.abs(a / b - 1) < 0.35, `${a} and ${b}`);
});

test('equal time ends at equal time', async () => {
  await visit(`${SMALL}&samples=40&treatments=2&mode=time&energyB=turquin&scene=orbs`);
  await session.page.waitForFunction(() => [0, 1].some((i) => Number(document.querySelector(`[data-render="${i}"] td`)?.textContent) >= 40), undefined, { timeout: 180000 });
  const [a, b] = JSON.parse(await rested(async () => JSON.stringify((await rows()).map((cells) => Number(cells[1])))));
  assert.ok(Math.abs(a - b) < 0.6, `${a} and ${b}`);
});

test('four treatments have three dividers, which arrow keys and the mouse move', async () => {
  await visit(`${SMALL}&samples=4&treatments=4&mode=samples`);
  await samples(3, 4);
  const dividers = session.page.getByRole('separator');
  await eventually(async () => assert.equal(await dividers.count(), 3));
  await dividers.nth(1).focus();
  const isAt = (place) => eventually(async () => assert.equal(await dividers.nth(1).getAttribute('aria-valuenow'), place));
  for (let i = 1; i <= 5; i++) {
    await session.page.keyboard.press('ArrowRight');
    await isAt(String(50 + i));
  }
  await session.page.keyboard.press('End');
  await isAt('75');
  const box = await session.page.locator('.layers').boundingBox();
  await session.page.mouse.move(box.x + box.width / 4, box.y + 40);
  await session.page.mouse.down();
  await session.page.mouse.move(box.x + box.width / 10, box.y + 40, { steps: 3 });
  await session.page.mouse.up();
  await session.page.waitForFunction(() => /dividers=0\.(1|099|101)/.test(location.hash));
  assert.ok(!(await session.page.evaluate(() => location.hash.includes('camera='))));
});

test('errors against a reference are those of the library, and fall as they should', async () => {
  // Points begin with the eighth sample of the reference: where that is slow, A has many by then.
  await visit(`${SMALL}&samples=768&mode=samples&reference=A`);
  await samples(0, 768);
  await session.page.getByRole('img', { name: /RMSE over seconds/ }).waitFor({ timeout: 180000 });
  await session.page.getByRole('button', { name: 'Pause' }).click();
  // The library's comparison is of what the table shows, once both rest.
  await session.page.waitForFunction(() => {
    const said = [...document.querySelectorAll('p')].map((p) => /A against the reference: RMSE ([^,]+),/.exec(p.textContent)?.[1]).find((x) => x !== undefined);
    return Math.abs(Number(said) / Number(document.querySelector('[data-render="0"]').children[6].textContent) - 1) < 0.01;
  });
  await session.page.getByLabel('Samples', { exact: true }).check({ force: true });
  await eventually(async () => {
    const path = await session.page.getByRole('img', { name: /RMSE over samples/ }).locator('.series').first().getAttribute('d');
    const points = path.match(/[\d.]+,[\d.]+/g).map((pair) => pair.split(',').map(Number));
    assert.ok(points.length >= 8 && points.at(-1)[1] > points[0][1], 'the error falls, to the end');
  });
  for (const show of ['Noise', 'Error']) {
    await session.page.getByLabel(show, { exact: true }).check({ force: true });
    await session.page.getByText('100 %', { exact: true }).waitFor();
  }
});

/** Colour and variance of a render by the library. */
async function byLibrary(what, count) {
  const render = await openRender(session.page, what);
  const { arrays } = await ask({ ask: 'render.advance', session: render, samples: count, wants: ['colour', 'variance'] });
  await ask({ ask: 'render.close', session: render });
  return arrays;
}

/** Mean of a picture's rows by the library, and the standard deviation of that mean. */
async function libraryMean(request, count) {
  const arrays = await byLibrary({ scene: 'ball', width: 96, height: 54, ...request }, count);
  return moments(arrays.colour, arrays.variance);
}

function moments(colour, variance) {
  const pixels = colour.length / 3;
  const sum = (values, k) => values.reduce((s, v, i) => (i % 3 === k ? s + v : s), 0);
  return [0, 1, 2].map((k) => ({ mean: sum(colour, k) / pixels, error: Math.sqrt(sum(variance, k)) / pixels }));
}

test("compared renders converge to the library's picture: z-test", async () => {
  for (const mode of ['samples', 'time']) {
    await visit(`${SMALL}&samples=96&treatments=2&mode=${mode}&energyA=none&energyB=turquin&samplerA=heitz&samplerB=exact&seed=5`);
    await session.page.waitForFunction(() => [0, 1].some((i) => Number(document.querySelector(`[data-render="${i}"] td`)?.textContent) >= 96), undefined, { timeout: 180000 });
    for (const [i, energy] of ['none', 'turquin'].entries()) {
      const cells = await row(i);
      const [count, found] = [Number(cells[0]), colourOf(cells)];
      const wanted = await libraryMean({ energy, seed: 77 }, 256);
      wanted.forEach(({ mean: expected, error }, k) => {
        // What is shown has four digits behind the point.
        const deviation = Math.hypot(error, error * Math.sqrt(256 / count), 0.5e-4);
        assert.ok(Math.abs(found[k] - expected) < 4.5 * deviation, `${mode}, ${energy}: ${found[k]}, expected ${expected} +- ${deviation}`);
      });
    }
  }
});

/** Means of two pictures of other random numbers, in every channel: `errors` are those of one sample per pixel. */
function agree(found, expected, errors, samples, least = 4.5) {
  assert.deepEqual([found.width, found.height], [expected.width, expected.height]);
  const deviation = (k) => errors[k] * Math.sqrt(1 / samples[0] + 1 / samples[1]);
  const of = (values) => values.reduce((sum, v) => sum + v, 0) / values.length;
  for (let k = 0; k < 3; k++) {
    const [a, b] = [of(found.colour[k]), of(expected.colour[k])];
    assert.ok(Math.abs(a - b) < least * deviation(k), `channel ${k}: ${a} and ${b}, deviation ${deviation(k)}`);
  }
}

test("the page's picture is the command line's: z-test in every channel", { skip: needsProgram }, async () => {
  for (const [scene, energy, height] of [['furnace', 'turquin', 24], ['orbs', 'none', 54]]) {
    await visit(`scene=${scene}&width=96&height=${height}&samples=64&energyA=${energy}&samplerA=exact&seed=11`);
    await samples(0, 64);
    const errors = (await libraryMean({ scene, height, energy, sampler: 'exact', seed: 12 }, 64)).map(({ error }) => 8 * error);
    const expected = await byCommandLine(session.page, { samples: 256, seed: 13 });
    agree(await saved(session.page), expected, errors, [64, 256]);
  }
});

test('WebGPU takes the same samples: z-test, progress while its shader compiles, and the library where the GPU is lost', async () => {
  session.messages.splice(0);
  await session.page.addInitScript(() => {
    const request = globalThis.GPUAdapter?.prototype.requestDevice;
    if (request === undefined) return;
    GPUAdapter.prototype.requestDevice = async function (...given) {
      globalThis.lastDevice = await request.apply(this, given);
      return globalThis.lastDevice;
    };
  });
  await session.page.goto('about:blank');
  await session.page.goto(at('render', '?scene=orbs&width=32&height=18&samples=24&by=gpu&mode=samples'));
  await session.page.getByText(/Compiling [\d,]+ lines of WGSL/).waitFor({ timeout: 180000 });
  // The page answers meanwhile.
  await session.page.getByRole('button', { name: 'Pause' }).click();
  await session.page.getByRole('button', { name: 'Go on' }).click();
  assert.ok(await session.page.getByText(/Compiling [\d,]+ lines of WGSL/).isVisible());
  await samples(0, 24, 600000);
  await session.page.locator('[data-by=gpu]').waitFor();
  const found = await mean(0);
  const wanted = await libraryMean({ scene: 'orbs', width: 32, height: 18, seed: 9 }, 256);
  wanted.forEach(({ mean: expected, error }, k) => {
    const deviation = Math.hypot(error, error * Math.sqrt(256 / 24), 0.5e-4);
    assert.ok(Math.abs(found[k] - expected) < 4.5 * deviation, `${found[k]}, expected ${expected} +- ${deviation}`);
  });
  // With the same random numbers the pixels are the same, up to rounding: the deviation too.
  const arrays = await byLibrary({ scene: 'orbs', width: 32, height: 18, seed: 1 }, 24);
  const cells = await session.page.locator('[data-pixel=A] td').allInnerTexts();
  const middle = 3 * (9 * 32 + 16);
  for (let k = 0; k < 3; k++) assert.ok(Math.abs(Number(cells[k]) / arrays.colour[middle + k] - 1) < 0.02, `${cells[k]} and ${arrays.colour[middle + k]}`);
  const weights = [0.2126, 0.7152, 0.0722];
  const deviation = weights.reduce((sum, w, k) => sum + w * Math.sqrt(arrays.variance[middle + k]), 0);
  assert.ok(Math.abs(Number(cells[4]) / deviation - 1) < 0.06, `${cells[4]} and ${deviation}`);
  // And the picture is that of the command line.
  const picture = await saved(session.page);
  assert.deepEqual([picture.width, picture.height], [32, 18]);
  if (!needsProgram) {
    const expected = await byCommandLine(session.page, { samples: 256, seed: 13 });
    agree(picture, expected, wanted.map(({ error }) => 16 * error), [24, 256]);
  }
  assert.deepEqual(session.messages, []);
  await session.page.evaluate(() => globalThis.lastDevice.destroy());
  await session.page.getByRole('spinbutton', { name: 'Samples per pixel' }).fill('64');
  await session.page.getByText(/By the library on the processor: the GPU was lost/).waitFor();
  await samples(0, 64);
});

test('a drag turns the camera, and the address keeps it; so do arrow keys', async () => {
  await visit(`${SMALL}&samples=4`);
  const box = await session.page.locator('canvas.picture').boundingBox();
  await session.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await session.page.mouse.down();
  await session.page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2, { steps: 4 });
  await session.page.mouse.up();
  await inAddress('camera=');
  const address = () => session.page.evaluate(() => location.hash);
  const before = await rested(address);
  await session.page.locator('.layers').focus();
  await session.page.keyboard.press('ArrowUp');
  await session.page.waitForFunction((hash) => location.hash !== hash, before);
  // What was dragged is what the library renders for that camera.
  const numbers = /camera=([^&]+)/.exec(await rested(address))[1].split(',').map(Number);
  const camera = { eye: numbers.slice(0, 3), target: numbers.slice(3, 6), up: numbers.slice(6, 9), fovDegrees: numbers[9] };
  const wanted = await libraryMean({ camera, seed: 1 }, 64);
  await eventually(async () => {
    const cells = await row(0);
    assert.equal(cells?.[0], '4');
    const found = colourOf(cells);
    wanted.forEach(({ mean: expected, error }, k) => assert.ok(Math.abs(found[k] - expected) < 6 * error * 4 + 1e-4, `${found[k]}, expected ${expected}`));
  });
  await session.page.getByRole('button', { name: "The scene's view" }).click();
  await inAddress('camera=', false);
});

test('a click picks a material, whose text and sliders change the picture', async () => {
  await visit(`${SMALL}&samples=16`);
  await samples(0, 16);
  const before = (await row(0))[4];
  const box = await session.page.locator('canvas.picture').boundingBox();
  await session.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const field = session.page.getByLabel('As text');
  await field.fill('diffuse 0.9 0.05 0.05');
  await field.press('Enter');
  await inAddress('edits=');
  const changed = (text) =>
    session.page.waitForFunction((old) => {
      const cells = [...document.querySelectorAll('[data-render="0"] td')].map((c) => c.textContent);
      return Number(cells[0]) >= 16 && cells[4] !== old;
    }, text);
  await changed(before);
  const red = (await row(0))[4];
  await session.page.getByRole('spinbutton', { name: 'reflectance red' }).fill('0.1');
  await inAddress('diffuse+0.1+0.05+0.05');
  await changed(red);
  await session.page.getByText('Scene as text').click();
  await session.page.locator('.scene-text').filter({ hasText: 'diffuse 0.1 0.05 0.05' }).waitFor();
  await session.page.getByRole('button', { name: "The scene's own" }).click();
  await inAddress('edits=', false);
  await session.page.waitForFunction((old) => document.querySelectorAll('[data-render="0"] td')[4]?.textContent === old, before);
});

test('what is typed as soon as a field is there stays', async () => {
  await visit(`${SMALL}&samples=4`);
  await samples(0, 4);
  const typed = await session.page.evaluate(
    () =>
      new Promise((resolve) => {
        const type = (input, text) => {
          input.value = text;
          input.dispatchEvent(new Event('input', { bubbles: true }));
        };
        const labelled = (text) => document.getElementById([...document.querySelectorAll('label')].find((label) => label.textContent === text)?.htmlFor);
        const watch = new MutationObserver(() => {
          const [text, number] = [labelled('As text'), labelled('alpha')];
          if (text === undefined || text === null || number === null) return;
          watch.disconnect();
          const first = text.value;
          type(text, 'diffuse 0.7');
          type(number, '');
          // Behind all effects of what was drawn.
          requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(() => resolve([first, text.value, number.value]), 200)));
        });
        watch.observe(document.body, { childList: true, subtree: true });
        const materials = labelled('Material');
        materials.value = [...materials.options].find((option) => option.text.includes('conductor')).value;
        materials.dispatchEvent(new Event('change', { bubbles: true }));
      }),
  );
  assert.match(typed[0], /^conductor .*alpha/);
  assert.deepEqual(typed.slice(1), ['diffuse 0.7', '']);
  await session.page.getByLabel('As text').dispatchEvent('change');
  await inAddress('diffuse+0.7');
});

test('a material of one treatment alone', async () => {
  await visit(`${SMALL}&samples=16&treatments=2&mode=samples&energyB=&editsB=0=diffuse+0.1`);
  for (const i of [0, 1]) await samples(i, 16);
  assert.notDeepEqual(await mean(0), await mean(1));
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

const OBJ = 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n';

test('dropped files are opened, and what is wrong with them is said', async () => {
  await visit(`${SMALL}&samples=4`);
  await samples(0, 4);
  const ball = (await row(0))[4];
  const drop = (files) =>
    session.page.evaluate((all) => {
      const data = new DataTransfer();
      for (const [name, text] of all) data.items.add(new File([text], name));
      document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    }, files);
  await drop([['notes.txt', 'nothing']]);
  await session.page.getByRole('alert').filter({ hasText: 'no scene among the files' }).waitFor();
  await drop([['bad.pbrt', 'Camera "round"\nWorldBegin\n']]);
  await session.page.getByRole('alert').filter({ hasText: 'bad.pbrt:1' }).waitFor();
  await drop([['a.obj', OBJ], ['b.obj', OBJ]]);
  await session.page.getByRole('alert').filter({ hasText: 'several scenes' }).waitFor();
  await session.page.getByRole('button', { name: 'b.obj' }).click();
  await inAddress('b.obj');
  await eventually(async () => assert.ok((await row(0))?.[4] !== ball && (await row(0))?.[0] === '4', 'another picture'));
  await session.page.getByLabel(/Drop a scene/).setInputFiles({ name: 'square.obj', mimeType: 'text/plain', buffer: Buffer.from(OBJ) });
  await inAddress('square.obj');
});

test('the inspector shows the pixel of the address and the one below the pointer', async () => {
  await visit(`${SMALL}&samples=8&pixel=10,20`);
  await samples(0, 8);
  const arrays = await byLibrary({ scene: 'ball', width: 96, height: 54, seed: 1 }, 8);
  await eventually(async () => {
    assert.equal(await session.page.getByRole('spinbutton', { name: 'Column' }).inputValue(), '10');
    const cells = await session.page.locator('[data-pixel=A] td').allInnerTexts();
    for (let k = 0; k < 3; k++) assert.ok(Math.abs(Number(cells[k]) / arrays.colour[3 * (20 * 96 + 10) + k] - 1) < 0.01, `${cells[k]}`);
  });
  const box = await session.page.locator('.layers').boundingBox();
  await session.page.mouse.move(box.x + (70.5 / 96) * box.width, box.y + (30.5 / 54) * box.height);
  await session.page.waitForFunction(() => [...document.querySelectorAll('input[type=number]')].some((input) => input.value === '70'));
  await session.page.getByText('Below the pointer.').waitFor();
});

test('tone curves and exposure change what is shown, not the figures', async () => {
  await visit(`${SMALL}&samples=4`);
  await samples(0, 4);
  const shown = () => session.page.locator('canvas.picture').evaluate((canvas) => [...canvas.getContext('2d').getImageData(48, 27, 1, 1).data].join());
  const seen = [await rested(shown)];
  const before = await row(0);
  for (const tone of ['reinhard', 'aces', 'agx', 'neutral']) {
    await session.page.getByLabel('Tone curve').selectOption(tone);
    await inAddress(`tone=${tone}`);
    await eventually(async () => assert.notEqual(await shown(), seen.at(-1), tone));
    seen.push(await shown());
  }
  // The neutral curve is linear but for a shift where colours are dark.
  assert.ok(new Set(seen).size >= 4, seen.join(' | '));
  assert.deepEqual(await row(0), before);
});

test('pictures are saved', async () => {
  await visit(`${SMALL}&samples=4`);
  for (const name of ['EXR', 'PNG']) {
    const [download] = await Promise.all([session.page.waitForEvent('download'), session.page.getByRole('button', { name, exact: true }).click()]);
    assert.ok(download.suggestedFilename().endsWith(name.toLowerCase()));
  }
});

test('axe has nothing to say, nor the console', async () => {
  session.messages.splice(0);
  for (const scheme of ['light', 'dark']) {
    await session.page.emulateMedia({ colorScheme: scheme });
    await visit(`${SMALL}&samples=4&treatments=3&reference=A&show=noise&mode=samples`);
    await samples(2, 4);
    await session.page.getByLabel('Material', { exact: true }).selectOption('0');
    await session.page.getByText('Scene as text').click();
    await accessible(session.page, { runOnly: ['wcag2a', 'wcag2aa'] });
  }
  await session.page.emulateMedia({ colorScheme: 'light' });
  assert.deepEqual(session.messages, []);
});
