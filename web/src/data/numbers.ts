// SPDX-License-Identifier: BSD-3-Clause
/** Numbers as people read them: four significant digits, no exponent where none is needed, a true minus. */
export function figure(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text =
    size >= 1e6 || size < 1e-4
      ? value.toExponential(Math.max(0, digits - 1)).replace(/\.?0+e/, 'e').replace('e+', 'e')
      : String(Number(value.toPrecision(digits)));
  return text.replace('-', '−');
}

/** Coordinates, all to the same decimal: four significant digits of the largest. */
export function vector(values: number[]): string {
  const largest = Math.max(...values.map(Math.abs));
  const decimals = largest > 0 ? Math.min(20, Math.max(0, 3 - Math.floor(Math.log10(largest)))) : 0;
  return `(${values.map((x) => figure(Number(x.toFixed(decimals)))).join(', ')})`;
}

/** Probabilities never read 1 or 0 unless they are. */
export function probability(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0 || value === 1) return String(value);
  if (value > 0.9995) return '>0.999';
  if (value < 0.0005) return '<0.001';
  return value.toFixed(3);
}

export function count(value: number): string {
  return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, ',');
}

export function milliseconds(value: number): string {
  return value >= 1000 ? `${figure(value / 1000, 3)} s` : `${figure(value, 3)} ms`;
}

/** "found" for 1, "founds" for all else. */
export function plural(n: number, one: string, many = `${one}s`): string {
  return `${count(n)} ${n === 1 ? one : many}`;
}
