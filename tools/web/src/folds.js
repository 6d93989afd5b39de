// Foldable sections with the details of a run.
import './analysis.css';
import { Analysis } from './analysis.js';
import { explain } from './api.js';
import { differencesOf } from './differences.js';
import { element } from './dom.js';
import { effectsOf } from './effects.js';
import { t } from './messages.js';
import { pricesOf } from './prices.js';
import { claimsOf, elementsOf, energyOf, equationsOf, eventsOf, explanationOf, inWords, notesOf, statisticsOf } from './sections.js';
import { SweepPanel } from './sweep.js';

export class Folds {
  // request(): the netlist that is edited: its text, file and session; load(path, value): gives a number of it another value.
  constructor(host, request, load) {
    this.host = host;
    this.request = request;
    this.charts = [];
    this.fills = new Map(); // for each section: makes its content, unless it is there
    this.effects = new Analysis('effects', effectsOf);
    this.prices = new Analysis('precision', ({ prices }, charts) => (prices ? pricesOf(prices, this.isExact, inWords, charts) : []));
    this.sweep = new SweepPanel(request, load);
  }

  // Call when the text has changed: ends the analyses, whose results are outdated.
  stop() {
    [this.effects, this.prices, this.sweep].forEach((analysis) => analysis.stop());
  }

  // Call for another scene.
  renew() {
    this.sweep.clear();
    this.explained = null;
  }

  // Shows the sections; open ones stay open. `runs` has all compared runs, `data` is the run that is edited.
  show(data, runs) {
    this.opened = new Set([...this.host.querySelectorAll('details[open]')].map((details) => details.dataset.name));
    this.charts.forEach((chart) => chart.destroy());
    this.charts = [];
    const { scene, done } = data;
    this.isExact = done?.statistics.arc_steps > 0 && done.statistics.arc_steps === done.statistics.steps;
    const compared = runs.filter((run) => run.data.hasCurves);
    this.host.replaceChildren(...[
      compared.length > 1 ? this.fold('Differences', t('Differences'), () => differencesOf(compared)) : null,
      this.fold('What is simulated, and why', t('What is simulated, and why'), () => this.explanation()),
      this.fold('Equations', t('Equations'), () => equationsOf(scene)),
      this.fold('Elements', t('Elements'), () => elementsOf(scene)),
      data.hasEnergy ? this.fold('Energy account', t('Energy account'), () => energyOf(data, this.charts)) : null,
      this.fold('Events', t('Events'), () => eventsOf(data)),
      done?.claims.length ? this.fold('Claims', t('Claims'), () => claimsOf(data)) : null,
      done ? this.fold('Statistics', t('Statistics'), () => statisticsOf(data)) : null,
      done?.notes.length || data.mistakes.length ? this.fold('Notes', t('Notes'), () => notesOf(data)) : null,
      done ? this.fold('Effects', t('Effects'), () => this.effects.show(this.request())) : null,
      done ? this.fold('Price of accuracy', t('Price of accuracy'), () => this.prices.show(this.request())) : null,
      this.fold('Sweep', t('Sweep'), () => this.sweep.show(scene, this.request())),
    ].filter(Boolean));
  }

  // Goes to the sweep, of the number with this path if one is given.
  openSweep(path) {
    const details = this.host.querySelector('[data-name="Sweep"]');
    if (path) this.sweep.begin(path);
    details.open = true;
    this.fills.get(details.dataset.name)(); // The event that does it comes after the page has scrolled.
    details.scrollIntoView();
    details.querySelector('summary').focus({ preventScroll: true });
  }

  // The explanation takes a moment; the earlier one stays until then.
  explanation() {
    const host = element('div', {}, this.explained ?? element('p', { class: 'note' }, t('Looking at it …')));
    const request = this.request();
    const asked = (this.asked = explain({ ...request, session: `${request.session}-why` }));
    asked.then(explanationOf, (error) => element('p', { class: 'note bad' }, error.message)).then((explained) => {
      if (asked !== this.asked) return;
      this.explained = explained;
      host.replaceChildren(explained);
    });
    return host;
  }

  // A section whose content is created when it is opened; `name` is the same in every language.
  fold(name, heading, make) {
    const details = element('details', { 'data-name': name, open: this.opened.has(name) }, element('summary', {}, heading));
    const fill = () => {
      if (!details.open || details.dataset.full) return;
      details.dataset.full = 'yes';
      const content = [make()].flat().filter(Boolean);
      details.append(...(content.length ? content : [element('p', { class: 'note' }, t('None.'))]));
    };
    details.addEventListener('toggle', fill);
    this.fills.set(name, fill);
    queueMicrotask(fill);
    return details;
  }
}
