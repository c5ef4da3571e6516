// SPDX-License-Identifier: BSD-3-Clause
// Marks made by hand, and the truth file that `toposcope evaluate` reads (schemas/truth.schema.json).
import type { Feature, Group, Point, TruthDocument } from '@schemas/truth';

/** One marked vertex; `vertex` is its index in the input mesh, null where a file names none. */
export interface Mark {
  point: Point;
  vertex: number | null;
}

/** The marks of a feature: one list, or one for each group; absent: the object does not have it. */
export interface FeatureMarks {
  absent: boolean;
  groups: Mark[][];
}

export type Marks = Map<string, FeatureMarks>;

const marksOf = (points: Point[], vertices?: number[]): Mark[] =>
  points.map((point, i) => ({ point, vertex: vertices?.length === points.length ? vertices[i]! : null }));

function fail(place: string, what: string): never {
  throw new Error(`${place}: ${what} (schemas/truth.schema.json)`);
}

function isPoint(value: unknown): value is Point {
  return Array.isArray(value) && value.length === 3 && value.every((x) => typeof x === 'number' && Number.isFinite(x));
}

function checkPoints(value: unknown, place: string): void {
  if (!Array.isArray(value)) fail(place, 'expected a list of points');
  (value as unknown[]).forEach((point, i) => isPoint(point) || fail(`${place}/${i}`, 'expected three numbers'));
}

/** Reads a truth file's text; errors name the member as a JSON pointer. */
export function parseTruth(text: string): TruthDocument {
  let root: unknown;
  try {
    root = JSON.parse(text);
  } catch (error) {
    return fail('truth file', `is no JSON: ${(error as Error).message}`);
  }
  if (typeof root !== 'object' || root === null || Array.isArray(root)) fail('/', 'a truth file holds a JSON object');
  const file = root as TruthDocument;
  if (typeof file.features !== 'object' || file.features === null || Array.isArray(file.features))
    fail('/features', 'expected an object of features by name');
  for (const [name, feature] of Object.entries(file.features)) {
    const place = `/features/${name}`;
    if (typeof feature !== 'object' || feature === null || (!feature.points && !feature.groups))
      fail(place, "expected an object with 'points' or 'groups'");
    if (feature.points) checkPoints(feature.points, `${place}/points`);
    if (feature.groups !== undefined && !Array.isArray(feature.groups)) fail(`${place}/groups`, 'expected a list');
    feature.groups?.forEach((group, i) => checkPoints(group?.points, `${place}/groups/${i}/points`));
  }
  return file;
}

export function marksOfTruth(file: TruthDocument): Marks {
  const marks: Marks = new Map();
  for (const [name, feature] of Object.entries(file.features)) {
    const groups = feature.groups?.length
      ? feature.groups.map((group) => marksOf(group.points, group.vertices))
      : [marksOf(feature.points ?? [], feature.vertices)];
    marks.set(name, { absent: groups.every((group) => group.length === 0), groups });
  }
  return marks;
}

function centroid(points: Point[]): Point {
  const sum: Point = [0, 0, 0];
  for (const point of points) for (let k = 0; k < 3; ++k) sum[k]! += point[k]! / points.length;
  return sum;
}

function sameMarks(a: FeatureMarks, b: FeatureMarks | undefined): boolean {
  return b !== undefined && JSON.stringify([a.absent, a.groups]) === JSON.stringify([b.absent, b.groups]);
}

const verticesOf = (list: Mark[]): number[] | undefined => {
  const found = list.map((mark) => mark.vertex);
  return list.length > 0 && found.every((v): v is number => v !== null) && new Set(found).size === found.length
    ? (found as number[])
    : undefined;
};

function group(list: Mark[], name: string): Group {
  const points = list.map((mark) => mark.point);
  const vertices = verticesOf(list);
  return { name, ...(vertices ? { vertices } : {}), points, centroid: centroid(points) };
}

function featureOf(marks: FeatureMarks, before: Feature | undefined): Feature {
  if (marks.absent) return { points: [] };
  const grouped = marks.groups.length > 1;
  if (grouped) {
    const groups = marks.groups
      .map((list, i) => ({ list, name: before?.groups?.[i]?.name ?? `end${i + 1}` }))
      .filter(({ list }) => list.length > 0)
      .map(({ list, name }) => group(list, name));
    return { groups };
  }
  const list = marks.groups[0] ?? [];
  const vertices = verticesOf(list);
  return { ...(vertices ? { vertices } : {}), points: list.map((mark) => mark.point) };
}

/** What a new file says beside the marks. */
export interface Header {
  mesh: string;
  class: string;
  mean_edge: number;
  bbox_diagonal: number;
}

/**
 * The marks as a truth file. What the file `before` said of features that were not touched, of the frame and of all else stays; exact
 * shapes go where the marks of their feature changed, and `sample` goes with the first change, for the file is then no longer
 * what the program made.
 * Features without any mark are left out, as not judged: an absent one is said to be absent.
 */
export function truthOf(marks: Marks, header: Header, before: TruthDocument | null): TruthDocument {
  const earlier = before ? marksOfTruth(before) : new Map<string, FeatureMarks>();
  const features: Record<string, Feature> = {};
  let changed = false;
  for (const [name, feature] of marks) {
    if (before && before.features[name] && sameMarks(feature, earlier.get(name))) {
      features[name] = before.features[name];
      continue;
    }
    changed = true;
    if (feature.absent || feature.groups.some((list) => list.length > 0))
      features[name] = featureOf(feature, before?.features[name]);
  }
  const file: TruthDocument = {
    schema: 'toposcope.truth/1',
    ...(before ?? {}),
    mesh: before?.mesh || header.mesh,
    class: header.class || before?.class || '',
    features,
    frame: { mean_edge: header.mean_edge, bbox_diagonal: header.bbox_diagonal, ...(before?.frame ?? {}) },
  };
  if (changed) delete file.sample;
  return file;
}

/** One line for each point, so that files compare well. */
export function textOfTruth(file: TruthDocument): string {
  return JSON.stringify(file, null, 1).replace(/\[\s+(-?[\d.e+-]+(?:,\s+-?[\d.e+-]+)*)\s+\]/g, (_all, inside: string) =>
    `[${inside.replace(/\s+/g, ' ')}]`,
  ) + '\n';
}
