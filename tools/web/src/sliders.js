// A slider for each number of a netlist. A moved slider changes the number in the text of the netlist; there is no other state.
import { breakable, element } from './dom.js';
import { typeset } from './formulas.js';
import { t } from './messages.js';
import { inPrint, number as inShort } from './units.js';

const steps = 400;
const main = 4; // sliders that are enough where there is little room and no demo says which matter
const decimal = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const literal = /^("(?:[^"\\]|\\.)*"|'[^']*'|[^\s,\]}#]+)/;

const rounded = (value) => Number(value.toPrecision(3));

class Slider {
  constructor(panel, knob) {
    this.panel = panel;
    this.knob = knob;
    const label = `${knob.group === 'parameters' ? '' : `${knob.group} `}${knob.name}`;
    this.range = element('input', { type: 'range', min: '0', max: String(steps), step: '1', 'aria-label': label });
    this.number = element('input', { type: 'text', inputmode: 'decimal', 'aria-label': t('{name}, value', { name: label }), size: '6' });
    this.range.addEventListener('input', () => this.slide(this.valueAt(Number(this.range.value))));
    this.range.addEventListener('pointerdown', () => (panel.held = this));
    // The range of a held slider is not adjusted.
    for (const end of ['change', 'pointerup', 'pointercancel', 'blur']) this.range.addEventListener(end, () => (panel.held = null));
    this.why = element('output', { class: 'why', hidden: true });
    this.number.addEventListener('change', () => this.take(this.number.value.trim()));
    this.number.addEventListener('input', () => this.accept());
    this.number.addEventListener('blur', () => this.putBack());
    this.number.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      this.accept();
      this.putBack();
    });
    this.undo = element('button', { type: 'button', class: 'undo', 'aria-label': t('Reset {name}', { name: label }), title: t('As the scene was opened'), onclick: () => this.reset() }, '↺');
    this.limits = { low: element('span'), high: element('span') };
    this.row = element('div', { class: 'slider', 'data-slider': this.path },
      element('span', { class: 'slider-name' }, breakable(knob.name), knob.description ? element('span', { class: 'hint', title: knob.description }, ' ', typeset(knob.description)) : null),
      element('span', { class: 'slider-way' }, this.range, element('span', { class: 'limits', 'aria-hidden': 'true' }, this.limits.low, this.limits.high)),
      this.number, element('span', { class: 'unit' }, breakable(inPrint(knob.unit))), this.undo, this.why);
    this.show();
  }

  get steps() {
    return steps;
  }

  get path() {
    return `${this.knob.group}.${this.knob.name}`;
  }

  // Takes a typed number. Any other text is refused: silently ignoring a unit or a comma would change the value.
  take(text) {
    const value = decimal.test(text) ? Number(text) : NaN;
    if (Number.isFinite(value)) {
      this.slide(value);
      if (!this.refused) this.putBack();
    } else {
      const what = this.knob.unit ? t('a number of {unit}', { unit: this.knob.unit }) : t('a number');
      this.refuse(text ? t('“{text}” is not {what}, such as 2.5 or 1e-3. Units and expressions belong in the netlist.', { text, what }) : t('Nothing is not {what}, such as 2.5 or 1e-3.', { what }));
    }
  }

  refuse(why) {
    this.refused = true;
    this.number.setAttribute('aria-invalid', 'true');
    this.why.textContent = why;
    this.why.hidden = false;
  }

  accept() {
    this.refused = false;
    this.number.removeAttribute('aria-invalid');
    this.why.hidden = true;
  }

  // The word why it was refused stays to be read.
  putBack() {
    this.number.removeAttribute('aria-invalid');
    this.number.value = String(this.knob.value);
  }

  // Where a value is on the slider.
  place() {
    const { value, low, high, scale } = this.knob;
    const part = scale === 'log' ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return Math.round(Math.min(1, Math.max(0, part)) * steps);
  }

  valueAt(place) {
    const { low, high, scale } = this.knob;
    const part = place / steps;
    if (scale === 'log') return rounded(low * (high / low) ** part);
    const value = low + (high - low) * part;
    if (this.knob.step) return rounded(low + Math.round((value - low) / this.knob.step) * this.knob.step);
    if (scale === 'whole') return Math.round(value);
    // Next to 0 is 0.
    return Math.abs(value) < (high - low) / (2 * steps) ? 0 : rounded(value);
  }

  widen() {
    const { knob } = this;
    if (knob.value > knob.high) knob.high = knob.value;
    if (knob.value < knob.low && (knob.scale !== 'log' || knob.value > 0)) knob.low = knob.value;
    if (knob.scale === 'log' && !(knob.value > 0)) Object.assign(knob, { scale: 'linear', low: Math.min(0, knob.value) });
  }

  show() {
    this.widen();
    this.range.value = String(this.place());
    for (const end of ['low', 'high']) this.limits[end].textContent = inShort(this.knob[end], 3);
    this.undo.style.visibility = this.isChanged ? '' : 'hidden';
    this.panel.showUndo();
    this.range.setAttribute('aria-valuetext', `${this.knob.value} ${inPrint(this.knob.unit)}`.trim());
    if (document.activeElement !== this.number || this.panel.held) this.number.value = String(this.knob.value);
  }

  get first() {
    return this.panel.firsts.get(`${this.knob.group}.${this.knob.name}`);
  }

  get isChanged() {
    return this.first !== undefined && this.first !== this.knob.value;
  }

  reset() {
    if (this.isChanged) this.slide(this.first);
  }

  // The number in the text, as it stands there.
  literal() {
    return literal.exec(this.panel.editor.view.state.sliceDoc(this.from, this.from + 500))?.[0];
  }

  settle(from) {
    this.from = from;
    this.was = this.literal();
  }

  slide(value) {
    const found = this.literal();
    if (!found || found !== this.was) {
      this.show();
      this.refuse(t('The netlist has changed here; the slider follows as soon as the netlist can be read.'));
      return;
    }
    this.accept();
    this.panel.latest = this;
    this.knob.value = value;
    this.show();
    const quote = /^["']/.test(found) ? found[0] : '';
    const text = this.knob.unit ? `${value} ${this.knob.unit}` : String(value);
    this.was = `${quote}${text}${quote}`;
    this.panel.editor.replace(this.from, this.from + found.length, this.was);
  }
}

export class Sliders {
  constructor(host, editor) {
    this.host = host;
    this.editor = editor;
    this.all = [];
    this.shape = '';
    this.held = null;
    this.latest = null; // the slider that was moved last
    this.firsts = new Map();
    this.undoAll = element('button', { type: 'button', class: 'undo-all', title: t('All numbers as the scene was opened (R)'), hidden: true, onclick: () => this.reset() }, t('↺ Reset all'));
    host.before(this.undoAll);
  }

  // All numbers as the scene was opened.
  reset() {
    // From the last one on, so that none moves before its turn.
    [...this.all].reverse().forEach((slider) => slider.reset());
  }

  showUndo() {
    this.undoAll.hidden = !this.all.some((slider) => slider.isChanged);
  }

  // Takes the sliders of a scene that was read from the text as it is; `first` are those that it had when it was opened.
  show(knobs, fresh, first = knobs) {
    if (fresh) this.firsts = new Map(first.map(({ group, name, value }) => [`${group}.${name}`, value]));
    const shape = JSON.stringify(knobs.map(({ group, name, unit }) => [group, name, unit]));
    if (fresh || shape !== this.shape) this.build(knobs);
    else
      this.all.forEach((slider, k) => {
        slider.settle(this.editor.offset(knobs[k].line, knobs[k].column));
        if (slider === this.held) return;
        slider.knob.value = knobs[k].value;
        slider.show();
      });
    this.shape = shape;
  }

  build(knobs) {
    this.held = this.latest = null;
    this.all = [];
    this.all = knobs.map((knob) => {
      const slider = new Slider(this, { ...knob });
      slider.settle(this.editor.offset(knob.line, knob.column));
      return slider;
    });
    const grouped = (sliders) => {
      const groups = new Map();
      [...sliders].sort((a, b) => order(a.knob.group) - order(b.knob.group)).forEach((slider) => {
        if (!groups.has(slider.knob.group)) groups.set(slider.knob.group, []);
        groups.get(slider.knob.group).push(slider.row);
      });
      return [...groups].map(([group, rows]) => element('fieldset', {}, element('legend', {}, breakable(group === 'simulate' ? t('run') : group)), rows));
    };
    const order = (group) => (group === 'parameters' ? 0 : group === 'simulate' ? 2 : 1);
    // A demo says which are worth moving; the others are folded away.
    const asked = this.all.filter(({ knob }) => knob.asked).sort((a, b) => a.knob.asked - b.knob.asked);
    const others = this.all.filter(({ knob }) => !knob.asked);
    if (asked.length) {
      const fields = element('fieldset', {}, element('legend', {}, t('to move')), asked.map(({ row }) => row));
      this.host.replaceChildren(fields,
        element('details', {}, element('summary', {}, t('All other numbers ({count})', { count: others.length })), grouped(others)));
    } else this.host.replaceChildren(...grouped(others));
    const matter = asked.length ? asked : [...others].sort((a, b) => order(a.knob.group) - order(b.knob.group)).slice(0, main);
    matter.forEach(({ row }) => row.classList.add('main'));
    this.showUndo();
    if (!this.all.length) this.host.append(element('p', { class: 'note' }, t('The netlist has no numbers to turn.')));
  }

  slide(path, value) {
    this.all.find((slider) => slider.path === path)?.slide(value);
  }

  // The texts in the netlist of the numbers with these paths, "parameters.B".
  literals(paths) {
    return Object.fromEntries(this.all.filter(({ path }) => paths.includes(path)).map((slider) => [slider.path, slider.literal()]));
  }

  // Writes other texts in the place of numbers. The sliders follow as soon as the netlist has been read.
  put(literals) {
    const changes = this.all.filter(({ path }) => literals[path]).map((slider) => ({ from: slider.from, to: slider.from + slider.literal().length, insert: literals[slider.path] }));
    this.editor.replaceAll(changes);
  }

  clear() {
    this.held = null;
    this.all = [];
    this.shape = '';
    this.host.replaceChildren(element('p', { class: 'note' }, t('The sliders are here as soon as the netlist can be read.')));
  }

  // The text has changed before them.
  move(changes) {
    this.all.forEach((slider) => (slider.from = changes.mapPos(slider.from, -1)));
  }
}
