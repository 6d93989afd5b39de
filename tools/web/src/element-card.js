// The card of an element: name, type, law, nodes, and a field for each of its parameters.
import { element } from './dom.js';
import { choiceField, readable, valueField } from './fields.js';
import { lawOf } from './formulas.js';
import { t } from './messages.js';
import { startFields } from './node-card.js';
import { richText } from './rich-text.js';
import { inWords } from './sections.js';
import { signalFields } from './signal-field.js';
import { Sliders } from './sliders.js';

const quoted = JSON.stringify;

// The entry of [elements] that defines an element of the schematic, and the element's path within the entry.
function originOf(netlist, name) {
  const parts = name.split('.');
  for (let k = parts.length; k > 0; --k) {
    const entry = parts.slice(0, k).join('.');
    if (netlist.element(entry)) return { entry, inside: parts.slice(k).join('.') };
  }
  return null;
}

export function elementCard(drawing, netlist, name) {
  const origin = originOf(netlist, name);
  if (!origin) return null;
  return new ElementCard(drawing, netlist, name, origin).card();
}

class ElementCard {
  constructor(drawing, netlist, name, { entry, inside }) {
    Object.assign(this, { drawing, name, entry, inside });
    this.path = ['elements', entry];
    this.value = netlist.element(entry);
    this.type = netlist.typeOf(entry);
    this.known = drawing.catalogue.find(this.type);
    this.domain = this.value.at('domain')?.plain ?? drawing.scene?.elements.find((each) => each.name === name)?.domain ?? drawing.domain;
    this.edit = (changes) => drawing.edit(changes);
    this.fields = [];
    this.knobs = this.slidersOf(this.value);
  }

  // The current netlist: a slider may have changed the text since the card was made.
  get netlist() {
    this.drawing.read();
    return this.drawing.netlist;
  }

  card() {
    const isGroup = this.value.at('series') || this.value.at('parallel');
    const parts = [
      this.origin(), this.nameField(), isGroup ? null : this.typeField(), this.law(), ...this.nodeFields(),
      ...(isGroup ? this.members(this.value, this.path) : this.parameters(this.path, this.value, this.type)), ...this.start(),
      this.neighbours(), this.foot(),
    ].filter(Boolean);
    return { heading: this.heading, parts, fields: this.fields, wrong: (mistakes) => this.wrong(mistakes), refresh: () => this.refresh(), move: (changes) => this.sliders?.move(changes) };
  }

  get heading() {
    const name = this.entry;
    return this.value.at('series') ? t('{name}: in series', { name }) : this.value.at('parallel') ? t('{name}: in parallel', { name }) : `${name}: ${this.type}`;
  }

  go(...path) {
    const { editor } = this.drawing.desk;
    editor.goTo(this.netlist.placeOf(...path));
  }

  // The model, assembly or repetition that creates the element, if any.
  origin() {
    const notes = [];
    const link = (text, ...path) => element('button', { type: 'button', class: 'link', onclick: () => this.go(...path) }, text);
    const { name, type, inside } = this;
    const isRepeated = this.value.at('repeat');
    if (isRepeated) {
      const what = inside ? t('{name} is one of those that `repeat` makes: a change here changes all of them.', { name }) : t('This is the pattern of those that `repeat` makes: a change here changes all of them.');
      notes.push([richText(what), ' ', link(t('Open the text'), ...this.path)]);
    }
    if (!this.known && type) {
      const own = ['models', 'laws'].find((table) => this.netlist.root.at(table, type));
      notes.push(own ? [richText(this.instanceOf(own, inside && !isRepeated)), ' ', t('A change there changes all its instances.'), ' ', link(t('Open its text'), own, type)]
        : [richText(this.instanceOf(own, inside && !isRepeated)), ' ', t('Its own values can be given here.'), ' ', link(t('Open the text'), ...this.path)]);
    }
    return notes.length ? element('div', { class: 'origin' }, notes.map((note) => element('p', {}, note))) : null;
  }

  // `own`: the table of this netlist that defines the type; absent where an included file does.
  instanceOf(own, isPart) {
    const { name, type } = this;
    if (own === 'laws') return t('This is an instance of the law `{type}`, which this netlist defines.', { type });
    if (own) return isPart ? t('{name} is a part of the model `{type}`, which this netlist defines.', { name, type }) : t('This is an instance of the model `{type}`, which this netlist defines.', { type });
    return isPart ? t('{name} is a part of the model `{type}`, which comes from an included file.', { name, type }) : t('This is an instance of the model `{type}`, which comes from an included file.', { type });
  }

  nameField() {
    const { entry, drawing } = this;
    const field = valueField({
      label: t('name'), value: entry, isText: true,
      onset: () => {
        const { netlist } = this;
        const name = field.input.value.trim();
        const fault = netlist.faultOfName(name, entry, false);
        field.refuse(fault);
        if (fault) return;
        drawing.inspector.target = { element: name };
        this.edit(netlist.rename(entry, name));
      },
    });
    return field.row;
  }

  // Types that have the same ports.
  typeField() {
    if (!this.known) return null;
    const alike = this.drawing.catalogue.types.filter(({ ports, nodes, group }) => ports === this.known.ports && nodes.length === this.known.nodes.length && (group === 'Signals') === (this.known.group === 'Signals'));
    return choiceField({ label: t('type'), value: this.type, options: alike.map((type) => [type.type[this.domain], type.type[this.domain]]), onset: (type) => this.edit(this.retyped(type)) }).row;
  }

  // Changes the type. Parameters that the new type has too are kept; the others are replaced by those that it requires.
  retyped(type) {
    const { netlist, path, domain } = this;
    const next = this.drawing.catalogue.find(type);
    const given = netlist.givenOf(this.entry).map(({ name }) => name);
    const known = (name) => next.parameters.find((parameter) => parameter.name[domain] === name);
    const unknown = given.filter((name) => !known(name));
    const isChosen = given.some((name) => known(name)?.alternative);
    const missing = this.drawing.catalogue.firstValues(next, domain).filter(([name]) => !given.includes(name) && !(isChosen && known(name).alternative));
    return [
      ...netlist.set([...path, 'type'], quoted(type)),
      ...missing.flatMap(([name, toml], k) => (unknown[k] ? netlist.replace([...path, unknown[k]], name, toml) : netlist.set([...path, name], toml))),
      ...netlist.removeSeveral(path, unknown.slice(missing.length)),
    ];
  }

  law() {
    if (!this.known) return null;
    return element('div', { class: 'card-law' }, element('p', { class: 'about' }, inWords(this.known.summary)), lawOf(this.known.tex, this.type));
  }

  // Where a mass begins, and how fast: values of its node.
  start() {
    const node = this.known?.type.translation === 'mass' && this.value.at('at')?.plain;
    if (!node) return [];
    const fields = startFields(this.drawing, node, this.edit);
    this.fields.push(...fields);
    return fields.map(({ field }) => field.row);
  }

  nodeFields() {
    const ports = this.netlist.portsOf(this.entry);
    const words = this.known?.nodes ?? [];
    return ports.map(({ key, node, path }, k) => {
      const label = key === 'between' ? (words[k]?.length > 1 ? words[k] : k === 0 ? t('from node') : k === 1 ? t('to node') : t('node {node}', { node: k + 1 })) : key === 'at' ? t('at node') : key;
      const taken = ports.filter((other) => other.path !== path && other.key === key).map((other) => other.node);
      const options = [...this.netlist.nodeNames, ...(key === 'at' ? [] : ['ground'])].filter((name) => !taken.includes(name)).map((name) => [name, name]);
      const fresh = this.netlist.freshNode();
      return choiceField({ label, value: node, options: [...options, [`+${fresh}`, t('new node {node}', { node: fresh })]], onset: (name) => this.edit(this.netlist.connect(path, name.replace(/^\+/, ''))) }).row;
    });
  }

  // Adds an element in series with this one or parallel to it.
  neighbours() {
    if (this.netlist.portsOf(this.entry).filter(({ key }) => key === 'between').length !== 2) return null;
    const { catalogue, ownTypes } = this.drawing;
    const types = [...catalogue.types.filter(({ nodes, group }) => nodes.length === 2 && group !== 'Transmissions').map(({ type }) => type[this.domain]), ...ownTypes.filter(([, , ports]) => ports === 2).map(([name]) => name)];
    const { row, input } = choiceField({ label: t('add'), value: this.type === 'spring' ? 'dashpot' : 'spring', options: types.map((type) => [type, type]), onset: () => {} });
    const button = (text, inSeries) => element('button', { type: 'button', onclick: () => this.drawing.addBeside(this.entry, input.value, this.domain, inSeries) }, text);
    row.append(element('span', { class: 'neighbours' }, button(t('in series'), true), button(t('in parallel'), false)));
    return row;
  }

  // Members of a group, each with its parameters.
  members(value, path) {
    const rows = [];
    for (const key of ['series', 'parallel'])
      value.at(key)?.items.forEach((item, k) => {
        const inner = [...path, key, k];
        const type = item.at('type')?.plain ?? '';
        const name = item.at('name')?.plain ?? '';
        const group = item.at('series') ? t('in series') : item.at('parallel') ? t('in parallel') : '';
        rows.push(element('fieldset', { class: 'member' }, element('legend', {}, [name, type || group].filter(Boolean).join(': ')),
          group ? this.members(item, inner) : this.parameters(inner, item, type)));
      });
    return rows;
  }

  // Given and required parameters first, the others folded.
  parameters(path, value, type) {
    const known = this.drawing.catalogue.find(type);
    if (!known) return this.freeParameters(path, value, type);
    const given = (parameter) => value.entries.has(parameter.name[this.domain]);
    const first = known.parameters.filter((parameter) => given(parameter) || parameter.required);
    const others = known.parameters.filter((parameter) => !first.includes(parameter));
    const inputs = known.most_inputs > 0 ? [this.inputField(path, value)] : [];
    return [...inputs, ...first.map((parameter) => this.parameter(path, value, parameter)),
      others.length ? element('details', { class: 'others' }, element('summary', {}, t('More parameters ({count})', { count: others.length })), others.map((parameter) => this.parameter(path, value, parameter))) : null];
  }

  parameter(path, value, parameter) {
    const name = parameter.name[this.domain];
    const own = [...path, name];
    const there = value.at(name);
    if (parameter.signal && there && (there.kind === 'table' || parameter.source))
      return signalFields(this, own, parameter);
    return this.fieldOf(own, {
      label: name, symbol: parameter.symbol, description: parameter.description, unit: parameter.unit[this.domain], placeholder: parameter.without, optional: !parameter.required, first: parameter.first[this.domain],
      onset: (toml) => this.edit(toml === null ? this.netlist.remove(own) : this.givenInstead(path, value, parameter, toml)),
    });
  }

  // The field of the value at a path, with its slider if it is a number.
  fieldOf(path, options) {
    const value = this.netlist.root.at(...path);
    const named = this.netlist.parameterOf(value);
    if (named) options = { ...options, description: [options.description, t('{name} = {value}, a parameter of the netlist', { name: value.plain, value: readable(this.netlist, named) })].filter(Boolean).join(' – ') };
    const field = valueField({ value: readable(this.netlist, value), ...options });
    const knob = value?.node && this.knobs.get((named ?? value).node.range[0]);
    if (knob) field.input.after(knob);
    this.fields.push({ path, field });
    return field.row;
  }

  // Updates the sliders from the fields.
  refresh() {
    this.value = this.netlist.element(this.entry);
    if (this.sliders && this.drawing.isNew) this.sliders.show(this.knobsIn(this.value), false);
  }

  // Sets a parameter and removes the one that it excludes, if exactly one of several must be given.
  givenInstead(path, value, parameter, toml) {
    const name = parameter.name[this.domain];
    const others = parameter.alternative && !value.at(name) ? (this.known?.parameters ?? []).filter((other) => other.alternative && value.at(other.name[this.domain])) : [];
    if (!others.length) return this.netlist.set([...path, name], toml);
    return this.netlist.replace([...path, others[0].name[this.domain]], name, toml);
  }

  // Parameters of a model or a law: the values of the instance, and defaults if this netlist defines the model or law.
  freeParameters(path, value, type) {
    const declared = (this.netlist.root.at('models', type) ?? this.netlist.root.at('laws', type))?.at('parameters');
    const tables = declared?.kind === 'array' ? declared.items : declared ? [declared] : [];
    const defaults = new Map(tables.flatMap((table) => (table.kind === 'table' ? [...table.entries.values()].map((entry) => [entry.name, entry.value]) : [[table.plain, null]])));
    const names = [...new Set([...defaults.keys(), ...(path.length === 2 ? this.netlist.givenOf(this.entry).map(({ name }) => name) : [])])];
    return names.map((name) => this.fieldOf([...path, name], {
      label: name, placeholder: readable(this.netlist, defaults.get(name)), optional: defaults.get(name) !== null, first: defaults.get(name)?.node ? this.netlist.source(defaults.get(name).node) : '',
      onset: (toml) => this.edit(toml === null ? this.netlist.remove([...path, name]) : this.netlist.set([...path, name], toml)),
    }));
  }

  get blocks() {
    return this.netlist.elementNames.filter((name) => this.drawing.catalogue.find(this.netlist.typeOf(name))?.group === 'Signals');
  }

  inputField(path, value) {
    const options = [...this.blocks.filter((name) => name !== this.entry), ...(this.drawing.scene?.records ?? []).filter(({ subject }) => subject === 'node' || subject === 'element').map(({ path: record }) => record)];
    return valueField({
      label: 'in', description: t('what the block takes in: a block, or a quantity such as a.velocity; several in brackets'), value: readable(this.netlist, value.at('in')), options,
      onset: (toml) => this.edit(this.netlist.set([...path, 'in'], toml)),
    }).row;
  }

  // The numbers in the entry, and the numbers of the parameters that it refers to.
  knobsIn(value) {
    const { desk, scene } = this.drawing;
    const starts = this.netlist.numbersIn(value);
    return scene.sliders.filter(({ line, column }) => starts.has(desk.editor.offset(line, column)));
  }

  // Sliders of these numbers, by the position of the number.
  slidersOf(value) {
    const mine = this.drawing.isNew ? this.knobsIn(value) : [];
    if (!mine.length) return new Map();
    this.sliders = new Sliders(element('div'), this.drawing.desk.editor);
    this.sliders.show(mine, true);
    return new Map(this.sliders.all.map((slider) => [slider.from, slider.range]));
  }

  foot() {
    return element('div', { class: 'inspector-foot' },
      element('button', { type: 'button', onclick: () => this.go(...this.path) }, t('Show in the text')),
      element('button', { type: 'button', class: 'delete', onclick: () => this.drawing.remove(this.entry) }, t('Delete')));
  }

  // Shows the mistakes within the element; a field with a mistake is marked.
  wrong(mistakes) {
    const entry = this.netlist.root.at('elements').entries.get(this.entry);
    const ranges = entry.statements.map((statement) => [statement.range[0], (statement.type === 'TOMLTable' ? statement.body.at(-1) ?? statement : statement).range[1]]);
    const { editor } = this.drawing.desk;
    const mine = mistakes.filter(({ line }) => line).map((mistake) => ({ ...mistake, at: editor.offset(mistake.line, mistake.column) })).filter(({ at }) => ranges.some(([from, to]) => from <= at && at <= to));
    for (const { path, field } of this.fields) {
      const node = this.netlist.root.at(...path)?.node;
      const bad = mine.find(({ at, severity }) => severity === 'error' && node && node.range[0] <= at && at < node.range[1]);
      if (bad) field.input.setAttribute('aria-invalid', 'true');
      else field.input.removeAttribute('aria-invalid');
    }
    return mine.filter(({ severity }) => severity === 'error').map(({ message, hint }) => (hint ? `${message} – ${hint}` : message));
  }
}
