// SPDX-License-Identifier: BSD-3-Clause
/** Named as those of `toposcope render --stage`. */
export const STAGES = ['mesh', 'worksets', 'candidates', 'found', 'marks'] as const;
export type Stage = (typeof STAGES)[number];

export interface State {
  stage: Stage;
  feature: string | null;
  relation: string | null;
  /** Face of the input surface, as shown. */
  face: number | null;
  /** Types of working sets that are not shown. */
  hiddenTypes: ReadonlySet<string>;
  /** One working set alone; null: all of the shown types. */
  set: number | null;
  /** Whose candidates are looked at, and which of them. */
  candidateOf: string | null;
  rank: number;
  allCandidates: boolean;
  /** 0: the best labelling; i: the i-th alternative. */
  labeling: number;
  /** null: as the stage has it. */
  edges: boolean | null;
  labels: boolean;
  orthographic: boolean;
  /** Which feature, and which of its groups, new marks go to. */
  markOf: string | null;
  group: number;
}

export function initialState(): State {
  return {
    stage: 'found', feature: null, relation: null, face: null, hiddenTypes: new Set(), set: null, candidateOf: null, rank: 1,
    allCandidates: true, labeling: 0, edges: null, labels: true, orthographic: false, markOf: null, group: 0,
  };
}

/** What the page shows; everything that draws listens to it. */
export class Store {
  private listeners: ((state: State, before: State) => void)[] = [];
  constructor(public state: State) {}

  listen(listener: (state: State, before: State) => void): void {
    this.listeners.push(listener);
  }

  set(change: Partial<State>): void {
    const before = this.state;
    this.state = { ...before, ...change };
    for (const listener of this.listeners) listener(this.state, before);
  }

  /** A feature, or none when it is selected already. */
  toggleFeature(name: string): void {
    const on = this.state.feature !== name;
    this.set({ feature: on ? name : null, relation: null, face: null, ...(on ? { candidateOf: name, rank: 1, markOf: name, group: 0 } : {}) });
  }
}
