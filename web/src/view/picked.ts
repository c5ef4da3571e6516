// SPDX-License-Identifier: BSD-3-Clause
// What a click on the surface means in each stage.
import type { Point } from '@schemas/scene';
import { count, plural } from '../data/numbers';
import type { Scene } from '../data/decoded';
import type { Marking } from '../data/marking';
import type { State } from '../state';
import { candidatesOf, surfaceOf } from './paint';
import type { Picked } from './viewer';

/** Written sets that hold a vertex, the smallest first. */
export function setsAt(scene: Scene, vertex: number): number[] {
  const sets = scene.document.working_sets;
  return sets.map((_set, i) => i).filter((i) => scene.set(i).includes(vertex)).sort((a, b) => sets[a]!.size - sets[b]!.size);
}

/** The one after the present one, around the list. */
function following<T>(list: T[], present: T | null): T | null {
  return list.length === 0 ? null : list[(list.indexOf(present as T) + 1) % list.length]!;
}

/** The feature whose face was hit; of an analysed surface, the one whose working sets hold the vertex. */
function featureAt(scene: Scene, state: State, picked: Picked): string | null {
  if (surfaceOf(scene, state) === scene.input) {
    const label = scene.input.labels[picked.triangle] ?? 0;
    return label > 0 ? (scene.features[label - 1]?.name ?? null) : null;
  }
  const sets = new Set(setsAt(scene, picked.vertex));
  for (const [name, { working_sets }] of candidatesOf(scene, state.stage === 'found' ? state.labeling : 0))
    if (working_sets.some((set) => sets.has(set))) return name;
  return null;
}

export function pickFeature(scene: Scene, state: State, picked: Picked | null): Partial<State> {
  if (!picked) return { feature: null, relation: null, face: null };
  const name = featureAt(scene, state, picked);
  return {
    feature: name,
    relation: null,
    face: surfaceOf(scene, state) === scene.input ? picked.triangle : null,
    ...(name ? { candidateOf: name, rank: 1 } : {}),
  };
}

export function pickSet(scene: Scene, state: State, picked: Picked | null): Partial<State> {
  return { set: picked ? following(setsAt(scene, picked.vertex), state.set) : null };
}

export function pickCandidate(scene: Scene, state: State, picked: Picked | null): Partial<State> {
  if (!picked) return {};
  const sets = new Set(setsAt(scene, picked.vertex));
  const names = state.candidateOf === null ? scene.features.map(({ name }) => name) : [state.candidateOf];
  const list = names.flatMap((name) => scene.candidates(name)).filter((each) => each.working_sets.some((set) => sets.has(set)));
  const present = list.find((each) => each.feature === state.candidateOf && each.rank === state.rank) ?? null;
  const next = following(list, present);
  return next ? { candidateOf: next.feature, rank: next.rank } : {};
}

/** Marks the vertex, or takes its mark away; says what was done. */
export function pickMark(scene: Scene, state: State, marking: Marking, picked: Picked): string | null {
  if (state.markOf === null) return null;
  const { positions, vertexIds } = scene.input, v = picked.vertex;
  const point: Point = [positions[3 * v]!, positions[3 * v + 1]!, positions[3 * v + 2]!];
  const done = marking.toggle(state.markOf, state.group, { point, vertex: vertexIds ? vertexIds[v]! : v });
  return `mark ${done}: ${plural(marking.count(state.markOf), 'mark')} of ${state.markOf}`;
}

export function hoverText(scene: Scene, state: State, picked: Picked): string {
  const { faces, vertexIds, labels } = scene.input;
  if (state.stage === 'worksets') {
    const types = setsAt(scene, picked.vertex).map((i) => scene.document.working_sets[i]!.type);
    return types.length === 0 ? '' : [...new Set(types)].map((type) => `${plural(types.filter((each) => each === type).length, `${type} set`)}`).join(', ');
  }
  if (state.stage === 'marks') return state.markOf ? `mark vertex ${count(vertexIds ? vertexIds[picked.vertex]! : picked.vertex)}` : 'choose a feature to mark';
  if (surfaceOf(scene, state) !== scene.input) return '';
  const label = labels[picked.triangle] ?? 0;
  const face = faces ? faces[picked.triangle]! : picked.triangle;
  return `${label > 0 ? `${scene.features[label - 1]?.name ?? ''} · ` : ''}face ${count(face)}`;
}
