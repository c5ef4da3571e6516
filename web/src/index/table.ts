// SPDX-License-Identifier: BSD-3-Clause
import type { Cell, Kind, Table, Verdict } from '@schemas/index';
import { count, figure, milliseconds, plural } from '../data/numbers';
import { h } from '../ui/dom';
import { verdictChip } from './verdicts';

export function cellText(value: Cell, kind: Kind): string {
  if (value === null) return '–';
  if (typeof value === 'string') return value;
  if (kind === 'percent') return `${figure(100 * value, 3)} %`;
  if (kind === 'ms') return milliseconds(value);
  return Number.isInteger(value) && value >= 1000 ? count(value) : figure(value);
}

/** Numbers by value, texts as people order them (10 after 9), nothing last. */
export function compareCells(a: Cell, b: Cell): number {
  if (a === null || b === null) return a === b ? 0 : a === null ? 1 : -1;
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return String(a).localeCompare(String(b), 'en', { numeric: true });
}

/** Row numbers that hold all words of the filter, in the order of a column. */
export function chosenRows(table: Table, filter: string, column: number | null, descending: boolean): number[] {
  const words = filter.toLowerCase().split(/\s+/).filter(Boolean);
  const texts = table.rows.map((row) => row.map((cell, i) => cellText(cell, table.columns[i]!.kind)).join(' ').toLowerCase());
  const rows = table.rows.map((_row, i) => i).filter((i) => words.every((word) => texts[i]!.includes(word)));
  if (column === null) return rows;
  return rows.sort((a, b) => {
    const x = table.rows[a]![column] ?? null, y = table.rows[b]![column] ?? null;
    // What is empty stays last either way.
    if (x === null || y === null) return compareCells(x, y) || a - b;
    return (descending ? -1 : 1) * compareCells(x, y) || a - b;
  });
}

const SHOWN = 300;
/** Letters beyond which a text is broken into lines. */
const LONG = 34;

export function tableSection(table: Table): HTMLElement {
  let sorted: number | null = null, descending = false, limit = SHOWN;
  const body = h('tbody', {}), amount = h('small', { role: 'status' });
  const filter = h('input', { type: 'search', placeholder: 'filter rows', 'aria-label': `Filter rows of ${table.title}`, oninput: () => fill() });
  const more = h('button', { class: 'plain', onclick: () => { limit = Infinity; fill(); } }, 'Show all rows');
  const heads = table.columns.map((column, i) =>
    h('th', { scope: 'col', class: column.kind === 'text' || column.kind === 'verdict' ? '' : 'numeric' },
      h('button', { onclick: () => sort(i) }, column.name, column.unit && column.kind !== 'ms' ? h('small', {}, ` ${column.unit}`) : null, h('span', { class: 'order', 'aria-hidden': 'true' }))));
  const sort = (column: number): void => {
    descending = sorted === column ? !descending : false;
    sorted = column;
    heads.forEach((head, i) => (i === column ? head.setAttribute('aria-sort', descending ? 'descending' : 'ascending') : head.removeAttribute('aria-sort')));
    fill();
  };
  const cell = (value: Cell, i: number, row: number): HTMLElement => {
    const { kind } = table.columns[i]!, text = cellText(value, kind), link = table.links?.[row];
    const content = kind === 'verdict' && typeof value === 'string' ? verdictChip(value as Verdict) : i === 0 && link ? h('a', { href: link }, text) : text;
    return h(i === 0 ? 'th' : 'td', { scope: i === 0 ? 'row' : null, class: kind === 'text' ? (text.length > LONG ? 'long' : '') : kind === 'verdict' ? '' : 'numeric' }, content);
  };
  const fill = (): void => {
    const rows = chosenRows(table, filter.value, sorted, descending);
    body.replaceChildren(...rows.slice(0, limit).map((r) => h('tr', {}, table.rows[r]!.map((value, i) => cell(value, i, r)))));
    amount.textContent = rows.length === table.rows.length ? plural(rows.length, 'row') : `${rows.length} of ${plural(table.rows.length, 'row')}`;
    more.hidden = rows.length <= limit;
  };
  fill();
  const id = `table-${table.id}`;
  return h(
    'section', { class: 'panel wide', 'aria-labelledby': id },
    h('div', { class: 'bar-of-title' }, h('h2', { id }, table.title, amount), h('div', { class: 'controls' }, table.rows.length > 5 && filter)),
    h('div', { class: 'scroller', tabindex: 0, role: 'region', 'aria-label': `${table.title}, table` }, h('table', {}, h('thead', {}, h('tr', {}, heads)), body)),
    more,
  );
}
