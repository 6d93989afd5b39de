// Foreign pages that embed the playground in a frame: refused unless the server's options name their origin.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { createServer } from 'node:http';
import { after, before, test } from 'node:test';
import { bingham, browser, folderWith, program, remove, serve } from './support.mjs';

// A site of its own: `localhost` is another one than 127.0.0.1, where the playground is.
let school;
let pages;
let shown = '';
let folder;
let chromium;
before(async () => {
  folder = folderWith({ 'bingham.toml': bingham });
  chromium = await browser();
  pages = createServer((_, response) => response.writeHead(200, { 'Content-Type': 'text/html' }).end(`<!doctype html><iframe width="900" height="700" src="${shown}"></iframe>`));
  await new Promise((resolve) => pages.listen(0, 'localhost', resolve));
  school = `http://localhost:${pages.address().port}`;
});
after(async () => {
  await chromium.close();
  pages.close();
  remove(folder);
});

// A page of the school with the playground of a server in a frame.
async function framed(options) {
  const server = await serve(folder, ...options);
  shown = `${server.address}&embed#file=bingham.toml`;
  const page = await chromium.newPage();
  await page.goto(`${school}/`);
  return { page, frame: page.frameLocator('iframe'), server, close: async () => {
    await page.close();
    await server.stop();
  } };
}

test('no page may show it in a frame', async () => {
  const { page, server, close } = await framed([]);
  await page.waitForTimeout(1500);
  assert.ok(!page.frames().some((frame) => frame.url().startsWith(server.origin)), page.frames().map((frame) => frame.url()).join(' '));
  const { headers } = await fetch(server.address);
  assert.match(headers.get('content-security-policy'), /frame-ancestors 'none'/);
  await close();
});

test('a page of the origin that is named shows it in a frame, where it runs', async () => {
  const { frame, server, close } = await framed(['--framed-by', school]);
  await frame.locator('.plots .chart canvas').first().waitFor();
  const number = frame.locator('[data-slider="parameters.Tc"] input[type="text"]');
  await number.fill('3');
  await number.press('Enter');
  await frame.locator('.drawing', { hasText: '3 N·m' }).waitFor();
  const { headers } = await fetch(server.address);
  assert.match(headers.get('content-security-policy'), new RegExp(`frame-ancestors ${school}$`));
  // Requests for contents of the folder still need the token.
  assert.equal((await fetch(`${server.origin}/api/folder`)).status, 401);
  assert.equal((await fetch(`${server.origin}/`)).status, 401);
  await close();
});

test('what is no origin is refused with what one looks like', () => {
  for (const wrong of ['school.example', 'http://school.example/path', "http://a; script-src 'unsafe-inline'", 'ftp://school.example']) {
    const { status, stderr } = spawnSync(program, ['serve', folder, '--port', '0', '--framed-by', wrong], { encoding: 'utf8', timeout: 20_000 });
    assert.equal(status, 2, wrong);
    assert.match(stderr, /an origin is as in https:\/\/school\.example/);
  }
});
