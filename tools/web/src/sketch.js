// A curve over time that somebody draws, by a pointer or by the arrow keys.
import { element } from './dom.js';
import { t } from './messages.js';
import { shownIn, spaced, timeShown } from './units.js';

const columns = 60;
const height = 300; // px
const [left, right, top, bottom] = [58, 14, 12, 34]; // px of the axes
const name = 'http://www.w3.org/2000/svg';

function shape(tag, attributes, text) {
  const node = document.createElementNS(name, tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

export class Sketch {
  // Over the times from start to stop; `range`: the least and the largest value, in the SI unit `unit`; onchange(): something was drawn.
  constructor({ start, stop, range, quantity, unit, as, onchange }) {
    Object.assign(this, { start, stop, range, quantity, onchange });
    this.shown = as ?? shownIn(unit, Math.max(...range.map(Math.abs)));
    this.width = Math.min(640, Math.max(300, document.documentElement.clientWidth - 60)); // px, so that its texts can be read on a phone
    this.values = Array(columns + 1).fill(null);
    this.at = 0; // the column of the keys
    this.svg = shape('svg', { viewBox: `0 0 ${this.width} ${height}`, class: 'sketch', tabindex: '0', role: 'slider', 'aria-orientation': 'vertical',
      'aria-label': t('Sketch of {quantity} over time. Arrow keys: left and right go through the time, up and down draw.', { quantity }),
      'aria-valuemin': '0', 'aria-valuemax': '100' });
    this.drawAxes();
    this.line = shape('path', { class: 'sketch-line' });
    this.pen = shape('circle', { r: 5, class: 'sketch-pen' });
    this.svg.append(this.line, this.pen);
    this.listen();
    this.show();
  }

  x(column) {
    return left + (column / columns) * (this.width - left - right);
  }

  y(value) {
    const [low, high] = this.range;
    return height - bottom - ((value - low) / (high - low)) * (height - top - bottom);
  }

  drawAxes() {
    const { start, stop, range, shown } = this;
    const time = timeShown(start, stop);
    this.time = time;
    const axis = (d) => this.svg.append(shape('path', { d, class: 'sketch-axis' }));
    const label = (x, y, anchor, text) => this.svg.append(shape('text', { x, y, 'text-anchor': anchor }, text));
    axis(`M${left} ${top}V${height - bottom}H${this.width - right}`);
    const ends = [...range, ...(range[0] < 0 && range[1] > 0 ? [0] : [])];
    for (const value of ends) {
      axis(`M${left} ${this.y(value)}H${this.width - right}`);
      label(left - 6, this.y(value) + 4, 'end', spaced(value / shown.factor, (range[1] - range[0]) / 5 / shown.factor));
    }
    for (const part of [0, 0.25, 0.5, 0.75, 1]) {
      axis(`M${this.x(part * columns)} ${height - bottom}v5`);
      label(this.x(part * columns), height - bottom + 18, part === 1 ? 'end' : 'middle', spaced((start + part * (stop - start)) / time.factor, (stop - start) / 4 / time.factor));
    }
    label((left + this.width - right) / 2, height - 2, 'middle', `${t('time')} [${time.name}]`);
    this.svg.append(shape('text', { transform: `translate(14 ${(top + height - bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle' },
      `${this.quantity}${shown.name ? ` [${shown.name}]` : ''}`));
  }

  listen() {
    const place = ({ clientX, clientY }) => {
      const box = this.svg.getBoundingClientRect();
      const part = ((clientX - box.left) * this.width / box.width - left) / (this.width - left - right);
      const up = (height - bottom - (clientY - box.top) * height / box.height) / (height - top - bottom);
      const [low, high] = this.range;
      return { column: Math.round(Math.min(1, Math.max(0, part)) * columns), value: low + Math.min(1, Math.max(0, up)) * (high - low) };
    };
    let last = null;
    this.svg.addEventListener('pointerdown', (event) => {
      this.svg.setPointerCapture(event.pointerId);
      last = place(event);
      this.draw(last, last);
    });
    this.svg.addEventListener('pointermove', (event) => {
      if (!last) return;
      const next = place(event);
      this.draw(last, next);
      last = next;
    });
    for (const end of ['pointerup', 'pointercancel']) this.svg.addEventListener(end, () => (last = null));
    this.svg.addEventListener('keydown', (event) => this.key(event));
  }

  // A stroke from one place to another: each column between them gets its value.
  draw(from, to) {
    const [first, last] = from.column <= to.column ? [from, to] : [to, from];
    for (let k = first.column; k <= last.column; ++k)
      this.values[k] = first.column === last.column ? to.value : first.value + ((last.value - first.value) * (k - first.column)) / (last.column - first.column);
    this.at = to.column;
    this.show();
    this.onchange();
  }

  // The value of the column of the keys: what was drawn there, or beside it.
  get value() {
    const before = this.values.slice(0, this.at + 1).reverse().find((value) => value !== null);
    return this.values[this.at] ?? before ?? Math.min(this.range[1], Math.max(this.range[0], 0));
  }

  key(event) {
    const step = (this.range[1] - this.range[0]) / 20;
    const here = { column: this.at, value: this.value };
    const within = (value) => Math.min(this.range[1], Math.max(this.range[0], value));
    const moves = {
      ArrowRight: () => this.draw(here, { column: Math.min(columns, this.at + 1), value: this.values[this.at + 1] ?? here.value }),
      ArrowLeft: () => { this.at = Math.max(0, this.at - 1); this.show(); },
      ArrowUp: () => this.draw(here, { column: this.at, value: within(here.value + step) }),
      ArrowDown: () => this.draw(here, { column: this.at, value: within(here.value - step) }),
      End: () => this.draw(here, { column: columns, value: here.value }),
    };
    if (!moves[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    moves[event.key]();
    event.preventDefault();
  }

  show() {
    let pen = 'M';
    const path = this.values.map((value, k) => {
      if (value === null) return (pen = 'M', '');
      const part = `${pen}${this.x(k).toFixed(1)} ${this.y(value).toFixed(1)}`;
      pen = 'L';
      return part;
    });
    this.line.setAttribute('d', path.join(''));
    this.pen.setAttribute('cx', this.x(this.at));
    this.pen.setAttribute('cy', this.y(this.value));
    const [low, high] = this.range;
    const time = this.start + (this.at / columns) * (this.stop - this.start);
    this.svg.setAttribute('aria-valuenow', String(Math.round((100 * (this.value - low)) / (high - low))));
    this.svg.setAttribute('aria-valuetext', `${spaced(this.value / this.shown.factor, (high - low) / 20 / this.shown.factor)} ${this.shown.name}, ${
      spaced(time / this.time.factor, (this.stop - this.start) / columns / this.time.factor)} ${this.time.name}`);
  }

  // Nearly all of the time has a value.
  get isComplete() {
    return this.values.filter((value) => value !== null).length > 0.9 * columns;
  }

  // The curve in SI; gaps are closed by the value before them.
  get curve() {
    const x = [];
    const y = [];
    let last = this.values.find((value) => value !== null) ?? 0;
    this.values.forEach((value, k) => {
      last = value ?? last;
      x.push(this.start + (k / columns) * (this.stop - this.start));
      y.push(last);
    });
    return { x, y };
  }

  clear() {
    this.take(Array(columns + 1).fill(null));
  }

  take(values) {
    this.values = [...values];
    this.at = 0;
    this.show();
    this.onchange();
  }
}
