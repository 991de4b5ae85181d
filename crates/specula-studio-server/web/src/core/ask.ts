/** Asks the library: over the program's server, or in WebAssembly where a page has none. */

import workerText from 'worker:./wasm_worker.ts';
import type { ByteArray, FloatArray, IntegerArray, Protocol } from './protocol';

export type Ask = keyof Protocol;
export interface Answer<K extends Ask> {
  value: Protocol[K][1];
  arrays: Protocol[K][2];
}

/** A request that has no answer, in words for a person. */
export class AskError extends Error {
  override name = 'AskError';
}

declare global {
  /** The WebAssembly module, gzip'ed, as base64: set by a script of an exported site. */
  var SPECULA_WASM: string | undefined;
}

/** Where requests are answered. */
export type Backend = 'server' | 'wasm' | 'none';
export const backend: Backend = globalThis.SPECULA_WASM !== undefined ? 'wasm' : isExported() ? 'none' : 'server';

/** Whether the page is one that `specula studio --export` wrote. */
function isExported(): boolean {
  return !location.protocol.startsWith('http') || document.querySelector('meta[name=generator]') !== null;
}

/** The answer to a request. `signal`: gives up waiting for it; `isLast`: it is sent even where the page goes away. */
export async function ask<K extends Ask>(request: Protocol[K][0] & { ask: K }, signal?: AbortSignal, isLast = false): Promise<Answer<K>> {
  const text = JSON.stringify(request);
  if (backend === 'wasm') return decode<K>(await askWorker(text, signal));
  if (backend === 'none') throw new AskError('this page has neither a program nor the WebAssembly module: export it with --wasm, or start `specula studio`');
  let response: Response;
  try {
    response = await fetch('/api/ask', {
      method: 'POST',
      headers: { 'content-type': 'application/json', 'x-specula': '1' },
      body: text,
      signal: signal ?? null,
      keepalive: isLast,
    });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new AskError('the program does not answer: is `specula studio` still running?');
  }
  if (response.status === 403) throw new AskError('open the address that `specula studio` printed: it holds the token');
  if (!response.ok) throw new AskError(`the program answered ${response.status}: ${await response.text()}`);
  return decode<K>(await response.arrayBuffer());
}

/** Reads the bytes of an answer; see `specula-studio/src/answer.rs`. */
function decode<K extends Ask>(buffer: ArrayBuffer): Answer<K> {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  if (head.error !== undefined) throw new AskError(head.error);
  const arrays: Record<string, FloatArray | IntegerArray | ByteArray> = {};
  for (const { name, type, shape, offset } of head.arrays) {
    const count = shape.reduce((product: number, side: number) => product * side, 1);
    const at = 4 + length + offset;
    if (type === 'f32') arrays[name] = { shape, values: new Float32Array(buffer, at, count) };
    else if (type === 'u32') arrays[name] = { shape, values: new Uint32Array(buffer, at, count) };
    else arrays[name] = { shape, values: new Uint8Array(buffer, at, count) };
  }
  return { value: head.value, arrays: arrays as Answer<K>['arrays'] };
}

let worker: Worker | undefined;
let last = 0;
const waiting = new Map<number, { resolve: (bytes: ArrayBuffer) => void; reject: (error: unknown) => void }>();

function askWorker(text: string, signal?: AbortSignal): Promise<ArrayBuffer> {
  if (worker === undefined) {
    worker = new Worker(URL.createObjectURL(new Blob([workerText], { type: 'text/javascript' })));
    worker.onmessage = ({ data: { id, bytes, error } }) => {
      const asked = waiting.get(id);
      waiting.delete(id);
      if (error !== undefined) asked?.reject(new AskError(error));
      else asked?.resolve(bytes);
    };
    worker.postMessage({ module: globalThis.SPECULA_WASM });
  }
  const id = ++last;
  return new Promise((resolve, reject) => {
    waiting.set(id, { resolve, reject });
    signal?.addEventListener('abort', () => {
      waiting.delete(id);
      reject(signal.reason);
    });
    worker?.postMessage({ id, text });
  });
}
