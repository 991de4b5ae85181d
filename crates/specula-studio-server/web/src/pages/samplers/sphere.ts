/** What is drawn on the unit sphere: circles, outlines, points, the view. */

import { ArrowHelper, BufferAttribute, BufferGeometry, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, type Object3D, SphereGeometry, Vector3 } from 'three';
import type { Vec3 } from '../../core/protocol';
import { themeColour } from '../../ui/space';

/** A line through unit vectors. */
export function outline(values: ArrayLike<number>, colour: string, isFaint = false): Object3D {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(values, (v) => v * 1.004), 3));
  return new Line(geometry, new LineBasicMaterial({ color: themeColour(colour), transparent: isFaint, opacity: isFaint ? 0.55 : 1 }));
}

function circle(from: Vec3, to: Vec3): number[] {
  const values: number[] = [];
  for (let i = 0; i <= 128; i++) {
    const [c, s] = [Math.cos((i / 64) * Math.PI), Math.sin((i / 64) * Math.PI)];
    for (let k = 0; k < 3; k++) values.push(c * (from[k] as number) + s * (to[k] as number));
  }
  return values;
}

/** The sphere itself: its horizon and two meridians, with what is behind it faded. */
export function sphere(): Object3D[] {
  const body = new Mesh(new SphereGeometry(0.995, 64, 48), new MeshBasicMaterial({ color: themeColour('--card'), transparent: true, opacity: 0.5 }));
  return [
    body,
    outline(circle([1, 0, 0], [0, 1, 0]), '--ink'),
    outline(circle([1, 0, 0], [0, 0, 1]), '--quiet', true),
    outline(circle([0, 1, 0], [0, 0, 1]), '--quiet', true),
  ];
}

/** The view, with a knob that can be dragged. */
export function view(wo: Vec3): Object3D[] {
  const colour = themeColour('--series-4');
  const arrow = new ArrowHelper(new Vector3(...wo), new Vector3(), 1.18, colour.getHex(), 0.12, 0.07);
  const knob = new Mesh(new SphereGeometry(0.055, 24, 16), new MeshBasicMaterial({ color: colour }));
  knob.position.set(...wo);
  knob.name = 'view';
  return [arrow, knob];
}
