// SPDX-License-Identifier: BSD-3-Clause
import { Group, Raycaster, Scene, Vector2, Vector3 } from 'three';
import type { SurfaceData } from '../data/decoded';
import { DepthImage } from '../geometry/depth_image';
import { facing } from '../geometry/facing';
import type { Frame } from '../geometry/frame';
import { nearestCorner, pick, type Hit } from '../geometry/pick';
import { h } from '../ui/dom';
import { dispose } from './drawn';
import { LabelLayer, type Extent, type Label } from './labels';
import { Rig } from './rig';
import type { Screen } from './screen';
import { Surface } from './surface';

export interface Picked extends Hit {
  vertex: number;
}

/** Longest move of a press that is still a click, in pixels. */
const CLICK = 5;
/** Work on shading between two frames, in ms. */
const BUDGET = 24;

/** One window on one object: draws when something changed, and then once. */
export class Viewer {
  readonly element: HTMLElement;
  readonly rig: Rig;
  readonly labels: LabelLayer;
  /** Shapes, dots: whatever stands for what was found. */
  readonly drawings = new Group();
  onpick: (picked: Picked | null) => void = () => undefined;
  onhover: (picked: Picked | null, x: number, y: number) => void = () => undefined;
  onlabel: (name: string) => void = () => undefined;
  onmove: () => void = () => undefined;
  ondraw: () => void = () => undefined;
  /** Frames drawn so far. */
  frames = 0;
  private scene = new Scene();
  private surfaces = new Map<SurfaceData, Surface>();
  private shown: Surface | null = null;
  private requested = false;
  private shading = false;
  private hovering = 0;

  constructor(private screen: Screen, private frame: Frame, label: string) {
    this.screen.element.setAttribute('aria-hidden', 'true');
    this.labels = new LabelLayer((name) => this.onlabel(name));
    this.element = h('div', { class: 'viewer', tabindex: 0, role: 'application', 'aria-label': label }, screen.element, this.labels.element);
    this.rig = new Rig(frame, this.element, () => {
      this.invalidate();
      this.onmove();
    });
    this.scene.add(this.drawings);
    this.listen();
    new ResizeObserver(() => {
      this.rig.resize(this.element.clientWidth, this.element.clientHeight);
      this.draw();
    }).observe(this.element);
  }

  /** Whether all is drawn, the shading of hollows too. */
  get idle(): boolean {
    return !this.requested && !this.shading && this.frames > 0;
  }

  get surface(): Surface | null {
    return this.shown;
  }

  show(data: SurfaceData): Surface {
    let surface = this.surfaces.get(data);
    if (!surface) {
      surface = new Surface(data, this.frame.centre, this.frame.radius);
      this.surfaces.set(data, surface);
    }
    if (surface !== this.shown) {
      if (this.shown) this.scene.remove(this.shown.mesh);
      this.scene.add(surface.mesh);
      this.shown = surface;
    }
    this.invalidate();
    return surface;
  }

  clearDrawings(): void {
    dispose(this.drawings);
  }

  setLabels(labels: Label[]): void {
    this.labels.set(labels);
    this.invalidate();
  }

  invalidate(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => this.draw());
  }

  draw(): void {
    this.requested = false;
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.rig.update();
    this.screen.draw(this.scene, this.rig.camera, width, height);
    this.labels.update(this.rig.camera, width, height, this.silhouette(width));
    ++this.frames;
    this.ondraw();
    // Hollows darken when the page has nothing else to do.
    if (!this.shading && this.shown && !this.shown.shaded) {
      this.shading = true;
      setTimeout(() => this.shade());
    }
  }

  /** The picture as it is shown, with its ground and its labels. */
  picture(ground: string): HTMLCanvasElement {
    this.draw();
    const source = this.screen.element;
    const canvas = h('canvas', { width: source.width, height: source.height });
    const context = canvas.getContext('2d')!;
    context.fillStyle = ground;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(source, 0, 0);
    const ratio = source.width / this.element.clientWidth;
    context.scale(ratio, ratio);
    const style = getComputedStyle(this.element);
    context.font = `600 13px ${style.fontFamily}`;
    context.textBaseline = 'middle';
    for (const { label, anchor, at, side } of this.labels.placed) {
      context.strokeStyle = context.fillStyle = style.color;
      context.lineWidth = 1;
      context.beginPath();
      context.moveTo(at[0], at[1]);
      context.lineTo(at[0] - side * 12, at[1]);
      context.lineTo(anchor[0], anchor[1]);
      context.stroke();
      context.textAlign = side < 0 ? 'right' : 'left';
      context.fillText(label.text, at[0] + side * 20, at[1]);
      context.fillStyle = label.color;
      context.beginPath();
      context.arc(at[0] + side * 10, at[1], 5, 0, 2 * Math.PI);
      context.arc(anchor[0], anchor[1], 3.6, 0, 2 * Math.PI);
      context.fill();
    }
    return canvas;
  }

  /** Turns to where a shape is best seen. */
  turnTo(points: Float32Array, animated: boolean): void {
    if (!this.shown || points.length < 6) return;
    const { positions, triangles } = this.shown.data, { centre, radius } = this.frame;
    const image = new DepthImage(positions, triangles, centre.toArray(), radius, 96);
    this.rig.lookFrom(new Vector3(...facing(image, points, this.rig.side.toArray())), animated);
  }

  /** What lies under a point of the window, in pixels from its top left. */
  at(x: number, y: number): Picked | null {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!this.shown) return null;
    this.rig.update();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.rig.camera);
    const { positions, triangles } = this.shown.data;
    const hit = pick(positions, triangles, ray.ray.origin.toArray(), ray.ray.direction.toArray());
    return hit && { ...hit, vertex: nearestCorner(positions, triangles, hit) };
  }

  project(point: [number, number, number]): [number, number] {
    const { clientWidth: width, clientHeight: height } = this.element;
    this.rig.update();
    const p = new Vector3(...point).project(this.rig.camera);
    return [((p.x + 1) / 2) * width, ((1 - p.y) / 2) * height];
  }

  /** How far the object reaches to the left and to the right, in pixels. */
  private silhouette(width: number): Extent {
    const point = new Vector3(), extent = { left: Infinity, right: -Infinity };
    for (const each of this.frame.outermost) {
      const x = ((point.copy(each).project(this.rig.camera).x + 1) / 2) * width;
      extent.left = Math.min(extent.left, x);
      extent.right = Math.max(extent.right, x);
    }
    return extent;
  }

  private shade(): void {
    const surface = this.shown;
    if (surface?.shade(BUDGET)) {
      setTimeout(() => this.shade());
      return;
    }
    this.shading = false;
    this.invalidate();
  }

  private listen(): void {
    let start: { x: number; y: number; id: number } | null = null;
    const place = (event: PointerEvent): [number, number] => {
      const box = this.element.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.element.addEventListener('pointerdown', (event) => {
      start = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY, id: event.pointerId } : null;
    });
    this.element.addEventListener('pointerup', (event) => {
      if (start?.id === event.pointerId && Math.hypot(event.clientX - start.x, event.clientY - start.y) <= CLICK)
        this.onpick(this.at(...place(event)));
      start = null;
    });
    this.element.addEventListener('pointermove', (event) => {
      if (event.buttons !== 0 || event.pointerType === 'touch') return;
      cancelAnimationFrame(this.hovering);
      this.hovering = requestAnimationFrame(() => {
        const [x, y] = place(event);
        this.onhover(this.at(x, y), x, y);
      });
    });
    this.element.addEventListener('pointerleave', () => {
      cancelAnimationFrame(this.hovering);
      this.onhover(null, 0, 0);
    });
  }
}
