// SPDX-License-Identifier: BSD-3-Clause
// Which way is up: the object's own directions, from the model's spatial associations and the features that were found.
import type { ModelFile, Point } from './scene';

export type Axis = 'up' | 'front' | 'right';
const AXES: Record<string, [Axis, 1 | -1]> = {
  up: ['up', 1], down: ['up', -1], front: ['front', 1], back: ['front', -1], right: ['right', 1], left: ['right', -1],
};

/** All objects that the object holds, through its parts and its bounds, itself too. */
function held(model: ModelFile, object: string): Set<string> {
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

/**
 * Unit directions, as far as the model's associations tell them. An object lies at the mean of the found features that it
 * holds; one that holds none, at `middle`.
 */
export function directions(model: ModelFile | undefined, places: Map<string, Point>, middle: Point): Partial<Record<Axis, Point>> {
  const sums: Partial<Record<Axis, Point>> = {};
  for (const association of model?.associations ?? []) {
    const from = association['from'];
    if (!model || !from) continue;
    const place = (object: string): Point | null => {
      const inside = held(model, object);
      const own = Object.entries(model.features ?? {}).filter(([, feature]) => feature.realises && inside.has(feature.realises));
      return mean(own.flatMap(([name]) => (places.has(name) ? [places.get(name)!] : [])));
    };
    for (const [relation, to] of Object.entries(association)) {
      const axis = AXES[relation];
      if (!axis) continue;
      const a = place(from), b = place(to);
      if (!a && !b) continue;
      const sum = (sums[axis[0]] ??= [0, 0, 0]);
      // "handle, up: body" reads: the handle lies up of the body.
      for (let k = 0; k < 3; ++k) sum[k]! += axis[1] * ((a ?? middle)[k]! - (b ?? middle)[k]!);
    }
  }
  for (const [axis, sum] of Object.entries(sums) as [Axis, Point][]) {
    const length = Math.hypot(...sum);
    if (length > 0) sums[axis] = sum.map((x) => x / length) as Point;
    else delete sums[axis];
  }
  return sums;
}
