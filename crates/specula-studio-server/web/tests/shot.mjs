// A picture of a page: node tests/shot.mjs URL OUT.png [--dark] [--width N] [--height N] [--wait MS]
import { launch, open } from './browser.mjs';

const [url, out] = process.argv.slice(2);
const option = (name, fallback) => {
  const at = process.argv.indexOf(name);
  return at < 0 ? fallback : Number(process.argv[at + 1]);
};
const browser = await launch();
const scheme = process.argv.includes('--dark') ? 'dark' : 'light';
const { page, messages } = await open(browser, url, { width: option('--width', 1280), height: option('--height', 860), scheme });
await page.waitForTimeout(option('--wait', 3000));
await page.screenshot({ path: out, fullPage: process.argv.includes('--full') });
for (const message of messages) console.log(message);
await browser.close();
