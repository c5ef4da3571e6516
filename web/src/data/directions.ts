// SPDX-License-Identifier: BSD-3-Clause
// Which way is up: the object's own directions, from the model's spatial associations and the features that were found.
import type { ModelDocument } from '@schemas/model';
import type { Point } from '@schemas/scene';

export type Axis = 'up' | 'front' | 'right';
const AXES: Record<string, [Axis, 1 | -1]> = {
  up: ['up', 1], down: ['up', -1], front: ['front', 1], back: ['front', -1], right: ['right', 1], left: ['right', -1],
};

/** All objects that the object holds, through its parts and its bounds, itself too. */
function held(model: ModelDocument, object: string): Set<string> {
  const seen = new Set<string>();
  const open = [object];
  for (let next = open.pop(); next !== undefined; next = open.pop()) {
    if (seen.has(next)) continue;
    seen.add(next);
    open.push(...(model.parts?.[next] ?? []), ...(model.topology?.[next] ?? []));
  }
  return seen;
}

function mean(points: Point[]): Point | null {
  if (points.length === 0) return null;
  const sum: Point = [0, 0, 0];
  for (const point of points) for (let k = 0; k < 3; ++k) sum[k]! += point[k]! / points.length;
  return sum;
}

const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

interface Sum {
  axis: Axis;
  sum: Point;
  /** Associations of which both objects hold found features. */
  sure: number;
}

/**
 * Unit directions at right angles, as far as the model's associations tell them. An object lies at the mean of the found features
 * that it holds; one that holds none, at `middle`. A fin that is up of the fuselage lies far back too: what an axis has of a surer one, or
 * of one before it in the order right, front, up, is taken away.
 */
export function directions(model: ModelDocument | undefined, places: Map<string, Point>, middle: Point): Partial<Record<Axis, Point>> {
  if (!model) return {};
  const place = (object: string): Point | null => {
    const inside = held(model, object);
    const own = Object.entries(model.features ?? {}).filter(([, feature]) => feature.realises && inside.has(feature.realises));
    return mean(own.flatMap(([name]) => (places.has(name) ? [places.get(name)!] : [])));
  };
  const sums: Sum[] = (['right', 'front', 'up'] as const).map((axis) => ({ axis, sum: [0, 0, 0], sure: 0 }));
  for (const { from, ...relations } of model.associations ?? [])
    for (const [relation, to] of Object.entries(relations)) {
      const axis = AXES[relation];
      if (!axis) continue;
      const a = place(from), b = place(to);
      if (!a && !b) continue;
      const entry = sums.find((each) => each.axis === axis[0])!;
      if (a && b) ++entry.sure;
      // "handle, up: body" reads: the handle lies up of the body.
      for (let k = 0; k < 3; ++k) entry.sum[k]! += axis[1] * ((a ?? middle)[k]! - (b ?? middle)[k]!);
    }
  const found: Partial<Record<Axis, Point>> = {};
  for (const { axis, sum } of sums.sort((a, b) => b.sure - a.sure)) {
    const whole = Math.hypot(...sum);
    for (const other of Object.values(found)) {
      const along = dot(sum, other);
      for (let k = 0; k < 3; ++k) sum[k]! -= along * other[k]!;
    }
    const left = Math.hypot(...sum);
    if (left > 0.02 * whole) found[axis] = sum.map((x) => x / left) as Point;
  }
  return found;
}
