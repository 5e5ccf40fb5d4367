import type { Display, Facts, Surface } from './trigon-viewer.js';

export { TrigonError } from './trigon-viewer.js';

export interface Options {
  /** Pixels; 1000 unless given. */
  width?: number;
  /** Pixels; 600 unless given. */
  height?: number;
  /** Along each side of a pixel, 1 to 4; 3 unless given. */
  samples?: number;
  display?: Display;
  surface?: Surface;
  /** A colour of CSS, `transparent`, or a gradient for an empty text. */
  background?: string;
}

/** Loads the module, of the best level of this machine unless one is given; gives the level. */
export function startModule(level?: 'simd128' | 'scalar'): Promise<string>;

/** Draws the model of a file as a PNG. */
export function render(path: string, options?: Options): Promise<{ png: Uint8Array; facts: Facts }>;
