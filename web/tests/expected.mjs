// What tests/corpus and tests/manifest expect.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { corpus, root } from './paths.mjs';

const rows = (path) => readFileSync(path, 'utf8').split('\n').filter((line) => line && !line.startsWith('#'));

/** The lines of the manifest in alphabetical order: a hash and a name each. */
export const manifest = () => rows(join(root, 'tests/manifest/pictures.txt')).sort();

/** What each model of the corpus must do. */
export const models = () =>
  rows(join(corpus, 'expected.txt')).map((row) => {
    const [outcome, model, ...words] = row.split(/\s+/);
    return { outcome, model, words: words.join(' ') };
  });
