// The card of a node: name, start values, connected elements, and elements to add.
import { element } from './dom.js';
import { choiceField, readable, valueField } from './fields.js';
import { t } from './messages.js';

export function nodeCard(drawing, node) {
  const { netlist, catalogue, inspector } = drawing;
  const edit = (changes) => drawing.edit(changes);
  const show = (target) => inspector.show(target, true);
  if (node === 'ground') {
    const at = netlist.elementsAt('ground');
    return { heading: t('Ground'), fields: [], parts: [element('p', { class: 'about' }, t('The node that never moves.')), listOf(at, show)] };
  }
  const isOwn = netlist.nodeNames.includes(node);
  if (!isOwn) {
    const owner = node.split('.')[0];
    if (!netlist.element(owner)) return null;
    const start = startFields(drawing, node, edit);
    return { heading: t('Node {node}', { node }), fields: start, parts: [element('p', { class: 'about' }, t('An inner node of {owner}, which its model, group or repetition makes.', { owner })), listOf([owner], show), ...start.map(({ field }) => field.row)] };
  }
  const name = valueField({
    label: t('name'), value: node, isText: true,
    onset: () => {
      const fresh = name.input.value.trim();
      const { netlist } = drawing;
      const fault = netlist.faultOfName(fresh, node, true);
      name.refuse(fault && netlist.nodeNames.includes(fresh) ? `${fault} ${t('“Join to” makes one of the two.')}` : fault);
      if (fault) return;
      inspector.target = { node: fresh };
      edit(netlist.renameNode(node, fresh));
    },
  });
  const others = [...netlist.nodeNames.filter((other) => other !== node), 'ground'];
  const isTight = (other) => netlist.elementsAt(node).some((each) => netlist.portsOf(each).some((port) => port.node === other)) || (other === 'ground' && netlist.elementsAt(node).some((each) => netlist.portsOf(each).some(({ key }) => key === 'at')));
  const join = choiceField({
    label: t('join to'), value: '', options: [['', t('no other node')], ...others.filter((other) => !isTight(other)).map((other) => [other, other])],
    onset: (other) => {
      inspector.target = { node: other };
      edit(drawing.netlist.renameNode(node, other));
    },
  });
  const domain = drawing.domainAt(node);
  const start = startFields(drawing, node, edit);
  const here = catalogue.types.filter(({ group }) => group === 'At a node').map((type) => type.type[domain]);
  return {
    heading: t('Node {node}', { node }),
    fields: start,
    parts: [name.row, ...start.map(({ field }) => field.row), join.row, listOf(netlist.elementsAt(node), show),
      element('div', { class: 'inspector-foot' }, t('Add here:'), ' ', here.map((type) => element('button', {
        type: 'button',
        onclick: () => {
          drawing.begin(type);
          drawing.take({ node });
        },
      }, type)))],
  };
}

export function startFields(drawing, node, edit) {
  const units = drawing.domainAt(node) === 'rotation' ? { position: 'rad', velocity: 'rad/s' } : { position: 'm', velocity: 'm/s' };
  return Object.entries(units).map(([key, unit]) => {
    const path = ['nodes', node, key];
    const field = valueField({
      label: key, description: t('at the start'), unit, value: readable(drawing.netlist, drawing.netlist.root.at(...path)), placeholder: '0', optional: true,
      onset: (toml) => {
        const { netlist } = drawing;
        const only = netlist.root.at('nodes', node)?.entries.size === 1;
        edit(toml === null ? netlist.remove(only ? ['nodes', node] : path) : netlist.set(path, toml));
      },
    });
    return { path, field };
  });
}

const listOf = (names, show) => element('p', { class: 'at-node' }, names.length ? `${t('Here are:')} ` : t('Nothing is here.'),
  names.map((name) => element('button', { type: 'button', class: 'link', onclick: () => show({ element: name }) }, name)));
