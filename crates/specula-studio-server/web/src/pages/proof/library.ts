/** Which functions of the exported shaders a text calls, and their text. */

import { ask } from '../../core/ask';

export interface Library {
  wgsl: string;
  tables: Uint8Array;
}

const WORDS = 'if for while loop switch return else fn let var const struct alias array atomic bitcast case continuing override enable requires ptr const_assert';
const BUILT_IN =
  'abs acos acosh all any arrayLength asin asinh atan atan2 atanh ceil clamp cos cosh countLeadingZeros countOneBits countTrailingZeros cross degrees determinant distance dot dot4U8Packed dot4I8Packed dpdx dpdy exp exp2 extractBits faceForward firstLeadingBit firstTrailingBit floor fma fract frexp insertBits inverseSqrt ldexp length log log2 max min mix modf normalize pack2x16float pack2x16snorm pack2x16unorm pack4x8snorm pack4x8unorm pow quantizeToF16 radians reflect refract reverseBits round saturate select sign sin sinh smoothstep sqrt step tan tanh transpose trunc unpack2x16float unpack2x16snorm unpack2x16unorm unpack4x8snorm unpack4x8unorm storageBarrier workgroupBarrier i32 u32 f32 f16 bool';
const KNOWN = new Set(`${WORDS} ${BUILT_IN}`.split(' '));

/** A text without its comments, lines kept. */
function bare(text: string): string {
  return text.replace(/\/\*[\s\S]*?\*\//g, (found) => found.replace(/[^\n]/g, ' ')).replace(/\/\/[^\n]*/g, '');
}

/** What the text calls and neither defines nor WGSL has. */
export function foreignCalls(text: string): string[] {
  const code = bare(text);
  const own = new Set([...code.matchAll(/\b(?:fn|struct|alias)\s+([A-Za-z_]\w*)/g)].map((m) => m[1] as string));
  const called = [...code.matchAll(/\b([A-Za-z_]\w*)\s*\(/g)].map((m) => m[1] as string);
  const isType = (name: string) => /^(vec[234][fiuh]?|mat[234]x[234][fh]?)$/.test(name);
  return [...new Set(called)].filter((name) => !own.has(name) && !KNOWN.has(name) && !isType(name));
}

/** The names of the interface that a text lacks. */
export function missing(text: string): string[] {
  const code = bare(text);
  return ['user_eval', 'user_pdf', 'user_sample'].filter((name) => !new RegExp(`\\bfn\\s+${name}\\b`).test(code));
}

const asked = new Map<string, Promise<Library>>();

/** The text of functions with all that they call. */
export function libraryOf(functions: string[]): Promise<Library> {
  const key = [...functions].sort().join();
  let found = asked.get(key);
  if (found === undefined) {
    found = ask({ ask: 'shaders.library', functions }).then(({ value, arrays }) => ({ wgsl: value.wgsl, tables: arrays.tables.values }));
    found.catch(() => asked.delete(key));
    asked.set(key, found);
  }
  return found;
}
