// SPDX-License-Identifier: BSD-3-Clause
export interface Hit {
  /** Triangle as shown. */
  triangle: number;
  distance: number;
  point: [number, number, number];
}

type Vector = ArrayLike<number>;

/** The nearest triangle that a ray meets from either side (Möller and Trumbore 1997). */
export function pick(positions: Float32Array, triangles: Uint32Array, origin: Vector, direction: Vector): Hit | null {
  const ox = origin[0]!, oy = origin[1]!, oz = origin[2]!, dx = direction[0]!, dy = direction[1]!, dz = direction[2]!;
  let best = Infinity, found = -1;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t]!, b = 3 * triangles[t + 1]!, c = 3 * triangles[t + 2]!;
    const ax = positions[a]!, ay = positions[a + 1]!, az = positions[a + 2]!;
    const ux = positions[b]! - ax, uy = positions[b + 1]! - ay, uz = positions[b + 2]! - az;
    const vx = positions[c]! - ax, vy = positions[c + 1]! - ay, vz = positions[c + 2]! - az;
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const det = ux * px + uy * py + uz * pz;
    if (det === 0) continue;
    const sx = ox - ax, sy = oy - ay, sz = oz - az;
    const s = (sx * px + sy * py + sz * pz) / det;
    if (s < 0 || s > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const r = (dx * qx + dy * qy + dz * qz) / det;
    if (r < 0 || s + r > 1) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / det;
    if (distance > 0 && distance < best) {
      best = distance;
      found = t / 3;
    }
  }
  if (found < 0) return null;
  return { triangle: found, distance: best, point: [ox + best * dx, oy + best * dy, oz + best * dz] };
}

/** The corner of a triangle that is nearest to a point. */
export function nearestCorner(positions: Float32Array, triangles: Uint32Array, hit: Hit): number {
  let best = Infinity, vertex = 0;
  for (let k = 0; k < 3; ++k) {
    const v = triangles[3 * hit.triangle + k]!;
    const d = Math.hypot(positions[3 * v]! - hit.point[0], positions[3 * v + 1]! - hit.point[1], positions[3 * v + 2]! - hit.point[2]);
    if (d < best) {
      best = d;
      vertex = v;
    }
  }
  return vertex;
}
