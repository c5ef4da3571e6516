// SPDX-License-Identifier: BSD-3-Clause
// The document "toposcope.index/1": what compare and evaluate show.
import type { SceneDocument } from './scene';

export type Kind = 'text' | 'number' | 'verdict' | 'percent' | 'ms';
export type Cell = string | number | boolean | null;

export interface Table {
  id: string;
  title: string;
  columns: { name: string; unit?: string | null; kind: Kind }[];
  rows: Cell[][];
  links?: (string | null)[];
}

export interface MeshCard {
  name: string;
  dataset?: string;
  thumbnail?: string | null;
  verdicts?: Record<string, string>;
  report?: string | null;
  probability?: number | null;
}

export interface ReliabilityCurve {
  name: string;
  bins: { from: number; to: number; count: number; right: number; mean_probability: number }[];
  ece?: number | null;
}

export interface IndexDocument {
  schema: 'toposcope.index/1';
  title: string;
  program: string;
  tables?: Table[];
  meshes?: MeshCard[];
  reliability?: ReliabilityCurve[] | null;
  confusion?: { classes: string[]; answers?: string[]; counts: number[][] } | null;
  views?: { name: string; scene: SceneDocument }[] | null;
}
