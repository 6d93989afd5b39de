// Common parts of charts over time and of charts of one quantity against another: axes, colours, zoom by keyboard.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { element, onTheme, styled } from './dom.js';
import { along, spaced } from './units.js';

const charts = new Set();
const settling = 700; // Time without a change after which an axis is fitted to its values again [ms].

onTheme(() => charts.forEach((chart) => chart.repaint()));

export const colour = (k) => styled(`--curve-${(k % 7) + 1}`);
export const dashes = [[], [7, 3], [2, 2], [10, 3, 2, 3]]; // px
export const borders = ['solid', 'dashed', 'dotted', 'dashed']; // The same, for a legend.

// The colour of a curve on white paper, independent of the theme of the page.
export function colourInPrint(k) {
  const sheet = element('div', { 'data-theme': 'light', hidden: true });
  document.body.append(sheet);
  const value = getComputedStyle(sheet).getPropertyValue(`--curve-${(k % 7) + 1}`).trim();
  sheet.remove();
  return value;
}

// `factor`: the unit of the axis, in units of the values.
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

// The space for the numbers along an axis: beside it, and from one number to the next.
export function sideways(_, values) {
  return Math.max(64, 20 + character * Math.max(0, ...(values ?? []).map((text) => text.length)));
}
export function apart(_plot, _axis, min, max, length) {
  const longest = Math.max(...[min, max].map((value) => spaced(value, (max - min) / 5 || 1).length));
  return Math.min(Math.max(60, character * (longest + 3)), length);
}

// A value read from a curve, with a resolution of a hundredth of the visible range or better.
export const read = (plot, scale, value, least, factor = 1) => spaced(value / factor, (plot.scales[scale].max - plot.scales[scale].min) / 100 / factor, least);

// The range of an axis for values from min to max, with a margin. A curve that is 0 throughout is in the middle.
export const shownOf = (min, max, more) => (min === 0 && max === 0 ? [-1, 1] : uPlot.rangeNum(min, max, more, true));

export const labelOf = (quantity, shown) => (shown.name ? `${quantity} [${shown.name}]` : quantity);

// A chart that fills its host and zooms by keyboard.
export class Chart {
  constructor(host, height) {
    this.host = host;
    this.height = height;
    this.ranges = {}; // The current ranges of the axes.
    this.isHeld = false; // The user has fixed the axes.
    this.isMoving = false; // Values are changing: the axes may only grow.
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

  // The range of an axis, given the range that fits its values.
  rangeOf(key, [min, max]) {
    const before = this.ranges[key];
    if (before && this.isHeld) return before;
    this.ranges[key] = before && this.isMoving ? [Math.min(min, before[0]), Math.max(max, before[1])] : [min, max];
    return this.ranges[key];
  }

  // While values change, axes and units do not jump; they are fitted after the last change.
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
