// SPDX-License-Identifier: BSD-3-Clause
import type { MeshCard } from '@schemas/index';
import { plural, probability } from '../data/numbers';
import { h } from '../ui/dom';
import { KINDS, verdictChip } from './verdicts';

function card(mesh: MeshCard): HTMLElement {
  const verdicts = Object.entries(mesh.verdicts);
  const picture = mesh.thumbnail
    ? h('img', { src: mesh.thumbnail, alt: '', loading: 'lazy' })
    : h('span', { class: 'no-picture' }, 'no picture');
  const name = mesh.report ? h('a', { href: mesh.report }, mesh.name) : h('span', {}, mesh.name);
  return h(
    'li', { class: 'card' },
    h('div', { class: 'thumbnail' }, picture),
    h('div', { class: 'about' }, h('h3', {}, name), mesh.dataset && h('small', {}, mesh.dataset), mesh.probability !== null && mesh.probability !== undefined ? h('small', {}, `probability ${probability(mesh.probability)}`) : null,
      h('div', { class: 'verdicts' }, verdicts.map(([feature, verdict]) => h('span', { title: `${feature}: ${verdict}` }, verdictChip(verdict, `${feature}${KINDS[verdict] === 'met' ? '' : ` ${verdict}`}`))))),
  );
}

const SHOWN = 60;

/** Cards of the meshes, those with faults first on demand. */
export function gallery(meshes: MeshCard[]): HTMLElement {
  const list = h('ul', { class: 'gallery' });
  const faults = (mesh: MeshCard): number => Object.values(mesh.verdicts).filter((verdict) => KINDS[verdict] === 'broken').length;
  const amount = h('small', { role: 'status' });
  const filter = h('input', { type: 'search', placeholder: 'filter by name', 'aria-label': 'Filter meshes by name', oninput: () => fill() });
  const only = h('input', { type: 'checkbox', onchange: () => fill() });
  let limit = SHOWN;
  const more = h('button', { class: 'plain', onclick: () => { limit += 4 * SHOWN; fill(); } }, 'Show more');
  const fill = (): void => {
    const wanted = filter.value.trim().toLowerCase();
    const chosen = meshes.filter((mesh) => `${mesh.name} ${mesh.dataset ?? ''}`.toLowerCase().includes(wanted) && (!only.checked || faults(mesh) > 0));
    list.replaceChildren(...chosen.slice(0, limit).map(card));
    amount.textContent = chosen.length === meshes.length ? plural(meshes.length, 'mesh', 'meshes') : `${chosen.length} of ${plural(meshes.length, 'mesh', 'meshes')}`;
    more.hidden = chosen.length <= limit;
  };
  fill();
  return h(
    'section', { class: 'panel wide', 'aria-labelledby': 'meshes-title' },
    h('div', { class: 'bar-of-title' }, h('h2', { id: 'meshes-title' }, 'Meshes', amount),
      h('div', { class: 'controls' }, meshes.some((mesh) => faults(mesh) > 0) && h('label', { class: 'check' }, only, 'only with faults'), meshes.length > 6 && filter)),
    list, more,
  );
}
