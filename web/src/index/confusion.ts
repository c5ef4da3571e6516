// SPDX-License-Identifier: BSD-3-Clause
import type { Confusion } from '@schemas/index';
import { h, svg } from '../ui/dom';

/** Of names set aslant, by the letter. */
const CELL = 40, LEFT = 90, ASLANT = 5;

/** Truth by row, answer by column; shares of the row as tints, counts as figures. */
export function confusionFigure({ classes, answers, counts }: Confusion): HTMLElement {
  const columns = answers.length;
  const reach = ASLANT * Math.max(...answers.map((name) => name.length)), TOP = 26 + reach;
  const width = LEFT + CELL * columns + Math.max(12, reach - 10), height = TOP + CELL * counts.length + 12;
  const right = counts.reduce((sum, row, i) => sum + (row[i] ?? 0), 0), all = counts.flat().reduce((sum, n) => sum + n, 0);
  const chart = svg(
    'svg', { viewBox: `0 0 ${width} ${height}`, class: 'chart', style: `max-width:${width * 1.25}px`, role: 'img', 'aria-label': `Confusion matrix: ${right} of ${all} on the diagonal. ${counts.map((row, i) => `${classes[i]}: ${row.map((n, k) => (n > 0 ? `${n} as ${answers[k]}` : '')).filter(Boolean).join(', ') || 'none'}`).join('; ')}` },
    svg('text', { x: LEFT - 8, y: TOP - 10, 'text-anchor': 'end', class: 'title' }, 'truth'),
    answers.map((name, k) => svg('text', { transform: `translate(${LEFT + CELL * (k + 0.5) + 4} ${TOP - 8}) rotate(-48)` }, name)),
    counts.map((row, i) => {
      const sum = row.reduce((total, n) => total + n, 0) || 1;
      return [
        svg('text', { x: LEFT - 8, y: TOP + CELL * (i + 0.5) + 4, 'text-anchor': 'end' }, classes[i]!),
        row.map((n, k) => {
          const part = n / sum;
          return svg('g', { class: `cell ${i === k ? 'diagonal' : ''} ${part > 0.55 ? 'strong' : ''}` },
            svg('rect', { x: LEFT + CELL * k + 1, y: TOP + CELL * i + 1, width: CELL - 2, height: CELL - 2, rx: 4, class: 'empty' }),
            svg('rect', { x: LEFT + CELL * k + 1, y: TOP + CELL * i + 1, width: CELL - 2, height: CELL - 2, rx: 4, class: 'tint', 'fill-opacity': n === 0 ? 0 : 0.12 + 0.88 * part }),
            svg('text', { x: LEFT + CELL * (k + 0.5), y: TOP + CELL * (i + 0.5) + 4.5, 'text-anchor': 'middle', class: n === 0 ? 'zero' : '' }, n),
            svg('title', {}, `${classes[i]} answered as ${answers[k]}: ${n}`));
        }),
      ];
    }),
  );
  return h('figure', {}, chart, h('figcaption', {}, h('b', {}, 'Classes'), `${right} of ${all} right; rows are the truth, columns the answer`));
}
