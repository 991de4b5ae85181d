/** One picture of a page: its plots and canvases in a grid, on the page's ground, below names in their colours. */

import { savePng, svgCanvas } from '../../ui/files';

/** Side of a cell of the picture. */
const CELL = 720;

/** Saves what is in the root: plots, spaces and disks. Colours of titles are names of the theme's. */
export async function savePicture(name: string, root: Element, titles: { text: string; colour: string }[]): Promise<void> {
  const found = [...root.querySelectorAll('.plot > svg, .space canvas, canvas[data-picture], svg[data-picture]')].slice(0, 9);
  const pictures = await Promise.all(found.map((element) => (element instanceof SVGSVGElement ? svgCanvas(element) : (element as HTMLCanvasElement))));
  const columns = Math.min(3, Math.max(1, Math.ceil(Math.sqrt(pictures.length))));
  const rows = Math.max(1, Math.ceil(pictures.length / columns));
  const canvas = Object.assign(document.createElement('canvas'), { width: columns * CELL, height: rows * CELL + 60 });
  const context = canvas.getContext('2d');
  if (context === null) return;
  const style = getComputedStyle(document.documentElement);
  context.fillStyle = style.getPropertyValue('--card');
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.font = '26px system-ui, "DejaVu Sans", sans-serif';
  let left = 24;
  for (const { text, colour } of titles) {
    context.fillStyle = style.getPropertyValue(colour);
    context.fillText(text, left, 42);
    left += context.measureText(text).width + 36;
  }
  pictures.forEach((picture, i) => {
    const scale = Math.min((CELL - 40) / picture.width, (CELL - 40) / picture.height);
    const [width, height] = [picture.width * scale, picture.height * scale];
    const [x, y] = [(i % columns) * CELL, Math.floor(i / columns) * CELL + 60];
    context.drawImage(picture, x + (CELL - width) / 2, y + (CELL - height) / 2, width, height);
  });
  await savePng(name, canvas);
}
