// Moves the schematic as the network moves: masses and rods shift, springs stretch, sliders show whether they stick.
import { element } from './dom.js';
import { Labels } from './labels.js';
import { t } from './messages.js';
import { largestOf, number, timeShown } from './units.js';

const reach = 24; // px that the largest relative motion of a usual element takes
const most = 2 * reach; // px that nothing goes beyond, however far it moves

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor((values.length - 1) / 2)];

export class Animation {
  constructor(host, { onframe }) {
    this.onframe = onframe;
    this.playing = false;
    this.place = 0; // of the run, 0 to 1
    this.button = element('button', { type: 'button', class: 'play', 'aria-pressed': 'false' }, t('▶ Animate'));
    this.button.addEventListener('click', () => this.toggle());
    this.scrub = element('input', { type: 'range', min: '0', max: '1000', value: '0', 'aria-label': t('Time') });
    this.scrub.addEventListener('input', () => {
      this.stop();
      this.place = Number(this.scrub.value) / 1000;
      this.draw();
    });
    this.speed = element('select', { 'aria-label': t('Speed') }, [2, 4, 8, 16].map((s) => element('option', { value: String(s), selected: s === 8 }, t('in {s} s', { s }))));
    this.clock = element('output', { class: 'clock' });
    this.legend = element('span', { class: 'legend', hidden: true },
      element('span', { class: 'key' }, element('span', { class: 'swatch stick' }), t('sticks')),
      element('span', { class: 'key' }, element('span', { class: 'swatch slip' }), t('slips')));
    this.host = host;
    host.hidden = true; // until there is something to move
    host.append(this.button, this.scrub, this.speed, this.clock, this.legend);
  }

  // What is to move: the drawing and its run.
  attach(svg, data) {
    this.data = data;
    this.host.hidden = !data.hasCurves;
    this.parts = svg ? [...svg.querySelectorAll('[data-element]')].map((node) => this.part(node, data.scene.ends)) : [];
    this.rods = svg ? [...svg.querySelectorAll('path.node')].map((node) => ({ node, name: node.dataset.node })) : [];
    this.labels = svg && new Labels(svg, this.parts, most);
    const { scene } = data;
    const stretched = scene.elements.filter(({ b }) => b).map(({ name }) => data.column(`${name}.displacement`)).filter(Boolean);
    const moved = stretched.length ? stretched : data.records.filter(({ channel }) => channel === 'position').map(({ path }) => data.column(path));
    const sizes = moved.map((column) => largestOf([column])).filter((size) => size > 0);
    this.scale = sizes.length ? reach / median(sizes) : 0;
    this.legend.hidden = !this.parts.some(({ slider }) => slider);
    if (this.playing || this.place > 0) this.draw();
  }

  part(node, ends) {
    const name = node.dataset.element;
    const { left, right } = ends[name] ?? {};
    const box = node.getBBox();
    const slider = node.classList.contains('slider');
    return { node, left, right, name, slider, x: box.x, width: box.width, y: box.y, height: box.height };
  }

  shift(node, i) {
    if (!node || node === 'ground') return 0;
    const column = this.data.column(`${node}.position`);
    const far = column && column.length ? column[Math.min(i, column.length - 1)] * this.scale : 0;
    return most * Math.tanh(far / most);
  }

  draw() {
    const { data } = this;
    if (!data?.time.length) return;
    const time = data.scene.start + this.place * (data.scene.stop - data.scene.start);
    const i = data.at(time);
    for (const { node, name } of this.rods) node.style.transform = `translateX(${this.shift(name, i).toFixed(2)}px)`;
    for (const part of this.parts) this.drawPart(part, i);
    this.labels?.place((node) => this.shift(node, i));
    this.scrub.value = String(Math.round(this.place * 1000));
    const { name, factor } = timeShown(data.scene.start, data.scene.stop);
    this.clock.textContent = `${number(time / factor, 4)} ${name}`;
    this.onframe(time);
  }

  drawPart({ node, left, right, name, slider, x, width }, i) {
    const dl = this.shift(left ?? right, i);
    const dr = this.shift(right ?? left, i);
    const stretch = left && right && width > 0 ? Math.max(0.2, (width + dr - dl) / width) : 1;
    node.style.transform = `translateX(${(x + dl - x * stretch).toFixed(2)}px) scaleX(${stretch.toFixed(4)})`;
    if (!slider) return;
    const velocity = this.data.column(`${name}.velocity`);
    const sticks = velocity && velocity[Math.min(i, velocity.length - 1)] === 0;
    node.classList.toggle(t('sticks'), Boolean(sticks));
    node.classList.toggle(t('slips'), Boolean(velocity) && !sticks);
  }

  toggle() {
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
      this.place = (this.place + Math.max(0, now - before) / 1000 / Number(this.speed.value)) % 1;
      before = now;
      this.draw();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  stop() {
    this.playing = false;
    this.button.textContent = t('▶ Animate');
    this.button.setAttribute('aria-pressed', 'false');
  }
}
