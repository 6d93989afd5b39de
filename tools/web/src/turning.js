// Rotation in a schematic: marks run around the rotors, gears have spokes, and other shafts have a dial.

const vector = 'http://www.w3.org/2000/svg';
const marks = 3; // Number of marks on a rotor.
const dial = 5.5; // px, radius

function drawn(host, name, attributes) {
  const node = document.createElementNS(vector, name);
  for (const [key, value] of Object.entries({ class: 'turns', ...attributes })) node.setAttribute(key, value);
  host.append(node);
  return node;
}

// A cylinder seen from its side: each mark goes down its front, and comes up behind it, where nobody sees it.
class Rotor {
  constructor({ node, x, y, width, height }) {
    this.place = { x, width, middle: y + height / 2, radius: height / 2 - 1 };
    this.lines = Array.from({ length: marks }, () => drawn(node, 'path', { 'stroke-width': '2' }));
  }

  show(angle) {
    const { x, width, middle, radius } = this.place;
    const length = Math.min(12, width / 4);
    this.lines.forEach((line, k) => {
      const at = angle + (2 * Math.PI * k) / marks;
      const y = (middle + radius * Math.sin(at)).toFixed(2);
      line.setAttribute('d', `M${x + 1} ${y}h${length}M${x + width - 1} ${y}h${-length}`);
      line.style.visibility = Math.cos(at) > 0 ? '' : 'hidden';
    });
  }
}

// A circle seen from the front, with a hand.
class Dial {
  constructor(host, { x, y, radius, hasRim }) {
    this.place = { x, y, radius };
    if (hasRim) drawn(host, 'circle', { class: 'turns rim', cx: x, cy: y, r: radius });
    this.hand = drawn(host, 'path', { 'stroke-width': '1.6' });
  }

  show(angle) {
    const { x, y, radius } = this.place;
    this.hand.setAttribute('d', `M${x} ${y}l${(radius * Math.cos(angle)).toFixed(2)} ${(radius * Math.sin(angle)).toFixed(2)}`);
  }
}

// The circles of a symbol: an outline that begins as an arc from the leftmost point does.
function circlesOf(node) {
  return [...node.querySelectorAll('path[fill="#ffffff"], path[fill^="var(--paper"]')].flatMap((path) =>
    [...path.getAttribute('d').matchAll(/M([\d.]+) ([\d.]+)A([\d.]+) [\d.]+ 0 1 [01] ([\d.]+) ([\d.]+)A/g)].map(([, x1, y1, r, x2, y2]) => ({
      x: (Number(x1) + Number(x2)) / 2, y: (Number(y1) + Number(y2)) / 2, radius: Number(r) })));
}

export class Turning {
  // `parts`: the symbols and their ends; `wires`: the straight pieces of the nodes; `turns(node)`: whether the node does.
  constructor(svg, parts, wires, turns) {
    this.all = [];
    this.svg = svg;
    this.shown = new Set();
    for (const part of parts) this.add(part, turns);
    for (const node of new Set(wires.map(({ name }) => name)))
      if (node !== 'ground' && turns(node) && !this.shown.has(node)) this.addDial(wires.filter(({ name }) => name === node), parts);
  }

  add(part, turns) {
    const { node, left, right } = part;
    const own = left && right ? null : left ?? right;
    if (node.classList.contains('mass') && turns(own)) {
      this.all.push({ name: own, drawing: new Rotor(part) });
      this.shown.add(own);
      return;
    }
    // Two wheels are those of the two nodes; a single one beside a part that goes straight is that of the node that turns.
    const circles = circlesOf(node);
    const names = circles.length === 2 ? [left, right] : circles.length === 1 && turns(left) !== turns(right) ? [turns(left) ? left : right] : [];
    if (circles.length === 2 && Math.abs(circles[0].x - circles[1].x) < circles[0].radius) return;
    names.forEach((name, k) => {
      if (!name || !turns(name)) return;
      this.all.push({ name, drawing: new Dial(node, circles[k]) });
      this.shown.add(name);
    });
  }

  // In the middle of the longest free piece of the shaft.
  addDial(wires, parts) {
    const free = wires.flatMap(({ node, name }) => {
      const { x, y, width, height } = node.getBBox();
      if (height > 0.5) return [];
      let pieces = [[x, x + width]];
      for (const part of parts) {
        if (y < part.y - 1 || y > part.y + part.height + 1) continue;
        pieces = pieces.flatMap(([a, b]) => [[a, Math.min(b, part.x)], [Math.max(a, part.x + part.width), b]].filter(([low, high]) => high > low));
      }
      return pieces.map(([a, b]) => ({ name, x: (a + b) / 2, y, length: b - a }));
    });
    const best = free.sort((a, b) => b.length - a.length)[0];
    if (!best || best.length < 2 * dial + 1) return;
    this.all.push({ name: best.name, drawing: new Dial(wires[0].node.parentNode, { ...best, radius: dial, hasRim: true }) });
  }

  show(angleOf) {
    for (const { name, drawing } of this.all) drawing.show(angleOf(name));
  }
}
