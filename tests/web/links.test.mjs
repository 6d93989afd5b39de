// Links: how short they are, that old ones still open, and their QR code.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';
import { netlist, number, redrawn, setUp } from './desk.mjs';
import { networkInterfaces } from 'node:os';
import { accessible, bingham, done, folderWith, remove, serve } from './support.mjs';

const teaching = join(dirname(fileURLToPath(import.meta.url)), '../../netlists/teaching');
const demos = readdirSync(teaching).filter((name) => name.endsWith('.toml'));
const desk = setUp({ 'bingham.toml': bingham, ...Object.fromEntries(demos.map((name) => [`teaching/${name}`, readFileSync(join(teaching, name), 'utf8').replace(/^include.*$/m, '')])) });
const { open } = desk;

const linkOf = async (page) => {
  await page.locator('button', { hasText: 'Link' }).click();
  await page.waitForFunction(() => location.hash.startsWith('#s='));
  return page.evaluate(() => location.hash);
};

// As the page made links before it had dictionaries.
const oldLink = (value) => `#scene=${deflateRawSync(JSON.stringify(value)).toString('base64url')}`;

test('a link from before there were dictionaries opens', async () => {
  const text = bingham.replace('2 N*m', '4 N*m');
  const { page, close } = await open(oldLink({ scenes: [{ text, file: 'mine.toml' }], plots: { kind: 'phase', owner: null, chosen: null } }));
  assert.equal(await netlist(page), text);
  assert.equal(await page.locator('.plot-head input:checked').inputValue(), 'phase');
  await close();
});

test('a link that unpacks to very much is refused', async () => {
  const { page, close } = await open(oldLink({ scenes: [{ text: '#'.repeat(20 << 20), file: 'mine.toml' }], plots: {} }), {}, () => true);
  await page.waitForFunction(() => /The link cannot be read/.test(document.querySelector('.status').textContent));
  await close();
});

test('the link of a demonstration with another value has less than 150 characters', async () => {
  for (const [name, value] of [['bingham.toml', '1.25'], ['oscillator-forced.toml', '1.25'], ['stick-slip.toml', '45']]) {
    const { page, close } = await open(`#file=teaching/${name}`);
    const knob = page.locator('.slider input[type="text"]').first();
    await redrawn(page, () => knob.fill(value).then(() => knob.press('Enter')));
    const link = await linkOf(page);
    const before = oldLink({ scenes: [{ text: await netlist(page), file: name }], plots: {} });
    assert.ok(link.length < 150 && before.length > 1000, `${name}: ${link.length} now, ${before.length} before`);
    const text = await netlist(page);
    await close();
    const other = await open(link);
    assert.equal(await netlist(other.page), text);
    await other.close();
  }
});

test('two scenes that are compared are both in the link', async () => {
  const { page, close } = await open();
  await page.getByRole('button', { name: 'Compare' }).click();
  await redrawn(page, () => number(page, 'parameters.Tc').fill('5').then(() => number(page, 'parameters.Tc').press('Enter')));
  const link = await linkOf(page);
  await close();
  const other = await open(link);
  await other.page.locator('.variants label').first().click();
  assert.match(await netlist(other.page), /Tc = "2 N\*m"/);
  await other.page.locator('.variants label').nth(1).click();
  assert.match(await netlist(other.page), /Tc = "5 N\*m"/);
  await other.close();
});

test('the QR code holds the address', async () => {
  const { page, close } = await open();
  await page.locator('button', { hasText: 'Export' }).click();
  await page.getByRole('menuitem', { name: 'Link as a QR code' }).click();
  const address = page.url();
  const path = await page.locator('.qr path').nth(1).getAttribute('d');
  const drawn = new Set([...path.matchAll(/M(\d+) (\d+)h1v1h-1z/g)].map(([, x, y]) => `${x - 4} ${y - 4}`));
  const { encode } = createRequire(join(process.env.NODE_PACKAGES, 'package.json'))('uqr');
  const { data } = encode(address, { ecc: 'L', border: 0 });
  const expected = data.flatMap((row, y) => row.flatMap((dark, x) => (dark ? [`${x} ${y}`] : [])));
  assert.deepEqual([...drawn].sort(), expected.sort());
  assert.match(await page.textContent('dialog[open]'), new RegExp(`The link has ${address.length} characters[^]*Only this machine can open this address`));
  await accessible(page, 'QR code');
  await close();
});

test('the code for another page shows the scene in a frame', async () => {
  const { page, close } = await open();
  await page.locator('button', { hasText: 'Export' }).click();
  await page.getByRole('menuitem', { name: 'Code for another page' }).click();
  const code = await page.getByLabel('Code for another page').last().inputValue();
  const [, from] = /^<iframe src="([^"]+)"/.exec(code);
  assert.equal(from, page.url().replace(/#/, '?embed#'));
  await accessible(page, 'Code for another page');
  await page.goto(from);
  await page.locator('.embedded .plots canvas').first().waitFor();
  await close();
});

test('the link of a server for others opens in a fresh browser, which saves nothing in the folder', async (test) => {
  const near = Object.values(networkInterfaces()).flat().find(({ family, internal }) => family === 'IPv4' && !internal);
  if (!near) return test.skip('this machine has no network');
  const folder = folderWith({ 'bingham.toml': bingham });
  const server = await serve(folder, '--host', '0.0.0.0');
  const own = await desk.chromium.newContext({ permissions: ['clipboard-read', 'clipboard-write'] });
  const page = await own.newPage();
  await page.goto(`${server.address}#file=bingham.toml`);
  await done(page);
  await linkOf(page);
  await page.waitForFunction(() => /The link is copied/.test(document.querySelector('.toast').textContent));
  assert.doesNotMatch(await page.textContent('.toast'), /Only this machine/);
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(link, new RegExp(`^http://[\\d.]+:${server.port}/\\?guest=\\w{32}#s=`));
  await own.close();
  const fresh = await desk.chromium.newContext();
  const student = await fresh.newPage();
  await student.goto(link);
  await done(student);
  assert.equal(await netlist(student), bingham);
  await student.reload();
  await done(student);
  // Here the browser gives no clipboard: the address of the page is the link.
  await student.locator('button', { hasText: 'Link' }).click();
  await student.waitForFunction(() => /The (address|link)/.test(document.querySelector('.toast').textContent));
  assert.match(student.url(), /\?guest=\w{32}#s=/);
  await student.locator('button', { hasText: 'Save' }).click();
  assert.deepEqual(await student.locator('.menu-list:visible button').allTextContents(), ['Download the netlist', 'Make a lesson']);
  const { searchParams } = new URL(link);
  const answer = await fetch(`${server.origin}/api/save`, { method: 'POST', headers: { Authorization: `Bearer ${searchParams.get('guest')}`, 'Content-Type': 'application/json' }, body: JSON.stringify({ file: 'new.toml', text: bingham }) });
  assert.equal(answer.status, 403);
  assert.deepEqual(readdirSync(folder), ['bingham.toml']);
  assert.equal((await fetch(`${server.origin}/?guest=${'0'.repeat(32)}`)).status, 401);
  assert.equal((await fetch(`${server.origin}/?guest=`)).status, 401);
  await fresh.close();
  await server.stop();
  remove(folder);
});

test('where only this machine can open the link, the page says so when it copies it', async () => {
  const { page, close } = await open('#file=bingham.toml', { permissions: ['clipboard-read', 'clipboard-write'] });
  await linkOf(page);
  await page.waitForFunction(() => /The link is copied: .* Only this machine can open this address/.test(document.querySelector('.toast').textContent));
  await close();
});
