// SPDX-License-Identifier: BSD-3-Clause
import type { TruthDocument } from '@schemas/truth';
import { marksOfTruth, parseTruth, textOfTruth, truthOf, type FeatureMarks, type Header, type Mark, type Marks } from './truth';

const copyOf = (marks: Marks): Marks =>
  new Map([...marks].map(([name, { absent, groups }]) => [name, { absent, groups: groups.map((group) => [...group]) }]));

const same = (a: Mark, b: Mark): boolean => a.point.every((x, k) => x === b.point[k]);

/** Marks under way: every step can be undone. */
export class Marking {
  private history: Marks[] = [];
  private listeners: (() => void)[] = [];
  /** The class of the object: that of the file, or else what the header says. */
  className: string;

  constructor(private now: Marks, private file: TruthDocument | null, private header: Header) {
    this.className = file?.class || header.class;
  }

  listen(listener: () => void): void {
    this.listeners.push(listener);
  }

  get marks(): ReadonlyMap<string, FeatureMarks> {
    return this.now;
  }

  get canUndo(): boolean {
    return this.history.length > 0;
  }

  /** All of the features together. */
  get total(): number {
    return [...this.now.values()].reduce((sum, { groups }) => sum + groups.reduce((n, group) => n + group.length, 0), 0);
  }

  count(name: string): number {
    return this.now.get(name)?.groups.reduce((n, group) => n + group.length, 0) ?? 0;
  }

  /** Adds a mark, or takes it away where the feature's group has it. */
  toggle(name: string, group: number, mark: Mark): 'added' | 'removed' {
    const at = this.now.get(name)?.groups[group]?.findIndex((each) => same(each, mark)) ?? -1;
    this.change((marks) => {
      const feature = marks.get(name) ?? { absent: false, groups: [] };
      while (feature.groups.length <= group) feature.groups.push([]);
      if (at >= 0) feature.groups[group]!.splice(at, 1);
      else feature.groups[group]!.push(mark);
      feature.absent = false;
      marks.set(name, feature);
    });
    return at >= 0 ? 'removed' : 'added';
  }

  removeLast(name: string, group: number): void {
    if (this.now.get(name)?.groups[group]?.length) this.change((marks) => marks.get(name)!.groups[group]!.pop());
  }

  clear(name: string): void {
    if (this.count(name) > 0 || this.now.get(name)?.absent) this.change((marks) => marks.delete(name));
  }

  /** Says that the object does not have the feature, or takes that back. */
  setAbsent(name: string, absent: boolean): void {
    this.change((marks) => {
      if (absent) marks.set(name, { absent: true, groups: [[]] });
      else marks.delete(name);
    });
  }

  undo(): void {
    const before = this.history.pop();
    if (!before) return;
    this.now = before;
    this.tell();
  }

  /** \throw Error that names the member at fault; the marks stay as they were */
  load(text: string): void {
    const file = parseTruth(text);
    const marks = marksOfTruth(file);
    this.change(() => undefined);
    this.now = marks;
    this.file = file;
    this.className = file.class || this.className;
    this.tell();
  }

  text(): string {
    return textOfTruth(truthOf(this.now, { ...this.header, class: this.className }, this.file));
  }

  private change(step: (marks: Marks) => void): void {
    this.history.push(copyOf(this.now));
    this.now = copyOf(this.now);
    step(this.now);
    this.tell();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
