// SPDX-License-Identifier: BSD-3-Clause
import { h } from './dom';
import { dial, icon, type Icon } from './icons';
import { toggleTheme } from './theme';

export function tool(name: Icon, label: string, key: string, run: () => void, pressed?: boolean): HTMLButtonElement {
  return h(
    'button', {
      class: 'tool', title: key ? `${label} (${key})` : label, 'aria-label': label, 'data-key': `tool:${name}`,
      'aria-pressed': pressed === undefined ? null : pressed ? 'true' : 'false', 'aria-keyshortcuts': key || null, onclick: run,
    },
    icon(name),
  );
}

export function pageHeader(title: string, state: Node | null, ...tools: HTMLElement[]): HTMLElement {
  return h(
    'header', {},
    h('span', { class: 'mark' }, dial(), h('span', { class: 'word' }, 'Toposcope')),
    h('h1', {}, title),
    state,
    h('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Page' }, tools, tool('theme', 'Light or dark', 'T', toggleTheme)),
  );
}
