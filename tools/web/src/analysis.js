// An analysis that needs many runs of a scene: shows its progress, then its results.
import { task } from './api.js';
import { element } from './dom.js';
import { t } from './messages.js';

export class Analysis {
  // `draw(messages)` returns nodes that show the messages, by kind. `charts` has the charts in these nodes.
  constructor(kind, draw) {
    this.kind = kind;
    this.draw = draw;
    this.charts = [];
    this.drawn = [];
  }

  // The part of the page for the scene of a request. An earlier result stays, greyed out, until the new one arrives.
  show(request) {
    this.stop();
    this.host = element('div', { class: 'analysis' });
    this.progress = element('progress', { max: '1', value: '0', 'aria-label': t('Part that is done') });
    this.host.append(element('p', { class: 'note' }, t('Simulating …'), ' ', this.progress), element('div', { class: 'stale' }, this.drawn));
    this.run(request);
    return this.host;
  }

  async run(request) {
    const control = new AbortController();
    this.control = control;
    const came = {};
    try {
      await task({ ...request, task: this.kind, session: `${request.session}-${this.kind}` }, (message) => {
        came[message.kind] = message;
        if (message.kind === 'progress') this.progress.value = message.fraction;
      }, control.signal);
    } catch (error) {
      if (error.name === 'AbortError') return;
      came.failed = { message: error.message };
    }
    if (this.control !== control) return;
    this.control = null;
    this.destroy();
    this.drawn = came.failed ? [element('p', { class: 'note bad' }, came.failed.message)] : this.draw(came, this.charts);
    this.host.replaceChildren(...this.drawn);
  }

  // Ends the runs of an outdated text.
  stop() {
    this.control?.abort();
    this.control = null;
  }

  destroy() {
    this.charts.splice(0).forEach((chart) => chart.destroy());
  }
}
