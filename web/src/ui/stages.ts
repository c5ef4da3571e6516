// SPDX-License-Identifier: BSD-3-Clause
// The stations of the way from mesh to features, and what each of them lets one do.
import { count, figure, plural, probability } from '../data/numbers';
import type { Scene } from '../data/decoded';
import type { Marking } from '../data/marking';
import { STAGES, type Stage, type Store } from '../state';
import { distinctShapes } from '../view/compose';
import { h, swatch } from './dom';
import { icon } from './icons';
import { rows } from './features_panel';
import { markingTools } from './marking_tools';

export const TITLES: Record<Stage, string> = { mesh: 'Mesh', worksets: 'Working sets', candidates: 'Candidates', found: 'Found', marks: 'Marks' };

function summary(scene: Scene, marking: Marking, stage: Stage): string {
  const { result } = scene;
  switch (stage) {
    case 'mesh':
      return plural(result.mesh.faces, 'face');
    case 'worksets':
      return `${plural(result.working_sets, 'set')}, ${plural(scene.setTypes.length, 'type')}`;
    case 'candidates':
      return `${count(Object.values(result.candidates).reduce((sum, { kept }) => sum + kept, 0))} in all`;
    case 'found':
      return `${scene.features.filter(({ feature }) => feature.present).length} of ${scene.features.length}`;
    case 'marks':
      return marking.total === 0 ? 'by hand' : plural(marking.total, 'point');
  }
}

export function stageNavigation(scene: Scene, store: Store, marking: Marking): HTMLElement {
  return h('ol', {}, STAGES.map((stage, i) =>
    h('li', {}, h(
      'button', {
        'data-key': `stage:${stage}`, 'data-stage': stage, 'aria-current': store.state.stage === stage ? 'step' : null,
        'aria-keyshortcuts': String(i + 1), onclick: () => store.set({ stage }),
      },
      h('span', { class: 'number', 'aria-hidden': 'true' }, i + 1),
      h('span', { class: 'name' }, TITLES[stage], h('small', {}, summary(scene, marking, stage))),
    )),
  ));
}

/** A stepper: back, slider, on. */
function stepper(key: string, label: string, value: number, last: number, go: (value: number) => void): HTMLElement {
  const step = (by: number): void => go(Math.min(last, Math.max(1, value + by)));
  return h(
    'div', { class: 'stepper' },
    h('button', { class: 'tool', 'data-key': `${key}:back`, 'aria-label': `Previous ${label}`, disabled: value <= 1, onclick: () => step(-1) }, icon('previous')),
    h('input', {
      type: 'range', min: 1, max: last, value, 'data-key': `${key}:slider`, 'aria-label': label, 'aria-valuetext': `${value} of ${last}`,
      oninput: (event) => go(Number((event.target as HTMLInputElement).value)),
    }),
    h('button', { class: 'tool', 'data-key': `${key}:on`, 'aria-label': `Next ${label}`, disabled: value >= last, onclick: () => step(1) }, icon('next')),
  );
}

function meshTools(scene: Scene): HTMLElement[] {
  const { input } = scene.document.surfaces;
  const analysed = scene.analysed.triangles.length / 3, same = scene.analysed === scene.input;
  const all = input.mesh_triangles;
  return [
    h('p', {}, same
      ? 'The mesh as it was read and repaired; nothing else was done to it before it was analysed.'
      : `The mesh as it is analysed, after the filters: ${count(analysed)} triangles, made of ${count(all)}.`),
    input.shown_triangles < all ? h('p', { class: 'notice' }, `Shown: ${count(input.shown_triangles)} of ${count(all)} triangles. Labels are kept.`) : h('span', {}),
  ];
}

function setTools(scene: Scene, store: Store): HTMLElement[] {
  const { state } = store, sets = scene.document.working_sets;
  const current = state.set === null ? null : sets[state.set];
  const nodes: HTMLElement[] = [
    h('p', {}, 'Connected regions of one kind of curvature, from the bottom up, at every scale: the material that shapes are fitted to. Sets overlap; a place has the colour of the smallest set that holds it.'),
    h('div', { class: 'chips', role: 'group', 'aria-label': 'Types of working sets' }, scene.setTypes.map((type) =>
      h(
        'button', {
          class: 'toggle', 'data-key': `type:${type}`, 'aria-pressed': state.set === null && !state.hiddenTypes.has(type) ? 'true' : 'false',
          onclick: () => {
            const hidden = new Set(state.hiddenTypes);
            if (!hidden.delete(type)) hidden.add(type);
            store.set({ hiddenTypes: hidden, set: null });
          },
        },
        swatch(scene.setColor(type)), type,
      ))),
  ];
  if (sets.length > 0) {
    nodes.push(
      h('h3', {}, 'One at a time'),
      stepper('set', 'working set', (state.set ?? -1) + 1, sets.length, (n) => store.set({ set: n - 1 })),
      current
        ? h('p', { class: 'fact' }, swatch(scene.setColor(current.type)), ` ${current.type}${current.plugin === undefined ? '' : ` of ${current.plugin}`}, ${plural(current.size, 'vertex', 'vertices')}${current.saliency === null ? '' : `, stands out ${figure(100 * current.saliency, 2)} %`}`)
        : h('p', { class: 'hint' }, 'Or click the surface: sets at that place, the smallest first.'),
    );
    if (current) nodes.push(h('button', { class: 'link', 'data-key': 'sets:all', onclick: () => store.set({ set: null }) }, 'Show all sets by type'));
    if (sets.length < scene.result.working_sets)
      nodes.push(h('p', { class: 'hint' }, `${count(sets.length)} of ${count(scene.result.working_sets)} sets are kept in this page: those that a candidate stands on.`));
  }
  return nodes;
}

function shapeLegend(scene: Scene): HTMLElement {
  const counts = new Map<string, { color: string; n: number }>();
  for (const { candidate, color } of distinctShapes(scene)) counts.set(candidate.shape, { color, n: (counts.get(candidate.shape)?.n ?? 0) + 1 });
  return h('ul', { class: 'legend' }, [...counts].map(([shape, { color, n }]) => h('li', {}, swatch(color), `${shape}: ${count(n)}`)));
}

function candidateTools(scene: Scene, store: Store): HTMLElement[] {
  const { state } = store;
  const choose = (name: string | null): void => store.set({ candidateOf: name, rank: 1 });
  const list = state.candidateOf === null ? [] : scene.candidates(state.candidateOf);
  const current = list.find((each) => each.rank === state.rank) ?? list[0];
  const nodes: HTMLElement[] = [
    h('p', {}, 'Constructed features: shapes fitted to the working sets of each feature, within the ranges of the model; one of them, or none, will be the feature.'),
    h(
      'div', { class: 'chips', role: 'group', 'aria-label': 'Candidates of a feature' },
      h('button', { class: 'toggle', 'data-key': 'candidates:all', 'aria-pressed': state.candidateOf === null ? 'true' : 'false', onclick: () => choose(null) }, 'all'),
      scene.features.map(({ name, color }) =>
        h('button', { class: 'toggle', 'data-key': `candidates:${name}`, 'aria-pressed': state.candidateOf === name ? 'true' : 'false', onclick: () => choose(name) }, swatch(color), name),
      ),
    ),
  ];
  if (state.candidateOf === null) return [...nodes, shapeLegend(scene)];
  if (!current) return [...nodes, h('p', { class: 'notice' }, `No shape could be fitted for ${state.candidateOf} within its ranges.`)];
  const position = list.indexOf(current) + 1;
  const kept = scene.result.candidates[state.candidateOf]?.kept ?? list.length;
  nodes.push(
    h('h3', {}, `Candidate ${position} of ${list.length}`, list.length < kept ? h('small', {}, ` (${count(kept)} kept)`) : null),
    stepper('candidate', 'candidate', position, list.length, (n) => store.set({ rank: list[n - 1]!.rank })),
    rows([
      ['shape', current.shape],
      ['probability', probability(current.probability)],
      ['evidence', `${figure(current.evidence, 3)} nats`],
      ['fit error', figure(current.fit_error, 3)],
      ['working sets', current.working_sets.map((i) => scene.document.working_sets[i]).map((set) => (set ? `${set.type} (${count(set.size)})` : '–')).join(', ')],
    ]),
    h('label', { class: 'check' }, h('input', { type: 'checkbox', 'data-key': 'candidates:others', checked: state.allCandidates, onchange: () => store.set({ allCandidates: !state.allCandidates }) }), 'draw the others thin'),
  );
  return nodes;
}

function foundTools(scene: Scene, store: Store): HTMLElement[] {
  const { state } = store, missing = scene.features.filter(({ feature }) => !feature.present);
  if (state.labeling > 0)
    return [
      h('p', { class: 'notice' }, `Alternative ${state.labeling}, not the best labelling.`),
      h('button', { class: 'link', 'data-key': 'found:best', onclick: () => store.set({ labeling: 0 }) }, 'Back to the best'),
    ];
  return [
    h('p', {}, 'The labelling that explains the mesh best: shapes drawn, their surface in the same colour. Click a face, a name or a row.'),
    h('p', { class: 'hint' }, missing.length === 0 ? 'All features of the model are found.' : `Not found: ${missing.map(({ name }) => name).join(', ')}.`),
  ];
}

export function stageDetail(scene: Scene, store: Store, marking: Marking): HTMLElement[] {
  const { stage } = store.state;
  const tools = {
    mesh: () => meshTools(scene),
    worksets: () => setTools(scene, store),
    candidates: () => candidateTools(scene, store),
    found: () => foundTools(scene, store),
    marks: () => markingTools(scene, store, marking),
  };
  return [h('h2', {}, TITLES[stage]), ...tools[stage]()];
}
