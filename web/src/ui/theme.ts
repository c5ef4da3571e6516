// SPDX-License-Identifier: BSD-3-Clause
import type { Rgb } from '../view/paint';

export type Theme = 'light' | 'dark';
const listeners: (() => void)[] = [];
const dark = matchMedia('(prefers-color-scheme: dark)');

/** What the reader chose, or else what the system has. */
export function theme(): Theme {
  const chosen = document.documentElement.dataset['theme'];
  return chosen === 'light' || chosen === 'dark' ? chosen : dark.matches ? 'dark' : 'light';
}

export function toggleTheme(): void {
  document.documentElement.dataset['theme'] = theme() === 'dark' ? 'light' : 'dark';
  for (const listener of listeners) listener();
}

export function onTheme(listener: () => void): void {
  listeners.push(listener);
  dark.addEventListener('change', listener);
}

export const reducedMotion = (): boolean => matchMedia('(prefers-reduced-motion: reduce)').matches;

export interface Colors {
  surface: Rgb;
  /** Wireframe over the surface. */
  edge: string;
  /** Around lines and dots. */
  halo: string;
  /** Behind everything, for pictures. */
  ground: string;
  strong: string;
}

export const colors = (): Colors =>
  theme() === 'dark'
    ? { surface: [158, 166, 178], edge: '#0c1016', halo: '#0e1319', ground: '#1a2028', strong: '#ffffff' }
    : { surface: [208, 211, 217], edge: '#39424f', halo: '#ffffff', ground: '#eef1f5', strong: '#10161f' };
