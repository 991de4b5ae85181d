/** Compiles a text with the kernels, and runs them: what a BSDF says of itself, in numbers. */

import type { Vec3 } from '../../core/protocol';
import { bindings, type Gpu, gpu, GpuLost, shader, storage, work } from '../../gpu/device';
import kernels from './kernels.wgsl';
import { foreignCalls, type Library, libraryOf, missing } from './library';
import prelude from './prelude.wgsl';

export const ROWS = 32;
export const COLUMNS = 64;
export const CELLS = ROWS * COLUMNS;
const THREADS = 8192;
const COUNTS = CELLS + 10;
const SUMS_BYTES = 2 * (THREADS + CELLS) * 16;
/** Cells that take a finer rule, at most. */
const MOST_REFINED = 64;
const ENTRIES = { proof_draw: THREADS / 64, proof_expect: CELLS / 64, proof_reciprocity: 64, proof_scan: 256, proof_refine: 0 };

/** A fault of the text; `line` from 1, where it has one. */
export interface Fault {
  line: number | undefined;
  text: string;
}

/** Pipelines of a text. */
export interface Compiled {
  text: string;
  on: Gpu;
  pipelines: [GPUComputePipeline, number][];
  layout: GPUBindGroupLayout;
  tables: GPUBindGroup;
}

export interface Question {
  wo: Vec3;
  parameters: [number, number, number, number];
  seed: number;
  /** Samples of a thread. */
  each: number;
}

/** Raw numbers of a run. */
export interface Numbers {
  samples: number;
  counts: Uint32Array;
  /** Of the text's own threads: sums of weights, and of their squares. */
  weight: [number, number, number];
  squares: [number, number, number];
  /** By cell: red, green, blue and density, by the fine and by the coarse rule. */
  fine: Float32Array;
  coarse: Float32Array;
}

const lines = (text: string) => text.split('\n').length - 1;

/** Compiles; faults where the text has some. Never blocks the page. */
export async function compile(text: string): Promise<Compiled | Fault[]> {
  const lacking = missing(text);
  if (lacking.length > 0) return lacking.map((name) => ({ line: undefined, text: `the text has no function '${name}'` }));
  let library: Library | undefined;
  const faults: Fault[] = [];
  const calls = foreignCalls(text);
  if (calls.length > 0) {
    try {
      library = await libraryOf(calls);
    } catch (error) {
      const words = error instanceof Error ? error.message : String(error);
      faults.push({ line: undefined, text: `not defined here, and not from the library: ${calls.join(', ')} (${words})` });
    }
  }
  const on = await gpu();
  const front = `${library === undefined ? '' : `${library.wgsl.trimEnd()}\n`}${prelude.trimEnd()}\n`;
  const { module, faults: said } = await shader(on, `${front}${text.trimEnd()}\n${kernels}`);
  const [first, last] = [lines(front), lines(front) + lines(`${text.trimEnd()}\n`)];
  for (const { line, text: words } of said) {
    const isOwn = line > first && line <= last;
    faults.push({ line: isOwn ? line - first : undefined, text: isOwn ? words : `where the text is used: ${words}` });
  }
  if (faults.length > 0) return faults;
  return pipelines(on, module, text, library);
}

async function pipelines(on: Gpu, module: GPUShaderModule, text: string, library: Library | undefined): Promise<Compiled | Fault[]> {
  const { device } = on;
  const hasTables = library !== undefined && /@group\(0\)\s*@binding\(0\)/.test(library.wgsl);
  const first = bindings(device, hasTables ? ['read-only-storage'] : []);
  const layout = bindings(device, ['uniform', 'storage', 'storage', 'read-only-storage', 'read-only-storage']);
  const whole = device.createPipelineLayout({ bindGroupLayouts: [first, layout] });
  try {
    const making = Object.keys(ENTRIES).map((entryPoint) => device.createComputePipelineAsync({ layout: whole, compute: { module, entryPoint } }));
    const made = await work(on, Promise.all(making));
    const entries = hasTables && library !== undefined ? [{ binding: 0, resource: { buffer: storage(device, library.tables) } }] : [];
    const tables = device.createBindGroup({ layout: first, entries });
    const sizes = Object.values(ENTRIES);
    return { text, on, layout, tables, pipelines: made.map((pipeline, i) => [pipeline, sizes[i] as number]) };
  } catch (error) {
    if (error instanceof GpuLost) throw error;
    return [{ line: undefined, text: error instanceof Error ? error.message : String(error) }];
  }
}

/** Runs all kernels; cells whose rules differ, or that count otherwise than expected, take a finer rule. */
export async function prove(compiled: Compiled, question: Question): Promise<Numbers> {
  const { device: on } = compiled.on;
  const usage = GPUBufferUsage;
  const task = on.createBuffer({ size: 48, usage: usage.UNIFORM | usage.COPY_DST });
  const counts = on.createBuffer({ size: 4 * COUNTS, usage: usage.STORAGE | usage.COPY_SRC | usage.COPY_DST });
  const sums = on.createBuffer({ size: SUMS_BYTES, usage: usage.STORAGE | usage.COPY_SRC });
  const turns = on.createBuffer({ size: 8 * (ROWS + COLUMNS + 2), usage: usage.STORAGE | usage.COPY_DST });
  const list = on.createBuffer({ size: 4 * MOST_REFINED, usage: usage.STORAGE | usage.COPY_DST });
  const back = on.createBuffer({ size: 4 * COUNTS + SUMS_BYTES, usage: usage.MAP_READ | usage.COPY_DST });
  const buffers = [task, counts, sums, turns, list];
  const words = new ArrayBuffer(48);
  new Float32Array(words).set([...question.wo, 0, ...question.parameters]);
  new Uint32Array(words).set([question.seed >>> 0, question.each], 8);
  on.queue.writeBuffer(task, 0, words);
  const start = new Uint32Array(COUNTS);
  start[CELLS + 9] = 0xffffffff;
  on.queue.writeBuffer(counts, 0, start);
  on.queue.writeBuffer(turns, 0, boundaries());
  const group = on.createBindGroup({ layout: compiled.layout, entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })) });
  const run = async (dispatches: [GPUComputePipeline, number][]) => {
    const encoder = on.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setBindGroup(0, compiled.tables);
    pass.setBindGroup(1, group);
    for (const [pipeline, groups] of dispatches) {
      pass.setPipeline(pipeline);
      pass.dispatchWorkgroups(groups);
    }
    pass.end();
    encoder.copyBufferToBuffer(counts, 0, back, 0, 4 * COUNTS);
    encoder.copyBufferToBuffer(sums, 0, back, 4 * COUNTS, SUMS_BYTES);
    on.queue.submit([encoder.finish()]);
    await work(compiled.on, back.mapAsync(GPUMapMode.READ));
    const numbers = numbersOf(back.getMappedRange().slice(0), THREADS * question.each);
    back.unmap();
    return numbers;
  };
  try {
    const [refine] = compiled.pipelines.at(-1) as [GPUComputePipeline, number];
    const first = await run(compiled.pipelines.slice(0, -1));
    const cells = doubtful(first);
    if (cells.length === 0) return first;
    on.queue.writeBuffer(list, 0, new Uint32Array(cells));
    return await run([[refine, cells.length]]);
  } finally {
    for (const buffer of [...buffers, back]) buffer.destroy();
  }
}

/** Cosine and sine of the cells' boundaries, theta before phi. */
function boundaries(): Float32Array<ArrayBuffer> {
  const turn = (angle: number) => [Math.cos(angle), Math.sin(angle)];
  const theta = Array.from({ length: ROWS + 1 }, (_, i) => turn((Math.PI * i) / ROWS));
  const phi = Array.from({ length: COLUMNS + 1 }, (_, i) => turn((2 * Math.PI * i) / COLUMNS));
  return new Float32Array([...theta, ...phi].flat());
}

/** Cells that ask for a finer rule, worst first. */
function doubtful({ samples, counts, fine, coarse }: Numbers): number[] {
  const need = Array.from({ length: CELLS }, (_, cell) => {
    const [found, expected] = [counts[cell] as number, samples * (fine[4 * cell + 3] as number)];
    const apart = samples * Math.max(...[0, 1, 2, 3].map((k) => Math.abs((fine[4 * cell + k] as number) - (coarse[4 * cell + k] as number))));
    return Math.max(apart, Math.abs(found - expected) - 4 * Math.sqrt(expected)) / Math.sqrt(Math.max(expected, 10));
  });
  const cells = need.map((_, cell) => cell).filter((cell) => (need[cell] as number) > 0.2);
  return cells.sort((a, b) => (need[b] as number) - (need[a] as number)).slice(0, MOST_REFINED);
}

function numbersOf(bytes: ArrayBuffer, samples: number): Numbers {
  const counts = new Uint32Array(bytes, 0, COUNTS);
  const sums = new Float32Array(bytes, 4 * COUNTS);
  const [weight, squares] = [[0, 0, 0], [0, 0, 0]] as [[number, number, number], [number, number, number]];
  for (let thread = 0; thread < THREADS; thread++) {
    for (let k = 0; k < 3; k++) {
      weight[k as 0] += sums[8 * thread + k] as number;
      squares[k as 0] += sums[8 * thread + 4 + k] as number;
    }
  }
  const [fine, coarse] = [new Float32Array(4 * CELLS), new Float32Array(4 * CELLS)];
  for (let cell = 0; cell < CELLS; cell++) {
    const at = 8 * (THREADS + cell);
    fine.set(sums.subarray(at, at + 4), 4 * cell);
    coarse.set(sums.subarray(at + 4, at + 8), 4 * cell);
  }
  return { samples, counts, weight, squares, fine, coarse };
}
