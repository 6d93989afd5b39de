// For any request, the server keeps running, answers other clients, and neither reads nor writes outside its folder.
import assert from 'node:assert/strict';
import { chmodSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import http from 'node:http';
import net from 'node:net';
import { dirname, join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { bingham, folderWith, remove, rheonet, serve } from './support.mjs';

// A mass that a square wave drives against friction, nearly for ever.
const endless = `[elements]
push = { type = "force", at = "block", force = { square = "3 N", frequency = "50 Hz" } }
m1 = { type = "mass", at = "block", mass = "1 kg" }
s1 = { type = "slider", between = ["block", "ground"], coulomb = "1 N" }
[simulate]
stop = "1e7 s"
output = { every = "1e4 s" }
`;

let outer, folder, server;
before(async () => {
  outer = folderWith({ 'secret.toml': `# secret words\n${bingham}`, 'inside/bingham.toml': bingham, 'inside/deep/other.toml': bingham });
  folder = join(outer, 'inside');
  symlinkSync(join(outer, 'secret.toml'), join(folder, 'link.toml'));
  symlinkSync(outer, join(folder, 'out'));
  writeFileSync(join(outer, 'numbers.csv'), '0,4711\n1,4711\n');
  symlinkSync(join(outer, 'numbers.csv'), join(folder, 'link.csv'));
  for (const name of ['.env', '.hidden.toml', '.git/config.toml', '.data.csv']) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), '# hidden words\n0,4712\n1,4712\n');
  }
  writeFileSync(join(folder, 'id_rsa'), 'hidden words\n0,4712\n');
  server = await serve(folder, '--time-limit', '2', '--memory-limit', '300');
});
after(async () => {
  assert.equal(await server.stop(), 0);
  remove(outer);
});
// After each of them it answers as before.
afterEach(async () => {
  const { status, body } = await post({ task: 'show', text: bingham, file: 'bingham.toml' });
  assert.equal(status, 200);
  assert.match(body, /"kind":"done"/);
});

// A request with a path as it is, which no client tidies up.
function ask(path, { method = 'GET', headers = {}, body } = {}) {
  return new Promise((resolve, reject) => {
    const request = http.request({ host: '127.0.0.1', port: server.port, path, method, headers: { ...server.key, ...headers }, agent: false }, (response) => {
      const pieces = [];
      response.on('data', (piece) => pieces.push(piece));
      response.on('end', () => resolve({ status: response.statusCode, headers: response.headers, body: Buffer.concat(pieces).toString() }));
      response.on('error', reject);
    });
    request.on('error', reject);
    if (body !== undefined) request.write(body);
    request.end();
  });
}
const json = { 'Content-Type': 'application/json' };
const post = (value, path = '/api/task', headers = json) => ask(path, { method: 'POST', headers, body: typeof value === 'string' || Buffer.isBuffer(value) ? value : JSON.stringify(value) });
const messages = (body) => body.trim().split('\n').map((line) => JSON.parse(line));

// Sends raw bytes. Returns the answer up to the end of the connection.
function raw(bytes, patience = 15_000) {
  return new Promise((resolve) => {
    let text = '';
    const socket = net.connect(server.port, '127.0.0.1', () => socket.write(bytes));
    socket.on('data', (piece) => (text += piece));
    socket.on('close', () => resolve(text));
    socket.on('error', () => resolve(text));
    socket.setTimeout(patience, () => socket.destroy());
  });
}

test('a request for many ranges gets one short refusal', async () => {
  const Range = `bytes=${Array(2000).fill('0-').join(',')}`;
  for (const headers of [{ Range }, { Range, Authorization: 'Bearer wrong' }]) {
    const { status, body } = await ask('/api/folder', { headers });
    assert.ok(status >= 400 && status < 500, `${status}`);
    assert.ok(body.length < 1000, `${body.length} bytes`);
  }
});

test('nothing outside the folder is read', async () => {
  assert.equal((await ask('/api/scene?file=bingham.toml')).body, bingham);
  assert.equal((await ask('/api/scene?file=deep/other.toml')).status, 200);
  for (const name of ['../secret.toml', '..%2fsecret.toml', '%2e%2e/secret.toml', 'deep/../../secret.toml', join(outer, 'secret.toml'), 'link.toml', 'out/secret.toml',
    '../inside/../secret.toml', 'bingham.toml%00', '..\\secret.toml', '/etc/passwd', '', '.', 'deep', 'x'.repeat(3000), `deep/${'../'.repeat(500)}etc/passwd`]) {
    const { status, body } = await ask(`/api/scene?file=${name}`);
    assert.ok(status === 404 || status === 414 || status === 400, `${name}: ${status}`);
    assert.ok(!body.includes('secret words'));
  }
  for (const path of ['/../secret.toml', '/%2e%2e/secret.toml', '/etc/passwd', '//etc/passwd', '/api/../../secret.toml']) {
    const { status, body } = await ask(path);
    assert.ok(status >= 400, `${path}: ${status}`);
    assert.ok(!body.includes('secret words'));
  }
  const files = JSON.parse((await ask('/api/folder')).body).scenes.map(({ file }) => file);
  assert.deepEqual(files, ['bingham.toml', 'deep/other.toml']);
});

test('a netlist that is sent includes nothing from outside', async () => {
  for (const name of ['../secret.toml', 'link.toml', 'out/secret.toml', join(outer, 'secret.toml')]) {
    const { body } = await post({ task: 'show', text: `include = [${JSON.stringify(name)}]\n${bingham}`, file: 'bingham.toml' });
    const [mistakes] = messages(body);
    assert.equal(mistakes.items[0].severity, 'error', name);
    assert.match(mistakes.items[0].message, /outside|there is no file|link/);
    assert.ok(!body.includes('secret words'));
  }
  // Tables of numbers outside the folder are refused, too.
  for (const name of ['../numbers.csv', join(outer, 'numbers.csv'), 'link.csv', '/proc/self/environ', '/dev/zero']) {
    const text = bingham.replace('{ step = "10 rad/s", time = "0 s" }', `{ table = ${JSON.stringify(name)} }`);
    const { body } = await post({ task: 'csv', text, file: 'bingham.toml' });
    assert.match(body, /outside|there is no file|link/, name);
    assert.ok(!body.includes('4711'), name);
  }
  // Hidden files, and files of other kinds, are refused whether they exist or not, and no line of them comes back.
  for (const name of ['.env', '.hidden.toml', '.git/config.toml', 'deep/../.hidden.toml', '.none.toml', '.data.csv', 'id_rsa', 'deep']) {
    const asked = [`include = [${JSON.stringify(name)}]\n${bingham}`, bingham.replace('{ step = "10 rad/s", time = "0 s" }', `{ table = ${JSON.stringify(name)} }`)];
    for (const text of asked) {
      const { body } = await post({ task: 'show', text, file: 'bingham.toml' });
      const [mistakes] = messages(body);
      assert.match(mistakes.items[0].message, /hidden, and not served|only \.toml, \.csv and \.lesson files are served/, name);
      assert.doesNotMatch(body, /hidden words|4712/, name);
    }
  }
  // Messages name an included file by its path in the folder, never by its absolute path.
  writeFileSync(join(folder, 'deep/models.toml'), '[models.m]\nports = ["a"]\nelements = { m = { type = "mas", at = "a", mass = 1 } }\n');
  const mistaken = await post({ task: 'show', text: `include = ["models.toml"]\n${bingham.replace('[elements]', '[elements]\nm = { type = "m", at = "mid" }')}`, file: 'deep/x.toml' });
  assert.match(messages(mistaken.body)[0].items.map(({ text }) => text).join('\n'), /^deep\/models\.toml:3:/m);
  assert.ok(!mistaken.body.includes(outer), mistaken.body.slice(0, 300));
  rmSync(join(folder, 'deep/models.toml'));
  // The library is there, and is called by its name too.
  const library = await post({ task: 'show', text: `include = ["library/rheology.toml"]\n${bingham}`, file: 'bingham.toml' });
  assert.match(library.body, /"kind":"done"/);
  assert.ok(library.body.includes('"file":"library/rheology.toml"'));
  // The folder cannot be left through the netlist's own file name either.
  const { body } = await post({ task: 'show', text: `include = ["secret.toml"]\n${bingham}`, file: '../x.toml' });
  assert.match(body, /there is no file/);
});

const save = async (request) => {
  const { status, body } = await post(request, '/api/save');
  return { status, ...JSON.parse(body) };
};

test('nothing outside the folder is written', async () => {
  const before = readFileSync(join(outer, 'secret.toml'), 'utf8');
  for (const name of ['../new.toml', '/tmp/new.toml', 'link.toml', 'out/new.toml', 'deep/../../new.toml']) assert.ok([400, 403].includes((await save({ file: name, text: 'x' })).status), name);
  assert.equal(readFileSync(join(outer, 'secret.toml'), 'utf8'), before);
  assert.ok(!existsSync(join(outer, 'new.toml')) && !existsSync('/tmp/new.toml'));
  assert.equal((await save({ file: 'deep/new.toml', text: endless })).status, 200);
  assert.equal(readFileSync(join(folder, 'deep/new.toml'), 'utf8'), endless);
  assert.deepEqual(readdirSync(join(folder, 'deep')).sort(), ['new.toml', 'other.toml']);
  rmSync(join(folder, 'deep/new.toml'));
});

test('without the token nothing is answered but what to do', async () => {
  const no = { Authorization: '' };
  for (const path of ['/', '/?token=', `/?token=${'0'.repeat(32)}`, '/playground.js', '/licences.txt', '/none']) {
    const { status, headers, body } = await ask(path, { headers: no });
    assert.equal(status, 401, path);
    assert.match(headers['content-type'], /text\/html/);
    assert.match(body, /Open the address that <code>rheonet serve<\/code> has printed/);
    assert.ok(!headers['set-cookie']);
  }
  for (const [path, options] of [['/api/folder', {}], ['/api/scene?file=bingham.toml', {}], ['/api/task', { method: 'POST', headers: json, body: JSON.stringify({ task: 'show', text: bingham, file: 'a.toml' }) }],
    ['/api/save', { method: 'POST', headers: json, body: JSON.stringify({ file: 'new.toml', text: 'x' }) }]]) {
    for (const wrong of [no, { Authorization: `Bearer ${'0'.repeat(32)}` }, { Authorization: server.key.Authorization.slice(0, -1) }]) {
      const { status, body } = await ask(path, { ...options, headers: { ...options.headers, ...wrong } });
      assert.equal(status, 401, path);
      assert.match(JSON.parse(body).error, /the token of the address that `rheonet serve` has printed is missing/);
    }
  }
  assert.ok(!existsSync(join(folder, 'new.toml')));
  // The address opens the page; its cookie loads the page again, and opens nothing else: browsers send it to other ports too.
  const first = await ask(new URL(server.address).search.replace('?', '/?'), { headers: no });
  assert.equal(first.status, 200);
  const [cookie] = first.headers['set-cookie'];
  assert.match(cookie, /; HttpOnly; SameSite=Lax$/);
  assert.ok(!cookie.includes(server.key.Authorization.split(' ')[1]), 'the cookie is not the token');
  const again = { ...no, Cookie: `other=1; ${cookie.split(';')[0]}` };
  for (const path of ['/', '/playground.js', '/playground.css', '/licences.txt']) assert.equal((await ask(path, { headers: again })).status, 200, path);
  assert.equal((await ask('/api/folder', { headers: again })).status, 401);
  // No two servers, or starts of one, have the same.
  const other = await serve(folder);
  assert.notEqual(other.key.Authorization, server.key.Authorization);
  await other.stop();
});

test('a netlist keeps its mode when it is saved; a new one has what the umask leaves; what is read-only stays', async () => {
  const mode = (file) => statSync(join(folder, file)).mode & 0o7777;
  const umask = process.umask(0o027);
  const other = await serve(folder);
  process.umask(umask);
  const put = async (request) => {
    const response = await fetch(`${other.origin}/api/save`, { method: 'POST', headers: { ...json, ...other.key }, body: JSON.stringify(request) });
    return { status: response.status, ...(await response.json()) };
  };
  let { version } = await put({ file: 'mine.toml', text: 'first' });
  assert.equal(mode('mine.toml'), 0o640);
  for (const wanted of [0o600, 0o664, 0o755]) {
    chmodSync(join(folder, 'mine.toml'), wanted);
    ({ version } = await put({ file: 'mine.toml', text: `${wanted}`, version }));
    assert.equal(mode('mine.toml'), wanted);
  }
  chmodSync(join(folder, 'mine.toml'), 0o444);
  const refused = await put({ file: 'mine.toml', text: 'never', version });
  assert.equal(refused.status, 403);
  assert.match(refused.error, /`mine\.toml` is there already, and is not overwritten: it is read-only/);
  assert.equal(readFileSync(join(folder, 'mine.toml'), 'utf8'), `${0o755}`);
  // No temporary file is left.
  assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith('.rheonet')), []);
  rmSync(join(folder, 'mine.toml'), { force: true });
  await other.stop();
});

test('a folder that is exchanged for a link meanwhile leads nowhere', async () => {
  // `swing` is in turn a folder of the served one, and a link that leads out of it.
  const swing = join(folder, 'swing'), put_away = join(outer, 'put-away'), outside = join(outer, 'outside');
  mkdirSync(swing);
  mkdirSync(outside);
  writeFileSync(join(swing, 'a.toml'), '# inside\n');
  writeFileSync(join(outside, 'a.toml'), '# secret words\n');
  const turner = spawn('bash', ['-c', `while :; do mv -T "${swing}" "${put_away}" && ln -s "${outside}" "${swing}"; rm "${swing}"; mv -T "${put_away}" "${swing}"; done`]);
  const outcomes = { read: 0, saved: 0, refused: 0 };
  try {
    const enough = () => Math.min(...Object.values(outcomes)) >= 10;
    for (let k = 0; k < 50 || (k < 3000 && !enough()); ++k) {
      const [scene, saved, included] = await Promise.all([ask('/api/scene?file=swing/a.toml'), save({ file: `swing/n${k}.toml`, text: 'x' }),
        post({ task: 'explain', text: `include = ["swing/a.toml"]\n${bingham}`, file: 'x.toml' })]);
      assert.ok(!scene.body.includes('secret words') && !included.body.includes('secret words'));
      outcomes[saved.status === 200 ? 'saved' : 'refused']++;
      if (scene.status === 200) outcomes.read++;
    }
  } finally {
    turner.kill('SIGKILL');
    await once(turner, 'exit');
  }
  assert.deepEqual(readdirSync(outside), ['a.toml'], 'a netlist was written outside the folder');
  assert.equal(readFileSync(join(outside, 'a.toml'), 'utf8'), '# secret words\n');
  assert.ok(Object.values(outcomes).every((count) => count > 0), JSON.stringify(outcomes));
  for (const name of [swing, put_away, outside]) rmSync(name, { recursive: true, force: true });
});

test('a name that is none is told what is wrong with it', async () => {
  const part = (size) => `${'n'.repeat(size - 5)}.toml`;
  for (const [name, why] of [['', /needs a name/], ['../new.toml', /`\.\.` leads out/], ['/new.toml', /begins with `\/`/], ['link.toml', /`link\.toml` is a symbolic link, and links are not followed/], ['out/new.toml', /`out` is a symbolic link/],
    ['new.sh', /ends in \.toml, that of a lesson in \.lesson: `new\.sh\.toml`/], ['.hidden.lesson', /`\.hidden\.lesson` begins with a dot/], ['../new.lesson', /`\.\.` leads out/], ['new', /ends in \.toml/], ['deep', /ends in \.toml/], ['deep/', /name of a folder/], ['.hidden.toml', /`\.hidden\.toml` begins with a dot/], ['deep/.git/a.toml', /`\.git` begins/],
    ['no/such/a.toml', /no folder `no\/such`/], ['a\nb.toml', /`\\n` is a character/], ['a\u0000.toml', /`\\u0000`/], ['a\u001b[2J.toml', /`\\u001B`/], ['a\u202etxt.toml', /`\\u202E`/], ['a\u0085.toml', /`\\u0085`/],
    ['deep\\a.toml', /separated by `\/`/], [part(256), /has 256 bytes, and may have 255/], [`${'deep/'.repeat(300)}a.toml`, /may have 1000 bytes, not 1506/]]) {
    const { status, error } = await save({ file: name, text: 'x' });
    assert.equal(status, name === 'link.toml' ? 403 : 400, name);
    assert.match(error, why, name);
  }
  for (const name of ['a b.toml', 'µ-π.toml', 'deep/a.b.toml', part(255)]) {
    assert.equal((await save({ file: name, text: 'x' })).status, 200, name);
    assert.equal((await ask(`/api/scene?file=${encodeURIComponent(name)}`)).body, 'x', name);
    rmSync(join(folder, name));
  }
  // Invalid UTF-8 is refused in JSON and in names.
  assert.match(JSON.parse((await post(Buffer.from('{"file":"a\xff.toml","text":"x"}', 'latin1'), '/api/save')).body).error, /UTF-8/);
  assert.equal((await ask('/api/scene?file=a%ff.toml')).status, 404);
  for (const [request, why] of [[{ text: 'x' }, /no name/], [{ file: 1, text: 'x' }, /no name/], [{ file: 'a.toml' }, /no text/]]) {
    const { status, error } = await save(request);
    assert.equal(status, 400);
    assert.match(error, why);
  }
});

test('what nobody has seen is not overwritten', async () => {
  const file = 'deep/mine.toml';
  const on_disk = () => readFileSync(join(folder, file), 'utf8');
  const { status, version: first } = await save({ file, text: 'first' });
  assert.equal(status, 200);
  const { headers } = await ask(`/api/scene?file=${file}`);
  assert.equal(headers.etag, `"${first}"`);
  for (const version of [undefined, '', 'other', `${first}0`]) {
    const answer = await save({ file, text: 'second', version });
    assert.equal(answer.status, 409);
    assert.match(answer.error, version ? /has changed since/ : /there is already a netlist `deep\/mine\.toml`/);
    assert.equal(answer.version, first);
    assert.equal(on_disk(), 'first');
  }
  const { status: over, version: second } = await save({ file, text: 'second', version: first });
  assert.equal(over, 200);
  assert.equal(on_disk(), 'second');
  assert.equal((await save({ file, text: 'third', version: first })).status, 409);
  // One of two simultaneous requests is too late.
  const both = await Promise.all(['third', 'fourth'].map((text) => save({ file, text, version: second })));
  assert.deepEqual(both.map(({ status: one }) => one).sort(), [200, 409]);
  const ended = both.find(({ status: one }) => one === 200).version;
  assert.equal((await ask(`/api/scene?file=${file}`)).headers.etag, `"${ended}"`);
  // One that was taken away is made anew.
  rmSync(join(folder, file));
  assert.equal((await save({ file, text: 'fifth', version: second })).status, 200);
  assert.equal(on_disk(), 'fifth');
  rmSync(join(folder, file));
});

test('other pages cannot use it', async () => {
  const to = `127.0.0.1:${server.port}`;
  const status = async (headers, options = {}) => (await ask('/api/folder', { ...options, headers })).status;
  assert.equal(await status({ Host: to }), 200);
  assert.equal(await status({ Host: `localhost:${server.port}` }), 200);
  for (const host of ['evil.example', `evil.example:${server.port}`, 'localhost.evil.example', '127.0.0.1.evil.example', '10.0.0.1', '[', '::1:80'])
    assert.equal(await status({ Host: host }), 403, host);
  assert.match(await raw('GET /api/folder HTTP/1.1\r\n\r\n'), /^HTTP\/1\.1 403/);
  assert.equal(await status({ Host: to, Origin: `http://${to}` }), 200);
  for (const origin of ['http://evil.example', 'null', `https://${to}`, 'http://127.0.0.1:1']) assert.equal(await status({ Host: to, Origin: origin }), 403, origin);
  for (const site of ['cross-site', 'same-site']) assert.equal(await status({ Host: to, 'Sec-Fetch-Site': site }), 403, site);
  // Nothing tells a browser to let another page send the token's header, or read an answer.
  const asked = await ask('/api/folder', { method: 'OPTIONS', headers: { Host: to, Origin: 'http://evil.example', 'Access-Control-Request-Headers': 'authorization' } });
  assert.equal(asked.status, 403);
  for (const { headers } of [asked, await ask('/api/folder'), await ask('/')]) assert.ok(!Object.keys(headers).some((name) => name.startsWith('access-control')));
  // The content types that a form of another page can send are refused.
  assert.equal((await post({ task: 'show', text: bingham, file: 'a.toml' }, '/api/task', { 'Content-Type': 'text/plain' })).status, 403);
  const page = await ask('/');
  assert.match(page.headers['content-security-policy'], /default-src 'none'.*frame-ancestors 'none'/);
});

test('bodies that are too large or no JSON are refused', async () => {
  const large = JSON.stringify({ task: 'show', file: 'a.toml', text: '#'.repeat(1 << 20) });
  const { status } = await post(large).catch(() => ({ status: 413 }));
  assert.equal(status, 413);
  // In pieces whose sum nobody says beforehand.
  const piece = `8000\r\n${'x'.repeat(0x8000)}\r\n`;
  const answer = await raw(`POST /api/task HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: ${server.key.Authorization}\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n${piece.repeat(200)}`);
  assert.ok(answer === '' || /^HTTP\/1\.1 4/.test(answer), answer.slice(0, 100));
  for (const body of ['', '{', '[]', '1', 'null', '"x"', '{}', '{"task":"show"}', '{"task":"show","text":1}', '{"task":["show"],"text":""}', '{"task":"show","text":"\\ud800"}',
    '{"task":"figure","scenes":[],"curves":[]}', '{"task":"report","scenes":[{}]}', '{"task":"figure","scenes":[{"text":""}]}', '{"task":"figure","scenes":[{"text":"","curves":[[1,2]]}]}',
    `{"task":"figure","scenes":[{"text":"","curves":[{"x":"time","y":"a","panel":0,"color":"url(//x)","dashes":"","x_unit":{"name":"s","factor":1},"y_unit":{"name":"m","factor":1}}]}]}`,
    `{"task":"figure","scenes":[{"text":"","curves":[{"x":"time","y":"a","panel":0,"color":"#000000","dashes":"","x_unit":{"name":"s","factor":0},"y_unit":{"name":"m","factor":1}}]}]}`, '[' .repeat(100_000), '{"a":'.repeat(50_000), '\xff\xfe', '\0'])
    assert.equal((await post(body)).status, 400, body.slice(0, 60));
  for (const head of ['GET', 'GET / HTTP/9.9\r\n\r\n', '\0\0\0\0\r\n\r\n', `GET /${'x'.repeat(20_000)} HTTP/1.1\r\n\r\n`, `GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n${'A: b\r\n'.repeat(1000)}X: ${'y'.repeat(10_000)}\r\n\r\n`,
    `POST /api/task HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: ${server.key.Authorization}\r\nContent-Type: application/json\r\nContent-Length: -5\r\n\r\n`, `POST /api/task HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: ${server.key.Authorization}\r\nContent-Type: application/json\r\nContent-Length: 99999999999999999999\r\n\r\nx`])
    assert.ok(!/ 200 /.test((await raw(head, 1000)).slice(0, 20)), head.slice(0, 40));
  const zipped = await ask('/api/task', { method: 'POST', headers: { ...json, 'Content-Encoding': 'gzip' }, body: 'x' });
  assert.equal(zipped.status, 403);
});

test('netlists that are no good are answered with what is wrong', async () => {
  for (const text of ['', '\0', '= = =', '['.repeat(100_000), 'a = '.concat('['.repeat(10_000)), 'a.'.repeat(20_000), bingham.replace('"spring"', '"sprong"'), '\u{10ffff}', `title = ${'"'.repeat(9)}`]) {
    const [mistakes] = messages((await post({ task: 'show', text, file: 'a.toml' })).body);
    assert.equal(mistakes.kind, 'mistakes');
    assert.ok(mistakes.items.some(({ severity }) => severity === 'error'), text.slice(0, 30));
  }
});

test('a scene that never ends is ended, and says so', async () => {
  const last = messages((await post({ task: 'show', text: endless, file: 'a.toml' })).body).at(-1);
  assert.equal(last.kind, 'failed');
  assert.match(last.message, /longer than the 2 s/);
  const csv = messages((await post({ task: 'csv', text: endless, file: 'a.toml' })).body).at(-1);
  assert.match(csv.message, /longer than the 2 s/);
});

test('a scene that takes too much memory ends alone', async () => {
  const huge = (count) => `[elements]
chain = { type = "spring", between = ["a", "ground"], stiffness = 1, repeat = { count = ${count}, as = "i", arrange = "series" } }
drive = { type = "motion", at = "a", velocity = 1 }
[simulate]
stop = 1
`;
  for (const count of [200_000, 5_000_000, 2_000_000_000]) {
    const told = messages((await post({ task: 'show', text: huge(count), file: 'a.toml' })).body);
    const failed = told.find(({ kind }) => kind === 'failed');
    const mistake = told.find(({ kind }) => kind === 'mistakes')?.items.find(({ severity }) => severity === 'error');
    assert.match(failed?.message ?? mistake?.message ?? '', /MB of memory|longer than|elements|count|at most|must/, String(count));
  }
  const rows = bingham.replace('every = "1 ms"', 'points = 100000000');
  const told = messages((await post({ task: 'csv', text: rows, file: 'a.toml' })).body);
  assert.ok(told.at(-1).kind === 'failed' || told.at(-1).items?.length > 0, JSON.stringify(told.at(-1)).slice(0, 100));
});

test('a result that is too large is not sent, and says how large it is', async () => {
  const rows = async (megabytes) => {
    const other = await serve(folder, '--memory-limit', megabytes, '--time-limit', '60');
    const text = bingham.replace('every = "1 ms"', 'points = 2000001');
    const response = await fetch(`${other.origin}/api/task`, { method: 'POST', headers: { ...json, ...other.key }, body: JSON.stringify({ task: 'csv', text, file: 'a.toml' }) });
    const told = messages(await response.text());
    await other.stop();
    return told;
  };
  assert.match((await rows('100')).at(-1).message, /needs more than the 100 MB of memory/);
  const told = await rows('4000');
  const found = /comes to (\d+) MB so far, and a page may have 64 MB: record fewer quantities, or at fewer output times/.exec(told.at(-1).message);
  assert.ok(Number(found?.[1]) > 64, told.at(-1).message);
  assert.ok(!told.some(({ kind }) => kind === 'file'));
});

const children = (parent) => readdirSync('/proc').filter((name) => /^\d+$/.test(name) && (() => {
  try {
    return readFileSync(`/proc/${name}/stat`, 'utf8').replace(/^.*\) /, '').split(' ')[1] === String(parent);
  } catch {
    return false;
  }
})());

test('how the process of a run has ended is said, and those that had nothing to do are replaced', async () => {
  for (const [signal, why] of [['SIGSEGV', /ended by signal 11 \(Segmentation fault\)/], ['SIGKILL', /ended by signal 9 \(Killed\)/]]) {
    const asked = post({ task: 'show', text: endless, file: 'a.toml' });
    await new Promise((resolve) => setTimeout(resolve, 500));
    children(server.process.pid).forEach((id) => process.kill(Number(id), signal));
    const last = messages((await asked).body).at(-1);
    assert.equal(last.kind, 'failed');
    assert.match(last.message, why);
    assert.match((await post({ task: 'show', text: bingham, file: 'a.toml' })).body, /"kind":"done"/);
  }
});

test('a run is charged for its CPU time, not for waiting', async () => {
  const stopped = (signal) => children(server.process.pid).forEach((id) => process.kill(Number(id), signal));
  const asked = post({ task: 'show', text: bingham.replace('stop   = "0.2 s"', 'stop = "20 s"'), file: 'a.toml' });
  stopped('SIGSTOP');
  await new Promise((resolve) => setTimeout(resolve, 2500)); // more than the 2 s that a run may take
  stopped('SIGCONT');
  assert.match((await asked).body, /"kind":"done"/);
});

test('runs that never end make way for others', async () => {
  const other = await serve(folder, '--time-limit', '30');
  const show = async (text, session) => {
    const response = await fetch(`${other.origin}/api/task`, { method: 'POST', headers: { ...json, ...other.key }, body: JSON.stringify({ task: 'show', text, file: 'a.toml', session }) });
    return messages(await response.text()).at(-1);
  };
  const ended = [];
  const many = Array.from({ length: 60 }, (_, k) => show(endless, `session ${k}`).then((last) => ended.push(last.message), () => {}));
  await new Promise((resolve) => setTimeout(resolve, 200));
  for (let k = 0; k < 5; ++k) {
    assert.equal((await show(bingham, 'honest')).kind, 'done');
    // No request waited until one of these runs reached its limit. Some runs continue; those without room end with a message.
    assert.ok(ended.every((message) => /too many others are simulating for a run that takes longer/.test(message)), ended.at(-1));
    assert.ok(ended.length < 60);
  }
  await other.stop();
  await Promise.all(many);
});

test('a newer request of a session ends the older', async () => {
  const older = post({ task: 'show', text: endless, file: 'a.toml', session: 'one' });
  await new Promise((resolve) => setTimeout(resolve, 300));
  const newer = messages((await post({ task: 'show', text: bingham, file: 'b.toml', session: 'one' })).body);
  assert.equal(newer.at(-1).kind, 'done');
  const ended = messages((await older).body);
  assert.ok(!ended.some(({ kind, message }) => kind === 'done' || /longer than/.test(message)), 'the older one went on');
  // An older one that is late does not end the newer one.
  const running = post({ task: 'show', text: endless, file: 'a.toml', session: 'one', turn: 2 });
  await new Promise((resolve) => setTimeout(resolve, 300));
  assert.equal((await post({ task: 'show', text: bingham, file: 'b.toml', session: 'one', turn: 1 })).status, 409);
  assert.match(messages((await running).body).at(-1).message, /longer than/);
  // One of another session does not.
  const [first, second] = await Promise.all(['two', 'three'].map((session) => post({ task: 'show', text: bingham, file: 'a.toml', session })));
  assert.match(first.body, /"kind":"done"/);
  assert.match(second.body, /"kind":"done"/);
});

test('two hundred at once are all answered, as one alone is', async () => {
  const request = { task: 'csv', text: bingham, file: 'bingham.toml' };
  const alone = messages((await post(request)).body).at(-1).text;
  const { stdout } = await rheonet(['run', '-q', 'bingham.toml'], { cwd: folder });
  assert.equal(alone, stdout);
  const all = await Promise.all(Array.from({ length: 200 }, () => post(request)));
  for (const { status, body } of all) {
    assert.equal(status, 200);
    assert.equal(messages(body).at(-1).text, alone);
  }
});

test('slow clients, and those that go away, keep nobody waiting', async () => {
  const head = `POST /api/task HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: ${server.key.Authorization}\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n`;
  const sockets = Array.from({ length: 120 }, (_, k) => {
    const socket = net.connect(server.port, '127.0.0.1');
    socket.on('error', () => {});
    const bytes = k % 2 ? head : 'GET / HTTP/1.1\r\n';
    let sent = 0;
    socket.timer = setInterval(() => socket.write(bytes[Math.min(sent++, bytes.length - 1)]), 100);
    socket.ended = new Promise((resolve) => socket.on('close', resolve));
    return socket;
  });
  // They ask for a run that never ends, and leave; or stay, and read nothing.
  const body = JSON.stringify({ task: 'show', text: endless, file: 'a.toml' });
  const ask = `POST /api/task HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: ${server.key.Authorization}\r\nContent-Type: application/json\r\nContent-Length: ${body.length}\r\n\r\n${body}`;
  for (let k = 0; k < 10; ++k) {
    const socket = net.connect(server.port, '127.0.0.1', () => socket.write(ask, () => socket.destroy()));
    socket.on('error', () => {});
  }
  const deaf = net.connect(server.port, '127.0.0.1', () => deaf.write(ask.replace(endless, bingham)));
  deaf.pause();
  deaf.on('error', () => {});
  const { body: answer } = await post({ task: 'show', text: bingham, file: 'bingham.toml' });
  assert.match(answer, /"kind":"done"/);
  // A request that does not come to its end is given up.
  await Promise.race(sockets.map((socket) => socket.ended));
  sockets.forEach((socket) => {
    clearInterval(socket.timer);
    socket.destroy();
  });
  deaf.destroy();
});

test('it ends with 0 while a client is still asking', async () => {
  const other = await serve(folder);
  const socket = net.connect(other.port, '127.0.0.1', () => socket.write('GET / HTTP/1.1\r\n'));
  socket.on('error', () => {});
  await once(socket, 'connect');
  // Connections are taken in their order: once this one is answered the other one is being read.
  await fetch(other.origin);
  assert.equal(await other.stop(), 0);
  socket.destroy();
});

test('it leaves no process behind', async () => {
  const other = await serve(folder);
  const workers = children(other.process.pid);
  assert.ok(workers.length >= 2);
  other.process.removeAllListeners('exit');
  const gone = new Promise((resolve) => other.process.on('exit', resolve));
  other.process.kill('SIGKILL');
  await gone;
  const alive = () => workers.filter((name) => {
    try {
      return !/\) Z /.test(readFileSync(`/proc/${name}/stat`, 'utf8'));
    } catch {
      return false;
    }
  });
  for (let k = 0; k < 100 && alive().length; ++k) await new Promise((resolve) => setTimeout(resolve, 50));
  assert.deepEqual(alive(), []);
});
