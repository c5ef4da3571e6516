// SPDX-License-Identifier: BSD-3-Clause
import type { IndexDocument } from '@schemas/index';
import type { SceneDocument } from '@schemas/scene';
import { IndexPage } from './index_page';
import { ScenePage } from './scene_page';
import { h } from './ui/dom';

function failed(root: HTMLElement, what: string): void {
  root.className = 'empty';
  root.replaceChildren(h('main', {}, h('h1', {}, 'Toposcope'), h('p', {}, what)));
}

function start(): void {
  const root = document.getElementById('page')!;
  const text = document.getElementById('toposcope-data')?.textContent?.trim() ?? 'null';
  try {
    const data = JSON.parse(text) as SceneDocument | IndexDocument | null;
    if (data === null) failed(root, "This page holds no result: 'toposcope run MESH --model NAME --out DIR' writes one that does.");
    else if (data.schema === 'toposcope.scene/1') new ScenePage(data, root).start();
    else if (data.schema === 'toposcope.index/1') new IndexPage(data, root).start();
    else failed(root, `This page's document is of schema '${(data as { schema?: string }).schema}'; it shows toposcope.scene/1 and toposcope.index/1.`);
  } catch (error) {
    failed(root, `This page's document cannot be shown: ${(error as Error).message}`);
    throw error;
  }
}

start();
