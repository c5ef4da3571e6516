// SPDX-License-Identifier: BSD-3-Clause
// From the state to what the window shows: colours of the surface, shapes, dots, names.
import type { Candidate, Drawing, Point, Points } from '@schemas/scene';
import { floats } from '../data/buffers';
import type { NamedFeature, Scene } from '../data/decoded';
import type { Marking } from '../data/marking';
import type { State } from '../state';
import { colors } from '../ui/theme';
import { dots, drawn, type Style } from './drawn';
import type { Label } from './labels';
import { candidatesOf, chosenFeatures, css, mixed, paint, rgb, surfaceOf } from './paint';
import type { Viewer } from './viewer';

export interface Shown {
  feature: NamedFeature;
  drawing: Drawing;
  /** The nearest candidate of a feature that is missing. */
  doubtful: boolean;
}

const equal = (a: unknown, b: unknown): boolean => JSON.stringify(a) === JSON.stringify(b);

/** The candidate that a missing feature came nearest to. */
export function nearestCandidate(scene: Scene, { name, feature }: NamedFeature): Candidate | null {
  if (feature.present || !feature.why.nearest_candidate) return null;
  const { parameters } = feature.why.nearest_candidate;
  return scene.candidates(name).find((each) => equal(each.parameters, parameters)) ?? null;
}

const SHAPE_COLORS: Record<string, string> = { circle: '#d55e00', plane: '#0072b2', 'line-group': '#e69f00', sphere: '#cc79a7', cylinder: '#009e73' };

/** The candidates of all features, each fit once. */
export function distinctShapes(scene: Scene): { candidate: Candidate; color: string }[] {
  const seen = new Set<string>();
  return scene.document.candidates.flatMap((candidate) => {
    const key = JSON.stringify([candidate.shape, candidate.working_sets]);
    if (seen.has(key)) return [];
    seen.add(key);
    return [{ candidate, color: SHAPE_COLORS[candidate.shape] ?? '#cc79a7' }];
  });
}

/** The shapes of a labelling. */
export function labeled(scene: Scene, labeling: number): Shown[] {
  const candidates = candidatesOf(scene, labeling);
  return scene.features.flatMap((feature) => {
    const drawing = labeling === 0 ? feature.drawing : candidates.get(feature.name)?.drawing;
    return drawing ? [{ feature, drawing, doubtful: false }] : [];
  });
}

/** Coordinates of a drawing's lines, or of its patches where it has none. */
export function anchorsOf(drawing: Drawing): Float32Array {
  const buffers = drawing.lines.length > 0 ? drawing.lines : drawing.patches.map((each) => each.positions);
  const points: number[] = [];
  for (const buffer of buffers) for (const x of floats(buffer, 'drawing')) points.push(x);
  return Float32Array.from(points);
}

class Composer {
  readonly labels: Label[] = [];
  private chosen: Set<string>;
  private palette = colors();

  constructor(private viewer: Viewer, private scene: Scene, private state: State) {
    this.chosen = new Set(chosenFeatures(scene, state));
  }

  draw(drawing: Drawing, style: Style): void {
    this.viewer.drawings.add(drawn(drawing, style));
  }

  label(feature: NamedFeature, drawing: Drawing, text = feature.name): void {
    const selected = this.chosen.has(feature.name);
    this.labels.push({
      name: feature.name, text, color: feature.color, selected, faint: this.chosen.size > 0 && !selected, anchors: anchorsOf(drawing),
    });
  }

  /** A feature's colour as it shows through the surface. */
  private pale(feature: NamedFeature, part: number): string {
    return css(mixed(this.palette.surface, rgb(feature.color), part));
  }

  /** Found shapes, strong where they are chosen. */
  found(): void {
    const shown = labeled(this.scene, this.state.stage === 'found' ? this.state.labeling : 0);
    for (const feature of this.scene.features) {
      const nearest = this.chosen.has(feature.name) ? nearestCandidate(this.scene, feature) : null;
      if (nearest && this.state.labeling === 0) shown.push({ feature, drawing: nearest.drawing, doubtful: true });
    }
    for (const { feature, drawing, doubtful } of shown) {
      const faint = this.chosen.size > 0 && !this.chosen.has(feature.name);
      const chosen = this.chosen.has(feature.name);
      this.draw(drawing, {
        color: faint ? this.pale(feature, 0.3) : feature.color,
        width: faint || doubtful ? 2 : chosen ? 5 : 4,
        ...(faint ? {} : { halo: this.palette.halo }),
        fill: faint ? 0.06 : 0.22,
        hidden: this.pale(feature, faint ? 0.16 : chosen ? 0.7 : 0.45),
      });
      this.label(feature, drawing, doubtful ? `${feature.name}: nearest candidate` : feature.name);
    }
  }

  chosenShapes(): void {
    if (this.chosen.size === 0) return;
    for (const { feature, drawing } of labeled(this.scene, 0)) {
      if (!this.chosen.has(feature.name)) continue;
      this.draw(drawing, { color: feature.color, width: 3, halo: this.palette.halo, fill: 0.12, hidden: this.pale(feature, 0.45) });
      this.label(feature, drawing);
    }
  }

  /** All candidates by shape, each fit once however many features share it. */
  allCandidates(): void {
    for (const { candidate, color } of distinctShapes(this.scene))
      this.draw({ lines: candidate.drawing.lines, patches: [] }, { color, width: 1.6, hidden: css(mixed(this.palette.surface, rgb(color), 0.25)) });
  }

  candidates(): void {
    const { candidateOf, rank, allCandidates } = this.state;
    const feature = this.scene.feature(candidateOf);
    if (!feature) return this.allCandidates();
    const candidates = this.scene.candidates(feature.name), current = candidates.find((each) => each.rank === rank);
    for (const each of allCandidates ? candidates : [])
      if (each !== current) this.draw({ lines: each.drawing.lines, patches: [] }, { color: this.pale(feature, 0.6), width: 1.4, hidden: this.pale(feature, 0.2) });
    if (!current) return;
    this.draw(current.drawing, { color: feature.color, width: 5, halo: this.palette.halo, fill: 0.25, hidden: this.pale(feature, 0.7) });
    this.label(feature, current.drawing, `${feature.name}, no. ${current.rank}`);
  }

  marks(marking: Marking): void {
    for (const feature of this.scene.features) {
      const marks = marking.marks.get(feature.name);
      const chosen = this.state.markOf === feature.name;
      marks?.groups.forEach((group, i) => {
        if (group.length === 0) return;
        const active = chosen && (marks.groups.length < 2 || i === this.state.group);
        this.viewer.drawings.add(
          dots(group.map((mark) => mark.point), { color: feature.color, outline: active ? this.palette.strong : this.palette.halo, pixels: (active ? 13 : 9) * Math.min(2, devicePixelRatio) }),
        );
      });
      const points = marks?.groups.flat().map((mark) => mark.point) ?? [];
      if (points.length > 0)
        this.labels.push({ name: feature.name, text: `${feature.name} · ${points.length}`, color: feature.color, selected: chosen, faint: false, anchors: Float32Array.from(points.flat()) });
    }
  }

  face(): void {
    const surface = this.viewer.surface?.data;
    if (this.state.face === null || surface !== this.scene.input) return;
    const line: number[] = [];
    for (const k of [0, 1, 2, 0]) {
      const v = surface.triangles[3 * this.state.face + k]!;
      line.push(surface.positions[3 * v]!, surface.positions[3 * v + 1]!, surface.positions[3 * v + 2]!);
    }
    this.viewer.drawings.add(drawn({ lines: [encode(line)], patches: [] }, { color: this.palette.strong, width: 2.2, halo: this.palette.halo }));
  }
}

/** Points as a drawing holds them. */
function encode(values: number[]): Points {
  const bytes = new Uint8Array(Float32Array.from(values).buffer);
  return { type: 'f32', count: values.length, data: btoa(String.fromCharCode(...bytes)) };
}

export function compose(viewer: Viewer, scene: Scene, state: State, marking: Marking): void {
  const palette = colors();
  const surface = viewer.show(surfaceOf(scene, state));
  const edges = state.edges ?? state.stage === 'mesh';
  surface.paint(paint(scene, state, palette.surface), !edges);
  surface.edges(edges ? 0.62 : 0, palette.edge);
  viewer.clearDrawings();
  const composer = new Composer(viewer, scene, state);
  if (state.stage === 'found') composer.found();
  else if (state.stage === 'candidates') composer.candidates();
  else if (state.stage === 'marks') composer.marks(marking);
  else composer.chosenShapes();
  composer.face();
  viewer.setLabels(state.labels ? composer.labels : []);
}

/** The middle of the input surface's box. */
export function middle(positions: Float32Array): Point {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3]!, positions[i]!);
    high[i % 3] = Math.max(high[i % 3]!, positions[i]!);
  }
  return low.map((x, k) => (x + high[k]!) / 2) as Point;
}
