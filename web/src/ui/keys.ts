// SPDX-License-Identifier: BSD-3-Clause
import { h } from './dom';

export interface Key {
  /** As `KeyboardEvent.key`, several by spaces. */
  keys: string;
  shown: string;
  text: string;
  /** Only while the view has the focus. */
  view?: boolean;
  run: (event: KeyboardEvent) => void;
}

const typing = (target: EventTarget | null): boolean =>
  target instanceof HTMLElement && (target.isContentEditable || /^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName));

/** Keys without Ctrl, Alt or Meta; those belong to the browser. */
export function listenToKeys(keys: Key[], view: HTMLElement): void {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented) return;
    const inside = document.activeElement === view;
    if (typing(event.target) || document.querySelector('dialog[open]')) return;
    const key = keys.find((each) => each.keys.split(' ').includes(event.key) && (!each.view || inside));
    if (!key) return;
    event.preventDefault();
    key.run(event);
  });
}

export function helpDialog(keys: Key[]): HTMLDialogElement {
  const dialog = h(
    'dialog', { 'aria-labelledby': 'help-title' },
    h('h2', { id: 'help-title' }, 'Mouse, touch and keys'),
    h('dl', { class: 'keys' }, [
      ['drag', 'turn; with the right button or two fingers: move'],
      ['wheel, pinch', 'nearer and farther'],
      ['click', 'select; on the stages “Working sets” and “Constructed features” again for the next at that place'],
      ...keys.filter((key) => key.shown).map((key) => [key.shown, key.text + (key.view ? ' (while the view has the focus)' : '')]),
    ].map(([name, text]) => h('div', {}, h('dt', {}, name!), h('dd', {}, text!)))),
    h('form', { method: 'dialog' }, h('button', { class: 'plain strong' }, 'Close')),
  );
  document.body.append(dialog);
  return dialog;
}
