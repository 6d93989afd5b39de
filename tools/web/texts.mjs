// The texts in the sources of the playground: those passed to t() (src/messages.js), and those that look like texts but are not passed to it.
// `NODE_PACKAGES=build/release/tools/web node tools/web/texts.mjs` prints the faults in the sources and in the files of src/messages. The test
// tests/web/messages.test.mjs fails on the same faults.
import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const source = join(dirname(fileURLToPath(import.meta.url)), 'src');
// Reports are in English; theirs are the sources that the playground does not have.
const ofReports = ['report.js', 'document.js'];

// Where a string is no text: keys of objects whose values are for the browser or for other programs, and functions that take names.
const keysOfNames = new Set(['class', 'style', 'role', 'type', 'font', 'labelFont', 'fontFamily', 'transform', 'filter', 'kind', 'task', 'mode', 'event', 'userEvent', 'Authorization', 'Content-Type',
  'd', 'viewBox', 'border', 'borderRight', 'background', 'backgroundColor', 'color', 'fontStyle', 'points', 'key', 'texts']);
const takersOfNames = new Set(['querySelector', 'querySelectorAll', 'closest', 'matches', 'matchMedia', 'addEventListener', 'removeEventListener', 'getContext', 'getPropertyValue', 'setProperty',
  'styled', 'DOMException', 'freshId', 'RegExp', 'join', 'split', 'includes', 'startsWith', 'endsWith', 'getElementById', 'encodeURIComponent', 'fold']);
// Each language by its own name, and the name of the project.
const properNames = new Set(['English', 'Deutsch', 'Español', 'Français', 'rheonet']);
// Fields of cards that are named as the keys of the netlist that they write.
const keysOfNetlists = new Set(['block', 'domain', 'in']);
const keysOfTexts = new Set(['aria-label', 'title', 'placeholder', 'label', 'alt']);
// `key === 'Escape'`.
const isComparison = ({ type, operator }) => type === 'BinaryExpression' && /^[!=]==?$|^in$/.test(operator);

const words = (text) => text.replace(/\{[^}]*\}|&[a-z]+;/g, ' ');
// Two words, or one that begins as a sentence does. Names of the browser, selectors, paths of SVG and the like are neither.
function looksLikeText(text) {
  const plain = words(text).trim();
  if (/^[<#.[]|var\(--|^[MmHhVvLl][\d{ -]|;\s*$|^\w+(-\w+)+$/.test(text) || /[{};]\s|\n\[/.test(plain)) return false;
  if (/(^|[^\w-])[A-Za-zÀ-ÿ]{2,}[,.:;!?]? +[A-Za-zÀ-ÿ]{2,}/.test(plain)) return true;
  return /^[A-Z][a-z]{2,}\W*$/.test(plain);
}

// A child of element(), a heading of table(), or an attribute that people read: a single word there is a text too.
function isShown(node, ancestors) {
  return ancestors.some((each, k) => {
    const child = ancestors[k + 1] ?? node;
    if (each.type === 'Property' && child === each.value) return keysOfTexts.has(each.key.name ?? each.key.value);
    if (each.type === 'AssignmentExpression' && child === each.right) return each.left.property?.name === 'textContent';
    if (each.type !== 'CallExpression' || !ancestors.slice(k + 1).every(({ type }) => /^(Array|Conditional|Logical|Template|Spread)/.test(type))) return false;
    return (each.callee.name === 'element' && each.arguments.indexOf(child) >= 2) || (each.callee.name === 'table' && each.arguments.includes(child));
  });
}

// The text of a string or of a template with {} for each expression; undefined for any other node.
function textOf(node) {
  if (node.type === 'Literal' && typeof node.value === 'string') return node.value;
  if (node.type === 'TemplateLiteral') return node.quasis.map((each) => each.value.cooked).join('{}');
  return undefined;
}

const nameOf = (callee) => (callee.type === 'Identifier' ? callee.name : callee.type === 'MemberExpression' ? callee.property.name : '');

// Calls visit(node, ancestors) for each node below.
function walk(node, visit, ancestors = []) {
  if (!node || typeof node.type !== 'string') return;
  if (visit(node, ancestors) === false) return;
  for (const value of Object.values(node))
    for (const child of Array.isArray(value) ? value : [value]) if (child && typeof child === 'object') walk(child, visit, [...ancestors, node]);
}

function isName(node, ancestors) {
  const parent = ancestors.at(-1);
  if (!parent) return false;
  if (/^(Import|Export)/.test(parent.type) || isComparison(parent)) return true;
  if ((parent.type === 'Property' || parent.type === 'PropertyDefinition') && parent.key === node) return true;
  return ancestors.some((each, k) => {
    const child = ancestors[k + 1] ?? node;
    if (each.type === 'Property' && child === each.value && keysOfNames.has(each.key.name ?? each.key.value)) return true;
    if (each.type === 'AssignmentExpression' && child === each.right && /^(font|className|innerHTML|transform|d)$/.test(each.left.property?.name ?? '')) return true;
    // A function that is given to addEventListener() is no name, and may have texts.
    return (each.type === 'CallExpression' || each.type === 'NewExpression') && each.arguments.includes(child) && !/Function/.test(child.type) && takersOfNames.has(nameOf(each.callee));
  });
}

// { used: Map of each text that is given to t() to its place, outside: [place and text] }.
export function textsOf(parse, names = readdirSync(source).filter((name) => name.endsWith('.js') && !ofReports.includes(name))) {
  const used = new Map();
  const outside = [];
  for (const name of names) {
    const code = readFileSync(join(source, name), 'utf8');
    walk(parse(code, { ecmaVersion: 2022, sourceType: 'module', locations: true }), (node, ancestors) => {
      const place = `${name}:${node.loc.start.line}`;
      if (node.type === 'CallExpression' && node.callee.name === 't') {
        const text = textOf(node.arguments[0]);
        if (text === undefined || node.arguments[0].type === 'TemplateLiteral') outside.push(`${place}: t() takes a string, with {names} for what is put in`);
        else used.set(text, place);
        node.arguments.slice(1).forEach((rest) => walk(rest, visitText, [...ancestors, node]));
        return false;
      }
      return visitText(node, ancestors);
      function visitText(each, above) {
        if (each !== node && each.type === 'CallExpression' && each.callee.name === 't') return;
        const text = textOf(each);
        if (text === undefined) return;
        if (properNames.has(text.trim()) || keysOfNetlists.has(text) || isName(each, above)) return;
        const isWord = /[A-Za-zÀ-ÿ]{2,}/.test(words(text)) && isShown(each, above);
        if (isWord || looksLikeText(text)) outside.push(`${name}:${each.loc.start.line}: ${text}`);
      }
    });
  }
  return { used, outside };
}

export const messages = Object.fromEntries(readdirSync(join(source, 'messages')).map((name) => [name.replace('.json', ''), JSON.parse(readFileSync(join(source, 'messages', name), 'utf8'))]));

// Faults of the translation files: missing and unused texts.
export function faultsOf({ used }, languages = messages) {
  const faults = [];
  const places = (text) => [...text.matchAll(/\{\w+\}/g)].map(([place]) => place).sort().join();
  for (const [language, translated] of Object.entries(languages)) {
    for (const [text, place] of used) {
      if (!translated[text]) faults.push(`${language}.json lacks: ${JSON.stringify(text)} (${place})`);
      else if (places(translated[text]) !== places(text)) faults.push(`${language}.json has other {names} in: ${JSON.stringify(text)}`);
    }
    for (const text of Object.keys(translated)) if (!used.has(text)) faults.push(`${language}.json has a text that is not used: ${JSON.stringify(text)}`);
  }
  return faults;
}

export const parser = () => createRequire(resolve(process.env.NODE_PACKAGES, 'package.json'))('acorn').parse;

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const found = textsOf(parser());
  const all = [...found.outside, ...faultsOf(found)];
  all.forEach((line) => console.log(line));
  process.exitCode = all.length ? 1 : 0;
}
