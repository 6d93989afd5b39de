// A lesson: the student predicts, then sees the run beside the prediction, tries other values, and reads why. Until the prediction
// is made, the page shows no result.
import './lesson.css';
import { task } from './api.js';
import { element } from './dom.js';
import { LoopChart } from './loop-chart.js';
import { language } from './language.js';
import { t } from './messages.js';
import { predictionOf } from './prediction.js';
import { paragraphs, richText } from './rich-text.js';

export const levels = { beginner: t('beginner'), intermediate: t('intermediate'), advanced: t('advanced') };
// The title of a netlist of the gallery, in the language of the page if its lesson has one.
export const titleOf = ({ file, title, lesson }) => lesson?.titles?.[language] || title || file;
export const aboutLesson = ({ level, minutes }) => t('{level}, {minutes} minutes', { level: levels[level] ?? level, minutes });

export class Lesson {
  // `box`: the part of the page for it; `others()`: the netlists with a lesson, in their order; onopen(file), onagain(), onleave(): the student goes
  // on; onedit(): the teacher does.
  constructor(box, { sliders, language, others, onopen, onagain, onleave, onedit }) {
    Object.assign(this, { box, sliders, language, others, onopen, onagain, onleave, onedit });
    this.told = null;
  }

  get isOn() {
    return Boolean(this.told);
  }

  // Whether the results must still be hidden.
  get isConcealing() {
    return document.body.classList.contains('predicting');
  }

  // The steps that the student has done, to go on from there.
  get state() {
    return this.told && { prediction: this.prediction?.state ?? null, original: this.shown && this.original };
  }

  // Starts the lesson of a netlist that has just been opened: its `lesson`, or else the one of the folder. `left`: its state, to go on. Mistakes in
  // the lesson's file are shown in its place.
  async begin({ text, file, opened = text, lesson }, left) {
    this.end();
    Object.assign(this, { left, opened });
    document.body.classList.add('in-lesson');
    const asked = (this.asked = {});
    this.conceal(true);
    let told = null;
    let mistakes = [];
    try {
      await task({ task: 'lesson', text: opened, file, language: this.language, lesson: lesson?.text }, (message) => {
        if (message.kind === 'lesson') told = message;
        if (message.kind === 'mistakes') mistakes = message.items.map((item) => item.text);
        if (message.kind === 'failed') mistakes = [message.message];
      });
    } catch (error) {
      mistakes = [error.message];
    }
    if (this.asked !== asked) return;
    if (told) this.start(told, file, lesson?.isOwn);
    else this.refuse(mistakes);
  }

  end() {
    this.asked = this.told = this.data = null;
    this.chart?.destroy();
    this.chart = null;
    document.body.classList.remove('in-lesson');
    this.conceal(false);
    if (this.body) this.box.hidden = true;
    this.body?.remove();
    this.body = null;
  }

  conceal(hidden) {
    document.body.classList.toggle('predicting', hidden);
  }

  put(...content) {
    this.body?.remove();
    this.body = element('div', { class: 'lesson-steps' }, content.flat(Infinity).filter(Boolean));
    this.box.append(this.body);
    this.box.hidden = false;
  }

  refuse(mistakes) {
    document.body.classList.remove('in-lesson');
    this.conceal(false);
    this.put(mistakes.length ? mistakes.map((text) => element('pre', { class: 'bad', tabindex: '0' }, text)) : element('p', { class: 'note' }, t('This netlist has no lesson.')));
  }

  start(told, file, isOwn) {
    this.told = told;
    this.file = file;
    this.prediction = null;
    this.shown = null;
    this.names = [...new Set(told.presets.flatMap(({ values }) => Object.keys(values)))];
    this.put(
      element('div', { class: 'lesson-head' }, element('span', { class: 'note' }, aboutLesson(told)),
        isOwn && element('button', { type: 'button', onclick: () => this.onedit() }, t('Edit the lesson')),
        element('button', { type: 'button', onclick: () => this.onleave() }, t('Leave the lesson'))),
      told.demo.question ? element('p', { class: 'question' }, richText(told.demo.question)) : null,
      (this.ask = element('section', {}, element('h3', {}, t('1. Predict')), paragraphs(told.predict.prompt))),
      (this.steps = element('div')));
    if (this.data) this.take(this.data, this.text);
  }

  // The run of the netlist as it is now. The verdict is on the run that was predicted.
  take(data, text) {
    Object.assign(this, { data, text });
    if (!this.told || !data.scene) return;
    if (!this.prediction) this.offer();
    if (this.shown) this.draw();
  }

  record(path) {
    return path === 'time' ? { path: t('time'), unit: 's' } : this.data.records[this.data.index.get(path)];
  }

  offer() {
    const record = this.record(this.told.predict.y);
    if (!record) return;
    const done = element('button', { type: 'button', class: 'primary', disabled: true, onclick: () => this.compare() }, t('Compare with the run'));
    this.prediction = predictionOf(this.told.predict, () => (done.disabled = !this.prediction.isComplete), record, this.record(this.told.predict.x));
    this.done = done;
    this.ask.append(this.prediction.host, done);
    const { left } = this;
    this.left = null;
    if (left?.prediction != null) this.prediction.restore(left.prediction);
    if (left?.original) this.compare(left.original);
  }

  // Shows the run after the prediction has been made. `original`: the numbers that the presets change, as they were then.
  compare(original) {
    const { told, prediction } = this;
    prediction.settle();
    this.done.remove();
    this.conceal(false);
    this.original = original ?? this.sliders.literals(this.names);
    const chart = element('div');
    this.verdict = element('div', { role: 'status' });
    this.steps.append(...[
      element('section', {}, element('h3', { tabindex: '-1' }, t('2. Compare')), this.verdict, chart),
      element('section', {}, element('h3', {}, t('3. Try')), element('p', {}, told.demo.change ? richText(told.demo.change) : t('Change a value with its slider.')), told.presets.length ? this.presets() : null),
      (told.demo.see || told.demo.why || told.explain) && element('section', {}, element('h3', {}, t('4. Explain')), element('p', {}, t('Say it in your own words first. Then compare.')),
        this.fold(t('See'), paragraphs(told.demo.see)), this.fold(t('Why'), [...paragraphs(told.demo.why), ...paragraphs(told.explain)])),
      this.onward(),
    ].filter(Boolean));
    this.chartHost = chart;
    this.shown = true;
    this.judged = false;
    this.draw();
    const heading = this.steps.querySelector('h3');
    heading.focus({ preventScroll: true });
    // A prediction may fill the screen: the comparison, which was just asked for, comes into sight. A lesson that is resumed stays where it was.
    if (!original) heading.scrollIntoView({ block: 'start' });
  }

  fold(name, content) {
    return content.length ? element('details', {}, element('summary', {}, name), content) : null;
  }

  presets() {
    const look = element('p', { role: 'status' });
    const button = (name, values, text) => element('button', { type: 'button', onclick: () => {
      this.sliders.put({ ...this.original, ...values });
      look.replaceChildren(...richText(text));
    } }, name);
    return element('div', {}, element('div', { class: 'presets' }, this.told.presets.map(({ name, values, look: text }) => button(name, values, text)),
      button(t('as at first'), {}, '')), look);
  }

  onward() {
    const all = this.others();
    const next = all[all.findIndex(({ file }) => file === this.file) + 1];
    return element('p', { class: 'onward' },
      element('button', { type: 'button', onclick: () => this.onagain() }, t('Begin this lesson again')),
      next ? element('button', { type: 'button', onclick: () => this.onopen(next.file) }, t('Next lesson: {title}', { title: titleOf(next) })) : null);
  }

  runCurve() {
    const { x, y } = this.told.predict;
    return { x: x === 'time' ? this.data.time : this.data.column(x), y: this.data.column(y) };
  }

  draw() {
    const { x, y } = this.told.predict;
    if (!this.data.hasCurves || !this.record(y)) return;
    const isOver = this.data.done || this.data.failed;
    const isFirst = this.text === this.opened;
    this.verdict.hidden = !isFirst;
    if (isOver && isFirst && !this.judged) {
      this.verdict.append(...this.prediction.verdict(this.runCurve()));
      this.judged = true;
    }
    const curves = [{ name: t('the run'), ...this.runCurve(), style: 0 }];
    const { curve } = this.prediction;
    if (curve.y) curves.push({ name: t('your prediction'), x: curve.x, y: curve.y, style: 1, dash: 1 });
    if (this.chart) {
      this.chart.update(curves);
      return;
    }
    const side = (path) => ({ quantity: this.record(path).path, unit: this.record(path).unit, as: this.record(path).shown, exact: path === 'time' });
    this.chart = new LoopChart(this.chartHost, { x: side(x), y: side(y), curves, height: 280 });
  }
}
