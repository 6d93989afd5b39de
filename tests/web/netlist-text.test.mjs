// Edits of a netlist by the schematic: each changes what it is meant to change, and no other character. No browser is needed.
import assert from 'node:assert/strict';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const packages = process.env.NODE_PACKAGES;

// A module of the page, with the packages that it imports.
async function moduleOf(name) {
  const folder = mkdtempSync(join(tmpdir(), 'rheonet-module-'));
  const outfile = join(folder, 'module.mjs');
  const { build } = createRequire(join(packages, 'package.json'))('esbuild');
  await build({ entryPoints: [join(here, '../../tools/web/src', name)], bundle: true, format: 'esm', outfile, nodePaths: [join(packages, 'node_modules')], logLevel: 'error' });
  const found = await import(pathToFileURL(outfile).href);
  rmSync(folder, { recursive: true });
  return found;
}
const { NetworkText } = await moduleOf('network-text.js');
const { valueOf, changed } = await moduleOf('netlist-text.js');
const { placeIn } = await moduleOf('netlist-place.js');

const scene = `# A block.
title = "Stick"   # short

[elements]
pull = { type = "motion", at = "hand", velocity = "10 mm/s" } # the drive
k1   = { type = "spring",  between = ["hand", "block"], stiffness = "100 N/m" }
block = { type = "mass", at = "block", mass = "1 kg" }   # heavy
s1.type = "slider"
s1.between = ["block", "ground"]
s1.coulomb = "1 N"
lag1 = { type = "lag", in = "-k1.force", time_constant = 0.1 }

[elements.shaker]
type = "force"
at = "block"
[elements.shaker.force]  # by the block
block = "lag1"

[nodes]
block = { position = 1 }

[simulate]
stop = "8 s"
record = [
  "block.position", # where it is
  "k1.force",
  "block.force",
  { name = "gap", value = "hand.position-block.position" },
]

[expect]
k1.force = { max = 2 }
"block.velocity" = { max = 2 }

[plot]
y = ["k1.force"]
loop = "k1"

[effects]
without = ["elasticity:k1"]
`;

// The lines that an edit takes away and those that it brings; no change overlaps another, and the result is TOML.
function edited(text, edit) {
  const changes = edit(new NetworkText(text));
  const sorted = [...changes].sort((a, b) => a.from - b.from);
  sorted.slice(1).forEach(({ from }, k) => assert.ok(from >= sorted[k].to, 'changes overlap'));
  const result = changed(text, changes);
  new NetworkText(result);
  const [before, after] = [text.split('\n'), result.split('\n')];
  const only = (a, b) => a.filter((line) => !b.includes(line));
  return { gone: only(before, after), come: only(after, before), result };
}

test('a value is changed, added or taken away, wherever and however its table is written', () => {
  const cases = [
    [['elements', 'k1', 'stiffness'], '2', 'k1   = { type = "spring",  between = ["hand", "block"], stiffness = 2 }'],
    [['elements', 'k1', 'rest'], '"1 mm"', 'k1   = { type = "spring",  between = ["hand", "block"], stiffness = "100 N/m", rest = "1 mm" }'],
    [['elements', 's1', 'breakaway'], '"2 N"', 's1.breakaway = "2 N"'],
    [['elements', 'shaker', 'domain'], '"translation"', 'domain = "translation"'],
    [['nodes', 'hand', 'position'], '2', 'hand = { position = 2 }'],
    [['simulate', 'output', 'points'], '11', 'output = { points = 11 }'],
    [['parameters', 'k'], '"1 N/m"', 'k = "1 N/m"'],
  ];
  for (const [path, toml, line] of cases) {
    const { come, result } = edited(scene, (netlist) => netlist.set(path, toml));
    assert.ok(come.includes(line), `${path}: ${come}`);
    const read = new NetworkText(result);
    assert.equal(read.source(read.root.at(...path).node), toml);
    // Removing an added entry restores the text.
    if (new NetworkText(scene).root.at(...path) || path[0] === 'nodes' || path[0] === 'parameters' || path[1] === 'output') continue;
    assert.equal(changed(result, read.remove(path)), scene, String(path));
  }
});

test('a table of several statements becomes a single value', () => {
  const { gone, come } = edited(scene, (netlist) => netlist.set(['elements', 'shaker', 'force'], '"1 N"'));
  assert.deepEqual(gone, ['[elements.shaker.force]  # by the block', 'block = "lag1"']);
  assert.deepEqual(come, ['force = "1 N"']);
});

test('an entry takes the place of another, and several go at once', () => {
  const to = (path, name) => edited(scene, (netlist) => netlist.replace(path, name, '3')).come;
  assert.deepEqual(to(['elements', 's1', 'coulomb'], 'damping'), ['s1.damping = 3']);
  assert.deepEqual(to(['elements', 'k1', 'stiffness'], 'damping'), ['k1   = { type = "spring",  between = ["hand", "block"], damping = 3 }']);
  assert.deepEqual(to(['elements', 'shaker', 'force'], 'torque'), ['torque = 3']);
  const without = (path, names) => edited(scene, (netlist) => netlist.removeSeveral(path, names)).come;
  assert.deepEqual(without(['elements', 'k1'], ['type', 'between']), ['k1   = { stiffness = "100 N/m" }']);
  assert.deepEqual(without(['elements', 'k1'], ['between', 'stiffness']), ['k1   = { type = "spring" }']);
  assert.deepEqual(without(['elements', 'shaker'], ['type', 'at']), []);
});

test('an element gets another name in all places that refer to it, and in no others', () => {
  const { come } = edited(scene, (netlist) => netlist.rename('k1', 'steel'));
  assert.deepEqual(come, [
    'steel   = { type = "spring",  between = ["hand", "block"], stiffness = "100 N/m" }', 'lag1 = { type = "lag", in = "-steel.force", time_constant = 0.1 }',
    '  "steel.force",', 'steel.force = { max = 2 }', 'y = ["steel.force"]', 'loop = "steel"', 'without = ["elasticity:steel"]',
  ]);
  assert.deepEqual(edited(scene, (netlist) => netlist.rename('lag1', 'slow')).come, ['slow = { type = "lag", in = "-k1.force", time_constant = 0.1 }', 'block = "slow"']);
});

test('an element and a node of one name are told apart by what is recorded of them', () => {
  const ofElement = edited(scene, (netlist) => netlist.rename('block', 'cart'));
  assert.deepEqual(ofElement.come, ['cart = { type = "mass", at = "block", mass = "1 kg" }   # heavy', '  "cart.force",']);
  const ofNode = edited(scene, (netlist) => netlist.renameNode('block', 'cart'));
  assert.deepEqual(ofNode.come, [
    'k1   = { type = "spring",  between = ["hand", "cart"], stiffness = "100 N/m" }', 'block = { type = "mass", at = "cart", mass = "1 kg" }   # heavy', 's1.between = ["cart", "ground"]',
    'at = "cart"', 'cart = { position = 1 }', '  "cart.position", # where it is', '  { name = "gap", value = "hand.position-cart.position" },', '"cart.velocity" = { max = 2 }',
  ]);
});

test('an element goes with all that is recorded and claimed of it, and of nodes that nothing else names', () => {
  assert.deepEqual(edited(scene, (netlist) => netlist.removeElement('k1')).gone,
    ['k1   = { type = "spring",  between = ["hand", "block"], stiffness = "100 N/m" }', '  "k1.force",', 'k1.force = { max = 2 }']);
  const small = '[elements]\nk1 = { type = "spring", between = ["a", "b"], stiffness = 1 }\n# stays\nm1 = { type = "mass", at = "b", mass = 1 } # goes\n[nodes]\na = { position = 1 }\n[simulate]\nstop = 1\nrecord = ["a.position", "b.position", "k1.force"]\n';
  assert.equal(edited(small, (netlist) => netlist.removeElement('k1')).result,
    '[elements]\n# stays\nm1 = { type = "mass", at = "b", mass = 1 } # goes\n[nodes]\n[simulate]\nstop = 1\nrecord = ["b.position"]\n');
  assert.equal(edited(small, (netlist) => netlist.removeElement('m1')).result,
    '[elements]\nk1 = { type = "spring", between = ["a", "b"], stiffness = 1 }\n# stays\n[nodes]\na = { position = 1 }\n[simulate]\nstop = 1\nrecord = ["a.position", "b.position", "k1.force"]\n');
});

test('what is recorded, claimed and given of a node that an element leaves follows to its new node', () => {
  const small = '[elements]\nm1 = { type = "mass", at = "a", mass = 1 }\nk1 = { type = "spring", between = ["b", "ground"], stiffness = 1 }\n[nodes]\na = { position = 1 }\n[simulate]\nstop = 1\nrecord = ["a.position", "k1.force"]\n[expect]\na.position = { max = 2 }\n';
  const moved = (text, node) => edited(text, (netlist) => netlist.connect(['elements', 'm1', 'at'], node)).result;
  assert.equal(moved(small, 'b'), small.replace('at = "a"', 'at = "b"').replace('"a.position"', '"b.position"').replaceAll('\na', '\nb'));
  // Nothing is recorded twice.
  const both = small.replace('"k1.force"', '"b.position"');
  assert.match(moved(both, 'b'), /record = \["b.position"\]/);
  // Records and start values stay with a node that still has an element.
  const shared = small.replace('["b"', '["a"');
  assert.equal(moved(shared, 'b'), shared.replace('at = "a"', 'at = "b"'));
  // Ground has neither records nor start values.
  assert.equal(edited(small, (netlist) => netlist.renameNode('a', 'ground')).result, small.replace('at = "a"', 'at = "ground"').replace('"a.position", ', '').replace('a = { position = 1 }\n', '').replace('a.position = { max = 2 }\n', ''));
});

test('a number that TOML knows stands without quotes, all else in them', () => {
  for (const [text, toml] of [['1', '1'], ['-2.5e3', '-2.5e3'], ['1 N', '"1 N"'], ['.5', '".5"'], ['01', '"01"'], ['5.', '"5."'], ['2*k', '"2*k"'], ['a "b"', '"a \\"b\\""'], ['inf', '"inf"']]) {
    assert.equal(valueOf(text), toml);
    new NetworkText(`x = ${valueOf(text)}`);
  }
});

test('every netlist of the project is read; each of its elements can be renamed there and back, and leaves', () => {
  const folder = join(here, '../../netlists');
  let renamed = 0;
  for (const entry of readdirSync(folder, { withFileTypes: true, recursive: true })) {
    if (!entry.isFile() || !entry.name.endsWith('.toml')) continue;
    const text = readFileSync(join(entry.parentPath ?? entry.path, entry.name), 'utf8');
    const netlist = new NetworkText(text);
    for (const name of netlist.elementNames.slice(0, 20)) {
      const there = edited(text, (each) => each.rename(name, 'a-name-of-no-other')).result;
      assert.equal(edited(there, (each) => each.rename('a-name-of-no-other', name)).result, text, `${entry.name}: ${name}`);
      assert.ok(!new NetworkText(edited(text, (each) => each.removeElement(name)).result).element(name));
      renamed += 1;
    }
    for (const node of netlist.nodeNames.slice(0, 20)) {
      const there = edited(text, (each) => each.renameNode(node, 'a-name-of-no-other')).result;
      assert.equal(edited(there, (each) => each.renameNode('a-name-of-no-other', node)).result, text, `${entry.name}: ${node}`);
    }
  }
  assert.ok(renamed > 300, String(renamed));
});

test('the place of the cursor in a text that is not finished', () => {
  const place = (text) => {
    const at = text.indexOf('|');
    const { path, key, word, quote, given, isHeader } = placeIn(text.slice(0, at) + text.slice(at + 1), at);
    return { path, key, word, quote, given: [...given.keys()], isHeader };
  };
  const expected = { given: [], isHeader: false, quote: '', word: '' };
  assert.deepEqual(place('[elem|'), { ...expected, path: [], key: null, word: 'elem', isHeader: true });
  assert.deepEqual(place('[simulate]\nsto|'), { ...expected, path: ['simulate'], key: null, word: 'sto' });
  assert.deepEqual(place('[elements]\nk1 = { type = "spring", between = ["a|'), { ...expected, path: ['elements', 'k1', 'between', 0], key: 'between', word: 'a', quote: '"' });
  assert.deepEqual(place('[elements]\nk1 = { type = "spring", between = ["a", "b"], sti|'), { ...expected, path: ['elements', 'k1'], key: null, word: 'sti', given: ['type', 'between'] });
  assert.deepEqual(place('[elements]\nk1 = { type = "spring", stiffness = "1 N|'), { ...expected, path: ['elements', 'k1'], key: 'stiffness', word: '1 N', quote: '"', given: ['type'] });
  assert.deepEqual(place('[elements]\nk1 = { type = "spr\nm1 = { |'), { ...expected, path: ['elements', 'm1'], key: null });
  assert.deepEqual(place('[simulate]\nrecord = [\n  "a.force", # not "this\n  "|'), { ...expected, path: ['simulate', 'record', 1], key: 'record', quote: '"' });
  assert.equal(placeIn('# a comment', 5), null);
});
