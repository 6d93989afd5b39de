// The plots of one or several runs, over time or of one quantity against another, with a choice of records.
import { colourInPrint, dashes } from './chart.js';
import { element, freshId } from './dom.js';
import { LoopChart } from './loop-chart.js';
import { Measure } from './measure.js';
import { t } from './messages.js';
import { inWords } from './sections.js';
import { TimeChart, TimeGroup } from './time-chart.js';

const kinds = [
  { id: 'own', label: t('As the scene says') },
  { id: 'time', label: t('Over time') },
  { id: 'loop', label: t('Force against displacement'), x: 'displacement', y: 'force' },
  { id: 'flow', label: t('Force against velocity'), x: 'velocity', y: 'force' },
  { id: 'phase', label: t('Phase plane'), x: 'position', y: 'velocity' },
  { id: 'pair', label: t('Any two records') },
];
const least = (usual, presenting) => (document.body.classList.contains('presenting') ? presenting : usual); // Heights [px].
const few = { curves: 4, panels: 3, all: 8 }; // Default limits: curves of one quantity, panels, curves in all.

const sentence = (text) => `${text[0]?.toUpperCase() ?? ''}${text.slice(1)}${/[.!?]$/.test(text) ? '' : '.'}`;

export class PlotPanel {
  // `fits`: the charts share the height of their host. `traces`: those that are kept, with their buttons.
  constructor(host, { onchange = () => {}, fits = false, traces = null } = {}) {
    this.host = host;
    this.onchange = onchange;
    this.fits = fits;
    this.traces = traces;
    this.isHeld = false;
    this.first = 0; // panel that is shown, where there is no room for all
    this.measure = new Measure(() => this.charts.filter((chart) => chart instanceof TimeChart));
    this.holdButton = element('button', { type: 'button', class: 'hold', 'aria-pressed': 'false', onclick: () => this.hold(!this.isHeld), title: t('The vertical axes stay as they are (H)') }, t('Hold axes'));
    this.eventKey = element('details', { class: 'event-key', hidden: true }, element('summary', {}, t('What are the lines?')),
      element('p', {}, t('The vertical lines are events: something sticks, slips, touches, lets go, yields or turns back, or an input jumps or has a corner.')));
    this.nextButton = element('button', { type: 'button', class: 'next-plot', hidden: true, onclick: () => this.showNext() });
    this.kind = null; // nobody has chosen
    this.owner = null;
    this.chosen = null;
    this.pair = null; // two records, of the kind `pair`
    this.charts = [];
    this.runs = [];
    this.failures = []; // runs of which there is nothing to draw
    this.shape = '';
    this.tabs = element('div', { class: 'tabs', role: 'radiogroup', 'aria-label': t('Kind of plot'), hidden: true });
    this.tools = element('div', { class: 'plot-tools' });
    this.body = element('div', { class: 'plots' });
    document.addEventListener('pointerdown', (event) => {
      const chooser = this.tools.querySelector('details[open]');
      if (chooser && !chooser.contains(event.target)) chooser.open = false;
    });
    host.append(element('div', { class: 'plot-head' }, this.tabs, this.tools), this.body, this.measure.host);
    if (fits) (this.watch = new ResizeObserver(() => this.fit())).observe(this.body);
    const name = freshId('kind');
    for (const kind of kinds) {
      const input = element('input', { type: 'radio', name, value: kind.id, checked: kind.id === 'time' });
      input.addEventListener('change', () => this.choose({ kind: kind.id }));
      this.tabs.append(element('label', { 'data-kind': kind.id }, input, element('span', {}, kind.label)));
    }
  }

  // runs: [{ label, data }]; curves carry the labels where there are several.
  show(runs) {
    const read = runs.filter((run) => run.data.scene);
    this.failures = read.filter(({ data }) => data.failed && !data.hasCurves);
    this.runs = read.filter((run) => !this.failures.includes(run));
    this.tabs.hidden = !this.runs.length;
    this.tabs.querySelector('[data-kind="own"]').hidden = !this.ownCurves().length;
    for (const input of this.tabs.querySelectorAll('input')) input.checked = input.value === this.shownKind;
    const shape = JSON.stringify([
      this.failures.map(({ data }) => data.failed.message),
      this.shownKind,
      this.ownCurves(),
      this.owner,
      this.pair,
      this.chosen && [...this.chosen],
      this.runs.map((run) => [run.label, run.data.records.map((record) => [record.path, record.unit])]),
    ]);
    if (shape === this.shape) this.update();
    else this.build();
    this.shape = shape;
    // The events come after the curves: until then the key stays as it was.
    if (this.runs.every(({ data }) => data.done || data.failed)) this.eventKey.hidden = this.shownKind !== 'time' || !this.charts.length || !this.eventTimes().length;
    this.measure.show();
  }

  hold(on) {
    this.isHeld = on;
    this.holdButton.setAttribute('aria-pressed', String(on));
    this.charts.forEach((chart) => chart.hold(on));
  }

  // The charts share the height that there is; where it is too little for all, a presentation shows some at a time.
  fit() {
    if (!this.fits || !this.body.clientHeight || !this.charts.length) return;
    const hosts = this.charts.map(({ host }) => host);
    hosts.forEach((host) => (host.hidden = false));
    const beside = hosts.map((host, k) => host.offsetHeight - this.charts[k].height); // legends
    const needed = least(290, 125) + Math.max(...beside);
    this.body.style.minHeight = `${least(needed * hosts.length, 0)}px`; // The page scrolls where the screen is too small.
    const room = this.body.clientHeight;
    const most = Math.max(1, Math.floor(room / needed));
    const count = Math.min(most, hosts.length);
    this.first = Math.min(this.first, hosts.length - count);
    const shown = hosts.map((_, k) => k >= this.first && k < this.first + count);
    hosts.forEach((host, k) => (host.hidden = !shown[k]));
    this.nextButton.hidden = count === hosts.length;
    this.nextButton.textContent = t('Other plots ({count})', { count: hosts.length - count });
    const free = room - beside.reduce((sum, height, k) => sum + (shown[k] ? height : 0), 0);
    this.charts.forEach((chart, k) => shown[k] && chart.setHeight(Math.max(60, Math.floor(free / count) - 1)));
    this.measure.show();
  }

  showNext() {
    const shown = this.charts.filter(({ host }) => !host.hidden).length;
    this.first = this.first + shown >= this.charts.length ? 0 : this.first + shown;
    this.fit();
  }

  choose(choice) {
    Object.assign(this, choice);
    this.show(this.runs);
    this.onchange();
  }

  // The user's choices, for a link.
  get state() {
    return { kind: this.kind, owner: this.owner, chosen: this.chosen && [...this.chosen], pair: this.pair };
  }
  set state({ kind, owner, chosen, pair }) {
    this.kind = kinds.some((known) => known.id === kind) ? kind : null;
    this.owner = owner ?? null;
    this.chosen = chosen ? new Set(chosen) : null;
    this.pair = Array.isArray(pair) ? pair : null;
  }

  // The curves of [plot] that are not over time.
  ownCurves() {
    const curves = this.runs[0]?.data.scene.plot?.curves ?? [];
    return curves.filter(([x]) => x !== 'time');
  }

  get shownKind() {
    const own = this.ownCurves().length > 0;
    if (this.kind && (this.kind !== 'own' || own)) return this.kind;
    return own ? 'own' : 'time';
  }

  build() {
    this.charts.forEach((chart) => chart.destroy());
    this.charts = [];
    this.body.replaceChildren();
    this.tools.replaceChildren();
    this.body.append(...this.failures.map(({ label, data }) => element('p', { class: 'note bad no-curves' },
      `${label ? `${label}: ` : ''}${data.failed.limit ? t('There is nothing to draw so far.') : t('There is nothing to draw, as the run does not get beyond its start.')} `, inWords(sentence(data.failed.message)))));
    if (!this.runs.length) return;
    const kind = kinds.find((known) => known.id === this.shownKind);
    if (kind.id === 'time') this.buildTime();
    else if (kind.id === 'own') this.buildAgainst(this.ownCurves());
    else if (kind.id === 'pair') this.buildPair();
    else this.buildLoop(kind);
    this.tools.append(...[this.nextButton, this.traces?.controls, kind.id === 'time' ? this.measure.button : null, this.holdButton, this.eventKey].filter(Boolean));
    if (this.isHeld) this.charts.forEach((chart) => chart.hold(true));
    // Names that need another line take it from the charts.
    if (this.watch) this.charts.forEach(({ host }) => host.querySelectorAll('.u-legend, .loop-legend').forEach((legend) => this.watch.observe(legend)));
    this.fit();
  }

  update() {
    const kind = kinds.find((known) => known.id === this.shownKind);
    if (kind.id === 'own' || kind.id === 'pair') {
      const panels = this.panelsOf(kind.id === 'own' ? this.ownCurves() : [this.shownPair()]);
      this.charts.forEach((chart, k) => chart.update(panels[k].curves));
      return;
    }
    if (kind.id !== 'time') {
      const curves = this.loopCurves(kind);
      if (this.charts[0]) this.charts[0].update(curves);
      return;
    }
    const panels = this.panels();
    this.charts.forEach((chart, k) => chart.update(panels[k].curves, this.eventTimes()));
  }

  // A panel for each pair of quantities among `pairs` of records, which are drawn against each other.
  panelsOf(pairs) {
    const panels = new Map();
    this.runs.forEach(({ label, data }, run) => {
      pairs.forEach(([x, y], style) => {
        const sides = [x, y].map((path) => data.records[data.index.get(path)]);
        if (!sides[0] || !sides[1]) return;
        const [across, up] = sides.map(({ quantity, unit, shown }) => ({ quantity, unit, as: shown }));
        const key = JSON.stringify([across, up]);
        if (!panels.has(key)) panels.set(key, { x: across, y: up, curves: [] });
        const panel = panels.get(key);
        const name = pairs.every(([other]) => other === x) ? y : t('{y} against {x}', { y, x });
        panel.curves.push({ name: label ? `${label} ${name}` : name, time: data.time, x: data.column(x), y: data.column(y), ...this.look(run, style), paths: [x, y], run, data });
      });
    });
    return [...panels.values()];
  }

  buildAgainst(pairs) {
    for (const panel of this.panelsOf(pairs)) {
      const host = element('div');
      this.body.append(host);
      this.charts.push(new LoopChart(host, panel));
    }
  }

  // The records of all runs, by their paths.
  get allRecords() {
    return new Map(this.runs.flatMap(({ data }) => data.records.map((record) => [record.path, record])));
  }

  // The two records that are drawn against each other: by default the first force over the position of the first driven node.
  shownPair() {
    const all = [...this.allRecords.values()];
    const known = (path) => all.find((record) => record.path === path)?.path;
    const first = (channel, owner) => all.find((record) => record.channel === channel && (!owner || record.owner === owner))?.path;
    const driven = this.runs[0].data.scene.elements.find(({ type, a }) => ['motion', 'force', 'torque'].includes(type) && first('position', a))?.a;
    return [known(this.pair?.[0]) ?? first('position', driven) ?? all[0]?.path, known(this.pair?.[1]) ?? first('force') ?? all.at(-1)?.path];
  }

  buildPair() {
    const paths = [...this.allRecords.keys()];
    const pair = this.shownPair();
    const select = (side, label) => {
      const input = element('select', { 'aria-label': label }, paths.map((path) => element('option', { value: path, selected: path === pair[side] }, path)));
      input.addEventListener('change', () => {
        this.choose({ pair: side ? [pair[0], input.value] : [input.value, pair[1]] });
        this.tools.querySelectorAll('select')[1 - side].focus(); // The charts are built anew.
      });
      return input;
    };
    this.tools.append(select(1, t('vertical axis')), t('against'), select(0, t('horizontal axis')));
    this.buildAgainst([pair]);
  }

  // Where there are several runs the colour tells them apart, everywhere, and the dashes tell their records apart; of a single run the
  // colour tells its records apart.
  look(run, record) {
    return this.runs.length > 1 ? { style: this.runs[run].colour ?? run, dash: record } : { style: record, dash: Math.floor(record / 7) };
  }

  // The records that are shown, by default those that the scene draws, or the first of each quantity that the scene itself records.
  shownPaths() {
    if (this.chosen) return this.chosen;
    const drawn = this.runs.flatMap(({ data }) => data.scene.plot?.curves ?? []).filter(([x]) => x === 'time').map(([, y]) => y);
    if (drawn.length) return new Set(drawn);
    const counts = new Map();
    const paths = new Set();
    for (const { data } of this.runs)
      data.records.slice(0, data.scene.own_records).forEach(({ path, quantity, unit }) => {
        const key = `${quantity} ${unit}`;
        if (paths.has(path) || paths.size >= few.all || (!counts.has(key) && counts.size >= few.panels)) return;
        counts.set(key, (counts.get(key) ?? 0) + 1);
        if (counts.get(key) <= few.curves) paths.add(path);
      });
    return paths;
  }

  panels() {
    const paths = this.shownPaths();
    const panels = new Map();
    this.runs.forEach(({ label, data }, run) => {
      data.records.forEach((record, k) => {
        if (!paths.has(record.path)) return;
        const key = `${record.quantity}|${record.unit}`;
        if (!panels.has(key)) panels.set(key, { quantity: record.quantity, unit: record.unit, as: record.shown, names: [], curves: [] });
        const panel = panels.get(key);
        if (!panel.names.includes(record.path)) panel.names.push(record.path);
        panel.curves.push({
          name: label ? `${label} ${record.path}` : record.path,
          time: data.time,
          values: data.columns[k],
          ...this.look(run, panel.names.indexOf(record.path)),
          paths: ['time', record.path],
          run,
        });
      });
    });
    return [...panels.values()];
  }

  eventTimes() {
    return this.runs.length === 1 ? [...new Set(this.runs[0].data.events.items.map((item) => item[0]))] : [];
  }

  buildTime() {
    this.group = new TimeGroup();
    const panels = this.panels();
    panels.forEach(({ quantity, unit, as, curves }, k) => {
      const host = element('div');
      this.body.append(host);
      this.charts.push(new TimeChart(host, this.group, { quantity, unit, as, curves, events: this.eventTimes(),
        height: panels.length > 1 ? 200 : 260, labelled: k === panels.length - 1 }));
    });
    if (!panels.length) this.body.append(element('p', { class: 'note' }, t('Choose what is to be shown.')));
    this.tools.append(this.chooser());
  }

  chooser() {
    const shown = this.shownPaths();
    const all = this.allRecords;
    const boxes = element('div', { class: 'boxes' });
    const chosen = [...shown].filter((path) => all.has(path)).length;
    const count = element('span', {}, t('Records ({shown} of {all})', { shown: chosen, all: all.size }));
    for (const [path, record] of all) {
      const box = element('input', { type: 'checkbox', checked: shown.has(path) });
      box.addEventListener('change', () => {
        const paths = new Set(this.shownPaths());
        if (box.checked) paths.add(path);
        else paths.delete(path);
        this.keepOpen = true;
        this.focusOn = path;
        this.choose({ chosen: paths });
      });
      boxes.append(element('label', { title: `${record.quantity} [${record.unit}]`, 'data-path': path }, box, ` ${path}`));
    }
    const find = element('input', { type: 'search', placeholder: t('find'), 'aria-label': t('Find records') });
    find.addEventListener('input', () => {
      for (const label of boxes.children) label.hidden = !label.dataset.path.includes(find.value.trim());
    });
    const details = element('details', { class: 'chooser', open: Boolean(this.keepOpen) }, element('summary', {}, count),
      element('div', { class: 'chooser-body' }, all.size > 12 ? find : null, this.ownRecordsButton(shown), boxes));
    details.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || !details.open) return;
      details.open = false;
      details.querySelector('summary').focus();
      event.stopPropagation();
    });
    if (this.keepOpen) queueMicrotask(() => boxes.querySelector(`[data-path="${CSS.escape(this.focusOn)}"] input`)?.focus());
    this.keepOpen = false;
    return details;
  }

  // All that the scene itself records, where only a few of them are shown.
  ownRecordsButton(shown) {
    const own = [...new Set(this.runs.flatMap(({ data }) => data.records.slice(0, data.scene.own_records).map(({ path }) => path)))];
    if (own.every((path) => shown.has(path))) return null;
    return element('button', { type: 'button', class: 'all-own', onclick: () => this.choose({ chosen: new Set([...shown, ...own]) }) }, t('All {count} that the scene records', { count: own.length }));
  }

  loopCurves(kind) {
    const curves = [];
    this.runs.forEach(({ label, data }, run) => {
      const x = data.column(`${this.loopOwner}.${kind.x}`);
      const y = data.column(`${this.loopOwner}.${kind.y}`);
      const paths = [kind.x, kind.y].map((channel) => `${this.loopOwner}.${channel}`);
      if (x && y) curves.push({ name: label ? `${label} ${this.loopOwner}` : this.loopOwner, time: data.time, x, y, ...this.look(run, 0), paths, run, data });
    });
    return curves;
  }

  buildLoop(kind) {
    const owners = [...new Set(this.runs.flatMap(({ data }) => data.ownersOf(kind.x, kind.y)))];
    if (!owners.length) {
      this.body.append(element('p', { class: 'note' }, t('The run has no {x} and {y} of one element to draw against each other.', { x: kind.x, y: kind.y })));
      return;
    }
    this.loopOwner = owners.includes(this.owner) ? this.owner : owners[0];
    const select = element('select', { 'aria-label': t('Whose') }, owners.map((owner) => element('option', { value: owner, selected: owner === this.loopOwner }, owner)));
    select.addEventListener('change', () => this.choose({ owner: select.value }));
    this.tools.append(select);
    const record = (channel) => {
      for (const { data } of this.runs) {
        const k = data.index.get(`${this.loopOwner}.${channel}`);
        if (k !== undefined) return data.records[k];
      }
      return null;
    };
    const side = (channel) => ({ quantity: record(channel).quantity, unit: record(channel).unit, as: record(channel).shown });
    const host = element('div');
    this.body.append(host);
    this.charts.push(new LoopChart(host, { x: side(kind.x), y: side(kind.y), curves: this.loopCurves(kind) }));
  }

  // The visible curves in the order of the runs, with the colours, dashes and units on the screen, for export.
  drawnCurves() {
    const ofRuns = this.runs.map(() => []);
    this.charts.forEach((chart, panel) => {
      const [xUnit, yUnit] = chart.units ?? [chart.timeUnit, chart.shown];
      for (const { name, paths: [x, y], run, style, dash } of chart.curves)
        ofRuns[run].push({ x, y, name, panel, color: colourInPrint(style), dashes: dashes[dash % dashes.length].join(' '), x_unit: xUnit, y_unit: yUnit });
    });
    return ofRuns;
  }

  // Marks a time in all charts.
  mark(time) {
    for (const chart of this.charts) chart.mark(time, chart.curves.map((curve) => curve.data?.at(time) ?? 0));
  }
}
