// SPDX-License-Identifier: BSD-3-Clause
import { h } from '../ui/dom';
import { icon } from '../ui/icons';

/** Whether a verdict is a good one, as evaluate means it: what is absent and said to be so is right. */
export function kindOf(verdict: string): 'met' | 'broken' | 'untested' {
  if (/^(right|absent|yes|satisfied|optimal|agrees)$/.test(verdict)) return 'met';
  if (/^(wrong|missed|spurious|no|failed)$/.test(verdict)) return 'broken';
  return 'untested';
}

const ICONS = { met: 'check', broken: 'cross', untested: 'dash' } as const;

/** A sign and a word: never colour alone. */
export function verdictChip(verdict: string, text = verdict): HTMLElement {
  const kind = kindOf(verdict);
  return h('span', { class: `verdict-chip ${kind}` }, icon(ICONS[kind], 14), text);
}
