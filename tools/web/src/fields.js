// Fields of a card: each writes one value of the netlist.
import { element, freshId } from './dom.js';
import { t } from './messages.js';
import { NetlistText, valueOf } from './netlist-text.js';
import { inWords } from './sections.js';
import { inPrint } from './units.js';

const number = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

// A value for reading: a text without its quotes, any other value as written in the netlist.
export function readable(netlist, value) {
  if (!value?.node) return '';
  return typeof value.plain === 'string' ? value.plain : netlist.source(value.node);
}

// Converts typed text to TOML. A number without a unit keeps the unit of the value before, or gets the unit of the quantity.
export function asToml(typed, before, unit) {
  const text = typed.trim();
  if (/^[[{]/.test(text)) {
    new NetlistText(`value = ${text}`); // Throws if it is not valid TOML.
    return text;
  }
  const had = /^[+-]?[\d.]+(?:e[+-]?\d+)?\s+(.+)$/i.exec(before ?? '')?.[1] ?? (before ? '' : unit);
  return number.test(text) && had ? JSON.stringify(`${text} ${had}`) : valueOf(text);
}

// onset(toml): writes it; null takes the value away, if it is `optional`. `first`: a value to begin with, as
// TOML, where there is none. `isText`: it is no quantity, whatever it looks like.
export function valueField({ label, symbol = '', description = '', value = '', placeholder = '', unit = '', optional = false, isText = false, first = '', options = [], onset }) {
  const id = freshId('field');
  const list = options.length ? element('datalist', { id: `${id}-list` }, options.map((option) => element('option', { value: option }))) : null;
  const input = element('input', { type: 'text', id, value, placeholder, spellcheck: 'false', autocomplete: 'off', list: list ? list.id : null, 'aria-describedby': `${id}-about` });
  const why = element('output', { class: 'why', hidden: true });
  const refuse = (text) => {
    input.toggleAttribute('aria-invalid', Boolean(text));
    if (text) input.setAttribute('aria-invalid', 'true');
    why.textContent = text;
    why.hidden = !text;
  };
  input.addEventListener('change', () => {
    const typed = input.value.trim();
    if (typed === value) return;
    try {
      if (!typed && !optional) refuse(t('A value is missing.'));
      else onset(typed ? (isText ? JSON.stringify(typed) : asToml(typed, input.hasAttribute('aria-invalid') ? '' : value, unit)) : null);
    } catch {
      refuse(t('The brackets do not make a value of TOML: [[0, 1], [2, 3]] or { sine = 1, frequency = 2 }, say.'));
    }
  });
  input.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || input.value === value) return;
    input.value = value;
    refuse('');
    event.stopPropagation();
  });
  const give = first && !value ? element('button', { type: 'button', class: 'give', 'aria-label': t('Give {name}', { name: label }), title: t('Give {name}', { name: first.replaceAll('"', '') }), onclick: () => onset(first) }, '+') : null;
  const row = element('div', { class: 'field' },
    element('label', { for: id }, label, symbol ? element('i', {}, ` ${symbol}`) : null), input, give,
    element('span', { class: 'about', id: `${id}-about` }, inWords(description), unit ? ` [${inPrint(unit)}]` : ''), why, list);
  // Shows a new value, but keeps text that is being typed.
  const show = (now) => {
    if (now !== value) refuse('');
    if (document.activeElement !== input || input.value === value) input.value = now;
    value = now;
  };
  return { row, input, refuse, show };
}

export function choiceField({ label, value, options, onset }) {
  const id = freshId('field');
  const known = options.some(([key]) => key === value) ? options : [[value, value], ...options];
  const select = element('select', { id, 'data-value': value }, known.map(([key, text]) => element('option', { value: key, selected: key === value }, text)));
  select.addEventListener('change', () => onset(select.value));
  return { row: element('div', { class: 'field' }, element('label', { for: id }, label), select), input: select };
}
