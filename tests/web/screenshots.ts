// SPDX-License-Identifier: BSD-3-Clause
// Pictures of reports for the docs: screenshots.mjs OUT NAME=REPORT.html... For each: all stages in one picture, and the page whole.
import { mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import type { State } from '@page/state';
import { idle, launch, open } from './browser';

/** A view as it is taken, and how wide it is shown. */
const CELL = { width: 640, height: 480, shown: 500 };

interface Shot {
  title: string;
  state: Partial<State>;
}

/** The dissertation's figures: (a) to (e), and of (c) one feature with the working sets that it stands on. */
function shots(feature: string): Shot[] {
  return [
    { title: 'Mesh', state: { stage: 'mesh' } },
    { title: 'Working sets by type', state: { stage: 'worksets' } },
    { title: 'Constructed features', state: { stage: 'candidates', candidateOf: null } },
    { title: `Candidates of ${feature}, the best in bold`, state: { stage: 'candidates', candidateOf: feature, rank: 1 } },
    { title: 'Found features', state: { stage: 'found', candidateOf: null, feature: null } },
    { title: 'Marked points', state: { stage: 'marks' } },
  ];
}

async function png(page: Page, selector: string): Promise<string> {
  await idle(page);
  return `data:image/png;base64,${(await page.locator(selector).screenshot()).toString('base64')}`;
}

/** All stages of one report, side by side. */
async function stages(browser: Browser, report: string, out: string): Promise<void> {
  const { page } = await open(browser, report, { viewport: { width: CELL.width, height: CELL.height }, deviceScaleFactor: 1.5 });
  await page.addStyleTag({ content: '#page.scene{display:block!important} header,.stages,.stage,.panels,.tools.floating{display:none!important} .view-area{height:100vh!important}' });
  const feature = await page.evaluate(() => (document.querySelector('[data-key^="feature:"]') as HTMLElement).dataset['key']!.slice('feature:'.length));
  const cells: string[] = [];
  for (const { title, state } of shots(feature)) {
    await page.evaluate((change) => window.toposcope!.set(change), state);
    await page.waitForTimeout(100);
    cells.push(`<figure><img src="${await png(page, '.view')}"><figcaption><b>${String.fromCharCode(97 + cells.length)}</b> ${title}</figcaption></figure>`);
  }
  await page.setViewportSize({ width: 3 * CELL.shown + 40, height: 100 });
  await page.setContent(`<style>
    body { margin: 0; background: #fff; font: 17px system-ui, 'DejaVu Sans', sans-serif; color: #18202b; }
    main { display: inline-grid; grid-template-columns: repeat(3, ${CELL.shown}px); gap: 10px; padding: 10px; }
    figure { margin: 0; } img { display: block; width: 100%; border-radius: 10px; } figcaption { padding: 7px 4px 3px; } b { color: #0b6e6e; }
  </style><main>${cells.join('')}</main>`);
  await page.locator('main').screenshot({ path: out, type: 'jpeg', quality: 88, scale: 'css' });
  await page.context().close();
}

async function whole(browser: Browser, report: string, out: string, options: Parameters<typeof open>[2], change: Partial<State>): Promise<void> {
  const { page } = await open(browser, report, options);
  await page.evaluate((state) => window.toposcope!.set(state), change);
  await page.waitForTimeout(100);
  await idle(page);
  await page.screenshot({ path: out, type: 'jpeg', quality: 88 });
  await page.context().close();
}

const [out, ...reports] = process.argv.slice(2);
if (!out || reports.length === 0) throw new Error('usage: screenshots.mjs OUT NAME=REPORT.html...');
mkdirSync(out, { recursive: true });
const browser = await launch();
for (const [i, each] of reports.entries()) {
  const [name, report] = each.split('=') as [string, string], path = resolve(report);
  await stages(browser, path, join(out, `report-${name}-stages.jpg`));
  const size = { width: 1380, height: 860 };
  await whole(browser, path, join(out, `report-${name}.jpg`), { viewport: size, colorScheme: i % 2 ? 'dark' : 'light' }, {});
  if (i === 0) await whole(browser, path, join(out, `report-${name}-phone.jpg`), { viewport: { width: 390, height: 800 }, isMobile: true, hasTouch: true }, {});
}
await browser.close();
