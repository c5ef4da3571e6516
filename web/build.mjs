// SPDX-License-Identifier: BSD-3-Clause
// Bundles the page into one file; to be run in the folder that holds node_modules: node build.mjs OUT.html [--tests DIR].
import { build } from 'esbuild';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';

const [out, flag, tests] = process.argv.slice(2);
const common = { bundle: true, write: false, logLevel: 'warning', preserveSymlinks: true, target: 'es2022', legalComments: 'inline' };

const script = await build({ ...common, entryPoints: ['src/main.ts'], format: 'iife', minify: true });
const styles = await build({ ...common, entryPoints: ['src/styles/page.css'], minify: true });
// Nothing in a script may end its element; replacements are functions, for '$' means something in a replacement text.
const inline = (text) => text.trim().replace(/<\/(script|style)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
const page = readFileSync('page.html', 'utf8')
  .replace('/*STYLES*/', () => inline(styles.outputFiles[0].text))
  .replace('/*SCRIPT*/', () => inline(script.outputFiles[0].text));
writeFileSync(out, page);

if (flag === '--tests')
  await build({
    ...common, write: true, outdir: tests, platform: 'node', format: 'esm', outExtension: { '.js': '.mjs' }, packages: 'external',
    sourcemap: 'inline', entryPoints: readdirSync('tests').filter((name) => name.endsWith('.ts')).map((name) => `tests/${name}`),
  });
