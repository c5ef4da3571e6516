// SPDX-License-Identifier: BSD-3-Clause
// Fitted shapes: fat lines with a halo, faint where the surface hides them, and translucent patches.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, GreaterDepth, Group, Material, Mesh, MeshBasicMaterial, Points, ShaderMaterial } from 'three';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import type { Drawing, Point } from '@schemas/scene';
import { floats, indices } from '../data/buffers';

export interface Style {
  color: string;
  /** Pixels. */
  width: number;
  /** Colour of the outline around lines; none where absent. */
  halo?: string;
  /** Opacity of a patch's inside. */
  fill?: number;
  /** Colour of what the surface hides; not drawn where absent. Lines are opaque: their segments overlap. */
  hidden?: string;
}

/** Towards the viewer, in parts of the depth range: a fitted circle runs partly a little below the surface. */
const BIAS = 0.012;

function lineMaterial(color: string, width: number): LineMaterial {
  const material = new LineMaterial({ color: new Color().setStyle(color), linewidth: width, transparent: true, depthWrite: false });
  material.onBeforeCompile = (shader): void => {
    shader.vertexShader = shader.vertexShader.replace(
      '#include <logdepthbuf_vertex>',
      `gl_Position.z -= ${BIAS.toFixed(4)} * gl_Position.w;\n#include <logdepthbuf_vertex>`,
    );
  };
  return material;
}

function polyline(points: Float32Array, style: Style): Line2[] {
  const geometry = new LineGeometry();
  geometry.setPositions(points);
  const lines: Line2[] = [];
  const add = (material: LineMaterial, order: number): void => {
    const line = new Line2(geometry, material);
    line.renderOrder = order;
    line.frustumCulled = false;
    lines.push(line);
  };
  if (style.hidden) {
    const material = lineMaterial(style.hidden, Math.max(1.2, style.width * 0.5));
    material.depthFunc = GreaterDepth;
    add(material, 1);
  }
  if (style.halo) add(lineMaterial(style.halo, style.width + 2.6), 3);
  add(lineMaterial(style.color, style.width), 4);
  return lines;
}

function patch(positions: Float32Array, triangles: Uint32Array, style: Style): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  const material = new MeshBasicMaterial({
    color: new Color().setStyle(style.color),
    transparent: true,
    opacity: style.fill ?? 0.3,
    side: DoubleSide,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -2,
    polygonOffsetUnits: -8,
  });
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = 2;
  return mesh;
}

export function drawn(drawing: Drawing, style: Style): Group {
  const group = new Group();
  for (const each of drawing.patches)
    group.add(patch(floats(each.positions, 'patch'), indices(each.triangles, 'patch triangles'), style));
  for (const line of drawing.lines) {
    const points = floats(line, 'line');
    if (points.length >= 6) group.add(...polyline(points, style));
  }
  return group;
}

/** Round dots of a fixed size in pixels, with an outline. */
export function dots(points: Point[], style: { color: string; outline: string; pixels: number; through?: boolean }): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(points.flat()), 3));
  const material = new ShaderMaterial({
    uniforms: {
      size: { value: style.pixels },
      fill: { value: new Color().setStyle(style.color) },
      outline: { value: new Color().setStyle(style.outline) },
    },
    vertexShader: /* glsl */ `
      uniform float size;
      void main() {
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        gl_Position.z -= ${(2 * BIAS).toFixed(4)} * gl_Position.w;
        gl_PointSize = size;
      }`,
    fragmentShader: /* glsl */ `
      uniform vec3 fill, outline;
      uniform float size;
      void main() {
        float r = length(gl_PointCoord - 0.5) * size, edge = 0.5 * size;
        if (r > edge) discard;
        gl_FragColor = vec4(mix(fill, outline, smoothstep(edge - 2.6, edge - 1.6, r)), smoothstep(edge, edge - 1.0, r));
        #include <colorspace_fragment>
      }`,
    transparent: true,
    depthTest: !style.through,
    depthWrite: false,
  });
  const object = new Points(geometry, material);
  object.renderOrder = 6;
  object.frustumCulled = false;
  return object;
}

export function dispose(group: Group): void {
  group.traverse((object) => {
    const { geometry, material } = object as unknown as { geometry?: BufferGeometry; material?: Material };
    geometry?.dispose();
    material?.dispose();
  });
  group.clear();
}
