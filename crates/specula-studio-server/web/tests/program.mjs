// The command line beside the page: `specula render` of the scene that a page shows. `PROGRAM` is the program.
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { FloatType } from 'three';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';

const program = process.env.PROGRAM;
/** Why tests that need the program are left out. */
export const needsProgram = program === undefined ? 'PROGRAM names no specula: cargo xtask studio builds one' : false;

/** A picture in OpenEXR: its size, and red, green, blue of its pixels. */
async function picture(path) {
  const file = await readFile(path);
  const loader = new EXRLoader().setDataType(FloatType);
  const { width, height, data } = loader.parse(file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength));
  const channels = data.length / (width * height);
  // Rows are from the bottom there; sums do not mind.
  return { width, height, colour: [0, 1, 2].map((k) => Array.from({ length: width * height }, (_, i) => data[channels * i + k])) };
}

/** The page's picture, as its button saves it. */
export async function saved(page) {
  const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'EXR', exact: true }).click()]);
  return picture(await file.path());
}

/** What the page says is its command line, with other random numbers and so many samples. */
export async function byCommandLine(page, { samples, seed }) {
  const folder = await mkdtemp(join(tmpdir(), 'studio-program-'));
  try {
    const form = async (name) => page.locator('label').getByText(name, { exact: true }).click();
    await page.getByText('Scene as text').click();
    await form('Command line');
    const shown = page.getByLabel('The scene as text').filter({ hasText: 'specula render' });
    const said = (await shown.innerText()).split('\n').find((line) => line.startsWith('specula render'));
    const words = said.split(/\s+/).slice(1);
    const scene = words.find((word) => word.endsWith('.pbrt'));
    if (scene !== undefined) {
      await form('pbrt-v4');
      const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save', exact: true }).click()]);
      await file.saveAs(join(folder, scene));
    }
    for (const [option, value] of [['--spp', samples], ['--seed', seed]]) {
      const at = words.indexOf(option);
      if (at >= 0) words.splice(at, 2);
      words.push(option, String(value));
    }
    await promisify(execFile)(program, [...words, '-o', 'picture.exr'], { cwd: folder });
    return await picture(join(folder, 'picture.exr'));
  } finally {
    await rm(folder, { recursive: true });
  }
}
