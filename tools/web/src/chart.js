// What curves over time and curves of one quantity against another have in common: axes, colours, zoom by keys.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { onTheme, styled } from './dom.js';
import { spaced } from './units.js';

const charts = new Set();
onTheme(() => charts.forEach((chart) => chart.repaint()));

export const colour = (k) => styled(`--curve-${(k % 7) + 1}`);

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
    values: (_plot, splits, _axis, _space, spacing) => splits.map((value) => spaced(value / factor(), spacing / factor())),
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

  repaint() {
    this.plot?.redraw(false, true);
  }

  destroy() {
    charts.delete(this);
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
