#!/usr/bin/env node
// trigon-render model.glb picture.png [--size=1000x600] [--samples=3] [--display=shaded] [--surface=surface] [--background=white]

import { writeFile } from 'node:fs/promises';
import { parseArgs } from 'node:util';

import { render } from './node.js';

const text = { type: 'string' };
try {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { size: text, samples: text, display: text, surface: text, background: text },
  });
  const size = /^(\d+)[x,](\d+)$/.exec(values.size ?? '1000x600');
  if (positionals.length !== 2 || size === null) {
    throw new Error('give a model, a picture, and perhaps --size=1000x600, --samples, --display, --surface, --background');
  }
  const [, width, height] = size.map(Number);
  const { display, surface, background } = values;
  const samples = Number(values.samples ?? 3);
  const { png, facts } = await render(positionals[0], { width, height, samples, display, surface, background });
  for (const { message } of facts.warnings) console.error(`warning: ${message}`);
  await writeFile(positionals[1], png);
} catch (error) {
  console.error(`error: ${error.message}`);
  process.exitCode = 1;
}
