// SPDX-License-Identifier: BSD-3-Clause
// A scene document with its buffers read, as the views take it.
import type { Feature, ResultDocument } from '@schemas/result';
import type { Candidate, Drawing, Point, SceneDocument } from '@schemas/scene';
import { floats, indices } from './buffers';
import { directions, type Axis } from './directions';
import { marksOfTruth, type Marks } from './truth';

export interface SurfaceData {
  positions: Float32Array;
  triangles: Uint32Array;
}

export interface NamedFeature {
  name: string;
  /** Place among result.features; labels of triangles are one more. */
  index: number;
  color: string;
  feature: Feature;
  drawing: Drawing | null;
  /** The candidate that it is, as far as that is written. */
  candidate: Candidate | null;
}

export class Scene {
  readonly input: SurfaceData & { labels: Uint32Array; faces: Uint32Array | null; vertexIds: Uint32Array | null };
  /** What working sets index. */
  readonly analysed: SurfaceData;
  readonly features: NamedFeature[];
  private setVertices = new Map<number, Uint32Array>();

  constructor(readonly document: SceneDocument) {
    const { input, normalised } = document.surfaces;
    const triangles = indices(input.triangles, 'surfaces.input.triangles');
    this.input = {
      positions: floats(input.positions, 'surfaces.input.positions'),
      triangles,
      labels: input.labels ? indices(input.labels, 'surfaces.input.labels') : new Uint32Array(triangles.length / 3),
      faces: input.faces ? indices(input.faces, 'surfaces.input.faces') : null,
      vertexIds: input.vertex_ids ? indices(input.vertex_ids, 'surfaces.input.vertex_ids') : null,
    };
    this.analysed = normalised
      ? {
          positions: floats(normalised.positions, 'surfaces.normalised.positions'),
          triangles: indices(normalised.triangles, 'surfaces.normalised.triangles'),
        }
      : this.input;
    const found = new Map(document.found.map((each) => [each.feature, each]));
    this.features = Object.entries(document.result.features).map(([name, feature], index) => ({
      name,
      index,
      color: document.palette.features[index]!,
      feature,
      drawing: found.get(name)?.drawing ?? null,
      candidate: this.candidate(name, found.get(name)?.rank ?? 0),
    }));
  }

  get result(): ResultDocument {
    return this.document.result;
  }

  /** In the order in which the document names them. */
  get setTypes(): string[] {
    return this.document.all_working_sets.map((set) => set.type);
  }

  setColor(type: string): string {
    return this.document.palette.worksets[type]!;
  }

  feature(name: string | null): NamedFeature | null {
    return this.features.find((feature) => feature.name === name) ?? null;
  }

  candidates(feature: string): Candidate[] {
    return this.document.candidates.filter((c) => c.feature === feature).sort((a, b) => a.rank - b.rank);
  }

  candidate(feature: string, rank: number): Candidate | null {
    return this.document.candidates.find((c) => c.feature === feature && c.rank === rank) ?? null;
  }

  /** Vertices of a written working set. */
  set(index: number): Uint32Array {
    let vertices = this.setVertices.get(index);
    if (!vertices) {
      const set = this.document.working_sets[index]!;
      vertices = indices(set.vertices, `working_sets[${index}].vertices`);
      this.setVertices.set(index, vertices);
    }
    return vertices;
  }

  /** All sets of a type together. */
  union(type: string): Uint32Array {
    const all = this.document.all_working_sets.find((set) => set.type === type)!;
    return indices(all.vertices, `all_working_sets ${type}`);
  }

  directions(middle: Point): Partial<Record<Axis, Point>> {
    const told = this.document.result.directions;
    if (told) return { up: told.up as Point, front: told.front as Point, right: told.right as Point };
    const places = new Map<string, Point>();
    for (const { name, drawing } of this.features) {
      const place = drawing && middleOf(drawing);
      if (place) places.set(name, place);
    }
    return directions(this.document.model, places, middle);
  }

  /** Coordinates of the found shapes' lines. */
  foundPoints(): Float32Array {
    const points = this.features.flatMap(({ drawing }) => (drawing?.lines ?? []).flatMap((line) => [...floats(line, 'line')]));
    return Float32Array.from(points);
  }

  /** Marks of the truth file beside the mesh; none of it is a copy that a change would reach. */
  marks(): Marks {
    const { truth, marks } = this.document;
    if (truth) return marksOfTruth(truth);
    return new Map(
      Object.entries(marks ?? {}).map(([name, points]) => [
        name,
        { absent: points.length === 0, groups: [points.map((point) => ({ point, vertex: null }))] },
      ]),
    );
  }

  /** How many groups of marks a feature takes: one for each working set of a feature that has several. */
  groups(name: string): number {
    return Math.max(1, this.document.model?.features?.[name]?.worksets.length ?? 1);
  }
}

/** The middle of a drawing's box. */
export function middleOf(drawing: Drawing): Point | null {
  const low: Point = [Infinity, Infinity, Infinity], high: Point = [-Infinity, -Infinity, -Infinity];
  for (const buffer of [...drawing.lines, ...drawing.patches.map((patch) => patch.positions)])
    floats(buffer, 'drawing').forEach((x, i) => {
      low[i % 3] = Math.min(low[i % 3]!, x);
      high[i % 3] = Math.max(high[i % 3]!, x);
    });
  return low[0] === Infinity ? null : (low.map((x, k) => (x + high[k]!) / 2) as Point);
}
