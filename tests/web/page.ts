// SPDX-License-Identifier: BSD-3-Clause
// The page in a browser. Arguments by the environment: TOPOSCOPE_PAGE, the built template; TOPOSCOPE_AXE, axe-core's script.
import assert from 'node:assert/strict';
import { readFileSync, rmSync } from 'node:fs';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import type { Point } from '@schemas/scene';
import { STAGES, type Stage } from '@page/state';
import { distance, folder, hex, hue, idle, launch, likeHue, open, pixels, written, type Opened, type Rgb } from './browser';
import { AROUND, COLORS, index, RIM, scene, SET_COLORS } from './fixture';

const template = process.env['TOPOSCOPE_PAGE'] ?? 'report.html';
const axe = readFileSync(process.env['TOPOSCOPE_AXE'] ?? 'node_modules/axe-core/axe.min.js', 'utf8');
let browser: Browser, scenePage: string, indexPage: string;

before(async () => {
  browser = await launch();
  scenePage = written(template, scene(), 'beaker.html');
  indexPage = written(template, index(), 'index.html');
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

const project = (page: Page, point: Point): Promise<[number, number]> => page.evaluate((p) => window.toposcope!.project(p), point);

/** In the first view the viewer stands aslant of the model's up, z; this finds the azimuth that faces him. */
async function facing(page: Page): Promise<number> {
  let best = 0, lowest = -Infinity;
  for (let a = 0; a < 2 * Math.PI; a += Math.PI / 24) {
    const [, y] = await project(page, [34 * Math.cos(a), 34 * Math.sin(a), 30]);
    if (y > lowest) {
      lowest = y;
      best = a;
    }
  }
  return best;
}

const around = (r: number, z: number, a: number): Point => [r * Math.cos(a), r * Math.sin(a), z];

interface Look {
  color(point: Point): Promise<Rgb>;
  /** The strongest likeness to a colour within a few pixels of a point: lines are thin. */
  nearest(point: Point, color: Rgb): Promise<number>;
}

/** The view as it is now. */
async function look(page: Page): Promise<Look> {
  const image = await pixels(page);
  return {
    color: async (point) => image.at(...(await project(page, point))),
    nearest: async (point, color) => {
      const [x, y] = await project(page, point);
      let best = Infinity;
      for (let dx = -3; dx <= 3; ++dx) for (let dy = -3; dy <= 3; ++dy) best = Math.min(best, distance(image.at(x + dx, y + dy), color));
      return best;
    },
  };
}

const toStage = (page: Page, stage: Stage): Promise<void> => page.click(`[data-stage="${stage}"]`);

async function closed({ page, faults }: Opened): Promise<void> {
  assert.deepEqual(faults, []);
  await page.context().close();
}

test('every stage draws', async () => {
  const opened = await open(browser, scenePage), { page } = opened;
  await idle(page);
  await page.keyboard.press('l');
  const a = await facing(page), side = around(34, 30, a);
  const box = (await page.locator('.viewer').boundingBox())!;

  await toStage(page, 'mesh');
  const withEdges = await pixels(page), [x, y] = await project(page, side);
  assert.ok(distance(withEdges.at(x, y), withEdges.at(box.x + 4, box.y + box.height / 2)) > 20, 'the surface stands out from the ground');
  await page.keyboard.press('e');
  const without = await pixels(page);
  let changed = 0;
  for (let d = -40; d < 40; ++d) changed += distance(withEdges.at(x + d, y), without.at(x + d, y)) > 25 ? 1 : 0;
  assert.ok(changed > 2 && changed < 60, `edges are lines over the surface: ${changed} of 80 pixels`);
  await page.keyboard.press('e');

  await toStage(page, 'worksets');
  const lip = around(38, 71, a);
  let now = await look(page);
  assert.ok(likeHue(await now.color(lip), hex(SET_COLORS.convex)), 'the convex set in its colour');
  assert.ok(hue(await now.color(side)).saturation < 0.15, 'no set, no colour');
  await page.click('[data-key="type:convex"]');
  assert.ok(hue(await (await look(page)).color(lip)).saturation < 0.15, 'a type that is not wanted');
  for (let i = 0; i < 3; ++i) await page.keyboard.press(']');
  assert.ok(likeHue(await (await look(page)).color(around(35.5, 45, a)), hex(SET_COLORS.convex)), 'the third set alone');

  await toStage(page, 'candidates');
  await page.click('[data-key="candidates:rim"]');
  await page.keyboard.press(']');
  assert.equal(await page.evaluate(() => window.toposcope!.state().rank), 2);
  now = await look(page);
  assert.ok((await now.nearest(around(35, 40, a), hex(COLORS.rim))) < 30, 'the second candidate of the rim');
  assert.ok(likeHue(await now.color(around(35.5, 45, a)), hex(SET_COLORS.convex)), 'and its working set');

  await toStage(page, 'found');
  const front = around(RIM.radius, 73, a);
  now = await look(page);
  assert.ok((await now.nearest(front, hex(COLORS.rim))) < 30, 'the rim as a circle');
  assert.ok(likeHue(await now.color(lip), hex(COLORS.rim), 30), 'and its faces');
  await page.click('[data-key="labeling:1"]');
  now = await look(page);
  assert.ok((await now.nearest(around(35, 40, a), hex(COLORS.rim))) < 30, 'an alternative');
  assert.ok((await now.nearest(front, hex(COLORS.rim))) > 60);

  await toStage(page, 'marks');
  await page.click('[data-key="mark:rim"]');
  await page.mouse.click(x, y);
  const dots = await pixels(page);
  let dotted = 0;
  for (let dx = -25; dx <= 25; ++dx) for (let dy = -25; dy <= 25; ++dy) dotted += distance(dots.at(x + dx, y + dy), hex(COLORS.rim)) < 20 ? 1 : 0;
  assert.ok(dotted > 40, `the mark as a dot: ${dotted} pixels`);
  await closed(opened);
});

test('picking a face, a row or a name selects everywhere', async () => {
  const opened = await open(browser, scenePage), { page } = opened;
  await idle(page);
  const a = await facing(page), lip = around(38, 71, a);
  const pressed = (): Promise<string[]> => page.$$eval('.panels [aria-pressed="true"]', (rows) => rows.map((row) => row.getAttribute('data-key')!));
  await page.mouse.click(...(await project(page, lip)));
  assert.deepEqual((await pressed()).filter((key) => !key.startsWith('labeling')), ['feature:rim']);
  assert.match(await page.textContent('.panels .selected .detail') ?? '', /radius36 ± 0\.05/);
  assert.equal(await page.textContent('.label.selected'), 'rim');
  await page.click('[data-key="feature:bottom"]');
  assert.equal(await page.evaluate(() => window.toposcope!.state().feature), 'bottom');
  assert.ok(hue(await (await look(page)).color(lip)).saturation < 0.3, 'what is not selected grows pale');
  await page.click('.label >> text=rim');
  assert.ok(likeHue(await (await look(page)).color(lip), hex(COLORS.rim), 30));
  await page.click('[data-key="feature:bottom"]');
  assert.ok(!likeHue(await (await look(page)).color([15, 0, 0]), hex(COLORS.bottom)), 'the side lies before the bottom');
  await page.keyboard.press('f');
  assert.ok(likeHue(await (await look(page)).color([15, 0, 0]), hex(COLORS.bottom)), 'turned to see the bottom');
  await page.keyboard.press('r');
  await page.click('[data-key="relation:r1"]');
  assert.deepEqual((await pressed()).filter((key) => !key.startsWith('labeling')), ['relation:r1']);
  assert.equal(await page.locator('.panels .related').count(), 2, 'both features of the relation');
  await page.click('[data-key="feature:handle"]');
  assert.match(await page.textContent('.panels .missing .detail') ?? '', /r2 perpendicular 41° of 10°.*Proven: every candidate breaks r2 or shares its place with bottom/);
  assert.match(await page.textContent('.labels') ?? '', /handle: nearest candidate/);
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => window.toposcope!.state().feature), null);
  // On the stages before, a click goes through what lies at a place.
  await toStage(page, 'worksets');
  const clicks: (number | null)[] = [];
  for (let i = 0; i < 3; ++i) {
    await page.mouse.click(...(await project(page, lip)));
    clicks.push(await page.evaluate(() => window.toposcope!.state().set));
  }
  assert.deepEqual(clicks, [3, 0, 3], 'the smallest set first, then around');
  await closed(opened);
});

test('marks are made, deleted, saved and loaded', async () => {
  const opened = await open(browser, scenePage), { page } = opened;
  await idle(page);
  const a = await facing(page), step = (2 * Math.PI) / AROUND;
  const at = Math.round(a / step);
  await toStage(page, 'marks');
  await page.click('[data-key="mark:handle"]');
  await page.mouse.click(...(await project(page, around(34, 30, at * step))));
  await page.click('[data-key="group:1"]');
  await page.mouse.click(...(await project(page, around(36, 50, (at + 2) * step))));
  await page.mouse.click(...(await project(page, around(36, 50, (at - 2) * step))));
  await page.mouse.click(...(await project(page, around(36, 50, (at - 2) * step))));
  assert.equal(await page.textContent('[data-key="group:1"]'), 'end 2 · 1', 'a second click takes the mark away');
  await page.keyboard.press('u');
  assert.equal(await page.textContent('[data-key="group:1"]'), 'end 2 · 2', 'undone');
  await page.click('[data-key="mark:last"]');
  await page.click('[data-key="mark:bottom"]');
  await page.check('[data-key="mark:absent"]');
  const save = async (): Promise<string> => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-key="marks:save"]')]);
    assert.equal(download.suggestedFilename(), 'beaker.truth.json');
    return readFileSync((await download.path())!, 'utf8');
  };
  const text = await save(), file = JSON.parse(text);
  const vertex = (ring: number, i: number): number => ring * AROUND + ((i + AROUND) % AROUND);
  assert.deepEqual(file.features.handle.groups.map((group: { vertices: number[] }) => group.vertices), [[vertex(6, at)], [vertex(8, at + 2)]]);
  const point = file.features.handle.groups[0].points[0] as Point;
  assert.ok(Math.hypot(...around(34, 30, at * step).map((x, k) => x - point[k]!)) < 0.01, 'the vertex itself');
  assert.deepEqual([file.mesh, file.class, file.features.bottom, file.frame], ['beaker.ply', 'cup', { points: [] }, { mean_edge: 5, bbox_diagonal: Math.hypot(76, 76, 73) }]);
  assert.equal('rim' in file.features, false, 'what has no mark is not judged');

  const again = await open(browser, scenePage), other = again.page;
  await toStage(other, 'marks');
  await other.setInputFiles('input[type=file]', { name: 'beaker.truth.json', mimeType: 'application/json', buffer: Buffer.from(text) });
  await other.waitForSelector('[data-stage="marks"] >> text=2 points');
  const [download] = await Promise.all([other.waitForEvent('download'), other.click('[data-key="marks:save"]')]);
  assert.equal(readFileSync((await download.path())!, 'utf8'), text, 'saved again it is the same file');
  await other.setInputFiles('input[type=file]', { name: 'x.json', mimeType: 'application/json', buffer: Buffer.from('{"features": {"rim": {"points": [1]}}}') });
  await other.waitForSelector('.notice.error >> text=x.json: /features/rim/points/0: expected three numbers');
  await closed(again);
  await closed(opened);
});

test('all of it by keyboard', async () => {
  const opened = await open(browser, scenePage), { page } = opened;
  await idle(page);
  await page.keyboard.press('5');
  const focus = async (selector: string): Promise<void> => {
    for (let i = 0; i < 80; ++i) {
      await page.keyboard.press('Tab');
      if (await page.evaluate((wanted) => document.activeElement!.matches(wanted), selector)) return;
    }
    assert.fail(`Tab does not reach ${selector}`);
  };
  await focus('[data-key="mark:rim"]');
  await page.keyboard.press('Enter');
  assert.equal(await page.evaluate(() => document.activeElement!.getAttribute('data-key')), 'mark:rim', 'the focus stays where it was');
  await focus('.viewer');
  assert.ok(await page.isVisible('.cross'), 'the cross shows where Enter marks');
  const before = await page.evaluate(() => window.toposcope!.project([10, 0, 73]));
  for (const key of ['ArrowLeft', 'ArrowDown', '+', 'Shift+ArrowUp']) await page.keyboard.press(key);
  const moved = await page.evaluate(() => window.toposcope!.project([10, 0, 73]));
  assert.ok(Math.hypot(moved[0] - before[0], moved[1] - before[1]) > 10, 'the view turned');
  await page.keyboard.press('r');
  const back = await page.evaluate(() => window.toposcope!.project([10, 0, 73]));
  assert.ok(Math.hypot(back[0] - before[0], back[1] - before[1]) < 0.5, `and is as it was: ${before} ${moved} ${back}`);
  await page.keyboard.press('Enter');
  await page.waitForSelector('[data-stage="marks"] >> text=1 point');
  await page.keyboard.press('Delete');
  await page.waitForSelector('[data-stage="marks"] >> text=by hand');
  await page.keyboard.press('?');
  assert.ok(await page.isVisible('dialog'));
  await page.keyboard.press('Escape');
  await page.keyboard.press('o');
  assert.equal(await page.getAttribute('[data-key="tool:orthographic"]', 'aria-pressed'), 'true');
  await closed(opened);
});

test('measures stand with their deviations, or say why they have none', async () => {
  const { page, faults } = await open(browser, scenePage);
  await idle(page);
  const rows = await page.$$eval('.measured', (all) => all.map((each) => [each.getAttribute('title'), each.textContent]));
  assert.deepEqual(rows, [['distance(rim, bottom)', 'height71.25 ± 0.08'], ['distance(rim, handle)', "reach'handle' is missing"]]);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('result.json and a picture are handed out', async () => {
  const opened = await open(browser, scenePage), { page } = opened;
  await idle(page);
  const [result] = await Promise.all([page.waitForEvent('download'), page.click('[data-key="tool:download"]')]);
  assert.deepEqual(JSON.parse(readFileSync((await result.path())!, 'utf8')), JSON.parse(JSON.stringify(scene().result)));
  const [picture] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('p')]);
  assert.equal(picture.suggestedFilename(), 'beaker-found.png');
  const png = readFileSync((await picture.path())!);
  const canvas = (await page.locator('.viewer canvas').boundingBox())!;
  assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [Math.floor(canvas.width), Math.floor(canvas.height)]);
  await closed(opened);
});

test('the index: linked views, filters, sorting', async () => {
  const opened = await open(browser, indexPage), { page } = opened;
  await page.waitForSelector('.views canvas');
  const views = page.locator('.views .viewer');
  assert.equal(await views.count(), 2);
  await page.waitForTimeout(300);
  const shot = async (i: number): Promise<string> => (await views.nth(i).screenshot()).toString('base64');
  const before = [await shot(0), await shot(1)];
  await views.nth(0).focus();
  for (let i = 0; i < 3; ++i) await page.keyboard.press('ArrowRight');
  for (let i = 0; i < 3; ++i) await page.keyboard.press('ArrowUp');
  await page.waitForTimeout(300);
  const after = [await shot(0), await shot(1)];
  assert.ok(before[0] !== after[0] && before[1] !== after[1], 'turning one turns both');
  await page.click('text=linked cameras');
  await views.nth(0).focus();
  await page.keyboard.press('ArrowLeft');
  await page.waitForTimeout(300);
  assert.equal(await shot(1), after[1], 'unlinked, the other stays');

  const rows = (): Promise<string[]> => page.$$eval('table tbody tr th', (cells) => cells.map((cell) => cell.textContent!));
  await page.click('thead >> text=cost');
  assert.deepEqual((await rows())[0], 'least-error');
  assert.equal(await page.getAttribute('th:has-text("cost")', 'aria-sort'), 'ascending');
  await page.fill('input[aria-label^="Filter rows"]', 'search');
  assert.deepEqual(await rows(), ['search-9', 'search-10']);
  await page.check('text=only with faults');
  assert.equal(await page.locator('.gallery .card').count(), 1);
  assert.equal(await page.locator('.figures .chart').count(), 2);
  assert.match((await page.getAttribute('.figures .chart >> nth=1', 'aria-label'))!, /29 of 30 on the diagonal.*tee: 14 as tee, 1 as wye/);
  await closed(opened);
});

test('axe finds no serious fault, light and dark', async () => {
  for (const colorScheme of ['light', 'dark'] as const)
    for (const path of [scenePage, indexPage]) {
      const opened = await open(browser, path, { colorScheme }), { page } = opened;
      const audit = async (place: string): Promise<void> => {
        // What does not hang on colours is the same in the dark.
        const rules = colorScheme === 'light' ? {} : { runOnly: { type: 'rule', values: ['color-contrast', 'link-in-text-block'] } };
        const found = await page.evaluate(async (options) => {
          const result = await (window as unknown as { axe: { run(options: object): Promise<{ violations: { id: string; impact: string; nodes: { html: string; failureSummary: string }[] }[] }> } }).axe.run(options);
          return result.violations.filter(({ impact }) => impact === 'serious' || impact === 'critical').map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.html.slice(0, 160)} (${node.failureSummary.slice(0, 200)})`).join(' | ')}`);
        }, rules);
        assert.deepEqual(found, [], `${place}, ${colorScheme}`);
      };
      await page.evaluate(axe);
      if (path === indexPage) {
        await audit('index');
      } else {
        for (const stage of STAGES) {
          await toStage(page, stage);
          if (stage === 'candidates') await page.click('[data-key="candidates:rim"]');
          if (stage === 'found') await page.click('[data-key="feature:handle"]');
          if (stage === 'marks') await page.click('[data-key="mark:handle"]');
          await audit(stage);
        }
      }
      await closed(opened);
    }
});

test('a window as people have it: the page does not scroll, its panels do, and a relation keeps its name beside its type', async () => {
  for (const width of [1400, 1100]) {
    const opened = await open(browser, scenePage, { viewport: { width, height: 900 } }), { page } = opened;
    for (const stage of STAGES) {
      await toStage(page, stage);
      assert.equal(await page.evaluate(() => document.documentElement.scrollHeight), 900, stage);
    }
    const tops = await page.$$eval('.relation', (rows) => rows.map((row) => row.querySelector('small')!.getBoundingClientRect().top - row.getBoundingClientRect().top));
    assert.ok(tops.length === 3 && tops.every((top) => top === tops[0]), `one line before the features: ${tops}`);
    await closed(opened);
  }
});

test('a telephone: nothing scrolls sideways, the stages are at hand', async () => {
  for (const path of [scenePage, indexPage]) {
    const opened = await open(browser, path, { viewport: { width: 360, height: 740 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true }), { page } = opened;
    for (const stage of path === scenePage ? STAGES : [null]) {
      if (stage) await page.tap(`[data-stage="${stage}"]`);
      const [wide, window_] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
      assert.ok(wide! <= window_!, `${stage ?? 'index'}: ${wide} in ${window_}`);
    }
    await closed(opened);
  }
});

test('a document that the page does not know is named', async () => {
  const opened = await open(browser, written(template, { schema: 'toposcope.scene/9' }, 'other.html'));
  assert.match(await opened.page.textContent('main') ?? '', /of schema 'toposcope.scene\/9'/);
  await closed(opened);
  const empty = await open(browser, written(template, null, 'empty.html'));
  assert.match(await empty.page.textContent('main') ?? '', /holds no result/);
  await closed(empty);
});
