// SPDX-License-Identifier: BSD-3-Clause
import { BufferAttribute, BufferGeometry, Color, DoubleSide, GLSL3, Mesh, ShaderMaterial, Sphere, Vector3 } from 'three';
import type { SurfaceData } from '../data/decoded';
import { creasedCorners, facesAround } from '../geometry/normals';
import { Occlusion } from '../geometry/occlusion';

const CREASE_DEG = 42;

const vertexShader = /* glsl */ `
in vec3 tint;
in float sky;
out vec3 vNormal, vPosition, vTint, vCorner;
out float vSky;
void main() {
  vec4 p = modelViewMatrix * vec4(position, 1.0);
  vPosition = p.xyz;
  vNormal = normalMatrix * normal;
  vTint = tint;
  vSky = sky;
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  gl_Position = projectionMatrix * p;
}`;

// A key light over the viewer's left shoulder, a hemisphere of sky and ground, a faint rim; all fixed to the camera, so that an
// object is turned under the light as in the hand.
const fragmentShader = /* glsl */ `
in vec3 vNormal, vPosition, vTint, vCorner;
in float vSky;
out vec4 color;
uniform float edges;
uniform vec3 edgeTint;
vec3 linear(vec3 c) { return pow(c, vec3(2.2)); }
void main() {
  vec3 n = normalize(vNormal);
  vec3 v = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(-vPosition);
  // At an outline slivers of what faces away show through; they are lit as what lies beside them.
  bool inside = !gl_FrontFacing && dot(n, v) < -0.25;
  if (inside) n = -n;
  vec3 base = linear(vTint);
  float open = mix(0.30, 1.0, vSky);
  const vec3 key = normalize(vec3(-0.50, 0.55, 0.67)), fill = normalize(vec3(0.75, 0.05, 0.55));
  float lit = max(dot(n, key) + 0.2, 0.0) / 1.2, filled = 0.5 + 0.5 * dot(n, fill);
  vec3 hemisphere = mix(vec3(0.42, 0.41, 0.41), vec3(0.66, 0.69, 0.74), 0.5 + 0.5 * n.y);
  vec3 light = hemisphere * open + vec3(0.56, 0.54, 0.51) * lit * mix(0.72, 1.0, vSky) + vec3(0.10, 0.11, 0.13) * filled * open;
  vec3 h = normalize(key + v);
  float gloss = 0.10 * pow(max(dot(n, h), 0.0), 42.0) * vSky;
  float rim = 0.10 * pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 3.0);
  vec3 c = base * light + gloss + rim * base;
  if (inside) c *= 0.82;
  if (edges > 0.0) {
    vec3 w = fwidth(vCorner);
    float pixels = 1.0 / max(max(w.x, w.y), w.z);
    vec3 near = smoothstep(vec3(0.0), 1.15 * w, vCorner);
    float line = 1.0 - min(min(near.x, near.y), near.z);
    c = mix(c, linear(edgeTint), edges * line * smoothstep(0.8, 6.0, pixels));
  }
  color = vec4(c, 1.0);
  color = linearToOutputTexel(color);
}`;

/** A triangle mesh whose triangles are coloured one by one. */
export class Surface {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  private occlusion: Occlusion | null;
  private around: { starts: Uint32Array; faces: Uint32Array };

  constructor(readonly data: SurfaceData, centre: Vector3, radius: number) {
    const { positions, triangles } = data;
    const corners = creasedCorners(positions, triangles, CREASE_DEG);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(corners.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(corners.normals, 3));
    geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(3 * triangles.length).fill(200), 3, true));
    geometry.setAttribute('sky', new BufferAttribute(new Uint8Array(triangles.length).fill(255), 1, true));
    geometry.boundingSphere = new Sphere(centre, radius);
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      side: DoubleSide,
      uniforms: { edges: { value: 0 }, edgeTint: { value: new Color(0.1, 0.12, 0.15) } },
      // Lines and patches that lie in the surface are drawn over it.
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.mesh = new Mesh(geometry, material);
    this.around = facesAround(triangles, positions.length / 3);
    this.occlusion = new Occlusion(positions, triangles, this.vertexNormals(corners.normals), centre.toArray(), radius);
  }

  /**
   * Colours by triangle, 3 bytes each (sRGB).
   * \param soft  runs them into each other at the vertices, so that regions have no teeth; else each triangle has its own
   */
  paint(colors: Uint8Array, soft: boolean): void {
    const tint = this.mesh.geometry.getAttribute('tint') as BufferAttribute;
    const out = tint.array as Uint8Array, { triangles } = this.data, { starts, faces } = this.around;
    if (soft) {
      for (let c = 0; c < triangles.length; ++c) {
        const v = triangles[c]!, n = starts[v + 1]! - starts[v]!;
        let r = 0, g = 0, b = 0;
        for (let i = starts[v]!; i < starts[v + 1]!; ++i) {
          const f = 3 * faces[i]!;
          r += colors[f]!;
          g += colors[f + 1]!;
          b += colors[f + 2]!;
        }
        out[3 * c] = r / n;
        out[3 * c + 1] = g / n;
        out[3 * c + 2] = b / n;
      }
    } else {
      for (let t = 0; t < colors.length; t += 3) for (let c = 0; c < 9; ++c) out[3 * t + c] = colors[t + (c % 3)]!;
    }
    tint.needsUpdate = true;
  }

  edges(strength: number, tint: string): void {
    this.mesh.material.uniforms['edges']!.value = strength;
    (this.mesh.material.uniforms['edgeTint']!.value as Color).setStyle(tint, '');
  }

  /** Whether the shading of hollows is done. */
  get shaded(): boolean {
    return this.occlusion === null;
  }

  /** Works on the shading of hollows for about `budget_ms`; false when there is no more to do. */
  shade(budget_ms: number): boolean {
    const { occlusion } = this;
    if (!occlusion) return false;
    const until = performance.now() + budget_ms;
    while (!occlusion.done && performance.now() < until) occlusion.step();
    if (!occlusion.done) return true;
    this.applySky(this.smoothed(occlusion.visibility()));
    this.occlusion = null;
    return false;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  private applySky(visibility: Float32Array): void {
    const sky = this.mesh.geometry.getAttribute('sky') as BufferAttribute;
    const out = sky.array as Uint8Array, { triangles } = this.data;
    for (let c = 0; c < triangles.length; ++c) out[c] = Math.round(255 * visibility[triangles[c]!]!);
    sky.needsUpdate = true;
  }

  /** Two rounds of the mean over each vertex's faces. */
  private smoothed(values: Float32Array): Float32Array {
    const { triangles } = this.data, { starts, faces } = this.around;
    let now = values;
    for (let round = 0; round < 2; ++round) {
      const next = now.slice();
      for (let v = 0; v < next.length; ++v) {
        let sum = now[v]!, n = 1;
        for (let i = starts[v]!; i < starts[v + 1]!; ++i)
          for (let k = 0; k < 3; ++k, ++n) sum += now[triangles[3 * faces[i]! + k]!]!;
        next[v] = sum / n;
      }
      now = next;
    }
    return now;
  }

  private vertexNormals(corners: Float32Array): Float32Array {
    const { positions, triangles } = this.data, normals = new Float32Array(positions.length);
    for (let c = 0; c < triangles.length; ++c)
      for (let k = 0; k < 3; ++k) normals[3 * triangles[c]! + k]! += corners[3 * c + k]!;
    for (let v = 0; v < normals.length; v += 3) {
      const size = Math.hypot(normals[v]!, normals[v + 1]!, normals[v + 2]!) || 1;
      for (let k = 0; k < 3; ++k) normals[v + k]! /= size;
    }
    return normals;
  }
}

