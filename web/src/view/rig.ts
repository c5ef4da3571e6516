// SPDX-License-Identifier: BSD-3-Clause
import { OrthographicCamera, PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Frame } from '../geometry/frame';

const FOV_DEG = 28;
const TAN = Math.tan((FOV_DEG * Math.PI) / 360);
/** Part of the window's height that the object takes at first. */
const TALL = 0.84;
/** Room for names at both sides of it, in pixels, and the least part of the width that is left to the object. */
const SIDE = 118, LEAST_WIDE = 0.62;

/** The camera and what moves it: mouse, touch, keys. */
export class Rig {
  private perspective = new PerspectiveCamera(FOV_DEG, 1);
  private orthographic = new OrthographicCamera();
  private controls: OrbitControls;
  private width = 1;
  private height = 1;
  private moving = 0;

  constructor(private frame: Frame, element: HTMLElement, private changed: () => void) {
    this.perspective.up.copy(frame.up);
    this.orthographic.up.copy(frame.up);
    this.controls = new OrbitControls(this.perspective, element);
    this.controls.rotateSpeed = 0.8;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.changed());
    this.place(this.first());
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.controls.object as PerspectiveCamera | OrthographicCamera;
  }

  get isOrthographic(): boolean {
    return this.camera === this.orthographic;
  }

  resize(width: number, height: number): void {
    const before = this.fit();
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.perspective.aspect = this.width / this.height;
    // A window that changes its shape keeps the object as large as it was beside the window.
    const offset = this.perspective.position.clone().sub(this.controls.target).multiplyScalar(this.fit() / before);
    if (!this.isOrthographic) this.perspective.position.copy(this.controls.target).add(offset);
    this.update();
  }

  /** Sets near and far about the object, the frustum and the camera's matrices; to be called before it is used. */
  update(): void {
    const { radius, centre } = this.frame;
    const distance = this.camera.position.distanceTo(centre);
    this.perspective.near = Math.max(0.02 * radius, distance - 1.5 * radius);
    this.perspective.far = distance + 1.5 * radius;
    const half = (this.fit() * TAN), aspect = this.width / this.height;
    Object.assign(this.orthographic, {
      left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: distance - 1.5 * radius, far: distance + 1.5 * radius,
    });
    this.perspective.updateProjectionMatrix();
    this.orthographic.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  reset(animated: boolean): void {
    if (this.isOrthographic) {
      this.orthographic.zoom = 1;
      this.place(this.first());
    } else if (animated) {
      this.glide(this.first());
    } else {
      this.place(this.first());
    }
  }

  /** From the object to the viewer, unit. */
  get side(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** Looks at the object's middle from a side, from as far as at present. */
  lookFrom(side: Vector3, animated: boolean): void {
    // Straight from above or below, what is up would hang on roundings.
    const limit = 0.03, tilt = side.angleTo(this.frame.up);
    const held = side.clone();
    if (tilt < limit || tilt > Math.PI - limit)
      held.addScaledVector(this.frame.towards.clone().addScaledVector(this.frame.up, -this.frame.towards.dot(this.frame.up)).normalize(), limit);
    const distance = this.camera.position.distanceTo(this.controls.target);
    const position = this.frame.centre.clone().addScaledVector(held.normalize(), distance);
    if (animated) this.glide(position);
    else this.place(position);
  }

  setOrthographic(on: boolean): void {
    if (on === this.isOrthographic) return;
    const distance = this.camera.position.distanceTo(this.controls.target);
    const towards = this.camera.position.clone().sub(this.controls.target).normalize();
    if (on) {
      this.orthographic.zoom = this.fit() / distance;
      this.orthographic.position.copy(this.controls.target).addScaledVector(towards, this.fit());
      this.controls.object = this.orthographic;
    } else {
      this.perspective.position.copy(this.controls.target).addScaledVector(towards, this.fit() / this.orthographic.zoom);
      this.controls.object = this.perspective;
    }
    this.controls.update();
    this.changed();
  }

  /** Turns about the object, by degrees to the right and up. */
  turn(right_deg: number, up_deg: number): void {
    const { camera, controls, frame } = this;
    const offset = camera.position.clone().sub(controls.target);
    const elevation = offset.angleTo(frame.up);
    const limit = 0.02, step = (-up_deg * Math.PI) / 180;
    const tilt = Math.min(Math.PI - limit, Math.max(limit, elevation + step)) - elevation;
    const side = frame.up.clone().cross(offset).normalize();
    offset.applyAxisAngle(side, tilt).applyAxisAngle(frame.up, (right_deg * Math.PI) / 180);
    this.place(offset.add(controls.target), controls.target);
  }

  zoom(factor: number): void {
    const { camera, controls } = this;
    if (camera instanceof OrthographicCamera) camera.zoom *= factor;
    else camera.position.sub(controls.target).divideScalar(factor).add(controls.target);
    this.place(camera.position.clone(), controls.target);
  }

  /** In parts of the window's height. */
  pan(right: number, up: number): void {
    const { camera, controls } = this;
    const height = this.pixel * this.height;
    const move = new Vector3(right, up, 0).multiplyScalar(height).applyQuaternion(camera.quaternion);
    controls.target.add(move);
    this.place(camera.position.clone().add(move), controls.target);
  }

  /** Length of a pixel at the depth of the object's middle. */
  get pixel(): number {
    const { camera, frame } = this;
    if (this.isOrthographic) return (2 * this.fit() * TAN) / (this.orthographic.zoom * this.height);
    const ahead = new Vector3(0, 0, -1).applyQuaternion(camera.quaternion);
    return (2 * TAN * Math.max(1e-6 * frame.radius, frame.centre.clone().sub(camera.position).dot(ahead))) / this.height;
  }

  /** Looks at the object as another rig looks at its own. */
  follow(other: Rig): void {
    this.setOrthographic(other.isOrthographic);
    const scale = this.frame.radius / other.frame.radius;
    const target = other.controls.target.clone().sub(other.frame.centre).multiplyScalar(scale).add(this.frame.centre);
    const offset = other.camera.position.clone().sub(other.controls.target).multiplyScalar(scale);
    this.orthographic.zoom = other.orthographic.zoom;
    this.place(offset.add(target), target);
  }

  private first(): Vector3 {
    return this.frame.centre.clone().addScaledVector(this.frame.towards, this.fit());
  }

  /** The distance at which the object, seen as at first, fills the window. */
  private fit(): number {
    const { outermost, centre, towards, up } = this.frame;
    const right = up.clone().cross(towards).normalize(), upright = towards.clone().cross(right);
    const wide = Math.max(LEAST_WIDE, 1 - (2 * SIDE) / this.width);
    const tanX = TAN * wide * (this.width / this.height), tanY = TAN * TALL, offset = new Vector3();
    let distance = 0;
    for (const point of outermost) {
      offset.copy(point).sub(centre);
      distance = Math.max(distance, offset.dot(towards) + Math.max(Math.abs(offset.dot(right)) / tanX, Math.abs(offset.dot(upright)) / tanY));
    }
    return distance || 1;
  }

  private place(position: Vector3, target = this.frame.centre): void {
    cancelAnimationFrame(this.moving);
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
    this.update();
    this.changed();
  }

  private glide(to: Vector3): void {
    const start = performance.now(), from = this.camera.position.clone(), target = this.controls.target.clone();
    const step = (now: number): void => {
      const t = Math.min(1, (now - start) / 260), s = t * t * (3 - 2 * t);
      const middle = target.clone().lerp(this.frame.centre, s);
      // Around the object, not through it.
      const a = from.clone().sub(target), b = to.clone().sub(this.frame.centre);
      const length = a.length() * (1 - s) + b.length() * s;
      this.place(a.lerp(b, s).setLength(length).add(middle), middle);
      if (t < 1) this.moving = requestAnimationFrame(step);
    };
    this.moving = requestAnimationFrame(step);
  }
}
