// Differences of runs from the first run, for each record.
import { element, table } from './dom.js';
import { t } from './messages.js';
import { number, withUnit } from './units.js';

// The value of a column at a time, interpolated linearly between rows.
function interpolate(time, values, t) {
  let low = 0;
  let high = time.length - 1;
  if (t < time[low] || t > time[high]) return NaN;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle;
  }
  const length = time[high] - time[low];
  return length > 0 ? values[low] + ((values[high] - values[low]) * (t - time[low])) / length : values[low];
}

export function difference(first, second, path) {
  const a = first.column(path);
  const b = second.column(path);
  let largest = 0;
  let at = 0;
  let scale = 0;
  let squares = 0;
  let count = 0;
  first.time.forEach((time, k) => {
    if (first.time[k + 1] === time) return; // At a jump take the right limit, as in the other run.
    const other = interpolate(second.time, b, time);
    if (Number.isNaN(other)) return;
    const off = Math.abs(a[k] - other);
    scale = Math.max(scale, Math.abs(a[k]), Math.abs(other));
    squares += off * off;
    ++count;
    if (off > largest) [largest, at] = [off, time];
  });
  return { largest, at, scale, rms: count ? Math.sqrt(squares / count) : 0 };
}

// The record of the force of a drive that both scenes have, if their elements are others: numbers of other elements have no counterpart.
function fairRecord(first, others) {
  const elementsOf = ({ data }) => (data.scene.elements ?? []).map(({ name, type }) => `${name}:${type}`).sort().join();
  if (others.every((run) => elementsOf(run) === elementsOf(first))) return '';
  const drives = (first.data.scene.elements ?? []).filter(({ type }) => type === 'motion').map(({ name }) => `${name}.force`);
  return drives.find((path) => [first, ...others].every(({ data }) => data.records.some((record) => record.path === path))) ?? '';
}

export function differencesOf(runs) {
  const [first, ...others] = runs;
  const rows = [];
  const fair = fairRecord(first, others);
  const listed = first.data.records.filter(({ path }, k) => path === fair || k < first.data.scene.own_records);
  for (const { label, data } of others)
    for (const { path, unit } of listed) {
      if (unit !== data.records.find((record) => record.path === path)?.unit) continue;
      if (!data.column(path) || !first.data.time.length || !data.time.length) continue;
      const { largest, at, scale, rms } = difference(first.data, data, path);
      rows.push([`${first.label} – ${label}`, element('code', {}, path), withUnit(largest, unit), scale > 0 ? number(largest / scale, 3) : '0',
        largest > 0 ? `${number(at)}\u00a0s` : '–', withUnit(rms, unit)]);
    }
  if (!rows.length) return element('p', { class: 'note' }, t('The scenes record nothing under the same name and in the same unit.'));
  const shown = table([t('scenes'), t('record'), t('largest difference'), t('relative'), t('at'), t('root mean square')], rows, t('Differences'));
  return fair ? element('div', {}, element('p', { class: 'note' }, t('The scenes have different elements: {path}, the force of the drive, compares them as wholes.', { path: fair })), shown) : shown;
}
