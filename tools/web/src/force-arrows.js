// The forces of a run as arrows at the nodes on which they act, with one scale for forces and one for torques.
import { largestOf } from './units.js';
import { roundBelow } from './motion-scale.js';

const longest = 30; // px
const head = 5; // px

export class ForceArrows {
  constructor(svg, parts, data) {
    this.host = document.createElementNS('http://www.w3.org/2000/svg', 'g');
    this.host.setAttribute('class', 'force-arrows');
    svg.append(this.host);
    const elements = new Map(data.scene.elements.map((element) => [element.name, element]));
    this.arrows = parts.flatMap((part) => this.arrowsOf(part, elements.get(part.name), data));
    this.scales = new Map();
    for (const unit of new Set(this.arrows.map((arrow) => arrow.unit))) {
      const most = largestOf(this.arrows.filter((arrow) => arrow.unit === unit).map(({ column }) => column));
      if (most > 0) this.scales.set(unit, { px: longest / most, of: roundBelow(most) });
    }
  }

  // An element pushes its second node forward by its force, and its first one backward.
  arrowsOf(part, element, data) {
    const record = data.records[data.index.get(`${part.name}.force`)];
    if (!record || !element || part.node.classList.contains('mass')) return [];
    const column = data.column(record.path);
    const arrow = (x, node, sign) => {
      const line = document.createElementNS('http://www.w3.org/2000/svg', 'path');
      this.host.append(line);
      return { line, x, y: part.y + part.height / 2, node, sign, column, unit: record.unit };
    };
    const [low, high] = [part.x, part.x + part.width];
    if (!element.b) return [arrow(part.left ? low : high, element.a, 1)];
    return [['left', low], ['right', high]].filter(([side]) => part[side] && part[side] !== 'ground')
      .map(([side, x]) => arrow(x, part[side], part[side] === element.b ? 1 : -1));
  }

  // shiftOf(node): displacement of a node from its drawn position [px].
  show(i, shiftOf) {
    for (const { line, x, y, node, sign, column, unit } of this.arrows) {
      const length = sign * (column[Math.min(i, column.length - 1)] ?? 0) * (this.scales.get(unit)?.px ?? 0);
      const tip = Math.sign(length) * Math.min(head, Math.abs(length));
      const from = x + shiftOf(node);
      line.setAttribute('d', Math.abs(length) < 0.5 ? '' : `M${from.toFixed(2)} ${y}h${length.toFixed(2)}m${-tip} ${-head / 1.6}l${tip} ${head / 1.6}l${-tip} ${head / 1.6}`);
    }
  }

  // The lengths of the arrows: [{ px, of, unit }].
  get legend() {
    return [...this.scales].map(([unit, { px, of }]) => ({ px: px * of, of, unit }));
  }
}
