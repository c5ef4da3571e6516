// SPDX-License-Identifier: BSD-3-Clause
import type { FoundFeature, MissingFeature, Parameters } from '@schemas/result';
import { nearestCandidate } from '../view/compose';
import { figure, plural, probability, vector } from '../data/numbers';
import type { NamedFeature, Scene } from '../data/decoded';
import type { Store } from '../state';
import { probabilityBar, residualText } from './bars';
import { h, swatch } from './dom';

/** Turns the view to a feature. */
type TurnTo = (name: string) => void;

const words = (name: string): string => name.replace(/_/g, ' ');

/** Lengths and areas bear the mesh's unit; angles, shares and counts do not. */
function unitOfMeasure(name: string, unit: string): string {
  if (/_deg$/.test(name)) return '°';
  if (!unit || /coverage|count|ratio/.test(name)) return '';
  return name === 'area' ? ` ${unit}²` : ` ${unit}`;
}

function parameterRows(parameters: Parameters): [string, string][] {
  return Object.entries(parameters).map(([name, value]) => {
    if (typeof value === 'number') return [name, figure(value)];
    if (typeof value === 'boolean') return [name, value ? 'yes' : 'no'];
    return [name, Array.isArray(value[0]) ? (value as number[][]).map(vector).join(' ') : vector(value as number[])];
  });
}

export function rows(entries: [string, string | Node][]): HTMLElement {
  return h('dl', { class: 'rows' }, entries.map(([name, value]) => h('div', {}, h('dt', {}, name), h('dd', {}, value))));
}

function measureRows(feature: FoundFeature, unit: string): [string, string][] {
  return Object.entries(feature.measures).map(([name, value]) => {
    const sd = feature.uncertainty[name];
    const spread = typeof sd === 'number' && sd > 0 ? ` ± ${figure(sd, 2)}` : '';
    return [words(name), `${figure(value)}${spread}${unitOfMeasure(name, unit)}`];
  });
}

function foundDetail(scene: Scene, store: Store, { name }: NamedFeature, feature: FoundFeature, turnTo: TurnTo): HTMLElement {
  const unit = scene.document.unit;
  const direction = feature.uncertainty['direction_deg'];
  return h(
    'div', { class: 'detail' },
    rows([
      ...measureRows(feature, unit),
      ...parameterRows(feature.parameters).filter(([key]) => !(key in feature.measures)),
      ...(typeof direction === 'number' ? [['direction within', `${figure(direction, 2)}°`] as [string, string]] : []),
      ['fit error', figure(feature.fit_error, 3) + (unit ? ` ${unit}` : '')],
      ['evidence', `${figure(feature.evidence, 3)} nats over missing`],
      ['surface', plural(feature.faces.length, 'face')],
    ]),
    h('div', { class: 'buttons' }, h('button', { class: 'link', 'data-key': `turn:${name}`, onclick: () => turnTo(name) }, 'Turn to it (F)'), candidatesButton(scene, store, name)),
  );
}

function missingDetail(scene: Scene, store: Store, named: NamedFeature, feature: MissingFeature): HTMLElement {
  const { why } = feature, unit = scene.document.unit;
  const nearest = nearestCandidate(scene, named);
  const against = [...(why.conflict?.relations ?? []).map((each) => `breaks ${each}`), ...(why.conflict?.exclusions ?? []).map((each) => `shares its place with ${each}`)];
  return h(
    'div', { class: 'detail' },
    why.nearest_candidate && h('p', {}, `The nearest candidate${nearest ? ` (number ${nearest.rank}, drawn thin)` : ''} is not taken:`),
    why.relations_failed?.length
      ? h('ul', { class: 'failed' }, why.relations_failed.map((each) => h('li', {}, h('b', {}, `${each.name} ${each.type}`), ` ${each.residual === undefined ? (each.why ?? '') : residualText(each, unit)}`)))
      : null,
    against.length > 0 && h('p', {}, `${why.conflict?.smallest ? 'Proven: every' : 'Every'} candidate ${against.join(' or ')}.`),
    candidatesButton(scene, store, named.name),
  );
}

function candidatesButton(scene: Scene, store: Store, name: string): HTMLElement | null {
  const n = scene.candidates(name).length;
  return n === 0 ? null : h(
    'button', { class: 'link', 'data-key': `candidates:${name}`, onclick: () => store.set({ stage: 'candidates', candidateOf: name, rank: 1 }) },
    `Look at its ${plural(n, 'candidate')}`,
  );
}

function shortMeasure(feature: FoundFeature): string {
  const [name, value] = Object.entries(feature.measures).find(([key]) => key === 'radius' || key === 'length' || key === 'extent') ?? Object.entries(feature.measures)[0] ?? [];
  return name ? `${feature.shape} · ${words(name)} ${figure(value)}` : feature.shape;
}

function item(scene: Scene, store: Store, named: NamedFeature, turnTo: TurnTo): HTMLElement {
  const { name, color, feature } = named, { state } = store;
  const selected = state.feature === name;
  const inRelation = state.relation !== null && scene.result.relations.some((each) => each.name === state.relation && each.features.includes(name));
  const button = h(
    'button', { class: 'row', 'aria-pressed': selected ? 'true' : 'false', 'data-key': `feature:${name}`, onclick: () => store.toggleFeature(name) },
    swatch(color),
    h('span', { class: 'name' }, name, h('small', {}, feature.present ? shortMeasure(feature) : feature.why.reason)),
    feature.present
      ? probabilityBar(feature.probability, color)
      : h('span', { class: 'absent' }, 'missing', h('small', {}, feature.probability_missing === null ? '' : `probability ${probability(feature.probability_missing)}`)),
  );
  const detail = selected ? (feature.present ? foundDetail(scene, store, named, feature, turnTo) : missingDetail(scene, store, named, feature)) : null;
  return h('li', { class: `item${selected ? ' selected' : ''}${inRelation ? ' related' : ''}${feature.present ? '' : ' missing'}` }, button, detail);
}

export function featuresPanel(scene: Scene, store: Store, turnTo: TurnTo): HTMLElement {
  const found = scene.features.filter(({ feature }) => feature.present).length;
  const { probability_exactness: exactness, probability_error: error } = scene.result;
  const kind = exactness === 'none' ? 'no probabilities' : exactness === 'bound' ? `probabilities off by at most ${error}` : `probabilities ${exactness}`;
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'features-title' },
    h('h2', { id: 'features-title' }, 'Features', h('small', {}, `${found} of ${scene.features.length} found, ${kind}`)),
    h('ul', { class: 'list' }, scene.features.map((feature) => item(scene, store, feature, turnTo))),
    h('p', { class: 'note' }, `Lengths in the mesh's own unit${scene.document.unit ? ` (${scene.document.unit})` : ''}; ± is one standard deviation.`),
  );
}
