// SPDX-License-Identifier: BSD-3-Clause
// The colour of each triangle in each stage.
import type { Candidate } from '@schemas/scene';
import type { Scene, SurfaceData } from '../data/decoded';
import type { State } from '../state';

export type Rgb = [number, number, number];

export function rgb(color: string): Rgb {
  const value = parseInt(color.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

export const css = (color: Rgb): string => `rgb(${color.join(', ')})`;

export const mixed = (a: Rgb, b: Rgb, part: number): Rgb => a.map((x, k) => Math.round(x + (b[k]! - x) * part)) as Rgb;

class Paint {
  readonly colors: Uint8Array;
  constructor(private surface: SurfaceData, base: Rgb) {
    this.colors = new Uint8Array(surface.triangles.length);
    for (let i = 0; i < this.colors.length; ++i) this.colors[i] = base[i % 3]!;
  }

  triangle(t: number, color: Rgb): void {
    this.colors.set(color, 3 * t);
  }

  /** All triangles between the vertices of a set. */
  set(vertices: Uint32Array, color: Rgb): void {
    const { triangles, positions } = this.surface;
    const inside = new Uint8Array(positions.length / 3);
    for (const v of vertices) inside[v] = 1;
    for (let t = 0; t < triangles.length; t += 3)
      if (inside[triangles[t]!] && inside[triangles[t + 1]!] && inside[triangles[t + 2]!]) this.triangle(t / 3, color);
  }

  /** Triangles of which two vertices at least are of one part. */
  partition(parts: { vertices: Uint32Array; color: Rgb }[]): void {
    const { triangles, positions } = this.surface;
    const partOf = new Uint8Array(positions.length / 3);
    parts.forEach(({ vertices }, i) => vertices.forEach((v) => (partOf[v] = i + 1)));
    for (let t = 0; t < triangles.length; t += 3) {
      const a = partOf[triangles[t]!]!, b = partOf[triangles[t + 1]!]!, c = partOf[triangles[t + 2]!]!;
      const part = a === b || a === c ? a : b === c ? b : 0;
      if (part > 0) this.triangle(t / 3, parts[part - 1]!.color);
    }
  }
}

/** The candidates of a labelling, by feature; 0 is the best, as far as it is written. */
export function candidatesOf(scene: Scene, labeling: number): Map<string, Candidate> {
  const ranks = labeling === 0 ? null : (scene.result.alternatives[labeling - 1]?.candidates ?? {});
  const pairs = scene.features.map(({ name, candidate }) => [name, ranks ? scene.candidate(name, ranks[name] ?? 0) : candidate] as const);
  return new Map(pairs.filter((pair): pair is readonly [string, Candidate] => pair[1] !== null));
}

/** Whether filters made the mesh so much finer that regions are better seen on what they left than on faces of the file. */
function isRefined(scene: Scene): boolean {
  const written = scene.features.every(({ feature, candidate }) => !feature.present || candidate !== null);
  return written && scene.analysed.triangles.length > 1.5 * scene.input.triangles.length;
}

/** Which surface a stage shows. */
export function surfaceOf(scene: Scene, state: State): SurfaceData {
  if (state.stage === 'found') return state.labeling > 0 || isRefined(scene) ? scene.analysed : scene.input;
  return state.stage === 'marks' ? scene.input : scene.analysed;
}

/** \param base  of the bare surface */
export function paint(scene: Scene, state: State, base: Rgb): Uint8Array {
  const surface = surfaceOf(scene, state), canvas = new Paint(surface, base);
  const chosen = new Set(chosenFeatures(scene, state));
  const strength = (name: string): number => (chosen.size === 0 ? 0.72 : chosen.has(name) ? 0.92 : 0.16);
  if (state.stage === 'worksets') {
    const set = state.set === null ? null : scene.document.working_sets[state.set];
    if (set) canvas.set(scene.set(state.set!), rgb(scene.setColor(set.type)));
    else canvas.partition(scene.setTypes.map((type) => ({
        vertices: state.hiddenTypes.has(type) ? new Uint32Array() : scene.union(type),
        color: mixed(base, rgb(scene.setColor(type)), 0.8),
      })));
  } else if (state.stage === 'candidates') {
    const candidate = state.candidateOf === null ? null : scene.candidate(state.candidateOf, state.rank);
    for (const index of candidate?.working_sets ?? []) {
      const { type } = scene.document.working_sets[index]!;
      canvas.set(scene.set(index), mixed(base, rgb(scene.setColor(type)), 0.72));
    }
  } else if (state.stage === 'found' && (surface !== scene.input || state.labeling > 0)) {
    for (const [name, { working_sets }] of candidatesOf(scene, state.labeling))
      for (const index of working_sets) canvas.set(scene.set(index), mixed(base, rgb(scene.feature(name)!.color), strength(name)));
  } else if (surface === scene.input && (state.stage === 'found' || chosen.size > 0)) {
    const soft = state.stage === 'found' ? 1 : 0.35;
    const colors = scene.features.map(({ name, color }) =>
      state.stage === 'found' || chosen.has(name) ? mixed(base, rgb(color), soft * strength(name)) : base,
    );
    scene.input.labels.forEach((label, t) => {
      if (label > 0) canvas.triangle(t, colors[label - 1] ?? base);
    });
  }
  return canvas.colors;
}

/** The features that a selection stands for. */
export function chosenFeatures(scene: Scene, state: State): string[] {
  if (state.feature !== null) return [state.feature];
  const relation = scene.result.relations.find(({ name }) => name === state.relation);
  return relation?.features ?? [];
}
