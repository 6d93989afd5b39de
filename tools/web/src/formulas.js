// Units and formulas in running text, as a book prints them: N·s/m for N*s/m, and formulas by KaTeX.
import katex from 'katex';
import 'katex/dist/katex.min.css';
import { element, tellMore } from './dom.js';
import { t } from './messages.js';
import { inPrint } from './units.js';

const unit = '(?:[kmµMnG]?(?:N|m|s|g|J|W|Pa|Hz|K)|rad|deg|rpm|min|dyn|cm|mm|cSt|mN|rev)';
const before = '(?<=\\d[ \\u00a0]?|[[(]|\\b(?:in|of|per) )';
const units = new RegExp(`${before}${unit}(?:\\^\\d)?(?:[*/]\\(?${unit}(?:\\^-?[\\d.]+)?\\)?)+(?:\\^-?[\\d.]+)?(?![\\w^(])|(?<=\\d[ \\u00a0]?)${unit}(?:\\^\\d\\b|(?=[\\s.,;:)]|$))`, 'g');

// Replaces units in netlist notation by their printed form.
export const withUnits = (text) => String(text).replace(units, (found) => inPrint(found));

const greek = new Set(['alpha', 'beta', 'gamma', 'delta', 'epsilon', 'zeta', 'eta', 'theta', 'kappa', 'lambda', 'mu', 'nu', 'pi', 'rho', 'sigma', 'tau', 'phi', 'omega']);
const functions = new Set(['sqrt', 'exp', 'ln', 'sin', 'cos', 'tan', 'tanh', 'abs', 'sign', 'max', 'min']);
// One letter, perhaps with a subscript: a, T1, Fc.
const isSymbol = (word) => /^[A-Za-z](?:\d|[csrd])?$/.test(word) && !['a', 'I', 'is', 'as', 'or'].includes(word);
const isMath = (word) => greek.has(word) || functions.has(word) || isSymbol(word);

const tokens = /(\d+(?:\.\d+)?(?:e[+-]?\d+)?)|([A-Za-z]+\d?)|(<=|>=|[-+*/^()=<>,])|(\s+)|(.)/gsu;

// The TeX of an expression; null if the text is not an expression. Juxtaposition binds closer than division: m k/B^2 is (m k)/B^2.
export function toTex(text) {
  const words = [...text.matchAll(tokens)].filter(([, , , , blank]) => blank === undefined);
  let at = 0;
  const peek = () => words[at]?.[0];
  const fail = () => { throw new SyntaxError(text); };
  const operators = { '<=': '\\le ', '>=': '\\ge ', '=': '=', '<': '<', '>': '>' };
  const relation = () => {
    let tex = sum();
    while (peek() in operators) tex += operators[words[at++][0]] + sum();
    return tex;
  };
  const sum = () => {
    let tex = ['+', '-'].includes(peek()) ? words[at++][0] : '';
    tex += fraction();
    while (['+', '-'].includes(peek())) tex += ` ${words[at++][0]} ${fraction()}`;
    return tex;
  };
  const fraction = () => {
    let { tex } = product();
    while (peek() === '/') {
      ++at;
      tex = `\\frac{${bare(tex)}}{${bare(product().tex)}}`;
    }
    return tex;
  };
  const bare = (tex) => (/^\\left\((?:(?!\\left\(|\\right\)).)*\\right\)$/s.test(tex) ? tex.slice(6, -7) : tex);
  const product = () => {
    let tex = power();
    for (;;) {
      if (peek() === '*') ++at;
      else if (!words[at] || !(words[at][1] || words[at][2] || peek() === '(')) return { tex };
      tex += `\\,${power()}`;
    }
  };
  const power = () => {
    let tex = atom();
    while (peek() === '^') {
      ++at;
      const sign = peek() === '-' ? words[at++][0] : '';
      tex = `${tex}^{${sign}${bare(atom())}}`;
    }
    return tex;
  };
  const atom = () => {
    const word = words[at++];
    if (!word) fail();
    const [whole, digits, name] = word;
    if (digits) {
      const [mantissa, exponent] = whole.split('e');
      return exponent ? `${mantissa}\\cdot 10^{${Number(exponent)}}` : whole;
    }
    if (whole === '(') {
      const inside = relation();
      if (words[at++]?.[0] !== ')') fail();
      return `\\left(${inside}\\right)`;
    }
    if (!name || !isMath(name)) fail();
    if (functions.has(name)) {
      if (peek() !== '(') fail();
      const inside = bare(atom());
      if (name === 'sqrt') return `\\sqrt{${inside}}`;
      if (name === 'abs') return `\\left|${inside}\\right|`;
      return `${name === 'sign' ? '\\operatorname{sign}' : `\\${name}`}\\left(${inside}\\right)`;
    }
    if (greek.has(name)) return name === 'epsilon' ? '\\varepsilon ' : `\\${name} `;
    return name.length > 1 ? `${name[0]}_{${/\d/.test(name[1]) ? name[1] : `\\mathrm{${name[1]}}`}}` : name;
  };
  try {
    const tex = relation();
    return at === words.length ? tex : null;
  } catch (error) {
    if (error instanceof SyntaxError) return null;
    throw error;
  }
}

// The longest pieces of a text that are formulas: with an operator or a function, or a single Greek letter.
function pieces(text) {
  const all = [...text.matchAll(tokens)].map((match) => ({ text: match[0], number: match[1], word: match[2], sign: match[3], blank: match[4], at: match.index }));
  const belongs = ({ number, word, sign, blank }) => number !== undefined || (word !== undefined && isMath(word)) || (sign !== undefined && sign !== ',') || blank !== undefined;
  const found = [];
  for (let k = 0; k < all.length; ++k) {
    if (!belongs(all[k]) || all[k].blank || (k > 0 && /[\p{L}\d]$/u.test(all[k - 1].text) && !all[k].sign)) continue;
    let last = k;
    while (last + 1 < all.length && belongs(all[last + 1])) ++last;
    for (let end = last; end >= k; --end) {
      const part = all.slice(k, end + 1);
      const after = all[end + 1];
      if (part.at(-1).blank || (after && !after.blank && /[\p{L}\d]/u.test(after.text[0]) && !part.at(-1).sign)) continue;
      if (!isFormula(part)) continue;
      const written = text.slice(all[k].at, part.at(-1).at + part.at(-1).text.length);
      const tex = toTex(written);
      if (tex === null) continue;
      found.push({ from: all[k].at, to: all[k].at + written.length, tex });
      k = end;
      break;
    }
  }
  return found;
}

function isFormula(part) {
  const words = part.filter(({ word }) => word !== undefined);
  if (!words.length) return part.some(({ sign }) => sign === '^');
  if (part.length === 1) return greek.has(words[0].word);
  return part.some(({ sign, word }) => ['^', '/', '=', '*', '<', '>', '<=', '>=', '+'].includes(sign) || functions.has(word) || greek.has(word)) ||
    part.some(({ sign }) => sign === '-' && words.length > 1);
}

function set(tex, source) {
  const host = element('span', { class: 'formula', 'data-source': source });
  katex.render(tex, host, { throwOnError: false, output: 'htmlAndMathml' });
  return host;
}

// The law of an element type: its formulas beside each other, and below each other where there is no room.
export function lawOf(tex, type) {
  const host = element('div', { class: 'equation', tabindex: '0', role: 'group', 'aria-label': t('Law of {type}', { type }) });
  for (const part of tex.split(/,\s*\\qquad\s*/)) {
    const formula = element('div');
    katex.render(part, formula, { displayMode: true, throwOnError: false, output: 'htmlAndMathml' });
    host.append(formula);
  }
  tellMore(host);
  return host;
}

// A text as text nodes and elements, with units and formulas typeset.
export function typeset(text) {
  const parts = [];
  let last = 0;
  const add = (piece) => {
    let done = 0;
    for (const { from, to, tex } of pieces(piece)) {
      parts.push(piece.slice(done, from), set(tex, piece.slice(from, to)));
      done = to;
    }
    parts.push(piece.slice(done));
  };
  for (const match of text.matchAll(units)) {
    add(text.slice(last, match.index));
    parts.push(inPrint(match[0]));
    last = match.index + match[0].length;
  }
  add(text.slice(last));
  return parts.filter((part) => part !== '');
}
