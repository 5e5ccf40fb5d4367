// Mouse, fingers and keys that move the camera of an element, as in the viewer.

/** Radians, heights of the image and powers of e for one press of a key. */
const KEY = { turn: Math.PI / 24, shift: 0.05, zoom: 0.1 };
/** A line of the wheel makes the model 1.1 times as large; this many pixels are a line. */
const LINE = { power: Math.log(1.1), pixels: 40 };
/** A drag over the height of the image magnifies by e to this power. */
const ZOOM_PER_HEIGHT = 3;

export class Controls {
  #element;
  #canvas;
  #turn;
  #pointers = new Map();

  /** `turn` takes calls of the module's model. */
  constructor(element, canvas, turn) {
    [this.#element, this.#canvas, this.#turn] = [element, canvas, turn];
    canvas.addEventListener('pointerdown', (event) => this.#press(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => this.#release(event));
    canvas.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this.#key(event));
    canvas.addEventListener('contextmenu', (event) => this.#isEnabled && event.preventDefault());
  }

  /** Whether a button or a finger is down. */
  get isHeld() {
    return this.#pointers.size > 0;
  }

  get #isEnabled() {
    return this.#element.hasAttribute('camera-controls');
  }

  #press(event) {
    if (!this.#isEnabled) return;
    this.#canvas.setPointerCapture(event.pointerId);
    this.#canvas.focus({ preventScroll: true });
    this.#pointers.set(event.pointerId, { x: event.clientX, y: event.clientY, button: event.button });
    if (event.button === 1) event.preventDefault();
  }

  #move(event) {
    const pointer = this.#pointers.get(event.pointerId);
    if (pointer === undefined) return;
    const [right, down] = [event.clientX - pointer.x, event.clientY - pointer.y].map((way) => way / this.#canvas.clientHeight);
    const before = this.#span();
    [pointer.x, pointer.y] = [event.clientX, event.clientY];
    if (this.#pointers.size === 2) {
      const zoom = Math.log(this.#span() / before);
      return this.#turn([['pan', right / 2, down / 2], ...(Number.isFinite(zoom) ? [['zoom', zoom]] : [])]);
    }
    if (this.#pointers.size > 2) return;
    if (pointer.button === 2) return this.#turn([['zoom', -down * ZOOM_PER_HEIGHT]]);
    if (pointer.button === 1 || event.shiftKey) return this.#turn([['pan', right, down]]);
    if (event.ctrlKey) return this.#turn([['roll', right * Math.PI]]);
    this.#turn([['drag', right, down]]);
  }

  /** The distance between two fingers. */
  #span() {
    const [a, b] = [...this.#pointers.values()];
    return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  }

  #release(event) {
    this.#pointers.delete(event.pointerId);
  }

  #wheel(event) {
    if (!this.#isEnabled) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY : event.deltaY / LINE.pixels;
    this.#turn([['zoom', -Math.max(-10, Math.min(10, lines)) * LINE.power]]);
  }

  #key(event) {
    if (!this.#isEnabled || event.altKey || event.metaKey) return;
    const action = this.#keyAction(event);
    if (action === null) return;
    event.preventDefault();
    action();
  }

  #keyAction({ key, ctrlKey, shiftKey }) {
    const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key] ?? [0, 0];
    if ((x !== 0 || y !== 0) && ctrlKey && shiftKey) return () => this.#turn([['pan', -x * KEY.shift, y * KEY.shift]]);
    if (x !== 0 || y !== 0) return () => this.#turn([['orbit', x * KEY.turn, y * KEY.turn]]);
    const sides = ctrlKey ? { 1: 'back', 3: 'left', 7: 'bottom' } : { 1: 'front', 3: 'right', 7: 'top', 9: 'isometric' };
    if (sides[key]) return () => this.#element.lookFrom(sides[key]);
    if (ctrlKey) return null;
    switch (key) {
      case 'PageUp':
        return () => this.#turn([['zoom', KEY.zoom]]);
      case 'PageDown':
        return () => this.#turn([['zoom', -KEY.zoom]]);
      case 'Enter':
        return () => this.#element.resetView();
      case '2':
        return () => this.#turn([['orbit', 0, -Math.PI / 2]]);
      case '8':
        return () => this.#turn([['orbit', 0, Math.PI / 2]]);
      case '4':
        return () => this.#turn([['roll', -Math.PI / 2]]);
      case '6':
        return () => this.#turn([['roll', Math.PI / 2]]);
      case '5':
        return () => this.#element.toggleOrthographic();
      default:
        return null;
    }
  }
}
