// Simulates the newest text. There is one run at a time; intermediate texts are skipped, and a long run is cancelled for a newer text.
import { task } from './api.js';
import { SceneData } from './scene-data.js';

const patience = 150; // Time of a run before a newer text may cancel it [ms].
const partly = 250; // Time after which a partial result is shown [ms].

export class Runner {
  // ondata(data, { text, complete, took }): the result so far.
  // onscene(data, text): the scene has been read, and its run has started.
  constructor(session, ondata, onscene) {
    this.session = session;
    this.ondata = ondata;
    this.onscene = onscene;
    this.next = null;
    this.current = null;
  }

  run(text, file) {
    this.next = { text, file, asked: performance.now() };
    if (!this.current) this.begin();
    else this.giveWay();
  }

  giveWay() {
    const since = performance.now() - this.current.began;
    clearTimeout(this.timer);
    if (since >= patience) this.begin();
    else this.timer = setTimeout(() => this.next && this.begin(), patience - since);
  }

  async begin() {
    clearTimeout(this.timer);
    this.current?.control.abort();
    const run = { ...this.next, began: performance.now(), control: new AbortController() };
    this.next = null;
    this.current = run;
    const data = new SceneData();
    let shown = run.began;
    try {
      await task({ task: 'show', session: this.session, text: run.text, file: run.file }, (message) => {
        data.take(message);
        if (this.current === run && message.kind === 'scene') this.onscene(data, run.text);
        if (this.current !== run || !data.scene || performance.now() - shown < partly) return;
        shown = performance.now();
        this.ondata(data, { text: run.text, complete: false });
      }, run.control.signal);
    } catch (error) {
      if (error.name === 'AbortError' || this.current !== run) return;
      data.failed ??= { message: error.message };
    }
    if (this.current !== run) return;
    this.current = null;
    this.ondata(data, { text: run.text, complete: true, asked: run.asked });
    if (this.next) this.begin();
  }
}
