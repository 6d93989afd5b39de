// How one symbol of a schematic follows the nodes at its ends: springs stretch, pistons move in their cylinders, blocks slide on
// their rails, and the plates of a stop touch when the stop does. Coordinates move, so that lines keep their width.

const axes = { M: 'xy', L: 'xy', H: 'x', V: 'y', Q: 'xyxy', C: 'xyxyxy', A: '.....xy', Z: '' };
const near = 1; // Largest distance of two lines of a symbol that count as joined [px].
const margin = 3; // Overhang of a rail or a cylinder beyond the body in it [px].

// The parts of a path that are joined within: lists of { command, numbers }, with L in place of H and V.
function subpaths(path) {
  const parts = [];
  let x = 0;
  let y = 0;
  for (const [, letter, text] of path.matchAll(/([A-Z])([^A-Z]*)/g)) {
    let numbers = (text.match(/-?[\d.]+(?:e-?\d+)?/g) ?? []).map(Number);
    if (letter === 'H') numbers = [numbers[0], y];
    if (letter === 'V') numbers = [x, numbers[0]];
    if (numbers.length) [x, y] = numbers.slice(-2);
    if (letter === 'M') parts.push([]);
    parts.at(-1).push({ command: 'HV'.includes(letter) ? 'L' : letter, numbers });
  }
  return parts;
}

const pointsOf = (commands) => commands.filter(({ numbers }) => numbers.length).map(({ numbers }) => numbers.slice(-2));

function distance([px, py], [ax, ay], [bx, by]) {
  const length = (bx - ax) ** 2 + (by - ay) ** 2;
  const part = length > 0 ? Math.min(1, Math.max(0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length)) : 0;
  return Math.hypot(px - ax - part * (bx - ax), py - ay - part * (by - ay));
}

class Piece {
  constructor(path, commands, left, right) {
    this.path = path;
    this.commands = commands;
    this.points = pointsOf(commands);
    this.isClosed = commands.some(({ command }) => command === 'Z');
    const across = this.points.map(([x]) => x);
    this.low = Math.min(...across);
    this.high = Math.max(...across);
    this.corners = across.filter((x) => x > left + 0.6 && x < right - 0.6); // those that are not at an edge
    this.atLeft = this.low < left + 0.6;
    this.atRight = this.high > right - 0.6;
    this.side = this.atLeft && this.atRight ? 'both' : this.atLeft ? 'left' : this.atRight ? 'right' : null;
  }

  touches(point) {
    const { points } = this;
    const ring = this.isClosed ? [...points, points[0]] : points;
    return ring.some((to, k) => k > 0 && distance(point, ring[k - 1], to) < near);
  }

  isJoinedTo(other) {
    const ends = (piece) => [piece.points[0], piece.points.at(-1)];
    return ends(this).some((point) => other.touches(point)) || ends(other).some((point) => this.touches(point));
  }

  written(across) {
    return this.commands.map(({ command, numbers }) => {
      const kinds = axes[command];
      return command + numbers.map((value, k) => (kinds[k] === 'x' ? across(value) : value).toFixed(2).replace(/\.?0+$/, '')).join(' ');
    }).join('');
  }
}

// Straight between the points that are given: [[x, its place], ...] in the order of x; beyond them as far as the outermost.
function through(stops) {
  return (x) => {
    const k = stops.findIndex(([at]) => x <= at);
    if (k === 0) return x + stops[0][1] - stops[0][0];
    if (k < 0) return x + stops.at(-1)[1] - stops.at(-1)[0];
    const [[a, from], [b, to]] = [stops[k - 1], stops[k]];
    return b - a > 1e-9 ? from + ((to - from) * (x - a)) / (b - a) : to;
  };
}

// Maps of a sliding body and of its rail or cylinder. The body stays between its ends, and the rail or cylinder is extended to it. Here the
// body belongs to the left node.
function slidingMaps({ low, high, body: [b0, b1], around: [c0, c1] }, dl, dr) {
  const slid = Math.min(dl, Math.max(high + dr - margin - b1, low + dl - b0));
  return {
    inner: through([[low, low + dl], [b0, b0 + slid], [b1, b1 + slid]]),
    outer: through([[c0, Math.min(c0 + dr, b0 + slid - margin)], [c1, Math.max(c1 + dr, b1 + slid + margin)], [high, high + dr]]),
  };
}

export class SymbolMotion {
  // `bounds`: the displacements at which the symbol of a stop touches while it is pressed together, and while it is drawn apart.
  constructor(node, { left, right }, bounds = null) {
    const box = node.getBBox();
    Object.assign(this, { node, left, right, bounds, x: box.x, y: box.y, width: box.width, height: box.height });
    this.low = box.x;
    this.high = box.x + box.width;
    this.pieces = [...node.querySelectorAll('path')].flatMap((path) =>
      subpaths(path.getAttribute('d')).map((commands) => new Piece(path, commands, this.low, this.high)));
    this.paths = [...new Set(this.pieces.map(({ path }) => path))];
    if (left && right) this.join();
    this.shown = '';
  }

  // Which node each piece belongs to: that of the lead that it is joined to, or both.
  join() {
    for (;;) {
      const found = this.pieces.filter(({ side }) => side === null).map((piece) => {
        const sides = new Set(this.pieces.filter((other) => other.side && other.side !== 'both' && piece.isJoinedTo(other)).map(({ side }) => side));
        return [piece, sides.size > 1 || sides.has('middle') ? 'middle' : [...sides][0] ?? null];
      }).filter(([, side]) => side);
      if (!found.length) break;
      for (const [piece, side] of found) piece.side = side;
    }
    for (const piece of this.pieces) piece.side ??= 'middle';
    const extent = (pieces) => {
      const corners = pieces.flatMap((piece) => piece.corners);
      return corners.length ? [Math.min(...corners), Math.max(...corners)] : null;
    };
    const of = (side) => this.pieces.filter((piece) => piece.side === side);
    const bodies = ['left', 'right'].map((side) => extent(of(side).filter(({ atLeft, atRight }) => !atLeft && !atRight)));
    const rims = ['left', 'right'].map((side) => extent(of(side)));
    // The narrower part slides in or on the other one.
    const inner = !bodies[1] || (bodies[0] && rims[0][1] - bodies[0][0] <= rims[1][1] - rims[1][0]) ? 0 : 1;
    if (bodies[inner] && rims[1 - inner]) Object.assign(this, { body: bodies[inner], around: rims[1 - inner], isMirrored: inner === 1 });
    if (this.body && (this.body[1] <= this.around[0] || this.around[1] <= this.body[0])) this.body = null;
    this.middle = extent(of('middle'));
  }

  // `left` and `right`: how far the two ends are from where they are drawn; `gaps`: of a stop, how far its plates are apart [px].
  place(left, right, gaps = null) {
    const key = `${left.toFixed(2)} ${right.toFixed(2)} ${gaps ?? ''}`;
    if (key === this.shown) return;
    this.shown = key;
    const across = this.maps(left, right, gaps);
    for (const path of this.paths)
      path.setAttribute('d', this.pieces.filter((piece) => piece.path === path).map((piece) => piece.written(across(piece))).join(''));
  }

  maps(dl, dr, gaps) {
    if (!(this.left && this.right)) return () => (x) => x + (this.left ? dl : dr);
    if (gaps) return this.stopMaps(dl, dr, gaps);
    const { low, high } = this;
    const stretched = through([[low, low + dl], [high, high + dr]]);
    if (this.body) {
      const mirrored = ([from, to]) => [-to, -from];
      const map = this.isMirrored ? slidingMaps({ low: -high, high: -low, body: mirrored(this.body), around: mirrored(this.around) }, -dr, -dl) : slidingMaps(this, dl, dr);
      const inner = this.isMirrored ? 'right' : 'left';
      const across = (own) => (this.isMirrored ? (x) => -own(-x) : own);
      return ({ side }) => (side === 'both' || side === 'middle' ? stretched : across(side === inner ? map.inner : map.outer));
    }
    if (this.middle) {
      const mean = (dl + dr) / 2;
      const leads = through([[low, low + dl], [this.middle[0], this.middle[0] + mean], [this.middle[1], this.middle[1] + mean], [high, high + dr]]);
      return ({ side }) => (side === 'middle' ? (x) => x + mean : leads);
    }
    return () => stretched;
  }

  // The outer plates go with the nodes; each inner one is as far from its outer one as the stop is from touching. A stop that is only
  // pressed has two plates, and one that is only drawn apart has a single inner one.
  stopMaps(dl, dr, [pressed, apart]) {
    const plates = this.pieces.filter(({ low, high }) => high - low < 0.1).map(({ low }) => low).sort((a, b) => a - b);
    const [first, last] = [plates[0] + dl, plates.at(-1) + dr];
    const isTwoSided = Number.isFinite(pressed) && Number.isFinite(apart);
    const room = Math.max(0, isTwoSided ? (last - first) / 2 - 2 : last - first - 4);
    let inner = [first + Math.min(room, pressed), last - Math.min(room, apart)];
    if (!isTwoSided) inner = Number.isFinite(pressed) ? [inner[0], inner[0]] : [inner[1], inner[1]];
    const right = isTwoSided || Number.isFinite(apart) ? last : inner[0];
    const all = through([[this.low, this.low + dl], [plates[0], first], [plates[1], inner[0]], [plates[2], inner[1]], [plates[3], right], [this.high, this.high + dr]]);
    return () => all;
  }
}
