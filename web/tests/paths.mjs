// Where `.ci/web` has put things.

import { readdirSync, statSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { join } from 'node:path';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const built = join(root, 'target/web');
export const site = join(built, 'site');
export const corpus = join(root, 'tests/corpus');
export const LEVELS = ['simd128', 'scalar'];

/** The levels that were built: both, unless TRIGON_WEB_LEVELS names one. */
export const levels = (process.env.TRIGON_WEB_LEVELS ?? LEVELS.join(' ')).split(' ');

/** Bytes of all files of a folder and the folders in it. */
export function size(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .reduce((sum, entry) => sum + statSync(join(entry.parentPath, entry.name)).size, 0);
}
