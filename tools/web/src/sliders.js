// A slider for each number of a netlist. What is moved is written into the text of the netlist, which is all there is.
import { element } from './dom.js';
import { number } from './units.js';

const steps = 400;
const literal = /^("(?:[^"\\]|\\.)*"|'[^']*'|[^\s,\]}#]+)/;

const rounded = (value) => Number(value.toPrecision(3));

class Slider {
  constructor(panel, knob) {
    this.panel = panel;
    this.knob = knob;
    const label = `${knob.group === 'parameters' ? '' : `${knob.group} `}${knob.name}`;
    this.range = element('input', { type: 'range', min: '0', max: String(steps), step: '1', 'aria-label': label });
    this.number = element('input', { type: 'text', inputmode: 'decimal', 'aria-label': `${label}, value`, size: '6' });
    this.range.addEventListener('input', () => this.slide(this.valueAt(Number(this.range.value))));
    this.range.addEventListener('pointerdown', () => (panel.held = this));
    this.range.addEventListener('change', () => (panel.held = null));
    this.number.addEventListener('change', () => {
      const value = Number.parseFloat(this.number.value.replace(',', '.'));
      if (Number.isFinite(value)) this.slide(value);
      this.number.value = number(this.knob.value, 6);
    });
    this.row = element('div', { class: 'slider', title: knob.description, 'data-slider': `${knob.group}.${knob.name}` },
      element('span', { class: 'slider-name' }, knob.name), this.range, this.number, element('span', { class: 'unit' }, knob.unit));
    this.show();
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
    this.range.setAttribute('aria-valuetext', `${this.knob.value} ${this.knob.unit}`);
    if (document.activeElement !== this.number || this.panel.held) this.number.value = number(this.knob.value, 6);
  }

  slide(value) {
    this.knob.value = value;
    this.show();
    const { editor } = this.panel;
    const found = literal.exec(editor.view.state.sliceDoc(this.from, this.from + 500));
    if (!found) return;
    const quote = /^["']/.test(found[0]) ? found[0][0] : '';
    const text = this.knob.unit ? `${value} ${this.knob.unit}` : String(value);
    editor.replace(this.from, this.from + found[0].length, quote ? `${quote}${text}${quote}` : text);
  }
}

export class Sliders {
  constructor(host, editor) {
    this.host = host;
    this.editor = editor;
    this.all = [];
    this.shape = '';
    this.held = null;
  }

  // Takes the sliders of a scene that was read from the text as it is.
  show(knobs, fresh) {
    const shape = JSON.stringify(knobs.map(({ group, name, unit }) => [group, name, unit]));
    if (fresh || shape !== this.shape) this.build(knobs);
    else
      this.all.forEach((slider, k) => {
        slider.from = this.editor.offset(knobs[k].line, knobs[k].column);
        if (slider === this.held) return;
        slider.knob.value = knobs[k].value;
        slider.show();
      });
    this.shape = shape;
  }

  build(knobs) {
    this.held = null;
    this.all = knobs.map((knob) => {
      const slider = new Slider(this, { ...knob });
      slider.from = this.editor.offset(knob.line, knob.column);
      return slider;
    });
    const grouped = (sliders) => {
      const groups = new Map();
      const order = (group) => (group === 'parameters' ? 0 : group === 'simulate' ? 2 : 1);
      [...sliders].sort((a, b) => order(a.knob.group) - order(b.knob.group)).forEach((slider) => {
        if (!groups.has(slider.knob.group)) groups.set(slider.knob.group, []);
        groups.get(slider.knob.group).push(slider.row);
      });
      return [...groups].map(([group, rows]) => element('fieldset', {}, element('legend', {}, group === 'simulate' ? 'run' : group), rows));
    };
    // A demo says which are worth moving; the others are folded away.
    const asked = this.all.filter(({ knob }) => knob.asked).sort((a, b) => a.knob.asked - b.knob.asked);
    const others = this.all.filter(({ knob }) => !knob.asked);
    if (asked.length) {
      this.host.replaceChildren(element('fieldset', {}, element('legend', {}, 'to move'), asked.map(({ row }) => row)),
        element('details', {}, element('summary', {}, `All other numbers (${others.length})`), grouped(others)));
    } else this.host.replaceChildren(...grouped(others));
    if (!this.all.length) this.host.append(element('p', { class: 'note' }, 'The netlist has no numbers to turn.'));
  }

  // The text has changed before them.
  move(changes) {
    this.all.forEach((slider) => (slider.from = changes.mapPos(slider.from, -1)));
  }
}
