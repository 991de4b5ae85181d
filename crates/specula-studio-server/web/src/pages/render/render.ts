/** A render that takes samples: of the library, or of the browser's GPU. */

import { ask } from '../../core/ask';
import type { Camera, MaterialEdit, RenderAdvanceValue, RenderOpenValue, Sampler } from '../../core/protocol';
import { type Compiling, gpu, GpuLost } from '../../gpu/device';
import { type Amount, PathTracer } from '../../gpu/path_tracer';

/** What is rendered. */
export interface Setup {
  scene: string;
  size: [number, number];
  energy: string;
  sampler: string;
  camera: Camera | undefined;
  edits: MaterialEdit[];
  seed: number;
  /** `auto`: WebGPU where it is faster than the library. */
  by: string;
}

/** What a page shows of a render. */
export interface Turn {
  opened: RenderOpenValue | undefined;
  state: RenderAdvanceValue | undefined;
  colour: Float32Array | undefined;
  variance: Float32Array | undefined;
  error: string | undefined;
  /** Who takes the samples, and why. */
  by: { isGpu: boolean; words: string };
  compiling: Compiling | undefined;
}

export const EMPTY: Turn = { opened: undefined, state: undefined, colour: undefined, variance: undefined, error: undefined, by: { isGpu: false, words: '' }, compiling: undefined };

const sameJson = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);

/** Whether an open render can be changed to this, not opened anew. */
function isChange(from: Setup, to: Setup): boolean {
  const isTakenBack = (a: string, b: string) => a !== '' && b === '';
  return from.scene === to.scene && from.seed === to.seed && from.by === to.by && !isTakenBack(from.energy, to.energy) && !isTakenBack(from.sampler, to.sampler);
}

/** Who is to take the samples. */
async function choose(by: string, missing: string[]): Promise<{ isGpu: boolean; words: string }> {
  const library = (why: string) => ({ isGpu: false, words: `By the library on the processor${why}` });
  if (by === 'processor') return library('');
  if (missing.length > 0) return library(`: WebGPU does not render ${missing.join(', ')}`);
  try {
    const { name, isSoftware } = await gpu();
    if (by !== 'gpu' && isSoftware) return library(": the browser's WebGPU is software, which is slower");
    return { isGpu: true, words: `By WebGPU (${name})` };
  } catch (error) {
    return library(`: ${(error as Error).message}`);
  }
}

export class Render {
  turn: Turn = { ...EMPTY };
  private setup: Setup | undefined;
  /** The view of the scene's own camera. */
  private ownCamera: Camera | null = null;
  private tracer: PathTracer | undefined;
  private isClosed = false;

  /** `tell`: the turn has changed beside the loop. */
  constructor(private readonly tell: () => void) {}

  /** Whether it renders this. */
  isOf(setup: Setup): boolean {
    return sameJson(this.setup, setup);
  }

  get samples(): number {
    return this.turn.state?.samples ?? 0;
  }

  get seconds(): number {
    return this.turn.state?.seconds ?? 0;
  }

  get isAble(): boolean {
    return this.turn.opened !== undefined && this.turn.error === undefined;
  }

  /** Opens the render, or changes it; it begins anew, and shows its last picture until then. */
  async become(setup: Setup): Promise<void> {
    const before = this.setup;
    this.setup = setup;
    try {
      const session = this.turn.opened?.session;
      const opened = session !== undefined && before !== undefined && this.isAble && isChange(before, setup) ? await this.change(session, before, setup) : await this.open(setup);
      const hasSize = opened.width === this.turn.opened?.width && opened.height === this.turn.opened.height;
      const kept = hasSize ? { colour: this.turn.colour, variance: this.turn.variance } : {};
      this.turn = { ...EMPTY, ...kept, by: this.turn.by, opened };
      await this.ready(setup, opened);
    } catch (error) {
      this.turn = { ...this.turn, error: (error as Error).message };
    }
    if (this.isClosed) this.close();
  }

  private async open(setup: Setup): Promise<RenderOpenValue> {
    this.closeSession();
    const { scene, size, energy, sampler, camera, edits, seed } = setup;
    const given = { ...(energy === '' ? {} : { energy }), ...(sampler === '' ? {} : { sampler: sampler as Sampler }), edits, seed };
    const { value } = await ask<'render.open'>({ ask: 'render.open', scene, width: size[0], height: size[1], ...given });
    this.ownCamera = value.camera;
    if (camera === undefined) return value;
    this.turn = { ...this.turn, opened: value };
    return (await ask<'render.change'>({ ask: 'render.change', session: value.session, camera })).value;
  }

  private async change(session: number, before: Setup, setup: Setup): Promise<RenderOpenValue> {
    const { size, energy, sampler, edits } = setup;
    const camera = setup.camera ?? this.ownCamera ?? undefined;
    const gone = before.edits.filter((e) => !edits.some((other) => other.material === e.material)).map(({ material }) => ({ material, text: '' }));
    const { value } = await ask<'render.change'>({
      ask: 'render.change',
      session,
      ...(camera === undefined || sameJson(setup.camera, before.camera) ? {} : { camera }),
      ...(sameJson(edits, before.edits) ? {} : { edits: [...gone, ...edits] }),
      ...(energy === before.energy ? {} : { energy }),
      ...(sampler === before.sampler ? {} : { sampler: sampler as Sampler }),
      ...(sameJson(size, before.size) ? {} : { width: size[0], height: size[1] }),
    });
    return value;
  }

  /** Makes who takes the samples. */
  private async ready(setup: Setup, opened: RenderOpenValue): Promise<void> {
    this.tracer?.destroy();
    this.tracer = undefined;
    const by = await choose(setup.by, opened.missing);
    this.turn = { ...this.turn, by };
    if (!by.isGpu) return;
    try {
      this.tracer = await PathTracer.open(opened.session, (compiling) => {
        this.turn = { ...this.turn, compiling };
        this.tell();
      });
    } catch (error) {
      this.fallBack(error);
    }
  }

  private fallBack(error: unknown): void {
    this.tracer?.destroy();
    this.tracer = undefined;
    const words = `By the library on the processor: ${(error as Error).message}`;
    this.turn = { ...this.turn, by: { isGpu: false, words }, state: undefined, compiling: undefined };
  }

  /** Takes samples; on the processor where the GPU is lost. */
  async advance(amount: Amount): Promise<void> {
    const { tracer } = this;
    if (tracer === undefined) return this.advanceLibrary(amount);
    try {
      const state = await tracer.advance(amount);
      // Copies: what is shown is compared by identity.
      const { colour, variance } = tracer.film;
      this.turn = { ...this.turn, state, colour: colour.slice(), variance: variance.slice() };
    } catch (error) {
      if (error instanceof GpuLost) this.fallBack(error);
      else this.turn = { ...this.turn, error: (error as Error).message };
    }
  }

  private async advanceLibrary(amount: Amount): Promise<void> {
    const session = this.turn.opened?.session ?? 0;
    try {
      const { value, arrays } = await ask<'render.advance'>({ ask: 'render.advance', session, ...amount, wants: ['colour', 'variance'] });
      this.turn = { ...this.turn, state: value, colour: arrays.colour?.values, variance: arrays.variance?.values };
    } catch (error) {
      this.turn = { ...this.turn, error: (error as Error).message };
    }
  }

  /** Lets the program know that it is still wanted: it closes renders that nobody asks for in a minute. */
  async keep(): Promise<void> {
    const session = this.turn.opened?.session;
    if (session !== undefined) await ask<'render.pick'>({ ask: 'render.pick', session, x: 0, y: 0 }).catch(() => undefined);
  }

  private closeSession(): void {
    const session = this.turn.opened?.session;
    this.turn = { ...this.turn, opened: undefined };
    if (session !== undefined) void ask<'render.close'>({ ask: 'render.close', session }, undefined, true).catch(() => undefined);
  }

  close(): void {
    this.isClosed = true;
    this.tracer?.destroy();
    this.tracer = undefined;
    this.closeSession();
  }
}
