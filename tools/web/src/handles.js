// Handles in the schematic: elements, nodes, and the ends of elements, which can be dragged to other nodes.
import { t } from './messages.js';

const namespace = 'http://www.w3.org/2000/svg';

function shape(tag, attributes) {
  const node = document.createElementNS(namespace, tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  return node;
}

export class Handles {
  // onpick(target): something was clicked, or chosen with Enter; onconnect(element, from, target): the end of an element that was at
  // the node `from` was dropped on a target; onremove(element): the Delete key. A target is { element }, { node }, or {} for a free
  // place. pullOf(element): what happens while an element is dragged, { move(px), end() }, or null. isPlacing(): a new element is being
  // placed; onspan(from, to): it was drawn from one node to another, undefined for a new node.
  constructor(host, { onpick, onconnect, onremove, pullOf, isPlacing, onspan }) {
    this.host = host;
    this.onpick = onpick;
    this.onconnect = onconnect;
    this.onremove = onremove;
    this.pullOf = pullOf;
    this.isPlacing = isPlacing;
    this.onspan = onspan;
    this.place = 0; // which handle the Tab key reaches
    this.buttons = [];
    this.moving = []; // the handles, with the nodes that their sides go with
    // In the capture phase, before the handler that moves the whole drawing.
    host.addEventListener('pointerdown', (event) => this.down(event), true);
    host.addEventListener('click', (event) => this.click(event));
  }

  // `ground`: show ground even if no element is connected to it.
  attach(svg, scene, ground = false) {
    this.svg = svg;
    svg.querySelector('.handles')?.remove();
    let { joints } = scene;
    if (ground && !svg.querySelector('path.ground')) joints = [...joints, this.addGround(svg)];
    else if (ground && svg.querySelector('.added-ground')) joints = [...joints, this.ground];
    else this.removeGround(svg);
    // The role of an image would hide its parts from screen readers.
    svg.setAttribute('role', 'group');
    const layer = shape('g', { class: 'handles' });
    const walls = [...svg.querySelectorAll('path.ground')].map((path) => ({ path, node: 'ground' }));
    const wires = [...svg.querySelectorAll('path.node')].map((path) => ({ path, node: path.dataset.node }));
    for (const { path, node } of [...walls, ...wires]) layer.append(shape('path', { class: 'wire-handle', d: path.getAttribute('d'), 'data-at': node }));
    for (const part of svg.querySelectorAll('[data-element]')) layer.append(this.overElement(part, scene));
    const seen = new Set();
    for (const { element, node, x, y } of joints) {
      const [cx, cy] = this.besideLabel(svg, element, x, y);
      const handle = shape('circle', { class: 'end-handle', cx, cy, r: 4.5, 'data-at': node, 'data-end-of': element });
      if (seen.has(node)) handle.setAttribute('aria-hidden', 'true');
      else this.makeButton(handle, node === 'ground' ? 'ground' : t('node {node}', { node }));
      seen.add(node);
      layer.append(handle);
    }
    this.line = shape('path', { class: 'drag-line', visibility: 'hidden' });
    layer.append(this.line);
    svg.append(layer);
    this.buttons = [...layer.querySelectorAll('[role=button]')];
    this.moving = [...layer.querySelectorAll('[data-of], [data-at]')].map((handle) => {
      const { of, at } = handle.dataset;
      const { left, right } = of ? scene.ends[of] ?? {} : { left: at, right: at };
      return { handle, left: left ?? right, right: right ?? left, width: of ? Number(handle.getAttribute('width')) : 0, low: 0, high: 0 };
    });
    this.rove(Math.min(this.place, this.buttons.length - 1));
    layer.addEventListener('keydown', (event) => this.key(event));
    layer.addEventListener('focusin', (event) => this.rove(this.buttons.indexOf(event.target)));
  }

  // Moves the handles with the drawing; shiftOf(node): how far a node is from where it is drawn [px].
  follow(shiftOf) {
    for (const moving of this.moving) {
      const { handle, left, right, width } = moving;
      const [low, high] = [shiftOf(left), shiftOf(right)];
      if (low === moving.low && high === moving.high) continue;
      Object.assign(moving, { low, high });
      handle.style.transform = `translateX(${low.toFixed(2)}px)`;
      if (width) handle.setAttribute('width', Math.max(0, width + high - low).toFixed(2));
    }
  }

  // Adds ground beside the drawing, which is widened for it.
  addGround(svg) {
    const { width, height } = svg.viewBox.baseVal;
    svg.dataset.before = svg.getAttribute('viewBox');
    const [room, y] = [46, height / 2];
    svg.setAttribute('viewBox', `0 0 ${width + room} ${height}`);
    for (const side of ['minWidth', 'maxWidth']) if (svg.style[side]) svg.style[side] = `${(Number.parseFloat(svg.style[side]) * (width + room)) / width}px`;
    const x = width + room - 24;
    const group = shape('g', { class: 'added-ground', fill: 'none', stroke: 'currentColor', 'stroke-width': 1 });
    group.append(shape('path', { class: 'ground', d: `M${x} ${y - 16}V${y + 16}`, 'stroke-width': 2.2 }), shape('path', { d: [-12, -6, 0, 6, 12].map((k) => `M${x} ${y + k}l7 5`).join('') }));
    svg.append(group);
    this.ground = { element: '', node: 'ground', x, y };
    return this.ground;
  }

  removeGround(svg) {
    svg.querySelector('.added-ground')?.remove();
    if (svg.dataset.before) svg.setAttribute('viewBox', svg.dataset.before);
    delete svg.dataset.before;
  }

  overElement(part, scene) {
    const { x, y, width, height } = part.getBBox();
    const of = part.dataset.element;
    const room = Math.max(0, 10 - height / 2); // a thin symbol can be hit too
    const type = part.getAttribute('class').split(' ')[0];
    const rect = shape('rect', { class: `element-handle${['mass', 'force', 'motion'].includes(type) ? ' pulls' : ''}`, x, y: y - room, width, height: height + 2 * room, rx: 4, 'data-of': of });
    this.makeButton(rect, `${of}, ${scene.elements.find((each) => each.name === of)?.type ?? type}`);
    const title = shape('title', {});
    title.textContent = part.querySelector('title')?.textContent ?? of;
    rect.append(title);
    return rect;
  }

  // A place beside the middle of a mass, where its name is.
  besideLabel(svg, element, x, y) {
    const box = svg.querySelector(`[data-element="${CSS.escape(element)}"]`)?.getBBox();
    const isInside = box && x > box.x + 1 && x < box.x + box.width - 1 && y > box.y + 1 && y < box.y + box.height - 1;
    return isInside ? [x, box.y + box.height] : [x, y];
  }

  makeButton(handle, label) {
    handle.setAttribute('role', 'button');
    handle.setAttribute('aria-label', label);
    handle.setAttribute('tabindex', '-1');
  }

  // Roving focus: Tab reaches one handle, the arrow keys reach the others.
  rove(k) {
    if (k < 0) return;
    this.place = k;
    this.buttons.forEach((button, i) => button.setAttribute('tabindex', i === k ? '0' : '-1'));
  }

  key(event) {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (step) this.buttons[(this.place + step + this.buttons.length) % this.buttons.length].focus();
    else if (event.key === 'Enter' || event.key === ' ') this.onpick(this.targetOf(event.target), true);
    else if (event.key === 'Delete' && event.target.dataset.of) this.onremove(event.target.dataset.of);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  targetOf(node) {
    const handle = node?.closest?.('[data-at], [data-of]');
    if (handle?.dataset.of) return { element: handle.dataset.of };
    const part = node?.closest?.('[data-element]');
    if (part) return { element: part.dataset.element };
    return handle ? { node: handle.dataset.at } : {};
  }

  // The target at a place of the window; null outside the drawing.
  at(x, y) {
    const node = document.elementFromPoint(x, y);
    return node && this.host.contains(node) ? this.targetOf(node) : null;
  }

  // The node at the end of an element that is nearest to a place of the window.
  nearestEnd(element, x, y) {
    const away = (handle) => {
      const box = handle.getBoundingClientRect();
      return Math.hypot(box.x + box.width / 2 - x, box.y + box.height / 2 - y);
    };
    const ends = [...this.svg.querySelectorAll('.end-handle')].filter((handle) => handle.dataset.endOf === element);
    return ends.sort((a, b) => away(a) - away(b))[0]?.dataset.at;
  }

  show(target) {
    for (const handle of this.svg?.querySelectorAll('[data-at], [data-of]') ?? [])
      handle.classList.toggle('chosen', Boolean((target?.element && handle.dataset.of === target.element) || (target?.node && handle.dataset.at === target.node)));
  }

  focus(target) {
    this.buttons.find(({ dataset }) => (target.element ? dataset.of === target.element : dataset.at === target.node))?.focus();
  }

  click(event) {
    if (this.dragged) this.dragged = false;
    else this.onpick(this.targetOf(event.target), false, event);
  }

  down(event) {
    const end = event.target.closest('.end-handle');
    const part = event.target.closest('.pulls, .mass, .force, .motion');
    if (event.button !== 0) return;
    if (end || this.isPlacing()) event.preventDefault(); // The drawing stays in place.
    if (this.isPlacing()) this.drag(event, this.spanning(event.clientX, event.clientY));
    else if (end) this.drag(event, this.reconnecting(end));
    else if (part) this.drag(event, this.pulling(this.pullOf(part.dataset.of ?? part.dataset.element), event.clientX));
  }

  pulling(pull, from) {
    return pull && { move: (x) => pull.move(x - from), finish: (isDragged) => isDragged && pull.end() };
  }

  // The node at a place of the window: that of an element is its nearer end. { } for a free place, null outside the drawing.
  nodeAt(x, y) {
    const target = this.at(x, y);
    return target?.element ? { node: this.nearestEnd(target.element, x, y) } : target;
  }

  // A line from a place of the drawing to the mouse; ondrop(target) where it ends.
  stretching(from, ondrop) {
    const { svg, line } = this;
    const inDrawing = (x, y) => new DOMPoint(x, y).matrixTransform(svg.getScreenCTM().inverse());
    const begin = from(inDrawing);
    return {
      move(clientX, clientY) {
        const { x, y } = inDrawing(clientX, clientY);
        line?.setAttribute('d', `M${begin.x} ${begin.y}L${x} ${y}`);
        line?.setAttribute('visibility', 'visible');
      },
      finish: (isDragged, { type, clientX, clientY }) => {
        line?.setAttribute('visibility', 'hidden');
        const target = isDragged && type === 'pointerup' ? this.nodeAt(clientX, clientY) : null;
        if (target) ondrop(target);
      },
    };
  }

  reconnecting(end) {
    return this.stretching(() => ({ x: end.getAttribute('cx'), y: end.getAttribute('cy') }), (target) => this.onconnect(end.dataset.endOf, end.dataset.at, target));
  }

  spanning(x, y) {
    const from = this.nodeAt(x, y) ?? {};
    return this.svg?.isConnected ? this.stretching((inDrawing) => inDrawing(x, y), (to) => this.onspan(from.node, to.node)) : null;
  }

  drag(event, act) {
    if (!act) return;
    const begin = { x: event.clientX, y: event.clientY };
    const move = ({ clientX, clientY }) => {
      if (!this.dragged && Math.hypot(clientX - begin.x, clientY - begin.y) < 6) return;
      this.dragged = true;
      act.move(clientX, clientY);
    };
    const finish = (last) => {
      for (const kind of ['pointermove', 'pointerup', 'pointercancel']) removeEventListener(kind, kind === 'pointermove' ? move : finish);
      const isDragged = this.dragged;
      // The click that follows at the same place is none; there is not always one.
      if (isDragged) setTimeout(() => (this.dragged = false));
      act.finish(isDragged, last);
    };
    addEventListener('pointermove', move);
    addEventListener('pointerup', finish);
    addEventListener('pointercancel', finish);
  }
}
