// Something that takes many runs of a scene: its progress while they go on, and then what they gave.
import { task } from './api.js';
import { element } from './dom.js';
import { t } from './messages.js';

export class Analysis {
  // `draw(messages)`: nodes that show what came, by kind of message; `charts` are the charts in them.
  constructor(kind, draw) {
    this.kind = kind;
    this.draw = draw;
    this.charts = [];
    this.drawn = [];
  }

  // A part of the page for the scene of a request. What was shown before stays, pale, until the new result is there.
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

  // A newer text makes the runs of an older one useless.
  stop() {
    this.control?.abort();
    this.control = null;
  }

  destroy() {
    this.charts.splice(0).forEach((chart) => chart.destroy());
  }
}
