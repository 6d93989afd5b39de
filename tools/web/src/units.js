// Values and units as a person reads them.
import { t } from './messages.js';

const prefixes = { '-15': 'f', '-12': 'p', '-9': 'n', '-6': 'µ', '-3': 'm', 0: '', 3: 'k', 6: 'M', 9: 'G' };
const raised = { '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹', '.': '·' };

const superscript = (power) => [...String(power)].map((c) => raised[c]).join('');

export function inPrint(unit) {
  if (!unit || unit === '1') return '';
  return unit.replace(/\*/g, '·').replace(/\^\(?(-?[\d.]+)\)?/g, (_, power) => superscript(power));
}

// The decimal multiple of an SI unit in which values up to `largest` are easy to read: its name and its size.
export function shownIn(unit, largest) {
  const plain = { name: inPrint(unit), factor: 1 };
  if (!(largest > 0) || !Number.isFinite(largest) || !/^(m|N|s|J|W|rad)([*/]|$)/.test(unit)) return plain;
  if (largest >= 0.1 && largest < 1e4) return plain;
  // A value that would be printed as 1000 of a unit gets the next prefix.
  const power = Math.min(9, Math.max(-15, 3 * Math.floor(Math.log10(largest * 1.0001) / 3)));
  if (power > 0 && /^(m|s|rad)/.test(unit)) return plain;
  return { name: prefixes[power] + plain.name, factor: 10 ** power };
}

// The same of times from start to stop.
export const timeShown = (start, stop) => shownIn('s', Math.max(Math.abs(start), Math.abs(stop)));

export function number(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(digits)));
  return value.toExponential(Math.max(0, digits - 2)).replace(/(\.\d*?)0+e/, '$1e').replace('.e', 'e').replace('e+', 'e');
}

// A text in which numbers have six digits at most.
export const shortened = (text) => text.replace(/(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w.])/g, (found) => {
  const value = Number(found);
  return found.replace(/e.*|\./g, '').replace(/^0+/, '').length > 6 ? number(value, value >= 1e-3 && value < 1e5 ? 6 : 7) : found;
});

// A value among others that are `spacing` apart: as many digits as tell it from them, and no fewer than `least`.
export function spaced(value, spacing, least = 2) {
  if (!Number.isFinite(value) || !(spacing > 0)) return number(value, least);
  const size = Math.abs(value);
  const needed = size > 0 ? Math.floor(Math.log10(size)) - Math.floor(Math.log10(spacing)) + 2 : 0;
  if (needed < 1) return '0';
  const digits = Math.min(17, Math.max(least, needed));
  // A power of ten does not make many digits shorter.
  if (digits > 6 && size >= 1e5 && size < 1e12) return String(Number(value.toPrecision(digits)));
  return number(value, size >= 1e-3 && size < 1e5 ? digits : Math.max(digits + 1, 2));
}

// The numbers along an axis, `spacing` apart: all in one notation, with the same number of decimals.
export function along(values, spacing) {
  const largest = Math.max(...values.map(Math.abs), 0);
  if (!(largest > 0) || !(spacing > 0)) return values.map((value) => number(value, 2));
  const digit = Math.floor(Math.log10(spacing) + 1e-6);
  const isWhole = Math.abs(spacing / 10 ** digit - Math.round(spacing / 10 ** digit)) < 1e-6;
  const finest = isWhole ? digit : digit - 1; // 0.25 needs two decimals
  const isLong = Math.log10(largest) - finest > 6; // too many digits for a power of ten to make it shorter
  if ((largest >= 1e-2 || finest >= -3) && (largest < 1e5 || (isLong && largest < 1e12)))
    return values.map((value) => (Math.abs(value) < spacing / 2 ? '0' : value.toFixed(Math.max(0, -finest))));
  const power = Math.max(finest, Math.ceil(Math.log10(largest) - 1e-6) - 1);
  return values.map((value) => (Math.abs(value) < spacing / 2 ? '0' : `${(value / 10 ** power).toFixed(power - finest)}·10${superscript(power)}`));
}

// The same of powers of ten.
export function alongDecades(values) {
  const isPlain = values.every((value) => value >= 1e-3 && value < 1e5);
  return values.map((value) => {
    if (isPlain) return number(value, 2);
    const power = Math.floor(Math.log10(value) + 1e-9);
    const factor = number(value / 10 ** power, 2);
    return `${factor === '1' ? '' : `${factor}·`}10${superscript(power)}`;
  });
}

export function withUnit(value, unit, digits = 4) {
  const shown = shownIn(unit, Math.abs(value));
  return `${number(value / shown.factor, digits)}${shown.name ? `\u00a0${shown.name}` : ''}`; // on one line
}

export function grouped(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, ',');
}

export function largestOf(arrays) {
  let largest = 0;
  for (const array of arrays) for (const value of array) if (Math.abs(value) > largest) largest = Math.abs(value);
  return largest;
}

// The time that a run took, of its statistics; a page without a server has no clock of CPU time.
export const runTime = ({ cpu_seconds: known, cpu_time: cpu, wall_time: wall }) => (known > 0 ? t('{time} of CPU time', { time: cpu }) : wall);
