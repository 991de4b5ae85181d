/** Turning, moving and approaching with a camera. */

import type { Camera, Vec3 } from '../../core/protocol';

const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const add = (a: Vec3, b: Vec3, s = 1): Vec3 => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a: Vec3): Vec3 => add([0, 0, 0], a, 1 / Math.max(Math.hypot(...a), 1e-12));

/** A vector turned about a unit axis (Rodrigues). */
function turned(v: Vec3, axis: Vec3, angle: number): Vec3 {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return add(add(add([0, 0, 0], v, c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
}

/** The camera around its target, by angles in radians. */
export function orbit(camera: Camera, right: number, up: number): Camera {
  const axis = unit(camera.up);
  const around = turned(sub(camera.eye, camera.target), axis, -right);
  const side = unit(cross(axis, around));
  const over = turned(around, side, -up);
  // Not over the pole.
  const isPole = Math.abs(dot(unit(over), axis)) > 0.995;
  return { ...camera, eye: add(camera.target, isPole ? around : over) };
}

/** The camera and its target moved in the plane of the picture, by shares of their distance. */
export function pan(camera: Camera, right: number, up: number): Camera {
  const back = sub(camera.eye, camera.target);
  const distance = Math.hypot(...back);
  const side = unit(cross(camera.up, back));
  const over = unit(cross(back, side));
  const move = add(add([0, 0, 0], side, right * distance), over, up * distance);
  return { ...camera, eye: add(camera.eye, move), target: add(camera.target, move) };
}

/** The camera nearer to its target, or farther. */
export function dolly(camera: Camera, factor: number): Camera {
  return { ...camera, eye: add(camera.target, sub(camera.eye, camera.target), factor) };
}
