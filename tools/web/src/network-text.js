// The network in the text of a netlist: elements, nodes, and all references to them by name.
import { t } from './messages.js';
import { NetlistText, keyOf, valueOf } from './netlist-text.js';

const ofNodes = new Set(['position', 'velocity', 'acceleration']); // channels
const places = new Set(['between', 'at', 'support']); // keys whose values are nodes
const inWiring = new Set([...places, 'type', 'name', 'repeat', 'series', 'parallel', 'domain', 'in', 'arrange', 'smooth', 'columns']);

const escaped = (name) => name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');

export class NetworkText extends NetlistText {
  // The names of the elements, in the order of the text.
  get elementNames() {
    return [...(this.root.at('elements')?.entries.keys() ?? [])];
  }

  element(name) {
    return this.root.at('elements', name);
  }

  typeOf(name) {
    return this.element(name)?.at('type')?.plain ?? '';
  }

  // The nodes of an element, each with the path of the text that names it.
  portsOf(name) {
    const element = this.element(name);
    const ports = [];
    for (const key of places) {
      const value = element?.at(key);
      if (typeof value?.plain === 'string') ports.push({ key, node: value.plain, path: ['elements', name, key] });
      value?.items.forEach((item, k) => typeof item.plain === 'string' && ports.push({ key, node: item.plain, path: ['elements', name, key, k] }));
    }
    return ports;
  }

  // Without ground, in the order in which the elements name them.
  get nodeNames() {
    const names = new Set(this.elementNames.flatMap((name) => this.portsOf(name).map(({ node }) => node)));
    names.delete('ground');
    return [...names];
  }

  elementsAt(node) {
    return this.elementNames.filter((name) => this.portsOf(name).some((port) => port.node === node));
  }

  // Parameters in the entry of an element, as written.
  givenOf(name) {
    return [...(this.element(name)?.entries.values() ?? [])].filter((entry) => !inWiring.has(entry.name));
  }

  // The places of the numbers in a value, and of those of the parameters that it names.
  numbersIn(value, found = new Set()) {
    if (value.kind === 'value') found.add((this.parameterOf(value) ?? value).node.range[0]);
    value.items.forEach((item) => this.numbersIn(item, found));
    for (const entry of value.entries.values()) this.numbersIn(entry.value, found);
    return found;
  }

  // The parameter that a value names.
  parameterOf(value) {
    return typeof value?.plain === 'string' ? this.root.at('parameters', value.plain) : null;
  }

  // A name that no element and no node has.
  freshName(word, taken = []) {
    const all = new Set([...this.elementNames, ...this.nodeNames, ...(this.root.at('parameters')?.entries.keys() ?? []), ...taken, 'ground']);
    let k = 1;
    while (all.has(`${word}${k}`)) ++k;
    return `${word}${k}`;
  }

  // Nodes are called a, b, c, ...
  freshNode(taken = []) {
    const all = new Set([...this.elementNames, ...this.nodeNames, ...taken]);
    for (let k = 0; ; ++k) {
      const name = String.fromCharCode(97 + (k % 26)) + (k < 26 ? '' : Math.floor(k / 26));
      if (!all.has(name)) return name;
    }
  }

  // Why the element or node `old` cannot be renamed to a name; empty if it can.
  faultOfName(name, old, isNode) {
    if (!name) return t('A name is missing.');
    if (!/^[A-Za-z0-9_-]+$/.test(name)) return t('A name is made of letters, digits, _ and -.');
    if (name === 'ground') return t('“ground” is the node that never moves.');
    if (name === old) return '';
    if (isNode && this.nodeNames.includes(name)) return t('There is a node called {name} already.', { name });
    if (!isNode && this.elementNames.includes(name)) return t('There is an element called {name} already.', { name });
    return '';
  }

  // A new element at the end of [elements]; `parameters`: pairs of a name and a value in TOML.
  addElement(name, type, wiring, parameters) {
    const parts = [`type = ${valueOf(type)}`, ...wiring, ...parameters.map(([key, toml]) => `${keyOf(key)} = ${toml}`)];
    return this.insert(['elements'], name, `{ ${parts.join(', ')} }`);
  }

  // Another node at one end of an element.
  wire(path, node) {
    const { range: [from, to] } = this.root.at(...path).node;
    return [{ from, to, insert: JSON.stringify(node) }];
  }

  // The same, where nothing else is done to the netlist. If no other end is at the node before, all that refers to it follows to the new one.
  connect(path, node) {
    const old = this.root.at(...path).plain;
    const ends = this.elementNames.flatMap((name) => this.portsOf(name)).filter((port) => port.node === old);
    return old !== 'ground' && ends.length === 1 ? this.renameNode(old, node) : this.wire(path, node);
  }

  // Every place where a path or an expression over paths may stand, with the text between its quotes.
  *references() {
    for (const { value, path } of this.texts()) {
      const [top, second, key] = path;
      const expression = (top === 'simulate' && second === 'stop_when') || (top === 'simulate' && second === 'record' && path.at(-1) === 'value');
      const isPath = (top === 'simulate' && second === 'record' && path.length === 3) || top === 'plot' || (top === 'expect' && path.at(-1) === 'per') ||
        (top === 'elements' && !places.has(key) && key !== 'type' && key !== 'name');
      if (expression || isPath) yield { node: value.node, path, expression, inner: this.source(value.node) };
    }
  }

  // Replaces a name before a dot: in paths of records, in expressions over them, in quantities that blocks take in. `keeps(channel)`
  // says of a path whether it means something else of this name.
  renamedPaths(old, name, keeps) {
    const changes = [];
    const before = (expression) => (expression ? '(?<![\\w.])' : '(?<![\\w.-])-?'); // a name in an expression has no dash
    const pattern = (expression) => new RegExp(`${before(expression)}${escaped(old)}(?=\\.([\\w-]+))`, 'g');
    const replace = (node, text, expression = false) => {
      for (const { index, 0: { length }, 1: channel } of text.matchAll(pattern(expression))) {
        const to = node.range[0] + index + length;
        if (!keeps(channel)) changes.push({ from: to - old.length, to, insert: name });
      }
    };
    for (const { node, inner, path, expression } of this.references()) {
      // Texts of an element that are no paths, such as "2*B", have no name with a dot in them.
      if (path[0] !== 'plot' || !['unit', 'log'].includes(path[1])) replace(node, inner, expression);
    }
    for (const table of ['expect', 'exact', 'nodes'])
      for (const entry of this.root.at(table)?.entries.values() ?? []) {
        const nested = entry.value.kind === 'table' && entry.name === old && table !== 'nodes';
        for (const key of entry.keys) {
          if (nested) {
            // k1.force without quotes.
            const channels = [...entry.value.entries.keys()];
            if (!channels.some((channel) => keeps(channel))) changes.push({ from: key.range[0], to: key.range[1], insert: keyOf(name) });
          } else replace(key, this.source(key));
        }
      }
    return changes;
  }

  rename(old, name) {
    const shared = this.nodeNames.includes(old);
    const entry = this.root.at('elements').entries.get(old);
    const changes = entry.keys.map(({ range: [from, to] }) => ({ from, to, insert: keyOf(name) }));
    changes.push(...this.renamedPaths(old, name, (channel) => shared && ofNodes.has(channel)));
    for (const { node, inner, path } of this.references()) {
      const isName = ['block', 'in', 'loop', 'flow'].some((key) => path.includes(key));
      const sign = /^["']-?/.exec(inner)?.[0] ?? '';
      if (isName && inner.slice(sign.length, -1) === old) changes.push({ from: node.range[0] + sign.length, to: node.range[1] - 1, insert: name });
    }
    for (const { value, path } of this.texts(this.root.at('effects') ?? undefined, ['effects']))
      if (path[0] === 'effects' && value.plain.endsWith(`:${old}`)) changes.push({ from: value.node.range[1] - 1 - old.length, to: value.node.range[1] - 1, insert: name });
    return changes;
  }

  // Also joins two nodes: `name` may be that of another one, whose records and claims are not doubled, or ground, which has none.
  renameNode(old, name) {
    const shared = this.elementNames.includes(old);
    const gone = this.withoutPaths((path, others) => {
      const [owner, channel] = [path.split('.')[0], path.split('.').at(-1)];
      return owner === old && ofNodes.has(channel) && (name === 'ground' || others.includes(`${name}.${channel}`));
    });
    const changes = this.elementNames.flatMap((element) => this.portsOf(element)).filter(({ node }) => node === old).flatMap(({ path }) => this.wire(path, name));
    const entry = this.root.at('nodes')?.entries.get(old);
    if (entry && (name === 'ground' || this.root.at('nodes', name))) changes.push(...this.remove(['nodes', old]));
    else if (entry) changes.push(...entry.keys.map(({ range: [from, to] }) => ({ from, to, insert: keyOf(name) })));
    changes.push(...this.renamedPaths(old, name, (channel) => shared && !ofNodes.has(channel)));
    for (const { node, inner, path } of this.references())
      if (path[0] === 'plot' && path[1] === 'phase' && inner.slice(1, -1) === old) changes.push({ from: node.range[0] + 1, to: node.range[1] - 1, insert: name });
    return [...gone, ...changes.filter(({ from, to }) => !gone.some((other) => other.from <= from && to <= other.to))];
  }

  // Removes records and claims. isGone(path, all): `all` are the paths of the same list.
  withoutPaths(isGone) {
    const changes = [];
    const plain = (path) => path.replace(/^-/, '');
    const record = this.root.at('simulate', 'record');
    if (record?.kind === 'array') {
      const paths = record.items.map((item) => (typeof item.plain === 'string' ? plain(item.plain) : null));
      const gone = paths.map((path) => path !== null && isGone(path, paths));
      // An empty list would record nothing at all: without it everything is.
      if (gone.length && gone.every(Boolean)) changes.push(...this.remove(['simulate', 'record']));
      else changes.push(...this.withoutItems(record.node.elements, (_, k) => gone[k]));
    }
    for (const table of ['expect', 'exact']) {
      const entries = [...(this.root.at(table)?.entries.values() ?? [])];
      // k1.force without quotes is a table k1 that has an entry `force`.
      const claims = entries.flatMap(({ name, value }) => (value.kind === 'table' && !name.includes('.') ? [...value.entries.keys()].map((key) => ({ name: `${name}.${key}`, path: [name, key] })) : [{ name, path: [name] }]));
      for (const { name, path } of claims) if (isGone(name, claims.map((claim) => claim.name))) changes.push(...this.remove([table, ...path]));
    }
    return changes;
  }

  // Removes an element, its nodes that no other element names, and all records, claims and start values of these.
  removeElement(name) {
    const orphans = this.portsOf(name).map(({ node }) => node).filter((node) => node !== 'ground' && this.elementsAt(node).every((other) => other === name));
    const isGone = (path) => {
      const [owner, channel] = [path.split('.')[0], path.split('.').at(-1)];
      if (orphans.includes(owner) && ofNodes.has(channel)) return true;
      return owner === name && !(this.nodeNames.includes(name) && ofNodes.has(channel));
    };
    const changes = [...this.remove(['elements', name]), ...this.withoutPaths(isGone)];
    for (const node of orphans) changes.push(...this.remove(['nodes', node]));
    return changes;
  }
}
