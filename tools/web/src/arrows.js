// Arrows at the ends of elements: their forces on the nodes, and the power that flows into them or out of them. Each unit has one scale.
import { roundBelow } from './motion-scale.js';

const longest = 30; // px, of all arrows but those of short peaks
const most = 60; // Arrows of larger forces are broken [px].
const peak = { times: 3, rows: 0.03 }; // A peak lasts for this part of the rows at most, and is this many times larger than the rest.
const head = 5; // px
const belowForces = 9; // Distance of the arrows of power from those of the forces [px].

// The largest magnitude in these columns, without short peaks.
function usualOf(columns) {
  const largest = new Float64Array(Math.max(0, ...columns.map(({ length }) => length)));
  for (const column of columns) column.forEach((value, i) => (largest[i] = Math.max(largest[i], Math.abs(value))));
  largest.sort();
  const [usual, all] = [largest[Math.floor((1 - peak.rows) * (largest.length - 1))] ?? 0, largest.at(-1) ?? 0];
  return usual > 0 && all > peak.times * usual ? usual : all;
}

// The ends of the elements of which forces are known: { element, node, x, y, isLeft, force, unit }. A mass has no symbol between two nodes.
function endsOf(parts, data) {
  const elements = new Map(data.scene.elements.map((element) => [element.name, element]));
  return parts.flatMap((part) => {
    const record = data.records[data.index.get(`${part.name}.force`)];
    const element = elements.get(part.name);
    if (!record || !element || part.node.classList.contains('mass')) return [];
    const end = (node, isLeft) => ({ element, node, isLeft, x: isLeft ? part.x : part.x + part.width, y: part.y + part.height / 2,
      force: data.column(record.path), unit: record.unit });
    if (!element.b) return [end(element.a, Boolean(part.left))];
    return ['left', 'right'].filter((side) => part[side] && part[side] !== 'ground').map((side) => end(part[side], side === 'left'));
  });
}

export const hasForces = (parts, data) => endsOf(parts, data).length > 0;

// An element pushes its second node forward by its force, and its first one backward. A drive pushes the only one forward.
const pushes = ({ element, node }) => (!element.b || node === element.b ? 1 : -1);

export const forcesOf = (parts, data) => endsOf(parts, data).map((end) => ({ ...end, column: end.force, sign: pushes(end) }));

// Power flows to the right where an element takes it up at its left end, or gives it off at its right end.
export function powersOf(parts, data) {
  return endsOf(parts, data).flatMap((end) => {
    const velocity = data.column(`${end.node}.velocity`);
    if (!velocity) return [];
    const given = end.force.map((force, i) => force * (velocity[i] ?? 0) * pushes(end));
    return [{ ...end, y: end.y + belowForces, column: given, sign: end.isLeft ? -1 : 1, unit: 'W' }];
  });
}

export class Arrows {
  // `arrows`: [{ node, x, y, column, sign, unit }]; `kind` names their style, and what shows them.
  constructor(svg, kind, arrows) {
    this.host = document.createElementNS('http://www.w3.org/2000/svg', 'g');
    this.host.setAttribute('class', `arrows ${kind}-arrows`);
    svg.append(this.host);
    this.kind = kind;
    this.arrows = arrows.map((arrow) => {
      const line = document.createElementNS('http://www.w3.org/2000/svg', 'path');
      this.host.append(line);
      return { ...arrow, line };
    });
    this.scales = new Map();
    for (const unit of new Set(arrows.map((arrow) => arrow.unit))) {
      const usual = usualOf(arrows.filter((arrow) => arrow.unit === unit).map(({ column }) => column));
      if (usual > 0) this.scales.set(unit, { px: longest / usual, of: roundBelow(usual) });
    }
  }

  // At row i; shiftOf(node): displacement of a node from its drawn position [px].
  show(i, shiftOf) {
    for (const { line, x, y, node, sign, column, unit } of this.arrows) {
      const full = sign * (column[Math.min(i, column.length - 1)] ?? 0) * (this.scales.get(unit)?.px ?? 0);
      const length = Math.sign(full) * Math.min(most, Math.abs(full));
      line.classList.toggle('longer', length !== full);
      const tip = Math.sign(length) * Math.min(head, Math.abs(length));
      const from = x + shiftOf(node);
      line.setAttribute('d', Math.abs(length) < 0.5 ? '' : `M${from.toFixed(2)} ${y}h${length.toFixed(2)}m${-tip} ${-head / 1.6}l${tip} ${head / 1.6}l${-tip} ${head / 1.6}`);
    }
  }

  // The lengths of the arrows: [{ px, of, unit, kind }].
  get legend() {
    return [...this.scales].map(([unit, { px, of }]) => ({ px: px * of, of, unit, kind: this.kind }));
  }
}
