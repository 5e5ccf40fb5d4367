// <trigon-viewer src="model.glb" camera-controls>: shows a model, drawn by trigon in a worker.

import { Controls } from './controls.js';
import { collect } from './references.js';
import { TrigonError, simdLevels } from './module.js';

export { TrigonError };

/** More pixels than these are not drawn: the image is enlarged instead. */
const MOST_PIXELS = 2_500_000;
const DEGREE = Math.PI / 180;

const STYLE = `
  :host { display: block; position: relative; width: 300px; height: 150px; contain: strict; }
  canvas { width: 100%; height: 100%; display: block; outline: none; touch-action: none; }
  canvas:focus-visible { outline: 2px solid Highlight; outline-offset: -2px; }
  :host(:not([camera-controls])) canvas { touch-action: auto; }
  .poster { position: absolute; inset: 0; background: center / contain no-repeat; pointer-events: none; }
  .poster[hidden] { display: none; }
`;

/** A length or an angle of an attribute: `45deg`, `0.8rad`, `2m`, `105%`, `auto`. */
function quantity(text) {
  const [, number, unit] = /^(-?\d*\.?\d+)(deg|rad|m|cm|mm|%)$/.exec(text ?? '') ?? [];
  const scale = { deg: DEGREE, rad: 1, m: 1, cm: 0.01, mm: 0.001, '%': 0.01 }[unit];
  return scale === undefined ? null : { value: Number(number) * scale, unit };
}

/** Browsers start workers of the page's own origin only; such a one may import from where this package is served. */
const WORKER = (() => {
  const address = new URL('./worker.js', import.meta.url);
  if (address.origin === location.origin) return address;
  return URL.createObjectURL(new Blob([`import ${JSON.stringify(address)};`], { type: 'text/javascript' }));
})();

/** A number from 1 on. */
function whole(text, usual, most) {
  return Math.min(most, Math.max(1, Number.parseInt(text, 10) || usual));
}

export class TrigonViewerElement extends HTMLElement {
  static observedAttributes = [
    'src', 'alt', 'camera-orbit', 'field-of-view', 'exposure', 'poster', 'background', 'display', 'surface', 'samples', 'edge-samples',
    'glass-bounces', 'auto-rotate', 'autoplay', 'animation-name', 'tabindex',
  ];

  #canvas = document.createElement('canvas');
  #poster = document.createElement('div');
  #worker = null;
  #started = null;
  #requests = new Map();
  #number = 0;
  #size = [1, 1];
  #facts = null;
  #controls = new Controls(this, this.#canvas, (calls) => this.#turn(calls));
  #resizes = null;
  #loads = 0;
  #frame = null;
  #time = 0;
  #isFitted = true;
  #views = 0;
  #shown = null;

  constructor() {
    super();
    const style = document.createElement('style');
    style.textContent = STYLE;
    this.#poster.className = 'poster';
    this.#canvas.tabIndex = 0;
    this.#canvas.setAttribute('role', 'img');
    this.attachShadow({ mode: 'open' }).append(style, this.#canvas, this.#poster);
  }

  /** What is known of the model: counts, sizes, animations and warnings; `null` without a model. */
  get facts() {
    return this.#facts;
  }

  /** The SIMD level of the module that draws: `simd128` or `scalar`. Set it before the element is in a page. */
  level = simdLevels()[0];

  connectedCallback() {
    this.#resizes = new ResizeObserver(() => this.#fill());
    this.#resizes.observe(this);
    this.#fill();
    if (this.hasAttribute('src') && this.#facts === null) this.#loadSource();
    this.#animateIfNeeded();
  }

  disconnectedCallback() {
    this.#resizes.disconnect();
    this.#resizes = null;
    cancelAnimationFrame(this.#frame);
    this.#frame = null;
    this.#stop(new TrigonError({ kind: 'Cancelled', message: 'the element was removed' }));
    this.#facts = null;
  }

  attributeChangedCallback(name, before, after) {
    if (before === after) return;
    // Attributes of a document are there before the element is connected.
    if (name === 'src' && this.#resizes !== null) this.#loadSource();
    if (name === 'alt') this.#canvas.setAttribute('aria-label', after ?? '');
    if (name === 'poster') this.#poster.style.backgroundImage = after ? `url(${JSON.stringify(after)})` : '';
    if (name === 'auto-rotate' || name === 'autoplay') this.#animateIfNeeded();
    const calls = this.#callsOf(name);
    if (calls.length > 0) this.#view(calls);
  }

  /**
   * Shows a model of files: a `Map` of bytes by path, or a list of `File`s. `path` names one of several models. Gives what is
   * known of it.
   */
  async load(files, path) {
    const number = ++this.#loads;
    try {
      const given = files instanceof Map ? files : await readFiles(files);
      await this.#start();
      const facts = await this.#ask('load', { files: given, path });
      if (number !== this.#loads) return facts;
      this.#facts = facts;
      this.#time = 0;
      this.#isFitted = true;
      const names = TrigonViewerElement.observedAttributes;
      this.#view(names.flatMap((name) => this.#callsOf(name)));
      this.#animateIfNeeded();
      this.dispatchEvent(new CustomEvent('load', { detail: facts }));
      return facts;
    } catch (thrown) {
      this.#report(thrown);
      throw thrown;
    }
  }

  /** The image as a PNG file. */
  async toBlob() {
    return new Blob([await this.#ask('png')], { type: 'image/png' });
  }

  /** Why a pixel of the image looks as it does; in pixels of the page from the element's upper left corner. */
  explain(x, y) {
    const part = this.#size[0] / this.clientWidth;
    return this.#ask('explain', { x: Math.floor(x * part), y: Math.floor(y * part) });
  }

  /**
   * What the image costs at many settings, and how wrong it then is: a plot as SVG, whose first circles are the dots in
   * their order, and the dots. `progress` events have the part that is done. Whatever changes the image cancels it.
   */
  measure() {
    const [width, height] = this.#size;
    return this.#ask('measure', { subject: `${this.#facts?.path}, ${width}×${height}, 1 thread, ${this.level}` });
  }

  cancelMeasurement() {
    this.#worker?.postMessage({ request: 'cancel' });
  }

  /** The whole image once it is drawn, at once if it is. Rejects with an error that is reported before. */
  settled() {
    if (this.#shown?.isDraft === false) return Promise.resolve(this.#shown);
    return new Promise((resolve, reject) => {
      const end = (settle, detail) => {
        this.removeEventListener('render', rendered);
        this.removeEventListener('error', failed);
        settle(detail);
      };
      const rendered = ({ detail }) => {
        if (!detail.isDraft && this.#shown === detail) end(resolve, detail);
      };
      const failed = ({ detail }) => end(reject, detail);
      this.addEventListener('render', rendered);
      this.addEventListener('error', failed);
    });
  }

  /** The bytes of memory that the module has. */
  memory() {
    return this.#ask('memory');
  }

  /** Looks from the upper right in front, so that the model fills the image. */
  resetView() {
    this.#isFitted = true;
    this.#view([['reset'], ...this.#callsOf('camera-orbit')]);
  }

  /** Looks from `front`, `back`, `left`, `right`, `top`, `bottom` or `isometric`. */
  lookFrom(side) {
    this.#view([['lookFrom', side]]);
  }

  /** Switches between perspective and parallel lines of sight. */
  toggleOrthographic() {
    this.#view([['toggleOrthographic']]);
  }

  // Loading

  async #loadSource() {
    const source = this.getAttribute('src');
    if (!source) return;
    const address = new URL(source, document.baseURI);
    const name = decodeURIComponent(address.pathname.split('/').at(-1)) || 'model';
    try {
      const files = await collect(name, async (path) => {
        const other = path === name ? address : new URL(path.split('/').map(encodeURIComponent).join('/'), address);
        const response = await fetch(other);
        if (response.ok) return new Uint8Array(await response.arrayBuffer());
        if (path !== name) return null;
        throw new TrigonError({ kind: 'Read', file: source, message: `${source}: cannot be read (${response.status} ${response.statusText}); check the address` });
      });
      if (source === this.getAttribute('src')) await this.load(files, name).catch(() => {});
    } catch (thrown) {
      this.#report(thrown instanceof TypeError ? new TrigonError({ kind: 'Read', file: source, message: `${source}: cannot be read (${thrown.message}); check the address` }) : thrown);
    }
  }

  #start() {
    if (this.#worker !== null) return this.#started;
    const worker = new Worker(WORKER, { type: 'module' });
    this.#worker = worker;
    worker.onmessage = ({ data }) => this.#receive(data);
    worker.onerror = ({ message }) => this.#stop(new TrigonError({ kind: 'Read', message: `the renderer cannot be loaded (${message ?? 'see the console'}); check that all files of trigon-viewer are served` }));
    this.#started = this.#ask('start', { level: this.level });
    return this.#started;
  }

  #stop(error) {
    this.#worker?.terminate();
    this.#worker = null;
    this.#shown = null;
    for (const { reject } of this.#requests.values()) reject(error);
    this.#requests.clear();
  }

  #ask(request, more = {}) {
    if (this.#worker === null) return Promise.reject(new TrigonError({ kind: 'Empty', message: 'there is no model' }));
    const id = ++this.#number;
    return new Promise((resolve, reject) => {
      this.#requests.set(id, { resolve, reject });
      this.#worker.postMessage({ request, id, ...more });
    });
  }

  #receive({ event, id, answer, error, ...image }) {
    if (event === 'image') return this.#show(image);
    if (event === 'progress') return this.dispatchEvent(new CustomEvent('progress', { detail: image.part }));
    const waiting = this.#requests.get(id);
    this.#requests.delete(id);
    if (event === 'answer') return waiting?.resolve(answer);
    const thrown = new TrigonError(error);
    // A module that stopped cannot go on: the next model gets a new one.
    if (thrown.kind === 'Stopped') {
      this.#stop(thrown);
      this.#facts = null;
    }
    if (waiting) waiting.reject(thrown);
    else this.#report(thrown);
  }

  #report(thrown) {
    const error = TrigonError.from(thrown);
    this.dispatchEvent(new CustomEvent('error', { detail: error }));
  }

  // Images

  #show({ view, bytes, width, height, isDraft, time }) {
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      [this.#canvas.width, this.#canvas.height] = [width, height];
    }
    this.#canvas.getContext('2d').putImageData(new ImageData(bytes, width, height), 0, 0);
    this.#poster.hidden = true;
    const detail = { width, height, isDraft, time };
    // The worker may have been drawing the view before.
    if (view === this.#views) this.#shown = detail;
    this.dispatchEvent(new CustomEvent('render', { detail }));
  }

  #fill() {
    const [width, height] = [this.clientWidth, this.clientHeight];
    if (width === 0 || height === 0) return;
    const part = Math.min(devicePixelRatio, 2, Math.sqrt(MOST_PIXELS / (width * height)));
    const size = [width, height].map((side) => Math.max(1, Math.round(side * part)));
    if (size[0] === this.#size[0] && size[1] === this.#size[1]) return;
    this.#size = size;
    this.#view([]);
  }

  #view(calls, isMoving = false) {
    if (this.#facts === null || this.#worker === null) return;
    this.#shown = null;
    const resized = [['resize', ...this.#size]];
    if (this.#isFitted && !this.hasAttribute('camera-orbit')) resized.push(['fit']);
    this.#views += 1;
    this.#worker.postMessage({ request: 'view', view: this.#views, size: this.#size, calls: [...resized, ...calls], isMoving });
  }

  /** The camera was moved by hand. */
  #turn(calls) {
    this.#isFitted = false;
    this.#view(calls, true);
    this.dispatchEvent(new CustomEvent('camera-change'));
  }

  // Attributes

  #callsOf(name) {
    const value = this.getAttribute(name);
    switch (name) {
      case 'camera-orbit':
        return value === null ? [] : this.#orbitCalls(value);
      case 'field-of-view': {
        const angle = quantity(value)?.value ?? 30 * DEGREE;
        return [['setFieldOfView', angle], ...this.#callsOf('camera-orbit')];
      }
      case 'exposure':
        return [['setLight', Number(value ?? 1) >= 0 ? Number(value ?? 1) : 1]];
      case 'background':
        return [['setBackground', value ?? '']];
      case 'display':
        return [['setDisplay', value ?? 'shaded']];
      case 'surface':
        return [['setStyle', value ?? 'surface']];
      case 'samples':
        return [['setSamples', whole(value, 3, 4)]];
      case 'edge-samples':
        return [['setEdgeSamples', 2 ** Math.floor(Math.log2(whole(value, 1, 16)))]];
      case 'glass-bounces':
        return [['setGlassBounces', whole(value, 8, 16)]];
      default:
        return [];
    }
  }

  /** `theta phi radius`: from the front to the right, from the top downwards, and a distance. */
  #orbitCalls(text) {
    const [theta, phi, radius] = text.trim().split(/\s+/).map(quantity);
    const azimuth = theta?.value ?? 0;
    const elevation = Math.PI / 2 - (phi?.value ?? 75 * DEGREE);
    if (radius?.unit === '%') return [['setOrbit', azimuth, elevation], ['zoom', -Math.log(radius.value)]];
    return [['setOrbit', azimuth, elevation, radius?.value]];
  }

  // Movement without hands

  #animateIfNeeded() {
    const isMoving = () => this.hasAttribute('auto-rotate') || (this.hasAttribute('autoplay') && this.#animation() !== null);
    if (this.#frame !== null || this.#facts === null || !this.isConnected || !isMoving()) return;
    let before = null;
    const step = (now) => {
      this.#frame = null;
      if (!isMoving() || this.#facts === null) return;
      const seconds = before === null ? 0 : Math.min((now - before) / 1000, 0.1);
      before = now;
      this.#advance(seconds);
      this.#frame = requestAnimationFrame(step);
    };
    this.#frame = requestAnimationFrame(step);
  }

  #advance(seconds) {
    const calls = [];
    if (this.hasAttribute('auto-rotate') && !this.#controls.isHeld) {
      const speed = quantity(this.getAttribute('rotation-per-second'))?.value ?? 30 * DEGREE;
      calls.push(['orbit', -seconds * speed, 0]);
    }
    const animation = this.hasAttribute('autoplay') ? this.#animation() : null;
    if (animation !== null) {
      this.#time += seconds;
      const { duration } = this.#facts.animations[animation];
      calls.push(['animate', animation, duration > 0 ? this.#time % duration : 0]);
    }
    if (calls.length > 0) {
      this.#isFitted = false;
      this.#view(calls, true);
    }
  }

  #animation() {
    const name = this.getAttribute('animation-name');
    const animations = this.#facts?.animations ?? [];
    const index = name === null ? 0 : animations.findIndex((animation) => animation.name === name);
    return index >= 0 && index < animations.length ? index : null;
  }
}

/** Bytes by path. A folder that was chosen gives its files their paths. */
async function readFiles(files) {
  const read = async (file) => [file.webkitRelativePath || file.name, new Uint8Array(await file.arrayBuffer())];
  return new Map(await Promise.all([...files].map(read)));
}

customElements.define('trigon-viewer', TrigonViewerElement);
