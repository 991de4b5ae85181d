// Answers requests by the module: node run.mjs MODULE REQUEST... prints the answers' values, and what the module takes.
import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

const [file, ...requests] = process.argv.slice(1);
const bytes = readFileSync(file);
const env = { now: () => performance.now() };
const { exports } = (await WebAssembly.instantiate(bytes, { env })).instance;

function ask(text) {
  const request = new TextEncoder().encode(text);
  const at = exports.studio_allocate(request.length);
  new Uint8Array(exports.memory.buffer, at, request.length).set(request);
  const answer = exports.studio_answer(at, request.length);
  exports.studio_free(at, request.length);
  const length = new DataView(exports.memory.buffer).getUint32(answer, true);
  const copy = new Uint8Array(exports.memory.buffer, answer + 4, length).slice();
  exports.studio_free(answer, 4 + length);
  const json = new DataView(copy.buffer).getUint32(0, true);
  const { value, error } = JSON.parse(new TextDecoder().decode(copy.subarray(4, 4 + json)));
  if (error !== undefined) throw new Error(`${text}: ${error}`);
  return value;
}

let seconds = 0;
const answers = requests.map((request) => {
  const begin = performance.now();
  const value = ask(request);
  seconds = (performance.now() - begin) / 1000;
  return value;
});
const memory = exports.memory.buffer.byteLength;
console.log(JSON.stringify({ answers, seconds, memory, gzip: gzipSync(bytes, { level: 9 }).length }));
