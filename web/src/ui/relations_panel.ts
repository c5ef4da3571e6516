// SPDX-License-Identifier: BSD-3-Clause
import type { Relation } from '@schemas/result';
import { probability } from '../data/numbers';
import type { Scene } from '../data/decoded';
import type { Store } from '../state';
import { residualBar, residualText } from './bars';
import { h, swatch } from './dom';
import { icon } from './icons';

function state(relation: Relation): { icon: 'check' | 'cross' | 'dash'; text: string; kind: string } {
  if (!relation.tested || relation.residual === undefined) return { icon: 'dash', text: relation.why || 'not tested', kind: 'untested' };
  return relation.satisfied ? { icon: 'check', text: 'satisfied', kind: 'met' } : { icon: 'cross', text: 'not met', kind: 'broken' };
}

function row(scene: Scene, store: Store, relation: Relation): HTMLElement {
  const selected = store.state.relation === relation.name;
  const related = store.state.feature !== null && relation.features.includes(store.state.feature);
  const { icon: mark, text, kind } = state(relation);
  const tested = kind !== 'untested';
  return h(
    'li', { class: `item relation ${kind}${selected ? ' selected' : ''}${related ? ' related' : ''}` },
    h(
      'button', {
        class: 'row', 'aria-pressed': selected ? 'true' : 'false', 'data-key': `relation:${relation.name}`,
        title: relation.probability === null || relation.probability === undefined ? '' : `holds with probability ${probability(relation.probability)}`,
        onclick: () => store.set({ relation: selected ? null : relation.name, feature: null, face: null }),
      },
      h('span', { class: `verdict ${kind}` }, icon(mark, 16), h('span', { class: 'unseen' }, text)),
      h(
        'span', { class: 'name' }, h('span', {}, relation.type, ' ', h('code', {}, relation.name)),
        h('small', {}, relation.features.map((name, i) => [i > 0 ? ' ' : '', h('span', { class: 'chip' }, swatch(scene.feature(name)?.color ?? '#888888'), name)])),
      ),
      tested
        ? h('span', { class: 'measure' }, residualBar(relation), h('small', {}, residualText(relation, scene.document.unit)))
        : h('span', { class: 'measure' }, h('small', {}, text)),
    ),
  );
}

export function relationsPanel(scene: Scene, store: Store): HTMLElement | null {
  const { relations } = scene.result;
  if (relations.length === 0) return null;
  const tested = relations.filter((each) => state(each).kind !== 'untested');
  const met = tested.filter((each) => each.satisfied).length;
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'relations-title' },
    h('h2', { id: 'relations-title' }, 'Relations', h('small', {}, `${met} of ${tested.length} tested hold`)),
    h('ul', { class: 'list' }, relations.map((relation) => row(scene, store, relation))),
    h('p', { class: 'note' }, 'Bars: residual; the stroke is the tolerance.'),
  );
}
