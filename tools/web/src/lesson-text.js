// The text of a lesson, read into the fields of its form and written from them. All that has no field stays as it is: presets, [demo],
// comments, and the texts in other languages.
import { NetlistText, changed, placeIn, valueOf } from './netlist-text.js';

// The file of the lesson of a netlist.
export const lessonFileOf = (file) => `${file.replace(/\.toml$/, '')}.lesson`;

const choicesAt = ['predict', 'choices'];

// Several lines stay lines.
const quoted = (text) => {
  const escaped = JSON.stringify(text);
  return text.includes('\n') ? `"""\n${escaped.slice(1, -1).replace(/\\(.)/g, (all, c) => (c === 'n' ? '\n' : all))}"""` : escaped;
};

export class LessonText {
  // Throws an error with `line` and `column` if the text is no TOML. A new lesson predicts `record`.
  constructor(text, language, record) {
    this.language = language;
    this.take(text || `level = "beginner"\nminutes = 10\n\n[predict]\ny = ${JSON.stringify(record)}\n`);
  }

  take(text) {
    this.text = text;
    this.toml = new NetlistText(text);
  }

  // The value at a path as it is read: of a text in several languages the one of the page, or else the one that is shown in its place.
  read(path) {
    const value = this.toml.root.at(...path);
    if (!value || value.kind === 'array') return '';
    const one = value.kind === 'value' ? value : ([this.language, 'en'].map((code) => value.at(code)).find(Boolean) ?? [...value.entries.values()][0]?.value);
    return String(one?.plain ?? '').trim();
  }

  edit(changes) {
    this.take(changed(this.text, changes));
  }

  // Writes `toml` as the value at a path, or removes the value if `toml` is ''.
  put(path, toml) {
    this.edit(toml ? this.toml.set(path, toml) : this.toml.remove(path));
  }

  // Writes the text `typed` into the field of the value at a path, if it has changed: as `toml`, or else as a number, a quantity or a formula.
  change(path, typed, toml = typed && valueOf(typed)) {
    if (typed !== this.read(path)) this.put(path, toml);
  }

  // The text `typed`, in the language of the page unless the lesson has one text for all languages.
  putText(path, typed) {
    if (typed !== this.read(path)) this.put(this.toml.root.at(...path)?.kind === 'value' ? path : [...path, this.language], quoted(typed));
  }

  get choices() {
    return this.toml.root.at(...choicesAt)?.items ?? [];
  }

  removeChoice(k) {
    const { node } = this.choices[k];
    if (node.type === 'TOMLTable') this.edit(this.toml.withoutStatement(node));
    else this.edit([this.toml.withoutItem(node.parent.elements, k)]);
    if (!this.choices.length) this.put(choicesAt, ''); // an array on one line is left empty
  }

  // An empty choice, behind the others.
  addChoice() {
    const last = this.choices.at(-1)?.node;
    if (last && last.type !== 'TOMLTable') {
      this.edit(this.toml.append(choicesAt, '{}'));
      return;
    }
    const end = this.toml.lineEnd((last ?? this.toml.root.at('predict').node ?? this.toml.top).range[1]);
    this.edit([{ from: end, to: end, insert: '\n\n[[predict.choices]]' }]);
  }

  // The fields, by name; `choices` is null if a curve is sketched. `from` is the place of a choice in this text, `drawn` its curve as numbers; to
  // write(), only if it was drawn anew.
  get fields() {
    const at = (...path) => this.read(path);
    const [low, high] = this.range;
    const choices = this.choices.map((_, k) => {
      const [text, y, reply, right] = ['text', 'y', 'reply', 'right'].map((key) => at(...choicesAt, k, key));
      const drawn = this.toml.root.at(...choicesAt, k, 'y')?.items.map(({ plain }) => plain);
      return { from: k, text, y, drawn, reply, right: right === 'true' };
    });
    return { level: at('level'), minutes: at('minutes'), prompt: at('predict', 'prompt'), y: at('predict', 'y'), low, high, choices: choices.length ? choices : null, explain: at('explain') };
  }

  get range() {
    return [0, 1].map((k) => this.read(['predict', 'range', k]));
  }

  write({ level, minutes, prompt, y, low, high, choices, explain }) {
    this.change(['level'], level);
    this.change(['minutes'], minutes);
    this.putText(['predict', 'prompt'], prompt);
    this.change(['predict', 'y'], y);
    const kept = (choices ?? []).map(({ from }) => from);
    for (let k = this.choices.length - 1; k >= 0; --k) if (!kept.includes(k)) this.removeChoice(k);
    if (choices) this.put(['predict', 'range'], '');
    else {
      this.put(['predict', 'x'], '');
      const { range } = this;
      if (low !== range[0] || high !== range[1]) this.put(['predict', 'range'], `[${valueOf(low)}, ${valueOf(high)}]`);
    }
    choices?.forEach((choice, k) => {
      if (choice.from === undefined) this.addChoice();
      const path = [...choicesAt, k];
      this.putText([...path, 'text'], choice.text);
      if (choice.drawn) this.put([...path, 'y'], choice.drawn.length ? `[${choice.drawn.map((value) => Number(value.toPrecision(3))).join(', ')}]` : '');
      else this.change([...path, 'y'], choice.y);
      if (!this.toml.root.at(...path, 'y')) this.put([...path, 'x'], ''); // a curve has both sides or none
      const right = choice.right ? 'true' : '';
      this.change([...path, 'right'], right, right);
      this.putText([...path, 'reply'], choice.reply);
    });
    this.putText(['explain'], explain);
    return this.text;
  }

  // Whether the value at a path has the place of a line and a column (both from 1, in characters).
  contains(path, line, column) {
    const entry = path.length && this.toml.root.at(...path.slice(0, -1))?.entries.get(path.at(-1));
    const nodes = entry ? entry.statements : [this.toml.root.at(...path)?.node].filter(Boolean);
    const rows = this.text.split('\n');
    const place = rows.slice(0, line - 1).reduce((sum, row) => sum + row.length + 1, placeIn(rows[line - 1] ?? '', column));
    return nodes.some(({ range: [from, to] }) => from <= place && place <= to);
  }
}
