// Runs that are kept in the plots, to be compared with those that come after them.
import { element } from './dom.js';
import { withUnits } from './formulas.js';
import { t } from './messages.js';

const most = 5;
const firstColour = 2; // After those of two variants: a frozen curve keeps its colour when a comparison begins.

export class Traces {
  // onchange(): the plots are to be drawn anew.
  constructor(onchange) {
    this.onchange = onchange;
    this.all = [];
    this.freezeButton = element('button', { type: 'button', class: 'freeze', onclick: () => this.freeze(), title: t('Keep these curves, and see the next ones beside them (T)') }, t('Freeze'));
    this.clearButton = element('button', { type: 'button', class: 'thaw', onclick: () => this.clear(), hidden: true }, t('Clear'));
    this.controls = element('span', { class: 'traces' }, this.freezeButton, this.clearButton);
  }

  // Sets the run that would be kept: data and text of a variant. `first`: the numbers of the scene when it was opened.
  offer(variant) {
    this.offered = variant.data.hasCurves ? { data: variant.data, text: variant.shown ?? variant.text, file: variant.file, first: variant.first ?? [] } : null;
    this.freezeButton.disabled = !this.offered || this.all.length >= most || this.all.some(({ data }) => data === this.offered.data);
  }

  freeze() {
    if (!this.offered || this.freezeButton.disabled) return;
    this.all.push({ ...this.offered, label: this.nameOf(this.offered), colour: firstColour + this.all.length });
    this.show();
  }

  // The numbers that make the run another one than the first, or how many it is.
  nameOf({ data, first }) {
    const before = new Map(first.map(({ group, name, value }) => [`${group}.${name}`, value]));
    const changed = data.scene.sliders.filter(({ group, name, value }) => before.has(`${group}.${name}`) && before.get(`${group}.${name}`) !== value);
    const named = changed.slice(0, 2).map(({ group, name, value, unit }) => `${group === 'parameters' ? '' : `${group} `}${name} = ${withUnits(`${value} ${unit}`).trim()}`).join(', ');
    const wanted = named ? `${named}${changed.length > 2 ? ' …' : ''}` : t('as at first');
    const taken = this.all.filter(({ label }) => label === wanted || label.startsWith(`${wanted} (`)).length;
    return taken ? `${wanted} (${taken + 1})` : wanted;
  }

  clear() {
    if (!this.all.length) return;
    this.all = [];
    this.show();
  }

  show() {
    this.clearButton.hidden = !this.all.length;
    this.clearButton.textContent = t('Clear {count} frozen', { count: this.all.length });
    this.onchange();
  }
}
