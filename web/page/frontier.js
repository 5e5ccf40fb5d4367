// Error against time: measures the view at many settings, and uses the setting of a dot that is clicked.

import { save, stem } from './save.js';

const $ = (id) => document.getElementById(id);
const view = $('view');

const ms = (time) => Number(time.toPrecision(3)).toString();

/** What a dot says. */
function words({ name, milliseconds: [low, median, high], error, standing }) {
  const wrong = error === 0 ? 'no error' : `RMSE ${error.toExponential(2)}`;
  return `${name}: ${ms(median)} ms (${ms(low)} to ${ms(high)}), ${wrong}, ${standing}`;
}

function show({ svg, dots }, use) {
  const plot = new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement;
  plot.setAttribute('role', 'group');
  const circles = plot.querySelectorAll('circle');
  dots.forEach((dot, index) => {
    const circle = circles[index];
    const choose = () => {
      $('frontier').close();
      use(dot);
    };
    const title = document.createElementNS(plot.namespaceURI, 'title');
    title.textContent = words(dot);
    circle.append(title);
    for (const [name, value] of [['role', 'button'], ['tabindex', 0], ['aria-label', words(dot)]]) circle.setAttribute(name, value);
    circle.addEventListener('click', choose);
    circle.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') choose();
    });
  });
  $('plot').replaceChildren(document.adoptNode(plot));
  $('plot-again').hidden = false;
  $('frontier').showModal();
}

/** `use` takes the setting of a dot, and `report` an error. */
export function offerFrontier(use, report) {
  let last = null;
  $('measure').onclick = async () => {
    $('measure').hidden = true;
    $('measuring').hidden = false;
    $('measured').value = 0;
    try {
      last = await view.measure();
      show(last, use);
    } catch (error) {
      if (error.kind !== 'Cancelled') report(error);
    }
    $('measure').hidden = false;
    $('measuring').hidden = true;
  };
  view.addEventListener('progress', ({ detail }) => {
    $('measured').value = detail;
  });
  view.addEventListener('load', () => {
    $('plot-again').hidden = true;
    $('frontier').close();
  });
  $('cancel').onclick = () => view.cancelMeasurement();
  $('plot-again').onclick = () => $('frontier').showModal();
  $('close-plot').onclick = () => $('frontier').close();
  $('save-plot').onclick = () => {
    save(new Blob([last.svg], { type: 'image/svg+xml' }), `${stem(view)}_frontier.svg`);
  };
}
