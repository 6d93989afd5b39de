// Zoom and position of the schematic. By default it is fitted to its place, unless its letters would be too small to read. Buttons, the
// wheel with Ctrl, and two fingers zoom; dragging the background with one finger or the mouse moves the schematic.
import { element, legible } from './dom.js';
import { t } from './messages.js';

const largest = 4; // Largest zoom.
const factor = 1.25; // Zoom factor of a button.

export class DrawingView {
  constructor(host) {
    this.host = host;
    this.zoom = null; // null: not chosen by the user.
    this.most = 1; // Largest automatic zoom.
    this.least = legible; // Smallest automatic zoom.
    this.others = []; // Views that the buttons change too.
    const button = (text, label, act) => element('button', { type: 'button', 'aria-label': /\w/.test(text) ? null : label, title: label, onclick: act }, text);
    this.controls = element('div', { class: 'zoom', role: 'group', 'aria-label': t('Size of the schematic') },
      button('−', t('Smaller'), () => this.all((view) => view.by(1 / factor))), button('+', t('Larger'), () => this.all((view) => view.by(factor))), button(t('Fit'), t('All of the schematic'), () => this.all((view) => view.fit())));
    new ResizeObserver(() => this.place()).observe(host);
    host.addEventListener('wheel', (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      this.by(Math.exp(-event.deltaY / 300), event);
    }, { passive: false });
    this.listenToMouse();
    this.listenToFingers();
  }

  all(act) {
    for (const view of [this, ...this.others]) act(view);
  }

  // Call for a new drawing.
  attach() {
    this.scroller = this.host.querySelector('.schematic');
    this.svg = this.scroller?.querySelector('svg') ?? null;
    this.controls.hidden = !this.svg;
    if (!this.svg) return;
    const [, , width, height] = this.svg.getAttribute('viewBox').split(' ').map(Number);
    this.size = { width, height };
    for (const name of ['minWidth', 'minHeight', 'maxWidth']) this.svg.style[name] = '';
    this.place();
  }

  // The zoom at which the whole drawing is visible.
  get whole() {
    const { clientWidth: width, clientHeight: height } = this.host;
    return Math.min(width / this.size.width, (height || Infinity) / this.size.height);
  }

  get shown() {
    return this.zoom ?? Math.min(this.most, Math.max(this.least, this.whole));
  }

  place() {
    if (!this.svg || !this.host.clientWidth) return;
    this.svg.style.width = `${(this.size.width * this.shown).toFixed(1)}px`;
    this.svg.style.height = `${(this.size.height * this.shown).toFixed(1)}px`;
  }

  by(times, about = null) {
    if (!this.svg) return;
    const box = this.scroller.getBoundingClientRect();
    const at = { x: about ? about.clientX - box.left : box.width / 2, y: about ? about.clientY - box.top : box.height / 2 };
    const before = this.shown;
    this.zoom = Math.min(largest, Math.max(Math.min(legible, this.whole) / 2, before * times));
    this.place();
    // Keep the point under the fingers fixed.
    const ratio = this.zoom / before;
    this.scroller.scrollLeft = (this.scroller.scrollLeft + at.x) * ratio - at.x;
    this.scroller.scrollTop = (this.scroller.scrollTop + at.y) * ratio - at.y;
  }

  fit() {
    if (!this.svg) return;
    this.zoom = Math.min(this.whole, largest);
    this.place();
  }

  listenToMouse() {
    let from = null;
    this.host.addEventListener('pointerdown', (event) => {
      const isEmpty = !event.target.closest('[data-element], .pulls, text, path.node');
      if (event.pointerType !== 'mouse' || event.button !== 0 || !isEmpty || event.defaultPrevented || !this.scroller) return;
      from = { x: event.clientX + this.scroller.scrollLeft, y: event.clientY + this.scroller.scrollTop };
    });
    addEventListener('pointermove', (event) => {
      if (!from || !(event.buttons & 1)) return;
      this.scroller.scrollLeft = from.x - event.clientX;
      this.scroller.scrollTop = from.y - event.clientY;
    });
    addEventListener('pointerup', () => (from = null));
  }

  listenToFingers() {
    let before = null;
    const spread = ([a, b]) => ({ length: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY), clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 });
    const begin = ({ touches }) => (before = touches.length === 2 ? spread(touches) : null);
    this.host.addEventListener('touchstart', begin, { passive: true });
    this.host.addEventListener('touchend', begin, { passive: true });
    this.host.addEventListener('touchmove', (event) => {
      if (event.touches.length !== 2 || !before) return;
      event.preventDefault();
      const now = spread(event.touches);
      this.by(now.length / before.length, now);
      before = now;
    }, { passive: false });
  }
}
