// Curves of one quantity against another.
import uPlot from 'uplot';
import { apart, axis, borders, Chart, colour, dashes, labelOf, read, shownOf, sideways } from './chart.js';
import { element } from './dom.js';
import { listenToFingers } from './gestures.js';
import { t } from './messages.js';
import { alongDecades, largestOf, number, shownIn, timeShown } from './units.js';

// The ticks of a logarithmic axis. uPlot's own function does not terminate on some ranges that do not begin at a power of ten.
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
  // curves: [{ name, time, x, y }]; x and y: the axes, { quantity, unit, as, exact (without a margin) }, or { log: true } for both. onpick(k, i): point i of curve k was clicked.
  constructor(host, { x, y, curves, height = 380, marks = false, onpick = null }) {
    super(host, height);
    this.marks = marks;
    host.classList.add('chart', 'loop');
    host.tabIndex = 0;
    host.setAttribute('role', 'group');
    host.setAttribute('aria-label', t('{y} against {x}: {names}', { y: y.quantity, x: x.quantity, names: curves.map((curve) => curve.name).join(', ') }));
    const log = Boolean(x.log);
    this.sides = [x, y];
    this.curves = curves;
    this.findUnits();
    const isExact = { x: x.exact, y: y.exact };
    const ends = (key, min, max) => (log ? [min / 2, max * 2] : isExact[key] && max > min ? [min, max] : shownOf(min, max, 0.08));
    const scale = (key) => ({ time: false, distr: log ? 3 : 1, range: (_, min, max) => this.rangeOf(key, ends(key, min, max)) });
    const logValues = log ? { splits: decades, filter: (_, splits) => splits, values: (_, splits) => alongDecades(splits) } : {};
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
        scales: { x: scale('x'), y: scale('y') },
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
        const swatch = element('span', { class: 'swatch line' });
        swatch.style.borderTop = `3px ${borders[(curve.dash ?? 0) % borders.length]} var(--curve-${((curve.style ?? k) % 7) + 1})`;
        return element('span', { class: 'key' }, swatch, curve.name);
      }),
      (this.readout = element('output', { class: 'readout' })),
    );
    host.append(this.legend);
    listenToFingers(this);
    this.plot.over.addEventListener('mousemove', () => this.hover());
    this.plot.over.addEventListener('mouseleave', () => this.hide());
    if (onpick) this.plot.over.addEventListener('click', () => {
      const { distance, k, i } = this.nearest();
      if (distance <= 40) onpick(k, i);
    });
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
    ctx.setLineDash(dashes[(this.curves[s - 1].dash ?? 0) % dashes.length].map((length) => length * devicePixelRatio));
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

  // The point that is nearest to the cursor, and its distance [px].
  nearest() {
    const { left, top } = this.plot.cursor;
    let best = { distance: Infinity };
    this.plot.data.slice(1).forEach(([xs, ys], k) => {
      for (let i = 0; i < xs.length; ++i) {
        const distance = Math.hypot(this.plot.valToPos(xs[i], 'x') - left, this.plot.valToPos(ys[i], 'y') - top);
        if (distance < best.distance) best = { distance, k, i };
      }
    });
    return best;
  }

  hover() {
    this.hide();
    const { distance, k, i } = this.nearest();
    if (distance > 40) return;
    this.show(k, i);
    const [xs, ys] = this.plot.data[k + 1];
    const curve = this.curves[k];
    const unit = curve.time && timeShown(curve.time[0], curve.time.at(-1));
    const time = unit ? ` at ${number(curve.time[i] / unit.factor, 5)} ${unit.name}` : '';
    const [x, y] = [read(this.plot, 'x', xs[i], 5), read(this.plot, 'y', ys[i], 5)].map((value, side) => `${value} ${this.units[side].name}`.trim());
    this.readout.textContent = `${curve.name}: ${x}, ${y}${time}`;
  }

  // Marks the points of the curves at a time.
  mark(_, indices) {
    indices.forEach((i, k) => this.dots[k] && this.show(k, i));
  }

  update(curves) {
    this.curves = curves;
    this.moves();
    if (!this.keepsUnits) this.findUnits();
    this.label();
    this.plot.setData(this.data());
  }

  label() {
    this.sides.forEach((side, k) => (this.plot.axes[k].label = labelOf(side.quantity, this.units[k])));
  }

  settle() {
    this.findUnits();
    this.label();
    this.plot.setData(this.data());
  }

  zoom(min, max) {
    this.plot.setScale('x', { min, max });
  }

  get isZoomed() {
    const { min, max } = this.plot.scales.x;
    const [low, high] = this.ranges.x ?? [min, max];
    return min > low || max < high;
  }

  lookAt({ x, y }) {
    this.plot.setScale('x', { min: x[0], max: x[1] });
    this.plot.setScale('y', { min: y[0], max: y[1] });
  }

  reset() {
    this.plot.setData(this.data(), true);
  }
}
