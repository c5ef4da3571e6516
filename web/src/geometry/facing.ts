// SPDX-License-Identifier: BSD-3-Clause
import { DepthImage, spread } from './depth_image';

type Vector = [number, number, number];

const SIDES = 60;
/** What counts beside being seen, in shares of it: that the shape is seen from its flat side, and that the view turns little. */
const FLAT = 0.35, NEAR = 0.2;

/** The normal of a polygon (Newell), unit; null where it has no area to speak of. */
function normal(points: Float32Array): Vector | null {
  const n: Vector = [0, 0, 0];
  let length = 0;
  for (let i = 0; i < points.length; i += 3) {
    const k = (i + 3) % points.length;
    const [ax, ay, az, bx, by, bz] = [points[i]!, points[i + 1]!, points[i + 2]!, points[k]!, points[k + 1]!, points[k + 2]!];
    n[0] += (ay - by) * (az + bz);
    n[1] += (az - bz) * (ax + bx);
    n[2] += (ax - bx) * (ay + by);
    length += Math.hypot(ax - bx, ay - by, az - bz);
  }
  const area = Math.hypot(...n);
  return area > 1e-3 * length * length ? (n.map((x) => x / area) as Vector) : null;
}

/** The side from which a shape's points are best seen before a mesh, starting from the present one. */
export function facing(image: DepthImage, points: Float32Array, present: Vector): Vector {
  const flat = normal(points);
  let best = present, most = -Infinity;
  for (const side of [present, ...spread(SIDES)]) {
    image.draw(side);
    let seen = 0;
    for (let i = 0; i + 2 < points.length; i += 3) seen += image.seesPoint(points, i) ? 3 / points.length : 0;
    const score = seen + NEAR * dot(side, present) + (flat ? FLAT * Math.abs(dot(side, flat)) : 0);
    if (score > most) {
      most = score;
      best = side;
    }
  }
  return best;
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
