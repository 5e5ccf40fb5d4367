// Draws in a worker, so that the page stays fluid: drafts while something moves, and the whole image once it rests.

import { TrigonError, moduleUrl } from './module.js';
import { Session, memory, start } from './session.js';

/** Milliseconds without a movement until the whole image is drawn. */
const REST = 120;
/** Milliseconds that a draft may take. */
const DRAFT = 33;
/** Sizes of drafts, as parts of the image's. */
const SCALES = [1, 0.75, 0.5, 0.375, 0.25];

const session = new Session();
let [width, height] = [1, 1];
let scale = 0;
let isDraftNext = false;
let rest = 0;
/** The number of the last view that was requested. */
let view = 0;
let timer = null;
/** What is measured now. */
let measurement = null;

function send(message, transfer = []) {
  postMessage(message, transfer);
}

function show(isDraft) {
  const part = isDraft ? SCALES[scale] : 1;
  const size = [width, height].map((side) => Math.max(1, Math.round(side * part)));
  const began = performance.now();
  const bytes = session.draw(...size, isDraft).slice();
  const time = performance.now() - began;
  if (isDraft && time > DRAFT && scale + 1 < SCALES.length) scale += 1;
  if (isDraft && time < DRAFT / 3 && scale > 0) scale -= 1;
  send({ event: 'image', view, bytes, width: size[0], height: size[1], isDraft, time }, [bytes.buffer]);
}

// Messages that have arrived meanwhile come first: of many movements only the last one is drawn.
function plan(isMoving) {
  isDraftNext = true;
  rest = isMoving ? REST : 0;
  schedule(0);
}

function schedule(delay) {
  clearTimeout(timer);
  timer = setTimeout(turn, delay);
}

function turn() {
  if (!session.isLoaded) return;
  const isDraft = isDraftNext;
  isDraftNext = false;
  try {
    show(isDraft);
    if (isDraft) schedule(rest);
  } catch (error) {
    fail(error);
  }
}

function cancel() {
  measurement?.free();
  measurement = null;
}

async function measure({ subject }) {
  cancel();
  const own = session.measurement(width, height, subject);
  measurement = own;
  for (let part = 0; part < 1; ) {
    // Messages that have arrived meanwhile come first, and cancel it.
    await new Promise((resolve) => setTimeout(resolve));
    if (measurement !== own) throw new TrigonError({ kind: 'Cancelled', message: 'the measurement was cancelled' });
    part = own.step();
    send({ event: 'progress', part });
  }
  const result = JSON.parse(own.result());
  cancel();
  return result;
}

function fail(error, id) {
  const { kind, file, message } = TrigonError.from(error);
  send({ event: 'error', id, error: { kind, file, message } });
}

const REQUESTS = {
  async start({ level }) {
    return { level: await start(moduleUrl(level)) };
  },
  load({ files, path }) {
    cancel();
    const facts = session.load(files, path);
    clearTimeout(timer);
    scale = 0;
    return facts;
  },
  png() {
    session.draw(width, height);
    return session.png();
  },
  explain({ x, y }) {
    return session.explain(x, y, width, height);
  },
  measure,
  cancel,
  memory,
  get({ method }) {
    return session.call(method);
  },
};

onmessage = async ({ data }) => {
  const { request, id } = data;
  if (request === 'view') {
    try {
      cancel();
      view = data.view;
      if (data.size) [width, height] = data.size;
      for (const [method, ...parameters] of data.calls ?? []) session.call(method, ...parameters);
      plan(data.isMoving);
    } catch (error) {
      fail(error);
    }
    return;
  }
  try {
    send({ event: 'answer', id, answer: await REQUESTS[request](data) });
  } catch (error) {
    fail(error, id);
  }
};
