/** A picture of linear colours on a canvas, with exposure and a tone curve; or a map of errors. */

import { useEffect, useRef } from 'preact/hooks';
import { encoded } from '../../core/colour';
import type { Rgb } from '../../core/protocol';
import { viridis } from '../../ui/scale';
import { toneOf } from './tone';

export interface PictureProps {
  label: string;
  width: number;
  height: number;
  colour: Float32Array | undefined;
  /** Relative errors of pixels, shown instead of colours. */
  map: Float32Array | undefined;
  /** In stops. */
  exposure: number;
  tone: string;
  /** Of the width: what is left of it is not shown. */
  from: number;
}

/** Powers of ten that maps show: from a thousandth to all. */
export const MAP_DECADES = 3;

/** Colours as bytes of sRGB, opaque. */
function developed(colour: Float32Array, exposure: number, tone: string, bytes: Uint8ClampedArray): void {
  const scale = 2 ** exposure;
  const { id, curve } = toneOf(tone);
  for (let i = 0; i < colour.length / 3; i++) {
    const own: Rgb = [scale * (colour[3 * i] as number), scale * (colour[3 * i + 1] as number), scale * (colour[3 * i + 2] as number)];
    const bent = id === 'linear' ? own : curve(own);
    for (let k = 0; k < 3; k++) bytes[4 * i + k] = encoded(bent[k] as number);
    bytes[4 * i + 3] = 255;
  }
}

export function Picture(props: PictureProps) {
  const { width, height, colour, map, exposure, tone, from } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const context = canvas.current?.getContext('2d');
    const pixels = width * height;
    if (context === null || context === undefined || colour?.length !== 3 * pixels) return;
    const image = context.createImageData(width, height);
    if (map?.length === pixels) map.forEach((error, i) => image.data.set([...viridis(1 + Math.log10(Math.max(error, 1e-9)) / MAP_DECADES), 255], 4 * i));
    else developed(colour, exposure, tone, image.data);
    context.putImageData(image, 0, 0);
  }, [colour, map, exposure, tone, width, height]);
  return <canvas ref={canvas} class="picture" width={width} height={height} role="img" aria-label={props.label} style={from > 0 ? { clipPath: `inset(0 0 0 ${100 * from}%)` } : {}} />;
}
