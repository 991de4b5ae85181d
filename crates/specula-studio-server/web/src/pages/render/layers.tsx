/** Pictures on top of each other, with dividers between them; drags turn the camera, clicks pick. */

import { useRef } from 'preact/hooks';
import { Picture } from './canvas';
import type { Turn } from './render';

export interface LayersProps {
  turns: Turn[];
  maps: (Float32Array | undefined)[];
  /** Of pictures without an answer yet. */
  size: [number, number];
  exposure: number;
  tone: string;
  /** Shares of the width, ascending. */
  dividers: number[];
  onDividers: (dividers: number[]) => void;
  onTurn: (dx: number, dy: number, isPan: boolean) => void;
  onZoom: (steps: number) => void;
  onPick: (x: number, y: number) => void;
  /** The pixel below the pointer; `undefined`: it has left. */
  onHover: (pixel: [number, number] | undefined) => void;
}

export const LETTERS = ['A', 'B', 'C', 'D'] as const;

/** Pixels of the screen that a press of an arrow key is worth. */
const KEY_STEP = 20;
const ARROWS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export function Layers(props: LayersProps) {
  const { turns, dividers } = props;
  const drag = useRef<{ x: number; y: number; moved: number } | undefined>(undefined);
  const [width, height] = [turns[0]?.opened?.width ?? props.size[0], turns[0]?.opened?.height ?? props.size[1]];
  const pixel = (event: PointerEvent): [number, number] => {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    const at = (share: number, of: number) => Math.max(0, Math.min(of - 1, Math.floor(share * of)));
    return [at((event.clientX - box.left) / box.width, width), at((event.clientY - box.top) / box.height, height)];
  };
  const key = (event: KeyboardEvent) => {
    const arrow = ARROWS[event.key];
    if (arrow !== undefined) props.onTurn(KEY_STEP * arrow[0], KEY_STEP * arrow[1], event.shiftKey);
    else if (event.key === '+' || event.key === '-') props.onZoom(event.key === '+' ? -1 : 1);
    else return;
    event.preventDefault();
  };
  return (
    <div
      class="layers"
      role="group"
      tabIndex={0}
      aria-label="Picture: arrow keys turn the camera, with shift they move it, plus and minus approach and retreat"
      onKeyDown={key}
      onPointerDown={(event) => {
        drag.current = { x: event.clientX, y: event.clientY, moved: 0 };
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        props.onHover(pixel(event));
        const before = drag.current;
        if (before === undefined) return;
        const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
        drag.current = { x: event.clientX, y: event.clientY, moved: before.moved + Math.abs(dx) + Math.abs(dy) };
        if (drag.current.moved > 4) props.onTurn(dx, dy, event.shiftKey || event.buttons === 2);
      }}
      onPointerUp={(event) => {
        if ((drag.current?.moved ?? 9) <= 4) props.onPick(...pixel(event));
        drag.current = undefined;
      }}
      onPointerCancel={() => (drag.current = undefined)}
      onPointerLeave={() => props.onHover(undefined)}
      onWheel={(event) => {
        event.preventDefault();
        props.onZoom(Math.sign(event.deltaY));
      }}
      onContextMenu={(event) => event.preventDefault()}
    >
      {turns.map((turn, i) => (
        <Picture
          key={i}
          label={`Render ${LETTERS[i]}`}
          width={turn.opened?.width ?? width}
          height={turn.opened?.height ?? height}
          colour={turn.colour}
          map={props.maps[i]}
          exposure={props.exposure}
          tone={props.tone}
          from={i === 0 ? 0 : (dividers[i - 1] ?? 0)}
        />
      ))}
      {turns.length > 1 &&
        turns.map((_, i) => (
          <span key={`letter-${i}`} class="letter" aria-hidden="true" style={{ left: `${100 * (i === 0 ? 0 : (dividers[i - 1] ?? 0))}%` }}>
            {LETTERS[i]}
          </span>
        ))}
      {dividers.map((at, i) => (
        <Divider key={`divider-${i}`} label={`Divider between ${LETTERS[i]} and ${LETTERS[i + 1]}`} at={at} low={dividers[i - 1] ?? 0} high={dividers[i + 1] ?? 1} onChange={(share) => props.onDividers(dividers.map((d, k) => (k === i ? share : d)))} />
      ))}
    </div>
  );
}

function Divider({ label, at, low, high, onChange }: { label: string; at: number; low: number; high: number; onChange: (share: number) => void }) {
  const isDragged = useRef(false);
  const set = (share: number) => onChange(Math.max(low, Math.min(high, Math.round(1000 * share) / 1000)));
  const key = (event: KeyboardEvent) => {
    const step = event.shiftKey ? 0.1 : 0.01;
    const places: Record<string, number> = { ArrowLeft: at - step, ArrowRight: at + step, ArrowDown: at - step, ArrowUp: at + step, Home: low, End: high };
    const share = places[event.key];
    if (share === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    set(share);
  };
  return (
    <div
      class="divider"
      role="separator"
      tabIndex={0}
      aria-orientation="vertical"
      aria-label={label}
      aria-valuemin={Math.round(100 * low)}
      aria-valuemax={Math.round(100 * high)}
      aria-valuenow={Math.round(100 * at)}
      style={{ left: `${100 * at}%` }}
      onKeyDown={key}
      onPointerDown={(event) => {
        event.stopPropagation();
        isDragged.current = true;
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        event.stopPropagation();
        const box = event.currentTarget.parentElement?.getBoundingClientRect();
        if (isDragged.current && box !== undefined) set((event.clientX - box.left) / box.width);
      }}
      onPointerUp={(event) => {
        event.stopPropagation();
        isDragged.current = false;
      }}
      onPointerCancel={() => (isDragged.current = false)}
    />
  );
}
