// Completion and hover texts of the editor, from the schema of netlists and from the network.
import { autocompletion, snippetCompletion } from '@codemirror/autocomplete';
import { hoverTooltip } from '@codemirror/view';
import { element } from './dom.js';
import { t } from './messages.js';
import { keyOf } from './netlist-text.js';
import { placeIn } from './netlist-place.js';
import { SchemaPath } from './schema-path.js';
import { inWords } from './sections.js';
import { inPrint } from './units.js';

const nodeKeys = new Set(['between', 'at', 'support']);

class Assistant {
  // `drawing` has the element types, the network that was read last, and the possible records.
  constructor(drawing) {
    Object.assign(this, { drawing, catalogue: drawing.catalogue, netlist: drawing.lastRead, records: drawing.scene?.records ?? [] });
    this.schema = new SchemaPath(drawing.catalogue.schema);
  }

  // Elements of models have the same description as elements of the scene.
  typeAt({ path, given }) {
    return path.includes('elements') ? given.get('type')?.replace(/["']/g, '') ?? this.typeOfEntry(path) : null;
  }

  // The type of an entry with a header of its own, or whose type follows the position.
  typeOfEntry(path) {
    const type = this.netlist?.root.at(...path)?.at('type');
    return typeof type?.plain === 'string' ? type.plain : null;
  }

  givenAt(place) {
    const type = this.typeAt(place);
    return type ? new Map([...place.given, ['type', type]]) : place.given;
  }

  parameter(place, name) {
    return this.catalogue.find(this.typeAt(place))?.parameters.find((each) => Object.values(each.name).includes(name));
  }

  keys(place) {
    const given = this.givenAt(place);
    const domain = this.drawing.domain;
    return [...this.schema.keysAt(place.path, given)].filter(([name]) => !place.given.has(name) || name === place.word).map(([name, info]) => {
      const parameter = this.parameter(place, name);
      const words = this.schema.wordsAt([...place.path, name], given);
      const value = parameter ? parameter.first[domain] : nodeKeys.has(name) ? (name === 'between' ? '["a", "b"]' : '"a"') : words.size ? '"${}"' : '${}';
      return snippetCompletion(`${keyOf(name)} = ${parameter || nodeKeys.has(name) ? value.replace(/^(["[]*)(.*?)(["\]]*)$/s, '$1${$2}$3') : value}`, { label: name, detail: parameter ? inPrint(parameter.unit[domain]) : '', info, type: 'property' });
    });
  }

  tables() {
    return [...Object.entries(this.catalogue.schema.properties)].filter(([name]) => this.schema.at([name], new Map()).some(({ properties, additionalProperties }) => properties || additionalProperties))
      .map(([name, schema]) => ({ label: name, info: this.schema.describe(schema, new Map()), type: 'namespace' }));
  }

  names() {
    const { netlist } = this;
    return { nodes: ['ground', ...(netlist?.nodeNames ?? [])], elements: netlist?.elementNames ?? [], parameters: [...(netlist?.root.at('parameters')?.entries.keys() ?? [])] };
  }

  values(place) {
    const { key, path } = place;
    const { nodes, elements, parameters } = this.names();
    const option = (label, type, info = '') => ({ label, type, info });
    if (key === 'type' && path.includes('elements')) {
      const own = this.drawing.ownTypes.map(([name, about]) => option(name, 'class', about));
      return [...[...this.catalogue.byName].map(([name, { summary, law }]) => option(name, 'class', `${summary}: ${law}`)), ...own];
    }
    if (nodeKeys.has(key)) return nodes.map((node) => option(node, 'variable', this.aboutNode(node)));
    if (path[0] === 'plot' && ['loop', 'flow'].includes(key)) return elements.map((name) => option(name, 'variable', this.aboutElement(name)));
    if (path[0] === 'plot' && key === 'phase') return nodes.map((node) => option(node, 'variable'));
    if ((path[0] === 'simulate' && key === 'record') || path[0] === 'plot' || key === 'per' || key === 'in') return [...(key === 'in' ? elements.map((name) => option(name, 'variable', this.aboutElement(name))) : []), ...this.records.map((record) => option(record.path, 'variable', `${record.quantity} [${inPrint(record.unit)}]`))];
    if (key === 'block') return elements.filter((name) => this.catalogue.find(this.netlist.typeOf(name))?.group === 'Signals').map((name) => option(name, 'variable', this.aboutElement(name)));
    const words = this.schema.wordsAt([...path.filter((part) => typeof part !== 'number'), key], this.givenAt(place));
    if (words.size) return [...words].map(([word, about]) => option(String(word), 'constant', about));
    return parameters.map((name) => option(name, 'variable', t('a parameter of this netlist')));
  }

  // The units of the quantity, after a number and a blank.
  units(place) {
    const typed = /^[+-]?[\d.]+(?:e[+-]?\d+)?\s+(\S*)$/i.exec(place.word);
    if (!typed || !place.quote) return null;
    const parameter = this.parameter(place, place.key) ?? this.parameter({ ...place, path: place.path.slice(0, -1) }, place.path.at(-1));
    const described = this.schema.keysAt(place.path, this.givenAt(place)).get(place.key) ?? '';
    const units = parameter ? [...new Set(Object.values(parameter.unit))] : [/\[([^\];]+?)(?:;|\])/.exec(described)?.[1] ?? ''];
    const from = place.from + place.word.length - typed[1].length;
    return { from, options: units.filter((unit) => unit && !unit.includes(' ')).map((unit) => ({ label: unit, type: 'keyword' })) };
  }

  complete(place) {
    if (place.isHeader) return { from: place.from, options: this.tables() };
    if (place.key === null) return { from: place.from, options: this.keys(place) };
    const units = this.units(place);
    if (units) return units;
    const options = this.values(place);
    return { from: place.from, options: place.quote ? options : options.map((each) => ({ ...each, apply: JSON.stringify(each.label) })) };
  }

  aboutNode(node) {
    if (node === 'ground') return t('the node that never moves');
    const at = this.netlist?.elementsAt(node) ?? [];
    return at.length ? t('node, with {elements}', { elements: at.join(', ') }) : '';
  }

  aboutElement(name) {
    const type = this.netlist?.typeOf(name);
    const at = this.netlist?.portsOf(name).map(({ node }) => node) ?? [];
    const nodes = at.join(', ');
    if (!type || !nodes) return type ?? '';
    return at.length > 1 ? t('{type} between {nodes}', { type, nodes }) : t('{type} at {nodes}', { type, nodes });
  }

  // The description of a word; null if there is none.
  explain(place, word) {
    if (place.key === null) return place.isHeader ? this.schema.describe(this.catalogue.schema.properties[word], new Map()) : this.schema.keysAt(place.path, this.givenAt(place)).get(word) ?? (place.path.at(-1) === 'elements' ? this.aboutElement(word) : null);
    const type = place.key === 'type' && this.catalogue.find(word);
    if (type) return `${type.summary}: ${type.law}`;
    if (nodeKeys.has(place.key)) return this.aboutNode(word);
    const record = this.records.find(({ path }) => path === word);
    if (record) return `${record.quantity} [${inPrint(record.unit)}]`;
    const parameter = this.netlist?.root.at('parameters', word);
    return parameter?.node ? `${word} = ${this.netlist.source(parameter.node)}` : this.aboutElement(word);
  }
}

// `drawingOf()` returns the drawing as soon as it exists.
export function assistance(drawingOf) {
  const assistant = async () => {
    const drawing = drawingOf();
    return drawing && (await drawing.load()) ? new Assistant(drawing) : null;
  };
  const source = async (context) => {
    const place = placeIn(context.state.doc.toString(), context.pos);
    if (!place || (!context.explicit && !place.word && !place.quote)) return null;
    const helper = await assistant();
    const offered = helper?.complete(place);
    if (!offered?.options.length) return null;
    return { ...offered, validFor: /^[^\s"',\]}]*$/ };
  };
  const hover = hoverTooltip(async (view, position) => {
    const text = view.state.doc.toString();
    const before = /[\w.-]*$/.exec(text.slice(Math.max(0, position - 80), position))[0];
    const after = /^[\w.-]*/.exec(text.slice(position, position + 80))[0];
    const word = before + after;
    const place = word && placeIn(text, position - before.length + Math.min(1, word.length));
    if (!place) return null;
    const about = (await assistant())?.explain(place, word);
    if (!about) return null;
    return { pos: position - before.length, end: position + after.length, create: () => ({ dom: element('div', { class: 'hover' }, element('b', {}, word), ' ', inWords(about)) }) };
  });
  return [autocompletion({ override: [source], icons: false }), hover];
}
