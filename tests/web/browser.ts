// SPDX-License-Identifier: BSD-3-Clause
// Opens the built page with a document in it, as the program writes it, in headless Chromium.
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const CHROMIUM = process.env['TOPOSCOPE_CHROMIUM'] ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find((path) => existsSync(path));

// Software rendering, and nothing that reaches for a network.
const FLAGS = [
  '--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  // A machine that is busy for half a minute is not a fault of the page.
  '--disable-gpu-watchdog', '--disable-hang-monitor',
];

const PATIENCE_MS = 120_000;

export function launch(): Promise<Browser> {
  if (!CHROMIUM) throw new Error('chromium is not there: run scripts/install-deps, or name it in TOPOSCOPE_CHROMIUM');
  return chromium.launch({ executablePath: CHROMIUM, args: FLAGS, timeout: PATIENCE_MS });
}

export const folder = mkdtempSync(join(tmpdir(), 'toposcope-page-'));

/** Puts a document into the template as the program does. */
export function written(template: string, document: unknown, name: string): string {
  const marker = '<script type="application/json" id="toposcope-data">null</script>';
  const page = readFileSync(template, 'utf8'), at = page.indexOf(marker);
  if (at < 0 || page.indexOf(marker, at + 1) >= 0) throw new Error(`${template}: holds the data's element not just once`);
  const filled = marker.replace('null', () => JSON.stringify(document).replace(/</g, '\\u003c'));
  mkdirSync(folder, { recursive: true });
  const path = join(folder, name);
  writeFileSync(path, page.slice(0, at) + filled + page.slice(at + marker.length));
  return path;
}

export interface Opened {
  page: Page;
  /** Errors of the console and of the page, and requests beyond the file itself. */
  faults: string[];
}

export async function open(browser: Browser, path: string, options: BrowserContextOptions = {}): Promise<Opened> {
  const context = await browser.newContext({ viewport: { width: 1190, height: 600 }, reducedMotion: 'reduce', acceptDownloads: true, ...options });
  context.setDefaultTimeout(PATIENCE_MS);
  const page = await context.newPage(), faults: string[] = [], url = pathToFileURL(path).href;
  page.on('console', (message) => message.type() === 'error' && faults.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => faults.push(`page: ${error.message}`));
  page.on('request', (request) => {
    if (request.url() !== url && !/^(data|blob):/.test(request.url())) faults.push(`request: ${request.url()}`);
  });
  await page.goto(url);
  return { page, faults };
}

export const idle = (page: Page): Promise<unknown> => page.waitForFunction(() => window.toposcope!.idle());

export type Rgb = [number, number, number];

export interface Pixels {
  /** By the window's coordinates, as those of a click. */
  at(x: number, y: number): Rgb;
}

/** The view's pixels, as a reader sees them. */
export async function pixels(page: Page): Promise<Pixels> {
  await idle(page);
  const clip = (await page.locator('.viewer').boundingBox())!;
  const png = (await page.screenshot({ clip })).toString('base64');
  const { width, data } = await page.evaluate(async (text) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    const bytes = context.getImageData(0, 0, image.width, image.height).data;
    let packed = '';
    for (let i = 0; i < bytes.length; i += 4) packed += String.fromCharCode(bytes[i]!, bytes[i + 1]!, bytes[i + 2]!);
    return { width: image.width, data: packed };
  }, png);
  return {
    at: (x, y) => {
      const i = 3 * (Math.round(x - clip.x) + width * Math.round(y - clip.y));
      return [0, 1, 2].map((k) => data.charCodeAt(i + k)) as Rgb;
    },
  };
}

export const hex = (color: string): Rgb => [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16)) as Rgb;

export const distance = (a: Rgb, b: Rgb): number => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The hue in degrees and the saturation from 0 to 1 (HSV): light changes neither much. */
export function hue([r, g, b]: Rgb): { hue: number; saturation: number } {
  const high = Math.max(r, g, b), low = Math.min(r, g, b), range = high - low;
  if (range === 0) return { hue: 0, saturation: 0 };
  const sector = high === r ? ((g - b) / range + 6) % 6 : high === g ? (b - r) / range + 2 : (r - g) / range + 4;
  return { hue: 60 * sector, saturation: range / high };
}

export function likeHue(a: Rgb, b: Rgb, degrees = 25): boolean {
  const d = Math.abs(hue(a).hue - hue(b).hue);
  return Math.min(d, 360 - d) <= degrees && hue(a).saturation > 0.25;
}
