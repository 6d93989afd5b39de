// The element types with their symbols, to choose from or to drag into the schematic.
import { groupNames } from './catalogue.js';
import { element } from './dom.js';
import { t } from './messages.js';

// The words whose first letters are the type, as "solid friction model" of sfm, if the text about it begins with them; else null.
function meaningOf(type, about) {
  const name = about.split(':')[0];
  return type.length > 1 && name.split(' ').map((word) => word[0]).join('') === type ? name : null;
}

export class Palette {
  // onchoose(type): clicked; ondrop(type, x, y): let go at a place of the window.
  constructor(host, { onchoose, ondrop }) {
    this.host = host;
    this.onchoose = onchoose;
    this.ondrop = ondrop;
    this.ghost = element('div', { class: 'ghost', hidden: true, 'aria-hidden': 'true' });
    document.body.append(this.ghost);
  }

  // `own`: types that the netlist itself defines, as [name, what they are].
  show(catalogue, domain, own) {
    const shape = JSON.stringify([domain, own]);
    if (shape === this.shape) return;
    this.shape = shape;
    const names = groupNames();
    const isOpen = (group) => group !== 'Transmissions' && group !== 'Signals';
    const groups = [...catalogue.groups].map(([group, types]) => [names[group] ?? group, isOpen(group), types.map((type) => this.button(type.type[domain], type.symbol[domain], type.summary))]);
    if (own.length) groups.push([t('Of this netlist'), true, own.map(([name, about]) => this.button(name, '', about))]);
    this.host.replaceChildren(...groups.map(([name, open, buttons]) =>
      element('details', { class: 'palette-group', open: open && buttons.length < 12 },
        element('summary', {}, name), element('div', { class: 'palette-types' }, buttons))));
  }

  button(type, symbol, about) {
    const picture = element('span', { class: 'symbol' });
    picture.innerHTML = symbol;
    const meaning = meaningOf(type, about);
    const button = element('button', { type: 'button', class: 'palette-type', title: about, 'data-type': type }, picture, type,
      meaning ? element('span', { class: 'palette-meaning' }, meaning) : null);
    button.addEventListener('click', () => {
      if (!this.dragged) this.onchoose(type);
      this.dragged = false;
    });
    button.addEventListener('pointerdown', (event) => event.pointerType === 'mouse' && event.button === 0 && this.drag(event, type, symbol));
    return button;
  }

  mark(type) {
    for (const button of this.host.querySelectorAll('.palette-type')) button.setAttribute('aria-pressed', String(button.dataset.type === type));
  }

  drag(begin, type, symbol) {
    begin.preventDefault(); // Do not select text while dragging.
    begin.target.closest('button').focus();
    const move = ({ clientX, clientY }) => {
      if (!this.dragged && Math.hypot(clientX - begin.clientX, clientY - begin.clientY) < 6) return;
      if (!this.dragged) this.ghost.innerHTML = symbol;
      this.dragged = true;
      this.ghost.hidden = false;
      Object.assign(this.ghost.style, { left: `${clientX}px`, top: `${clientY}px` });
    };
    const finish = ({ clientX, clientY }) => {
      removeEventListener('pointermove', move);
      this.ghost.hidden = true;
      if (!this.dragged) return;
      setTimeout(() => (this.dragged = false)); // Ignore the click that may follow.
      this.ondrop(type, clientX, clientY);
    };
    addEventListener('pointermove', move);
    addEventListener('pointerup', finish, { once: true });
  }
}
