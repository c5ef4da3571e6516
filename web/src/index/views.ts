// SPDX-License-Identifier: BSD-3-Clause
// Results side by side; turning one turns all.
import type { IndexDocument } from '@schemas/index';
import { Scene } from '../data/decoded';
import { Marking } from '../data/marking';
import { probability } from '../data/numbers';
import { firstView } from '../geometry/frame';
import { initialState, Store } from '../state';
import { h, swatch } from '../ui/dom';
import { icon } from '../ui/icons';
import { reducedMotion } from '../ui/theme';
import { compose, middle } from '../view/compose';
import { pickFeature } from '../view/picked';
import { sharedScreens } from '../view/screen';
import { Viewer } from '../view/viewer';

interface View {
  name: string;
  scene: Scene;
  viewer: Viewer;
}

const TURN_DEG = 8, ZOOM = 1.15;

export class LinkedViews {
  readonly element: HTMLElement;
  private grid = h('div', { class: 'views' });
  private legend = h('div', { class: 'chips views-legend', role: 'group', 'aria-label': 'Features' });
  private views: View[] = [];
  private store = new Store({ ...initialState(), labels: false });
  private linked = true;
  private following = false;

  constructor(private documents: NonNullable<IndexDocument['views']>) {
    const link = h('button', { class: 'toggle', 'aria-pressed': 'true', onclick: () => {
      this.linked = !this.linked;
      link.setAttribute('aria-pressed', String(this.linked));
      if (this.linked && this.views[0]) this.follow(this.views[0]);
    } }, icon('link', 16), 'linked cameras');
    const reset = h('button', { class: 'plain', onclick: () => (this.linked ? this.views.slice(0, 1) : this.views).forEach(({ viewer }) => viewer.rig.reset(!reducedMotion())) }, icon('reset', 16), 'Reset');
    this.element = h(
      'section', { class: 'panel wide', 'aria-labelledby': 'views-title' },
      h('div', { class: 'bar-of-title' }, h('h2', { id: 'views-title' }, 'Side by side'), h('div', { class: 'controls' }, link, reset)),
      this.legend, this.grid,
    );
  }

  start(): void {
    let screens: ReturnType<typeof sharedScreens>;
    try {
      screens = sharedScreens();
    } catch (error) {
      this.grid.append(h('p', { class: 'notice error' }, `The views cannot be drawn: ${(error as Error).message}. They need a browser with WebGL 2.`));
      return;
    }
    for (const { name, scene: document_ } of this.documents) {
      const scene = new Scene(document_), { positions } = scene.input;
      const frame = firstView(scene.input, scene.directions(middle(positions)), scene.foundPoints());
      const viewer = new Viewer(screens(), frame, `3-D view, ${name}: arrow keys turn it, plus and minus zoom`);
      const view: View = { name, scene, viewer };
      viewer.onmove = () => this.follow(view);
      viewer.onpick = (picked) => this.store.set(pickFeature(scene, this.store.state, picked));
      viewer.element.addEventListener('keydown', (event) => this.key(view, event));
      const found = scene.features.filter(({ feature }) => feature.present);
      this.grid.append(h('figure', {}, viewer.element, h('figcaption', {}, h('b', {}, name), `${found.length} of ${scene.features.length} found`)));
      this.views.push(view);
    }
    this.store.listen(() => this.render());
    this.render();
  }

  render(): void {
    for (const { scene, viewer } of this.views) compose(viewer, scene, this.store.state, new Marking(new Map(), null, { mesh: '', class: '', mean_edge: 1, bbox_diagonal: 1 }));
    const names = new Map(this.views.flatMap(({ scene }) => scene.features.map((feature) => [feature.name, feature] as const)));
    this.legend.replaceChildren(...[...names.values()].map(({ name, color }) => h(
      'button', {
        class: 'toggle', 'aria-pressed': this.store.state.feature === name ? 'true' : 'false',
        title: this.views.map((view) => `${view.name}: ${said(view.scene, name)}`).join('\n'), onclick: () => this.store.toggleFeature(name),
      }, swatch(color), name)));
  }

  private follow(leader: View): void {
    if (!this.linked || this.following) return;
    this.following = true;
    for (const view of this.views) if (view !== leader) view.viewer.rig.follow(leader.viewer.rig);
    this.following = false;
  }

  private key({ viewer: { rig } }: View, event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const turn = turns[event.key];
    if (turn) rig.turn(turn[0] * TURN_DEG, turn[1] * TURN_DEG);
    else if (event.key === '+' || event.key === '=') rig.zoom(ZOOM);
    else if (event.key === '-') rig.zoom(1 / ZOOM);
    else return;
    event.preventDefault();
  }
}

function said(scene: Scene, name: string): string {
  const feature = scene.feature(name)?.feature;
  return !feature ? 'not in its model' : feature.present ? `found, probability ${probability(feature.probability)}` : 'missing';
}
