// The page in Chromium.

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { chromium } from 'playwright-core';

import { manifest } from './expected.mjs';
import { built, corpus, levels, root, site } from './paths.mjs';
import { serve } from './serve.mjs';

const shots = join(built, 'screenshots');
mkdirSync(shots, { recursive: true });
const cube = join(corpus, 'ok/cube_textured.glb');
const mug = join(root, 'crates/study/models/mug.obj');

let browser;
let address;
let close;

before(async () => {
  [address, close] = await serve(site, built, join(root, 'web/tests'), root);
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--headless=new'],
  });
});
after(async () => {
  await browser?.close();
  close?.();
});

async function open(size = { width: 1200, height: 760 }) {
  const page = await browser.newPage({ viewport: size });
  page.on('pageerror', (error) => assert.fail(error));
  await page.goto(address);
  return page;
}

/** Drops files on the page, as the system does. */
async function drop(page, ...paths) {
  const files = paths.map((path) => [path.split('/').at(-1), readFileSync(path).toString('base64')]);
  await page.evaluate((files) => {
    const transfer = new DataTransfer();
    for (const [name, text] of files) {
      transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
    }
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, files);
}

const settled = (page) => page.evaluate(() => document.querySelector('trigon-viewer').settled());
/** A hash of the image that is shown. */
const shown = (page) =>
  page.evaluate(async () => {
    await document.querySelector('trigon-viewer').settled();
    const canvas = document.querySelector('trigon-viewer').shadowRoot.querySelector('canvas');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const digest = await crypto.subtle.digest('SHA-256', data);
    return [...new Uint8Array(digest)].join(' ');
  });

async function openWith(paths, size) {
  const page = await open(size);
  await drop(page, ...[paths].flat());
  await page.waitForFunction(() => !document.body.classList.contains('empty'));
  await settled(page);
  return page;
}

for (const level of levels) {
  test(`the manifest's pictures hash to the same at ${level}`, async () => {
    const page = await open();
    const lines = await page.evaluate(async (level) => {
      const module = await import(`/${level}/trigon_web_manifest.js`);
      await module.default({ module_or_path: `/${level}/trigon_web_manifest_bg.wasm` });
      return module.lines();
    }, level);
    assert.deepEqual(lines.sort(), manifest());
    await page.close();
  });
}

test('an empty page says what to do', async () => {
  const page = await open();
  await page.getByText('Drop a model here').waitFor();
  await page.screenshot({ path: join(shots, 'empty.png') });
  await page.close();
});

test('a dropped model is shown, and orbits with the mouse and the keys', async () => {
  const page = await openWith(cube);
  assert.match(await page.locator('#facts').innerText(), /triangles\s+12\b/);
  const first = await shown(page);
  await page.screenshot({ path: join(shots, 'cube.png') });
  await page.mouse.move(450, 400);
  await page.mouse.down();
  await page.mouse.move(600, 430, { steps: 5 });
  await page.mouse.up();
  const turned = await shown(page);
  assert.notEqual(turned, first);
  await page.keyboard.press('ArrowLeft');
  const byKey = await shown(page);
  assert.notEqual(byKey, turned);
  await page.mouse.wheel(0, 300);
  assert.notEqual(await shown(page), byKey);
  await page.keyboard.press('Enter');
  assert.equal(await shown(page), first, 'the view is reset');
  await page.close();
});

test('a click explains a pixel', async () => {
  const page = await openWith(mug);
  await page.mouse.click(450, 400);
  await page.locator('#pixel-text').waitFor();
  assert.match(await page.locator('#pixel-name').innerText(), /face/);
  assert.match(await page.locator('#pixel-text').innerText(), /edge/);
  await page.screenshot({ path: join(shots, 'pixel.png') });
  await page.close();
});

test('an error names the file and stays until it is dismissed', async () => {
  const page = await openWith(cube);
  const before = await shown(page);
  await drop(page, join(corpus, 'glb/truncated_at_00100.glb'));
  const error = page.getByRole('alert');
  await error.waitFor();
  assert.match(await error.innerText(), /truncated_at_00100\.glb/);
  await page.waitForTimeout(1000);
  await page.screenshot({ path: join(shots, 'error.png') });
  assert.ok(await error.isVisible());
  await error.getByRole('button').click();
  assert.equal(await page.getByRole('alert').count(), 0);
  assert.equal(await shown(page), before, 'the model before is still there');
  await drop(page, mug);
  await page.locator('#name', { hasText: 'mug.obj' }).waitFor();
  assert.notEqual(await shown(page), before, 'the next model is shown');
  await page.close();
});

test('outputs and surfaces change the image', async () => {
  const page = await openWith(mug);
  const seen = new Set([await shown(page)]);
  for (const [select, value] of [['#display', 'depth'], ['#display', 'normal'], ['#surface', 'hidden-line']]) {
    await page.locator(select).selectOption(value);
    seen.add(await shown(page));
    await page.screenshot({ path: join(shots, `${value}.png`) });
  }
  assert.equal(seen.size, 4);
  await page.close();
});

test('a view is measured at many settings, and a chosen dot sets its own', async () => {
  const page = await openWith(cube, { width: 760, height: 480 });
  const before = await shown(page);
  await page.locator('#measure').click();
  await page.locator('#frontier').waitFor({ timeout: 300_000 });
  await page.screenshot({ path: join(shots, 'frontier.png') });
  const dots = await page.locator('#frontier circle[role]').evaluateAll((circles) =>
    circles.map((circle) => [circle.getAttribute('aria-label'), Number(circle.getAttribute('cx'))]),
  );
  const time = ([label]) => Number(/: ([^ ]+) ms/.exec(label)[1]);
  const byTime = dots.toSorted((a, b) => time(a) - time(b));
  assert.ok(dots.length > 10, `${dots.length} dots`);
  // Labels have three digits: dots that are as far to the right may be in either order.
  byTime.forEach(([label, x], index) => assert.ok(index === 0 || x >= byTime[index - 1][1] - 1, `${label} lies where its time is`));
  await page.locator('#frontier circle[aria-label^="reference: "]').press('Enter');
  assert.equal(await page.locator('#frontier').isVisible(), false);
  const samples = () => Promise.all(['#samples', '#edge-samples'].map((select) => page.locator(select).inputValue()));
  assert.deepEqual(await samples(), ['4', '16']);
  const reference = await shown(page);
  assert.notEqual(reference, before);
  await page.locator('#plot-again').click();
  await page.locator('#frontier circle[aria-label^="draft: "]').click();
  assert.deepEqual(await samples(), ['1', '1']);
  assert.notEqual(await shown(page), reference);
  await page.close();
});

test('whatever changes the view cancels a measurement', async () => {
  const page = await openWith(cube);
  for (const cancel of [() => page.locator('#cancel').click(), () => page.mouse.wheel(0, 300)]) {
    await page.locator('#measure').click();
    await page.waitForFunction(() => document.getElementById('measured').value > 0);
    await page.mouse.move(450, 400);
    await cancel();
    await page.locator('#measure').waitFor();
    assert.equal(await page.locator('#frontier').isVisible(), false);
    assert.equal(await page.getByRole('alert').count(), 0);
  }
  await settled(page);
  await page.close();
});

test('the page fits a telephone', async () => {
  const page = await open({ width: 390, height: 760 });
  await drop(page, mug);
  await page.waitForFunction(() => !document.body.classList.contains('empty'));
  await settled(page);
  await page.screenshot({ path: join(shots, 'telephone.png') });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await page.close();
});

test('attributes of an element change its image', async () => {
  const page = await browser.newPage({ viewport: { width: 600, height: 400 } });
  await page.goto(`${address}elements.html`);
  const seen = new Set([await shown(page)]);
  const changes = {
    background: 'transparent', exposure: '0.5', 'camera-orbit': '120deg 60deg 105%', 'field-of-view': '60deg', display: 'matcap',
    samples: '1', 'edge-samples': '4',
  };
  for (const [name, value] of Object.entries(changes)) {
    await page.evaluate(([name, value]) => document.querySelector('trigon-viewer').setAttribute(name, value), [name, value]);
    seen.add(await shown(page));
  }
  assert.equal(seen.size, 8);
  const error = await page.evaluate(() => {
    const view = document.querySelector('trigon-viewer');
    const told = new Promise((resolve) => view.addEventListener('error', ({ detail }) => resolve(detail.message)));
    view.setAttribute('src', '/none.glb');
    return told;
  });
  assert.match(error, /none\.glb/);
  await page.close();
});

test('a page may load the element from another server', async () => {
  const page = await browser.newPage();
  await page.goto(`${address.replace('127.0.0.1', 'localhost')}style.css`);
  const shown = await page.evaluate(async (address) => {
    await import(`${address}trigon-viewer/trigon-viewer.js`);
    const view = document.createElement('trigon-viewer');
    document.body.append(view);
    view.setAttribute('src', `${address}examples/mug.obj`);
    return view.settled();
  }, address);
  assert.deepEqual([shown.width, shown.height, shown.isDraft], [300, 150, false]);
  await page.close();
});

test('500 models in the page take no more memory than 20', async () => {
  const page = await openWith(cube);
  const memory = await page.evaluate(async (text) => {
    const view = document.querySelector('trigon-viewer');
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const load = () => view.load(new Map([['cube.glb', bytes]]));
    for (let i = 0; i < 20; i += 1) await load();
    await view.settled();
    const before = await view.memory();
    for (let i = 0; i < 500; i += 1) await load();
    await view.settled();
    return [before, await view.memory()];
  }, readFileSync(cube).toString('base64'));
  assert.equal(memory[1], memory[0]);
  await page.close();
});
