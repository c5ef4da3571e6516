// SPDX-License-Identifier: BSD-3-Clause
// Documents for tests, made here: a beaker of revolution about z with a rim, a floor, and no handle.
import type { IndexDocument } from '@schemas/index';
import type { ModelDocument } from '@schemas/model';
import type { CandidateCount, Fit } from '@schemas/result';
import type { Candidate, Drawing, Point, Quantised, SceneDocument } from '@schemas/scene';

function base64(bytes: Uint8Array): string {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

interface Buffer<Type> {
  type: Type;
  count: number;
  data: string;
}

export function buffer<Type extends 'f32' | 'u32' | 'u16' | 'u8'>(type: Type, values: number[]): Buffer<Type> {
  const array = { f32: Float32Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array }[type].from(values);
  return { type, count: values.length, data: base64(new Uint8Array(array.buffer)) };
}

export function quantised(values: number[]): Quantised {
  const min: Point = [Infinity, Infinity, Infinity], max: Point = [-Infinity, -Infinity, -Infinity];
  values.forEach((x, i) => {
    min[i % 3] = Math.min(min[i % 3]!, x);
    max[i % 3] = Math.max(max[i % 3]!, x);
  });
  const step = min.map((low, k) => (max[k]! - low) / 65535 || 1) as Point;
  const array = Uint16Array.from(values.map((x, i) => Math.round((x - min[i % 3]!) / step[i % 3]!)));
  return { type: 'q16', count: values.length, data: base64(new Uint8Array(array.buffer)), min, step };
}

/** Rings of the beaker's section, radius and height, from the middle of the floor outside to the middle of the floor inside. */
const SECTION: [number, number][] = [
  [0.01, 0], [10, 0], [20, 0], [30, 0], [32, 10], [33, 20], [34, 30], [35, 40], [36, 50], [37, 60], [38, 70],
  [36, 73], [34, 70], [33, 60], [32, 50], [31, 40], [30, 30], [29, 20], [28, 10], [20, 8], [10, 8], [0.01, 8],
];
export const AROUND = 48;
export const RIM = { center: [0, 0, 73] as Point, radius: 36 };
const RIM_RINGS = [10, 11, 12], FLOOR_RINGS = [0, 1, 2, 3];

export interface Beaker {
  positions: number[];
  triangles: number[];
  labels: number[];
}

export function beaker(): Beaker {
  const mesh: Beaker = { positions: [], triangles: [], labels: [] };
  for (const [r, z] of SECTION)
    for (let i = 0; i < AROUND; ++i) {
      const a = (2 * Math.PI * i) / AROUND;
      mesh.positions.push(r * Math.cos(a), r * Math.sin(a), z);
    }
  for (let k = 0; k + 1 < SECTION.length; ++k)
    for (let i = 0; i < AROUND; ++i) {
      const a = k * AROUND + i, b = k * AROUND + ((i + 1) % AROUND), c = a + AROUND, d = b + AROUND;
      mesh.triangles.push(a, b, d, a, d, c);
      const label = RIM_RINGS.includes(k) && RIM_RINGS.includes(k + 1) ? 1 : FLOOR_RINGS.includes(k + 1) ? 2 : 0;
      mesh.labels.push(label, label);
    }
  return mesh;
}

const ringsOf = (rings: number[]): number[] => rings.flatMap((k) => Array.from({ length: AROUND }, (_unused, i) => k * AROUND + i));

export function circle(center: Point, radius: number): Drawing {
  const points = Array.from({ length: 97 }, (_unused, i) => {
    const a = (2 * Math.PI * i) / 96;
    return [center[0] + radius * Math.cos(a), center[1] + radius * Math.sin(a), center[2]];
  });
  return { lines: [buffer('f32', points.flat())], patches: [] };
}

function disc(radius: number): Drawing {
  const { lines } = circle([0, 0, 0], radius);
  const rim = Array.from({ length: 32 }, (_unused, i) => [radius * Math.cos((Math.PI * i) / 16), radius * Math.sin((Math.PI * i) / 16), 0]);
  const triangles = rim.flatMap((_point, i) => [0, 1 + i, 1 + ((i + 1) % 32)]);
  return { lines, patches: [{ positions: buffer('f32', [0, 0, 0, ...rim.flat()]), triangles: buffer('u16', triangles) }] };
}

export const COLORS = { rim: '#009e73', bottom: '#cc79a7', handle: '#56b4e9' };
export const SET_COLORS = { convex: '#d55e00', planar: '#009e73' };

function candidate(feature: string, rank: number, drawing: Drawing, sets: number[], parameters: Candidate['parameters']): Candidate {
  return { feature, rank, probability: rank === 1 ? 0.97 : 0.03 / rank, evidence: 30 / rank, shape: drawing.patches.length > 0 ? 'plane' : 'circle', parameters, fit_error: 0.1 * rank, working_sets: sets, drawing };
}

/** A model file that says so much of its objects. */
export function model(features: ModelDocument['features'], rest: Partial<ModelDocument> = {}): ModelDocument {
  return { schema: 'toposcope.model/1', name: 'cup', features, ...rest };
}

const MODELLED: ModelDocument['features'] = {
  rim: { realises: 'top', worksets: ['convex'], shape: 'circle' },
  bottom: { realises: 'floor', worksets: ['planar'], shape: 'plane' },
  handle: { realises: 'holder', worksets: ['concave', 'concave'], shape: 'circle' },
};

const kept = (n: number): CandidateCount => ({ kept: n, groups: n, boxed_out: 0, unusable: 0, out_of_range: 0, poor_fit: 0, beaten: 0 });

export function scene(): SceneDocument {
  const { positions, triangles, labels } = beaker();
  const rim = { center: RIM.center, normal: [0, 0, 1], radius: RIM.radius };
  const low = { center: [0, 0, 40] as Point, normal: [0, 0, 1], radius: 35 };
  const bottom = { point: [0, 0, 0], normal: [0, 0, 1] };
  const fit: Fit = { termination: 'converged', iterations: 3, initial_cost: 2, final_cost: 1, explained: 40, unexplained: 0, coverage: 1 };
  const facesOf = (label: number): number[] => labels.flatMap((each, t) => (each === label ? [t] : []));
  const handleFailed = { name: 'r2', type: 'perpendicular', features: ['handle', 'rim'], tested: true, residual: 41, tolerance: 10, unit: 'deg' as const, satisfied: false, probability: 0.01 };
  return {
    schema: 'toposcope.scene/1',
    title: 'beaker.ply · cup',
    program: 'toposcope test',
    unit: '',
    result: {
      schema: 'toposcope.result/1',
      mesh: { path: 'meshes/beaker.ply', sha256: '0'.repeat(64), vertices: positions.length / 3, faces: labels.length, box: { a: 76, b: 76, c: 73 }, mean_edge: 5, components: 1, closed_components: 0, holes: 2, euler: 0, genus: 0, repair: { merged_vertices: 3, unreferenced_vertices: 0, non_finite_vertices: 0, non_finite_faces: 0, degenerate_faces: 0, flat_faces: 0, duplicate_faces: 0, split_edges: 0, isolated_faces: 0, split_vertices: 0, turned_faces: 0, cut_edges: 0 } },
      model: 'cup', model_sha256: '0'.repeat(64), status: 'partial', class: null, class_probabilities: { cup: 1 }, log_evidence: 41.5, optimal: true,
      guarantee: 'least cost: proven', probabilities: 'posterior: exact', probability_exactness: 'exact', probability_error: null,
      features: {
        rim: { present: true, probability: 0.9997, evidence: 30, shape: 'circle', parameters: rim, measures: { radius: 36, coverage: 1 }, fit_error: 0.1, fit, uncertainty: { radius: 0.05, centroid: 0.04, direction_deg: 0.2 }, working_sets: [0], faces: facesOf(1) },
        bottom: { present: true, probability: 0.84, evidence: 12, shape: 'plane', parameters: bottom, measures: { extent: 60, area: 2800 }, fit_error: 0, fit, uncertainty: { extent: 1, centroid: 0.5 }, working_sets: [1], faces: facesOf(2) },
        handle: { present: false, probability_missing: 0.93, why: { reason: 'the nearest candidate breaks 1 relationship(s)', nearest_candidate: { parameters: low, fit_error: 0.2, cost: 9 }, relations_failed: [handleFailed], conflict: { relations: ['r2'], exclusions: ['bottom'], smallest: true } } },
      },
      relations: [
        { name: 'r1', type: 'parallel', features: ['rim', 'bottom'], tested: true, residual: 0.4, tolerance: 10, unit: 'deg', satisfied: true, probability: 0.999 },
        { name: 'r2', type: 'perpendicular', features: ['handle', 'rim'], tested: false, satisfied: false, why: "'handle' is missing" },
        { name: 'r3', type: 'reflective-symmetry', features: ['rim', 'bottom'], tested: true, residual: 3, tolerance: 2, unit: 'length', satisfied: false, probability: 0.2 },
      ],
      measures: {
        height: { expression: 'distance(rim, bottom)', unit: 'length', value: 71.25, sd: 0.08 },
        reach: { expression: 'distance(rim, handle)', unit: 'length', value: null, why: "'handle' is missing" },
      },
      measures_covariance: { of: ['height'], covariance: [[0.0064]] },
      alternatives: [{ probability: 0.03, cost: -4, candidates: { rim: 2, bottom: 1, handle: 0 } }],
      working_sets: 5,
      candidates: { rim: kept(2), bottom: kept(1), handle: kept(1) },
      timings_ms: { read: 3, classify: 12, fit: 40.2, label: 0.4 },
      plugins: [{ kind: 'shapes', id: 'circle', version: '1.0.0', options: { method: 'robust' } }, { kind: 'labelers', id: 'least-error', version: '1.0.0', options: {} }],
    },
    surfaces: {
      input: {
        mesh_vertices: positions.length / 3, mesh_triangles: labels.length, shown_vertices: positions.length / 3, shown_triangles: labels.length,
        positions: quantised(positions), triangles: buffer('u16', triangles), labels: buffer('u8', labels),
      },
    },
    working_sets: [
      { type: 'convex', vertices: buffer('u16', ringsOf(RIM_RINGS)), size: 3 * AROUND, saliency: 0.1 },
      { type: 'planar', vertices: buffer('u16', ringsOf(FLOOR_RINGS)), size: 4 * AROUND, saliency: null },
      { type: 'convex', vertices: buffer('u16', ringsOf([6, 7, 8])), size: 3 * AROUND, saliency: 0.2 },
      { type: 'convex', vertices: buffer('u16', ringsOf([10, 11])), size: 2 * AROUND, saliency: 0.3 },
    ],
    all_working_sets: [
      { type: 'convex', vertices: buffer('u16', ringsOf(RIM_RINGS)), size: 3 * AROUND },
      { type: 'planar', vertices: buffer('u16', ringsOf(FLOOR_RINGS)), size: 4 * AROUND },
    ],
    candidates: [
      candidate('rim', 1, circle(RIM.center, RIM.radius), [0], rim),
      candidate('rim', 2, circle(low.center, low.radius), [2], low),
      candidate('bottom', 1, disc(30), [1], bottom),
      candidate('handle', 1, circle(low.center, low.radius), [2], low),
    ],
    found: [{ feature: 'rim', rank: 1, drawing: circle(RIM.center, RIM.radius) }, { feature: 'bottom', rank: 1, drawing: disc(30) }],
    marks: null,
    model: model(MODELLED, {
      objects: { cup: 'volume', top: 'line', floor: 'surface', holder: 'line' },
      associations: [{ from: 'top', up: 'floor' }],
    }),
    palette: { features: Object.values(COLORS), worksets: SET_COLORS },
  };
}

/** A grey picture of one pixel. */
const PIXEL = 'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==';

export function index(): IndexDocument {
  const small: SceneDocument = { ...scene(), working_sets: [], all_working_sets: [], candidates: [] };
  return {
    schema: 'toposcope.index/1',
    title: 'two labelers',
    program: 'toposcope test',
    tables: [{
      id: 'labelers', title: 'Labelers',
      columns: [{ name: 'labeler', unit: null, kind: 'text' }, { name: 'rim', unit: null, kind: 'verdict' }, { name: 'right', unit: null, kind: 'percent' }, { name: 'cost', unit: 'nats', kind: 'number' }, { name: 'time', unit: 'ms', kind: 'ms' }],
      rows: [['backtracking', 'right', 0.5, 12.25, 3.5], ['least-error', 'right', 1, 9.5, 120], ['search-10', 'missed', 0.25, null, 8], ['search-9', 'wrong', 0.75, 30, 1500], ['random', 'absent', 0, 55, 0.1], ['annealing', 'spurious', 0.3, 10, 80]],
      links: ['backtracking/report.html', null, null, null, null, null],
    }],
    meshes: [
      { name: 'beaker', thumbnail: PIXEL, verdicts: { rim: 'right', bottom: 'wrong', handle: 'absent' }, report: 'beaker/report.html', probability: 0.8 },
      { name: 'mug', thumbnail: null, verdicts: { rim: 'right', bottom: 'right', handle: 'right' }, report: null, probability: 0.99 },
    ],
    reliability: [{ name: 'beakers', ece: 0.05, bins: [{ from: 0.4, to: 0.6, count: 10, right: 6, mean_probability: 0.5 }, { from: 0.9, to: 1, count: 90, right: 88, mean_probability: 0.98 }] }],
    confusion: { classes: ['tee', 'wye'], answers: ['tee', 'wye'], counts: [[14, 1], [0, 15]] },
    views: [{ name: 'backtracking', scene: small }, { name: 'least-error', scene: scene() }],
  };
}
