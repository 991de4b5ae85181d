// A headless browser for the tests: Chromium with WebGPU and WebGL in software.
import { join } from 'node:path';
import { chromium } from 'playwright-core';

const FLAGS = [
  '--no-sandbox',
  '--no-first-run',
  '--disable-quic',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--enable-unsafe-webgpu',
  '--use-webgpu-adapter=swiftshader',
  '--enable-unsafe-swiftshader',
  '--use-angle=swiftshader',
  '--ignore-gpu-blocklist',
  '--enable-features=Vulkan',
  '--use-vulkan=swiftshader',
  '--enable-gpu',
];

/** A browser; the program's own where one is named in `SPECULA_CHROMIUM`. */
export function launch() {
  return chromium.launch({ executablePath: process.env.SPECULA_CHROMIUM ?? '/usr/bin/chromium', headless: true, args: FLAGS });
}

/** A page of the browser; what it says on its console and what goes wrong is in `messages`. */
export async function open(browser, url, { width = 1280, height = 860, scheme = 'light' } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme });
  const page = await context.newPage();
  // A machine may be busy with other things.
  page.setDefaultTimeout(120_000);
  // As on a slower machine: `STUDIO_THROTTLE` times.
  const rate = Number(process.env.STUDIO_THROTTLE ?? 1);
  if (rate > 1) await (await context.newCDPSession(page)).send('Emulation.setCPUThrottlingRate', { rate });
  const messages = [];
  page.on('console', (message) => messages.push(`${message.type()}: ${message.text()}`));
  page.on('pageerror', (error) => messages.push(`error: ${error}`));
  // While pages are written: those of a folder, not the program's own.
  const folder = process.env.STUDIO_PAGES;
  if (folder !== undefined) for (const name of ['studio.js', 'studio.css']) await page.route(`**/${name}`, (route) => route.fulfill({ path: join(folder, name) }));
  await page.goto(url);
  return { page, messages, close: () => context.close() };
}
