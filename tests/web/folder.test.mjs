// The server's listing of its folder, and the folders that it serves.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { chmodSync, existsSync, readFileSync, readdirSync } from 'node:fs';
import { request } from 'node:http';
import { networkInterfaces } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { folderWith, program, remove, rheonet, serve } from './support.mjs';

test('the script and the style of the page come compressed to whoever takes that', async () => {
  const folder = folderWith({ 'a.toml': '[elements]\n[simulate]\n' });
  const server = await serve(folder);
  const get = (name, encoding) =>
    new Promise((resolve, reject) => {
      request(`${server.origin}/${name}`, { headers: { ...server.key, 'Accept-Encoding': encoding } }, (answer) => {
        const parts = [];
        answer.on('data', (part) => parts.push(part)).on('end', () => resolve({ headers: answer.headers, bytes: Buffer.concat(parts) }));
      }).on('error', reject).end();
    });
  for (const name of ['playground.js', 'playground.css']) {
    const plain = await get(name, 'identity'), small = await get(name, 'br, gzip');
    assert.equal(plain.headers['content-encoding'], undefined);
    assert.equal(small.headers['content-encoding'], 'gzip');
    assert.equal(small.headers['content-type'], plain.headers['content-type']);
    assert.ok(small.bytes.length < plain.bytes.length);
    assert.ok(gunzipSync(small.bytes).equals(plain.bytes));
  }
  await server.stop();
  remove(folder);
});

test('the netlists that come with rheonet are not changed', async () => {
  const own = spawn(program, ['serve', '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  const [line] = await once(own.stdout, 'data');
  const [, port, token] = /:(\d+)\/\?token=(\w+)/.exec(line);
  const answer = await fetch(`http://127.0.0.1:${port}/api/save`, { method: 'POST', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${token}` }, body: JSON.stringify({ file: 'teaching/new.toml', text: 'x' }) });
  assert.equal(answer.status, 403);
  assert.match((await answer.json()).error, /come with rheonet/);
  own.kill('SIGTERM');
  await once(own, 'exit');
});

test('the gallery is told what a netlist says of itself, however it is written', async () => {
  const files = {
    'single.toml': `# A comment.\ntitle = 'It''s'\n`.replace("'It''s'", "'single \"quotes\"'") + '[elements]\n[simulate]\n',
    'escaped.toml': `title = "tab\\tand \\"quote\\" \\u00b5" # "not this"\nelements = {}\nsimulate = { stop = 1 }\n`,
    'long.toml': 'title = """\nOn a line\nof its own"""\n[elements]\n[simulate]\n[demo]\nquestion = \'Why "so"?\'\n',
    'dotted.toml': `#:schema x.json\n#  First words,\n# and more.\n\n# Not these.\ndemo.see = "x"\nelements.k1.type = "spring"\nsimulate.stop = 1\n[parameters]\ntitle = "not this"\n`,
    'wrong.toml': 'title = "Wrong"\n[elements\n',
    'models.toml': 'title = "Models"\n[models.a]\n',
    'a\tb.toml': '[elements]\n[simulate]\n',
    'README.md': 'Not of a-single.toml. Here is `long.toml`, in its folder ./single.toml, and `long.toml` again.\n',
  };
  const told = (name) => files['README.md'].indexOf(name);
  const other = folderWith(files);
  const gallery = await serve(other);
  const { scenes, left_out: leftOut, all_visited: allVisited } = await (await fetch(`${gallery.origin}/api/folder`, { headers: gallery.key })).json();
  assert.deepEqual([leftOut, allVisited], [0, true]);
  assert.deepEqual(scenes, [
    { file: 'dotted.toml', title: '', about: 'First words, and more.' },
    { file: 'escaped.toml', title: 'tab\tand "quote" \u00b5', about: '' },
    { file: 'long.toml', title: 'On a line\nof its own', about: 'Why "so"?', place: told('long.toml') },
    { file: 'single.toml', title: 'single "quotes"', about: 'A comment.', place: told('/single.toml') + 1 },
    { file: 'wrong.toml', title: '', about: scenes.at(-1).about },
  ]);
  assert.match(scenes.at(-1).about, /^It cannot be read: 2:\d+: /);
  await gallery.stop();
  remove(other);
});

test('what cannot be served is said', async () => {
  const other = folderWith({ file: '' });
  const first = await serve(other);
  const { code, stderr } = await rheonet(['serve', join(other, 'none')]).catch((error) => error);
  assert.equal(code, 2);
  assert.match(stderr, /cannot serve/);
    assert.equal((await rheonet(['serve', join(other, 'file')]).catch((error) => error)).code, 2);
  const taken = await rheonet(['serve', other, '--port', String(first.port)]).catch((error) => error);
  assert.equal(taken.code, 1);
  assert.match(taken.stderr, /the port is in use/);
  await first.stop();
  remove(other);
});

test('of more than a thousand netlists it lists the first by name, and says how many others there are', async () => {
  const scene = '[elements]\n[simulate]\n';
  const files = Object.fromEntries(Array.from({ length: 1003 }, (_, k) => [`${k % 2 ? 'odd/' : ''}n${String(k).padStart(4, '0')}.toml`, scene]));
  const other = folderWith({ ...files, 'a-models.toml': '[models.a]\n' });
  const gallery = await serve(other);
  const listing = await (await fetch(`${gallery.origin}/api/folder`, { headers: gallery.key })).json();
  // Models are no scene, and take no place of one.
  assert.equal(listing.scenes.length, 1000);
  assert.equal(listing.left_out, 3);
  assert.equal(listing.all_visited, true);
  assert.deepEqual(listing.scenes.map(({ file }) => file), Object.keys(files).sort().slice(0, 1000));
  await gallery.stop();
  remove(other);
});

test('a host that others can reach is announced with a warning, and by an address that they can type', async () => {
  const other = folderWith({});
  const said = (host) => {
    const { stdout, stderr } = spawnSync('timeout', ['-s', 'INT', '2', program, 'serve', other, '--port', '0', '--host', host], { encoding: 'utf8' });
    return { stdout, stderr };
  };
  const everywhere = said('0.0.0.0');
  assert.match(everywhere.stdout, /^http:\/\/127\.0\.0\.1:\d+\/\?token=\w{32} /);
  assert.doesNotMatch(everywhere.stdout, /0\.0\.0\.0/);
  const others = Object.values(networkInterfaces()).flat().filter(({ family, internal }) => family === 'IPv4' && !internal);
  for (const { address } of others) assert.match(everywhere.stdout, new RegExp(`from other machines, to type: http://${address.replaceAll('.', '\\.')}:\\d+/[a-z2-9]{4}-[a-z2-9]{4} \\(saves nothing here\\)\\n`));
  assert.match(everywhere.stderr, /warning: `--host 0\.0\.0\.0` lets other machines in: .*an address can run scenes.*with the token can change the netlists/);
  for (const host of ['127.0.0.1', 'localhost']) assert.equal(said(host).stderr, '', host);
  remove(other);
});

test('the short address leads in as a guest, however it is typed, and is not found by trying', async () => {
  const other = folderWith({ 'a.toml': '' });
  const server = spawn(program, ['serve', other, '--port', '0', '--host', '0.0.0.0'], { stdio: ['ignore', 'pipe', 'ignore'] });
  let said = '';
  server.stdout.on('data', (piece) => (said += piece));
  for (let k = 0; k < 200 && !/to type: \S+ .*\n/.test(said); ++k) await new Promise((resolve) => setTimeout(resolve, 50));
  const [, origin] = /(http:\/\/127\.0\.0\.1:\d+)\//.exec(said);
  const code = /to type: http:\/\/[^/]+\/(\S+)/.exec(said)?.[1];
  if (code) {
    for (const typed of [code, code.toUpperCase(), code.replace('-', '')]) {
      const answer = await fetch(`${origin}/${typed}`, { redirect: 'manual' });
      assert.equal(answer.status, 302, typed);
      const [, key] = /^\/\?guest=(\w+)$/.exec(answer.headers.get('location'));
      const asked = (path, body) => fetch(`${origin}${path}`, { method: body ? 'POST' : 'GET', body, headers: { Authorization: `Bearer ${key}`, 'Content-Type': 'application/json' } });
      assert.equal((await asked('/api/folder')).status, 200);
      assert.equal((await asked('/api/save', JSON.stringify({ file: 'a.toml', text: 'x', opened: '' }))).status, 403);
    }
    const wrong = code.replace(/^./, (letter) => (letter === 'a' ? 'b' : 'a'));
    const answers = [];
    for (let k = 0; k < 40; ++k) answers.push((await fetch(`${origin}/${wrong}`, { redirect: 'manual' })).status);
    assert.equal(answers[0], 404);
    assert.ok(answers.filter((status) => status === 429).length > 5, String(answers));
  } else assert.ok(!Object.values(networkInterfaces()).flat().some(({ family, internal }) => family === 'IPv4' && !internal), said);
  server.kill('SIGTERM');
  await once(server, 'exit');
  remove(other);
});

test('where only this machine is served there is no short address', async () => {
  const other = folderWith({});
  const server = spawn(program, ['serve', other, '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  const [line] = await once(server.stdout, 'data');
  assert.doesNotMatch(String(line), /to type/);
  const [origin] = /http:\/\/127\.0\.0\.1:\d+/.exec(line);
  assert.equal((await fetch(`${origin}/abcd-efgh`)).status, 401);
  server.kill('SIGTERM');
  await once(server, 'exit');
  remove(other);
});

test('the address goes to the browser by a file that only its owner can read, never among the words of a process', async () => {
  const other = folderWith({ 'bin/xdg-open': '#!/bin/sh\nstat -c %a "$1" >"${0%/*}/mode"; cat "$1" >"${0%/*}/page"; echo "$@" >"${0%/*}/words"\n', 'here/a.toml': '' });
  chmodSync(join(other, 'bin/xdg-open'), 0o755);
  const server = spawn(program, ['serve', join(other, 'here'), '--port', '0', '--open'],
    { stdio: ['ignore', 'pipe', 'inherit'], env: { ...process.env, PATH: `${join(other, 'bin')}:${process.env.PATH}`, XDG_RUNTIME_DIR: other } });
  const [line] = await once(server.stdout, 'data');
  const [address] = /http:\S+/.exec(line);
  const words = join(other, 'bin/words');
  for (let k = 0; k < 200 && !(existsSync(words) && readFileSync(words, 'utf8')); ++k) await new Promise((resolve) => setTimeout(resolve, 50));
  assert.equal(readFileSync(join(other, 'bin/mode'), 'utf8'), '600\n');
  assert.ok(readFileSync(join(other, 'bin/page'), 'utf8').includes(`url=${address}`));
  assert.doesNotMatch(readFileSync(words, 'utf8'), /token/);
  server.kill('SIGTERM');
  await once(server, 'exit');
  assert.deepEqual(readdirSync(other).sort(), ['bin', 'here']);
  remove(other);
});
