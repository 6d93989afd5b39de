// Drawing by mouse, touch or keyboard: an action in the schematic changes the netlist, and the schematic is drawn again from it.
import './drawing.css';
import { catalogue } from './catalogue.js';
import { element, tellMore } from './dom.js';
import { Handles } from './handles.js';
import { Inspector } from './inspector.js';
import { t } from './messages.js';
import { NetworkText } from './network-text.js';
import { Palette } from './palette.js';
import { pullOf } from './pull.js';

// The schematic without elements: only ground.
const emptyPicture = () => `<svg viewBox="0 0 320 90" class="empty-picture" fill="none" stroke="currentColor" stroke-width="1.4" aria-label="${t('Empty schematic')}">
<path class="ground" d="M290 20V70" stroke-width="2.2"/><path d="M290 24l7 6M290 32l7 6M290 40l7 6M290 48l7 6M290 56l7 6M290 64l7 6" stroke-width="0.8"/></svg>`;
const groundAlone = { elements: [], joints: [{ element: '', node: 'ground', x: 290, y: 45 }] };

export class Drawing {
  // `desk`: the playground; `drawing`: where the schematic is; `bar`: the tools above it; `cards`: where cards are shown.
  constructor(desk, { drawing, bar, cards }) {
    this.desk = desk;
    this.host = drawing;
    this.netlist = null;
    this.scene = null;
    this.mistakes = [];
    this.placing = null;
    this.handles = new Handles(drawing, {
      onpick: (target, byKey, event) => this.pick(target, byKey, event),
      onconnect: (name, from, target) => this.connect(name, from, target),
      onremove: (name) => this.remove(name),
      pullOf: (name) => pullOf(this.desk, name),
      isPlacing: () => Boolean(this.placing),
      onspan: (from, to) => this.span(from, to),
    });
    this.inspector = new Inspector(this, cards);
    this.build(bar);
    // The handles are at the places of t = 0.
    drawing.addEventListener('pointerdown', () => this.isOn && this.desk.animation.rewind(), true);
    document.addEventListener('keydown', (event) => this.key(event));
  }

  build(bar) {
    const button = (text, act, extra = {}) => element('button', { type: 'button', onclick: act, ...extra }, text);
    this.toggle = button(t('Draw'), () => this.switch(), { 'aria-pressed': 'false' });
    this.tools = element('span', { class: 'drawing-tools', hidden: true },
      button('↶', () => this.desk.editor.undo(), { 'aria-label': t('Undo'), title: t('Undo (Ctrl Z)') }),
      button('↷', () => this.desk.editor.redo(), { 'aria-label': t('Redo'), title: t('Redo (Ctrl Y)') }),
      button(t('Run …'), () => this.inspector.showRun(), { title: t('Title, length of the run, rows, what is recorded') }));
    this.prompt = element('div', { class: 'prompt', role: 'group', 'aria-label': t('What to do in the schematic'), hidden: true });
    const palette = element('div', { class: 'palette', role: 'group', 'aria-label': t('Element types'), hidden: true });
    this.palette = new Palette(palette, { onchoose: (type) => this.begin(type), ondrop: (type, x, y) => this.drop(type, x, y) });
    tellMore(palette);
    bar.append(this.toggle, this.tools);
    this.host.parentNode.before(palette, this.prompt);
  }

  async switch(on = !this.isOn) {
    this.isOn = on;
    this.toggle.setAttribute('aria-pressed', String(on));
    this.tools.hidden = this.palette.host.hidden = this.prompt.hidden = !on;
    this.host.classList.toggle('drawn-in', on);
    this.host.closest('.box').classList.toggle('is-drawing', on);
    this.cancel();
    if (on) this.desk.animation.rewind();
    await this.load();
    this.follow();
    this.attach();
  }

  async load() {
    try {
      this.catalogue ??= await catalogue();
    } catch (error) {
      this.desk.answer(t('The element types cannot be had: {why}', { why: error.message }), true);
    }
    return this.catalogue;
  }

  get domain() {
    return this.netlist?.root.at('domain')?.plain === 'rotation' ? 'rotation' : 'translation';
  }

  // The unit system at a node, which may differ from that of the scene.
  domainAt(node) {
    return this.scene?.elements.find(({ a, b }) => node !== 'ground' && (a === node || b === node))?.domain ?? this.domain;
  }

  // Takes the scene that rheonet read last, from `text`. `isNew` says whether this is the current text.
  known(scene, text) {
    this.scene = scene;
    this.sceneText = text;
    this.mistakes = [];
    this.follow();
  }

  get isNew() {
    return Boolean(this.scene) && this.sceneText === this.desk.editor.text;
  }

  // Takes the mistakes of the current text.
  told(mistakes) {
    this.mistakes = mistakes;
    this.follow();
  }

  // Call before another scene is opened.
  clear() {
    this.scene = this.sceneText = this.lastGood = null;
    this.mistakes = [];
    this.inspector.close();
    this.cancel();
  }

  // Whether the netlist has no elements yet.
  get isEmpty() {
    return this.read() && this.netlist.elementNames.length === 0;
  }

  // Parses the current text. Returns whether it is valid TOML.
  read() {
    const { text } = this.desk.editor;
    if (this.netlist?.text === text) return true;
    try {
      this.lastGood = this.netlist = new NetworkText(text);
      this.fault = null;
      return true;
    } catch (error) {
      this.netlist = null;
      this.fault = error;
      return false;
    }
  }

  // The network that was read last, also while the current text is not valid TOML.
  get lastRead() {
    if (!this.lastGood && this.sceneText) this.lastGood = new NetworkText(this.sceneText);
    return this.lastGood;
  }

  // Call for a new schematic.
  attach(scene = this.scene) {
    const svg = this.host.querySelector('.schematic svg');
    if (this.isOn && this.isEmpty) {
      this.desk.drawn = null;
      this.host.innerHTML = emptyPicture();
      this.handles.attach(this.host.firstElementChild, groundAlone);
    } else if (svg && scene) {
      this.handles.attach(svg, scene, this.isOn);
      this.handles.show(this.inspector.target);
    }
    this.desk.view.attach(); // after the handles, which may widen the drawing
  }

  // Call when the text has changed, or when rheonet has read it.
  follow() {
    if (this.catalogue && this.read() && this.isOn) this.palette.show(this.catalogue, this.domain, this.ownTypes);
    if (this.isOn && this.isEmpty && this.host.querySelector('.schematic')) this.attach();
    if (this.catalogue) this.inspector.follow();
  }

  // Models and laws of this netlist, with the number of nodes of an instance.
  get ownTypes() {
    if (!this.lastRead) return [];
    const { root } = this.lastRead;
    const laws = [...(root.at('laws')?.entries.values() ?? [])].map(({ name, value }) => [name, value.at('summary')?.plain ?? t('a law of this netlist'), 2]);
    const models = [...(root.at('models')?.entries.values() ?? [])].map(({ name, value }) => [name, t('a model of this netlist'), value.at('ports')?.items.length ?? 0]);
    return [...laws, ...models];
  }

  // Makes changes as one undo step.
  edit(changes) {
    if (changes.length) this.desk.editor.edit(changes);
  }

  // Whether nothing can be changed; shows the reason then.
  cannot() {
    if (this.read()) return false;
    this.desk.answer(t('Line {line} of the netlist is not TOML: mend it there first.', { line: this.fault.line }), true);
    this.desk.editor.go(this.fault.line, this.fault.column + 1);
    return true;
  }

  // Placing a new element.

  portsOf(type) {
    const known = this.catalogue.find(type);
    if (known) return known.nodes;
    const count = this.ownTypes.find(([name]) => name === type)?.[2] ?? 0;
    return Array.from({ length: count }, (_, k) => `port ${k + 1}`);
  }

  begin(type) {
    if (this.cannot()) return;
    this.desk.animation.rewind();
    this.placing = { type, ports: this.portsOf(type), nodes: [] };
    this.palette.mark(type);
    if (this.placing.ports.length) this.ask();
    else this.place();
  }

  drop(type, x, y) {
    const target = this.handles.at(x, y);
    if (!target) return;
    this.begin(type);
    if (this.placing) this.take(target.element ? { node: this.handles.nearestEnd(target.element, x, y) } : target);
  }

  cancel() {
    this.placing = null;
    this.palette.mark(null);
    this.prompt.replaceChildren(element('span', { role: 'status' }, t('Choose an element. Click what is drawn to change it, drag an end ○ to reconnect it.')));
    this.prompt.classList.remove('asks');
    this.host.classList.remove('placing');
  }

  ask() {
    const { type, ports, nodes } = this.placing;
    const which = [t('its first node'), t('its second node'), t('its third node')][nodes.length] ?? t('its node number {number}', { number: nodes.length + 1 });
    const port = ports[nodes.length];
    const where = ports.length === 1 ? t('its node') : port.length > 1 && !port.startsWith('port') ? `${which} (${port})` : which;
    const choice = (text, node) => element('button', { type: 'button', onclick: () => this.take(node ? { node } : {}) }, text);
    const isDrive = ports.length === 1;
    const offered = [...this.netlist.nodeNames, ...nodes.filter((node) => !this.netlist.nodeNames.includes(node)), ...(isDrive ? [] : ['ground'])].filter((node) => !nodes.includes(node));
    this.prompt.replaceChildren(
      element('span', { role: 'status' }, element('b', {}, type), ': ', t('click {where} in the drawing, or a free place for a new node.', { where }), ' ',
        nodes.length ? t('From {nodes} to:', { nodes: nodes.join(', ') }) : t('Or here:'), ' '),
      ...offered.map((node) => choice(node, node)), choice(t('new node')),
      element('button', { type: 'button', class: 'quiet', onclick: () => this.cancel() }, t('Cancel')));
    this.prompt.classList.add('asks');
    this.host.classList.add('placing');
  }

  take({ node }) {
    const { placing } = this;
    if (this.cannot()) return;
    const chosen = node ?? this.netlist.freshNode(placing.nodes);
    if (placing.nodes.includes(chosen)) {
      this.desk.answer(t('The ends of an element are at different nodes: choose another one than {node}.', { node: chosen }), true);
      return;
    }
    if (chosen === 'ground' && placing.ports.length === 1) {
      this.desk.answer(t('Ground never moves: nothing there needs a mass, a motion or a force. Choose another node.'), true);
      return;
    }
    placing.nodes.push(chosen);
    if (placing.nodes.length < placing.ports.length) this.ask();
    else this.place();
  }

  // The element that is placed was drawn from one node to another; an element at one node is placed where the line ends.
  span(from, to) {
    if (this.placing.ports.length > 1) this.take({ node: from });
    if (this.placing) this.take({ node: to });
  }

  place() {
    const { type, nodes } = this.placing;
    this.cancel();
    this.add(type, nodes, nodes.map((node) => this.domainAt(node)).find((each) => each !== this.domain) ?? this.domain);
  }

  // A new element of another type beside one of two nodes: between the same nodes, or behind it, with a new node between the two.
  addBeside(entry, type, domain, inSeries) {
    if (this.cannot()) return;
    const [first, second] = this.netlist.portsOf(entry).filter(({ key }) => key === 'between');
    const between = this.netlist.freshNode();
    this.add(type, [inSeries ? between : first.node, second.node], domain, inSeries ? this.netlist.wire(second.path, between) : []);
  }

  add(type, nodes, domain, changes = []) {
    const known = this.catalogue.find(type);
    const wiring = nodes.length > 1 ? [`between = [${nodes.map((node) => JSON.stringify(node)).join(', ')}]`] : nodes.map((node) => `at = ${JSON.stringify(node)}`);
    const name = this.netlist.freshName(type, nodes);
    if (known?.group === 'Signals' && known.most_inputs > 0) {
      const inputs = this.signalsFor(known);
      if (!inputs) return;
      wiring.push(`in = ${known.most_inputs > 1 ? `[${inputs.join(', ')}]` : inputs[0]}`);
    }
    const parameters = known ? this.catalogue.firstValues(known, domain) : this.firstOfOwn(type);
    this.edit([...changes, ...this.netlist.addElement(name, type, wiring, parameters), ...this.recordOf(name, nodes)]);
    this.inspector.show({ element: name }, true, false); // The next element is placed after this one.
  }

  // Default inputs of a new block.
  signalsFor({ type, least_inputs: least }) {
    const [node] = this.netlist.nodeNames;
    if (node) return Array(Math.max(1, least)).fill(JSON.stringify(`${node}.velocity`));
    this.desk.answer(t('{type} takes in a signal, the velocity of a node say: add an element with a node first.', { type: type[this.domain] }), true);
    return null;
  }

  // Parameters that a model or law of this netlist leaves without a value.
  firstOfOwn(type) {
    const list = (this.netlist.root.at('models', type) ?? this.netlist.root.at('laws', type))?.at('parameters');
    return list?.kind === 'array' ? list.items.filter(({ plain }) => plain).map(({ plain }) => [plain, '1']) : [];
  }

  // The records to add for a new element, if the netlist has a list of records.
  recordOf(name, nodes) {
    const { netlist } = this;
    const record = netlist.root.at('simulate', 'record');
    const isFirst = netlist.elementNames.length === 0;
    if (!isFirst && record?.kind !== 'array') return [];
    const path = nodes.length === 0 ? `${name}.out` : nodes.length === 1 ? `${nodes[0]}.position` : `${name}.force`;
    if (record?.items.some(({ plain }) => plain === path)) return [];
    return netlist.append(['simulate', 'record'], JSON.stringify(path));
  }

  // Choosing and connecting.

  pick(target, byKey, event) {
    if (this.placing && !this.cannot()) {
      const ends = target.element ? this.netlist.portsOf(target.element.split('.')[0]) : [];
      if (target.element) this.take({ node: event ? this.handles.nearestEnd(target.element, event.clientX, event.clientY) : ends[0]?.node });
      else this.take(target);
      return;
    }
    if (!target.element && !target.node) {
      if (this.inspector.target) this.inspector.close();
      return;
    }
    this.load().then(() => !this.cannot() && this.inspector.show(target, byKey));
  }

  connect(name, from, target) {
    if (this.cannot()) return;
    const port = this.netlist.portsOf(name).find(({ node }) => node === from);
    if (!port) {
      this.desk.answer(t('The ends of {name} are where its model, group or repetition puts them: change them in the netlist.', { name }), true);
      return;
    }
    const node = target.node ?? this.netlist.freshNode();
    if (node === from) return;
    if (this.netlist.portsOf(name).some((other) => other.node === node)) {
      this.desk.answer(t('{name} has its other end at {node} already.', { name, node }), true);
      return;
    }
    if (node === 'ground' && port.key === 'at') {
      this.desk.answer(t('Ground never moves: what acts at a node goes to another one.'), true);
      return;
    }
    this.load().then(() => {
      this.edit(this.netlist.connect(port.path, node));
      this.inspector.show({ element: name });
    });
  }

  remove(name) {
    if (this.cannot()) return;
    if (!this.netlist.element(name)) {
      this.desk.answer(t('{name} is made by a model, a group or a repetition: change that in the netlist.', { name }), true);
      return;
    }
    this.inspector.close();
    this.edit(this.netlist.removeElement(name));
    this.desk.answer(t('Deleted {name}. Undo brings it back.', { name }));
  }

  key(event) {
    if (event.key === 'Escape' && !event.target.closest?.('dialog, .cm-editor, .menu')) {
      if (this.placing) this.cancel();
      else if (this.inspector.target) this.inspector.close();
    }
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.target.closest?.('.cm-editor, input, textarea, dialog')) return;
    const key = event.key.toLowerCase();
    if (key === 'z' && !event.shiftKey) this.desk.editor.undo();
    else if (key === 'y' || (key === 'z' && event.shiftKey)) this.desk.editor.redo();
    else return;
    event.preventDefault();
  }
}
