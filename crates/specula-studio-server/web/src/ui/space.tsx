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
  /** Drawn as well; made anew more often than `contents`. */
  marks?: Object3D[];
  /** Words at points, beside the picture. */
  labels?: { text: string; at: Vec3 }[];
  /** Whether another frame should follow; asked at each. */
  animate?: () => boolean;
  /** The point of the unit sphere below the pointer; `undefined`: there is none. */
  onHover?: (point: Vec3 | undefined) => void;
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
        placeLabels(element, camera, latest.current.labels ?? []);
        if (parts.current !== undefined && latest.current.animate?.() === true) draw();
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
    now.scene.add(...props.contents, ...(props.marks ?? []));
    now.draw();
    return () => {
      // After the next ones are drawn, which then find their programs compiled.
      const old = props.contents;
      requestAnimationFrame(() => requestAnimationFrame(() => old.forEach((object) => object.traverse(dispose))));
    };
  }, [props.contents]);
  useEffect(() => {
    const now = parts.current;
    if (now === undefined || props.marks === undefined) return;
    const marks = props.marks;
    if (marks.length > 0) now.scene.add(...marks);
    now.draw();
    return () => {
      if (marks.length > 0) now.scene.remove(...marks);
      marks.forEach((object) => object.traverse(dispose));
    };
  }, [props.marks]);
  useEffect(() => parts.current?.draw(), [props.animate]);
  return (
    <div class="space" ref={host}>
      {(props.labels ?? []).map(({ text }) => (
        <span key={text} class="label" aria-hidden="true">
          {text}
        </span>
      ))}
    </div>
  );
}

/** Moves words to their points, behind the sphere fainter. */
function placeLabels(host: HTMLElement, camera: PerspectiveCamera, labels: { at: Vec3 }[]): void {
  const { width, height } = host.getBoundingClientRect();
  host.querySelectorAll<HTMLElement>(':scope > .label').forEach((element, i) => {
    const point = new Vector3(...(labels[i]?.at ?? [0, 0, 0]));
    const isBehind = point.dot(camera.position) < 0;
    point.project(camera);
    element.style.transform = `translate(-50%, -50%) translate(${((point.x + 1) / 2) * width}px, ${((1 - point.y) / 2) * height}px)`;
    element.style.opacity = isBehind ? '.6' : '1';
  });
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
    const { onDrag, onHover } = props();
    const isHovering = onHover !== undefined && event.buttons === 0;
    if (dragged === undefined && !isHovering) return;
    aim(event);
    const { origin, direction } = caster.ray;
    // The nearest point of the sphere: where the ray enters it, or passes closest.
    const along = -origin.dot(direction);
    const nearest = origin.clone().addScaledVector(direction, along);
    const left = 1 - nearest.lengthSq();
    const isHit = left > 0;
    const point = isHit ? origin.clone().addScaledVector(direction, along - Math.sqrt(left)) : nearest;
    const unit = point.normalize().toArray() as Vec3;
    if (dragged !== undefined) onDrag?.(dragged, unit);
    else onHover?.(isHit ? unit : undefined);
  };
  const leave = () => props().onHover?.(undefined);
  canvas.addEventListener('pointerleave', leave);
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
