/** A picture in three dimensions that turns by dragging: z is up, drawn when something changes. */

import { useEffect, useRef } from 'preact/hooks';
import { Color, type Object3D, PerspectiveCamera, Scene, Vector2, Vector3, Raycaster, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Vec3 } from '../core/protocol';

export interface SpaceProps {
  /** What it shows, for screen readers. */
  label: string;
  /** Drawn; owned by the caller, who makes new ones when they change (geometries and materials are disposed here). */
  contents: Object3D[];
  eye?: Vec3;
  target?: Vec3;
  /** Called while something named in `draggable` is dragged, with the point of the unit sphere below the pointer. */
  onDrag?: (name: string, point: Vec3) => void;
  draggable?: string[];
}

interface Parts {
  renderer: WebGLRenderer;
  scene: Scene;
  camera: PerspectiveCamera;
  controls: OrbitControls;
  draw: () => void;
}

/** A colour of the page's theme, such as `--series-1`. */
export function themeColour(name: string): Color {
  return new Color(getComputedStyle(document.documentElement).getPropertyValue(name).trim());
}

export function Space(props: SpaceProps) {
  const host = useRef<HTMLDivElement>(null);
  const parts = useRef<Parts | undefined>(undefined);
  const latest = useRef(props);
  latest.current = props;
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    let renderer: WebGLRenderer;
    try {
      renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      element.textContent = 'This browser has no WebGL: the picture cannot be drawn.';
      return;
    }
    renderer.debug.checkShaderErrors = false;
    renderer.domElement.setAttribute('role', 'img');
    renderer.domElement.setAttribute('aria-label', latest.current.label);
    element.append(renderer.domElement);
    const scene = new Scene();
    const camera = new PerspectiveCamera(32, 1, 0.01, 100);
    camera.up.set(0, 0, 1);
    camera.position.set(...(props.eye ?? [2.4, -3.2, 2]));
    const controls = new OrbitControls(camera, renderer.domElement);
    controls.target.set(...(props.target ?? [0, 0, 0.25]));
    controls.enablePan = false;
    let isAsked = false;
    const draw = () => {
      if (isAsked) return;
      isAsked = true;
      requestAnimationFrame(() => {
        isAsked = false;
        renderer.render(scene, camera);
      });
    };
    controls.addEventListener('change', draw);
    controls.update();
    const resize = new ResizeObserver(() => {
      const { width, height } = element.getBoundingClientRect();
      if (width < 1 || height < 1) return;
      renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
      draw();
    });
    resize.observe(element);
    parts.current = { renderer, scene, camera, controls, draw };
    const stopDragging = listenToDragging(parts.current, () => latest.current);
    return () => {
      stopDragging();
      resize.disconnect();
      controls.dispose();
      renderer.dispose();
      renderer.domElement.remove();
      parts.current = undefined;
    };
  }, []);
  useEffect(() => {
    const now = parts.current;
    if (now === undefined) return;
    now.scene.clear();
    now.scene.add(...props.contents);
    now.draw();
    return () => {
      // After the next ones are drawn, which then find their programs compiled.
      const old = props.contents;
      requestAnimationFrame(() => requestAnimationFrame(() => old.forEach((object) => object.traverse(dispose))));
    };
  }, [props.contents]);
  return <div class="space" ref={host} />;
}

function dispose(object: Object3D): void {
  const { geometry, material } = object as { geometry?: { dispose(): void }; material?: { dispose(): void } };
  geometry?.dispose();
  material?.dispose();
}

/** Lets objects whose names are in `draggable` be dragged over the unit sphere. */
function listenToDragging({ renderer, scene, camera, controls }: Parts, props: () => SpaceProps): () => void {
  const canvas = renderer.domElement;
  let dragged: string | undefined;
  const caster = new Raycaster();
  caster.params.Points.threshold = 0.06;
  const aim = (event: PointerEvent) => {
    const box = canvas.getBoundingClientRect();
    caster.setFromCamera(new Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2), camera);
  };
  const down = (event: PointerEvent) => {
    aim(event);
    const names = props().draggable ?? [];
    const hit = caster.intersectObjects(scene.children, true).find((h) => names.includes(h.object.name));
    if (hit === undefined) return;
    dragged = hit.object.name;
    controls.enabled = false;
    canvas.setPointerCapture(event.pointerId);
  };
  const move = (event: PointerEvent) => {
    if (dragged === undefined) return;
    aim(event);
    const { origin, direction } = caster.ray;
    // The nearest point of the sphere: where the ray enters it, or passes closest.
    const along = -origin.dot(direction);
    const nearest = origin.clone().addScaledVector(direction, along);
    const left = 1 - nearest.lengthSq();
    const point = left > 0 ? origin.clone().addScaledVector(direction, along - Math.sqrt(left)) : nearest.normalize();
    props().onDrag?.(dragged, new Vector3().copy(point).normalize().toArray() as Vec3);
  };
  const up = () => {
    dragged = undefined;
    controls.enabled = true;
  };
  canvas.addEventListener('pointerdown', down, { capture: true });
  canvas.addEventListener('pointermove', move);
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  return () => canvas.removeEventListener('pointerdown', down, { capture: true });
}
