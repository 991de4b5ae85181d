/** The path tracer of `specula-gpu` in the browser: samples of the scene of a session, in dispatches that stay short. */

import { ask, type Answer } from '../core/ask';
import type { RenderAdvanceValue } from '../core/protocol';
import { bindings, type Compiling, type Gpu, gpu, pipeline, readBack, storage, work } from './device';
import { Film } from './film';
import sumsText from './sums.wgsl';

/** Bytes of a sample among the results. */
const SAMPLE_SIZE = 48;
/** Bytes of a pixel's sums. */
const SUMS_SIZE = 48;
/** Most samples of a dispatch: their results fit into the largest array that every device binds. */
const MOST_SAMPLES = Math.floor((128 << 20) / SAMPLE_SIZE / 64) * 64;
/** Samples of a first dispatch, before the device's speed is known. */
const FIRST_SAMPLES = 1 << 14;
/** Seconds that a dispatch is to take: the browser draws between two of them. */
const DISPATCH_SECONDS = 0.04;
/** Most samples of a pixel in a dispatch. */
const MOST_SLOTS = 64;

const ARRAYS = ['tables', 'nodes', 'packets', 'words'] as const;

/** How much is to be done: about so many seconds, and at most so many samples a pixel. */
export type Amount = { seconds?: number; samples: number };

export class PathTracer {
  private readonly sums: GPUBuffer;
  private readonly task: GPUBuffer;
  private readonly requests: GPUBuffer;
  private readonly results: GPUBuffer;
  private readonly scene: GPUBuffer[];
  private readonly sceneGroup: GPUBindGroup;
  private readonly sumsGroup: GPUBindGroup;
  private readonly capacity: number;
  readonly film: Film;
  private seconds = 0;
  private rays = 0;
  private samples = 0;
  /** Samples a second lately; 0: not known. */
  private rate = 0;

  private constructor(
    readonly gpu: Gpu,
    private readonly settings: readonly number[],
    private readonly pipelines: { path: GPUComputePipeline; sums: GPUComputePipeline },
    layouts: GPUBindGroupLayout[],
    arrays: Answer<'render.gpu'>['arrays'],
    readonly width: number,
    readonly height: number,
  ) {
    const { device } = gpu;
    const usage = GPUBufferUsage;
    const pixels = width * height;
    this.film = new Film(width, height);
    this.capacity = Math.min(MOST_SAMPLES, Math.max(64, MOST_SLOTS * pixels));
    this.scene = ARRAYS.map((name) => storage(device, arrays[name].values));
    this.task = device.createBuffer({ size: 16, usage: usage.UNIFORM | usage.COPY_DST });
    this.requests = device.createBuffer({ size: 16 * (2 + pixels), usage: usage.STORAGE | usage.COPY_DST });
    this.results = device.createBuffer({ size: SAMPLE_SIZE * this.capacity, usage: usage.STORAGE });
    this.sums = device.createBuffer({ size: SUMS_SIZE * pixels, usage: usage.STORAGE | usage.COPY_SRC | usage.COPY_DST });
    const group = (layout: GPUBindGroupLayout | undefined, buffers: GPUBuffer[]) =>
      device.createBindGroup({ layout: layout as GPUBindGroupLayout, entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })) });
    this.sceneGroup = group(layouts[0], [...this.scene, this.requests, this.results]);
    this.sumsGroup = group(layouts[1], [this.task, this.results, this.sums]);
  }

  /** The tracer of a session's scene; `tell` hears what is being compiled. */
  static async open(session: number, tell: (compiling: Compiling | undefined) => void): Promise<PathTracer> {
    const on = await gpu();
    const { value, arrays } = await ask<'render.gpu'>({ ask: 'render.gpu', session });
    const scene = bindings(on.device, [...Array<'read-only-storage'>(5).fill('read-only-storage'), 'storage']);
    const sums = bindings(on.device, ['uniform', 'read-only-storage', 'storage']);
    try {
      const made = {
        path: await pipeline(on, value.wgsl, 'path_main', [scene], tell),
        sums: await pipeline(on, sumsText, 'sums_main', [sums]),
      };
      return new PathTracer(on, value.settings, made, [scene, sums], arrays, value.width, value.height);
    } finally {
      tell(undefined);
    }
  }

  /** Takes samples of every pixel; the picture is in `film`. */
  async advance(amount: Amount): Promise<RenderAdvanceValue> {
    const pixels = this.width * this.height;
    const begun = performance.now();
    const spent = () => (performance.now() - begun) / 1000;
    const encoder = this.gpu.device.createCommandEncoder();
    encoder.clearBuffer(this.sums);
    this.gpu.device.queue.submit([encoder.finish()]);
    const fitting = () => (amount.seconds === undefined ? Infinity : this.fitting(amount.seconds - spent(), pixels));
    let taken = 0;
    do {
      const left = Math.min(amount.samples - taken, fitting());
      const each = Math.max(1, Math.min(left, MOST_SLOTS, Math.floor(this.dispatchSamples() / pixels)));
      const span = Math.max(1, Math.min(pixels, Math.floor(this.dispatchSamples() / each)));
      for (let first = 0; first < pixels; first += span) await this.dispatch(first, Math.min(span, pixels - first), this.samples + taken, each);
      taken += each;
    } while (taken < amount.samples && fitting() >= 1);
    const bytes = await readBack(this.gpu, this.sums, SUMS_SIZE * pixels);
    this.rays += this.film.add(new Float32Array(bytes), taken);
    this.samples += taken;
    this.seconds += spent();
    return { samples: this.samples, seconds: this.seconds, rays: this.rays, invalid: this.film.invalid, ...this.film.figures() };
  }

  /** Samples of every pixel that fit into a time. */
  private fitting(seconds: number, pixels: number): number {
    return this.rate === 0 ? 0 : Math.floor((seconds * this.rate) / pixels);
  }

  private dispatchSamples(): number {
    const wanted = this.rate === 0 ? FIRST_SAMPLES : this.rate * DISPATCH_SECONDS;
    return Math.max(64, Math.min(wanted, this.capacity));
  }

  /** So many samples of each of so many pixels, summed. */
  private async dispatch(first: number, count: number, sample: number, each: number): Promise<void> {
    const { device } = this.gpu;
    const words = new Uint32Array(4 * (2 + count));
    words.set([each, count, 0, 0, ...this.settings]);
    for (let i = 0; i < count; i++) {
      const pixel = first + i;
      words.set([pixel % this.width, Math.floor(pixel / this.width), sample, each], 8 + 4 * i);
    }
    device.queue.writeBuffer(this.requests, 0, words);
    device.queue.writeBuffer(this.task, 0, new Uint32Array([first, count, each, 0]));
    const begun = performance.now();
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(this.pipelines.path);
    pass.setBindGroup(0, this.sceneGroup);
    pass.dispatchWorkgroups(Math.ceil((count * each) / 64));
    pass.setPipeline(this.pipelines.sums);
    pass.setBindGroup(0, this.sumsGroup);
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    device.queue.submit([encoder.finish()]);
    await work(this.gpu, device.queue.onSubmittedWorkDone());
    const now = (count * each) / Math.max((performance.now() - begun) / 1000, 1e-4);
    this.rate = this.rate === 0 ? now : Math.sqrt(this.rate * now);
  }

  /** Gives its memory back. */
  destroy(): void {
    for (const buffer of [...this.scene, this.task, this.requests, this.results, this.sums]) buffer.destroy();
  }
}
