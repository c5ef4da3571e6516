// SPDX-License-Identifier: BSD-3-Clause
// A scene document with its buffers read, as the views take it.
import { floats, indices } from './buffers';
import { directions, type Axis } from './directions';
import type { Candidate, Drawing, Feature, Point, SceneDocument } from './scene';
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

const FALLBACK = ['#009e73', '#cc79a7', '#56b4e9', '#e69f00', '#0072b2', '#d55e00', '#f0e442', '#5a5a5a'];
const FALLBACK_SETS: Record<string, string> = { convex: '#d55e00', concave: '#0072b2', planar: '#009e73' };
export const SPARE_SET_COLOR = '#cc79a7';

export class Scene {
  readonly input: SurfaceData & { labels: Uint32Array; faces: Uint32Array | null; vertexIds: Uint32Array | null };
  /** What working sets index. */
  readonly analysed: SurfaceData;
  readonly features: NamedFeature[];
  readonly setColors: Map<string, string>;
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
    const found = new Map((document.found ?? []).map((each) => [each.feature, each]));
    this.features = Object.entries(document.result.features).map(([name, feature], index) => ({
      name,
      index,
      color: document.palette?.features?.[index] ?? FALLBACK[index % FALLBACK.length]!,
      feature,
      drawing: found.get(name)?.drawing ?? null,
      candidate: this.candidate(name, found.get(name)?.rank ?? 0),
    }));
    this.setColors = new Map();
    for (const type of this.setTypes)
      this.setColors.set(type, document.palette?.worksets?.[type] ?? FALLBACK_SETS[type] ?? SPARE_SET_COLOR);
  }

  get result(): SceneDocument['result'] {
    return this.document.result;
  }

  /** In the order in which the document names them. */
  get setTypes(): string[] {
    const { all_working_sets = [], working_sets = [] } = this.document;
    return [...new Set([...all_working_sets, ...working_sets].map((set) => set.type))];
  }

  feature(name: string | null): NamedFeature | null {
    return this.features.find((feature) => feature.name === name) ?? null;
  }

  candidates(feature: string): Candidate[] {
    return (this.document.candidates ?? []).filter((c) => c.feature === feature).sort((a, b) => a.rank - b.rank);
  }

  candidate(feature: string, rank: number): Candidate | null {
    return (this.document.candidates ?? []).find((c) => c.feature === feature && c.rank === rank) ?? null;
  }

  /** Vertices of a written working set. */
  set(index: number): Uint32Array {
    let vertices = this.setVertices.get(index);
    if (!vertices) {
      const set = this.document.working_sets?.[index];
      vertices = set ? indices(set.vertices, `working_sets[${index}].vertices`) : new Uint32Array();
      this.setVertices.set(index, vertices);
    }
    return vertices;
  }

  /** All sets of a type together. */
  union(type: string): Uint32Array {
    const all = this.document.all_working_sets?.find((set) => set.type === type);
    if (all) return indices(all.vertices, `all_working_sets ${type}`);
    const sets = (this.document.working_sets ?? []).flatMap((set, i) => (set.type === type ? [this.set(i)] : []));
    return Uint32Array.from(sets.flatMap((set) => [...set]));
  }

  directions(middle: Point): Partial<Record<Axis, Point>> {
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
    return Math.max(1, this.document.model?.features?.[name]?.worksets?.length ?? 1);
  }
}

/** The middle of a drawing's box. */
export function middleOf(drawing: Drawing): Point | null {
  const low: Point = [Infinity, Infinity, Infinity], high: Point = [-Infinity, -Infinity, -Infinity];
  for (const buffer of [...(drawing.lines ?? []), ...(drawing.patches ?? []).map((patch) => patch.positions)])
    floats(buffer, 'drawing').forEach((x, i) => {
      low[i % 3] = Math.min(low[i % 3]!, x);
      high[i % 3] = Math.max(high[i % 3]!, x);
    });
  return low[0] === Infinity ? null : (low.map((x, k) => (x + high[k]!) / 2) as Point);
}
