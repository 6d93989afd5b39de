// The scales of an animated schematic: one for all positions, and one for all angles. A group of nodes that moves further than the drawing
// allows stays in place; running dashes show its motion.
import { largestOf } from './units.js';

const room = 40; // Largest displacement of a node to either side [px].
const pressed = 20; // Largest compression of an element, at which its texts still fit [px].
const least = 3; // The common scale is used if the median motion of the elements is at least this [px].
const usual = 24; // Otherwise the scale gives the median motion this size [px].
const turnsPerSecond = 1; // Largest speed of rotation on the screen, if the run is played in `playing` seconds.
const playing = 8; // [s]

const frictions = new Set(['slider', 'sfm', 'cfm']);

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor((values.length - 1) / 2)];

// The largest 1, 2 or 5 times a power of ten that is not above a value.
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value * (1 + 1e-9)));
  return (value >= 5 * power * (1 - 1e-9) ? 5 : value >= 2 * power * (1 - 1e-9) ? 2 : 1) * power;
}

// Positions relative to the middle of their range, if they are far from 0 throughout.
function fromNearby(column) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of column) [low, high] = [Math.min(low, value), Math.max(high, value)];
  const middle = (low + high) / 2;
  return Math.abs(middle) > 2 * (high - low) ? column.map((value) => value - middle) : column;
}

export class MotionScale {
  // `other`: the scales of another run, with which this one shares its scales.
  constructor(data, other = null) {
    this.data = data;
    const positions = data.records.filter(({ channel, subject }) => channel === 'position' && subject === 'node');
    this.lengths = new Map();
    this.angles = new Map();
    for (const { owner, unit, path } of positions) {
      const column = data.column(path);
      if (column?.length) (unit === 'rad' ? this.angles : this.lengths).set(owner, unit === 'rad' ? column : fromNearby(column));
    }
    this.links = data.scene.elements.filter(({ a, b }) => b && a !== b && this.moves(a) && this.moves(b));
    this.scaleLengths();
    this.scaleAngles();
    if (other?.px > 0) this.px = Math.min(this.px || Infinity, other.px);
    if (other?.angles.size) this.turn = Math.min(this.turn, other.turn);
  }

  moves(node) {
    return node === 'ground' || this.lengths.has(node);
  }

  scaleLengths() {
    const stretches = this.links.map(({ name }) => this.data.column(`${name}.displacement`)).filter(Boolean).map((column) => largestOf([column]));
    const sizes = stretches.filter((size) => size > 0);
    const farthest = largestOf(this.lengths.values());
    this.px = 0;
    this.along = new Map(); // For each node that moves in a group: a node that represents it.
    this.drift = new Map();
    if (!(farthest > 0)) return;
    const all = Math.min(room / farthest, sizes.length ? pressed / Math.max(...sizes) : Infinity);
    const isSeen = !sizes.length || all * median(sizes) >= least;
    this.px = isSeen ? all : usual / median(sizes);
    if (!isSeen) this.follow();
    // Parts that can touch are drawn at one scale.
    if (this.links.some(({ type, a, b }) => type === 'stop' && this.drift.get(a) !== this.drift.get(b))) {
      this.px = all;
      this.drift.clear();
    }
  }

  // Groups the nodes between which no element stretches beyond `room`. A group that leaves the drawing is shown
  // relative to one of its nodes: a node with friction to something outside, which then rests while it sticks, otherwise a mass. Without either it is
  // shown relative to its mean motion.
  follow() {
    const top = (node) => {
      let at = node;
      while (this.along.has(at)) at = this.along.get(at);
      return at;
    };
    const difference = (a, b) => {
      const [first, second] = [a, b].map((node) => (node === 'ground' ? null : this.lengths.get(node)));
      const start = (first?.[0] ?? 0) - (second?.[0] ?? 0);
      return largestOf([(first ?? second).map((_, k) => (first?.[k] ?? 0) - (second?.[k] ?? 0) - start)]);
    };
    for (const { a, b } of this.links) {
      const [first, second] = [top(a), top(b)];
      if (first === second || this.px * difference(a, b) > room) continue;
      if (first === 'ground') this.along.set(second, first);
      else this.along.set(first, second);
    }
    const groups = new Map();
    for (const node of this.lengths.keys()) groups.set(top(node), [...(groups.get(top(node)) ?? []), node]);
    for (const [first, nodes] of groups) {
      const columns = nodes.map((node) => this.lengths.get(node));
      if (first === 'ground' || this.px * largestOf(columns) <= room) continue;
      const { elements } = this.data.scene;
      const rubs = (node) => elements.some(({ type, a, b }) => frictions.has(type) && b && [a, b].includes(node) && !(nodes.includes(a) && nodes.includes(b)));
      const isMass = (node) => elements.some(({ type, a }) => type === 'mass' && a === node);
      const middle = nodes.find(rubs) ?? nodes.find(isMass);
      const drift = middle ? this.lengths.get(middle) : columns[0].map((_, k) => columns.reduce((sum, column) => sum + column[k], 0) / columns.length);
      for (const node of nodes) this.drift.set(node, drift);
    }
  }

  scaleAngles() {
    this.turn = 1;
    const farthest = largestOf(this.angles.values());
    if (!(farthest > 0)) return;
    const { time } = this.data;
    let fastest = 0;
    for (const column of this.angles.values())
      for (let k = 1; k < column.length; ++k) if (time[k] > time[k - 1]) fastest = Math.max(fastest, Math.abs(column[k] - column[k - 1]) / (time[k] - time[k - 1]));
    const span = time.at(-1) - time[0];
    const turning = (fastest * span) / (2 * Math.PI * playing); // turns a second on the screen
    if (turning > turnsPerSecond) this.turn = roundBelow(turnsPerSecond / turning);
    else if (farthest < Math.PI / 4) this.turn = roundBelow(Math.PI / 2 / farthest);
  }

  at(column, i) {
    return column[Math.min(i, column.length - 1)];
  }

  // Displacement of a node from its drawn position [px].
  shift(node, i) {
    const column = this.lengths.get(node);
    if (!column) return 0;
    const drift = this.drift.get(node);
    const far = this.px * (this.at(column, i) - (drift ? this.at(drift, i) : 0));
    return Math.min(room, Math.max(-room, far));
  }

  // Subtracted motion of the group of a node [px]; 0 for a group that stays in the drawing.
  run(node, i) {
    const drift = this.drift.get(node);
    return drift ? this.px * this.at(drift, i) : 0;
  }

  runs(node) {
    return this.drift.has(node);
  }

  // Drawn angle of a node [rad]; null for a node that does not rotate.
  angle(node, i) {
    if (node === 'ground') return 0;
    const column = this.angles.get(node);
    return column ? this.turn * this.at(column, i) : null;
  }
}

export const farthestShift = room;
