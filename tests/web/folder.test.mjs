// What the server tells of its folder, and which folders it serves.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { test } from 'node:test';
import { folderWith, program, remove, rheonet, serve } from './support.mjs';

test('the netlists that come with rheonet are not changed', async () => {
  const own = spawn(program, ['serve', '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  const [line] = await once(own.stdout, 'data');
  const [, port] = /:(\d+)\//.exec(line);
  const answer = await fetch(`http://127.0.0.1:${port}/api/save`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ file: 'teaching/new.toml', text: 'x' }) });
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
  const { scenes } = await (await fetch(`${gallery.origin}/api/folder`)).json();
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
