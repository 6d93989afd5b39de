// Two cursors in plots over time: values at each cursor, their difference, and period and peak between the cursors.
import { element, table } from './dom.js';
import { t } from './messages.js';
import { number, spaced } from './units.js';

const names = ['1', '2'];

// The value at a time, interpolated linearly between rows. At a jump it is the right limit.
export function valueAt(times, values, time) {
  let low = 0;
  let high = times.length - 1;
  if (!(high >= 0) || time < times[0] || time > times[high]) return NaN;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  if (times[high] <= time) return values[high];
  const length = times[high] - times[low];
  return length > 0 ? values[low] + ((values[high] - values[low]) * (time - times[low])) / length : values[high];
}

// Properties of a curve in an interval: maximum and minimum with their times, and the period, which is the mean time between upward
// crossings of the middle between them; NaN if there are fewer than two crossings.
export function between(times, values, from, to) {
  const rows = [[from, valueAt(times, values, from)]];
  times.forEach((time, k) => time > from && time < to && rows.push([time, values[k]]));
  rows.push([to, valueAt(times, values, to)]);
  const known = rows.filter(([, value]) => !Number.isNaN(value));
  if (!known.length) return null;
  const highest = known.reduce((best, row) => (row[1] > best[1] ? row : best));
  const lowest = known.reduce((best, row) => (row[1] < best[1] ? row : best));
  const middle = (highest[1] + lowest[1]) / 2;
  const passages = [];
  for (let k = 1; k < known.length; ++k) {
    const [[t0, v0], [t1, v1]] = [known[k - 1], known[k]];
    if (v0 < middle && v1 >= middle) passages.push(v1 > v0 ? t0 + ((t1 - t0) * (middle - v0)) / (v1 - v0) : t1);
  }
  const period = passages.length > 1 ? (passages.at(-1) - passages[0]) / (passages.length - 1) : NaN;
  return { highest, lowest, period };
}

export class Measure {
  // charts(): the plots over time that are drawn.
  constructor(charts) {
    this.charts = charts;
    this.isOn = false;
    this.times = null;
    this.button = element('button', { type: 'button', class: 'measure', 'aria-pressed': 'false', onclick: () => this.toggle(), title: t('Two cursors (M)') }, t('Measure'));
    this.host = element('div', { class: 'measured', hidden: true });
  }

  toggle() {
    this.isOn = !this.isOn;
    this.button.setAttribute('aria-pressed', String(this.isOn));
    this.show();
  }

  // Call when the plots have been redrawn or have new values.
  show() {
    const charts = this.charts().filter((chart) => chart.span);
    this.host.hidden = !this.isOn || !charts.length;
    for (const { plot } of this.charts()) plot?.over.querySelectorAll('.measuring').forEach((line) => line.remove());
    this.lines = [];
    if (this.host.hidden) return;
    const [start, stop] = charts[0].span;
    const isWithin = this.times?.every((time) => time >= start && time <= stop);
    if (!isWithin) this.times = [start + (stop - start) / 4, start + (3 * (stop - start)) / 4];
    charts.forEach((chart, k) => names.forEach((name, which) => this.lines.push(this.line(chart, name, which, k === 0))));
    this.place();
  }

  line(chart, name, which, isFirst) {
    const line = element('div', { class: `measuring cursor-${name}` }, element('span', { class: 'cursor-name' }, name));
    if (isFirst) {
      line.tabIndex = 0;
      line.setAttribute('role', 'slider');
      line.setAttribute('aria-label', t('Cursor {name}', { name }));
      line.addEventListener('keydown', (event) => this.key(event, which, chart));
    }
    line.addEventListener('pointerdown', (event) => {
      event.stopPropagation();
      event.preventDefault();
      line.setPointerCapture(event.pointerId);
      line.focus({ preventScroll: true });
    });
    line.addEventListener('mousedown', (event) => event.stopPropagation()); // Do not zoom the plot.
    line.addEventListener('pointermove', (event) => {
      if (!line.hasPointerCapture(event.pointerId)) return;
      event.stopPropagation();
      const { left } = chart.plot.over.getBoundingClientRect();
      this.move(which, chart.plot.posToVal(event.clientX - left, 'x'), chart);
    });
    chart.plot.over.append(line);
    return { line, chart, which, isFirst };
  }

  key(event, which, chart) {
    const { min, max } = chart.plot.scales.x;
    const steps = { ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10 };
    if (!(event.key in steps)) return;
    event.preventDefault();
    event.stopPropagation();
    this.move(which, this.times[which] + (steps[event.key] * (max - min)) / 200, chart);
  }

  move(which, time, chart) {
    const [start, stop] = chart.span;
    this.times[which] = Math.min(stop, Math.max(start, time));
    this.place();
  }

  place() {
    for (const { line, chart, which, isFirst } of this.lines ?? []) {
      const time = this.times[which];
      const left = chart.plot.valToPos(time, 'x');
      line.style.transform = `translateX(${left}px)`;
      line.style.visibility = left < -1 || left > chart.plot.over.clientWidth + 1 ? 'hidden' : '';
      if (!isFirst) continue;
      const { factor, name } = chart.timeUnit;
      line.setAttribute('aria-valuemin', String(chart.span[0] / factor));
      line.setAttribute('aria-valuemax', String(chart.span[1] / factor));
      line.setAttribute('aria-valuenow', String(time / factor));
      line.setAttribute('aria-valuetext', `${number(time / factor, 5)} ${name}`);
    }
    this.tell();
  }

  tell() {
    const charts = this.charts().filter((chart) => chart.span);
    const [from, to] = [...this.times].sort((a, b) => a - b);
    const { factor, name, } = charts[0].timeUnit;
    const span = (to - from) / factor;
    const time = (t, digits = 5) => (Number.isFinite(t) ? `${number(t / factor, digits)} ${name}` : '–');
    const rows = charts.flatMap(({ curves, shown }) => curves.map((curve) => {
      const values = this.times.map((t) => valueAt(curve.time, curve.values, t));
      const found = between(curve.time, curve.values, from, to);
      const scale = found ? Math.max(Math.abs(found.highest[1]), Math.abs(found.lowest[1])) : 0;
      const said = (value) => (Number.isNaN(value) ? '–' : `${scale > 0 ? spaced(value / shown.factor, scale / shown.factor / 1e3, 3) : '0'} ${shown.name}`.trim());
      return [curve.name, ...values.map(said), said(values[1] - values[0]), found ? `${said(found.highest[1])} ${t('at {time}', { time: time(found.highest[0], 4) })}` : '–',
        found ? `${said(found.lowest[1])} ${t('at {time}', { time: time(found.lowest[0], 4) })}` : '–', found ? time(found.period, 4) : '–'];
    }));
    const opened = this.host.querySelector('.scroll')?.scrollLeft ?? 0;
    const all = table([t('record'), t('at {time}', { time: time(this.times[0]) }), t('at {time}', { time: time(this.times[1]) }), t('difference'), t('highest between'), t('lowest between'), t('period')], rows, t('Measured'));
    this.host.replaceChildren(element('p', { class: 'apart' }, span > 0 ? t('Cursors {span} apart, {frequency} Hz', { span: `${number(span, 5)} ${name}`, frequency: number(1 / (to - from), 4) }) : t('Cursors {span} apart', { span: `0 ${name}` })), all);
    all.scrollLeft = opened;
  }
}
