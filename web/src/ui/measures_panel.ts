// SPDX-License-Identifier: BSD-3-Clause
import type { Measurement } from '@schemas/result';
import { figure } from '../data/numbers';
import type { Scene } from '../data/decoded';
import { h } from './dom';

const POWERS: Record<string, string> = { length: '', area: '²', volume: '³' };

function withUnit(text: string, unit: string, lengthUnit: string): string {
  if (unit === 'deg') return `${text}°`;
  const power = POWERS[unit];
  if (power === undefined) return unit ? `${text} ${unit}` : text;
  return lengthUnit ? `${text} ${lengthUnit}${power}` : text;
}

function row(name: string, measure: Measurement, lengthUnit: string): HTMLElement {
  const spread = typeof measure.sd === 'number' && measure.sd > 0 ? ` ± ${figure(measure.sd, 2)}` : '';
  const value = measure.why ?? withUnit(`${figure(measure.value)}${spread}`, measure.unit, lengthUnit);
  return h('div', { class: 'measured', title: measure.expression }, h('dt', {}, name), h('dd', {}, value));
}

/** The measures of the model, where it has some. */
export function measuresPanel(scene: Scene): HTMLElement | null {
  const measures = Object.entries(scene.result.measures ?? {});
  if (measures.length === 0) return null;
  return h(
    'section', { class: 'panel', 'aria-labelledby': 'measures-title' },
    h('h2', { id: 'measures-title' }, 'Measures'),
    h('dl', { class: 'rows' }, measures.map(([name, measure]) => row(name, measure, scene.document.unit))),
    h('p', { class: 'note' }, 'Each with its standard deviation, from those of the fits.'),
  );
}
