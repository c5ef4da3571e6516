// SPDX-License-Identifier: BSD-3-Clause
// Names around the object, as on the dial that the program is named after: each at the side where its feature lies, with a line to it.
import { Vector3, type Camera } from 'three';
import { h, svg } from '../ui/dom';

export interface Label {
  name: string;
  text: string;
  color: string;
  selected: boolean;
  faint: boolean;
  /** Points of the drawn shape; the label points at the one farthest to its side. */
  anchors: Float32Array;
}

export interface Placed {
  label: Label;
  anchor: [number, number];
  /** The end of the label's line, at the label's inner edge. */
  at: [number, number];
  side: -1 | 1;
}

export interface Extent {
  left: number;
  right: number;
}

const LINE_HEIGHT = 30, MARGIN = 10, GAP = 30;

/** Places labels in two columns left and right of the object; pure, in pixels. */
export function arrange(
  labels: { label: Label; points: [number, number][]; width: number }[], object: Extent, window: { width: number; height: number },
): Placed[] {
  const sorted = labels
    .filter(({ points }) => points.length > 0)
    .map((each) => ({ ...each, x: each.points.reduce((sum, p) => sum + p[0], 0) / each.points.length }))
    .sort((a, b) => a.x - b.x);
  const half = Math.floor(sorted.length / 2);
  const placed: Placed[] = [];
  for (const side of [-1, 1] as const) {
    const own = side < 0 ? sorted.slice(0, half) : sorted.slice(half);
    const column = own
      .map(({ label, points, width }) => {
        const anchor = points.reduce((best, p) => (side * p[0] > side * best[0] ? p : best));
        const edge = side < 0 ? Math.max(width + MARGIN, object.left - GAP) : Math.min(window.width - width - MARGIN, object.right + GAP);
        return { label, anchor, side, at: [edge, anchor[1]] as [number, number] };
      })
      .sort((a, b) => a.anchor[1] - b.anchor[1]);
    spreadOut(column, window.height);
    placed.push(...column);
  }
  return placed;
}

/** Moves labels of one column apart, as little as it takes, and into the window. */
function spreadOut(column: Placed[], height: number): void {
  const low = 0.5 * LINE_HEIGHT + 6, high = height - 0.5 * LINE_HEIGHT - 6;
  for (let round = 0; round < 60; ++round) {
    let moved = false;
    for (let i = 0; i + 1 < column.length; ++i) {
      const a = column[i]!, b = column[i + 1]!, gap = b.at[1] - a.at[1];
      if (gap >= LINE_HEIGHT - 0.01) continue;
      a.at[1] -= (LINE_HEIGHT - gap) / 2;
      b.at[1] += (LINE_HEIGHT - gap) / 2;
      moved = true;
    }
    for (const each of column) {
      const y = Math.min(high, Math.max(low, each.at[1]));
      moved ||= y !== each.at[1];
      each.at[1] = y;
    }
    if (!moved) return;
  }
}

export class LabelLayer {
  readonly element = h('div', { class: 'labels', 'aria-hidden': 'true' });
  private lines = svg('svg', { class: 'leaders' });
  private labels: Label[] = [];
  private chips: HTMLElement[] = [];
  private widths: number[] = [];
  placed: Placed[] = [];

  constructor(private choose: (name: string) => void) {
    this.element.append(this.lines);
  }

  set(labels: Label[]): void {
    this.labels = labels;
    for (const chip of this.chips) chip.remove();
    this.chips = labels.map((label) => {
      const chip = h('div', { class: 'label' }, h('i', { class: 'swatch' }), label.text);
      chip.style.setProperty('--color', label.color);
      chip.classList.toggle('selected', label.selected);
      chip.classList.toggle('faint', label.faint);
      chip.addEventListener('pointerdown', (event) => event.stopPropagation());
      chip.addEventListener('click', () => this.choose(label.name));
      this.element.append(chip);
      return chip;
    });
    this.widths = this.chips.map((chip) => chip.offsetWidth);
  }

  update(camera: Camera, width: number, height: number, object: Extent): void {
    const point = new Vector3();
    const projected = this.labels.map((label, index) => {
      const points: [number, number][] = [];
      for (let i = 0; i + 2 < label.anchors.length; i += 3) {
        point.set(label.anchors[i]!, label.anchors[i + 1]!, label.anchors[i + 2]!).project(camera);
        if (Math.abs(point.z) <= 1) points.push([((point.x + 1) / 2) * width, ((1 - point.y) / 2) * height]);
      }
      return { label, points, width: this.widths[index]! };
    });
    this.placed = arrange(projected, object, { width, height });
    this.lines.replaceChildren();
    this.chips.forEach((chip) => (chip.hidden = true));
    for (const { label, anchor, at, side } of this.placed) {
      const chip = this.chips[this.labels.indexOf(label)]!;
      chip.hidden = false;
      chip.style.transform = `translate(${at[0]}px, ${at[1]}px) translate(${side < 0 ? '-100%' : '0'}, -50%)`;
      const bend = at[0] - side * 12;
      const path = `M${at[0]} ${at[1]}L${bend} ${at[1]}L${anchor[0]} ${anchor[1]}`;
      this.lines.append(
        svg('path', { d: path, class: label.faint ? 'faint under' : 'under' }),
        svg('path', { d: path, class: label.faint ? 'faint' : '' }),
        svg('circle', { cx: anchor[0], cy: anchor[1], r: 3.6, fill: label.color }),
      );
    }
  }
}
