// Curves over time, in panels that share its axis.
import uPlot from 'uplot';
import { apart, axis, borders, Chart, colour, dashes, labelOf, read, shownOf, sideways } from './chart.js';
import { breakable, styled } from './dom.js';
import { listenToFingers } from './gestures.js';
import { t } from './messages.js';
import { largestOf, shownIn, timeShown } from './units.js';

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

// All points of a curve. uPlot draws only the extremes of each pixel where they are dense, which looks like steps, and beats that are none.
function polyline(plot, k, from, to) {
  const stroke = new Path2D();
  const [times, values] = [plot.data[0], plot.data[k]];
  let begun = false;
  for (let i = from; i <= to; ++i) {
    if (values[i] === null || values[i] === undefined) continue;
    const [x, y] = [plot.valToPos(times[i], 'x', true), plot.valToPos(values[i], 'y', true)];
    if (begun) stroke.lineTo(x, y);
    else stroke.moveTo(x, y);
    begun = true;
  }
  return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 1 };
}

const same = 2e-3; // Curves that differ by less, as a share of the largest value, look like one.
const broken = [8, 8]; // px

// For each curve, whether it would cover an earlier one that is the same.
function coveringOf(curves, values) {
  const isSame = (a, b) => a.length === b.length && largest > 0 && a.every((value, k) => Math.abs(value - b[k]) <= same * largest);
  const largest = Math.max(...values.map((column) => largestOf([column])), 0);
  return curves.map((curve, k) => k < 12 && curves.some((other, j) => j < k && other.time === curve.time && isSame(values[k], values[j])));
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
    host.setAttribute('aria-label', t('{quantity} over time: {names}. Keys: plus and minus zoom, arrows move, 0 shows all.', { quantity, names }));
    this.quantity = quantity;
    this.unit = unit;
    this.as = as; // the unit that somebody wants
    this.curves = curves;
    this.findUnit();
    const dashOf = (this.dashOf = (curve, k) => (curve.dash ?? Math.floor(k / 7)) % dashes.length);
    const series = curves.map((curve, k) => ({
      label: curve.name,
      stroke: () => colour(first + (curve.style ?? k)),
      width: 1.6,
      paths: polyline,
      points: { show: false },
      value: (plot, value) => (value === null || value === undefined ? '–' : `${read(plot, 'y', value, 5)} ${this.shown.name}`),
    }));
    const data = this.data();
    this.timeLabel = () => (labelled ? labelOf(t('time'), this.timeUnit) : undefined);
    this.plot = new uPlot(
      {
        width: Math.max(this.width(), 240),
        height,
        series: [{ label: t('time'), value: (plot, at) => (at === null ? '–' : `${read(plot, 'x', at, 6, this.timeUnit.factor)} ${this.timeUnit.name}`) }, ...series],
        scales: { x: { time: false }, y: { range: (_, min, max) => this.rangeOf('y', shownOf(min, max, 0.1)) } },
        axes: [axis(this.timeLabel(), { space: apart, size: labelled ? 36 : 28 }, () => this.timeUnit.factor),
          axis(this.sideLabel(), { space: 24, size: (plot, values) => group.room(this, sideways(plot, values)) })],
        cursor: { sync: { key: group.sync.key, setSeries: false }, drag: { x: true, y: false } },
        legend: { live: true, markers: { width: 3, fill: () => 'transparent', dash: (_, k) => (k > 0 ? borders[dashOf(curves[k - 1], k - 1)] : 'solid') } },
        hooks: {
          drawClear: [(plot) => this.breakCovering(plot), (plot) => this.drawEvents(plot)],
          draw: [(plot) => this.tellRanges(plot)],
          // The legend has a time only while somebody points at one.
          setCursor: [(plot) => host.classList.toggle('pointed', typeof plot.cursor.idx === 'number')],
          setScale: [(plot, key) => key === 'x' && this.follow(plot)],
        },
      },
      data,
      host,
    );
    listenToFingers(this);
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
    this.timeUnit = timeShown(...(this.span ?? [0, 0]));
    return data;
  }

  // A curve on another one that is the same is broken, so that both are seen.
  breakCovering(plot) {
    const covers = coveringOf(this.curves, this.curves.map((curve) => curve.values));
    this.curves.forEach((curve, k) => (plot.series[k + 1].dash = covers[k] ? broken : dashes[this.dashOf(curve, k)]));
    this.host.dataset.broken = this.curves.filter((_, k) => covers[k]).map((curve) => curve.name).join(' ');
  }

  // New values in place of the old ones; the zoom stays.
  update(curves, events = []) {
    const whole = this.full();
    this.moves();
    this.curves = curves;
    this.events = events;
    if (!this.keepsUnits) this.findUnit();
    const data = this.data();
    this.plot.axes[0].label = this.timeLabel();
    this.plot.axes[1].label = this.sideLabel();
    this.plot.setData(data, whole);
    if (!whole) this.plot.redraw();
  }

  // Stores the visible range of times, and of values in SI.
  tellRanges({ scales: { x, y } }) {
    this.host.dataset.span = `${x.min} ${x.max}`;
    this.host.dataset.range = `${y.min * this.shown.factor} ${y.max * this.shown.factor}`;
  }

  // Beside a low chart there is room for the unit alone.
  sideLabel() {
    const whole = labelOf(this.quantity, this.shown);
    return 6.5 * whole.length < this.height - 36 || !this.shown.name ? whole : `[${this.shown.name}]`;
  }

  setHeight(height) {
    const isOther = height !== this.height;
    super.setHeight(height);
    if (isOther) this.plot.axes[1].label = this.sideLabel();
    if (isOther) this.plot.redraw(false, true);
  }

  findUnit() {
    this.shown = this.as ?? shownIn(this.unit, largestOf(this.curves.map((curve) => curve.values)));
  }

  settle() {
    this.findUnit();
    const { min, max } = this.plot.scales.x;
    this.plot.axes[1].label = this.sideLabel();
    this.plot.setData(this.data(), false);
    this.plot.setScale('x', { min, max });
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

  get isZoomed() {
    return !this.full();
  }

  // Shows a range, limited to the curves.
  lookAt({ x: [min, max] }) {
    const [start, stop] = this.span;
    const span = Math.min(max - min, stop - start);
    const low = Math.min(Math.max(min, start), stop - span);
    this.zoom(low, low + span);
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
    const gap = 6 * devicePixelRatio; // A zoom shows the events that are closer to each other.
    let last = -Infinity;
    for (const time of this.events) {
      const x = plot.valToPos(time, 'x', true);
      if (x < Math.max(bbox.left, last + gap) || x > bbox.left + bbox.width) continue;
      last = x;
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
    }
    ctx.stroke();
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
