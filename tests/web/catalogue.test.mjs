// The element types as the page gets them: what it begins an element with is a netlist that rheonet reads. No browser is needed.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { folderWith, remove, rheonet, serve } from './support.mjs';

let folder;
let server;
before(async () => {
  folder = folderWith({});
  server = await serve(folder);
});
after(async () => {
  assert.equal(await server.stop(), 0);
  remove(folder);
});

async function ask(task) {
  const headers = { ...server.key, 'Content-Type': 'application/json', Origin: server.origin };
  const response = await fetch(`${server.origin}/api/task`, { method: 'POST', headers, body: JSON.stringify(task) });
  assert.equal(response.status, 200);
  return (await response.text()).trim().split('\n').map((line) => JSON.parse(line));
}

test('it has every element type, with law, symbol and ports, and the schema that `rheonet schema` prints', async () => {
  const [{ kind, types, schema }] = await ask({ task: 'catalogue' });
  assert.equal(kind, 'catalogue');
  assert.deepEqual(schema, JSON.parse((await rheonet(['schema'])).stdout));
  const listed = [...(await rheonet(['components'])).stdout.matchAll(/^ {2}([a-z]\w*)(?:, \w+)? /gm)].map(([, type]) => type);
  assert.ok(listed.length > 25);
  assert.deepEqual(types.map(({ type }) => type.translation).sort(), listed.sort());
  for (const { type, symbol, tex, summary, nodes, ports } of types) {
    for (const domain of ['translation', 'rotation']) assert.match(symbol[domain], /^<svg viewBox="[-\d. ]+".*<path d="M.*<\/svg>$/, type.translation);
    assert.ok(tex && summary);
    assert.equal(nodes.length, { block: 0, at: 1, 'at or between': 1 }[ports] ?? (type.translation === 'planetary' ? 3 : 2), type.translation);
  }
  assert.equal(types.find(({ type }) => type.translation === 'mass').type.rotation, 'inertia');
});

test('an element of every type is read with the values that it begins with, in both domains', async () => {
  const [{ types }] = await ask({ task: 'catalogue' });
  for (const domain of ['translation', 'rotation'])
    for (const { type, ports, nodes, least_inputs: least, most_inputs: most, parameters } of types) {
      const values = parameters.filter(({ begins }) => begins).map(({ name, first }) => `${name[domain]} = ${first[domain]}`);
      const inputs = Array(Math.max(1, least)).fill('"hand.velocity"');
      const wiring = ports === 'block' ? (most > 1 ? [`in = [${inputs}]`] : most ? [`in = ${inputs[0]}`] : []) : nodes.length > 1 ? [`between = [${['"a"', '"b"', '"c"'].slice(0, nodes.length)}]`] : ['at = "a"'];
      const text = `domain = "${domain}"\n[elements]\nhand = { type = "motion", at = "hand", velocity = 1 }\nit = { ${[`type = "${type[domain]}"`, ...wiring, ...values].join(', ')} }\n[simulate]\nstop = 1\n`;
      const messages = await ask({ task: 'show', draw: true, text, file: 'scene.toml' });
      assert.deepEqual(messages[0].items.filter(({ severity }) => severity === 'error').map(({ text: wrong }) => wrong), [], text);
      const scene = messages.find(({ kind }) => kind === 'scene');
      assert.ok(scene.elements.some(({ name }) => name === 'it'), type[domain]);
      // Where each end is drawn.
      if (nodes.length) assert.deepEqual([...new Set(scene.joints.filter(({ element }) => element === 'it').map(({ node }) => node))].sort(), nodes.length === 1 ? ['a'] : nodes.length === 3 ? ['a', 'b', 'c'] : ['a', 'b'], type[domain]);
    }
});
