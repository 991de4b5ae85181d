/** The browser's GPU: one device for all pages; pipelines are compiled beside the page, each text once. */

/** Why there is no device, in words. */
export const NO_WEBGPU = 'This browser has no WebGPU. Chromium 113, Firefox 141, Safari 26 and later have it.';

/** A device that was lost, in words. */
export class GpuLost extends Error {
  override name = 'GpuLost';
}

export interface Gpu {
  device: GPUDevice;
  /** As the browser names it; it may say little. */
  name: string;
  /** The processor does its work: slower than the library. */
  isSoftware: boolean;
  /** Set once the device is lost. */
  lost: GpuLost | undefined;
}

/** What is being compiled, and since when (`performance.now`). */
export interface Compiling {
  what: string;
  since: number;
}

let found: Promise<Gpu> | undefined;

/** The device; a new one after one was lost. Rejects with `NO_WEBGPU` where there is none. */
export function gpu(): Promise<Gpu> {
  if (found === undefined) {
    found = open();
    found.catch(() => {
      found = undefined;
    });
  }
  return found;
}

async function open(): Promise<Gpu> {
  const adapter = await navigator.gpu?.requestAdapter({ powerPreference: 'high-performance' });
  if (adapter === null || adapter === undefined) throw new Error(NO_WEBGPU);
  const { vendor, architecture, description, isFallbackAdapter } = adapter.info as GPUAdapterInfo & { isFallbackAdapter?: boolean };
  const words = [description, vendor, architecture].filter((word) => word !== '');
  const device = await adapter.requestDevice();
  const made: Gpu = {
    device,
    name: words[0] ?? 'unnamed adapter',
    isSoftware: isFallbackAdapter === true || /swiftshader|llvmpipe|lavapipe|software|warp/i.test(words.join(' ')),
    lost: undefined,
  };
  void device.lost.then(({ message }) => {
    made.lost = new GpuLost(`the GPU was lost${message === '' ? '' : `: ${message}`}`);
    pipelines.delete(device);
    found = undefined;
  });
  return made;
}

/** Waits for work of a device; rejects where the device is lost meanwhile. */
export async function work<T>(on: Gpu, result: Promise<T>): Promise<T> {
  let value: T;
  try {
    value = await result;
  } catch (error) {
    // The loss is told a moment after what it breaks.
    await new Promise((resolve) => setTimeout(resolve, 0));
    throw on.lost ?? error;
  }
  if (on.lost !== undefined) throw on.lost;
  return value;
}

const pipelines = new WeakMap<GPUDevice, Map<string, Promise<GPUComputePipeline>>>();

/** Bindings of a group, in order. */
export function bindings(device: GPUDevice, types: GPUBufferBindingType[]): GPUBindGroupLayout {
  const entries = types.map((type, binding) => ({ binding, visibility: GPUShaderStage.COMPUTE, buffer: { type } }));
  return device.createBindGroupLayout({ entries });
}

/** The pipeline of a text; `tell` hears that it is being compiled. Never blocks the page. */
export function pipeline(on: Gpu, code: string, entryPoint: string, layouts: GPUBindGroupLayout[], tell: (compiling: Compiling) => void = () => undefined): Promise<GPUComputePipeline> {
  const { device } = on;
  let made = pipelines.get(device);
  if (made === undefined) pipelines.set(device, (made = new Map()));
  let one = made.get(code);
  if (one === undefined) {
    one = compile(on, code, entryPoint, layouts);
    made.set(code, one);
    one.catch(() => made.delete(code));
  }
  tell({ what: `${code.split('\n').length.toLocaleString('en')} lines of WGSL`, since: performance.now() });
  return one;
}

/** A text as a module, and what the browser finds wrong with it. */
export async function shader(on: Gpu, code: string): Promise<{ module: GPUShaderModule; faults: { line: number; text: string }[] }> {
  on.device.pushErrorScope('validation');
  const module = on.device.createShaderModule({ code });
  const said = on.device.popErrorScope();
  const { messages } = await work(on, module.getCompilationInfo());
  await said;
  const faults = messages.filter(({ type }) => type === 'error').map(({ lineNum, message }) => ({ line: lineNum, text: message }));
  return { module, faults };
}

async function compile(on: Gpu, code: string, entryPoint: string, layouts: GPUBindGroupLayout[]): Promise<GPUComputePipeline> {
  const { module, faults } = await shader(on, code);
  const [wrong] = faults;
  if (wrong !== undefined) throw new Error(`the shader does not compile: line ${wrong.line}: ${wrong.text}`);
  const layout = on.device.createPipelineLayout({ bindGroupLayouts: layouts });
  return work(on, on.device.createComputePipelineAsync({ layout, compute: { module, entryPoint } }));
}

/** A storage buffer with these bytes, a whole number of words. */
export function storage(device: GPUDevice, bytes: Uint8Array, usage = 0): GPUBuffer {
  const size = Math.max(16, (bytes.byteLength + 3) & ~3);
  const buffer = device.createBuffer({ size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | usage });
  if (bytes.byteLength % 4 === 0) device.queue.writeBuffer(buffer, 0, bytes as BufferSource);
  else {
    const padded = new Uint8Array(size);
    padded.set(bytes);
    device.queue.writeBuffer(buffer, 0, padded);
  }
  return buffer;
}

/** The bytes of a buffer that can be copied from. */
export async function readBack(on: Gpu, from: GPUBuffer, size: number): Promise<ArrayBuffer> {
  const back = on.device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  try {
    const encoder = on.device.createCommandEncoder();
    encoder.copyBufferToBuffer(from, 0, back, 0, size);
    on.device.queue.submit([encoder.finish()]);
    await work(on, back.mapAsync(GPUMapMode.READ));
    return back.getMappedRange().slice(0);
  } finally {
    back.destroy();
  }
}
