// SPDX-License-Identifier: BSD-3-Clause
import type { Verdict } from '@schemas/index';
import { h } from '../ui/dom';
import { icon } from '../ui/icons';

/** Whether a verdict is a good one, as evaluate means it: what is absent and said to be so is right. */
export const KINDS: Record<Verdict, 'met' | 'broken'> = { right: 'met', absent: 'met', wrong: 'broken', missed: 'broken', spurious: 'broken' };

const ICONS = { met: 'check', broken: 'cross' } as const;

/** A sign and a word: never colour alone. */
export function verdictChip(verdict: Verdict, text: string = verdict): HTMLElement {
  const kind = KINDS[verdict];
  return h('span', { class: `verdict-chip ${kind}` }, icon(ICONS[kind], 14), text);
}
