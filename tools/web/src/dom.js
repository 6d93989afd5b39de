// Creates an element: element('p', { class: 'note' }, 'text', child, ...).
export function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (key === 'class') node.className = value;
    else if (key in node && typeof value !== 'string') node[key] = value;
    else node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return node;
}
import { t } from './messages.js';

// Marks for the style sheet the sides on which a scrollable part of the page continues.
export function tellMore(host) {
  const look = () => {
    host.classList.toggle('more-left', host.scrollLeft > 1);
    host.classList.toggle('more-right', host.scrollLeft + host.clientWidth < host.scrollWidth - 1);
    host.classList.toggle('more-above', host.scrollTop > 1);
    host.classList.toggle('more-below', host.scrollTop + host.clientHeight < host.scrollHeight - 1);
  };
  host.addEventListener('scroll', look);
  const watch = new ResizeObserver(look);
  for (const part of [host, ...host.children]) watch.observe(part);
  new MutationObserver(look).observe(host, { childList: true, subtree: true });
}

export function table(headings, rows, caption) {
  const host = element(
    'div',
    { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption },
    element(
      'table',
      {},
      element('thead', {}, element('tr', {}, headings.map((text) => element('th', { scope: 'col' }, text)))),
      element('tbody', {}, rows.map((cells) => element('tr', {}, cells.map((cell) => element('td', { class: typeof cell === 'string' && cell.length < 14 ? 'short' : null }, cell))))),
    ),
  );
  tellMore(host);
  return host;
}

// A path, a name or a unit that can be broken after its dots, underscores and so on, but not within a word.
export const breakable = (name) => name.split(/(?<=[._*/·])/).flatMap((part, k) => (k ? [element('wbr'), part] : [part]));

let last = 0;
export const freshId = (word) => `${word}-${++last}`;

// A value of the style sheet in the current theme.
export const styled = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Calls `changed` when the colours change: another theme, or printing.
export function onTheme(changed) {
  matchMedia('print').addEventListener('change', changed);
  new MutationObserver(changed).observe(document.documentElement, { attributes: true, attributeFilter: ['data-theme'] });
}

// Smallest legible scale of a drawing: its smallest letters have 10 px and are legible at 9 px.
export const legible = 0.9;

const describe = (svg, scene) => svg.setAttribute('aria-label', t('Schematic of {title}', { title: scene.title || scene.file }));

// The drawing of a network in the colours of the page. With `read`, its scale is never below `legible`.
export function schematicOf(scene, { read = true } = {}) {
  const host = element('div', { class: 'schematic' });
  if (!scene.schematic) {
    host.append(element('p', { class: 'note' }, t('It is not drawn: {why}.', { why: scene.no_schematic })));
    return host;
  }
  host.innerHTML = scene.schematic
    .replace(/^<\?xml[^>]*>\s*/, '')
    .replaceAll('#111111', 'var(--ink)')
    .replaceAll('#ffffff', 'var(--paper)')
    .replaceAll('#666666', 'var(--faint)');
  const svg = host.querySelector('svg');
  describe(svg, scene);
  if (read) {
    svg.style.minWidth = `${legible * svg.getAttribute('width')}px`;
    svg.style.minHeight = `${legible * svg.getAttribute('height')}px`;
    host.tabIndex = 0;
    host.setAttribute('role', 'group');
    host.setAttribute('aria-label', t('Schematic'));
    tellMore(host);
  }
  svg.style.maxWidth = `${svg.getAttribute('width')}px`;
  svg.removeAttribute('width');
  svg.removeAttribute('height');
  return host;
}

function textsIn(root) {
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  const texts = [];
  while (walker.nextNode()) texts.push(walker.currentNode);
  return texts;
}
// Whether a text is empty stays: it has no node of its own then.
const withoutTexts = (drawing) => drawing.replace(/>[^<]+</g, '>.<');
const partsOf = ({ ends, joints, elements }) => JSON.stringify([ends, joints, elements.map(({ name, type, domain }) => [name, type, domain])]);

// Writes the texts of `scene`'s schematic into `svg`, which schematicOf made of the scene `before`. Returns false, and changes nothing, where more
// than texts differ.
export function rewriteTexts(svg, before, scene) {
  if (!svg || !before?.schematic || !scene.schematic || partsOf(before) !== partsOf(scene) || withoutTexts(before.schematic) !== withoutTexts(scene.schematic)) return false;
  describe(svg, scene);
  if (before.schematic === scene.schematic) return true;
  const texts = textsIn(new DOMParser().parseFromString(scene.schematic, 'image/svg+xml'));
  // The texts of handles and arrows, which are added to a drawing, come after its own.
  textsIn(svg).slice(0, texts.length).forEach((text, k) => {
    if (text.data !== texts[k].data) text.data = texts[k].data;
  });
  return true;
}
