// The labels of an animated schematic. Each moves with the node or symbol that it names, unless it would touch another label, ground, a
// mass or a rod.

const apart = 2; // px
const passes = 12; // Each pass pushes neighbours apart, and halves the error of a label between two others.

function boxOf(node) {
  const { x, y, width, height } = node.getBBox();
  return { x, y, width, height };
}

// The owner of a label: the node that it names, or the symbol that it is in, above or below.
function ownerOf(node, box, parts) {
  if (node.getAttribute('font-style') === 'italic') return { left: node.textContent };
  const x = box.x + box.width / 2;
  const y = box.y + box.height / 2;
  let owner = {};
  let nearest = 45; // px
  for (const part of parts) {
    if (x < part.x || x > part.x + part.width) continue;
    const away = Math.max(part.y - y, y - part.y - part.height, 0);
    if (away < nearest) [nearest, owner] = [away, part];
  }
  return owner;
}

export class Labels {
  // `parts`: the symbols, with their boxes and the nodes `left` and `right`; none moves further than `most` px.
  constructor(svg, parts, most) {
    this.labels = [...svg.querySelectorAll('text')].map((node) => {
      const box = boxOf(node);
      return { node, ...box, owner: ownerOf(node, box, parts) };
    });
    const rods = [...svg.querySelectorAll('path.node')].map((node) => ({ ...boxOf(node), owner: node.dataset.node })).filter(({ width, height }) => width < 1 && height > 1);
    const masses = parts.filter(({ node }) => node.classList.contains('mass')).map(({ x, y, width, height, left, right }) => ({ x, y, width, height, owner: left ?? right }));
    const walls = [...svg.querySelectorAll('path.ground')].map((node) => ({ ...boxOf(node), owner: 'ground' }));
    this.obstacles = [...rods, ...masses, ...walls].map((box) => ({ ...box, fixed: true }));
    const row = [...this.labels, ...this.obstacles].sort((a, b) => a.x - b.x);
    this.neighbours = [];
    row.forEach((a, k) => {
      for (const b of row.slice(k + 1)) {
        const gap = b.x - a.x - a.width;
        if (gap > 2 * most) break;
        // Labels that already overlap clearly in the drawing are left alone.
        if (!(a.fixed && b.fixed) && gap >= -apart && a.y < b.y + b.height && b.y < a.y + a.height) this.neighbours.push({ a, b, room: Math.max(0, gap - apart) });
      }
    });
  }

  // shiftOf(node of the network): displacement of a node from its drawn position [px].
  place(shiftOf) {
    for (const label of this.labels) {
      const { left, right } = label.owner;
      label.shift = (shiftOf(left ?? right) + shiftOf(right ?? left)) / 2;
    }
    for (const obstacle of this.obstacles) obstacle.shift = shiftOf(obstacle.owner);
    for (let pass = 0; pass < passes; ++pass)
      for (const { a, b, room } of this.neighbours) {
        const over = a.shift - b.shift - room;
        if (over <= 0) continue;
        a.shift -= a.fixed ? 0 : b.fixed ? over : over / 2;
        b.shift += b.fixed ? 0 : a.fixed ? over : over / 2;
      }
    for (const { node, shift } of this.labels) node.style.transform = `translateX(${shift.toFixed(2)}px)`;
  }
}
