// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { floats, indices } from '@page/data/buffers';
import { directions } from '@page/data/directions';
import { Marking } from '@page/data/marking';
import { count, figure, milliseconds, probability, vector } from '@page/data/numbers';
import { marksOfTruth, parseTruth, textOfTruth, truthOf, type Marks } from '@page/data/truth';
import { DepthImage } from '@page/geometry/depth_image';
import { facing } from '@page/geometry/facing';
import { creasedCorners } from '@page/geometry/normals';
import { Occlusion } from '@page/geometry/occlusion';
import { nearestCorner, pick } from '@page/geometry/pick';
import { cellText, chosenRows, compareCells } from '@page/index/table';
import { wilson } from '@page/index/reliability';
import { arrange, type Label } from '@page/view/labels';
import { roundLength } from '@page/view/scale_bar';
import type { Verdict } from '@schemas/index';
import type { ModelDocument } from '@schemas/model';
import type { Point, SceneDocument } from '@schemas/scene';
import type { TruthDocument } from '@schemas/truth';
import { beaker, buffer, index, model, quantised, scene } from './fixture';

/** A cube of side 2 about the origin, faces outward. */
const CUBE = {
  positions: Float32Array.from([-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1]),
  triangles: Uint32Array.from([0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7]),
};
const close = (a: ArrayLike<number>, b: ArrayLike<number>, tolerance: number): boolean =>
  a.length === b.length && Array.from(a).every((x, i) => Math.abs(x - b[i]!) <= tolerance);

test('buffers: numbers come back as they went in, little-endian', () => {
  assert.deepEqual([...floats(buffer('f32', [1.5, -2.25, 1e20]), 'b')], [1.5, -2.25, Math.fround(1e20)]);
  assert.deepEqual([...indices(buffer('u32', [0, 70000, 4294967295]), 'b')], [0, 70000, 4294967295]);
  assert.deepEqual([...indices(buffer('u16', [258]), 'b')], [258]);
  assert.deepEqual([...indices(buffer('u8', [255, 0]), 'b')], [255, 0]);
  // 0x0102 little-endian is 2, 1.
  assert.deepEqual([...indices({ type: 'u16', count: 1, data: 'AgE=' }, 'b')], [258]);
});

test('buffers: quantised coordinates are off by half a step at most', () => {
  const values = [0, 5, -3, 10, 5, 8, 3.3333, 5, 0.1];
  assert.ok(close(floats(quantised(values), 'b'), values, 11 / 65535));
});

test('buffers: errors name the buffer', () => {
  const strange = (type: string): never => ({ type, count: 1, data: 'AAAAAA==' }) as never;
  assert.throws(() => floats({ type: 'f32', count: 2, data: 'AAAAAA==' }, 'lines'), /lines: 2 numbers of f32 take 8 bytes, found 4/);
  assert.throws(() => indices(strange('f32'), 'faces'), /faces: indices are/);
  assert.throws(() => floats(strange('f16'), 'p'), /p: unknown buffer type 'f16'/);
});

test('types: what is not as the schemas say does not compile', () => {
  const whole = scene();
  // @ts-expect-error: a scene has a palette.
  const lacking: SceneDocument = { ...whole, palette: undefined };
  // @ts-expect-error: there is no such verdict.
  const strange: Verdict = 'perhaps';
  // @ts-expect-error: a working set says how salient it is, nothing of a level.
  const renamed: unknown = whole.working_sets[0]!.level;
  assert.deepEqual([lacking.palette, strange, renamed], [undefined, 'perhaps', undefined]);
});

test('figures read as people write them', () => {
  assert.deepEqual([figure(38.94529), figure(-0.5), figure(2.03e-5, 3), figure(0), figure(null), figure(1e7)], ['38.95', '−0.5', '2.03e−5', '0', '–', '1e7']);
  assert.deepEqual([probability(1), probability(0.99999), probability(0.8988), probability(1e-9), probability(0), probability(null)], ['1', '>0.999', '0.899', '<0.001', '0', '–']);
  assert.deepEqual([vector([-0.0015, 0.06, 94.881]), vector([-6.7e-6, 1e-5, 0.9999999]), vector([0, 0, 0])], ['(0, 0.06, 94.88)', '(0, 0, 1)', '(0, 0, 0)']);
  assert.deepEqual([count(1234567), count(12), milliseconds(3.14159), milliseconds(2500)], ['1,234,567', '12', '3.14 ms', '2.5 s']);
});

const header = { mesh: 'cup.ply', class: 'cup', mean_edge: 2.5, bbox_diagonal: 160 };
const mark = (x: number, vertex: number | null = x): { point: Point; vertex: number | null } => ({ point: [x, 0, 0.5], vertex });

test('truth: marks round trip through the file', () => {
  const marks: Marks = new Map([
    ['rim', { absent: false, groups: [[mark(1), mark(2)]] }],
    ['handleCon', { absent: false, groups: [[mark(3)], [mark(4), mark(5)]] }],
    ['bottom', { absent: true, groups: [[]] }],
  ]);
  const file = parseTruth(textOfTruth(truthOf(marks, header, null)));
  assert.deepEqual(file.frame, { mean_edge: 2.5, bbox_diagonal: 160 });
  assert.deepEqual([file.schema, file.mesh, file.class], ['toposcope.truth/1', 'cup.ply', 'cup']);
  assert.deepEqual(file.features['rim'], { vertices: [1, 2], points: [[1, 0, 0.5], [2, 0, 0.5]] });
  assert.deepEqual(file.features['handleCon']!.groups!.map((group) => [group.name, group.centroid]), [['end1', [3, 0, 0.5]], ['end2', [4.5, 0, 0.5]]]);
  assert.deepEqual(file.features['bottom'], { points: [] });
  assert.deepEqual(marksOfTruth(file), marks);
});

test('truth: what was not touched stays, what was is made anew', () => {
  const before: TruthDocument = {
    mesh: 'a.ply', class: 'cup', notes: 'by hand', frame: { up: [0, 0, 1], mean_edge: 9 }, sample: { kind: 'cup', parameters: {}, noise_rel: 0, seed: 1 },
    features: { rim: { points: [[1, 0, 0.5]], shape: 'circle', parameters: { radius: 3 } }, bottom: { points: [[7, 0, 0.5]], shape: 'plane' } },
  };
  const same = truthOf(marksOfTruth(before), header, before);
  assert.deepEqual(same.features, before.features);
  assert.deepEqual([same.notes, same.sample, same.mesh], ['by hand', before.sample, 'a.ply']);
  assert.deepEqual(same.frame, { up: [0, 0, 1], mean_edge: 9, bbox_diagonal: 160 });
  const marks = marksOfTruth(before);
  marks.get('rim')!.groups[0]!.push(mark(8));
  const changed = truthOf(marks, header, before);
  assert.deepEqual(changed.features['rim'], { points: [[1, 0, 0.5], [8, 0, 0.5]] }, 'vertices are left out where one is not known');
  assert.deepEqual(changed.features['bottom'], before.features['bottom']);
  assert.equal(changed.sample, undefined);
});

test('truth: errors name the member', () => {
  assert.throws(() => parseTruth('{'), /is no JSON/);
  assert.throws(() => parseTruth('{"features": []}'), /\/features: expected an object/);
  assert.throws(() => parseTruth('{"features": {"rim": {}}}'), /\/features\/rim: expected an object with 'points' or 'groups'/);
  assert.throws(() => parseTruth('{"features": {"rim": {"points": [[1, 2]]}}}'), /\/features\/rim\/points\/0: expected three numbers/);
  assert.throws(() => parseTruth('{"features": {"h": {"groups": [{"name": "x"}]}}}'), /\/features\/h\/groups\/0\/points/);
});

test('marking: toggling, undo, groups, absence', () => {
  const marking = new Marking(new Map(), null, header);
  assert.equal(marking.toggle('rim', 0, mark(1)), 'added');
  marking.toggle('rim', 0, mark(2));
  assert.equal(marking.toggle('rim', 0, mark(1)), 'removed');
  assert.deepEqual(marking.marks.get('rim')!.groups, [[mark(2)]]);
  marking.undo();
  assert.equal(marking.count('rim'), 2);
  marking.toggle('handle', 1, mark(3));
  assert.deepEqual(marking.marks.get('handle')!.groups, [[], [mark(3)]]);
  marking.setAbsent('rim', true);
  assert.deepEqual([marking.count('rim'), marking.marks.get('rim')!.absent], [0, true]);
  marking.toggle('rim', 0, mark(9));
  assert.equal(marking.marks.get('rim')!.absent, false, 'a mark says that it is there');
  const text = marking.text();
  assert.throws(() => marking.load('[]'));
  assert.equal(marking.text(), text, 'a file that cannot be read changes nothing');
  for (let i = 0; i < 20; ++i) marking.undo();
  assert.equal(marking.total, 0);
});

test('directions: up, front and right of the model, at right angles', () => {
  const realising = (objects: Record<string, string>): ModelDocument['features'] =>
    Object.fromEntries(Object.entries(objects).map(([name, realises]) => [name, { realises, worksets: ['convex'], shape: 'circle' }]));
  const airplane = model(realising({ p: 'portEdge', s: 'starboardEdge', fin: 'finEdge' }), {
    topology: { port: ['portEdge'], starboard: ['starboardEdge'], fin: ['finEdge'] },
    parts: { tail: ['fin'] },
    associations: [{ from: 'starboard', right: 'body' }, { from: 'port', left: 'body' }, { from: 'tail', back: 'body' }, { from: 'fin', up: 'body' }],
  });
  const places = new Map<string, Point>([['p', [0, 5, 0]], ['s', [0, -5, 0]], ['fin', [-10, 0, 2]]]);
  const found = directions(airplane, places, [0, 0, 0]);
  assert.ok(close(found.right!, [0, -1, 0], 1e-9));
  assert.ok(found.front![0] > 0.9);
  assert.equal(found.up, undefined, 'the fin alone says nothing of up that it does not say of back');
  assert.deepEqual(directions(model({}, { associations: [{ from: 'x', up: 'y' }] }), places, [0, 0, 0]), {});
  const cup = model(realising({ rim: 'top', foot: 'low' }), { associations: [{ from: 'top', up: 'low' }] });
  assert.deepEqual(directions(cup, new Map([['rim', [0, 0, 3]], ['foot', [0, 0, 1]]]), [0, 0, 0]).up, [0, 0, 1]);
});

test('normals: sharp over creases, smooth over bends', () => {
  const sharp = creasedCorners(CUBE.positions, CUBE.triangles, 42).normals;
  assert.ok(close(sharp.slice(18, 21), [0, 0, 1], 1e-6), 'a corner of the top');
  const smooth = creasedCorners(CUBE.positions, CUBE.triangles, 100).normals;
  assert.ok(smooth[18]! < -0.3 && smooth[20]! > 0.3, 'the same corner, averaged over three sides');
  assert.ok(Math.abs(Math.hypot(smooth[18]!, smooth[19]!, smooth[20]!) - 1) < 1e-5);
});

test('picking: the nearest triangle and its nearest corner', () => {
  const hit = pick(CUBE.positions, CUBE.triangles, [0.6, 0.7, 9], [0, 0, -1])!;
  assert.ok(close(hit.point, [0.6, 0.7, 1], 1e-6) && Math.abs(hit.distance - 8) < 1e-6);
  assert.equal(nearestCorner(CUBE.positions, CUBE.triangles, hit), 6);
  assert.equal(pick(CUBE.positions, CUBE.triangles, [3, 0, 9], [0, 0, -1]), null);
  assert.equal(pick(CUBE.positions, CUBE.triangles, [0, 0, 9], [0, 0, 1]), null, 'behind');
});

test('depth image: what lies behind is not seen', () => {
  const image = new DepthImage(CUBE.positions, CUBE.triangles, [0, 0, 0], Math.sqrt(3));
  image.draw([0, 0, 1]);
  assert.equal(image.seesPoint(Float32Array.from([0, 0, 1]), 0), true);
  assert.equal(image.seesPoint(Float32Array.from([0.2, 0.1, -1]), 0), false);
  assert.equal(image.seesPoint(Float32Array.from([1.5, 0, -1]), 0), true, 'beside the cube');
});

test('facing: a shape on the underside is seen from below, one that is seen already is not turned away from', () => {
  const image = new DepthImage(CUBE.positions, CUBE.triangles, [0, 0, 0], Math.sqrt(3), 96);
  const below = facing(image, Float32Array.from([-0.8, -0.8, -1, 0.8, -0.8, -1, 0.8, 0.8, -1, -0.8, 0.8, -1]), [0.6, 0, 0.8]);
  assert.ok(below[2] < -0.5, `${below}`);
  const above = facing(image, Float32Array.from([-0.8, -0.8, 1, 0.8, -0.8, 1, 0.8, 0.8, 1, -0.8, 0.8, 1]), [0.2, 0, 0.98]);
  assert.ok(above[2] > 0.9, `${above}`);
});

test('occlusion: open outside, dark inside', () => {
  const { positions, triangles } = beaker(), p = Float32Array.from(positions), t = Uint32Array.from(triangles);
  const normals = new Float32Array(p.length), corners = creasedCorners(p, t, 180).normals;
  t.forEach((v, c) => [0, 1, 2].forEach((k) => (normals[3 * v + k] = corners[3 * c + k]!)));
  const occlusion = new Occlusion(p, t, normals, [0, 0, 36], 60);
  while (!occlusion.done) occlusion.step();
  const seen = occlusion.visibility(), ring = (k: number): number => seen[48 * k + 5]!;
  assert.ok(ring(7) > 0.95, `the outer side: ${ring(7)}`);
  assert.ok(ring(19) < 0.6, `the floor inside: ${ring(19)}`);
});

test('labels: none lies on another, none outside', () => {
  const label = (name: string): Label => ({ name, text: name, color: '#000000', selected: false, faint: false, anchors: new Float32Array() });
  const points: [number, number][] = [[200, 100], [210, 102]];
  const placed = arrange(Array.from({ length: 8 }, (_unused, i) => ({ label: label(`f${i}`), points, width: 60 })), { left: 150, right: 260 }, { width: 420, height: 300 });
  assert.equal(placed.length, 8);
  for (const side of [-1, 1]) {
    const heights = placed.filter((each) => each.side === side).map((each) => each.at[1]).sort((a, b) => a - b);
    heights.forEach((y, i) => assert.ok(y > 0 && y < 300 && (i === 0 || y - heights[i - 1]! > 25), `${heights}`));
  }
  assert.ok(placed.every(({ at, side }) => (side < 0 ? at[0] - 60 >= 0 : at[0] + 60 <= 420)));
});

test('scale: round lengths', () => {
  const near = (a: number, b: number): void => assert.ok(Math.abs(a - b) < 1e-12 * b, `${a} for ${b}`);
  ([[130, 100], [99, 50], [5, 5], [0.049, 0.02], [1.99e6, 1e6]] as const).forEach(([most, length]) => near(roundLength(most), length));
});

test('tables: filter by words, sort by value, nothing last', () => {
  const table = index().tables![0]!;
  const names = (rows: number[]): unknown[] => rows.map((r) => table.rows[r]![0]);
  assert.deepEqual(names(chosenRows(table, 'search missed', null, false)), ['search-10']);
  assert.deepEqual(names(chosenRows(table, 'SEARCH', 0, false)), ['search-9', 'search-10'], '10 comes after 9');
  assert.deepEqual(names(chosenRows(table, '', 3, false)), ['least-error', 'annealing', 'backtracking', 'search-9', 'random', 'search-10']);
  assert.deepEqual(names(chosenRows(table, '', 3, true)), ['random', 'search-9', 'backtracking', 'annealing', 'least-error', 'search-10']);
  assert.deepEqual([cellText(753200, 'number'), cellText(0.25, 'percent'), cellText(1500, 'ms'), cellText(null, 'text')], ['753,200', '25 %', '1.5 s', '–']);
  assert.ok(compareCells(2, 10) < 0 && compareCells(null, 1) > 0);
});

test("reliability: Wilson's interval", () => {
  const [low, high] = wilson(8, 10);
  assert.ok(Math.abs(low - 0.4902) < 1e-3 && Math.abs(high - 0.9433) < 1e-3, `${low} ${high}`);
  assert.deepEqual(wilson(0, 0), [0, 1]);
});
