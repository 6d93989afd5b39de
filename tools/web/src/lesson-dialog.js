// The form of a lesson: what the students are asked, how they predict, and what they read afterwards.
import { task } from './api.js';
import { element, freshId } from './dom.js';
import { language } from './language.js';
import { LessonText } from './lesson-text.js';
import { levels } from './lesson.js';
import { t } from './messages.js';
import { predictionOf } from './prediction.js';
import { inPrint } from './units.js';

const fewest = 2; // answers to choose from

// A part of the form with its label and, below, why it is refused. `path`: its place in the lesson.
function field(label, input, path, about = '') {
  const id = freshId('lesson');
  input.id = id;
  input.setAttribute('aria-describedby', `${id}-why`);
  const why = element('output', { class: 'why', id: `${id}-why` });
  const refuse = (text) => {
    why.textContent = text;
    if (text) input.setAttribute('aria-invalid', 'true');
    else input.removeAttribute('aria-invalid');
  };
  input.addEventListener('input', () => refuse(''));
  return { input, path, refuse, row: element('div', { class: 'field' }, element('label', { for: id }, label), input, about && element('span', { class: 'note' }, about), why) };
}

const line = (value) => element('input', { type: 'text', value, autocomplete: 'off' });
const lines = (value, rows = '3') => element('textarea', { rows }, value);
const list = (options, value) => element('select', {}, options.map(([key, text]) => element('option', { value: key, selected: key === value }, text)));

export class LessonDialog {
  // ondone(text): the lesson has no mistakes.
  constructor({ ondone }) {
    this.ondone = ondone;
  }

  // For a netlist and its run, `data`. `lesson`: the text of its lesson, '' for a new one, which predicts the record `first`. A form that was closed
  // is shown again with the texts that were typed. Throws an error if the lesson is no TOML.
  open({ file, text, lesson, data, first = data.records[0]?.path }) {
    const { start, stop, sliders } = data.scene;
    const key = JSON.stringify([file, lesson, data.records.map(({ path }) => path), start, stop, sliders.map(({ name }) => name)]);
    this.netlist = { file, text };
    this.data = data;
    if (key !== this.key) this.build(lesson, first);
    this.key = key;
    this.dialog.showModal();
  }

  close() {
    this.dialog?.close();
  }

  recordOf(path) {
    return this.data.records[this.data.index.get(path)] ?? this.data.records[0];
  }

  // The ends [SI] of an axis on which the run of a record has room, and 0.
  endsOf(path) {
    const values = this.data.column(path) ?? [];
    const [low, high] = values.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [0, 0]);
    return [low, high].map((end, k) => Number((end + (k - 0.5) * 0.4 * (high - low || 2)).toPrecision(2)));
  }

  axisOf(path) {
    const { unit } = this.recordOf(path);
    return this.endsOf(path).map((end) => (unit === '1' ? String(end) : `${end} ${unit}`));
  }

  build(lesson, first) {
    const source = (this.source = new LessonText(lesson, language, first));
    const records = this.data.records.map(({ path, unit }) => [path, unit === '1' ? path : `${path} [${inPrint(unit)}]`]);
    const names = this.data.scene.sliders.filter(({ group }) => group === 'parameters').map(({ name }) => name);
    const { level, minutes, prompt, y, low, high, choices, explain } = source.fields;
    const close = () => this.close();
    const isAmong = records.some(([path]) => path === y);
    this.prompt = field(t('Question'), lines(prompt), ['predict', 'prompt'], t('Formulas stand between dollar signs, as in TeX: $F = k x$'));
    this.record = field(t('The students predict'), list(isAmong ? records : [[y, y], ...records], y), ['predict', 'y']);
    this.way = field(t('How'), list([['sketch', t('They sketch the curve')], ['choices', t('They choose an answer')]], choices ? 'choices' : 'sketch'), ['predict', 'choices']);
    const [least, most] = low ? [low, high] : this.axisOf(y);
    this.low = field(t('Axis from'), line(least), ['predict', 'range', 0]);
    this.high = field(t('Axis to'), line(most), ['predict', 'range', 1]);
    this.explain = field(t('Explanation afterwards'), lines(explain), ['explain']);
    this.level = field(t('Level'), list(Object.entries(levels), level), ['level']);
    this.minutes = field(t('Minutes'), line(minutes), ['minutes']);
    this.about = t('A value with its unit is a level line. A formula may contain {names}. Empty: no curve.', { names: ['t', ...names].join(', ') });
    this.right = freshId('right');
    this.choices = [];
    for (const choice of choices ?? Array(fewest).fill({})) this.add(choice);
    const answers = element('div', { class: 'answers' }, (this.host = element('div')), element('button', { type: 'button', onclick: () => this.add({}).text.input.focus() }, t('Add an answer')));
    const axis = element('div', { class: 'side-by-side' }, this.low.row, this.high.row);
    const showWay = () => {
      answers.hidden = !this.isChoice;
      axis.hidden = this.isChoice;
    };
    this.way.input.addEventListener('change', showWay);
    this.record.input.addEventListener('change', () => {
      [this.low.input.value, this.high.input.value] = this.axisOf(this.record.input.value);
      for (const choice of this.choices) if (choice.board) this.eraseDrawing(choice); // it is of the quantity before
    });
    this.wrong = element('output', { class: 'why' });
    this.dialog?.remove();
    this.dialog = element('dialog', { class: 'lesson-form', 'aria-labelledby': 'lesson-title' },
      element('div', { class: 'dialog-head' }, element('h2', { id: 'lesson-title' }, t('Lesson')), element('button', { type: 'button', onclick: close, 'aria-label': t('Close') }, '✕')),
      element('form', { onsubmit: (event) => (event.preventDefault(), this.check()) }, this.prompt.row, element('div', { class: 'side-by-side' }, this.record.row, this.way.row), axis, answers, this.explain.row,
        element('div', { class: 'side-by-side' }, this.level.row, this.minutes.row), this.wrong,
        element('div', { class: 'dialog-foot' }, element('button', { type: 'button', onclick: close }, t('Cancel')), element('button', { type: 'submit' }, t('See it as a student')))));
    document.body.append(this.dialog);
    this.showChoices();
    showWay();
  }

  get isChoice() {
    return this.way.input.value === 'choices';
  }

  add({ from, text = '', y = '', drawn, reply = '', right = false }) {
    const choice = { from, text: field(t('Answer'), lines(text, '1')), y: field(t('Its curve'), line(y), null, this.about), reply: field(t('Reply to it'), lines(reply, '2')),
      right: element('input', { type: 'radio', name: this.right, checked: right, oninput: () => this.way.refuse('') }) };
    choice.pen = element('button', { type: 'button', onclick: () => this.draw(choice) }, t('Draw'));
    choice.y.input.after(choice.pen);
    choice.y.input.addEventListener('input', () => this.eraseDrawing(choice));
    if (drawn?.length) this.draw(choice, drawn);
    this.choices.push(choice);
    this.showChoices();
    return choice;
  }

  // The curve of an answer is drawn instead of written; `before`: what it is so far.
  draw(choice, before) {
    const path = this.record.input.value;
    const { start, stop } = this.data.scene;
    const [low, high] = this.endsOf(path);
    const range = [Math.min(low, ...(before ?? [])), Math.max(high, ...(before ?? []))];
    const board = predictionOf({ start, stop, range }, () => {
      const isEmpty = board.state.every((value) => value === null);
      choice.drawn = isEmpty ? [] : board.curve.y;
      choice.isUnfinished = !isEmpty && !board.isComplete;
      choice.y.input.value = '';
      choice.y.refuse('');
    }, this.recordOf(path));
    if (before) board.restore(board.curve.y.map((_, k, { length }) => before[Math.round((k / (length - 1)) * (before.length - 1))]));
    choice.drawn = undefined; // until it changes
    choice.isUnfinished = false;
    choice.pen.hidden = true;
    choice.board = board.host;
    choice.pen.after(board.host);
  }

  // Removes the drawn curve, so that a written one can take its place.
  eraseDrawing(choice) {
    choice.board?.remove();
    choice.board = null;
    choice.drawn = choice.y.input.value ? undefined : [];
    choice.isUnfinished = false;
    choice.pen.hidden = false;
  }

  remove(choice) {
    this.choices = this.choices.filter((each) => each !== choice);
    this.showChoices();
    this.choices[0].text.input.focus();
  }

  showChoices() {
    this.choices.forEach(({ text, y, reply }, k) => {
      for (const [key, part] of Object.entries({ text, y, reply })) part.path = ['predict', 'choices', k, key];
    });
    this.host?.replaceChildren(...this.choices.map((choice, k) => element('fieldset', {}, element('legend', {}, t('Answer {n}', { n: k + 1 })),
      element('div', { class: 'answer-head' }, element('label', {}, choice.right, ` ${t('is right')}`),
        this.choices.length > fewest && element('button', { type: 'button', onclick: () => this.remove(choice) }, t('Remove'))),
      choice.text.row, choice.y.row, choice.reply.row)));
  }

  // The fields that are shown, in their order.
  get shown() {
    const answers = this.choices.flatMap(({ text, y, reply }) => [text, y, reply]);
    return [this.prompt, this.record, this.way, ...(this.isChoice ? answers : [this.low, this.high]), this.explain, this.level, this.minutes];
  }

  // Passes the lesson on if it has no mistakes, or else shows them.
  async check() {
    const typed = (part) => part.input.value.trim();
    const refused = new Map();
    const needed = [this.prompt, ...(this.isChoice ? this.choices.map(({ text }) => text) : [this.low, this.high]), this.minutes];
    for (const part of needed) if (!typed(part)) refused.set(part, t('A value is missing.'));
    for (const { isUnfinished, y } of this.isChoice ? this.choices : []) if (isUnfinished) refused.set(y, t('Draw to the end of the run.'));
    if (refused.size) return this.refuse(refused);
    const choices = this.isChoice ? this.choices.map(({ from, text, y, drawn, reply, right }) => ({ from, text: typed(text), y: typed(y), drawn, reply: typed(reply), right: right.checked })) : null;
    let isRight = false;
    try {
      const written = new LessonText(this.source.text, language);
      const [level, minutes, prompt, y, low, high, explain] = ['level', 'minutes', 'prompt', 'record', 'low', 'high', 'explain'].map((name) => typed(this[name]));
      const lesson = written.write({ level, minutes, prompt, y, low, high, choices, explain });
      await task({ task: 'lesson', ...this.netlist, language, lesson }, (message) => {
        isRight ||= message.kind === 'lesson';
        if (message.kind === 'failed') refused.set(null, message.message);
        for (const { line: row, column, message: why, hint } of message.items ?? []) {
          // The innermost of those that hold its place.
          const at = this.shown.filter(({ path }) => written.contains(path, row, column)).sort((a, b) => b.path.length - a.path.length)[0] ?? null;
          refused.set(at, [refused.get(at), hint ? `${why} – ${hint}` : why].filter(Boolean).join('\n'));
        }
      });
      if (!this.dialog.open) return; // closed meanwhile
      if (isRight) {
        this.dialog.close();
        this.key = null; // The form of this lesson is filled from its text the next time.
        this.ondone(lesson);
        return;
      }
      if (!refused.size) refused.set(null, t('The netlist has mistakes.'));
    } catch (error) {
      refused.set(null, error.message);
    }
    this.refuse(refused);
  }

  refuse(refused) {
    for (const part of this.shown) part.refuse(refused.get(part) ?? '');
    this.wrong.textContent = refused.get(null) ?? '';
    this.shown.find((part) => refused.has(part))?.input.focus();
  }
}
