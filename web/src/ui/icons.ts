// SPDX-License-Identifier: BSD-3-Clause
import { svg } from './dom';

const PATHS = {
  reset: 'M4 12a8 8 0 1 0 2.6-5.9M4 4v4.4h4.4',
  orthographic: 'M4 8l8-4 8 4v8l-8 4-8-4zM4 8l8 4 8-4M12 12v8',
  edges: 'M12 3l9 16H3zM7.5 11h9M7.5 11L12 19l4.5-8',
  labels: 'M4 5h9l7 7-7 7H4zM8 12h.01',
  picture: 'M4 8h4l1.5-2.5h5L16 8h4v11H4zM12 16.5a3.2 3.2 0 1 0 0-6.4 3.2 3.2 0 0 0 0 6.4',
  download: 'M12 4v11M7.5 11L12 15.5 16.5 11M5 20h14',
  upload: 'M12 16V5M7.5 9L12 4.5 16.5 9M5 20h14',
  theme: 'M12 4a8 8 0 1 0 8 8 6.2 6.2 0 0 1-8-8z',
  help: 'M9.2 9.2a2.9 2.9 0 1 1 4.3 2.5c-1 .600-1.5 1.2-1.5 2.3M12 17.5h.01M12 21a9 9 0 1 0 0-18 9 9 0 0 0 0 18z',
  plus: 'M12 5v14M5 12h14',
  minus: 'M5 12h14',
  previous: 'M14.5 6L8.5 12l6 6',
  next: 'M9.5 6l6 6-6 6',
  undo: 'M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11H9',
  check: 'M5 12.5l4.5 4.5L19 7.5',
  cross: 'M6.5 6.5l11 11M17.5 6.5l-11 11',
  dash: 'M7 12h10',
  link: 'M9 15l6-6M10.5 6.5l1.5-1.5a4 4 0 0 1 6 6l-1.5 1.5M13.5 17.5L12 19a4 4 0 0 1-6-6l1.5-1.5',
} as const;

export type Icon = keyof typeof PATHS;

export function icon(name: Icon, size = 18): SVGSVGElement {
  return svg('svg', { class: 'icon', viewBox: '0 0 24 24', width: size, height: size, 'aria-hidden': 'true' }, svg('path', { d: PATHS[name] }));
}

/** The dial on a hilltop that names the peaks around. */
export function dial(size = 26): SVGSVGElement {
  const ticks = Array.from({ length: 24 }, (_unused, i) => {
    const a = (i * Math.PI) / 12, r = i % 6 === 0 ? 7.2 : 8.8;
    return `M${12 + r * Math.sin(a)} ${12 - r * Math.cos(a)}L${12 + 10.4 * Math.sin(a)} ${12 - 10.4 * Math.cos(a)}`;
  });
  return svg(
    'svg', { class: 'dial', viewBox: '0 0 24 24', width: size, height: size, 'aria-hidden': 'true' },
    svg('path', { d: ticks.join('') }),
    svg('path', { class: 'needle', d: 'M12 12L17.2 5.8' }),
    svg('circle', { cx: 12, cy: 12, r: 2 }),
  );
}
