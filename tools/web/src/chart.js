// What curves over time and curves of one quantity against another have in common: axes, colours, zoom by keys.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { element, onTheme, styled } from './dom.js';
import { along, spaced } from './units.js';

const charts = new Set();
const settling = 700; // ms without a change after which an axis fits its values again

onTheme(() => charts.forEach((chart) => chart.repaint()));

export const colour = (k) => styled(`--curve-${(k % 7) + 1}`);
export const dashes = [[], [7, 3], [2, 2], [10, 3, 2, 3]]; // px
export const borders = ['solid', 'dashed', 'dotted', 'dashed']; // the same, of a legend

// The colour of a curve on white paper, whatever the theme of the page is.
export function colourInPrint(k) {
  const sheet = element('div', { 'data-theme': 'light', hidden: true });
  document.body.append(sheet);
  const value = getComputedStyle(sheet).getPropertyValue(`--curve-${(k % 7) + 1}`).trim();
  sheet.remove();
  return value;
}

// `factor`: the size of the unit along it, where that is another than that of the values.
export function axis(label, extra = {}, factor = () => 1) {
  return {
    label,
    labelSize: 22,
    stroke: () => styled('--ink'),
    font: '12px system-ui, sans-serif',
    labelFont: '12px system-ui, sans-serif',
    grid: { stroke: () => styled('--grid'), width: 1 },
    ticks: { stroke: () => styled('--grid'), width: 1 },
    values: (_plot, splits, _axis, _space, spacing) => along(splits.map((value) => value / factor()), spacing / factor()),
    ...extra,
  };
}

const character = 7; // px, about

// The room that the numbers along an axis take: to its side, and from one to the next.
export function sideways(_, values) {
  return Math.max(64, 20 + character * Math.max(0, ...(values ?? []).map((text) => text.length)));
}
export function apart(_plot, _axis, min, max, length) {
  const longest = Math.max(...[min, max].map((value) => spaced(value, (max - min) / 5 || 1).length));
  return Math.min(Math.max(60, character * (longest + 3)), length);
}

// A value that is read from a curve: three digits more than the height of what is shown.
export const read = (plot, scale, value, least, factor = 1) => spaced(value / factor, (plot.scales[scale].max - plot.scales[scale].min) / 100 / factor, least);

// What an axis shows of values from min to max: somewhat more. What is 0 all the time has its line in the middle.
export const shownOf = (min, max, more) => (min === 0 && max === 0 ? [-1, 1] : uPlot.rangeNum(min, max, more, true));

export const labelOf = (quantity, shown) => (shown.name ? `${quantity} [${shown.name}]` : quantity);

// A chart: it fills its host, and zooms by keys.
export class Chart {
  constructor(host, height) {
    this.host = host;
    this.height = height;
    this.ranges = {}; // of the axes as they are drawn
    this.isHeld = false; // somebody wants the axes to stay
    this.isMoving = false; // values are changing: the axes only grow
    charts.add(this);
    this.watch = new ResizeObserver(() => {
      const width = this.width();
      if (this.plot && width > 0 && width !== this.plot.width) this.plot.setSize({ width, height: this.height });
    });
    this.watch.observe(host);
    host.addEventListener('keydown', (event) => this.key(event));
  }

  width() {
    return Math.floor(this.host.clientWidth);
  }

  // The range of an axis, given the one that fits its values.
  rangeOf(key, [min, max]) {
    const before = this.ranges[key];
    if (before && this.isHeld) return before;
    this.ranges[key] = before && this.isMoving ? [Math.min(min, before[0]), Math.max(max, before[1])] : [min, max];
    return this.ranges[key];
  }

  // While values change, neither axes nor units jump; they settle after the last change.
  moves() {
    this.isMoving = true;
    clearTimeout(this.settles);
    this.settles = setTimeout(() => {
      this.isMoving = false;
      if (this.plot && !this.isHeld) this.settle();
    }, settling);
  }

  hold(on) {
    this.isHeld = on;
    if (!on) this.settle();
  }

  get keepsUnits() {
    return this.isHeld || this.isMoving;
  }

  setHeight(height) {
    if (height === this.height) return;
    this.height = height;
    this.plot?.setSize({ width: this.plot.width, height });
  }

  repaint() {
    this.plot?.redraw(false, true);
  }

  destroy() {
    charts.delete(this);
    clearTimeout(this.settles);
    this.watch.disconnect();
    this.plot?.destroy();
    this.plot = null;
  }

  key(event) {
    if (event.target !== this.host || event.ctrlKey || event.metaKey || event.altKey || !this.plot) return;
    const { min, max } = this.plot.scales.x;
    const span = max - min;
    const moves = {
      '+': [span / 4, -span / 4],
      '=': [span / 4, -span / 4],
      '-': [-span / 2, span / 2],
      ArrowLeft: [-span / 8, -span / 8],
      ArrowRight: [span / 8, span / 8],
    };
    if (event.key in moves) this.zoom(min + moves[event.key][0], max + moves[event.key][1]);
    else if (event.key === '0' || event.key === 'Home') this.reset();
    else return;
    event.preventDefault();
  }
}
