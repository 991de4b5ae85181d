/**
 * What a page asks for, and what it gets: the requests of the Rust crate `specula-studio`.
 *
 * A request is JSON with its name in `ask`; an answer is a JSON value and named arrays, in the bytes that
 * `specula-studio/src/answer.rs` describes. Over a server: `POST /api/ask`. In WebAssembly: a message to a worker.
 *
 * Directions are unit vectors in the local frame, z along the normal; both point away from the surface. Angles are
 * radians. Colours are linear sRGB. Seeds are integers below 2^53.
 */

export type Vec3 = [number, number, number];
export type Rgb = [number, number, number];
export type FloatArray = { shape: number[]; values: Float32Array };
export type IntegerArray = { shape: number[]; values: Uint32Array };
export type ByteArray = { shape: number[]; values: Uint8Array };

/** A number of a proof: whether it holds, and what it says. `p` only where chance plays. */
export interface Check {
  name: string;
  holds: boolean;
  /** In words, with figures. */
  text: string;
  p?: number;
}

// ---------------------------------------------------------------------------------------------------- lobes

/** A parameter of a kind of lobe. */
export interface Parameter {
  key: string;
  /** `alpha`: one or two numbers; `metal`: reflectance of a conductor, a symbol or a colour. */
  type: 'number' | 'count' | 'alpha' | 'colour' | 'choice' | 'flag' | 'metal';
  /** As in the text form; `null`: none. */
  default: string | null;
  low?: number;
  high?: number;
  choices?: string[];
  doc: string;
}

export interface LobeKind {
  name: string;
  doc: string;
  parameters: Parameter[];
}

/** `lobes.kinds` */
export interface LobesKinds {
  ask: 'lobes.kinds';
}
export interface LobesKindsValue {
  kinds: LobeKind[];
  metals: { symbol: string; name: string }[];
}

/** `lobes.parse`: reads the text form, such as `conductor Au alpha 0.3,0.1 energy turquin`. */
export interface LobesParse {
  ask: 'lobes.parse';
  lobe: string;
}
export interface LobesParseValue {
  /** The text in its normal form. */
  lobe: string;
  kind: string;
  /** What was given, by key; a value as in the text form. */
  given: Record<string, string>;
  /** Values are estimates (random walks). */
  isStochastic: boolean;
  /** Nothing but Dirac deltas. */
  isSpecular: boolean;
  /** Light passes through it. */
  transmits: boolean;
}

/**
 * `lobes.slice`: a plane through the normal. Arrays: `theta` (count), from -pi to pi, 0 is the normal, positive
 * towards `azimuth`; `f_cos` (count, 3), `f |cos|` in 1/sr; `pdf` (count), 1/sr. Estimates are means of `samples`.
 */
export interface LobesSlice {
  ask: 'lobes.slice';
  lobe: string;
  wo: Vec3;
  azimuth: number;
  count: number;
  samples?: number;
  seed?: number;
}
export interface LobesSliceArrays {
  theta: FloatArray;
  f_cos: FloatArray;
  pdf: FloatArray;
}

/**
 * `lobes.grid`: all directions, rows of cos theta from 1 to -1 (or to 0 where `sphere` is false), columns of phi from
 * 0 to 2 pi, both at vertices: `theta` (rows), `phi` (columns), `f_cos` (rows, columns, 3), `pdf` (rows, columns).
 * Rows are spaced evenly in theta.
 */
export interface LobesGrid {
  ask: 'lobes.grid';
  lobe: string;
  wo: Vec3;
  rows: number;
  columns: number;
  sphere: boolean;
  samples?: number;
  seed?: number;
}
export interface LobesGridArrays {
  theta: FloatArray;
  phi: FloatArray;
  f_cos: FloatArray;
  pdf: FloatArray;
}

/**
 * `lobes.albedo`: directional albedo over the view's cosine, from samples of the lobe. Arrays: `cos` (count),
 * `albedo` (count, 3), `error` (count, 3; standard deviation of the mean).
 */
export interface LobesAlbedo {
  ask: 'lobes.albedo';
  lobe: string;
  count: number;
  samples: number;
  seed?: number;
}
export interface LobesAlbedoArrays {
  cos: FloatArray;
  albedo: FloatArray;
  error: FloatArray;
}

/**
 * `lobes.samples`: arrays `wi` (count, 3), `weight` (count, 3; `f |cos| / pdf`), `pdf` (count; 0: the sample failed, or
 * is a Dirac delta), `u` (count, 3).
 */
export interface LobesSamples {
  ask: 'lobes.samples';
  lobe: string;
  wo: Vec3;
  count: number;
  seed?: number;
}
export interface LobesSamplesValue {
  failed: number;
  /** Mean weight, failed samples counted as 0: the albedo. */
  albedo: Rgb;
  /** Variance of the weight's luminance. */
  variance: number;
}
export interface LobesSamplesArrays {
  wi: FloatArray;
  weight: FloatArray;
  pdf: FloatArray;
  u: FloatArray;
}

/**
 * `lobes.prove`: chi-square, normalisation, furnace (`weight = f cos / pdf`), reciprocity, at one view. Arrays: of the
 * chi-square, `counts` and `expected` (rows, columns) over cos theta (from 1 down) and phi. Absent where it is not
 * tested.
 */
export interface LobesProve {
  ask: 'lobes.prove';
  lobe: string;
  wo: Vec3;
  samples: number;
  seed?: number;
}
export interface LobesProveValue {
  checks: Check[];
}
export interface LobesProveArrays {
  counts?: FloatArray;
  expected?: FloatArray;
}

/**
 * `lobes.walks`: random walks of light in a Smith surface, for drawings. Arrays: `offsets` (count + 1; u32; vertices of
 * walk i are those from `offsets[i]` up to `offsets[i + 1]`), `height` (vertices; in alphas, 0 is the mean height;
 * infinite: out of the surface), `direction` (vertices, 3; the direction in which light leaves the vertex; at the
 * first one, that in which it comes in, pointing down), `weight` (vertices, 3; throughput after the vertex).
 */
export interface LobesWalks {
  ask: 'lobes.walks';
  lobe: string;
  wo: Vec3;
  count: number;
  seed?: number;
}
export interface LobesWalksValue {
  /** Share of walks by number of bounces, 1, 2, 3, ...; the last is "more". */
  bounces: number[];
}
export interface LobesWalksArrays {
  offsets: IntegerArray;
  height: FloatArray;
  direction: FloatArray;
  weight: FloatArray;
}

export type Language = 'specula' | 'rust' | 'wgsl' | 'hlsl' | 'glsl' | 'metal' | 'cpp' | 'c' | 'python' | 'pbrt' | 'mitsuba';
/** `lobes.code`: the lobe in a language; an error where it cannot be said in it. */
export interface LobesCode {
  ask: 'lobes.code';
  lobe: string;
  language: Language;
}
export interface LobesCodeValue {
  text: string;
}

// ------------------------------------------------------------------------------------------------- samplers

export type Sampler = 'heitz' | 'cap' | 'bounded' | 'exact';

/** A GGX surface, a view and a sampler of its reflections. `alpha`: along x and y. `wo` may be below the horizon. */
export interface SamplerSetup {
  sampler: Sampler;
  alpha: [number, number];
  wo: Vec3;
}

/** A formula with the current numbers. */
export interface Formula {
  id: string;
  name: string;
  /** TeX, in the paper's notation as `docs/glossary.md` maps it. */
  tex: string;
  /** TeX with numbers put in. */
  numbers: string;
  value: number;
  /** Paper and equation, or our own derivation. */
  source: string;
}

/** `samplers.describe` */
export interface SamplersDescribe extends SamplerSetup {
  ask: 'samplers.describe';
}
export interface SamplersDescribeValue {
  formulas: Formula[];
  /** Share of samples above the horizon, by quadrature. */
  acceptance: number;
  /** The view in the stretched space. */
  stretched: Vec3;
}

/**
 * `samplers.regions`: outlines, closed, of unit vectors (count, 3 each). In the stretched space, for reflections of the
 * stretched view: `cap` (lower bound of the cap, z = -stretched.z), `bounded_cap` (z = -k stretched.z), `exact` (the
 * exact region's image: what maps above the horizon), `horizon` (z = 0). On the sphere of wi: `cap_wi`,
 * `bounded_cap_wi`, `exact_wi` (the same outlines, taken to reflections of the surface).
 */
export interface SamplersRegions {
  ask: 'samplers.regions';
  alpha: [number, number];
  wo: Vec3;
  count: number;
}
export type SamplersRegionsArrays = Record<
  'cap' | 'bounded_cap' | 'exact' | 'horizon' | 'cap_wi' | 'bounded_cap_wi' | 'exact_wi',
  FloatArray
>;

/**
 * `samplers.samples`: arrays `wi`, `wm`, `stretched` (count, 3 each; `stretched`: the sample on the sphere of the
 * stretched space), `pdf` (count), `accepted` (count; bytes 0 or 1: above the horizon).
 */
export interface SamplersSamples extends SamplerSetup {
  ask: 'samplers.samples';
  count: number;
  seed?: number;
}
export interface SamplersSamplesValue {
  accepted: number;
  rejected: number;
}
export interface SamplersSamplesArrays {
  wi: FloatArray;
  wm: FloatArray;
  stretched: FloatArray;
  pdf: FloatArray;
  accepted: ByteArray;
}

/**
 * `samplers.histogram`: reflections on the unit disk (x, y of wi, each from -1 to 1; rows from y = 1 down). Arrays:
 * `counts` and `expected` (size, size); the latter by quadrature of the pdf, in samples.
 */
export interface SamplersHistogram extends SamplerSetup {
  ask: 'samplers.histogram';
  size: number;
  count: number;
  seed?: number;
}
export interface SamplersHistogramValue {
  rejected: number;
  /** By the pdf's normalisation. */
  expectedRejected: number;
  chiSquare: number;
  degrees: number;
  p: number;
}
export interface SamplersHistogramArrays {
  counts: FloatArray;
  expected: FloatArray;
}

/** A light, as what an estimator sees: everywhere, or a disk of half angle `angle` around `towards`. */
export interface Lamp {
  towards?: Vec3;
  angle?: number;
}

/** `samplers.compare`: all samplers on one surface under one light. */
export interface SamplersCompare {
  ask: 'samplers.compare';
  alpha: [number, number];
  wo: Vec3;
  lamp: Lamp;
  count: number;
  seed?: number;
}
export interface SamplersCompareValue {
  rows: {
    sampler: Sampler;
    /** Share of samples above the horizon. */
    acceptance: number;
    /** Mean of weight times light: the same for all. */
    mean: number;
    /** Standard deviation of that mean. */
    error: number;
    /** Of one sample. */
    variance: number;
    /** Nanoseconds a sample, where a clock is there. */
    nanoseconds: number | null;
  }[];
}

// --------------------------------------------------------------------------------------------------- render

export interface Camera {
  eye: Vec3;
  target: Vec3;
  up: Vec3;
  /** Of the shorter side. */
  fovDegrees: number;
}

export interface SceneItem {
  /** What `render.open` takes. */
  name: string;
  title: string;
  from: 'built-in' | 'given' | 'dropped';
}

/** `render.scenes` */
export interface RenderScenes {
  ask: 'render.scenes';
}
export interface RenderScenesValue {
  scenes: SceneItem[];
  /** Scenes can be dropped or opened by path. */
  opensFiles: boolean;
}

export interface MaterialEdit {
  /** Name or number of the material. */
  material: number;
  /** As of `render --material`. */
  text: string;
}

/** `render.open`: a render of a scene; it takes samples when it is told to. Width and height: the scene's own. */
export interface RenderOpen {
  ask: 'render.open';
  scene: string;
  width?: number;
  height?: number;
  seed?: number;
  maxDepth?: number;
  camera?: Camera;
  edits?: MaterialEdit[];
  /** What becomes of the energy that one bounce loses, for every metal; as of `render --energy`. */
  energy?: string;
  /** Sampler of reflections off GGX, for every metal. */
  sampler?: Sampler;
}
export interface RenderOpenValue {
  session: number;
  width: number;
  height: number;
  camera: Camera | null;
  materials: { id: number; name: string; kind: string; text: string | null }[];
  warnings: string[];
  energies: string[];
  /** What WebGPU cannot render of the scene; empty: it can. */
  missing: string[];
  triangles: number;
}

/**
 * `render.advance`: takes samples for about so many seconds, or exactly so many a pixel. Arrays, where `wants` them:
 * `colour` (height, width, 3), `variance` (height, width, 3; of the mean).
 */
export interface RenderAdvance {
  ask: 'render.advance';
  session: number;
  seconds?: number;
  samples?: number;
  wants?: ('colour' | 'variance' | 'albedo' | 'normal' | 'depth')[];
}
export interface RenderAdvanceValue {
  /** Of every pixel, so far. */
  samples: number;
  /** Spent on samples, so far. */
  seconds: number;
  rays: number;
  invalid: number;
  /** Mean of the picture. */
  mean: Rgb;
  /** Estimated relative error of a pixel, root mean square. */
  noise: number;
}
export interface RenderAdvanceArrays {
  colour?: FloatArray;
  variance?: FloatArray;
  albedo?: FloatArray;
  normal?: FloatArray;
  depth?: FloatArray;
}

/** `render.change`: another camera, other materials; begins anew. The answer is that of `render.open`. */
export interface RenderChange {
  ask: 'render.change';
  session: number;
  camera?: Camera;
  edits?: MaterialEdit[];
  energy?: string;
  sampler?: Sampler;
  width?: number;
  height?: number;
}

/** `render.pick`: what is at a pixel. */
export interface RenderPick {
  ask: 'render.pick';
  session: number;
  x: number;
  y: number;
}
export interface RenderPickValue {
  hit: { material: number; name: string; point: Vec3; normal: Vec3; distance: number } | null;
}

/** `render.compare`: errors of one render against another. Array: `error` (height, width), relative error of pixels. */
export interface RenderCompare {
  ask: 'render.compare';
  session: number;
  reference: number;
}
export interface RenderCompareValue {
  rmse: number;
  relMse: number;
  /** RMSE of means of 8 x 8 pixels, times 8. */
  blockRmse: number;
  flip: number;
}
export interface RenderCompareArrays {
  error: FloatArray;
}

/**
 * `render.gpu`: what a page needs to take the same samples with WebGPU. Arrays of bytes: `tables`, `nodes`, `packets`,
 * `words`, bound as 0 to 3 of group 0, read-only storage; 4: requests, read-only; 5: results. Entry: `path_main`, 64
 * threads a group. The path kernel's layout: `specula-gpu/wgsl/path.wgsl`.
 */
export interface RenderGpu {
  ask: 'render.gpu';
  session: number;
}
export interface RenderGpuValue {
  wgsl: string;
  settings: [number, number, number, number];
  width: number;
  height: number;
}
export interface RenderGpuArrays {
  tables: ByteArray;
  nodes: ByteArray;
  packets: ByteArray;
  words: ByteArray;
}

/** `render.save`: array `file`. */
export interface RenderSave {
  ask: 'render.save';
  session: number;
  format: 'exr' | 'png';
}
export interface RenderSaveValue {
  name: string;
}
export interface RenderSaveArrays {
  file: ByteArray;
}

/** `render.scene`: the scene with its changes as pbrt-v4, or the changes as a command line. */
export interface RenderScene {
  ask: 'render.scene';
  session: number;
  format: 'pbrt' | 'command';
}
export interface RenderSceneValue {
  text: string;
}

/** `render.close` */
export interface RenderClose {
  ask: 'render.close';
  session: number;
}

// ------------------------------------------------------------------------------------------------- shaders

/** `shaders.library`: the library's WGSL, whole or what some functions need, as `specula export` writes it. */
export interface ShadersLibrary {
  ask: 'shaders.library';
  functions?: string[];
}
export interface ShadersLibraryValue {
  wgsl: string;
}
/** Array: the tables that lobes with compensation read, for the binding that the text declares. */
export interface ShadersLibraryArrays {
  tables: ByteArray;
}

// ---------------------------------------------------------------------------------------------- all of them

/** Requests by name: what is asked, the value and the arrays of the answer. */
export interface Protocol {
  'lobes.kinds': [LobesKinds, LobesKindsValue, {}];
  'lobes.parse': [LobesParse, LobesParseValue, {}];
  'lobes.slice': [LobesSlice, {}, LobesSliceArrays];
  'lobes.grid': [LobesGrid, {}, LobesGridArrays];
  'lobes.albedo': [LobesAlbedo, {}, LobesAlbedoArrays];
  'lobes.samples': [LobesSamples, LobesSamplesValue, LobesSamplesArrays];
  'lobes.prove': [LobesProve, LobesProveValue, LobesProveArrays];
  'lobes.walks': [LobesWalks, LobesWalksValue, LobesWalksArrays];
  'lobes.code': [LobesCode, LobesCodeValue, {}];
  'samplers.describe': [SamplersDescribe, SamplersDescribeValue, {}];
  'samplers.regions': [SamplersRegions, {}, SamplersRegionsArrays];
  'samplers.samples': [SamplersSamples, SamplersSamplesValue, SamplersSamplesArrays];
  'samplers.histogram': [SamplersHistogram, SamplersHistogramValue, SamplersHistogramArrays];
  'samplers.compare': [SamplersCompare, SamplersCompareValue, {}];
  'render.scenes': [RenderScenes, RenderScenesValue, {}];
  'render.open': [RenderOpen, RenderOpenValue, {}];
  'render.advance': [RenderAdvance, RenderAdvanceValue, RenderAdvanceArrays];
  'render.change': [RenderChange, RenderOpenValue, {}];
  'render.pick': [RenderPick, RenderPickValue, {}];
  'render.compare': [RenderCompare, RenderCompareValue, RenderCompareArrays];
  'render.gpu': [RenderGpu, RenderGpuValue, RenderGpuArrays];
  'render.save': [RenderSave, RenderSaveValue, RenderSaveArrays];
  'render.scene': [RenderScene, RenderSceneValue, {}];
  'render.close': [RenderClose, {}, {}];
  'shaders.library': [ShadersLibrary, ShadersLibraryValue, ShadersLibraryArrays];
}
