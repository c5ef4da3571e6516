// SPDX-License-Identifier: BSD-3-Clause
import type { ReliabilityCurve } from '@schemas/index';
import { figure, plural } from '../data/numbers';
import { h, svg } from '../ui/dom';

const SIZE = 220, LEFT = 40, TOP = 12, HISTOGRAM = 46, GAP = 10;

/** Wilson's interval of a share at 95 %. */
export function wilson(right: number, count: number): [number, number] {
  if (count === 0) return [0, 1];
  const z = 1.96, p = right / count, n = count;
  const middle = (p + (z * z) / (2 * n)) / (1 + (z * z) / n);
  const half = (z / (1 + (z * z) / n)) * Math.sqrt((p * (1 - p)) / n + (z * z) / (4 * n * n));
  return [Math.max(0, middle - half), Math.min(1, middle + half)];
}

/** Share that was right against the probability that was given, and how often each was given. */
export function reliabilityFigure(curve: ReliabilityCurve): HTMLElement {
  const { bins } = curve;
  const x = (p: number): number => LEFT + SIZE * p, y = (p: number): number => TOP + SIZE * (1 - p);
  const most = Math.max(1, ...bins.map((bin) => bin.count)), bottom = TOP + SIZE + GAP + HISTOGRAM;
  const total = bins.reduce((sum, bin) => sum + bin.count, 0);
  const ticks = [0, 0.25, 0.5, 0.75, 1];
  const chart = svg(
    'svg', { viewBox: `0 0 ${LEFT + SIZE + 14} ${bottom + 34}`, class: 'chart', role: 'img', 'aria-label': `Reliability of ${curve.name}: ${bins.map((bin) => `given about ${figure(bin.mean_probability, 2)}, right ${bin.right} of ${bin.count}`).join('; ')}` },
    ticks.map((t) => [
      svg('line', { class: 'grid', x1: x(0), x2: x(1), y1: y(t), y2: y(t) }),
      svg('text', { x: LEFT - 7, y: y(t) + 4, 'text-anchor': 'end' }, t),
      svg('text', { x: x(t), y: bottom + 15, 'text-anchor': 'middle' }, t),
    ]),
    svg('line', { class: 'ideal', x1: x(0), y1: y(0), x2: x(1), y2: y(1) }),
    bins.map((bin) => {
      const [low, high] = wilson(bin.right, bin.count), share = bin.right / bin.count, at = x(bin.mean_probability);
      const height = Math.max(1.5, (HISTOGRAM * bin.count) / most);
      return [
        svg('rect', { class: 'amount', x: x(bin.from) + 0.75, width: Math.max(1, x(bin.to) - x(bin.from) - 1.5), y: bottom - height, height }),
        svg('line', { class: 'spread', x1: at, x2: at, y1: y(low), y2: y(high) }),
        svg('circle', { class: 'point', cx: at, cy: y(share), r: 4.5 }, svg('title', {}, `given ${figure(bin.mean_probability, 3)}: right ${bin.right} of ${bin.count} (${figure(100 * share, 3)} %)`)),
      ];
    }),
    svg('line', { class: 'axis', x1: x(0), x2: x(1), y1: bottom, y2: bottom }),
    svg('text', { x: x(0.5), y: bottom + 31, 'text-anchor': 'middle', class: 'title' }, 'probability given'),
    svg('text', { x: 11, y: y(0.5), 'text-anchor': 'middle', class: 'title', transform: `rotate(-90 11 ${y(0.5)})` }, 'share right'),
  );
  return h('figure', {}, chart, h('figcaption', {}, h('b', {}, curve.name), `${plural(total, 'answer')}, calibration error ${figure(curve.ece, 2)}`));
}
