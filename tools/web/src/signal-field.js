// A function of time in a card: a constant, a shape with its values, or what a block gives.
import { element } from './dom.js';
import { choiceField, readable } from './fields.js';
import { t } from './messages.js';
import { valueOf } from './netlist-text.js';

// The unit of a further value of a shape, as its description says it: "when it starts [s]; 0 if absent".
const unitOf = (description) => /\[(s|Hz|rad)\b/.exec(description)?.[1] ?? '';

const always = ['time', 'offset']; // are offered for every shape

// `card`: of the element that has it.
export function signalFields(card, path, parameter) {
  const { netlist, domain, blocks, edit } = card;
  const { catalogue } = card.drawing;
  const fieldOf = (at, options) => card.fieldOf(at, options);
  const set = (toml) => edit(card.netlist.set(path, toml)); // of the text as it is then
  const name = parameter.name[domain];
  const value = netlist.root.at(...path);
  const unit = parameter.unit[domain];
  const table = catalogue.signalTable.properties;
  const shapes = catalogue.shapes;
  const shape = value?.kind === 'table' ? shapes.find((each) => value.at(each.name))?.name ?? (value.at('block') ? 'block' : 'other') : 'constant';
  const sizeNow = () => readable(card.netlist, card.netlist.root.at(...path, ...(shape === 'constant' ? [] : [shape])));
  const perSecond = unit && `${unit}/s`.replace('/s/s', '/s^2');
  // The slope of a ramp has another unit than all other shapes.
  const sizeOf = (chosen) => {
    if (chosen === 'ramp') return perSecond ? `"1 ${perSecond}"` : '1';
    const size = sizeNow();
    return size && !/^[[{]/.test(size) && shape !== 'block' && shape !== 'ramp' ? valueOf(size) : parameter.first[domain];
  };
  const begin = (needed) => `${needed} = ${unitOf(table[needed].description) ? `"1 ${unitOf(table[needed].description)}"` : 1}`;
  const rows = [choiceField({
    label: t('{name} over time', { name }),
    value: shape,
    options: [['constant', t('constant')], ...shapes.map((each) => [each.name, each.name]), ...(blocks.length || shape === 'block' ? [['block', t('from a block')]] : []), ...(shape === 'other' ? [['other', t('other')]] : [])],
    onset: (chosen) => {
      const found = shapes.find((each) => each.name === chosen);
      if (chosen === 'constant') set(sizeOf(chosen));
      else if (chosen === 'block') set(`{ block = ${JSON.stringify(blocks[0])} }`);
      else set(`{ ${[`${chosen} = ${sizeOf(chosen)}`, ...found.needs.map(begin)].join(', ')} }`);
    },
  }).row];
  const put = (key) => (toml) => edit(toml === null ? card.netlist.remove([...path, key]) : card.netlist.set([...path, key], toml));
  if (shape === 'constant' || shape === 'other') {
    rows.push(fieldOf(path, { label: name, symbol: parameter.symbol, description: parameter.description, unit, onset: set }));
  } else if (shape === 'block') {
    rows.push(choiceField({ label: 'block', value: readable(netlist, value.at('block')), options: blocks.map((block) => [block, block]), onset: (block) => put('block')(JSON.stringify(block)) }).row);
  } else {
    const needs = shapes.find((each) => each.name === shape).needs;
    const keys = [...new Set([shape, ...needs, ...value.entries.keys(), ...always])];
    for (const key of keys) {
      const { description = '' } = table[key] ?? {};
      const ofValue = key === shape ? (shape === 'ramp' ? perSecond : unit) : key === 'offset' ? unit : unitOf(description);
      rows.push(fieldOf([...path, key], {
        label: key, description: description.replace(/ \[[^\]]*\]/, ''), unit: ofValue, placeholder: value.at(key) ? '' : '0', optional: key !== shape && !needs.includes(key), onset: put(key),
      }));
    }
  }
  return element('fieldset', { class: 'signal' }, element('legend', {}, name), rows);
}
