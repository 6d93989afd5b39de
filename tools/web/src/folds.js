// What there is to say of a run, folded away until somebody opens it.
import { differencesOf } from './differences.js';
import { element } from './dom.js';
import { accuracyOf, claimsOf, elementsOf, energyOf, equationsOf, eventsOf, explanationOf, inWords, notesOf, statisticsOf } from './sections.js';
import { number } from './units.js';

export class Folds {
  // explain() asks for what is simulated of the netlist that is edited, and why.
  constructor(host, explain) {
    this.host = host;
    this.explain = explain;
    this.charts = [];
  }

  // Those that are open stay open. `runs` are all that are compared, `data` is the one that is edited.
  show(data, runs) {
    this.opened = new Set([...this.host.querySelectorAll('details[open]')].map((details) => details.dataset.name));
    this.charts.forEach((chart) => chart.destroy());
    this.charts = [];
    const { scene, done } = data;
    const compared = runs.filter((run) => run.data.hasCurves);
    this.host.replaceChildren(...[
      compared.length > 1 ? this.fold('Differences', () => differencesOf(compared)) : null,
      this.fold('What is simulated, and why', () => this.explanation()),
      this.fold('Equations', () => equationsOf(scene)),
      this.fold('Elements', () => elementsOf(scene)),
      data.hasEnergy ? this.fold('Energy account', () => energyOf(data, this.charts)) : null,
      this.fold('Events', () => eventsOf(data)),
      done?.claims.length ? this.fold('Claims', () => claimsOf(data)) : null,
      done ? this.fold('Statistics', () => statisticsOf(data)) : null,
      done?.notes.length || data.mistakes.length ? this.fold('Notes', () => notesOf(data)) : null,
      this.fold('Accuracy', () => accuracyOf(data, this.charts) ?? element('p', { class: 'note' },
        inWords(`The scene asks for ${number(scene.accuracy)}. \`rheonet report --certify --precision\` measures what is reached, and what it costs.`))),
    ].filter(Boolean));
  }

  // It takes a moment, in which what was said before stays.
  explanation() {
    const host = element('div', {}, this.explained ?? element('p', { class: 'note' }, 'Looking at it …'));
    const asked = (this.asked = this.explain());
    asked.then(explanationOf, (error) => element('p', { class: 'note bad' }, error.message)).then((explained) => {
      if (asked !== this.asked) return;
      this.explained = explained;
      host.replaceChildren(explained);
    });
    return host;
  }

  // Its content is made when it is opened.
  fold(name, make) {
    const details = element('details', { 'data-name': name, open: this.opened.has(name) }, element('summary', {}, name));
    const fill = () => {
      if (!details.open || details.dataset.full) return;
      details.dataset.full = 'yes';
      const content = [make()].flat().filter(Boolean);
      details.append(...(content.length ? content : [element('p', { class: 'note' }, 'None.')]));
    };
    details.addEventListener('toggle', fill);
    queueMicrotask(fill);
    return details;
  }
}
