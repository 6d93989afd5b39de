// The card of the run: title, length, rows and records.
import { element } from './dom.js';
import { choiceField, readable, valueField } from './fields.js';
import { t } from './messages.js';

export function runCard(drawing) {
  const { netlist, scene } = drawing;
  const edit = (changes) => drawing.edit(changes);
  const fields = [];
  const field = (label, path, extra) => {
    const made = valueField({
      label, value: readable(netlist, netlist.root.at(...path)),
      onset: (toml) => edit(toml === null ? drawing.netlist.remove(path) : drawing.netlist.set(path, toml)), ...extra,
    });
    fields.push({ path, field: made });
    return made.row;
  };
  const domain = choiceField({
    label: 'domain', value: drawing.domain, options: [['translation', t('translation: m, N, kg')], ['rotation', t('rotation: rad, N·m, kg·m²')]],
    onset: (chosen) => edit(drawing.netlist.set(['domain'], JSON.stringify(chosen))),
  });
  const rows = ['points', 'every'].find((key) => netlist.root.at('simulate', 'output', key)) ?? 'points';
  return {
    heading: t('Run'),
    fields,
    parts: [field('title', ['title'], { optional: true, isText: true }), domain.row,
      field('stop', ['simulate', 'stop'], { description: t('when the run ends'), unit: 's' }),
      field(rows, ['simulate', 'output', rows], rows === 'points' ? { description: t('number of rows'), optional: true } : { description: t('time between two rows'), unit: 's', optional: true }),
      field('accuracy', ['simulate', 'accuracy'], { description: t('error allowed, relative to the largest value of each record'), placeholder: '1e-6', optional: true }),
      records(drawing, netlist, scene, edit)],
  };
}

// A box for each quantity that can be recorded.
function records(drawing, netlist, scene, edit) {
  const list = netlist.root.at('simulate', 'record');
  const known = [...new Set((scene?.records ?? []).map(({ path }) => path))];
  if (list?.kind !== 'array')
    return element('div', { class: 'records' }, element('p', { class: 'about' }, t('All positions, displacements, velocities and forces are recorded.')),
      known.length ? element('button', { type: 'button', onclick: () => edit(netlist.set(['simulate', 'record'], `[${known.map((path) => JSON.stringify(path)).join(', ')}]`)) }, t('Choose …')) : null);
  const chosen = list.items.map(({ plain }) => plain);
  const all = [...new Set([...chosen.filter(Boolean), ...known])];
  const box = (path) => {
    const input = element('input', { type: 'checkbox', checked: chosen.includes(path) });
    input.addEventListener('change', () => {
      const { netlist: now } = drawing;
      if (input.checked) edit(now.append(['simulate', 'record'], JSON.stringify(path)));
      else edit(chosen.length === 1 ? now.remove(['simulate', 'record']) : now.withoutItems(now.root.at('simulate', 'record').node.elements, ({ value }) => value === path));
    });
    return element('label', { 'data-on': String(input.checked) }, input, ` ${path}`);
  };
  return element('fieldset', { class: 'records' }, element('legend', {}, t('recorded')), all.map(box));
}
