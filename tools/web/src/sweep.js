// One number of the netlist goes through a range, and a measure of each run is drawn over it: a resonance curve, say.
import { task } from './api.js';
import { element } from './dom.js';
import { LoopChart } from './loop-chart.js';
import { t } from './messages.js';
import { inPrint, number, withUnit } from './units.js';

// The measures: `texts(record, third, other)` returns measures for `rheonet sweep --measure`, and `of` computes a number from their values. A
// measure that compares two records uses their difference, which is added to the records of the netlist.
const difference = 'difference_of_two';
const measures = {
  magnitude: { label: t('largest magnitude'), texts: (record) => [`max(${record})`, `min(${record})`], of: ([high, low]) => Math.max(Math.abs(high), Math.abs(low)) },
  amplitude: { label: t('amplitude in the last third'), texts: (record, third) => [`max(${record}, from ${third} s)`, `min(${record}, from ${third} s)`], of: ([high, low]) => (high - low) / 2 },
  largest: { label: t('largest value'), texts: (record) => [`max(${record})`] },
  final: { label: t('final value'), texts: (record) => [`final(${record})`] },
  rms: { label: t('root mean square'), texts: (record) => [`rms(${record})`] },
  error: { label: t('largest difference from'), texts: () => [`max(${difference})`, `min(${difference})`], of: ([high, low]) => Math.max(Math.abs(high), Math.abs(low)), isOfTwo: true },
  dissipated: { label: t('energy dissipated'), texts: () => ['energy dissipated'], isOfRun: true },
  steps: { label: t('steps'), texts: () => ['steps'], isOfRun: true },
};

const drives = new Set(['force', 'torque', 'motion']);
const most = 400; // runs
const decimal = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

export class SweepPanel {
  // request(): the netlist that is edited; load(path, value): gives a number of it another value.
  constructor(request, load) {
    this.latest = request;
    this.load = load;
    this.clear();
  }

  // For another scene.
  clear() {
    this.chosen = { count: '40' }; // what somebody has chosen stays when the netlist changes
    this.drawn = [];
  }

  // A part of the page for a scene; request: its text, file and session.
  show(scene, request) {
    this.stop();
    Object.assign(this, { scene, request });
    this.host = element('div', { class: 'analysis' }, element('p', {}, t('Runs the scene for many values of a number, and draws a measure of each run.')));
    this.fields = element('form', { class: 'sweep-fields' });
    this.fields.addEventListener('submit', (event) => {
      event.preventDefault();
      this.run();
    });
    this.result = element('div', { class: request.text === this.drawnOf ? null : 'stale' }, this.drawn);
    this.host.append(this.fields, this.result);
    this.build();
    return this.host;
  }

  get knobs() {
    return this.scene.sliders.map((knob) => ({ ...knob, path: `${knob.group}.${knob.name}` })).filter(({ path }) => path !== 'simulate.accuracy');
  }

  get knob() {
    const asked = this.knobs.filter((each) => each.asked).sort((a, b) => a.asked - b.asked);
    return this.knobs.find(({ path }) => path === this.chosen.path) ?? asked[0] ?? this.knobs[0];
  }

  // Sweeps the number with this path.
  begin(path) {
    this.chosen.path = path;
    if (this.fields) this.build();
  }

  get measure() {
    return measures[this.chosen.measure] ?? measures.magnitude;
  }

  build() {
    const { knob, chosen } = this;
    if (!knob) {
      this.fields.replaceChildren(element('p', { class: 'note' }, t('The netlist has no numbers to turn.')));
      return;
    }
    const of = `${knob.path} ${knob.unit}`;
    if (chosen.of !== of) ['low', 'high', 'log'].forEach((key) => delete chosen[key]);
    chosen.of = of;
    const choose = (key, label, values, now) => {
      const select = element('select', { 'aria-label': label }, values.map(([value, name]) => element('option', { value, selected: value === now }, name)));
      select.addEventListener('change', () => {
        chosen[key] = select.value;
        this.build();
      });
      return select;
    };
    const type = (key, label, value) => {
      const input = element('input', { type: 'text', inputmode: 'decimal', size: '7', value, 'aria-label': label });
      input.addEventListener('change', () => (chosen[key] = input.value.trim()));
      return element('label', {}, `${label} `, input);
    };
    const records = this.scene.records.map(({ path }) => [path, path]);
    const log = element('input', { type: 'checkbox', checked: this.isLog });
    log.addEventListener('change', () => (chosen.log = log.checked));
    const record = this.measure.isOfRun ? null : choose('record', t('record'), records, this.record);
    const other = this.measure.isOfTwo ? choose('other', t('other record'), records, this.other) : null;
    this.fields.replaceChildren(...[
      element('label', {}, `${t('number')} `, choose('path', t('number'), this.knobs.map(({ path, group, name }) => [path, group === 'parameters' ? name : path]), knob.path)),
      type('low', t('from'), chosen.low ?? String(knob.low)), type('high', t('to'), chosen.high ?? String(knob.high)), element('span', { class: 'unit' }, knob.unit),
      type('count', t('runs'), chosen.count),
      element('label', {}, log, ` ${t('logarithmic')}`),
      element('label', {}, `${t('measure')} `, choose('measure', t('measure'), Object.entries(measures).map(([key, { label }]) => [key, label]), chosen.measure ?? 'magnitude')),
      this.measure.isOfTwo ? [other, element('span', {}, '–'), record] : record,
      (this.button = element('button', { type: 'submit' }, t('Run the sweep'))),
    ].flat().filter(Boolean));
  }

  get isLog() {
    return this.chosen.log ?? this.knob.scale === 'log';
  }

  // Records that are chosen, if the scene still has them, or else the first that no drive gives.
  get record() {
    const given = new Set(this.scene.elements.filter(({ type }) => drives.has(type)).flatMap(({ name, type, a }) =>
      (type === 'motion' ? [`${a}.position`, `${a}.velocity`] : [`${name}.force`])));
    const { records } = this.scene;
    return this.known(this.chosen.record) ?? (records.find(({ path }) => !given.has(path)) ?? records[0])?.path;
  }
  get other() {
    return this.known(this.chosen.other) ?? this.scene.records[1]?.path ?? this.record;
  }
  known(path) {
    return this.scene.records.find((record) => record.path === path)?.path;
  }

  // The values of the number as texts for a netlist; throws an error if a field is invalid.
  values() {
    const { knob, chosen } = this;
    const read = (text) => {
      if (!decimal.test(text)) throw new Error(t('“{text}” is not a number.', { text }));
      return Number(text);
    };
    const [low, high] = [read(chosen.low ?? String(knob.low)), read(chosen.high ?? String(knob.high))];
    const count = Math.min(most, Math.max(2, Math.round(read(chosen.count))));
    const isLog = this.isLog && low > 0 && high > 0;
    const all = Array.from({ length: count }, (_, k) => (isLog ? low * (high / low) ** (k / (count - 1)) : low + ((high - low) * k) / (count - 1)));
    const rounded = all.map((value) => (knob.step || knob.scale === 'whole' ? low + Math.round((value - low) / (knob.step || 1)) * (knob.step || 1) : Number(value.toPrecision(12))));
    return { numbers: [...new Set(rounded)], isLog };
  }

  stop() {
    this.control?.abort();
    this.control = null;
  }

  async run() {
    if (this.control) {
      this.stop();
      this.button.textContent = t('Run the sweep');
      return;
    }
    let values;
    try {
      values = this.values();
    } catch (error) {
      this.result.replaceChildren(element('p', { class: 'note bad' }, error.message));
      return;
    }
    const { knob, measure, record, other, scene, request } = this;
    const third = scene.start + (2 * (scene.stop - scene.start)) / 3;
    const control = new AbortController();
    this.control = control;
    this.button.textContent = t('Stop');
    const found = { x: [], y: [], failed: [], unit: '1', wrong: '' };
    const begin = (message) => {
      if (message.kind === 'measures') found.unit = message.units[0];
      if (message.kind === 'failed') found.wrong = message.message;
      if (message.kind === 'point') this.take(message, found, measure, values, control);
    };
    const set = measure.isOfTwo ? [`simulate.record=[{ name = "${difference}", value = "${other} - ${record}" }]`] : [];
    try {
      await task({ ...request, task: 'sweep', session: `${request.session}-sweep`, path: knob.path, set, measures: measure.texts(record, third),
        values: values.numbers.map((value) => (knob.unit ? `${value} ${knob.unit}` : String(value))) }, begin, control.signal);
    } catch (error) {
      if (error.name === 'AbortError') return;
      found.wrong = error.message;
    }
    if (this.control !== control) return;
    this.control = null;
    this.button.textContent = t('Run the sweep');
    this.draw(found, values);
  }

  take({ value, measures: of, failure }, found, measure, values, control) {
    if (this.control !== control) return;
    if (failure) found.failed.push(failure);
    else if (of.every(Number.isFinite)) {
      found.x.push(Number.parseFloat(value));
      found.y.push((measure.of ?? (([one]) => one))(of));
    }
    if (performance.now() - (this.lastDrawn ?? 0) < 300) return;
    this.lastDrawn = performance.now();
    this.draw(found, values);
  }

  draw({ x, y, failed, unit, wrong }, { numbers, isLog }) {
    this.chart?.destroy();
    this.chart = null;
    this.pick = null;
    this.drawnOf = this.request.text;
    const host = element('div');
    const { knob, measure, record, other } = this;
    const name = measure.isOfRun ? measure.label : measure.isOfTwo ? `${other} – ${record}` : `${measure.label}: ${record}`;
    this.drawn = [
      wrong ? element('p', { class: 'note bad' }, wrong) : null,
      x.length > 1 ? host : null,
      x.length > 1 && !this.control ? this.point(x, y, unit, name) : null,
      element('p', { class: 'note', role: 'status' }, t('{done} of {all} runs', { done: x.length + failed.length, all: numbers.length })),
      failed.length ? element('p', { class: 'note bad' }, t('{count} of the runs failed. The first: {failure}', { count: failed.length, failure: failed[0] })) : null,
    ].filter(Boolean);
    this.result.classList.remove('stale');
    this.result.replaceChildren(...this.drawn);
    const isPositive = y.every((value) => value > 0);
    if (x.length > 1)
      this.chart = new LoopChart(host, {
        x: { quantity: knob.name, unit: knob.unit, as: { name: knob.unit, factor: 1 }, log: isLog && isPositive },
        y: { quantity: measure.label, unit: unit === '1' ? '' : unit, log: isLog && isPositive },
        curves: [{ name, x, y }], height: 300, marks: true, onpick: (_, i) => this.pick?.(i),
      });
    this.host.dataset.last = y.length ? `${number(x.at(-1))} ${number(y.at(-1), 6)}` : '';
  }

  // One point of the curve: by default the highest. It is chosen in the chart or here, and its value can be put into the netlist.
  point(x, y, unit, name) {
    const { path, name: of, unit: ofNumber } = this.knob;
    const range = element('input', { type: 'range', min: '0', max: String(x.length - 1), step: '1', 'aria-label': t('Point of the curve') });
    const said = element('output', { class: 'point' });
    const show = () => {
      const i = Number(range.value);
      said.textContent = `${of} = ${`${number(x[i], 6)} ${inPrint(ofNumber)}`.trim()}, ${name} = ${withUnit(y[i], unit, 6)}`;
      range.setAttribute('aria-valuetext', said.textContent);
      if (!this.chart) return;
      this.chart.hide();
      this.chart.show(0, i);
    };
    this.pick = (i) => {
      range.value = String(i);
      show();
    };
    range.addEventListener('input', show);
    this.pick(y.indexOf(Math.max(...y)));
    return element('div', { class: 'sweep-point' }, range, said, element('button', { type: 'button', onclick: () => {
      this.load(path, x[Number(range.value)]);
      this.drawnOf = this.latest().text;
    } }, t('Load this point')));
  }
}
