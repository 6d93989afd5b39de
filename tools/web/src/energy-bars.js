// Bars of the energy at an instant: supplied, kinetic and elastic, dissipated.
import { element } from './dom.js';
import { t } from './messages.js';
import { largestOf, shownIn, spaced } from './units.js';

const kinds = { supplied: t('supplied'), kinetic: t('kinetic'), elastic: t('elastic'), dissipated: t('dissipated') };

// The slope at a point of a monotone cubic interpolant (Fritsch and Butland 1984).
function slope(times, values, k) {
  const rise = (j) => (values[j + 1] - values[j]) / (times[j + 1] - times[j]);
  const [before, after] = [k > 0 && times[k] > times[k - 1] ? rise(k - 1) : null, times[k + 1] > times[k] ? rise(k) : null];
  if (before === null || after === null) return before ?? after ?? 0;
  if (before * after <= 0) return 0;
  const [left, right] = [times[k] - times[k - 1], times[k + 1] - times[k]];
  const [a, b] = [2 * right + left, right + 2 * left];
  return (a + b) / (a / before + b / after);
}

// The interpolated value between two steps of the integrator, which may be far apart.
function between(times, values, k, time) {
  const length = times[k + 1] - times[k];
  if (!(length > 0)) return values[k + 1];
  const s = Math.min(1, Math.max(0, (time - times[k]) / length));
  return values[k] * (1 + 2 * s) * (1 - s) ** 2 + values[k + 1] * s * s * (3 - 2 * s)
    + length * s * (1 - s) * (slope(times, values, k) * (1 - s) - slope(times, values, k + 1) * s);
}

export class EnergyBars {
  constructor(host) {
    this.host = host;
    this.bars = Object.fromEntries(Object.keys(kinds).map((kind) => [kind, { bar: element('span', { class: `bar-of ${kind}` }), value: element('output') }]));
    host.append(...Object.entries(kinds).map(([kind, name]) =>
      element('span', { class: 'energy' }, element('span', { class: 'energy-name' }, name),
        element('span', { class: 'bar-room' }, this.bars[kind].bar), this.bars[kind].value)));
  }

  attach(data) {
    this.energy = data.hasEnergy ? data.energy : null;
    if (!this.energy) return;
    this.largest = largestOf(Object.keys(kinds).map((kind) => this.energy[kind]));
    this.unit = shownIn('J', this.largest);
  }

  show(time) {
    if (!this.energy) return;
    const { time: times } = this.energy;
    const next = times.findIndex((t) => t > time);
    const k = Math.max(0, (next < 0 ? times.length - 1 : next) - 1);
    for (const kind of Object.keys(kinds)) {
      const value = between(times, this.energy[kind], k, time);
      const { bar, value: output } = this.bars[kind];
      // Negative values extend to the left.
      const share = this.largest > 0 ? value / this.largest : 0;
      bar.style.width = `${(50 * Math.abs(share)).toFixed(2)}%`;
      bar.style.left = `${(50 + 50 * Math.min(0, share)).toFixed(2)}%`;
      output.textContent = `${spaced(value / this.unit.factor, this.largest / this.unit.factor / 100)} ${this.unit.name}`;
    }
  }
}
