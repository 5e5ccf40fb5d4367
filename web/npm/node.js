// Pictures of models in Node, without a browser or a GPU.

import { readFile } from 'node:fs/promises';
import { basename, dirname, join } from 'node:path';

import { TrigonError, moduleUrl, simdLevels } from './module.js';
import { collect } from './references.js';
import { Session, start } from './session.js';

export { TrigonError };

let started = null;

/** Loads the module, of the best level or of one of `simdLevels()`. Pictures do it themselves. */
export function startModule(level = simdLevels()[0]) {
  started ??= readFile(moduleUrl(level)).then((bytes) => start(new Uint8Array(bytes)));
  return started;
}

async function readIfThere(path) {
  try {
    return new Uint8Array(await readFile(path));
  } catch (error) {
    if (['ENOENT', 'ENOTDIR', 'EISDIR'].includes(error.code)) return null;
    throw error;
  }
}

/**
 * Draws the model of a file as a PNG: `{ png, facts }`. Without options it is the image that
 * `trigon-viewer model --output=picture.png` writes, byte for byte.
 */
export async function render(path, options = {}) {
  const { width = 1000, height = 600, samples = 3, display = 'shaded', surface = 'surface', background = '' } = options;
  await startModule();
  const [folder, name] = [dirname(path), basename(path)];
  const files = await collect(name, (inside) => readIfThere(join(folder, inside)));
  if (files.size === 0) throw new TrigonError({ kind: 'Read', file: path, message: `${path}: there is no such file; check the name and the folder` });
  const session = new Session();
  try {
    const facts = session.load(files, name);
    session.call('resize', width, height);
    session.call('setSamples', samples);
    session.call('setDisplay', display);
    session.call('setStyle', surface);
    if (!session.call('setBackground', background)) {
      throw new TrigonError({ kind: 'Render', message: `background: ${background} is no colour of CSS` });
    }
    session.call('reset');
    session.draw(width, height);
    return { png: session.png(), facts };
  } finally {
    session.close();
  }
}
