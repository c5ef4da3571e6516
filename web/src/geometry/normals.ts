// SPDX-License-Identifier: BSD-3-Clause
/** The mesh drawn corner by corner: three floats for each corner of each triangle. */
export interface Corners {
  positions: Float32Array;
  normals: Float32Array;
}

/** Faces around each vertex, in compressed rows. */
export function facesAround(triangles: Uint32Array, vertexCount: number): { starts: Uint32Array; faces: Uint32Array } {
  const starts = new Uint32Array(vertexCount + 1);
  for (const v of triangles) ++starts[v + 1]!;
  for (let v = 0; v < vertexCount; ++v) starts[v + 1]! += starts[v]!;
  const next = starts.slice(0, vertexCount);
  const faces = new Uint32Array(triangles.length);
  for (let c = 0; c < triangles.length; ++c) {
    const v = triangles[c]!;
    faces[next[v]!++] = (c / 3) | 0;
  }
  return { starts, faces };
}

/** Twice the area times the unit normal of each face. */
function areaNormals(positions: Float32Array, triangles: Uint32Array): Float32Array {
  const normals = new Float32Array(triangles.length);
  for (let f = 0; f < triangles.length; f += 3) {
    const a = 3 * triangles[f]!, b = 3 * triangles[f + 1]!, c = 3 * triangles[f + 2]!;
    const ux = positions[b]! - positions[a]!, uy = positions[b + 1]! - positions[a + 1]!, uz = positions[b + 2]! - positions[a + 2]!;
    const vx = positions[c]! - positions[a]!, vy = positions[c + 1]! - positions[a + 1]!, vz = positions[c + 2]! - positions[a + 2]!;
    normals[f] = uy * vz - uz * vy;
    normals[f + 1] = uz * vx - ux * vz;
    normals[f + 2] = ux * vy - uy * vx;
  }
  return normals;
}

/**
 * Corners with normals that are smooth over gentle bends and sharp over creases: a corner takes the mean, by area, of those faces
 * around its vertex whose normals lie within `crease_deg` of its own face's.
 */
export function creasedCorners(positions: Float32Array, triangles: Uint32Array, crease_deg: number): Corners {
  const { starts, faces } = facesAround(triangles, positions.length / 3);
  const area = areaNormals(positions, triangles);
  const sizes = new Float32Array(triangles.length / 3);
  for (let f = 0; f < sizes.length; ++f) sizes[f] = Math.hypot(area[3 * f]!, area[3 * f + 1]!, area[3 * f + 2]!);
  const limit = Math.cos((crease_deg * Math.PI) / 180);
  const out: Corners = { positions: new Float32Array(3 * triangles.length), normals: new Float32Array(3 * triangles.length) };
  for (let c = 0; c < triangles.length; ++c) {
    const v = triangles[c]!, own = (c / 3) | 0;
    const nx = area[3 * own]!, ny = area[3 * own + 1]!, nz = area[3 * own + 2]!;
    let x = 0, y = 0, z = 0;
    for (let i = starts[v]!; i < starts[v + 1]!; ++i) {
      const f = faces[i]!;
      const mx = area[3 * f]!, my = area[3 * f + 1]!, mz = area[3 * f + 2]!;
      if (f !== own && nx * mx + ny * my + nz * mz < limit * sizes[own]! * sizes[f]!) continue;
      x += mx;
      y += my;
      z += mz;
    }
    const size = Math.hypot(x, y, z) || 1;
    for (let k = 0; k < 3; ++k) out.positions[3 * c + k] = positions[3 * v + k]!;
    out.normals[3 * c] = x / size;
    out.normals[3 * c + 1] = y / size;
    out.normals[3 * c + 2] = z / size;
  }
  return out;
}
