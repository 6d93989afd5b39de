// The element types that a netlist can name, as rheonet describes them: see tools/report/messages.hpp.
import { catalogue as ask } from './api.js';
import { t } from './messages.js';

// The types of which most networks are made: each group begins with them.
const basics = ['mass', 'force', 'motion', 'spring', 'dashpot', 'slider'];
const rank = ({ type }) => (basics.includes(type.translation) ? basics.indexOf(type.translation) : basics.length);

// The names in the page of rheonet's groups of types, in the order of building a network.
export const groupNames = () => ({ 'At a node': t('At a node'), 'Between two nodes': t('Between two nodes'), Transmissions: t('Transmissions'), Signals: t('Signals') });

class Catalogue {
  constructor({ types, schema }) {
    this.types = types;
    this.schema = schema;
    this.byName = new Map(types.flatMap((type) => [[type.type.translation, type], [type.type.rotation, type]]));
  }

  find(name) {
    return this.byName.get(name) ?? null;
  }

  // Types by group.
  get groups() {
    const groups = new Map(Object.keys(groupNames()).map((name) => [name, []]));
    for (const type of [...this.types].sort((a, b) => rank(a) - rank(b))) groups.set(type.group, [...(groups.get(type.group) ?? []), type]);
    return groups;
  }

  // Initial parameters of an element of this type: pairs of a name and a value in TOML.
  firstValues({ parameters }, domain) {
    return parameters.filter(({ begins }) => begins).map(({ name, first }) => [name[domain], first[domain]]);
  }

  // The shapes of a signal, each with the keys that it requires.
  get shapes() {
    const { properties, oneOf, dependentRequired } = this.signalTable;
    return oneOf.map(({ required: [name] }) => ({ name, description: properties[name].description, needs: dependentRequired[name] ?? [] })).filter(({ name }) => name !== 'table');
  }

  get signalTable() {
    return this.schema.$defs.signal.anyOf.find(({ properties }) => properties?.sine);
  }
}

let known = null;
export function catalogue() {
  known ??= ask().then((message) => new Catalogue(message)).catch((error) => {
    known = null; // The next call tries again.
    throw error;
  });
  return known;
}
