// SPDX-License-Identifier: BSD-3-Clause
// The page that the program itself writes. Arguments by the environment: TOPOSCOPE_PROGRAM.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Browser } from 'playwright-core';
import { STAGES } from '@page/state';
import { folder, idle, launch, open } from './browser';

const program = process.env['TOPOSCOPE_PROGRAM'] ?? 'toposcope';
const run = (...words: string[]): string => execFileSync(program, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
let browser: Browser;

before(async () => {
  mkdirSync(folder, { recursive: true });
  browser = await launch();
  run('sample', 'cup', '--faces', '20000', '-o', 'cup.ply');
  run('run', 'cup.ply', '--model', 'cup', '--out', 'results', '-q');
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

test('run writes a page that shows its result', async () => {
  const report = join(folder, 'results/cup/report.html');
  assert.ok(statSync(report).size < 3e6, `${statSync(report).size} bytes for a cup of 20,000 faces`);
  const { page, faults } = await open(browser, report);
  await idle(page);
  const result = JSON.parse(readFileSync(join(folder, 'results/cup/result.json'), 'utf8'));
  const names = await page.$$eval('.panels [data-key^="feature:"]', (rows) => rows.map((row) => row.getAttribute('data-key')!.slice(8)));
  assert.deepEqual(names, Object.keys(result.features));
  assert.deepEqual((await page.$$eval('.label', (labels) => labels.map((label) => label.textContent!))).sort(), [...names].sort(), 'all are found and named in the view');
  assert.equal(await page.locator('.relation').count(), result.relations.length);
  // A click on the middle of a face of the rim selects the rim.
  const { radius, center } = result.features.rim.parameters;
  for (const stage of STAGES) {
    await page.click(`[data-stage="${stage}"]`);
    await idle(page);
  }
  assert.match((await page.textContent('[data-stage="marks"]'))!, /points/, "the sample's exact truth");
  await page.click('[data-stage="found"]');
  let lowest: [number, number] = [0, -Infinity];
  for (let a = 0; a < 2 * Math.PI; a += 0.05) {
    const at = await page.evaluate((p) => window.toposcope!.project(p as [number, number, number]), [center[0] + radius * Math.cos(a), center[1] + radius * Math.sin(a), center[2]]);
    if (at[1] > lowest[1]) lowest = at;
  }
  await page.mouse.click(...lowest);
  assert.equal(await page.evaluate(() => window.toposcope!.state().feature), 'rim');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('marks that the page saves are truth that evaluate reads', async () => {
  // Without the truth of the sample: all marks are made in the page.
  copyFileSync(join(folder, 'cup.ply'), join(folder, 'mine.ply'));
  run('run', 'mine.ply', '--model', 'cup', '--out', 'results', '-q');
  const { page, faults } = await open(browser, join(folder, 'results/mine/report.html'));
  await idle(page);
  const { rim, handleCon } = JSON.parse(readFileSync(join(folder, 'results/mine/result.json'), 'utf8')).features;
  await page.click('[data-stage="marks"]');
  await page.click('[data-key="mark:rim"]');
  const { radius, center } = rim.parameters;
  let marked = 0;
  for (let a = 0; a < 2 * Math.PI; a += Math.PI / 12) {
    const [x, y] = await page.evaluate((p) => window.toposcope!.project(p as [number, number, number]), [center[0] + radius * Math.cos(a), center[1] + radius * Math.sin(a), center[2]]);
    await page.mouse.click(x, y);
    ++marked;
  }
  assert.ok(marked > 20 && handleCon.present);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-key="marks:save"]')]);
  assert.equal(download.suggestedFilename(), 'mine.truth.json');
  copyFileSync((await download.path())!, join(folder, 'mine.truth.json'));
  const file = JSON.parse(readFileSync(join(folder, 'mine.truth.json'), 'utf8'));
  assert.ok(file.features.rim.points.length > 10);
  assert.deepEqual(faults, []);
  await page.context().close();

  writeFileSync(join(folder, 'mine.yaml'), 'schema: toposcope.dataset/1\nname: mine\nsummary: a cup marked in the page\nmodel: cup\nmeshes:\n  - {files: mine.ply}\n');
  const { features } = JSON.parse(run('evaluate', 'mine.yaml', '--json')).datasets[0];
  assert.deepEqual(Object.keys(features).filter((name) => name !== 'all'), ['rim'], 'the features that were marked');
  assert.equal(features.rim.right, 1);
  assert.ok(features.rim.mean_edges < 1, `${features.rim.mean_edges} mean edges from the marks`);
});

test('render has the stages of the page, by the same names', () => {
  const pictures = run('render', 'results/cup', '--stage', 'all', '--size', '160x120').trim().split('\n');
  assert.deepEqual([...new Set(pictures.map((path) => basename(path).replace(/(-.*)?\.png$/, '')))], [...STAGES]);
});

test('compare writes an index with the labelers side by side', async () => {
  run('compare', 'cup.ply', '--model', 'cup', '--labelers', 'least-error,backtracking', '--out', 'compared');
  const index = JSON.parse(readFileSync(join(folder, 'compared/index.json'), 'utf8'));
  const { page, faults } = await open(browser, join(folder, 'compared/index.html'));
  await page.waitForSelector('.views canvas');
  assert.deepEqual(await page.$$eval('.views figcaption b', (names) => names.map((name) => name.textContent)), index.views.map((view: { name: string }) => view.name));
  assert.equal(index.views.length, 2);
  assert.equal(await page.locator('.gallery .card').count(), 1);
  assert.ok(await page.locator('.gallery img').evaluate((image) => (image as HTMLImageElement).naturalWidth > 50), 'a thumbnail');
  assert.equal(await page.locator('table').count(), index.tables.length);
  assert.equal(await page.locator('table >> nth=0 >> tbody >> tr').count(), index.tables[0].rows.length);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('evaluate writes an index with reports behind its thumbnails', async () => {
  writeFileSync(join(folder, 'cups.yaml'), 'schema: toposcope.dataset/1\nname: cups\nsummary: one cup\nmodel: cup\nmeshes:\n  - {files: cup.ply}\n');
  run('evaluate', 'cups.yaml', '--out', 'evaluated', '--reports');
  const { page, faults } = await open(browser, join(folder, 'evaluated/index.html'));
  assert.equal(await page.locator('.figures figure').count() > 0, true, 'a reliability diagram');
  const report = await page.getAttribute('.gallery a', 'href');
  assert.ok(statSync(join(folder, 'evaluated', report!)).size > 5e5);
  assert.deepEqual(faults, []);
  await page.context().close();
});
