// The parts that a page is made of, each from the data of a scene.
import { element, table } from './dom.js';
import { lawOf, typeset, withUnits } from './formulas.js';
import { t } from './messages.js';
import { priceChart } from './prices.js';
import { TimeChart, TimeGroup } from './time-chart.js';
import { grouped, number, runTime, shortened, spaced, timeShown, withUnit } from './units.js';

// A text with typeset units and formulas; text between backticks is set as code.
export const inWords = (text) => text.split(/(`[^`]*`)/).flatMap((part, k) => (k % 2 ? [element('code', {}, part.slice(1, -1))] : typeset(part)));

// The lesson of a scene's [demo]; `folded`: observation and explanation are folded, for the reader to think first.
export function lessonOf({ demo }, folded) {
  if (!demo) return null;
  const answer = (name, text) => (folded ? element('details', {}, element('summary', {}, name), element('p', {}, inWords(text))) : element('p', {}, element('b', {}, `${name} `), inWords(text)));
  return element('div', { class: 'lesson' },
    element('p', { class: 'question' }, inWords(demo.question)),
    element('p', {}, element('b', {}, `${t('Change')} `), inWords(demo.change)),
    answer(t('See'), demo.see),
    answer(t('Why'), demo.why));
}

// The text of `rheonet explain`, with names and options set as code.
export function explanationOf({ passages, why_not: whyNot }) {
  if (whyNot) return element('p', { class: 'note bad' }, t('It cannot be simulated: {why}', { why: whyNot }));
  return element('div', { class: 'explanation' }, passages.map(({ heading, lines }) =>
    element('section', {},
      element('h4', {}, heading),
      lines.length ? element('ul', {}, lines.map(({ label, text }) => element('li', {}, label ? element('b', {}, `${label} `) : null, inWords(text.replace(/(--[a-z]+ [a-z]+)/g, '`$1`'))))) : null)));
}

export function equationsOf(scene) {
  const list = element('div', { class: 'equations' });
  for (const { type, tex, law, summary, notes, source, symbols } of scene.equations) {
    list.append(
      element('section', { class: 'law' },
        element('h4', {}, element('code', {}, type), ` – ${summary}`),
        tex ? lawOf(tex, type) : element('div', { class: 'equation' }, element('code', {}, law)),
        symbols.length ? element('p', { class: 'symbols' }, symbols.map(([symbol, name], k) => [k ? ', ' : '', element('i', {}, symbol), ` ${name.replaceAll('_', ' ')}`])) : null,
        notes ? element('p', { class: 'notes' }, inWords(notes)) : null,
        source ? element('p', { class: 'source' }, source) : null),
    );
  }
  return list;
}

export function elementsOf(scene) {
  const rows = scene.elements.map(({ name, type, place, values }) => [element('code', {}, name), type, place, withUnits(shortened(values.replace(/ {2,}/g, ', ')))]);
  const all = table([t('element'), t('type'), t('between'), t('values (SI)')], rows, t('Elements'));
  if (scene.element_count > scene.elements.length)
    all.append(element('p', { class: 'note' }, t('and {count} more', { count: grouped(scene.element_count - scene.elements.length) })));
  return all;
}

export function sourcesOf(scene) {
  return scene.sources.map(({ file, role, text }, k) =>
    element('details', { class: 'source-text', open: k === 0 },
      element('summary', {}, element('code', {}, file), role === 'scene' ? '' : ` (${role})`),
      element('pre', { tabindex: '0' }, text)));
}

export function energyOf(data, charts = []) {
  const host = element('div');
  const { time, supplied, stored, dissipated } = data.energy;
  const missing = time.map((_, k) => supplied[k] - stored[k] - dissipated[k]);
  const curve = (name, values) => ({ name, time, values });
  queueMicrotask(() => {
    charts.push(new TimeChart(host, new TimeGroup(), {
      quantity: t('energy'),
      unit: 'J',
      curves: [curve(t('supplied'), supplied), curve(t('stored'), stored), curve(t('dissipated'), dissipated), curve(t('missing'), missing)],
    }));
  });
  return host;
}

const lanes = 12;
export function eventsOf(data) {
  const { items, left_out } = data.events;
  if (!items.length) return element('p', { class: 'note' }, t('Nothing switched.'));
  const { start, stop } = data.scene;
  const names = [...new Set(items.map((item) => item[1]))];
  const shown = names.slice(0, lanes);
  const height = 22 * shown.length + 30;
  const width = 640;
  const left = 130;
  const unit = timeShown(start, stop);
  const x = (time) => left + ((time - start) / (stop - start)) * (width - left - 20);
  const kinds = [...new Set(items.map((item) => item[2]))];
  const parts = shown.map((name, lane) => {
    const y = 14 + 22 * lane;
    const ticks = items.filter((item) => item[1] === name).map(([time, , what, direction]) =>
      `<path class="event-tick" style="stroke:var(--curve-${(kinds.indexOf(what) % 7) + 1})" d="M${x(time).toFixed(2)} ${y - 8}v16"><title>${escape(`${name}: ${what}${direction ? `, direction ${direction}` : ''} at ${number(time / unit.factor, 6)} ${unit.name}`)}</title></path>`);
    return `<text x="${left - 8}" y="${y + 4}" text-anchor="end">${escape(name.length > 18 ? `${name.slice(0, 17)}…` : name)}</text><path class="lane" d="M${left} ${y}H${width - 20}"/>${ticks.join('')}`;
  });
  const axisY = 22 * shown.length + 8;
  const marks = [0, 0.25, 0.5, 0.75, 1].map((part) => {
    const time = start + part * (stop - start);
    return `<path class="lane" d="M${x(time)} ${axisY - 4}v6"/><text x="${x(time)}" y="${axisY + 16}" text-anchor="middle">${spaced(time / unit.factor, (stop - start) / 4 / unit.factor)} ${unit.name}</text>`;
  });
  const host = element('div', { class: 'events' });
  host.innerHTML = `<div class="lanes" tabindex="0" role="group" aria-label="${escape(t('Events over time'))}"><svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${escape(t('Events over time'))}">${parts.join('')}${marks.join('')}</svg></div>`;
  host.append(element('p', { class: 'loop-legend' }, kinds.map((kind, k) => {
    const swatch = element('span', { class: 'swatch' });
    swatch.style.background = `var(--curve-${(k % 7) + 1})`;
    return element('span', { class: 'key' }, swatch, `${kind} (${items.filter((item) => item[2] === kind).length})`);
  })));
  const most = 200;
  const times = items.map(([time]) => time / unit.factor);
  // The time between an event and its neighbours: its time is written to as many digits as that needs.
  const apart = (k) => Math.min(Math.abs(times[k]), ...[times[k] - times[k - 1], times[k + 1] - times[k]].filter((between) => between > 0));
  const rows = items.slice(0, most).map(([, name, what, direction], k) => [spaced(times[k], apart(k), 6), name, what, String(direction)]);
  host.append(element('details', {}, element('summary', {}, t('All {count} events', { count: grouped(items.length + left_out) })),
    table([`${t('time')} [${unit.name}]`, t('element'), t('event'), t('direction')], rows, t('Events')),
    items.length + left_out > most ? element('p', { class: 'note' }, t('and {count} more; `rheonet run --events` lists all', { count: grouped(items.length + left_out - most) })) : null));
  if (names.length > lanes) host.append(element('p', { class: 'note' }, t('{count} other elements switch too.', { count: names.length - lanes })));
  return host;
}

function escape(text) {
  return text.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
}

export function statisticsOf(data) {
  const s = data.done.statistics;
  const share = s.largest > 0 ? ` (${t('{part} of the largest energy in the run', { part: Math.abs(s.missing / s.largest).toExponential(1) })})` : '';
  const switched = s.switched.slice(0, 4).map(([name, times]) => t('{count} of {name}', { count: grouped(times), name })).join(', ');
  return table(['', ''], [
    [t('unknowns'), `${grouped(s.unknowns)}, ${s.unknowns === 0 ? t('all motion is prescribed, or held by friction') : s.sparse ? t('sparse linear algebra') : t('dense linear algebra')}`],
    [t('steps'), t('{steps}, {rejected} rejected', { steps: grouped(s.steps), rejected: grouped(s.rejected) })],
    [t('evaluations'), t('{residuals} of the residual, {jacobians} of the Jacobian', { residuals: grouped(s.residuals), jacobians: grouped(s.jacobians) })],
    [t('events'), `${grouped(s.events)}${switched ? `: ${switched}` : ''}`],
    [t('starts of the integrator'), grouped(s.starts)],
    [t('Time'), runTime(s)],
    [t('energy supplied'), withUnit(s.supplied, 'J')],
    [t('energy stored'), t('{energy} more than at the start', { energy: withUnit(s.stored, 'J') })],
    [t('energy dissipated'), withUnit(s.dissipated, 'J')],
    [t('energy missing'), `${withUnit(s.missing, 'J')}${share}`],
  ], t('Statistics'));
}

export function claimsOf(data) {
  const claims = data.done?.claims ?? [];
  if (!claims.length) return null;
  // A claim may fail in a late digit: then all digits are shown.
  const said = (text, holds) => withUnits(holds ? shortened(text) : text);
  return table([t('claim'), t('claimed'), t('found'), t('verdict')], claims.map(({ name, claimed, found, holds }) => [withUnits(name), said(claimed, holds), said(found, holds),
    element('span', { class: holds ? 'holds' : 'fails' }, holds ? t('holds') : t('fails'))]), t('Claims'));
}

export function notesOf(data) {
  const notes = [...data.mistakes.map(({ text }) => text), ...(data.done?.notes ?? [])];
  if (data.failed) notes.unshift(t('The run did not come to its end: {why}', { why: data.failed.message }));
  return notes.map((text) => element('p', { class: data.failed ? 'note bad' : 'note' }, text));
}

export function accuracyOf(data, charts = []) {
  const { certificate, prices } = data;
  if (!certificate && !prices) return null;
  const host = element('div');
  if (certificate) {
    host.append(element('pre', { class: certificate.holds ? 'verdict holds' : 'verdict fails', tabindex: '0' }, certificate.text));
    if (certificate.records.length)
      host.append(table([t('record'), t('estimated error'), t('relative'), t('at'), t('largest magnitude')],
        certificate.records.map(({ path, unit, error, relative, at, scale }) => [element('code', {}, path), withUnit(error, unit, 2),
          relative > 0 ? relative.toExponential(1) : '0', error > 0 ? `${number(at)}\u00a0s` : '–', withUnit(scale, unit)]), t('Errors')));
  }
  if (prices) {
    const plot = element('div');
    host.append(element('p', {}, t('What each accuracy costs: CPU time over the error that is made.')), plot, element('pre', { tabindex: '0' }, prices.text));
    if (prices.prices.length) queueMicrotask(() => charts.push(priceChart(plot, prices.prices, t('CPU time'), 's', ({ cpu }) => cpu)));
  }
  return host;
}
