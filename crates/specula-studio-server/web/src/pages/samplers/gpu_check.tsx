/** Samples of the exported WGSL, taken by the browser's GPU, against the density by quadrature: chi-square. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { ask } from '../../core/ask';
import type { Sampler } from '../../core/protocol';
import { bindings, type Compiling, gpu, pipeline, readBack, storage } from '../../gpu/device';
import { Message, Panel, Progress } from '../../ui/controls';
import { Heats } from '../../ui/heats';
import { format } from '../../ui/plot';
import { chiSquareP } from '../proof/gamma';
import kernel from './check.wgsl';
import type { Setup } from './setup';

const CELLS = 48;
const THREADS = 8192;
const EACH = 256;
const COUNT = THREADS * EACH;
/** As `SAMPLER_*` in `specula-shaders/wgsl/vndf/sampler.wgsl`. */
const STRATEGIES: Record<Sampler, number> = { heitz: 0, cap: 1, bounded: 2, exact: 3 };

interface Found {
  key: string;
  counts: Float64Array;
  expected: Float64Array;
  rejected: number;
  expectedRejected: number;
  chiSquare: number;
  degrees: number;
  p: number;
  milliseconds: number;
}

/** Pearson's statistic as the library pools it: cells that expect fewer than five together. */
export function pearson(cells: [found: number, expected: number][]): { chiSquare: number; degrees: number; p: number } {
  const kept = cells.filter(([, expected]) => expected >= 5);
  const pool = cells.filter(([, expected]) => expected < 5).reduce(([f, e], [found, expected]) => [f + found, e + expected] as [number, number], [0, 0] as [number, number]);
  if (pool[1] >= 5) kept.push(pool);
  else if (kept.length > 0) {
    const least = kept.reduce((a, b) => (b[1] < a[1] ? b : a));
    kept[kept.indexOf(least)] = [least[0] + pool[0], least[1] + pool[1]];
  }
  const chiSquare = kept.reduce((sum, [found, expected]) => sum + (found - expected) ** 2 / expected, 0);
  const degrees = Math.max(0, kept.length - 1);
  return { chiSquare, degrees, p: chiSquareP(chiSquare, degrees) };
}

async function count(setup: Setup, seed: number, tell: (compiling: Compiling) => void): Promise<{ counts: Uint32Array; milliseconds: number }> {
  const on = await gpu();
  const { value, arrays } = await ask<'shaders.library'>({ ask: 'shaders.library', functions: ['reflection_sample_direction'] });
  const hasTables = /@group\(0\)\s*@binding\(0\)/.test(value.wgsl);
  const layouts = [bindings(on.device, hasTables ? ['read-only-storage'] : []), bindings(on.device, ['uniform', 'storage'])] as const;
  const made = await pipeline(on, `${value.wgsl.trimEnd()}\n${kernel}`, 'check_main', [...layouts], tell);
  const { device } = on;
  const task = device.createBuffer({ size: 48, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
  const counts = storage(device, new Uint8Array(4 * (CELLS * CELLS + 1)), GPUBufferUsage.COPY_SRC);
  const tables = hasTables ? [storage(device, arrays.tables.values)] : [];
  try {
    const words = new ArrayBuffer(48);
    new Float32Array(words).set([...setup.wo, 0, ...setup.alpha]);
    new Uint32Array(words).set([STRATEGIES[setup.sampler], seed >>> 0, EACH, CELLS, 0, 0], 6);
    device.queue.writeBuffer(task, 0, words);
    const group = (layout: GPUBindGroupLayout, buffers: GPUBuffer[]) => device.createBindGroup({ layout, entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })) });
    const begun = performance.now();
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(made);
    pass.setBindGroup(0, group(layouts[0], tables));
    pass.setBindGroup(1, group(layouts[1], [task, counts]));
    pass.dispatchWorkgroups(THREADS / 64);
    pass.end();
    device.queue.submit([encoder.finish()]);
    const bytes = await readBack(on, counts, 4 * (CELLS * CELLS + 1));
    return { counts: new Uint32Array(bytes), milliseconds: performance.now() - begun };
  } finally {
    for (const buffer of [task, counts, ...tables]) buffer.destroy();
  }
}

async function check(setup: Setup, seed: number, key: string, tell: (compiling: Compiling | undefined) => void): Promise<Found> {
  const { counts, milliseconds } = await count(setup, seed, tell);
  tell(undefined);
  const { value, arrays } = await ask<'samplers.histogram'>({ ask: 'samplers.histogram', ...setup, size: CELLS, count: COUNT, seed });
  const expected = Float64Array.from(arrays.expected.values);
  const found = Float64Array.from(counts.subarray(0, CELLS * CELLS));
  const rejected = counts[CELLS * CELLS] as number;
  const cells = Array.from(found, (n, i) => [n, expected[i] as number] as [number, number]);
  cells.push([rejected, value.expectedRejected]);
  return { key, counts: found, expected, rejected, expectedRejected: value.expectedRejected, milliseconds, ...pearson(cells) };
}

export function GpuCheck({ setup, seed }: { setup: Setup; seed: number }) {
  const key = JSON.stringify([setup, seed]);
  const [found, setFound] = useState<Found>();
  const [error, setError] = useState<string>();
  const [compiling, setCompiling] = useState<Compiling>();
  const [isBusy, setBusy] = useState(false);
  const isGone = useRef(false);
  useEffect(
    () => () => {
      isGone.current = true;
    },
    [],
  );
  const run = async () => {
    setBusy(true);
    setError(undefined);
    try {
      const now = await check(setup, seed, key, (what) => !isGone.current && setCompiling(what));
      if (!isGone.current) setFound(now);
    } catch (reason) {
      if (!isGone.current) setError((reason as Error).message);
    }
    setCompiling(undefined);
    setBusy(false);
  };
  const shown = found?.key === key ? found : undefined;
  return (
    <Panel
      title="The exported shader"
      wide
      actions={
        <button type="button" disabled={isBusy} onClick={() => void run()}>
          Check in WebGPU
        </button>
      }
    >
      <p class="quiet">{COUNT.toLocaleString('en')} samples by the WGSL that <code>specula export</code> writes, in this browser's GPU, against the density in double precision.</p>
      <Message text={error} />
      {compiling !== undefined && <Progress label={`Compiling ${compiling.what}`} />}
      {shown !== undefined && (
        <>
          <p>
            Chi-square {format(shown.chiSquare)} of {shown.degrees} degrees, p = <span data-figure="gpu-p">{shown.p.toPrecision(3)}</span>:{' '}
            <span class={shown.p < 1e-4 ? 'bad' : 'good'}>{shown.p < 1e-4 ? 'the samples do not have this density' : 'nothing against the density'}</span>. Rejected {shown.rejected}, expected {shown.expectedRejected.toFixed(0)}. {shown.milliseconds.toFixed(0)} ms.
          </p>
          <Heats rows={CELLS} columns={CELLS} counts={shown.counts} expected={shown.expected} axes="x of the reflection to the right, y upwards" />
        </>
      )}
    </Panel>
  );
}
