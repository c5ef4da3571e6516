// SPDX-License-Identifier: BSD-3-Clause
// The page of several meshes or labelers.
import type { IndexDocument } from '@schemas/index';
import { confusionFigure } from './index/confusion';
import { gallery } from './index/gallery';
import { reliabilityFigure } from './index/reliability';
import { tableSection } from './index/table';
import { LinkedViews } from './index/views';
import { h } from './ui/dom';
import { pageHeader } from './ui/header';
import { onTheme } from './ui/theme';

export class IndexPage {
  constructor(private data: IndexDocument, private root: HTMLElement) {}

  start(): void {
    const { title, program, tables, meshes, reliability = [], confusion, views } = this.data;
    document.title = `${title} · Toposcope`;
    this.root.className = 'index';
    const linked = views?.length ? new LinkedViews(views) : null;
    const figures = [
      ...reliability.map((curve) => reliabilityFigure(curve)),
      ...(confusion ? [confusionFigure(confusion)] : []),
    ];
    const main = h(
      'main', {},
      linked?.element,
      meshes.length > 0 && gallery(meshes),
      figures.length > 0 && h('section', { class: 'panel wide', 'aria-labelledby': 'figures-title' }, h('h2', { id: 'figures-title' }, 'How good the answers are'), h('div', { class: 'figures' }, figures)),
      tables.map((table) => tableSection(table)),
      h('p', { class: 'program' }, program),
    );
    this.root.replaceChildren(pageHeader(title, null), main);
    linked?.start();
    onTheme(() => linked?.render());
  }
}
