/** A picture of linear colours on a canvas, with exposure; drags turn the camera, clicks pick. */

import { useEffect, useRef } from 'preact/hooks';

export interface PictureProps {
  label: string;
  width: number;
  height: number;
  colour: Float32Array | undefined;
  /** In stops. */
  exposure: number;
  /** Of the canvas' width, left of which nothing is drawn. */
  from?: number;
  onTurn?: (dx: number, dy: number, isPan: boolean) => void;
  onZoom?: (steps: number) => void;
  onPick?: (x: number, y: number) => void;
}

/** A byte of sRGB for a linear value. */
function encoded(x: number): number {
  const v = Math.min(1, Math.max(0, x));
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
}

export function Picture(props: PictureProps) {
  const { width, height, colour, exposure, from = 0 } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const context = canvas.current?.getContext('2d');
    if (context === null || context === undefined || colour === undefined || colour.length !== 3 * width * height) return;
    const image = context.createImageData(width, height);
    const scale = 2 ** exposure;
    for (let i = 0; i < width * height; i++) {
      for (let k = 0; k < 3; k++) image.data[4 * i + k] = encoded(scale * (colour[3 * i + k] as number));
      image.data[4 * i + 3] = 255;
    }
    context.clearRect(0, 0, width, height);
    const left = Math.round(from * width);
    context.putImageData(image, 0, 0, left, 0, width - left, height);
  }, [colour, exposure, width, height, from]);
  const last = useRef<{ x: number; y: number; moved: number } | undefined>(undefined);
  const place = (event: PointerEvent | MouseEvent) => {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height] as const;
  };
  return (
    <canvas
      ref={canvas}
      class="picture"
      width={width}
      height={height}
      role="img"
      aria-label={props.label}
      onPointerDown={(event) => {
        last.current = { x: event.clientX, y: event.clientY, moved: 0 };
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        const before = last.current;
        if (before === undefined) return;
        const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
        last.current = { x: event.clientX, y: event.clientY, moved: before.moved + Math.abs(dx) + Math.abs(dy) };
        if (last.current.moved > 4) props.onTurn?.(dx, dy, event.shiftKey || event.buttons === 2);
      }}
      onPointerUp={(event) => {
        if ((last.current?.moved ?? 9) <= 4) {
          const [x, y] = place(event);
          props.onPick?.(Math.min(width - 1, Math.floor(x * width)), Math.min(height - 1, Math.floor(y * height)));
        }
        last.current = undefined;
      }}
      onWheel={(event) => {
        if (props.onZoom === undefined) return;
        event.preventDefault();
        props.onZoom(Math.sign(event.deltaY));
      }}
      onContextMenu={(event) => event.preventDefault()}
    />
  );
}
