/** A lobe in three dimensions: radius by value, over the surface's plane. */

import { useMemo } from 'preact/hooks';
import {
  ArrowHelper,
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  DoubleSide,
  HemisphereLight,
  Line,
  LineBasicMaterial,
  LineLoop,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  CircleGeometry,
  type Color,
  type Object3D,
  Vector3,
} from 'three';
import type { Answer } from '../../core/ask';
import type { Vec3 } from '../../core/protocol';
import { useThemeChange } from '../../core/theme';
import { Space, themeColour } from '../../ui/space';
import { valueOf } from './curves';
import type { Quantity } from './state';

export interface SurfaceProps {
  label: string;
  grid: Answer<'lobes.grid'>;
  quantity: Quantity;
  isLogarithmic: boolean;
  wo: Vec3;
}

/** Powers of ten between the centre and the greatest value. */
const DECADES = 4;

export function Surface({ label, grid, quantity, isLogarithmic, wo }: SurfaceProps) {
  const theme = useThemeChange();
  const contents = useMemo(
    () => [...frame(wo), new Mesh(geometry(grid, quantity, isLogarithmic), new MeshLambertMaterial({ vertexColors: true, side: DoubleSide }))],
    [grid, quantity, isLogarithmic, wo.join(), theme],
  );
  return <Space label={label} contents={contents} eye={[1.1, -3.3, 1.5]} target={[0, 0, 0.2]} />;
}

/** The surface, the view, its mirror's direction, and lamps. */
function frame(wo: Vec3): Object3D[] {
  const [line, ink, quiet] = ['--line', '--ink', '--quiet'].map(themeColour) as [Color, Color, Color];
  const plane = new Mesh(new CircleGeometry(1, 96), new MeshBasicMaterial({ color: line, transparent: true, opacity: 0.28, side: DoubleSide, depthWrite: false }));
  const rim = new LineLoop(circle(), new LineBasicMaterial({ color: quiet }));
  const view = new ArrowHelper(new Vector3(...wo), new Vector3(), 1.15, ink, 0.09, 0.05);
  const mirror = new Line(new BufferGeometry().setFromPoints([new Vector3(), new Vector3(-wo[0], -wo[1], wo[2])]), new LineBasicMaterial({ color: quiet }));
  const normal = new Line(new BufferGeometry().setFromPoints([new Vector3(), new Vector3(0, 0, 1)]), new LineBasicMaterial({ color: line }));
  const sky = new HemisphereLight(0xffffff, 0x999999, 1.9);
  sky.position.set(0, 0, 1);
  const sun = new DirectionalLight(0xffffff, 1.6);
  sun.position.set(1.5, -2.5, 3);
  return [plane, rim, view, mirror, normal, sky, sun];
}

function circle(): BufferGeometry {
  return new BufferGeometry().setFromPoints(
    Array.from({ length: 96 }, (_, i) => new Vector3(Math.cos((i * Math.PI) / 48), Math.sin((i * Math.PI) / 48), 0)),
  );
}

function geometry(grid: Answer<'lobes.grid'>, quantity: Quantity, isLogarithmic: boolean): BufferGeometry {
  const { theta, phi, f_cos, pdf } = grid.arrays;
  const [rows, columns] = [theta.values.length, phi.values.length];
  const count = rows * columns;
  const values = Float64Array.from({ length: count }, (_, i) => valueOf(quantity, 3, f_cos.values, pdf.values, i));
  const top = values.reduce((most, v) => (Number.isFinite(v) ? Math.max(most, v) : most), 0) || 1;
  const radius = (v: number) => (!(v > 0) ? 0 : isLogarithmic ? Math.max(0, 1 + Math.log10(v / top) / DECADES) : v / top);
  const [positions, colours] = [new Float32Array(3 * count), new Float32Array(3 * count)];
  const own = themeColour('--series-1').toArray();
  for (let i = 0; i < count; i++) {
    const [t, p] = [theta.values[Math.floor(i / columns)] as number, phi.values[i % columns] as number];
    const r = radius(values[i] as number);
    const flat = r * Math.sin(t);
    positions[3 * i] = flat * Math.cos(p);
    positions[3 * i + 1] = flat * Math.sin(p);
    positions[3 * i + 2] = r * Math.cos(t);
    const most = Math.max(f_cos.values[3 * i] as number, f_cos.values[3 * i + 1] as number, f_cos.values[3 * i + 2] as number);
    for (let k = 0; k < 3; k++) {
      const isOwn = quantity === 'pdf' || !(most > 0);
      colours[3 * i + k] = isOwn ? (own[k] as number) : 0.8 * Math.max(0, (f_cos.values[3 * i + k] as number) / most) + 0.04;
    }
  }
  const indices = new Uint32Array(6 * (rows - 1) * (columns - 1));
  let at = 0;
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const a = row * columns + column;
      for (const corner of [a, a + columns, a + 1, a + 1, a + columns, a + columns + 1]) indices[at++] = corner;
    }
  }
  const shape = new BufferGeometry();
  shape.setAttribute('position', new BufferAttribute(positions, 3));
  shape.setAttribute('color', new BufferAttribute(colours, 3));
  shape.setIndex(new BufferAttribute(indices, 1));
  shape.computeVertexNormals();
  closeSeam(shape, rows, columns);
  return shape;
}

/** Azimuths 0 and 2 pi are the same points: their normals are made so. */
function closeSeam(shape: BufferGeometry, rows: number, columns: number): void {
  const normals = shape.getAttribute('normal');
  const sum = new Vector3();
  for (let row = 0; row < rows; row++) {
    const [first, last] = [row * columns, row * columns + columns - 1];
    sum.set(normals.getX(first) + normals.getX(last), normals.getY(first) + normals.getY(last), normals.getZ(first) + normals.getZ(last)).normalize();
    normals.setXYZ(first, sum.x, sum.y, sum.z);
    normals.setXYZ(last, sum.x, sum.y, sum.z);
  }
}
