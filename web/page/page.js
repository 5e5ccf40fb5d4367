// The page around a <trigon-viewer>: opens files, and shows what is known of the model and of its pixels.

import { offerFrontier } from './frontier.js';
import { save, stem } from './save.js';
import { TrigonError } from './trigon-viewer/trigon-viewer.js';

const $ = (id) => document.getElementById(id);
const view = $('view');

const DISPLAYS = [
  'shaded', 'matcap', 'base-color', 'normal', 'geometric-normal', 'uv', 'metallic', 'roughness', 'occlusion', 'emission',
  'alpha', 'depth',
];
for (const name of DISPLAYS) $('display').add(new Option(name.replace('-', ' '), name));

/** The files that are open, and which of them is shown. */
let files = new Map();

// Errors stay until they are dismissed.
function report(error) {
  const box = document.createElement('div');
  box.className = 'error';
  box.setAttribute('role', 'alert');
  const text = document.createElement('p');
  text.textContent = error.message;
  const close = document.createElement('button');
  close.textContent = '×';
  close.setAttribute('aria-label', 'Dismiss');
  close.onclick = () => box.remove();
  box.append(text, close);
  $('errors').append(box);
}
view.addEventListener('error', ({ detail }) => report(detail));

// Opening

async function open(given, path) {
  if (given.size === 0) return;
  try {
    const facts = await view.load(given, path);
    files = given;
    document.body.classList.remove('empty');
    tell(facts);
    forgetPixel();
  } catch {
    // It was reported.
  }
}

async function openList(list) {
  const read = async (file) => [file.webkitRelativePath || file.name, new Uint8Array(await file.arrayBuffer())];
  try {
    await open(new Map(await Promise.all([...list].map(read))));
  } catch (error) {
    report(error);
  }
}

/** All files of a dropped file or folder, by their paths. */
async function dropped(entry, before = '') {
  const path = before + entry.name;
  if (entry.isFile) {
    const file = await new Promise((resolve, reject) => entry.file(resolve, reject));
    return [[path, new Uint8Array(await file.arrayBuffer())]];
  }
  const reader = entry.createReader();
  const found = [];
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return found;
    for (const inner of some) found.push(...(await dropped(inner, `${path}/`)));
  }
}

for (const [button, input] of [['open', 'files'], ['folder', 'folders']]) {
  $(button).onclick = () => $(input).click();
  $(input).onchange = async () => {
    await openList($(input).files);
    $(input).value = '';
  };
}
for (const button of document.querySelectorAll('[data-open]')) button.onclick = () => $(button.dataset.open).click();
for (const button of document.querySelectorAll('[data-example]')) {
  button.onclick = async () => {
    const name = button.dataset.example;
    const response = await fetch(`examples/${name}`);
    if (response.ok) await open(new Map([[name, new Uint8Array(await response.arrayBuffer())]]));
    else report(new TrigonError({ kind: 'Read', file: name, message: `${name}: cannot be read (${response.status})` }));
  };
}

let over = 0;
addEventListener('dragenter', (event) => {
  event.preventDefault();
  over += 1;
  $('target').hidden = false;
});
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('dragleave', () => {
  over -= 1;
  $('target').hidden = over > 0;
});
addEventListener('drop', async (event) => {
  event.preventDefault();
  over = 0;
  $('target').hidden = true;
  const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (entries.length === 0) return openList(event.dataTransfer.files);
  try {
    await open(new Map((await Promise.all(entries.map((entry) => dropped(entry)))).flat()));
  } catch (error) {
    report(error);
  }
});

// What is known

const short = (length) => Number(length.toPrecision(4)).toString();
const count = (number) => number.toLocaleString('en');

function tell(facts) {
  $('name').textContent = facts.path;
  document.title = `${facts.path} – trigon`;
  const rows = [
    ['format', facts.format],
    ['triangles', count(facts.triangles)],
    ['faces', count(facts.faces)],
    ['vertices', count(facts.vertices)],
    ['nodes', count(facts.nodes)],
    ['materials', count(facts.materials)],
    ['textures', count(facts.textures)],
    ['size', facts.size.map(short).join(' × ')],
    ['files', facts.files.length > 1 ? facts.files.length : null],
    ['animations', facts.animations.length > 0 ? facts.animations.map(({ name }) => name || 'no name').join(', ') : null],
  ];
  const cells = rows.filter(([, value]) => value !== null).flatMap(([name, value]) => {
    const [term, detail] = [document.createElement('dt'), document.createElement('dd')];
    [term.textContent, detail.textContent] = [name, value];
    return [term, detail];
  });
  $('facts').replaceChildren(...cells);
  $('choice').hidden = facts.models.length < 2;
  $('models').replaceChildren(...facts.models.map((path) => new Option(path, path, false, path === facts.path)));
  $('warnings').hidden = facts.warnings.length === 0;
  $('count').textContent = facts.warnings.length;
  const items = facts.warnings.map(({ message }) => {
    const item = document.createElement('li');
    item.textContent = message;
    return item;
  });
  $('warnings').querySelector('ul').replaceChildren(...items);
}

$('models').onchange = ({ target }) => open(files, target.value);
const SAMPLES = ['samples', 'edge-samples'];
for (const name of ['display', 'surface', 'exposure', ...SAMPLES]) {
  $(name).oninput = () => {
    view.setAttribute(name, $(name).value);
    // A setting of the plot may have changed it.
    if (SAMPLES.includes(name)) view.removeAttribute('glass-bounces');
    forgetPixel();
  };
}
$('side-of').onchange = ({ target }) => {
  view.lookFrom(target.value);
  target.value = '';
  forgetPixel();
};
$('panels').onclick = () => {
  const isNarrow = document.body.classList.toggle('narrow');
  $('panels').setAttribute('aria-expanded', String(!isNarrow));
};

view.addEventListener('render', ({ detail: { width, height, isDraft, time } }) => {
  if (isDraft) return;
  $('status').textContent = `${width} × ${height} pixels in ${Math.round(time)} ms, ${view.level}`;
});

// Pixels

let pressed = null;
view.addEventListener('pointerdown', ({ clientX, clientY, button }) => {
  pressed = button === 0 ? [clientX, clientY] : null;
});
view.addEventListener('pointerup', async ({ clientX, clientY }) => {
  if (pressed === null || Math.hypot(clientX - pressed[0], clientY - pressed[1]) > 3) return;
  const box = view.getBoundingClientRect();
  try {
    const { name, face, text } = await view.explain(clientX - box.left, clientY - box.top);
    const of = face === null ? '' : `, face ${count(face)}`;
    $('pixel-name').textContent = name === null ? 'the background' : `${name || 'no name'}${of}`;
    $('pixel-text').textContent = text;
    $('pixel').hidden = false;
    $('pixel-hint').hidden = true;
    $('pixel').scrollIntoView({ block: 'nearest' });
  } catch (error) {
    report(error);
  }
});
view.addEventListener('camera-change', () => forgetPixel());

function forgetPixel() {
  $('pixel').hidden = true;
  $('pixel-hint').hidden = false;
}

// Keys that the element does not have, as in the viewer.

function next(select, step) {
  select.selectedIndex = (select.selectedIndex + step + select.length) % select.length;
  select.dispatchEvent(new Event('input'));
}

addEventListener('keydown', (event) => {
  const { key, ctrlKey, metaKey, altKey, target } = event;
  if (altKey || $('frontier').open || target instanceof HTMLSelectElement || target instanceof HTMLInputElement) return;
  if ((ctrlKey || metaKey) && key === 'o') {
    event.preventDefault();
    return $('files').click();
  }
  if (ctrlKey || metaKey || document.body.classList.contains('empty')) return;
  if (key === 'c') next($('display'), 1);
  if (key === 'C') next($('display'), -1);
  if (key === 'e') {
    $('surface').value = $('surface').value === 'edges' ? 'surface' : 'edges';
    $('surface').dispatchEvent(new Event('input'));
  }
  if (key === 'E') next($('surface'), 1);
  if (key === 'a') next($('samples'), 1);
  if (key === 'F12') savePicture();
});

// Saving

async function savePicture() {
  try {
    save(await view.toBlob(), `${stem(view)}.png`);
  } catch (error) {
    report(error);
  }
}
$('save').onclick = savePicture;

// Error against time

offerFrontier(({ samples, edgeSamples, glassBounces }) => {
  [$('samples').value, $('edge-samples').value] = [samples, edgeSamples];
  for (const name of SAMPLES) view.setAttribute(name, $(name).value);
  view.setAttribute('glass-bounces', glassBounces);
  forgetPixel();
}, report);
