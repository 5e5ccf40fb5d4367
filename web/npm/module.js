// Which of the two modules this machine runs, and how errors of the module become exceptions.

// A function with one instruction of SIMD128.
const SIMD128 = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

/** The levels that this machine has, the best first. */
export function simdLevels() {
  return WebAssembly.validate(SIMD128) ? ['simd128', 'scalar'] : ['scalar'];
}

/** The file of the module for a level. Both draw the same bytes. */
export function moduleUrl(level = simdLevels()[0]) {
  return new URL(`./wasm/trigon_${level}.wasm`, import.meta.url);
}

/** Something could not be loaded or drawn. `file` names the faulty file, if there is one. */
export class TrigonError extends Error {
  constructor({ kind, file = null, message }) {
    super(message);
    this.name = 'TrigonError';
    this.kind = kind;
    this.file = file;
  }

  /** Of what the module throws: JSON, or a trap, after which the module cannot be used any more. */
  static from(thrown) {
    if (thrown instanceof TrigonError) return thrown;
    if (typeof thrown === 'string') return new TrigonError(JSON.parse(thrown));
    if (thrown instanceof WebAssembly.RuntimeError || thrown instanceof RangeError) {
      const message = `the renderer stopped (${thrown.message}), probably for want of memory; use a smaller model or image`;
      return new TrigonError({ kind: 'Stopped', message });
    }
    return new TrigonError({ kind: 'Read', message: String(thrown?.message ?? thrown) });
  }
}
