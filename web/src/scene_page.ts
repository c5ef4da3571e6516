// SPDX-License-Identifier: BSD-3-Clause
// The page of one mesh: the view, the way to it on the left, what was found on the right.
import type { SceneDocument } from '@schemas/scene';
import { Scene } from './data/decoded';
import { Marking } from './data/marking';
import { firstView } from './geometry/frame';
import { initialState, STAGES, Store, type State } from './state';
import { announce, download, h } from './ui/dom';
import { featuresPanel } from './ui/features_panel';
import { pageHeader, tool } from './ui/header';
import { helpDialog, listenToKeys, type Key } from './ui/keys';
import { labelingsPanel } from './ui/labelings_panel';
import { className } from './ui/marking_tools';
import { refresh } from './ui/refresh';
import { familiesPanel } from './ui/families_panel';
import { measuresPanel } from './ui/measures_panel';
import { relationsPanel } from './ui/relations_panel';
import { runPanels } from './ui/run_panel';
import { stageDetail, stageNavigation, TITLES } from './ui/stages';
import { colors, onTheme, reducedMotion, toggleTheme } from './ui/theme';
import { anchorsOf, compose, labeled, middle } from './view/compose';
import { hoverText, pickCandidate, pickFeature, pickMark, pickSet } from './view/picked';
import { ScaleBar } from './view/scale_bar';
import { ownScreen } from './view/screen';
import { Viewer, type Picked } from './view/viewer';

declare global {
  interface Window {
    /** For scripts that drive the page. */
    toposcope?: {
      state(): State;
      set(change: Partial<State>): void;
      /** A point of the mesh's frame in the window's pixels. */
      project(point: [number, number, number]): [number, number];
      /** Whether all is drawn, the shading of hollows too. */
      idle(): boolean;
    };
  }
}

const TURN_DEG = 8, ZOOM = 1.15, PAN = 0.06;

export class ScenePage {
  private scene: Scene;
  private store = new Store(initialState());
  private marking: Marking;
  private viewer: Viewer | null = null;
  private keys: Key[] = [];
  private help: HTMLDialogElement | null = null;
  private navigation = h('nav', { class: 'stages', 'aria-label': 'Stages' });
  private detail = h('section', { class: 'stage', 'aria-label': 'Stage' });
  private view = h('div', { class: 'view' });
  private tools = h('div', { class: 'tools floating', role: 'toolbar', 'aria-label': 'View' });
  private tip = h('div', { class: 'tip', 'aria-hidden': 'true', hidden: true });
  private ring = h('div', { class: 'ring', 'aria-hidden': 'true', hidden: true });
  private cross = h('div', { class: 'cross', 'aria-hidden': 'true', hidden: true });
  private panel = h('aside', { class: 'panels', 'aria-label': 'Result' });

  constructor(document_: SceneDocument, private root: HTMLElement) {
    this.scene = new Scene(document_);
    const { mesh } = this.scene.result;
    this.marking = new Marking(this.scene.marks(), document_.truth ?? null, {
      mesh: mesh.path.split('/').pop() ?? '',
      class: className(this.scene),
      mean_edge: mesh.mean_edge,
      bbox_diagonal: Math.hypot(mesh.box.a, mesh.box.b, mesh.box.c),
    });
  }

  start(): void {
    const { document: document_, result } = this.scene;
    document.title = `${document_.title} · Toposcope`;
    this.keys = this.bindings();
    this.help = helpDialog(this.keys);
    const status = h('span', { class: `status ${result.status}` }, result.status);
    this.root.className = 'scene';
    this.root.replaceChildren(
      pageHeader(document_.title, status,
                 tool('download', 'Download result.json', '', () => this.saveResult()),
                 tool('help', 'Mouse, touch and keys', '?', () => this.help?.showModal())),
      this.navigation,
      h('main', { class: 'view-area' }, this.view),
      this.detail, this.panel,
    );
    this.openView();
    this.store.listen((state, before) => this.changed(state, before));
    this.marking.listen(() => this.render());
    onTheme(() => this.render());
    listenToKeys(this.keys, this.viewer?.element ?? this.view);
    this.render();
    window.toposcope = {
      state: () => this.store.state,
      set: (change) => this.store.set(change),
      project: (point) => {
        const box = this.view.getBoundingClientRect(), [x, y] = this.viewer?.project(point) ?? [NaN, NaN];
        return [box.left + x, box.top + y];
      },
      idle: () => this.viewer?.idle ?? true,
    };
  }

  private openView(): void {
    try {
      const { positions } = this.scene.input;
      const frame = firstView(this.scene.input, this.scene.directions(middle(positions)), this.scene.foundPoints());
      this.viewer = new Viewer(ownScreen(), frame, '3-D view of the mesh: arrow keys turn it, plus and minus zoom, Enter picks what lies under the middle');
    } catch (error) {
      this.view.append(h('p', { class: 'notice error' }, `The view cannot be drawn: ${(error as Error).message}. It needs a browser with WebGL 2; the tables beside it need none.`));
      return;
    }
    const { viewer } = this;
    viewer.onpick = (picked) => this.pick(picked);
    viewer.onlabel = (name) => this.store.toggleFeature(name);
    viewer.onhover = (picked, x, y) => this.hover(picked, x, y);
    viewer.element.addEventListener('focus', () => this.showCross());
    viewer.element.addEventListener('blur', () => this.showCross());
    const scale = new ScaleBar(this.scene.document.unit);
    viewer.ondraw = () => scale.update(viewer.rig.pixel);
    this.view.append(viewer.element, scale.element, this.ring, this.cross, this.tip, this.tools);
  }

  private changed(state: State, before: State): void {
    if (state.stage !== before.stage) announce(TITLES[state.stage]);
    else if (state.feature !== before.feature && state.feature) announce(`${state.feature} selected`);
    else if (state.relation !== before.relation && state.relation) announce(`relation ${state.relation} selected`);
    if (state.orthographic !== before.orthographic) this.viewer?.rig.setOrthographic(state.orthographic);
    this.render();
    if (state.feature !== before.feature && state.feature)
      this.panel.querySelector(`[data-key="feature:${CSS.escape(state.feature)}"]`)?.scrollIntoView({ block: 'nearest', behavior: reducedMotion() ? 'auto' : 'smooth' });
  }

  private render(): void {
    const { scene, store, marking, viewer } = this;
    refresh(this.navigation, stageNavigation(scene, store, marking));
    refresh(this.detail, ...stageDetail(scene, store, marking));
    const panels = [featuresPanel(scene, store, (name) => this.turnTo(name)), familiesPanel(scene), relationsPanel(scene, store), measuresPanel(scene), labelingsPanel(scene, store), ...runPanels(scene)];
    refresh(this.panel, ...panels.filter((panel): panel is HTMLElement => panel !== null));
    if (!viewer) return;
    compose(viewer, scene, store.state, marking);
    this.renderTools(viewer);
    this.showCross();
    viewer.element.classList.toggle('marking', store.state.stage === 'marks' && store.state.markOf !== null);
  }

  private renderTools(viewer: Viewer): void {
    const { state } = this.store;
    const edges = state.edges ?? state.stage === 'mesh';
    refresh(
      this.tools,
      tool('plus', 'Nearer', '+', () => viewer.rig.zoom(ZOOM)),
      tool('minus', 'Farther', '-', () => viewer.rig.zoom(1 / ZOOM)),
      tool('reset', 'Reset the view', 'R', () => viewer.rig.reset(!reducedMotion())),
      tool('orthographic', 'Orthographic', 'O', () => this.store.set({ orthographic: !state.orthographic }), state.orthographic),
      tool('edges', 'Edges of the triangles', 'E', () => this.store.set({ edges: !edges }), edges),
      tool('labels', 'Names of the features', 'L', () => this.store.set({ labels: !state.labels }), state.labels),
      tool('picture', 'Save a picture', 'P', () => this.savePicture()),
    );
  }

  private pick(picked: Picked | null): void {
    const { scene, store, marking } = this, { state } = store;
    if (state.stage === 'worksets') store.set(pickSet(scene, state, picked));
    else if (state.stage === 'candidates') store.set(pickCandidate(scene, state, picked));
    else if (state.stage === 'marks' && state.markOf !== null) {
      const said = picked && pickMark(scene, state, marking, picked);
      if (said) announce(said);
    } else store.set(pickFeature(scene, state, picked));
  }

  private hover(picked: Picked | null, x: number, y: number): void {
    const { stage, markOf } = this.store.state;
    this.ring.hidden = !picked || stage !== 'marks' || markOf === null;
    if (picked && !this.ring.hidden) {
      const p = this.scene.input.positions, v = 3 * picked.vertex;
      const at = this.viewer!.project([p[v]!, p[v + 1]!, p[v + 2]!]);
      this.ring.style.transform = `translate(${at[0]}px, ${at[1]}px)`;
    }
    const text = picked && hoverText(this.scene, this.store.state, picked);
    this.tip.hidden = !text;
    if (!text) return;
    this.tip.textContent = text;
    this.tip.style.transform = `translate(${x + 14}px, ${y + 16}px)`;
  }

  /** Where Enter picks, for those without a mouse. */
  private showCross(): void {
    this.cross.hidden = !this.viewer?.element.matches(':focus-visible');
  }

  private turnTo(name: string): void {
    const shown = labeled(this.scene, this.store.state.labeling).find(({ feature }) => feature.name === name);
    if (shown) this.viewer?.turnTo(anchorsOf(shown.drawing), !reducedMotion());
  }

  private saveResult(): void {
    download('result.json', `${JSON.stringify(this.scene.result, null, 1)}\n`);
  }

  private savePicture(): void {
    const { title } = this.scene.document;
    this.viewer?.picture(colors().ground).toBlob((blob) => {
      if (blob) download(`${title.split(' ')[0]!.replace(/\.[^.]*$/, '')}-${this.store.state.stage}.png`, blob);
    });
    announce('Picture saved');
  }

  private step(by: number): void {
    const { scene, store } = this, { state } = store;
    const within = (value: number, last: number): number => Math.min(last, Math.max(0, value));
    if (state.stage === 'worksets') {
      const last = (scene.document.working_sets.length) - 1;
      if (last >= 0) store.set({ set: within((state.set ?? -1) + by, last) });
    } else if (state.stage === 'candidates' && state.candidateOf !== null) {
      const list = scene.candidates(state.candidateOf), now = list.findIndex((each) => each.rank === state.rank);
      if (list.length > 0) store.set({ rank: list[within(now + by, list.length - 1)]!.rank });
    } else if (state.stage === 'found') {
      store.set({ labeling: within(state.labeling + by, scene.result.alternatives.length) });
    }
  }

  private bindings(): Key[] {
    const { store } = this, rig = () => this.viewer?.rig;
    const move = (right: number, up: number, event: KeyboardEvent): void => {
      if (event.shiftKey) rig()?.pan(-right * PAN, -up * PAN);
      else rig()?.turn(right * -TURN_DEG, up * TURN_DEG);
    };
    return [
      { keys: STAGES.map((_stage, i) => i + 1).join(' '), shown: `1 … ${STAGES.length}`, text: 'stages', run: (event) => store.set({ stage: STAGES[Number(event.key) - 1]! }) },
      { keys: 'ArrowLeft', shown: '← → ↑ ↓', text: 'turn; with Shift: move', view: true, run: (event) => move(-1, 0, event) },
      ...([['ArrowRight', 1, 0], ['ArrowUp', 0, 1], ['ArrowDown', 0, -1]] as const).map(([keys, x, y]) => ({ keys, shown: '', text: '', view: true, run: (event: KeyboardEvent) => move(x, y, event) })),
      { keys: '+ =', shown: '+ −', text: 'nearer, farther', run: () => rig()?.zoom(ZOOM) },
      { keys: '- _', shown: '', text: '', run: () => rig()?.zoom(1 / ZOOM) },
      { keys: 'Enter', shown: 'Enter', text: 'pick, or mark, what lies under the cross in the middle', view: true, run: () => this.pickMiddle() },
      { keys: '[', shown: '[ ]', text: 'previous and next working set, candidate or labelling', run: () => this.step(-1) },
      { keys: ']', shown: '', text: '', run: () => this.step(1) },
      { keys: 'u U', shown: 'U', text: 'undo a mark', run: () => this.marking.undo() },
      { keys: 'Delete Backspace', shown: 'Delete', text: 'delete the last mark of the chosen feature', run: () => store.state.markOf && this.marking.removeLast(store.state.markOf, store.state.group) },
      { keys: 'r R 0', shown: 'R', text: 'reset the view', run: () => rig()?.reset(!reducedMotion()) },
      { keys: 'f F', shown: 'F', text: 'turn to the selected feature', run: () => store.state.feature && this.turnTo(store.state.feature) },
      { keys: 'o O', shown: 'O', text: 'orthographic or perspective', run: () => store.set({ orthographic: !store.state.orthographic }) },
      { keys: 'e E', shown: 'E', text: 'edges of the triangles', run: () => store.set({ edges: !(store.state.edges ?? store.state.stage === 'mesh') }) },
      { keys: 'l L', shown: 'L', text: 'names of the features', run: () => store.set({ labels: !store.state.labels }) },
      { keys: 'p P', shown: 'P', text: 'save a picture', run: () => this.savePicture() },
      { keys: 't T', shown: 'T', text: 'light or dark', run: () => toggleTheme() },
      { keys: 'Escape', shown: 'Esc', text: 'select nothing', run: () => store.set({ feature: null, relation: null, face: null, set: null }) },
      { keys: '?', shown: '?', text: 'this help', run: () => this.help?.showModal() },
    ];
  }

  private pickMiddle(): void {
    const { viewer } = this;
    if (viewer) this.pick(viewer.at(viewer.element.clientWidth / 2, viewer.element.clientHeight / 2));
  }
}

