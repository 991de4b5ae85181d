/** What only the program's server has: files, the laboratory. */

import { AskError, backend } from './ask';

/** Whether there is a server. */
export const hasServer = backend === 'server';

/** What the program says is wrong; of a scene's file, where. */
interface Problem {
  error?: string;
  file?: string;
  line?: number;
  column?: number;
  help?: string;
}

function worded({ error, file, line, column, help }: Problem): string {
  const place = file === undefined || file === '' ? '' : `${[file, line, column].filter((part) => part !== undefined && part !== null).join(':')}: `;
  return `${place}${error}${help === undefined || help === null ? '' : `\n${help}`}`;
}

async function read<T>(response: Response): Promise<T> {
  if (response.status === 403) throw new AskError('open the address that `specula studio` printed: it holds the token');
  const text = await response.text();
  let value: T & Problem;
  try {
    value = JSON.parse(text);
  } catch {
    throw new AskError(text === '' ? `the program answered ${response.status}` : text);
  }
  if (typeof value.error === 'string') throw new AskError(worded(value));
  if (!response.ok) throw new AskError(`the program answered ${response.status}`);
  return value;
}

/** The JSON at a path. */
export async function get<T>(path: string): Promise<T> {
  return read(await reach(path, { headers: { 'x-specula': '1' } }));
}

/** Posts JSON; returns JSON. */
export async function post<T>(path: string, body: unknown = {}): Promise<T> {
  const headers = { 'content-type': 'application/json', 'x-specula': '1' };
  return read(await reach(path, { method: 'POST', headers, body: JSON.stringify(body) }));
}

/** Posts bytes; returns JSON. */
export async function upload<T>(path: string, body: Blob): Promise<T> {
  return read(await reach(path, { method: 'POST', headers: { 'content-type': 'application/octet-stream', 'x-specula': '1' }, body }));
}

async function reach(path: string, init: RequestInit): Promise<Response> {
  try {
    return await fetch(path, init);
  } catch {
    throw new AskError('the program does not answer: is `specula studio` still running?');
  }
}
