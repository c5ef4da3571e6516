// SPDX-License-Identifier: BSD-3-Clause
// From which side an object is first looked at.
import { Vector3 } from 'three';
import type { Point } from '@schemas/scene';
import type { Axis } from '../data/directions';
import { DepthImage, spread } from './depth_image';

export interface Frame {
  centre: Vector3;
  /** Of the least sphere about `centre` that holds the object. */
  radius: number;
  up: Vector3;
  /** From the object to the viewer, unit. */
  towards: Vector3;
  /** The object's outermost points on many sides: no other reaches notably farther on any. */
  outermost: Vector3[];
}

const ELEVATION_DEG = 24, TURN_DEG = 22, FRONT_TURN_DEG = 38;

function covariance(positions: Float32Array, centre: Vector3): number[][] {
  const m = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  for (let i = 0; i < positions.length; i += 3) {
    const d = [positions[i]! - centre.x, positions[i + 1]! - centre.y, positions[i + 2]! - centre.z];
    for (let r = 0; r < 3; ++r) for (let c = 0; c < 3; ++c) m[r]![c]! += d[r]! * d[c]!;
  }
  return m;
}

/** The direction across `up` along which the object is longest; to the side where it reaches farther out. */
function longest(positions: Float32Array, centre: Vector3, up: Vector3): Vector3 {
  const m = covariance(positions, centre);
  const a = new Vector3(Math.abs(up.x) < 0.6 ? 1 : 0, Math.abs(up.x) < 0.6 ? 0 : 1, 0).cross(up).normalize();
  const b = up.clone().cross(a);
  const times = (u: Vector3, v: Vector3): number => {
    const x = u.toArray(), y = v.toArray();
    let sum = 0;
    for (let r = 0; r < 3; ++r) for (let c = 0; c < 3; ++c) sum += x[r]! * m[r]![c]! * y[c]!;
    return sum;
  };
  const angle = 0.5 * Math.atan2(2 * times(a, b), times(a, a) - times(b, b));
  const axis = a.multiplyScalar(Math.cos(angle)).addScaledVector(b, Math.sin(angle));
  const along = (i: number): number =>
    (positions[i]! - centre.x) * axis.x + (positions[i + 1]! - centre.y) * axis.y + (positions[i + 2]! - centre.z) * axis.z;
  let mean = 0, skew = 0;
  for (let i = 0; i < positions.length; i += 3) mean += (3 * along(i)) / positions.length;
  for (let i = 0; i < positions.length; i += 3) skew += (along(i) - mean) ** 3;
  return skew < 0 ? axis.negate() : axis;
}

/** The least of the coordinate axes' extents stands up where nothing else tells, as things lie on a table. */
function flattest(size: Vector3): Vector3 {
  const margin = 0.8;
  if (size.z <= Math.min(size.x, size.y) / margin) return new Vector3(0, 0, 1);
  return size.y <= size.x ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0);
}

const SIDES = 160;

function outermost(positions: Float32Array): Vector3[] {
  const found = new Set<number>();
  for (const [x, y, z] of spread(SIDES)) {
    let best = -Infinity, at = 0;
    for (let i = 0; i < positions.length; i += 3) {
      const reach = positions[i]! * x + positions[i + 1]! * y + positions[i + 2]! * z;
      if (reach > best) {
        best = reach;
        at = i;
      }
    }
    found.add(at);
  }
  return [...found].map((i) => new Vector3(positions[i]!, positions[i + 1]!, positions[i + 2]!));
}

/** From the front, or across the longest direction: to either side of it and from either end. */
function sides(positions: Float32Array, centre: Vector3, up: Vector3, front: Vector3 | null): Vector3[] {
  const e = (ELEVATION_DEG * Math.PI) / 180;
  const turned = (start: Vector3, degrees: number): Vector3 =>
    start.clone().applyAxisAngle(up, (degrees * Math.PI) / 180).multiplyScalar(Math.cos(e)).addScaledVector(up, Math.sin(e)).normalize();
  const flat = front?.addScaledVector(up, -front.dot(up));
  if (flat && flat.lengthSq() > 1e-6) return [FRONT_TURN_DEG, -FRONT_TURN_DEG].map((turn) => turned(flat.normalize(), turn));
  const across = longest(positions, centre, up).cross(up).normalize();
  return [TURN_DEG, -TURN_DEG, 180 - TURN_DEG, 180 + TURN_DEG].map((turn) => turned(across, turn));
}

/** Of several sides, that from which most of the points are seen; an earlier one where it is about as good. */
function bestSide(candidates: Vector3[], points: Float32Array, surface: { positions: Float32Array; triangles: Uint32Array }, centre: Vector3, radius: number): Vector3 {
  const image = new DepthImage(surface.positions, surface.triangles, centre.toArray(), radius);
  const margin = 0.08;
  let best = candidates[0]!, most = -1;
  for (const side of candidates) {
    image.draw(side.toArray());
    let seen = 0;
    for (let i = 0; i + 2 < points.length; i += 3) seen += image.seesPoint(points, i) ? 3 / points.length : 0;
    if (seen > most + margin) {
      best = side;
      most = seen;
    }
  }
  return best;
}

/** \param points  that are to be seen: of the shapes that were found */
export function firstView(surface: { positions: Float32Array; triangles: Uint32Array }, known: Partial<Record<Axis, Point>>, points: Float32Array): Frame {
  const { positions } = surface;
  const low = new Vector3(Infinity, Infinity, Infinity), high = low.clone().negate(), point = new Vector3();
  for (let i = 0; i < positions.length; i += 3) {
    point.set(positions[i]!, positions[i + 1]!, positions[i + 2]!);
    low.min(point);
    high.max(point);
  }
  const centre = low.clone().add(high).multiplyScalar(0.5);
  let radius = 0;
  for (let i = 0; i < positions.length; i += 3)
    radius = Math.max(radius, point.set(positions[i]!, positions[i + 1]!, positions[i + 2]!).distanceTo(centre));
  radius ||= 1;
  const up = known.up ? new Vector3(...known.up) : flattest(high.clone().sub(low));
  const candidates = sides(positions, centre, up, known.front ? new Vector3(...known.front) : null);
  return { centre, radius, up, towards: bestSide(candidates, points, surface, centre, radius), outermost: outermost(positions) };
}
