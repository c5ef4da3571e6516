// SPDX-License-Identifier: BSD-3-Clause
import type { Bytes, Indices, Points, Quantised } from '@schemas/scene';

/** `atob` into bytes; a text that is no base64 throws. */
export function bytesOf(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const WIDTH = { f32: 4, u32: 4, u16: 2, u8: 1, q16: 2 };

function checked(buffer: Bytes | Indices | Points | Quantised, name: string): DataView {
  const width = WIDTH[buffer.type];
  if (!width) throw new Error(`${name}: unknown buffer type '${buffer.type}'; known are ${Object.keys(WIDTH).join(', ')}`);
  const bytes = bytesOf(buffer.data);
  if (bytes.length !== buffer.count * width)
    throw new Error(`${name}: ${buffer.count} numbers of ${buffer.type} take ${buffer.count * width} bytes, found ${bytes.length}`);
  return new DataView(bytes.buffer);
}

/** Coordinates, as f32 or q16. */
export function floats(buffer: Points | Quantised, name: string): Float32Array {
  const view = checked(buffer, name);
  const values = new Float32Array(buffer.count);
  if (buffer.type === 'f32') {
    for (let i = 0; i < values.length; ++i) values[i] = view.getFloat32(4 * i, true);
  } else if (buffer.type === 'q16' && buffer.min && buffer.step) {
    const { min, step } = buffer;
    for (let i = 0; i < values.length; ++i) values[i] = min[i % 3]! + step[i % 3]! * view.getUint16(2 * i, true);
  } else {
    throw new Error(`${name}: coordinates are f32, or q16 with 'min' and 'step'; found ${buffer.type}`);
  }
  return values;
}

/** Indices and labels, as u32, u16 or u8. */
export function indices(buffer: Bytes | Indices, name: string): Uint32Array {
  const view = checked(buffer, name);
  const values = new Uint32Array(buffer.count);
  for (let i = 0; i < values.length; ++i) {
    if (buffer.type === 'u32') values[i] = view.getUint32(4 * i, true);
    else if (buffer.type === 'u16') values[i] = view.getUint16(2 * i, true);
    else if (buffer.type === 'u8') values[i] = view.getUint8(i);
    else throw new Error(`${name}: indices are u32, u16 or u8; found ${buffer.type}`);
  }
  return values;
}
