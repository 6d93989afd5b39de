// The text of a netlist as a tree of tables and values with their positions, and changes of single places in the text. The rest of the text
// is kept, including comments and blanks. A change is a list of { from, to, insert }, as in CodeMirror.
import { parseTOML } from 'toml-eslint-parser';

const isBare = (name) => /^[A-Za-z0-9_-]+$/.test(name);
export const keyOf = (name) => (isBare(name) ? name : JSON.stringify(name));

// A value as TOML: a number unquoted, any other text in quotes.
export const valueOf = (text) => (/^[+-]?(\d+\.?\d*|\d*\.\d+)(e[+-]?\d+)?$/i.test(text) && !/^[+-]?(0\d|\.|\d+\.(e|$))/i.test(text) ? text : JSON.stringify(text));

// The place in a line of a column, counted from 1 in characters, as the server counts them.
export const placeIn = (line, column) => [...line].slice(0, Math.max(0, column - 1)).join('').length;

// A table, an array or a single value.
class Value {
  constructor(kind, node = null) {
    this.kind = kind; // 'table', 'array' or 'value'
    this.node = node; // of a table: the inline table or the header that makes it, if there is one
    this.entries = new Map(); // of a table: name -> Entry
    this.items = []; // of an array
  }

  // The value: a text, a number or a boolean.
  get plain() {
    return this.kind === 'value' ? this.node.value : undefined;
  }

  // An entry at a path; null if there is none.
  at(...path) {
    const [name, ...rest] = path;
    if (name === undefined) return this;
    const found = typeof name === 'number' ? this.items[name] : this.entries.get(name)?.value;
    return found ? found.at(...rest) : null;
  }
}

class Entry {
  constructor(name, value) {
    this.name = name;
    this.value = value;
    this.keys = []; // each place where its name stands as a key
    this.statements = []; // each `key = value` or header that its value is made of, itself or in part
  }
}

function valueFrom(node) {
  if (node.type === 'TOMLArray') {
    const array = new Value('array', node);
    array.items = node.elements.map(valueFrom);
    return array;
  }
  if (node.type !== 'TOMLInlineTable') return new Value('value', node);
  const table = new Value('table', node);
  node.body.forEach((statement) => define(table, statement));
  return table;
}

// Goes down a key, and makes the tables on its way.
function descend(table, keys, statement) {
  for (const key of keys) {
    const name = key.name ?? key.value;
    if (!table.entries.has(name)) table.entries.set(name, new Entry(name, new Value('table')));
    const entry = table.entries.get(name);
    entry.keys.push(key);
    entry.statements.push(statement);
    // A header [[x]] goes on in the last table of its array.
    table = entry.value.kind === 'array' ? entry.value.items.at(-1) : entry.value;
  }
  return table;
}

function define(table, statement) {
  const keys = statement.key.keys;
  const last = keys.at(-1);
  const name = last.name ?? last.value;
  const parent = descend(table, keys.slice(0, -1), statement);
  const entry = new Entry(name, valueFrom(statement.value));
  entry.keys.push(last);
  entry.statements.push(statement);
  parent.entries.set(name, entry);
}

function rootOf(body) {
  const root = new Value('table');
  for (const part of body) {
    if (part.type === 'TOMLKeyValue') {
      define(root, part);
      continue;
    }
    let table;
    if (part.kind === 'array') {
      const keys = part.key.keys;
      const parent = descend(root, keys.slice(0, -1), part);
      const name = keys.at(-1).name ?? keys.at(-1).value;
      if (!parent.entries.has(name)) parent.entries.set(name, new Entry(name, new Value('array')));
      const entry = parent.entries.get(name);
      entry.keys.push(keys.at(-1));
      entry.statements.push(part);
      entry.value.items.push((table = new Value('table', part)));
    } else {
      table = descend(root, part.key.keys, part);
      table.node = part;
    }
    part.body.forEach((statement) => define(table, statement));
  }
  return root;
}

export class NetlistText {
  // Throws an error with `line` and `column` if the text is no TOML.
  constructor(text) {
    this.text = text;
    try {
      this.top = parseTOML(text).body[0];
    } catch (error) {
      throw Object.assign(new Error(error.message), { line: error.lineNumber, column: error.column });
    }
    this.root = rootOf(this.top.body);
  }

  source({ range: [from, to] }) {
    return this.text.slice(from, to);
  }

  // The end of the line at a place, before the line break.
  lineEnd(at) {
    const end = this.text.indexOf('\n', at);
    return end < 0 ? this.text.length : end;
  }

  lineOf(at) {
    return this.text.slice(0, at).split('\n').length;
  }

  // The part of the text that an entry at a path takes: of its first statement.
  placeOf(...path) {
    const entry = this.root.at(...path.slice(0, -1))?.entries.get(path.at(-1));
    return entry ? entry.keys[0].range[0] : null;
  }

  // Puts a value, as TOML, at a path of names: in place of the one that is there, or as a new entry of its table.
  set(path, toml) {
    const value = this.root.at(...path);
    if (value?.node && value.node.type !== 'TOMLTable') return [{ from: value.node.range[0], to: value.node.range[1], insert: toml }];
    if (value) return this.replace(path, path.at(-1), toml);
    return this.insert(path.slice(0, -1), path.at(-1), toml);
  }

  // An entry of another name in the place of one that is there.
  replace(path, name, toml) {
    const { keys: [key], statements: [first, ...others] } = this.root.at(...path.slice(0, -1)).entries.get(path.at(-1));
    if (first.type === 'TOMLTable') return [...this.remove(path), ...this.insert(path.slice(0, -1), name, toml, path.at(-1))];
    return [{ from: key.range[0], to: first.range[1], insert: `${keyOf(name)} = ${toml}` }, ...others.flatMap((statement) => this.withoutStatement(statement))];
  }

  // A new entry of the table at a path; `except` names an entry that goes away at the same time.
  insert(path, name, toml, except = null) {
    const table = this.root.at(...path);
    const line = `${keyOf(name)} = ${toml}`;
    if (!table) return path.length === 1 ? this.newSection(path[0], line) : this.insert(path.slice(0, -1), path.at(-1), `{ ${line} }`);
    if (table.node?.type === 'TOMLInlineTable') return this.intoInline(table.node, line);
    if (table.node) return [this.afterStatement(table.node.body.filter(({ key }) => (key.keys[0].name ?? key.keys[0].value) !== except).at(-1) ?? table.node.key, line)];
    if (!path.length) return [this.beforeHeaders(`${line}\n`)];
    return this.besideDotted(path, line);
  }

  intoInline({ body, range: [from, to] }, line) {
    if (!body.length) return [{ from, to, insert: `{ ${line} }` }];
    const end = body.at(-1).range[1];
    return [{ from: end, to: end, insert: `, ${line}` }];
  }

  // On a line of its own behind that of a statement.
  afterStatement(statement, line) {
    const end = this.lineEnd(statement.range[1]);
    return { from: end, to: end, insert: `\n${line}` };
  }

  // Among the keys of the root, which stand before all headers.
  beforeHeaders(line) {
    const keys = this.top.body.filter(({ type }) => type === 'TOMLKeyValue');
    if (keys.length) return this.afterStatement(keys.at(-1), line.trimEnd());
    const first = this.top.body[0]?.range[0] ?? 0;
    return { from: first, to: first, insert: `${line}\n` };
  }

  // Into a table that dotted keys or headers of its sub-tables make, and no header of its own.
  besideDotted(path, line) {
    const statements = this.root.at(...path.slice(0, -1)).entries.get(path.at(-1)).statements;
    const header = statements.find(({ type }) => type === 'TOMLTable');
    if (header) return [{ from: header.range[0], to: header.range[0], insert: `[${path.map(keyOf).join('.')}]\n${line}\n\n` }];
    const last = statements.at(-1);
    const keys = last.key.keys;
    const end = keys.findIndex((key) => (key.name ?? key.value) === path.at(-1));
    return [this.afterStatement(last, `${this.text.slice(keys[0].range[0], keys[end].range[1])}.${line}`)];
  }

  // Elements stand before the rest, all else at the end.
  newSection(name, line) {
    const simulate = this.root.at('simulate')?.node;
    const at = simulate && simulate.type === 'TOMLTable' ? simulate.range[0] : this.text.length;
    const before = at > 0 && at === this.text.length ? (this.text.endsWith('\n') ? '\n' : '\n\n') : '';
    return [{ from: at, to: at, insert: `${before}[${keyOf(name)}]\n${line}\n${at < this.text.length ? '\n' : ''}` }];
  }

  // Takes away the entry at a path; comments on lines of their own stay.
  remove(path) {
    const entry = this.root.at(...path.slice(0, -1))?.entries.get(path.at(-1));
    if (!entry) return [];
    const inner = new Set(entry.statements);
    return entry.statements.filter((statement) => !inner.has(statement.parent)).flatMap((statement) => this.withoutStatement(statement));
  }

  // Takes away several entries of the table at a path.
  removeSeveral(path, names) {
    const { node } = this.root.at(...path);
    if (node?.type === 'TOMLInlineTable') return this.withoutItems(node.body, ({ key }) => names.includes(key.keys[0].name ?? key.keys[0].value));
    return names.flatMap((name) => this.remove([...path, name]));
  }

  withoutStatement(statement) {
    const parent = statement.parent;
    if (parent.type === 'TOMLInlineTable') return [this.withoutItem(parent.body, parent.body.indexOf(statement))];
    const start = this.text.lastIndexOf('\n', statement.range[0] - 1) + 1;
    const last = statement.type === 'TOMLTable' ? statement.body.at(-1) ?? statement.key : statement;
    const end = this.lineEnd(last.range[1]);
    return [{ from: start, to: Math.min(this.text.length, end + 1), insert: '' }];
  }

  withoutItem(items, k) {
    return this.withoutItems(items, (_, i) => i === k)[0];
  }

  // Takes items away with the commas between them.
  withoutItems(items, isUnwanted) {
    const unwanted = items.map(isUnwanted);
    const changes = [];
    for (let i = 0; i < items.length; ++i) {
      if (!unwanted[i]) continue;
      const first = i;
      while (unwanted[i + 1]) ++i;
      const next = items[i + 1];
      const from = !next && first ? items[first - 1].range[1] : items[first].range[0];
      changes.push({ from, to: next ? next.range[0] : items[i].range[1], insert: '' });
    }
    return changes;
  }

  // An item, as TOML, at the end of the array at a path; the array is made if it is not there.
  append(path, toml) {
    const array = this.root.at(...path);
    if (!array?.node) return this.set(path, `[${toml}]`);
    const items = array.node.elements;
    if (!items.length) return [{ from: array.node.range[0], to: array.node.range[1], insert: `[${toml}]` }];
    const end = items.at(-1).range[1];
    return [{ from: end, to: end, insert: `, ${toml}` }];
  }

  // All texts at or below a value, with their paths.
  *texts(value = this.root, path = []) {
    if (value.kind === 'value' && typeof value.plain === 'string') yield { value, path };
    for (const [k, item] of value.items.entries()) yield* this.texts(item, [...path, k]);
    for (const [name, entry] of value.entries) yield* this.texts(entry.value, [...path, name]);
  }
}

// The text after changes of it.
export function changed(text, changes) {
  return [...changes].sort((a, b) => b.from - a.from).reduce((result, { from, to, insert }) => result.slice(0, from) + insert + result.slice(to), text);
}
