// The card of the selected element or node, or of the run.
import { element } from './dom.js';
import { elementCard } from './element-card.js';
import { readable } from './fields.js';
import { t } from './messages.js';
import { nodeCard } from './node-card.js';
import { runCard } from './run-card.js';

// The structure of a card without the values of its fields. While it is unchanged, the fields are kept, and the focus with them.
function shapeOf({ heading, parts }, withSliders) {
  const html = parts.map((part) => part.outerHTML.replace(/ (id|for|list|value|aria-describedby|aria-valuetext|aria-invalid|open)="[^"]*"/g, ''));
  return [heading, ...html.map((part) => (withSliders ? part : part.replace(/<input type="range"[^>]*>/g, '')))].join('\n');
}

export class Inspector {
  constructor(drawing, host) {
    this.drawing = drawing;
    this.host = host;
    this.target = null;
    host.hidden = true;
    // The field with text that is not in the netlist yet: the card keeps its fields meanwhile.
    this.typed = null;
    host.addEventListener('input', ({ target }) => target.type === 'text' && (this.typed = target));
    for (const kind of ['change', 'focusout'])
      host.addEventListener(kind, () => {
        this.typed = null;
        if (this.isLate) this.follow();
      });
  }

  // `focus`: move the keyboard focus into the card; `scroll`: scroll it into view.
  show(target, focus = false, scroll = true) {
    this.target = target;
    this.shown = false;
    this.draw();
    this.drawing.handles.show(target);
    if (!this.target) return;
    this.host.scrollTop = 0;
    if (focus) this.host.querySelector('.inspector-close').focus({ preventScroll: true });
    if (scroll) this.host.scrollIntoView({ block: 'nearest' });
  }

  showRun() {
    if (!this.drawing.cannot()) this.drawing.load().then(() => this.show({ run: true }, true));
  }

  close() {
    const { target } = this;
    const hadFocus = this.host.contains(document.activeElement);
    this.target = null;
    this.shown = false;
    this.host.hidden = true;
    this.host.replaceChildren();
    this.drawing.handles.show(null);
    if (hadFocus && target) this.drawing.handles.focus(target);
  }

  // The text has changed, or rheonet has read it. Not before the keyboard has left a field that was changed: its next place is among
  // the fields that are there.
  follow() {
    clearTimeout(this.later);
    this.later = setTimeout(() => this.target && this.draw());
  }

  draw() {
    const { drawing } = this;
    const canRead = drawing.read();
    if (this.body) this.body.disabled = !canRead;
    if (!canRead) {
      this.tell([t('Line {line} of the netlist is not TOML: mend it there first.', { line: drawing.fault.line })]);
      return;
    }
    const isSliding = this.host.contains(document.activeElement) && document.activeElement.type === 'range';
    const next = isSliding && this.shown ? this.card : this.cardOf(drawing.netlist);
    if (!next) {
      this.close();
      return;
    }
    // Sliders exist only after rheonet has read the text.
    const isSame = next === this.card || (this.shown && shapeOf(next, drawing.isNew) === shapeOf(this.card, drawing.isNew));
    this.isLate = !isSame && this.shown && Boolean(this.typed);
    if (isSame) this.refresh();
    else if (!this.isLate) this.replace(next);
    this.tell(this.card.wrong?.(drawing.mistakes) ?? []);
  }

  refresh() {
    const { netlist } = this.drawing;
    for (const { path, field } of this.card.fields) field.show(readable(netlist, netlist.root.at(...path)));
    this.card.refresh?.();
  }

  // The text has changed at places before others.
  move(changes) {
    if (this.target) this.card?.move?.(changes);
  }

  cardOf(netlist) {
    const { target, drawing } = this;
    if (target.run) return runCard(drawing);
    if (target.node) return nodeCard(drawing, target.node);
    return elementCard(drawing, netlist, target.element);
  }

  // Where the keyboard was it stays: fields are the same ones in the same order mostly.
  replace(card) {
    const label = this.host.contains(document.activeElement) ? document.activeElement.closest('.field')?.querySelector('label')?.textContent ?? document.activeElement.className : null;
    const titleOf = ({ textContent }) => textContent.replace(/\d+/g, ''); // without the number of fields, which changes
    const open = new Set([...this.host.querySelectorAll('details[open] > summary')].map(titleOf));
    const { scrollTop } = this.host;
    this.typed = null;
    this.card = card;
    this.shown = true;
    this.wrong = element('div', { class: 'inspector-wrong', role: 'alert' });
    this.host.hidden = false;
    this.host.setAttribute('aria-label', card.heading);
    this.host.replaceChildren(
      element('div', { class: 'inspector-head' }, element('h2', {}, card.heading),
        element('button', { type: 'button', class: 'inspector-close', 'aria-label': t('Close the card'), onclick: () => this.close() }, '✕')),
      this.wrong, (this.body = element('fieldset', { class: 'inspector-body' }, card.parts)));
    for (const summary of this.host.querySelectorAll('details > summary')) if (open.has(titleOf(summary))) summary.parentElement.open = true;
    this.host.scrollTop = scrollTop;
    if (label === null) return;
    const field = [...this.host.querySelectorAll('.field')].find((each) => each.querySelector('label')?.textContent === label);
    (field?.querySelector('input, select') ?? this.host.querySelector('.inspector-close')).focus({ preventScroll: true });
  }

  tell(lines) {
    this.wrong?.replaceChildren(...lines.map((line) => element('p', { class: 'bad' }, line)));
  }
}
