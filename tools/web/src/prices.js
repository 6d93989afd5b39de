// Price of accuracy: the work of runs over their error.
import { breakable, element, table } from './dom.js';
import { LoopChart } from './loop-chart.js';
import { t } from './messages.js';
import { grouped, number, withUnit } from './units.js';

const roundOff = 2 ** -52; // relative; a logarithmic axis has no place for an error of 0

// An error that is no larger than twice the doubt of its yardstick is not known better.
const errorOf = ({ error, doubt }) => Math.max(error, 2 * doubt, roundOff);
const errorText = ({ error, doubt }) => (error > 2 * doubt || error === 0 ? error.toExponential(1) : `< ${(2 * doubt).toExponential(1)}`);

const methodNames = { ida: t('step by step (IDA)'), exact: t('exact arcs') };
const nameOf = (method) => methodNames[method] ?? method;

// A chart of all prices over their errors. `cost(price)`: the ordinate.
export function priceChart(host, prices, quantity, unit, cost) {
  const methods = [...new Set(prices.map(({ method }) => method))];
  return new LoopChart(host, {
    x: { quantity: t('relative error of the worst record'), unit: '', log: true },
    y: { quantity, unit, log: true },
    curves: methods.map((method) => {
      const of = prices.filter((price) => price.method === method);
      return { name: nameOf(method), x: of.map(errorOf), y: of.map(cost) };
    }),
    height: 280,
    marks: true,
  });
}

// Whether the next digit costs anything, and why.
function verdict({ prices, not_linear: reason, by_ida: byIda }, isExact) {
  const arcs = prices.find(({ method }) => method === 'exact');
  const steps = arcs && grouped(arcs.steps);
  const linear = t('between two events all laws of this scene are linear, and the motion is a sum of sines, exponentials and polynomials');
  if (isExact && arcs)
    return t('Accuracy costs nothing here: {linear}. rheonet computes it in closed form (exact arcs): {steps} steps give every digit, whatever accuracy is asked for. The other curve is what the integrator IDA would take.', { linear, steps });
  if (arcs && byIda)
    return t('The netlist asks for `method = "ida"`, so each digit costs steps. Without that line accuracy would cost nothing: {linear}; {steps} steps would give every digit.', { linear, steps });
  const digits = growth(prices.filter(({ method }) => method === 'ida'));
  const words = digits ? t('Each further digit takes {factor} times the steps.', { factor: number(digits, 3) }) : '';
  return `${reason ? t('This scene is solved step by step, by the integrator IDA: {reason}.', { reason }) : t('This scene is solved step by step, by the integrator IDA.')} ${words}`;
}

// How many times more steps a digit takes, from the loosest tolerance to the tightest.
function growth(prices) {
  const [first, last] = [prices[0], prices.at(-1)];
  const digits = first ? Math.log10(first.tolerance / last.tolerance) : 0;
  return digits > 0 ? (last.steps / first.steps) ** (1 / digits) : 0;
}

function yardstick({ closed_forms: forms, records, reference }) {
  const run = t('a run to {tolerance}', { tolerance: number(reference, 2) });
  if (!forms) return t('Errors are measured by {run}.', { run });
  return forms < records ? t('Errors are measured by the closed forms of the scene, and where it has none by {run}.', { run }) : t('Errors are measured by the closed forms of the scene.');
}

// `isExact`: the run on the page went by exact arcs. `inWords` sets names in a text.
export function pricesOf(message, isExact, inWords, charts) {
  const { prices, accuracy } = message;
  if (!prices.length) return [element('p', { class: 'note bad' }, t('No run came to its end.'))];
  const isTimed = prices.some(({ cpu }) => cpu > 0);
  const [steps, time] = [element('div'), element('div')];
  queueMicrotask(() => {
    charts.push(priceChart(steps, prices, t('steps'), '', (price) => price.steps));
    if (isTimed) charts.push(priceChart(time, prices, t('CPU time'), 's', ({ cpu }) => cpu));
  });
  const rows = prices.map((price) => [nameOf(price.method), price.method === 'exact' ? t('any') : number(price.tolerance, 2), errorText(price), element('code', {}, breakable(price.worst)),
    grouped(price.steps), ...(isTimed ? [withUnit(price.cpu, 's', 3)] : []), price.cheapest ? element('span', { class: 'holds' }, t('cheapest that is good enough')) : price.meets ? t('good enough') : '']);
  return [
    element('p', { class: 'finding' }, inWords(verdict(message, isExact))),
    element('div', { class: 'two-charts' }, steps, isTimed ? time : null),
    table([t('method'), t('accuracy asked'), t('error'), t('record'), t('steps'), ...(isTimed ? [t('CPU time')] : []), t('for {accuracy}', { accuracy: number(accuracy, 2) })], rows, t('Price of accuracy')),
    element('p', { class: 'note' }, `${yardstick(message)} ${t('An error is a part of the largest magnitude of its record.')}`),
  ];
}
