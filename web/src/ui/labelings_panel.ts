// SPDX-License-Identifier: BSD-3-Clause
import type { Alternative } from '@schemas/result';
import { figure } from '../data/numbers';
import type { Scene } from '../data/decoded';
import type { Store } from '../state';
import { probabilityBar } from './bars';
import { h } from './dom';

/** In which features an alternative differs from the best labelling. */
export function differences(scene: Scene, alternative: Alternative): string {
  const texts = scene.features.flatMap((named) => {
    const rank = alternative.candidates?.[named.name];
    if (rank === undefined) return [];
    const best = named.feature.present ? (named.candidate?.rank ?? null) : 0;
    if (rank === best) return [];
    return [rank === 0 ? `${named.name} missing` : `${named.name}: candidate ${rank}`];
  });
  return texts.length > 0 ? texts.join(', ') : 'the same candidates';
}

export function labelingsPanel(scene: Scene, store: Store): HTMLElement | null {
  const { alternatives, guarantee, optimal, probabilities, log_evidence } = scene.result;
  const rest = alternatives.reduce((sum, each) => sum + (each.probability ?? 0), 0);
  const row = (index: number, title: string, text: string, side: Node | null): HTMLElement =>
    h(
      'li', { class: `item${store.state.labeling === index ? ' selected' : ''}` },
      h(
        'button', {
          class: 'row', 'aria-pressed': store.state.labeling === index ? 'true' : 'false', 'data-key': `labeling:${index}`,
          onclick: () => store.set({ labeling: index, stage: 'found', feature: null, relation: null, face: null }),
        },
        h('span', { class: 'name' }, title, h('small', {}, text)), side,
      ),
    );
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'labelings-title' },
    h('h2', { id: 'labelings-title' }, 'Labellings', h('small', {}, alternatives.length > 0 ? `${alternatives.length} next best` : 'no alternatives')),
    h(
      'ul', { class: 'list compact' },
      row(0, 'Best', optimal ? guarantee : `${guarantee}; not proven best`, null),
      alternatives.map((each, i) =>
        row(i + 1, `Alternative ${i + 1}`, differences(scene, each),
            each.probability === null ? h('small', {}, `cost ${figure(each.cost)}`) : probabilityBar(each.probability)),
      ),
    ),
    h('p', { class: 'note' }, [
      probabilities ? `Probabilities: ${probabilities}.` : 'This labeler makes no probabilities.',
      alternatives.length > 0 && rest > 0 ? ` The alternatives share ${figure(100 * rest, 2)} %.` : '',
      log_evidence === null ? '' : ` Log evidence ${figure(log_evidence)}.`,
    ].join('')),
  );
}
