// SPDX-License-Identifier: BSD-3-Clause
import type { Family } from '@schemas/result';
import { figure } from '../data/numbers';
import type { Scene } from '../data/decoded';
import { h } from './dom';

function row(name: string, family: Family): HTMLElement {
  const sure = typeof family.probability === 'number' ? `, probability ${figure(family.probability)}` : '';
  const more = family.more_than_allowed;
  const beyond = more ? `; there would be ${more.likely_number} if the model allowed any number` : '';
  return h('div', { class: 'measured', title: `the model allows: ${family.allowed}` }, h('dt', {}, name), h('dd', {}, `${family.found} found${sure}${beyond}`));
}

/** How many instances of each family there are, where the model has any. */
export function familiesPanel(scene: Scene): HTMLElement | null {
  const families = Object.entries(scene.result.families ?? {});
  if (families.length === 0) return null;
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'families-title' },
    h('h2', { id: 'families-title' }, 'Families'),
    h('dl', { class: 'rows' }, families.map(([name, family]) => row(name, family))),
    h('p', { class: 'note' }, 'Features in any number: how many were found, and how probable that number is.'),
  );
}
