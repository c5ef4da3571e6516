// SPDX-License-Identifier: BSD-3-Clause
import type { Relation } from '@schemas/result';
import { figure, probability } from '../data/numbers';
import { h } from './dom';

/** A probability as a bar with its figure. */
export function probabilityBar(value: number | null | undefined, color?: string): HTMLElement {
  const bar = h('span', { class: 'bar', 'aria-hidden': 'true' }, h('i', {}));
  (bar.firstChild as HTMLElement).style.width = `${100 * Math.max(0, Math.min(1, value ?? 0))}%`;
  if (color) bar.style.setProperty('--color', color);
  return h('span', { class: 'probability' }, bar, h('span', { class: 'figure' }, probability(value)));
}

/** Longest bar, in tolerances. */
const FULL = 1.5;

/** Residual as a bar on which the tolerance is a stroke. */
export function residualBar(relation: Relation): HTMLElement {
  const { residual, tolerance } = relation;
  const bar = h('span', { class: 'residual', 'aria-hidden': 'true' });
  if (residual === null || residual === undefined || tolerance === null || tolerance === undefined) return bar;
  const part = tolerance > 0 ? Math.abs(residual) / tolerance : residual === 0 ? 0 : FULL;
  const fill = h('i', { class: relation.satisfied ? '' : 'over' });
  fill.style.width = `${(100 * Math.min(FULL, part)) / FULL}%`;
  const tick = h('b', {});
  tick.style.left = `${100 / FULL}%`;
  bar.append(fill, tick);
  return bar;
}

export function unitOf(relation: Relation, lengthUnit: string): string {
  return relation.unit === 'deg' ? '°' : lengthUnit ? ` ${lengthUnit}` : '';
}

export function residualText(relation: Relation, lengthUnit: string): string {
  const unit = unitOf(relation, lengthUnit);
  return `${figure(relation.residual, 3)}${unit} of ${figure(relation.tolerance, 3)}${unit}`;
}
