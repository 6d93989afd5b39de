// The schematic of the scene that is compared with the current one, in motion beside it.
import { Animation } from './animation.js';
import { element, legible, schematicOf } from './dom.js';
import { DrawingView } from './drawing-view.js';

const small = 0.8; // Scale of schematics beside each other: letters of 8 px.
const gap = 12; // px

export class Beside {
  constructor() {
    this.host = element('div', { class: 'beside', hidden: true });
    this.view = new DrawingView(this.host);
    this.animation = new Animation(element('div'));
  }

  // The current schematic and its view, in a common host.
  join(drawing, view) {
    this.drawing = drawing;
    this.current = view;
    view.others = [this.view];
    new ResizeObserver(() => this.arrange()).observe(drawing.parentNode);
  }

  // `other`: the variant beside the current one, null: none.
  show(current, other, isFirst) {
    const scene = other?.data.scene;
    if (!scene && this.host.hidden) return;
    this.host.hidden = !scene;
    this.drawing.dataset.label = scene ? current.label : '';
    if (scene?.schematic !== this.drawn) {
      this.host.replaceChildren(...(scene ? [schematicOf(scene)] : []));
      this.view.attach();
    }
    this.drawn = scene?.schematic;
    this.arrange();
    if (!scene) return;
    this.host.dataset.label = other.label;
    this.host.style.order = isFirst ? -1 : 0;
    this.animation.attach(this.host.querySelector('svg'), other.data, current.data);
  }

  // Two schematics are side by side where their letters are large enough for that, and below each other elsewhere.
  arrange() {
    const both = this.drawing.parentNode;
    const views = this.host.hidden ? [] : [this.current, this.view].filter(({ svg }) => svg);
    const isStacked = views.some(({ size }) => (both.clientWidth - gap) / 2 < small * size.width);
    both.classList.toggle('stacked', isStacked);
    this.current.least = this.view.least = views.length && !isStacked ? small : legible;
    this.current.all((view) => view.place());
  }
}
