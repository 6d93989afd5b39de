// The site in a browser, from a static host and from disk: all that it does, it does in the page.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { netlist, number, redrawn, shows, slider } from '../web/desk.mjs';
import { accessible, browser, done, watched } from '../web/support.mjs';
import { host, oneFile, site } from './page.mjs';

let chromium;
let hosted;
before(async () => {
  chromium = await browser();
  hosted = await host();
});
after(async () => {
  await chromium.close();
  await hosted.stop();
});

// A page of the site; with `cut` without any network. `close` fails if anything was wrong with it.
async function open(address, { cut = false, ...options } = {}) {
  const context = await chromium.newContext({ viewport: { width: 1500, height: 950 }, acceptDownloads: true, offline: cut, ...options });
  const { page, wrong } = await watched(context, cut ? 'file' : hosted.origin);
  await page.goto(address);
  if (address.includes('#')) await done(page);
  const close = async () => {
    assert.deepEqual(wrong, []);
    await context.close();
  };
  return { page, context, close };
}

async function exported(page, label) {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Export' }).click();
  await page.getByRole('menuitem', { name: label }).click();
  return readFileSync(await (await download).path(), 'utf8');
}

test('it is small', () => {
  const compressed = (name) => gzipSync(readFileSync(join(site, name)), { level: 9 }).length;
  const parts = ['index.html', 'playground.css', 'playground.js', 'worker.js.gz', 'rheonet.wasm.gz', 'netlists.json.gz'];
  assert.ok(parts.reduce((sum, name) => sum + compressed(name), 0) < 2e6);
  assert.ok(compressed('rheonet.html') < 2e6);
});

for (const [what, address, cut] of [['a static host', () => hosted.address, false], ['disk, without a network', () => oneFile, true]]) {
  test(`from ${what}: gallery, sliders, text, comparison, animation, exports, reports, links`, async () => {
    const begun = performance.now();
    const { page, context, close } = await open(address(), { cut });
    await page.waitForSelector('dialog.gallery[open] .card svg');
    const took = performance.now() - begun;
    assert.ok(took < 10_000, `the first picture took ${took} ms`);
    assert.ok((await page.locator('.card').count()) > 80);
    await accessible(page, 'gallery');
    await page.locator('.gallery input').fill('bingham yields');
    await page.locator('.card:visible').first().click();
    // Its card opens its lesson.
    await page.getByRole('radio', { name: /falls, but not to 0/ }).check();
    await page.getByRole('button', { name: 'Compare with the run' }).click();
    assert.match(await page.textContent('.lesson-steps'), /That is what happens\./);
    await page.getByRole('button', { name: 'Leave the lesson' }).click();
    await done(page);
    assert.equal(await page.textContent('.question'), 'Paint runs down the wall while it is brushed, and then stays. What makes a liquid hold still?');

    // The force of the spring in the end is the yield force.
    await shows(page, 0.99, 'spring.force', 5, 2e-2);
    await redrawn(page, () => number(page, 'parameters.Fc').fill('3').then(() => number(page, 'parameters.Fc').press('Enter')));
    await shows(page, 0.99, 'spring.force', 3, 2e-2);
    assert.match(await netlist(page), /Fc = "3 N"/);
    await redrawn(page, () => slider(page, 'parameters.Fc').focus().then(() => page.keyboard.press('ArrowRight')));

    await page.getByRole('button', { name: 'Compare' }).click();
    await done(page);
    await redrawn(page, () => number(page, 'parameters.Fc').fill('6').then(() => number(page, 'parameters.Fc').press('Enter')));
    await shows(page, 0.99, 'B spring.force', 6, 2e-2);
    await page.getByRole('button', { name: '▶ Play' }).click();
    await page.waitForFunction(() => Number(document.querySelector('.animation > input').value) > 10);
    await page.getByRole('button', { name: /Pause/ }).click();

    assert.match(await exported(page, 'Rows (CSV)'), /^time,grip\.position,mid\.position,spring\.force\n0,0,0,0\n/);
    assert.match(await exported(page, 'Plots (SVG)'), /<svg .*B spring\.force.*<\/svg>\s*$/s);
    const report = await exported(page, 'Report (HTML)');
    assert.match(report, /Bingham: what yields, and when/);
    assert.match(report.slice(0, report.indexOf('</head>')), /@font-face ?\{[^}]*KaTeX_Main[^}]*url\("?data:font\/woff2;base64,.{1000}/s);

    await page.getByRole('button', { name: 'Link' }).click();
    await page.waitForFunction(() => location.hash.startsWith('#s='));
    const link = page.url();
    const other = await open(link, { cut });
    assert.match(await netlist(other.page), /Fc = "6 N"/);
    await other.close();
    assert.equal(context.pages().length, 1);
    await close();
  });
}

test('from disk: a lesson is made of a netlist, edited, and opens from its link', async () => {
  const { page, close } = await open(`${oneFile}#file=teaching/bingham.toml`, { cut: true });
  await page.getByRole('button', { name: 'Save ▾' }).click();
  await page.getByRole('menuitem', { name: 'Edit the lesson' }).click();
  const form = page.locator('dialog.lesson-form[open]');
  await form.getByRole('textbox', { name: 'Answer' }).nth(1).fill('It falls to the force of the slider.');
  await form.getByRole('textbox', { name: 'Its curve' }).nth(0).fill('5 m');
  const show = form.getByRole('button', { name: 'See it as a student' });
  await show.click();
  await form.getByText('expected a force (N), found a length (m)').waitFor();
  await form.getByRole('textbox', { name: 'Its curve' }).nth(0).fill('');
  await show.click();
  await page.locator('.choices').waitFor();
  await page.getByRole('button', { name: 'Link', exact: true }).click();
  await page.waitForFunction(() => location.hash.startsWith('#s='));
  const link = page.url();
  await page.getByRole('button', { name: 'Save ▾' }).click();
  assert.deepEqual(await page.getByRole('menuitem').allTextContents(), ['Download the netlist', 'Download the lesson', 'Edit the lesson']);
  await close();
  const other = await open(link, { cut: true });
  assert.equal(await other.page.locator('.plots-box').isVisible(), false);
  await other.page.getByRole('radio', { name: 'It falls to the force of the slider.' }).check();
  await other.page.getByRole('button', { name: 'Compare with the run' }).click();
  await other.page.getByText('That is what happens.').waitFor();
  assert.ok(await other.page.locator('.presets button', { hasText: 'as at first' }).isVisible());
  await other.close();
});

test('an element is drawn, its card has law and fields, and rheonet checks them, without a server', async () => {
  const { page, close } = await open(`${hosted.address}#file=teaching/stick-slip.toml`);
  await page.getByRole('button', { name: 'Draw', exact: true }).click();
  await page.locator('.palette-type[data-type="spring"]').click();
  await page.locator('.end-handle[data-at="belt"]').first().click();
  await redrawn(page, () => page.locator('.prompt').getByRole('button', { name: 'ground', exact: true }).click());
  assert.match(await netlist(page), /^spring1 = \{ type = "spring", between = \["belt", "ground"\], stiffness = "100 N\/m" \}$/m);
  await page.locator('.inspector .katex').waitFor();
  await page.locator('.inspector').getByLabel('stiffness k').fill('3 kg');
  await page.keyboard.press('Tab');
  await page.locator('.inspector-wrong p', { hasText: 'expected a stiffness (N/m)' }).waitFor();
  // The schema is that of the program.
  await page.locator('.cm-line', { hasText: '[simulate]' }).click();
  await page.keyboard.press('End');
  await page.keyboard.type('\nstart_');
  await page.locator('.cm-tooltip-autocomplete li', { hasText: 'start_from' }).waitFor();
  await close();
});

test('embedded: the scene of a link, its schematic, sliders and plots, and a way to all of it', async () => {
  const { page, close } = await open(`${hosted.address}?embed#file=teaching/bingham.toml`, { viewport: { width: 700, height: 600 } });
  for (const part of ['.schematic-box', '.sliders-box', '.plots-box']) assert.ok(await page.locator(part).isVisible(), part);
  for (const part of ['.editor-box', '.actions', '.more-box']) assert.ok(!(await page.locator(part).isVisible()), part);
  assert.equal(await page.locator('dialog[open]').count(), 0);
  assert.equal(await page.getByRole('link', { name: 'Open in the playground' }).getAttribute('href'), `${hosted.address}#file=teaching/bingham.toml`);
  await close();
});

test('embedded in a page of another origin: the scene runs in its frame', async () => {
  const context = await chromium.newContext({ viewport: { width: 900, height: 700 } });
  const { page, wrong } = await watched(context, hosted.origin);
  // `localhost` is another site than 127.0.0.1.
  const school = createServer((_, response) => response.writeHead(200, { 'Content-Type': 'text/html' })
    .end(`<!doctype html><title>A lesson</title><iframe title="rheonet" width="800" height="600" src="${hosted.address}?embed#file=teaching/bingham.toml"></iframe>`));
  await new Promise((resolve) => school.listen(0, 'localhost', resolve));
  await page.goto(`http://localhost:${school.address().port}/`);
  const frame = page.frameLocator('iframe');
  await frame.locator('.plots .chart canvas').first().waitFor();
  await frame.locator('[data-slider="parameters.Fc"] input[type="text"]').fill('3');
  await frame.locator('[data-slider="parameters.Fc"] input[type="text"]').press('Enter');
  await frame.locator('.drawing', { hasText: '3 N' }).waitFor();
  assert.deepEqual(wrong.filter((each) => !each.includes('localhost')), []);
  await context.close();
  school.close();
});

test('what takes many runs: effects, price of accuracy, sweep', async () => {
  const { page, close } = await open(`${hosted.address}#file=teaching/inertia.toml`);
  const unfold = (name) => page.locator(`.sections details[data-name="${name}"] summary`).first().click();
  await unfold('Effects');
  await page.locator('[data-name="Effects"] .finding').waitFor();
  assert.match(await page.textContent('[data-name="Effects"] .finding'), /^To 1 % this scene needs/);
  await unfold('Price of accuracy');
  await page.locator('[data-name="Price of accuracy"] .finding').waitFor();
  assert.match(await page.textContent('[data-name="Price of accuracy"] .finding'), /Accuracy costs nothing here/);
  assert.equal(await page.locator('[data-name="Price of accuracy"] .chart.loop').count(), 1); // there is no clock of CPU time
  await unfold('Sweep');
  await page.getByLabel('runs').fill('5');
  await page.getByLabel('runs').press('Tab');
  await page.getByRole('button', { name: 'Run the sweep' }).click();
  await page.getByText('5 of 5 runs').waitFor();
  await close();
});

test('the drawing of a scene of more than 60 elements moves too', async () => {
  const { page, close } = await open(`${hosted.address}#file=teaching/couette-lag.toml`);
  const places = () => page.evaluate(() => [...document.querySelectorAll('.drawing [data-element] path:first-of-type')].map((path) => path.getAttribute('d')));
  await page.locator('.animation > input').fill('900');
  const late = await places();
  await page.locator('.animation > input').fill('300');
  const early = await places();
  assert.ok(late.filter((place, k) => place !== early[k]).length > 10);
  await close();
});

test('from disk on a phone', async () => {
  const { page, close } = await open(`${oneFile}#file=teaching/stick-slip.toml`, { cut: true, viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
  assert.ok(await page.locator('.drawing [data-element]').count());
  await close();
});

test('units of the library UDUNITS-2, mistakes, and runs that never end', async () => {
  const { page, close } = await open(`${hosted.address}#file=teaching/oscillator-free.toml`);
  const write = async (text) => {
    await page.locator('.cm-content').click();
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText(text);
  };
  const scene = (stiffness, extra = '') => `[elements]
k1 = { type = "spring", between = ["block", "ground"], stiffness = "${stiffness}" }
m1 = { type = "mass", at = "block", mass = "1 kg" }
[nodes]
block = { position = "1 cm" }
[simulate]
stop = "2 s"
${extra}`;
  await redrawn(page, () => write(scene('2 kip/fathom')));
  await write(scene('2 quibble/m'));
  await page.waitForSelector('.mistake.error');
  assert.match(await page.textContent('.mistakes'), /unknown unit `quibble`/);
  // A newer text ends a run that takes long.
  await write(scene('1e15 N/m', 'accuracy = 1e-10'));
  await page.waitForTimeout(1000);
  await redrawn(page, () => write(scene('100 N/m')));
  assert.equal(await page.locator('.mistake').count(), 0);
  await close();
});

test('an address with ?present begins with all on one screen', async () => {
  const { page, close } = await open(`${hosted.address}?present#file=teaching/bingham.toml`, { viewport: { width: 1024, height: 768 } });
  assert.ok(await page.locator('.question').isVisible());
  assert.equal(await page.locator('.editor-box').isVisible(), false);
  assert.ok(await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight));
  await close();
});
