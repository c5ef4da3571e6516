// SPDX-License-Identifier: BSD-3-Clause
import { figure } from '../data/numbers';
import { h } from '../ui/dom';

/** Most that the bar is wide, in pixels. */
const WIDEST = 130;

/** The longest of 1, 2, 5 times a power of ten that is not longer than `most`. */
export function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most)), part = most / power;
  return power * (part >= 5 ? 5 : part >= 2 ? 2 : 1);
}

/** How long a length is in the picture, at the depth of the object's middle. */
export class ScaleBar {
  private text = h('span', {});
  private bar = h('i', {});
  readonly element: HTMLElement;

  constructor(private unit: string) {
    this.element = h('div', { class: 'scale', 'aria-hidden': 'true', title: "in the mesh's own unit, at the depth of the object's middle" }, this.bar, this.text);
  }

  /** \param pixel  length of one pixel */
  update(pixel: number): void {
    const length = roundLength(WIDEST * pixel);
    this.bar.style.width = `${length / pixel}px`;
    this.text.textContent = `${figure(length)}${this.unit ? ` ${this.unit}` : ''}`;
  }
}
