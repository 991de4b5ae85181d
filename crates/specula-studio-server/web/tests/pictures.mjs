// Pictures of the pages for the book: node tests/pictures.mjs FOLDER [PAGE...], where STUDIO holds the studio's address.
// One picture a page: light, dark and narrow beside each other, as WebP.
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { launch, open } from './browser.mjs';

const folder = process.argv[2];
const address = process.env.STUDIO;
const { origin } = new URL(address);
/** Pages, their state, and what is waited for. */
const PAGES = {
  samplers: ['?rain=false&elevation=20', '[data-figure=p]'],
  lobes: ['?a=conductor+Au+alpha+0.4', 'svg'],
  render: ['?width=384&height=216&treatments=3&energyA=none&energyB=turquin&energyC=multibounce=specula&samples=12&mode=samples&tone=agx', '[data-render="2"]'],
  proof: ['?preset=no-g1', 'tr[data-holds]'],
  laboratory: ['?chosen=tokuyoshi24-fig3', 'button.main:not(:disabled)'],
};
const VIEWS = [
  { width: 1280, height: 860, scheme: 'light' },
  { width: 1280, height: 860, scheme: 'dark' },
  { width: 390, height: 860, scheme: 'light' },
];
const SCALE = 0.5;
const GAP = 8;

const browser = await launch();
/** Pages that are named on the command line, else all. */
const wanted = process.argv.slice(3);
for (const [id, [state, selector]] of Object.entries(PAGES)) {
  if (wanted.length > 0 && !wanted.includes(id)) continue;
  const shots = [];
  for (const view of VIEWS) {
    const { page, close } = await open(browser, address, view);
    await page.goto(`${origin}/#/${id}${state}`);
    await page.waitForSelector(selector);
    if (id === 'render') await page.waitForFunction(() => Number(document.querySelector('[data-render="2"] td')?.textContent) >= 12, undefined, { timeout: 240000 });
    if (id === 'laboratory') {
      await page.getByRole('button', { name: 'Run 1' }).click();
      await page.waitForSelector('table[aria-label=Experiments] tbody tr');
    }
    // Narrow windows have the controls first: what they show begins behind them.
    if (view.width < 600) await page.locator('.content').evaluate((element) => scrollTo(0, element.getBoundingClientRect().top - 60));
    await page.waitForTimeout(4000);
    shots.push((await page.screenshot()).toString('base64'));
    await close();
  }
  const { page, close } = await open(browser, 'about:blank');
  const webp = await page.evaluate(
    async ([pictures, scale, gap]) => {
      const images = await Promise.all(pictures.map(async (text) => createImageBitmap(await (await fetch(`data:image/png;base64,${text}`)).blob())));
      const canvas = document.createElement('canvas');
      canvas.width = images.reduce((sum, image) => sum + scale * image.width + gap, -gap);
      canvas.height = scale * images[0].height;
      const context = canvas.getContext('2d');
      context.imageSmoothingQuality = 'high';
      let x = 0;
      for (const image of images) {
        context.drawImage(image, x, 0, scale * image.width, scale * image.height);
        x += scale * image.width + gap;
      }
      return canvas.toDataURL('image/webp', 0.8).split(',')[1];
    },
    [shots, SCALE, GAP],
  );
  await close();
  await writeFile(join(folder, `studio-${id}.webp`), Buffer.from(webp, 'base64'));
  console.log(id, Buffer.from(webp, 'base64').length);
}
await browser.close();
