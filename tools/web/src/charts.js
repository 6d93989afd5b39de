// Curves over time, and curves of one quantity against another, both with zoom and hover.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { breakable, element, onTheme, styled } from './dom.js';
import { largestOf, number, shownIn, spaced } from './units.js';

const dashes = [[], [7, 3], [2, 2], [10, 3, 2, 3]];
const borders = ['solid', 'dashed', 'dotted', 'dashed']; // the same, of a legend
const charts = new Set();
onTheme(() => charts.forEach((chart) => chart.repaint()));

export const colour = (k) => styled(`--curve-${(k % 7) + 1}`);

function axis(label, extra = {}) {
  return {
    label,
    labelSize: 22,
    stroke: () => styled('--ink'),
    font: '12px system-ui, sans-serif',
    labelFont: '12px system-ui, sans-serif',
    grid: { stroke: () => styled('--grid'), width: 1 },
    ticks: { stroke: () => styled('--grid'), width: 1 },
    values: (_plot, splits, _axis, _space, spacing) => splits.map((value) => spaced(value, spacing)),
    ...extra,
  };
}

const character = 7; // px, about

// The room that the numbers along an axis take: to its side, and from one to the next.
function sideways(_, values) {
  return Math.max(64, 20 + character * Math.max(0, ...(values ?? []).map((text) => text.length)));
}
function apart(_plot, _axis, min, max, length) {
  const longest = Math.max(...[min, max].map((value) => spaced(value, (max - min) / 5 || 1).length));
  return Math.min(Math.max(60, character * (longest + 3)), length);
}

// A value that is read from a curve: three digits more than the height of what is shown.
const read = (plot, scale, value, least) => spaced(value, (plot.scales[scale].max - plot.scales[scale].min) / 100, least);

// What an axis shows of values from min to max: somewhat more. What is 0 all the time has its line in the middle.
const shownOf = (min, max, more) => (min === 0 && max === 0 ? [-1, 1] : uPlot.rangeNum(min, max, more, true));

const labelOf = (quantity, shown) => (shown.name ? `${quantity} [${shown.name}]` : quantity);

// What charts have in common: they fill their host, and zoom by keys.
class Chart {
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

// Curves of several runs over the times of all. At a jump a run has two rows of one time.
function joined(runs) {
  const places = runs.map(() => 0);
  const result = [[], ...runs.map(() => [])];
  for (;;) {
    const time = Math.min(...runs.map(([times], k) => times[places[k]] ?? Infinity));
    if (time === Infinity) return result;
    result[0].push(time);
    runs.forEach(([times, values], k) => result[k + 1].push(times[places[k]] === time ? values[places[k]++] : null));
  }
}

// Panels that share their time axis.
export class TimeGroup {
  constructor() {
    this.members = new Set();
    this.sync = uPlot.sync(`time-${TimeGroup.count++}`);
  }
  zoom(min, max) {
    this.members.forEach((chart) => chart.plot?.setScale('x', { min, max }));
  }
  // The room beside the panels is that of the one that needs the most: so their times are one below the other.
  room(chart, needed) {
    chart.needed = needed;
    const room = Math.max(...[...this.members].map((member) => member.needed ?? 0));
    if (room !== this.given) queueMicrotask(() => this.members.forEach((member) => member !== chart && member.plot?.redraw(false, true)));
    this.given = room;
    return room;
  }
}
TimeGroup.count = 0;

export class TimeChart extends Chart {
  // curves: [{ name, time, values }], all of one unit.
  constructor(host, group, { quantity, unit, as, curves, events = [], height = 230, labelled = true, first = 0 }) {
    super(host, height);
    this.group = group;
    group.members.add(this);
    this.events = events;
    host.classList.add('chart');
    host.tabIndex = 0;
    host.setAttribute('role', 'group');
    const names = curves.map((curve) => curve.name).join(', ');
    host.setAttribute('aria-label', `${quantity} over time: ${names}. Keys: plus and minus zoom, arrows move, 0 shows all.`);
    this.quantity = quantity;
    this.unit = unit;
    this.as = as; // the unit that somebody wants
    this.shown = as ?? shownIn(unit, largestOf(curves.map((curve) => curve.values)));
    this.curves = curves;
    const dashOf = (curve, k) => (curve.dash ?? Math.floor(k / 7)) % dashes.length;
    const series = curves.map((curve, k) => ({
      label: curve.name,
      stroke: () => colour(first + (curve.style ?? k)),
      width: 1.6,
      dash: dashes[dashOf(curve, k)],
      spanGaps: true,
      pxAlign: 0,
      points: { show: false },
      value: (plot, value) => (value === null || value === undefined ? '–' : `${read(plot, 'y', value, 5)} ${this.shown.name}`),
    }));
    this.plot = new uPlot(
      {
        width: Math.max(this.width(), 240),
        height,
        series: [{ label: 'time', value: (plot, t) => (t === null ? '–' : `${read(plot, 'x', t, 6)} s`) }, ...series],
        scales: { x: { time: false }, y: { range: (_, min, max) => shownOf(min, max, 0.1) } },
        axes: [axis(labelled ? 'time [s]' : undefined, { space: apart, size: labelled ? 36 : 28 }),
          axis(labelOf(quantity, this.shown), { size: (plot, values) => group.room(this, sideways(plot, values)) })],
        cursor: { sync: { key: group.sync.key, setSeries: false }, drag: { x: true, y: false } },
        legend: { live: true, markers: { width: 3, fill: () => 'transparent', dash: (_, k) => (k > 0 ? borders[dashOf(curves[k - 1], k - 1)] : 'solid') } },
        hooks: {
          drawClear: [(plot) => this.drawEvents(plot)],
          setScale: [(plot, key) => key === 'x' && this.follow(plot)],
        },
      },
      this.data(),
      host,
    );
    host.querySelectorAll('.u-label').forEach((label) => label.replaceChildren(...breakable(label.textContent)));
  }

  data() {
    const scaled = (values) => (this.shown.factor === 1 ? values : values.map((value) => value / this.shown.factor));
    const times = new Set(this.curves.map((curve) => curve.time));
    const data = times.size <= 1
      ? [this.curves[0]?.time ?? [], ...this.curves.map((curve) => scaled(curve.values))]
      : joined(this.curves.map((curve) => [curve.time, scaled(curve.values)]));
    // The times of a run that goes on grow in place.
    this.span = data[0].length ? [data[0][0], data[0].at(-1)] : null;
    return data;
  }

  // New values in place of the old ones; the zoom stays.
  update(curves, events = []) {
    const whole = this.full();
    this.curves = curves;
    this.events = events;
    this.shown = this.as ?? shownIn(this.unit, largestOf(curves.map((curve) => curve.values)));
    this.plot.axes[1].label = labelOf(this.quantity, this.shown);
    this.plot.setData(this.data(), whole);
    if (!whole) this.plot.redraw();
  }

  // All of the time is shown that there was when it was last drawn.
  full() {
    const { min, max } = this.plot.scales.x;
    return !(this.span && (min > this.span[0] || max < this.span[1]));
  }

  follow(plot) {
    if (this.group.busy) return;
    this.group.busy = true;
    const { min, max } = plot.scales.x;
    this.group.members.forEach((other) => other !== this && other.plot?.setScale('x', { min, max }));
    this.group.busy = false;
  }

  zoom(min, max) {
    this.group.zoom(min, max);
  }

  reset() {
    const x = this.plot.data[0];
    if (x.length) this.zoom(x[0], x[x.length - 1]);
  }

  drawEvents(plot) {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = styled('--event');
    ctx.lineWidth = devicePixelRatio;
    ctx.beginPath();
    let drawn = 0;
    for (const time of this.events) {
      const x = plot.valToPos(time, 'x', true);
      if (x < bbox.left || x > bbox.left + bbox.width || ++drawn > 300) continue;
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
    }
    if (drawn <= 300) ctx.stroke();
    ctx.restore();
  }

  mark(time) {
    const left = this.plot.valToPos(time, 'x');
    this.plot.setCursor({ left, top: -10 }, false);
  }

  destroy() {
    this.group.members.delete(this);
    super.destroy();
  }
}

// Where a logarithmic axis has its numbers. uPlot's own choice never ends on some ranges that do not begin at a power of ten.
function decades(plot, axis, min, max) {
  const low = Math.floor(Math.log10(min));
  const high = Math.ceil(Math.log10(max));
  const every = Math.ceil((high - low) / 8);
  const factors = Math.log10(max / min) < 2 ? [1, 2, 5] : [1];
  const splits = [];
  for (let power = low; power <= high; power += every) for (const factor of factors) splits.push(Number(`${factor}e${power}`));
  return splits.filter((value) => value >= min && value <= max);
}

export class LoopChart extends Chart {
  // curves: [{ name, time, x, y }]; what is along the axes: { quantity, unit, as }, or { log: true } of both.
  constructor(host, { x, y, curves, height = 380, marks = false }) {
    super(host, height);
    this.marks = marks;
    host.classList.add('chart', 'loop');
    host.tabIndex = 0;
    host.setAttribute('role', 'group');
    host.setAttribute('aria-label', `${y.quantity} against ${x.quantity}: ${curves.map((curve) => curve.name).join(', ')}`);
    const log = Boolean(x.log);
    this.sides = [x, y];
    this.curves = curves;
    this.findUnits();
    const range = (_, min, max) => (log ? [min / 2, max * 2] : shownOf(min, max, 0.08));
    const scale = { time: false, range, distr: log ? 3 : 1 };
    const logValues = log ? { splits: decades, filter: (_, splits) => splits, values: (_, splits) => splits.map((v) => number(v, 2)) } : {};
    this.plot = new uPlot(
      {
        mode: 2,
        width: Math.max(this.width(), 240),
        height,
        series: [
          null,
          ...curves.map((curve, k) => ({
            label: curve.name,
            stroke: () => colour(curve.style ?? k),
            facets: [
              { scale: 'x', auto: true, sorted: 0 },
              { scale: 'y', auto: true },
            ],
            paths: (plot, s) => this.path(plot, s),
          })),
        ],
        scales: { x: scale, y: { ...scale } },
        axes: [axis(labelOf(x.quantity, this.units[0]), { space: apart, ...logValues }), axis(labelOf(y.quantity, this.units[1]), { size: sideways, ...logValues })],
        cursor: { drag: { x: true, y: true, uni: 20 }, points: { show: false } },
        legend: { show: false },
      },
      this.data(),
      host,
    );
    this.dots = curves.map((_, k) => {
      const dot = element('div', { class: 'dot', hidden: true });
      dot.style.background = colour(curves[k].style ?? k);
      this.plot.over.append(dot);
      return dot;
    });
    this.legend = element(
      'div',
      { class: 'loop-legend' },
      curves.map((curve, k) => {
        const swatch = element('span', { class: 'swatch' });
        swatch.style.background = `var(--curve-${((curve.style ?? k) % 7) + 1})`;
        return element('span', { class: 'key' }, swatch, curve.name);
      }),
      (this.readout = element('output', { class: 'readout' })),
    );
    host.append(this.legend);
    this.plot.over.addEventListener('mousemove', () => this.hover());
    this.plot.over.addEventListener('mouseleave', () => this.hide());
  }

  findUnits() {
    this.units = this.sides.map((side, k) => {
      const values = this.curves.map((curve) => (k === 0 ? curve.x : curve.y));
      return side.log ? { name: side.unit, factor: 1 } : side.as ?? shownIn(side.unit, largestOf(values));
    });
  }

  data() {
    const scaled = (values, k) => (this.units[k].factor === 1 ? values : values.map((value) => value / this.units[k].factor));
    return [null, ...this.curves.map((curve) => [scaled(curve.x, 0), scaled(curve.y, 1)])];
  }

  path(plot, s) {
    const [xs, ys] = plot.data[s];
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.strokeStyle = ctx.fillStyle = colour(this.curves[s - 1].style ?? s - 1);
    ctx.lineWidth = 1.6 * devicePixelRatio;
    ctx.lineJoin = 'round';
    ctx.beginPath();
    for (let i = 0; i < xs.length; ++i) ctx.lineTo(plot.valToPos(xs[i], 'x', true), plot.valToPos(ys[i], 'y', true));
    ctx.stroke();
    if (this.marks)
      for (let i = 0; i < xs.length; ++i) {
        ctx.beginPath();
        ctx.arc(plot.valToPos(xs[i], 'x', true), plot.valToPos(ys[i], 'y', true), 3.5 * devicePixelRatio, 0, 2 * Math.PI);
        ctx.fill();
      }
    ctx.restore();
    return null;
  }

  show(k, i) {
    const [xs, ys] = this.plot.data[k + 1];
    if (i >= xs.length) return;
    const dot = this.dots[k];
    dot.hidden = false;
    dot.style.transform = `translate(${this.plot.valToPos(xs[i], 'x')}px, ${this.plot.valToPos(ys[i], 'y')}px)`;
  }

  hide() {
    this.dots.forEach((dot) => (dot.hidden = true));
    this.readout.textContent = '';
  }

  hover() {
    const { left, top } = this.plot.cursor;
    let best = { distance: Infinity };
    this.plot.data.slice(1).forEach(([xs, ys], k) => {
      for (let i = 0; i < xs.length; ++i) {
        const distance = Math.hypot(this.plot.valToPos(xs[i], 'x') - left, this.plot.valToPos(ys[i], 'y') - top);
        if (distance < best.distance) best = { distance, k, i };
      }
    });
    this.hide();
    if (best.distance > 40) return;
    const { k, i } = best;
    this.show(k, i);
    const [xs, ys] = this.plot.data[k + 1];
    const curve = this.curves[k];
    const time = curve.time ? ` at ${number(curve.time[i], 5)} s` : '';
    this.readout.textContent = `${curve.name}: ${read(this.plot, 'x', xs[i], 5)} ${this.units[0].name}, ${read(this.plot, 'y', ys[i], 5)} ${this.units[1].name}${time}`;
  }

  // Where the curves are at a time.
  mark(_, indices) {
    indices.forEach((i, k) => this.dots[k] && this.show(k, i));
  }

  update(curves) {
    this.curves = curves;
    this.findUnits();
    this.sides.forEach((side, k) => (this.plot.axes[k].label = labelOf(side.quantity, this.units[k])));
    this.plot.setData(this.data());
  }

  zoom(min, max) {
    this.plot.setScale('x', { min, max });
  }

  reset() {
    this.plot.setData(this.data(), true);
  }
}
