// A button that opens a menu, with the usual keys of a menu.
import { element, freshId } from './dom.js';

export function menu(label, items) {
  const id = freshId('menu');
  const list = element('div', { class: 'menu-list', role: 'menu', id, hidden: true, 'aria-label': label });
  const button = element('button', { type: 'button', 'aria-haspopup': 'menu', 'aria-expanded': 'false', 'aria-controls': id }, `${label} ▾`);
  const host = element('div', { class: 'menu' }, button, list);
  const entries = () => [...list.children];
  const close = (focus) => {
    list.hidden = true;
    button.setAttribute('aria-expanded', 'false');
    if (focus) button.focus();
  };
  const open = () => {
    list.replaceChildren(...items().map(({ label: text, act }) => {
      const entry = element('button', { type: 'button', role: 'menuitem', tabindex: '-1' }, text);
      entry.addEventListener('click', () => {
        close(true);
        act();
      });
      return entry;
    }));
    list.hidden = false;
    list.style.right = '';
    const { left } = list.getBoundingClientRect();
    if (left < 4) list.style.right = `${left - 4}px`; // It stays on the screen of a phone.
    button.setAttribute('aria-expanded', 'true');
    entries()[0]?.focus();
  };
  button.addEventListener('click', () => (list.hidden ? open() : close(true)));
  host.addEventListener('keydown', (event) => {
    if (list.hidden) return;
    const all = entries();
    const at = all.indexOf(document.activeElement);
    if (event.key === 'Escape') close(true);
    else if (event.key === 'ArrowDown') all[(at + 1) % all.length].focus();
    else if (event.key === 'ArrowUp') all[(at + all.length - 1) % all.length].focus();
    else if (event.key === 'Home') all[0].focus();
    else if (event.key === 'End') all[all.length - 1].focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  host.addEventListener('focusout', (event) => !host.contains(event.relatedTarget) && close(false));
  return host;
}
