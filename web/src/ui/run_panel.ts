// SPDX-License-Identifier: BSD-3-Clause
import { count, figure, milliseconds, plural, probability } from '../data/numbers';
import type { Scene } from '../data/decoded';
import { h } from './dom';
import { rows } from './features_panel';

function meshPanel(scene: Scene): HTMLElement {
  const { mesh, class: found, class_probabilities = {} } = scene.result;
  const repairs = Object.entries(mesh.repair).filter(([, n]) => n > 0);
  const classes = Object.entries(class_probabilities).filter(([, p]) => p !== null).sort((a, b) => b[1]! - a[1]!);
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'mesh-title' },
    h('h2', { id: 'mesh-title' }, 'Mesh'),
    rows([
      ['file', mesh.path.split('/').pop() ?? mesh.path],
      ...(found ? [['class', `${found} (${probability(class_probabilities[found])})`] as [string, string]] : []),
      ...(found && classes.length > 1 ? [['or', classes.slice(1).map(([name, p]) => `${name} ${probability(p)}`).join(', ')] as [string, string]] : []),
      ['size', `${count(mesh.vertices)} vertices, ${count(mesh.faces)} faces`],
      ['box', `${figure(mesh.box.a)} × ${figure(mesh.box.b)} × ${figure(mesh.box.c)}`],
      ['mean edge', figure(mesh.mean_edge, 3)],
      ['topology', `${plural(mesh.components, 'component')}, ${mesh.closed_components} closed, ${plural(mesh.holes, 'hole')}, genus ${mesh.genus}`],
      ['repaired', repairs.length === 0 ? 'nothing' : repairs.map(([name, n]) => `${count(n)} ${name.replace(/_/g, ' ')}`).join(', ')],
    ]),
  );
}

function timingsPanel(scene: Scene): HTMLElement {
  const timings = Object.entries(scene.result.timings_ms);
  const total = timings.reduce((sum, [, ms]) => sum + ms, 0);
  const longest = Math.max(1e-9, ...timings.map(([, ms]) => ms));
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'time-title' },
    h('h2', { id: 'time-title' }, 'Time', h('small', {}, milliseconds(total))),
    h('dl', { class: 'timings' }, timings.map(([station, ms]) => {
      const bar = h('i', { 'aria-hidden': 'true' });
      bar.style.width = `${(100 * ms) / longest}%`;
      return h('div', {}, h('dt', {}, station), h('dd', {}, h('span', { class: 'track' }, bar), h('span', {}, milliseconds(ms))));
    })),
  );
}

function pluginsPanel(scene: Scene): HTMLElement {
  const { plugins } = scene.result;
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'plugins-title' },
    h('h2', { id: 'plugins-title' }, 'Plugins', h('small', {}, plural(plugins.length, 'plugin'))),
    h('div', { class: 'plugins' }, plugins.map(({ kind, id, version, options }) =>
      h(
        'details', { 'data-key': `plugin:${kind}/${id}` },
        h('summary', {}, h('span', { class: 'kind' }, kind), h('b', {}, id), h('small', {}, version)),
        Object.keys(options).length === 0 ? h('p', { class: 'note' }, 'no options') : rows(Object.entries(options).map(([name, value]) => [name, value])),
      ),
    )),
  );
}

export function runPanels(scene: Scene): HTMLElement[] {
  return [meshPanel(scene), timingsPanel(scene), pluginsPanel(scene), h('p', { class: 'program' }, scene.document.program)];
}
