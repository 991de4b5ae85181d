/** The library in WebAssembly, in a worker: answers requests one after the other. */

interface Module {
  memory: WebAssembly.Memory;
  studio_allocate(length: number): number;
  studio_free(at: number, length: number): void;
  studio_answer(at: number, length: number): number;
}

const scope = self as unknown as { onmessage: (event: MessageEvent) => void; postMessage(data: unknown, move?: Transferable[]): void };
let ready: Promise<Module>;

async function start(base64: string): Promise<Module> {
  const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  // Not by a Blob: WebKit reads none in a page from disk.
  const gzip = new DecompressionStream('gzip');
  const writer = gzip.writable.getWriter();
  const written = writer.write(packed).then(() => writer.close());
  const [bytes] = await Promise.all([new Response(gzip.readable).arrayBuffer(), written]);
  const { instance } = await WebAssembly.instantiate(bytes, { env: { now: () => performance.now() } });
  return instance.exports as unknown as Module;
}

function answer(module: Module, text: string): ArrayBuffer {
  const request = new TextEncoder().encode(text);
  const at = module.studio_allocate(request.length);
  new Uint8Array(module.memory.buffer, at, request.length).set(request);
  const found = module.studio_answer(at, request.length) >>> 0;
  module.studio_free(at, request.length);
  const length = new DataView(module.memory.buffer).getUint32(found, true);
  const bytes = module.memory.buffer.slice(found + 4, found + 4 + length) as ArrayBuffer;
  module.studio_free(found, length + 4);
  return bytes;
}

scope.onmessage = async ({ data }) => {
  if (data.module !== undefined) {
    ready = start(data.module);
    return;
  }
  try {
    const bytes = answer(await ready, data.text);
    scope.postMessage({ id: data.id, bytes }, [bytes]);
  } catch (error) {
    scope.postMessage({ id: data.id, error: `the library stopped: ${error}` });
  }
};
