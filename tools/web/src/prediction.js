// A student's prediction of a run: the choice of one of several curves, or a sketched curve.
import { element, freshId } from './dom.js';
import { t } from './messages.js';
import { paragraphs, richText } from './rich-text.js';
import { Sketch } from './sketch.js';

const [width, height] = [180, 110]; // of the little picture of a choice

// Pictures of curves to the same scale, with the names of their axes; of a choice without a curve nothing.
function pictures(choices, names) {
  const ends = (key) => {
    const values = choices.flatMap((choice) => choice[key] ?? []);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    return high > low ? [low, high] : [low - 1, high + 1];
  };
  const [x, y] = [ends('x'), ends('y')];
  const place = (value, [low, high], size) => (8 + ((value - low) / (high - low)) * (size - 16)).toFixed(1);
  return choices.map((choice) => {
    if (!choice.y) return null;
    const host = element('span', { class: 'choice-picture', 'aria-hidden': 'true' });
    const points = choice.x.map((value, k) => `${place(value, x, width)} ${(height - place(choice.y[k], y, height)).toFixed(1)}`);
    const zero = y[0] <= 0 && y[1] >= 0 ? `<path class="choice-zero" d="M8 ${(height - place(0, y, height)).toFixed(1)}H${width - 8}"/>` : '';
    host.innerHTML = `<svg viewBox="0 0 ${width} ${height + 14}"><g transform="translate(0 10)"><path class="choice-axis" d="M8 0V${height - 6}H${width - 8}"/>${zero}<path class="choice-curve" d="M${points.join('L')}"/></g><text x="8" y="8"></text><text x="${width - 8}" y="${height + 13}" text-anchor="end"></text></svg>`;
    host.querySelectorAll('text').forEach((text, i) => (text.textContent = names[i]));
    return host;
  });
}

class Choice {
  constructor({ choices }, onchange, record, across) {
    Object.assign(this, { choices, onchange });
    this.chosen = null;
    const name = freshId('choice');
    const drawn = pictures(choices, [record?.path ?? '', across?.path ?? t('time')]);
    this.inputs = choices.map((choice, k) => {
      const input = element('input', { type: 'radio', name });
      input.addEventListener('change', () => this.restore(k));
      return input;
    });
    this.host = element('div', { class: 'choices', role: 'radiogroup', 'aria-label': t('Which curve do you expect?') },
      choices.map((choice, k) => element('label', {}, [this.inputs[k], drawn[k], element('span', {}, richText(choice.text))])));
  }

  get isComplete() {
    return this.chosen !== null;
  }

  get curve() {
    return this.choices[this.chosen];
  }

  get state() {
    return this.chosen;
  }
  restore(state) {
    this.chosen = state;
    this.inputs[state].checked = true;
    this.onchange();
  }

  settle() {
    this.inputs.forEach((input) => (input.disabled = true));
  }

  // The comment on the choice, next to the run.
  verdict() {
    const { right, reply } = this.curve;
    return [element('p', { class: right ? 'holds' : 'fails' }, right ? t('That is what happens.') : t('That is not what happens.')), ...paragraphs(reply)];
  }
}

class Drawing {
  constructor({ start, stop, range }, onchange, record) {
    this.sketch = new Sketch({ start, stop, range, quantity: record.path, unit: record.unit, as: record.shown, onchange });
    this.again = element('button', { type: 'button', onclick: () => this.sketch.clear() }, t('Erase'));
    this.host = element('div', { class: 'drawing-board' }, element('p', { class: 'note' }, t('Draw from left to right, by mouse, by finger, or with the arrow keys.')), this.sketch.svg, this.again);
  }

  get isComplete() {
    return this.sketch.isComplete;
  }

  get curve() {
    return this.sketch.curve;
  }

  get state() {
    return this.sketch.values;
  }
  restore(state) {
    this.sketch.take(state);
  }

  settle() {
    this.host.remove();
  }

  // How far it is from the run on average, as a part of the height of the run.
  verdict({ x: times, y: values }) {
    const { x, y } = this.curve;
    const height = Math.max(...values) - Math.min(...values);
    if (!(height > 0)) return [];
    let squares = 0;
    times.forEach((time, k) => {
      const j = Math.min(x.length - 2, Math.max(0, Math.floor(((time - x[0]) / (x.at(-1) - x[0])) * (x.length - 1))));
      const drawn = y[j] + ((y[j + 1] - y[j]) * (time - x[j])) / (x[j + 1] - x[j]);
      squares += (drawn - values[k]) ** 2;
    });
    const off = Math.round((100 * Math.sqrt(squares / times.length)) / height);
    return [element('p', {}, t('On average your curve is {off} % of the height of the run away from it.', { off }))];
  }
}

// `record` is on the vertical axis, `across` on the horizontal one (the time if absent).
export const predictionOf = (asked, onchange, record, across) => (asked.choices ? new Choice(asked, onchange, record, across) : new Drawing(asked, onchange, record));
