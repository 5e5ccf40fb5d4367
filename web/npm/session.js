// A model and its images, in the thread that calls: a worker of the page, or Node.

import initAsync, { Files, Measurement, Model, initSync, simdLevel } from './wasm/trigon.js';
import { TrigonError } from './module.js';

let exports = null;

/** Compiles the module: `source` is its address or its bytes. */
export async function start(source) {
  const module_or_path = source;
  exports = source instanceof Uint8Array ? initSync({ module: source }) : await initAsync({ module_or_path });
  return simdLevel();
}

/** The bytes of memory that the module has. They are never given back. */
export const memory = () => exports.memory.buffer.byteLength;

/** A model. Errors are `TrigonError`s. */
export class Session {
  #model = null;

  /**
   * Takes the place of the model before, unless it fails: `files` is a map of bytes by path, and `path` one of these.
   */
  load(files, path) {
    const given = new Files();
    for (const [name, bytes] of files) given.add(name, bytes);
    const models = given.models();
    const chosen = path ?? models[0];
    if (chosen === undefined) {
      given.free();
      const names = [...files.keys()].slice(0, 3).join(', ');
      throw new TrigonError({ kind: 'Unsupported', file: names, message: `${names}: there is no model among these files` });
    }
    // Takes `given` over, whatever happens.
    const model = this.#attempt(() => Model.load(given, chosen));
    this.close();
    this.#model = model;
    return { path: chosen, models, ...JSON.parse(this.#model.facts()) };
  }

  get isLoaded() {
    return this.#model !== null;
  }

  /** Calls a method of the module's model that changes the view; does nothing without a model. */
  call(method, ...parameters) {
    return this.#model === null ? undefined : this.#attempt(() => this.#model[method](...parameters));
  }

  /** Draws an image. Its bytes lie in the module's memory, and are valid until the next call. */
  draw(width, height, isDraft = false) {
    this.call('resize', width, height);
    this.call('draw', isDraft);
    return new Uint8ClampedArray(exports.memory.buffer, this.#model.pixels(), 4 * width * height);
  }

  /** The last image as a PNG file. */
  png() {
    return this.call('png');
  }

  /** Why a pixel of an image of a size looks as it does. */
  explain(x, y, width, height) {
    this.call('resize', width, height);
    return JSON.parse(this.call('explain', x, y));
  }

  /**
   * A measurement of the image of a size at many settings, which its plot calls `subject`: `step()` gives the part that is
   * done, and `result()` a JSON text. It needs a model.
   */
  measurement(width, height, subject) {
    this.call('resize', width, height);
    return this.#attempt(() => new Measurement(this.#model, subject));
  }

  /** Gives the model's memory back. */
  close() {
    this.#model?.free();
    this.#model = null;
  }

  #attempt(action) {
    try {
      return action();
    } catch (thrown) {
      throw TrigonError.from(thrown);
    }
  }
}
