// Animation of a run in the schematic, with play, pause, speed and a time slider.
import { Arrows, forcesOf, hasForces, powersOf } from './arrows.js';
import { element } from './dom.js';
import { EnergyBars } from './energy-bars.js';
import { Labels } from './labels.js';
import { farthestShift, MotionScale, roundBelow } from './motion-scale.js';
import { t } from './messages.js';
import { SymbolMotion } from './symbol-motion.js';
import { Turning } from './turning.js';
import { number, shownIn, timeShown, withUnit } from './units.js';

const lengths = [2, 4, 8, 16, 32, 64]; // Durations of a playback [s].
const usual = 8; // Default duration [s].
const stepwise = matchMedia('(prefers-reduced-motion: reduce)');
export const calm = () => stepwise.matches;
const step = 500; // Time between two pictures for users who prefer reduced motion [ms].
const gapOfTurning = 8; // Largest gap between the plates of a rotational stop [px].

// The toggles that show arrows, and their arrows.
const arrowsOf = { forces: forcesOf, energy: powersOf };

export class Animation {
  // onframe(time) and onmove(shiftOf) are called for each picture; shiftOf(node) is a displacement [px]. `follower`: the animation of another
  // run, which shows the same times to the same scales.
  constructor(host, { onframe = () => {}, onmove = () => {}, follower = null } = {}) {
    this.onframe = onframe;
    this.onmove = onmove;
    this.follower = follower;
    this.playing = false;
    this.place = 0; // Position in the run, 0 to 1.
    this.held = 0; // Scale of lengths that does not change while somebody pulls at the schematic [px/m].
    this.button = element('button', { type: 'button', class: 'play', 'aria-pressed': 'false', onclick: () => this.toggle() }, t('▶ Play'));
    this.scrub = element('input', { type: 'range', min: '0', max: '1000', value: '0', 'aria-label': t('Time') });
    this.scrub.addEventListener('input', () => {
      this.stop();
      this.place = Number(this.scrub.value) / 1000;
      this.draw();
    });
    this.speed = element('select', { 'aria-label': t('Speed') });
    this.clock = element('output', { class: 'clock' });
    const toggle = (name, text) => element('label', { class: 'toggle' }, element('input', { type: 'checkbox', 'data-shows': name, onchange: () => this.draw() }), ` ${text}`);
    this.toggles = { forces: toggle('forces', t('Forces')), energy: toggle('energy', t('Energy')) };
    this.legend = element('p', { class: 'motion-legend' });
    this.bars = new EnergyBars(this.energy = element('div', { class: 'energy-bars', role: 'group', 'aria-label': t('Energy'), hidden: true }));
    this.host = host;
    host.hidden = true; // Until there is a run to animate.
    host.append(this.button, this.scrub, this.clock, this.speed, ...Object.values(this.toggles), this.legend, this.energy);
  }

  shows(name) {
    return this.toggles[name].firstChild.checked && !this.toggles[name].hidden;
  }

  // Sets the drawing and its run. `beside`: a run that is shown beside it.
  attach(svg, data, beside = null) {
    const named = ({ scene }) => `${scene.file} ${scene.title}`;
    const isOther = this.data && named(this.data) !== named(data);
    this.data = data;
    this.host.hidden = !data.hasCurves;
    if (isOther) this.place = 0;
    Object.values(this.arrows ?? {}).forEach(({ host }) => host.remove());
    this.arrows = {};
    if (this.svg !== svg) this.parts = null;
    this.svg = svg;
    if (!data.hasCurves) this.rest();
    if (!svg || !data.hasCurves) return;
    this.scale = new MotionScale(data, beside?.hasCurves ? new MotionScale(beside) : null);
    if (this.held) this.scale.px = this.held;
    if (!this.parts) this.take(svg);
    this.bounds = this.boundsOf(data.scene.elements);
    this.wires.forEach(({ node, name }) => node.classList.toggle('runs', this.scale.runs(name)));
    this.bars.attach(data);
    this.toggles.forces.hidden = !hasForces(this.parts, data);
    this.toggles.energy.hidden = !this.bars.energy;
    this.showSpeeds();
    this.showLegend();
    this.draw();
  }

  take(svg) {
    const { ends } = this.data.scene;
    this.parts = [...svg.querySelectorAll('[data-element]')].map((node) =>
      Object.assign(new SymbolMotion(node, ends[node.dataset.element] ?? {}), { name: node.dataset.element, slides: node.classList.contains('slider') }));
    this.wires = [...svg.querySelectorAll('path.node')].map((node) => ({ node, name: node.dataset.node }));
    this.turning = new Turning(svg, this.parts, this.wires, (node) => node !== 'ground' && this.scale.angle(node, 0) !== null);
    this.labels = null;
  }

  // Without a run the drawing is as it was drawn.
  rest() {
    if (!this.parts) return;
    this.wires.forEach(({ node }) => node.classList.remove('runs'));
    for (const part of this.parts) {
      part.place(0, 0);
      part.node.classList.remove('sticks', 'slips');
    }
    this.pose(() => 0, () => 0);
    this.svg.closest('.drawing')?.classList.remove('moved');
  }

  // Wires, labels, handles and what turns, at their places; shiftOf(node) [px], angleOf(node) [rad].
  pose(shiftOf, angleOf) {
    for (const { node, name } of this.wires) node.style.transform = `translateX(${shiftOf(name).toFixed(2)}px)`;
    this.onmove(shiftOf);
    this.turning.show(angleOf);
    // Labels are measured when something first moves: it makes the browser lay out the page.
    if (this.labels || this.wires.some(({ name }) => shiftOf(name) !== 0)) (this.labels ??= new Labels(this.svg, this.parts, farthestShift)).place(shiftOf);
  }

  // Call when texts of the drawing have changed: they are measured again when they move.
  textsChanged() {
    this.labels?.place(() => 0);
    this.labels = null;
  }

  // The displacements at which a stop is in contact: when compressed in the drawing, and when extended.
  boundsOf(elements) {
    const bounds = new Map();
    for (const { name, a, numbers } of elements) {
      const part = this.parts.find((each) => each.name === name && each.node.classList.contains('stop'));
      if (!part?.left || !part.right) continue;
      const { lower = -Infinity, upper = Infinity } = numbers;
      // The displacement increases as the first node approaches the second one from the left.
      bounds.set(name, part.left === a ? { pressed: upper, apart: lower, sign: 1 } : { pressed: -lower, apart: -upper, sign: -1 });
    }
    return bounds;
  }

  gapsOf(name, i) {
    const bound = this.bounds.get(name);
    const column = bound && this.data.column(`${name}.displacement`);
    if (!column) return null;
    const turns = this.data.records[this.data.index.get(`${name}.displacement`)].unit === 'rad';
    const px = turns ? gapOfTurning / Math.max(...column.map(Math.abs), 1e-300) : this.scale.px;
    const pressed = bound.sign * this.scale.at(column, i);
    return [bound.pressed - pressed, pressed - bound.apart].map((gap) => Math.max(0, gap * px));
  }

  showSpeeds() {
    const { start, stop } = this.data.span;
    const chosen = Number(this.speed.value) || usual;
    const span = stop - start;
    const options = lengths.map((length) => [length, span / length]);
    if (span >= 0.5 && span <= 120 && !lengths.includes(span)) options.push([span, 1]);
    const label = ([length, rate]) => (Math.abs(rate - 1) < 1e-9 ? t('as it is ({s} s)', { s: number(length, 3) })
      : rate < 1 ? t('{factor} times slower ({s} s)', { factor: number(1 / rate, 2), s: number(length, 3) }) : t('{factor} times faster ({s} s)', { factor: number(rate, 2), s: number(length, 3) }));
    const key = String(span);
    if (this.speed.dataset.span === key) return;
    this.speed.dataset.span = key;
    this.speed.replaceChildren(...options.sort(([a], [b]) => a - b).map((option) =>
      element('option', { value: String(option[0]), selected: option[0] === chosen }, label(option))));
    if (this.speed.selectedIndex < 0) this.speed.value = String(usual);
  }

  // The scales and the meaning of the colours.
  showLegend() {
    const { scale } = this;
    const parts = [];
    const bar = (px, text, kind) => {
      const line = element('span', { class: `scale-bar ${kind}` });
      line.style.width = `${px.toFixed(1)}px`;
      return element('span', { class: 'key' }, line, text);
    };
    if (scale.px > 0) {
      const metres = roundBelow(60 / scale.px);
      const shown = shownIn('m', metres);
      parts.push(bar(metres * scale.px, `${number(metres / shown.factor, 3)} ${shown.name}`, 'length'));
    }
    if (this.turning.all.length) {
      const { turn } = scale;
      parts.push(element('span', { class: 'key', 'data-turn': String(turn) }, '⟳ ', turn === 1 ? t('angles as they are') : turn < 1 ? t('one turn drawn is {turns} turns', { turns: number(1 / turn, 3) }) : t('angles are drawn {factor} times as large', { factor: number(turn, 3) })));
    }
    if (scale.drift.size) parts.push(element('span', { class: 'key' }, element('span', { class: 'swatch running' }), t('runs on beyond the drawing')));
    if (this.parts.some(({ slides }) => slides))
      for (const [kind, text] of [['stick', t('sticks')], ['slip', t('slips')]]) parts.push(element('span', { class: 'key' }, element('span', { class: `swatch ${kind}` }), text));
    this.arrowKeys = Object.values(this.arrows).flatMap(({ legend }) => legend).map(({ px, of, unit, kind }) => ({ kind, key: bar(px, withUnit(of, unit, 3), `arrow ${kind}-arrow`) }));
    this.legend.replaceChildren(...parts, ...this.arrowKeys.map(({ key }) => key));
  }

  draw() {
    const { data, scale } = this;
    if (!this.parts || !data?.hasCurves) return;
    const { start, stop } = data.span;
    const time = start + this.place * (stop - start);
    const i = data.at(time);
    const shift = (node) => scale.shift(node, i);
    for (const { node, name } of this.wires) if (scale.runs(name)) node.style.strokeDashoffset = (-(scale.run(name, i) % 1000)).toFixed(2);
    for (const part of this.parts) this.drawPart(part, shift, i);
    this.pose(shift, (node) => scale.angle(node, i));
    this.svg.closest('.drawing')?.classList.toggle('moved', this.place > 0);
    for (const kind of Object.keys(arrowsOf)) {
      if (this.shows(kind)) this.makeArrows(kind).show(i, shift);
      if (this.arrows[kind]) this.arrows[kind].host.style.display = this.shows(kind) ? '' : 'none';
    }
    this.arrowKeys.forEach(({ kind, key }) => (key.hidden = !this.shows(kind)));
    this.energy.hidden = !this.shows('energy');
    if (!this.energy.hidden) this.bars.show(time);
    this.scrub.value = String(Math.round(this.place * 1000));
    const { name, factor } = timeShown(start, stop);
    this.clock.textContent = `${number(time / factor, 4)} ${name}`;
    this.scrub.setAttribute('aria-valuetext', this.clock.textContent);
    if (this.playing || this.place > 0) this.onframe(time);
    this.follower?.follow(this, time);
  }

  follow(leader, time) {
    if (!this.parts || !this.data.hasCurves) return;
    const { start, stop } = this.data.span;
    this.place = Math.min(1, Math.max(0, (time - start) / (stop - start)));
    for (const [name, toggle] of Object.entries(this.toggles)) toggle.firstChild.checked = leader.shows(name);
    for (const kind of Object.keys(leader.arrows)) if (this.shows(kind)) this.makeArrows(kind).scales = leader.arrows[kind].scales;
    this.draw();
  }

  // The arrows of a run take a moment, which only those who look at them should wait for.
  makeArrows(kind) {
    if (!this.arrows[kind]) {
      this.arrows[kind] = new Arrows(this.svg, kind, arrowsOf[kind](this.parts, this.data));
      this.showLegend();
    }
    return this.arrows[kind];
  }

  drawPart(part, shift, i) {
    const { left, right, name, node } = part;
    part.place(shift(left ?? right), shift(right ?? left), this.gapsOf(name, i));
    if (!part.slides) return;
    const velocity = this.data.column(`${name}.velocity`);
    const sticks = velocity && this.scale.at(velocity, i) === 0;
    node.classList.toggle('sticks', Boolean(sticks));
    node.classList.toggle('slips', Boolean(velocity) && !sticks);
  }

  toggle() {
    if (this.host.hidden) return;
    if (this.playing) this.stop();
    else this.start();
  }

  start() {
    this.playing = true;
    if (this.place >= 1) this.place = 0;
    this.button.textContent = t('❚❚ Pause');
    this.button.setAttribute('aria-pressed', 'true');
    let before = performance.now();
    const frame = (now) => {
      if (!this.playing) return;
      if (!stepwise.matches || now - before >= step) {
        this.place = (this.place + Math.max(0, now - before) / 1000 / Number(this.speed.value)) % 1;
        before = now;
        this.draw();
      }
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  // To the start, where the drawing is as it is drawn.
  rewind() {
    this.stop();
    if (this.place === 0) return;
    this.place = 0;
    this.draw();
    this.onframe(this.data.scene.start);
  }

  stop() {
    this.playing = false;
    this.button.textContent = t('▶ Play');
    this.button.setAttribute('aria-pressed', 'false');
  }
}
