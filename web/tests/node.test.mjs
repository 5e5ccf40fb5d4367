// The module and the package in Node.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { gunzipSync, gzipSync } from 'node:zlib';

import { manifest, models } from './expected.mjs';
import { built, corpus, levels, root, site } from './paths.mjs';

const packed = join(site, 'trigon-viewer');
const { collect } = await import(join(packed, 'references.js'));
const { Session, memory, start } = await import(join(packed, 'session.js'));

const read = (path) => {
  try {
    return new Uint8Array(readFileSync(path));
  } catch {
    return null;
  }
};

for (const level of levels) {
  test(`the manifest's pictures hash to the same at ${level}`, async () => {
    const module = await import(join(built, level, 'trigon_web_manifest.js'));
    module.initSync({ module: readFileSync(join(built, level, 'trigon_web_manifest_bg.wasm')) });
    assert.deepEqual(module.lines().sort(), manifest());
  });
}

test('every model of the corpus does what is expected, and the module goes on', async () => {
  assert.equal(await start(read(join(packed, 'wasm', `trigon_${levels[0]}.wasm`))), levels[0]);
  const session = new Session();
  for (const { outcome, model, words } of models()) {
    const [folder, name] = model.split('/');
    const files = await collect(name, async (path) => read(join(corpus, folder, path)));
    if (outcome === 'refused') {
      assert.throws(
        () => session.load(files, name),
        (error) => error.name === 'TrigonError' && error.kind !== 'Stopped' && error.message.includes(words),
        model,
      );
      continue;
    }
    const { warnings } = session.load(files, name);
    const told = warnings.map(({ message }) => message);
    if (outcome === 'clean') assert.deepEqual(told, [], model);
    else assert.ok(told.some((message) => message.includes(words)), `${model} says ${words}: ${told}`);
    session.draw(40, 30);
  }
  session.close();
});

test('memory does not grow with the number of models', async () => {
  const session = new Session();
  const name = 'cube_textured.glb';
  const load = () => {
    session.load(new Map([[name, read(join(corpus, 'ok', name))]]), name);
    session.draw(200, 150);
  };
  for (let i = 0; i < 20; i += 1) load();
  const before = memory();
  for (let i = 0; i < 500; i += 1) load();
  assert.equal(memory(), before);
  session.close();
});

test('an image is measured at many settings', () => {
  const session = new Session();
  const name = 'cube_textured.glb';
  session.load(new Map([[name, read(join(corpus, 'ok', name))]]), name);
  const measurement = session.measurement(40, 30, 'a <cube>');
  while (measurement.step() < 1);
  const { svg, dots } = JSON.parse(measurement.result());
  measurement.free();
  session.close();
  assert.match(svg, /a &lt;cube&gt;/);
  const [draft, reference] = ['draft', 'reference'].map((preset) => dots.find(({ name }) => name === preset));
  assert.deepEqual([draft.samples, draft.edgeSamples, reference.samples, reference.edgeSamples], [1, 1, 4, 16]);
  assert.ok(reference.error === 0 && draft.error > 0, `${draft.error}`);
  assert.ok(dots.every(({ milliseconds: [low, median, high] }) => low <= median && median <= high));
});

test('a file that is none is an error that names it', () => {
  const session = new Session();
  assert.throws(
    () => session.load(new Map([['a/notes.txt', new Uint8Array(3)]])),
    { name: 'TrigonError', kind: 'Unsupported', file: 'a/notes.txt' },
  );
  assert.throws(
    () => session.load(new Map([['broken.glb', new Uint8Array(3)]])),
    { name: 'TrigonError', file: 'broken.glb' },
  );
});

test('the package packs and draws pictures where it is installed', () => {
  const folder = mkdtempSync(join(tmpdir(), 'trigon-web-'));
  try {
    const run = (command, ...more) => execFileSync(command, more, { cwd: folder, encoding: 'utf8' });
    const [{ filename }] = JSON.parse(run('npm', 'pack', packed, '--json'));
    writeFileSync(join(folder, 'package.json'), '{ "private": true }');
    run('npm', 'install', '--no-audit', '--no-fund', '--offline', `./${filename}`);
    const model = join(root, 'crates/study/models/mug.obj');
    run('npx', '--no-install', 'trigon-render', model, 'mug.png', '--size=200x150');
    assert.deepEqual([...readFileSync(join(folder, 'mug.png')).subarray(1, 4)], [...Buffer.from('PNG')]);
    assert.throws(() => run('npx', '--no-install', 'trigon-render', 'none.obj', 'none.png'), /no such file/);
    assert.ok(!readdirSync(folder).includes('none.png'));
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('pictures are the bytes of the viewer', () => {
  const folder = mkdtempSync(join(tmpdir(), 'trigon-web-'));
  try {
    for (const path of ['crates/study/models/mug.obj', 'crates/study/models/chair.obj', 'tests/corpus/ok/cube_textured.glb']) {
      const model = join(root, path);
      execFileSync(process.env.TRIGON_VIEWER, [model, '--output', join(folder, 'a.png'), '--resolution=200,150']);
      execFileSync('node', [join(packed, 'render.js'), model, join(folder, 'b.png'), '--size=200x150']);
      assert.ok(readFileSync(join(folder, 'a.png')).equals(readFileSync(join(folder, 'b.png'))), path);
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('the page is small', () => {
  // As servers send it: each file by itself.
  const files = readdirSync(site, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile());
  const bytes = files.map((entry) => gzipSync(readFileSync(join(entry.parentPath, entry.name)), { level: 9 }));
  assert.ok(gunzipSync(bytes[0]).length > 0);
  const sum = bytes.reduce((sum, file) => sum + file.length, 0);
  assert.ok(sum < 6_000_000, `${sum} bytes`);
});
