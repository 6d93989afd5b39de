// Contribution of each physical effect: the scene without it, compared with the full model.
import { breakable, element, table } from './dom.js';
import { t } from './messages.js';
import { TimeChart, TimeGroup } from './time-chart.js';
import { grouped, number, withUnit } from './units.js';

const names = {
  inertia: t('inertia'),
  elasticity: t('elasticity'),
  viscosity: t('viscosity'),
  dry_friction: t('dry friction'),
  contact: t('contact'),
  delay: t('delay'),
  feedback: t('feedback'),
};
const inWords = (effects) => effects.map((effect) => names[effect] ?? effect).join(', ');

// Changes below the accuracy of the runs are shown as an upper bound.
const percent = (part, accuracy) => (part < accuracy ? `< ${number(100 * accuracy, 1)} %` : `${number(100 * part, 2)} %`);

function verdict({ effects, barest, steps, within, accuracy, full }) {
  const share = `${number(100 * within, 2)} %`;
  if (!barest) return t('To {share} this scene needs all that it has: {effects}.', { share, effects: inWords(effects) });
  const needed = effects.filter((effect) => !barest.includes(effect));
  const model = steps.find(({ without }) => without.length === barest.length);
  return `${needed.length ? t('To {share} this scene needs {effects}.', { share, effects: inWords(needed) }) : t('To {share} this scene needs none of its effects.', { share })} ${
    t('Without {effects} every record stays within {off} of the full model, with {steps} steps instead of {all}.', {
      effects: inWords(barest), off: percent(Math.max(model.worst?.relative ?? 0, accuracy), accuracy), steps: grouped(model.steps), all: grouped(full.steps) })}`;
}

// Models without some effects, with their CPU time if it can be measured.
function modelsOf(models, { full, accuracy }, nameOf, caption) {
  const isTimed = full.cpu > 0;
  const row = (name, { failure, worst, steps, cpu }) => [name,
    ...(failure ? [element('span', { class: 'bad' }, t('cannot be simulated')), '–', '–', '–'] : worst
      ? [percent(worst.relative, accuracy), withUnit(worst.largest, worst.unit, 3), element('code', {}, breakable(worst.path)), withUnit(worst.at, 's', 3)]
      : ['–', '–', '–', '–']),
    failure ? '–' : grouped(steps), ...(isTimed ? [failure ? '–' : withUnit(cpu, 's', 3)] : [])];
  return [
    table([t('without'), t('largest difference'), t('in SI'), t('record'), t('at'), t('steps'), ...(isTimed ? [t('CPU time')] : [])],
      [row(t('nothing (the full model)'), { ...full, worst: null }), ...models.map((model) => row(nameOf(model), model))], caption),
    ...models.filter(({ failure }) => failure).map(({ without, failure }) =>
      element('p', { class: 'note' }, t('Without {effects}: {failure}', { effects: inWords(without), failure }))),
  ];
}

const most = 20;

// The change of each record by each effect, in descending order of the largest change.
function recordsOf({ each, records, accuracy }) {
  const possible = each.filter(({ failure }) => !failure);
  if (!possible.length) return null;
  const order = records.map((_, k) => k).sort((a, b) => Math.max(...possible.map(({ relative }) => relative[b])) - Math.max(...possible.map(({ relative }) => relative[a])));
  return [
    element('h4', {}, t('What each effect changes in each record')),
    table([t('record'), ...possible.map(({ without }) => inWords(without))],
      order.slice(0, most).map((k) => [element('code', {}, breakable(records[k].path)), ...possible.map(({ relative }) => percent(relative[k], accuracy))]), t('Records')),
    order.length > most ? element('p', { class: 'note' }, t('{count} other records change less.', { count: order.length - most })) : null,
  ];
}

function chartOf({ path, curves }, { records }, charts) {
  const host = element('div');
  const { unit } = records.find((record) => record.path === path);
  queueMicrotask(() => charts.push(new TimeChart(host, new TimeGroup(), {
    quantity: path, unit, height: 260,
    curves: curves.map(({ without, time, values }, k) => ({ name: without ? t('without {effects}', { effects: inWords([without]) }) : t('full model'), time, values, style: k, dash: without ? 1 : 0 })),
  })));
  return host;
}

export function effectsOf({ effects, effect_curves: curves }, charts) {
  if (!effects) return [];
  if (!effects.effects.length) return [element('p', { class: 'note' }, t('Nothing in this scene brings an effect that could be left out.'))];
  return [
    element('p', { class: 'finding' }, verdict(effects)),
    curves ? chartOf(curves, effects, charts) : null,
    element('h4', {}, t('Each effect left out by itself')),
    modelsOf(effects.each, effects, ({ without }) => inWords(without), t('Each effect left out by itself')),
    effects.steps.length > 1 ? [
      element('h4', {}, t('One after the other, those first that matter least')),
      modelsOf(effects.steps, effects, ({ without }, k) => (without.length > 1 ? t('and {effect}', { effect: inWords(without.slice(-1)) }) : inWords(without)),
        t('One after the other, those first that matter least')),
    ] : null,
    recordsOf(effects),
    element('p', { class: 'note' }, t('Differences are parts of the largest magnitude of the record in either of the two runs.')),
  ].flat(Infinity).filter(Boolean);
}
