// The part of the JSON Schema of netlists for a place in a netlist: https://json-schema.org/draft/2020-12
export class SchemaPath {
  constructor(schema) {
    this.schema = schema;
  }

  // A schema with all that it refers to and combines, as far as it holds for a table with these values: `given`, name -> text in TOML.
  parts(node, given) {
    if (!node || typeof node !== 'object') return [];
    const more = [...(node.allOf ?? []), ...(node.anyOf ?? [])];
    if (node.$ref) more.push(this.schema.$defs[node.$ref.split('/').at(-1)]);
    if (node.if && this.holds(node.if, given)) more.push(node.then);
    return [node, ...more.flatMap((each) => this.parts(each, given))];
  }

  holds({ properties, required }, given) {
    const type = given.get('type')?.replace(/["']/g, '');
    return properties?.type ? properties.type.enum.includes(type) : required.some((name) => given.has(name));
  }

  // The schemas of the value at a path, whose last table has the values `given`.
  at(path, given) {
    let nodes = this.parts(this.schema, path.length ? new Map() : given);
    path.forEach((name, k) => {
      const inner = k + 1 === path.length ? given : new Map();
      const next = nodes.map((node) => (typeof name === 'number' ? node.items : node.properties?.[name] ?? (node.additionalProperties || undefined)));
      nodes = next.flatMap((each) => this.parts(each, inner));
    });
    return nodes;
  }

  // The keys of the table at a path: name -> description.
  keysAt(path, given) {
    const keys = new Map();
    const schemas = this.at(path, given);
    for (const { properties } of schemas)
      for (const [name, schema] of Object.entries(properties ?? {})) if (schema && !keys.get(name)) keys.set(name, this.describe(schema, given));
    // A key that one schema excludes is invalid, even if others allow it.
    for (const { properties, additionalProperties: others } of schemas)
      for (const name of keys.keys()) if (properties?.[name] === false || (others === false && !properties[name] && given.has('type'))) keys.delete(name);
    return keys;
  }

  describe(schema, given) {
    return this.parts(schema, given).find(({ description }) => description)?.description ?? '';
  }

  // The words that a value may be: word -> description.
  wordsAt(path, given) {
    const words = new Map();
    for (const { enum: list = [], const: one, description = '' } of this.at(path, given))
      for (const word of one === undefined ? list : [one]) words.set(word, one === undefined ? '' : description);
    return words;
  }
}
