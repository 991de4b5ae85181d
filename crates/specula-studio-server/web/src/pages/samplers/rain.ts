/** Samples that fall on the sphere one after the other. */

import { BufferAttribute, BufferGeometry, Points, ShaderMaterial } from 'three';
import { themeColour } from '../../ui/space';

/** Seconds in which all samples fall. */
export const RAIN_SECONDS = 4;
/** Seconds of a fall. */
const FALL_SECONDS = 0.45;

/** Seconds of the rain, which can be stopped: all pictures of a page share them. */
export class Clock {
  private before: number;
  private since: number | undefined;

  /** `isOver`: all samples have fallen. */
  constructor(isOver: boolean) {
    this.before = isOver ? Infinity : 0;
    this.since = isOver ? undefined : performance.now();
  }

  get seconds(): number {
    return this.before + (this.since === undefined ? 0 : (performance.now() - this.since) / 1000);
  }

  get isOver(): boolean {
    return this.seconds > RAIN_SECONDS + FALL_SECONDS;
  }

  /** Whether time passes. */
  get runs(): boolean {
    return this.since !== undefined && !this.isOver;
  }

  /** Whether it was stopped before all samples had fallen. */
  get isStopped(): boolean {
    return this.since === undefined && !this.isOver;
  }

  stop(): void {
    this.before = this.seconds;
    this.since = undefined;
  }

  goOn(): void {
    this.since ??= performance.now();
  }

  /** How many of so many samples have begun to fall. */
  fallen(count: number): number {
    return Math.min(count, Math.floor((this.seconds / RAIN_SECONDS) * count));
  }
}

/** Whether the user asks for less motion. */
export const wantsStillness = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

const VERTEX = `
attribute float birth;
uniform float seconds;
uniform float size;
void main() {
  float age = seconds - birth;
  float height = 0.7 * pow(clamp(1.0 - age / ${FALL_SECONDS.toFixed(2)}, 0.0, 1.0), 2.0);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position * (1.0 + height), 1.0);
  gl_PointSize = size;
  // Not born yet: outside of the picture.
  if (age < 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;
const FRAGMENT = `
uniform vec3 colour;
void main() {
  if (length(gl_PointCoord - 0.5) > 0.5) discard;
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
}`;

/** Points of unit vectors that are kept, in the order in which they fall. */
export function rain(values: Float32Array, isKept: (i: number) => boolean, colour: string, size: number, clock: Clock): Points {
  const count = values.length / 3;
  const [places, births]: [number[], number[]] = [[], []];
  for (let i = 0; i < count; i++) {
    if (!isKept(i)) continue;
    places.push(values[3 * i] as number, values[3 * i + 1] as number, values[3 * i + 2] as number);
    births.push((RAIN_SECONDS * i) / count);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(places), 3));
  geometry.setAttribute('birth', new BufferAttribute(Float32Array.from(births), 1));
  const uniforms = { seconds: { value: 0 }, size: { value: size * Math.min(devicePixelRatio, 2) }, colour: { value: themeColour(colour) } };
  const points = new Points(geometry, new ShaderMaterial({ uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT }));
  points.onBeforeRender = () => {
    uniforms.seconds.value = Math.min(clock.seconds, 1e6);
  };
  // Bounds of what falls are not those of where it lands.
  points.frustumCulled = false;
  return points;
}
