// SPDX-License-Identifier: BSD-3-Clause
// The document "toposcope.scene/1" (schemas/scene.schema.json), as far as the page reads it.
import type { Buffer } from './buffers';
import type { TruthFile } from './truth';

export type Point = [number, number, number];
/** Of a fitted shape: center, radius, endpoints, ... as in result.json. */
export type Parameters = Record<string, number | boolean | number[] | number[][]>;

export interface Relation {
  name: string;
  type: string;
  features: string[];
  tested: boolean;
  residual?: number | null;
  tolerance?: number | null;
  unit?: 'deg' | 'length';
  satisfied: boolean;
  probability?: number | null;
  why?: string;
}

export interface FoundFeature {
  present: true;
  probability: number | null;
  evidence: number | null;
  shape: string;
  parameters: Parameters;
  measures: Record<string, number | null>;
  fit_error: number | null;
  fit: Record<string, unknown>;
  uncertainty: Record<string, unknown>;
  working_sets: number[];
  faces: number[];
}

export interface MissingFeature {
  present: false;
  probability_missing: number | null;
  why: {
    reason: string;
    nearest_candidate?: { parameters: Parameters; fit_error: number | null; cost: number | null };
    relations_failed?: Relation[];
    conflict?: { relations: string[]; exclusions: string[]; smallest: boolean };
  };
}

export type Feature = FoundFeature | MissingFeature;

export interface Alternative {
  probability: number | null;
  cost: number | null;
  /** Rank of each feature's candidate from 1; 0 is missing. */
  candidates?: Record<string, number>;
}

export interface Result {
  schema: string;
  mesh: {
    path: string;
    vertices: number;
    faces: number;
    box: { a: number; b: number; c: number };
    mean_edge: number;
    components: number;
    closed_components: number;
    holes: number;
    euler: number;
    genus: number;
    repair: Record<string, number>;
  };
  model: string;
  status: string;
  class: string | null;
  class_probabilities?: Record<string, number | null>;
  log_evidence: number | null;
  optimal: boolean;
  guarantee: string;
  probabilities: string | null;
  features: Record<string, Feature>;
  relations: Relation[];
  alternatives: Alternative[];
  working_sets: number;
  candidates: Record<string, Record<string, number>>;
  timings_ms: Record<string, number>;
  plugins: { kind: string; id: string; version: string; options: Record<string, string> }[];
}

export interface Surface {
  mesh_vertices: number;
  mesh_triangles: number;
  shown_vertices: number;
  shown_triangles: number;
  positions: Buffer;
  triangles: Buffer;
  labels?: Buffer;
  faces?: Buffer;
  vertex_ids?: Buffer;
}


export interface Drawing {
  lines?: Buffer[];
  patches?: { positions: Buffer; triangles: Buffer }[];
  points?: Buffer;
}

export interface WorkingSet {
  type: string;
  vertices: Buffer;
  size: number;
  /** How clearly it stands out, 0 to 1. */
  level?: number | null;
}

export interface Candidate {
  feature: string;
  rank: number;
  probability: number | null;
  evidence: number | null;
  shape: string;
  parameters: Parameters;
  fit_error: number | null;
  working_sets: number[];
  drawing: Drawing;
}

/** The model file, as it was read. */
export interface ModelFile {
  name?: string;
  summary?: string;
  objects?: Record<string, string>;
  topology?: Record<string, string[]>;
  parts?: Record<string, string[]>;
  associations?: Record<string, string>[];
  features?: Record<string, { realises?: string; worksets?: string[]; shape?: string | { plugin: string } }>;
  classes?: Record<string, string[]>;
}

export interface SceneDocument {
  schema: 'toposcope.scene/1';
  title: string;
  program: string;
  unit?: string;
  result: Result;
  surfaces: { input: Surface; normalised?: Surface | null };
  working_sets?: WorkingSet[];
  all_working_sets?: { type: string; vertices: Buffer; count?: number }[];
  candidates?: Candidate[];
  found?: { feature: string; rank?: number; drawing: Drawing }[];
  marks?: Record<string, Point[]> | null;
  truth?: TruthFile | null;
  model?: ModelFile;
  palette: { features: string[]; worksets: Record<string, string> };
}
