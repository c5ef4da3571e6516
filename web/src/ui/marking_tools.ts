// SPDX-License-Identifier: BSD-3-Clause
import { plural } from '../data/numbers';
import type { Scene } from '../data/decoded';
import type { Marking } from '../data/marking';
import type { Store } from '../state';
import { announce, download, h, swatch } from './dom';
import { icon } from './icons';

/** Of the mesh: what evaluate looks for beside it. */
export function truthName(scene: Scene): string {
  const file = scene.result.mesh.path.split('/').pop() ?? 'mesh';
  return `${file.replace(/\.[^.]*$/, '')}.truth.json`;
}

/** The class that a truth file names: of a model with classes one of them, else the model itself. */
export function className(scene: Scene): string {
  return scene.result.class ?? scene.document.model?.name ?? scene.result.model.split('/').pop() ?? '';
}

function featureRow(scene: Scene, store: Store, marking: Marking, name: string, color: string): HTMLElement {
  const selected = store.state.markOf === name, marks = marking.marks.get(name);
  const n = marking.count(name);
  return h(
    'li', { class: `item${selected ? ' selected' : ''}` },
    h(
      'button', { class: 'row', 'aria-pressed': selected ? 'true' : 'false', 'data-key': `mark:${name}`, onclick: () => store.set({ markOf: selected ? null : name, group: 0 }) },
      swatch(color), h('span', { class: 'name' }, name), h('small', {}, marks?.absent ? 'not on the mesh' : n === 0 ? 'no marks' : plural(n, 'mark')),
    ),
    selected && selectedTools(scene, store, marking, name),
  );
}

function selectedTools(scene: Scene, store: Store, marking: Marking, name: string): HTMLElement {
  const marks = marking.marks.get(name), groups = Math.max(scene.groups(name), marks?.groups.length ?? 1);
  const { group } = store.state;
  return h(
    'div', { class: 'detail' },
    groups > 1 && h('div', { class: 'chips', role: 'group', 'aria-label': `Groups of marks of ${name}` }, Array.from({ length: groups }, (_unused, i) =>
      h('button', { class: 'toggle', 'data-key': `group:${i}`, 'aria-pressed': group === i ? 'true' : 'false', onclick: () => store.set({ group: i }) }, `end ${i + 1} · ${marks?.groups[i]?.length ?? 0}`))),
    h(
      'div', { class: 'buttons' },
      h('button', { class: 'plain', 'data-key': 'mark:last', disabled: (marks?.groups[group]?.length ?? 0) === 0, onclick: () => marking.removeLast(name, group) }, 'Delete last'),
      h('button', { class: 'plain', 'data-key': 'mark:clear', disabled: marking.count(name) === 0, onclick: () => marking.clear(name) }, 'Delete all'),
    ),
    h('label', { class: 'check' }, h('input', { type: 'checkbox', 'data-key': 'mark:absent', checked: marks?.absent ?? false, onchange: (event) => marking.setAbsent(name, (event.target as HTMLInputElement).checked) }), 'the object does not have it'),
  );
}

function classChoice(scene: Scene, marking: Marking): HTMLElement {
  const classes = Object.keys(scene.document.model?.classes ?? {});
  if (classes.length === 0) return h('span', {});
  const choice = h('select', { 'data-key': 'mark:class', onchange: () => (marking.className = choice.value) },
    [...new Set([...classes, marking.className])].map((name) => h('option', { value: name, selected: name === marking.className }, name)));
  return h('label', { class: 'field' }, 'class of the object ', choice);
}

export function markingTools(scene: Scene, store: Store, marking: Marking): HTMLElement[] {
  const file = h('input', { type: 'file', accept: '.json,application/json', class: 'unseen', tabindex: -1, 'aria-label': 'Load a truth file' });
  const error = h('p', { class: 'notice error', role: 'alert', hidden: true });
  file.addEventListener('change', async () => {
    const chosen = file.files?.[0];
    if (!chosen) return;
    try {
      marking.load(await chosen.text());
      announce(`${chosen.name} loaded: ${plural(marking.total, 'mark')}`);
    } catch (problem) {
      error.hidden = false;
      error.textContent = `${chosen.name}: ${(problem as Error).message}`;
    }
  });
  const save = (): void => {
    download(truthName(scene), marking.text());
    announce(`${truthName(scene)} saved`);
  };
  return [
    h('p', {}, 'Where a person sees the features: what ', h('code', {}, 'toposcope evaluate'), ' judges by. Choose a feature, then click vertices; a click on a mark takes it away.'),
    classChoice(scene, marking),
    h('ul', { class: 'list compact' }, scene.features.map(({ name, color }) => featureRow(scene, store, marking, name, color))),
    h(
      'div', { class: 'buttons' },
      h('button', { class: 'plain', 'data-key': 'marks:undo', disabled: !marking.canUndo, onclick: () => marking.undo() }, icon('undo', 16), 'Undo'),
      h('button', { class: 'plain', 'data-key': 'marks:load', onclick: () => file.click() }, icon('upload', 16), 'Load'),
      h('button', { class: 'plain strong', 'data-key': 'marks:save', onclick: save }, icon('download', 16), 'Save'),
      file,
    ),
    error,
    h('p', { class: 'hint' }, 'With the keyboard: move the view until the cross in its middle lies on the vertex, then Enter.'),
  ];
}
