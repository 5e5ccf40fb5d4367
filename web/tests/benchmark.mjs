// Times of first pictures and of images, beside three.js on SwiftShader in the same Chromium; after `.ci/web build`:
// node web/tests/benchmark.mjs [ROUNDS]. Writes the table of docs/web.md.

import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

import { built, root, site } from './paths.mjs';
import { serve } from './serve.mjs';
import { torus } from './torus.mjs';

const rounds = Number(process.argv[2] ?? 5);
/** Images of one measurement. */
const IMAGES = 20;

const made = join(built, 'models');
mkdirSync(made, { recursive: true });
for (const [name, around, across] of [['torus-7k', 100, 35], ['torus-70k', 350, 100], ['torus-500k', 1000, 250]]) {
  writeFileSync(join(made, `${name}.glb`), torus(around, across));
}
const MODELS = {
  mug: '/crates/study/models/mug.obj',
  chair: '/crates/study/models/chair.obj',
  'torus, 7,000 triangles': '/models/torus-7k.glb',
  'torus, 70,000 triangles': '/models/torus-70k.glb',
  'torus, 500,000 triangles': '/models/torus-500k.glb',
};

const [address, close] = await serve(site, built, join(root, 'web/tests'), root);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--headless=new', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

async function measure(program, model) {
  // A context of its own has no cache.
  const context = await browser.newContext({ viewport: { width: 1000, height: 600 } });
  const page = await context.newPage();
  await page.goto(`${address}${program}.html?model=${model}`);
  await page.waitForFunction(() => window.draw !== undefined, null, { timeout: 120_000 });
  const measured = await page.evaluate((images) => {
    const began = performance.now();
    for (let i = 1; i <= images; i += 1) window.draw(0.7 + i * 0.1);
    const time = (performance.now() - began) / images;
    return { first: window.firstPicture, image: time, versions: window.versions };
  }, IMAGES);
  await page.screenshot({ path: join(built, 'screenshots', `${program}-${model.split('/').at(-1)}.png`) });
  await context.close();
  return measured;
}

const median = (numbers) => numbers.toSorted((a, b) => a - b)[numbers.length >> 1];
const versions = new Set([`Chromium ${browser.version()}`]);
console.log('| model | first picture, ms: trigon | three.js | images per second: trigon | three.js |');
console.log('|---|--:|--:|--:|--:|');
for (const [name, model] of Object.entries(MODELS)) {
  const found = { trigon: [], three: [] };
  for (let round = 0; round < rounds; round += 1) {
    for (const program of Object.keys(found)) found[program].push(await measure(program, model));
  }
  const cells = ['first', 'image'].flatMap((what) =>
    Object.values(found).map((runs) => {
      const value = median(runs.map((run) => run[what]));
      return what === 'first' ? value.toFixed(0) : (1000 / value).toFixed(1);
    }),
  );
  for (const run of Object.values(found).flat()) versions.add(run.versions);
  console.log(`| ${[name, ...cells].join(' | ')} |`);
}
console.log(`\n${[...versions].join('; ')}; median of ${rounds} interleaved rounds`);
await browser.close();
close();
