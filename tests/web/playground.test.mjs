// The playground, as somebody uses it.
import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { netlist, number, numbersOnCanvas, redrawn, setUp, shows, slider, stickSlip } from './desk.mjs';
import { accessible, bingham, done, rheonet, serve, watched } from './support.mjs';

// A place that needs many digits, above a velocity of few.
const wide = `[nodes]
a_place_that_is_far_from_the_origin_of_all = { position = "1000 m" }
[elements]
drive_of_the_place = { type = "motion", at = "a_place_that_is_far_from_the_origin_of_all", velocity = { sine = "1 mm/s", frequency = "2 Hz" } }
[simulate]
stop = 1
record = ["a_place_that_is_far_from_the_origin_of_all.position", "a_place_that_is_far_from_the_origin_of_all.velocity"]
`;
// One whose rows come in many parts, beside a place that tells how far the run has come.
const slow = `[elements]
shaker = { type = "motion", at = "a", velocity = { sine = "1 m/s", frequency = "300 Hz" } }
spring = { type = "spring", between = ["a", "b"], stiffness = 1e5 }
block = { type = "slider", between = ["b", "ground"], coulomb = "1 N" }
mass = { type = "mass", at = "b", mass = "10 g" }
clock = { type = "motion", at = "hand", velocity = "1 m/s" }
[simulate]
stop = 3
output = { every = "0.2 ms" }
record = ["spring.force", "hand.position"]
`;
const desk = setUp({ 'bingham.toml': bingham, 'slow.toml': slow, 'more/stick-slip.toml': stickSlip, 'wide.toml': wide });
const { open } = desk;

test('the gallery shows the netlists of the folder, and opens one', async () => {
  const { page, close } = await open('');
  await page.waitForSelector('dialog.gallery[open] .card svg');
  assert.deepEqual(await page.locator('.card-title').allTextContents(), ['Bingham element', 'slow.toml', 'wide.toml', 'Stick and slip']);
  assert.match(await page.locator('.card').nth(3).textContent(), /A block that is pulled through a spring/);
  await accessible(page, 'gallery');
  await page.locator('.gallery input').fill('stick');
  assert.equal(await page.locator('.card:visible').count(), 1);
  await page.locator('.card:visible').click();
  await page.waitForFunction(() => document.querySelector('h1').textContent === 'Stick and slip');
  await done(page);
  for (const name of ['pull', 'k1', 'm1', 's1']) assert.equal(await page.locator(`.drawing [data-element="${name}"]`).count(), 1);
  await close();
});

test('the gallery says of a netlist that cannot be read what is wrong with it first', async () => {
  writeFileSync(join(desk.folder, 'mistaken.toml'), bingham.replace('"spring"', '"sprong"').replace('"dashpot"', '"dashpod"'));
  const { page, close } = await open('');
  const card = page.locator('.card', { has: page.locator('.bad') });
  await card.waitFor();
  assert.equal(await card.count(), 1);
  assert.equal(await card.getAttribute('data-file'), 'mistaken.toml');
  assert.match(await card.textContent(), /^no schematic.*It cannot be read: 10:\d+: unknown element type sprong$/);
  await accessible(page, 'a card of a netlist with mistakes');
  await card.click();
  await page.waitForSelector('.mistake.error');
  rmSync(join(desk.folder, 'mistaken.toml'));
  await close();
});

test('a mistake is marked where it is, and what was there stays', async () => {
  const { page, close } = await open();
  await page.locator('.cm-line', { hasText: 'k1    =' }).click();
  await page.keyboard.press('Home');
  await page.keyboard.press('Control+Shift+ArrowRight');
  await page.keyboard.press('Control+End');
  await page.keyboard.type('\nstray = 1');
  // A part of the typed text may have been checked before.
  await page.locator('.mistake.error', { hasText: /^\d+:1 .*`stray`/ }).waitFor();
  await page.locator('.plots[aria-busy="false"]').waitFor();
  assert.equal(await page.locator('.mistake.error').count(), 1);
  assert.equal(await page.locator('.cm-lintRange-error').textContent(), 'stray');
  assert.equal(await page.locator('.plots.stale').count(), 1);
  assert.ok(await page.locator('.plots .chart canvas').count());
  await redrawn(page, async () => {
    // A pause in typing makes several steps of it.
    do await page.keyboard.press('Control+z');
    while (/^s/.test(await page.locator('.cm-line').last().textContent()));
  });
  assert.equal(await page.locator('.mistake, .cm-lintRange-error, .plots.stale').count(), 0);
  await close();
});

test('a run whose rows come in parts is shown to its end', async () => {
  const { page, close } = await open('#file=slow.toml');
  await shows(page, 0.999, 'hand.position', 2.997, 5e-3);
  await page.locator('.plots .chart').first().focus();
  await page.keyboard.press('+');
  await redrawn(page, async () => {
    await number(page, 'spring.stiffness').fill('9e4');
    await number(page, 'spring.stiffness').press('Enter');
  });
  // Zoomed in, the part that was looked at stays.
  await shows(page, 0.999, 'hand.position', 2.25, 0.1);
  await close();
});

test('two variants are compared', async () => {
  const { page, close } = await open();
  await page.locator('button', { hasText: 'Compare' }).click();
  await page.waitForSelector('.variants:visible');
  await redrawn(page, async () => {
    await number(page, 'parameters.Tc').fill('4');
    await number(page, 'parameters.Tc').press('Enter');
  });
  await shows(page, 0.999, 'A k1.force', 7);
  await shows(page, 0.999, 'B k1.force', 9);
  // Both schematics, A before B, move together to one scale.
  const pictures = () => page.locator('.drawings > :visible').evaluateAll((all) => all.sort((a, b) => a.getBoundingClientRect().left - b.getBoundingClientRect().left)
    .map((host) => [host.dataset.label, /s1\D*(\d+) N·m/.exec(host.textContent)?.[1], host.querySelector('.slider').classList.contains('slips')]));
  assert.deepEqual(await pictures(), [['A', '2', false], ['B', '4', false]]);
  await page.locator('.animation > input').fill('15'); // 3 ms: the spring has 3 N·m, A slips and B sticks.
  assert.deepEqual(await pictures(), [['A', '2', true], ['B', '4', false]]);
  await page.locator('summary', { hasText: 'Differences' }).click();
  await page.waitForSelector('details[data-name="Differences"] table');
  // The two are 2 N*m apart as soon as both slip.
  assert.match(await page.locator('details[data-name="Differences"]').textContent(), /A – Bk1\.force2\sN·m/);
  await page.locator('.variants label', { hasText: 'Edit A' }).click();
  assert.match(await netlist(page), /Tc = "2 N\*m"/);
  assert.deepEqual((await pictures()).map(([label, torque]) => [label, torque]), [['A', '2'], ['B', '4']]);
  await page.locator('.variants label', { hasText: 'Edit B' }).click();
  assert.match(await netlist(page), /Tc = "4 N\*m"/);
  await accessible(page, 'comparison');
  await page.locator('button', { hasText: 'End comparison' }).click();
  assert.equal(await page.locator('.u-series', { hasText: 'A k1.force' }).count(), 0);
  assert.equal((await pictures()).length, 1);
  await shows(page, 0.999, 'k1.force', 9);
  await close();
});

async function exported(page, label) {
  await page.locator('button', { hasText: 'Export' }).click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('[role="menuitem"]', { hasText: label }).click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()), path: await download.path() };
}

test('what is seen can be taken along', async () => {
  const { page, context, close } = await open();
  const { stdout } = await rheonet(['run', '-q', 'bingham.toml'], { cwd: desk.folder });
  const csv = await exported(page, 'Rows (CSV)');
  assert.equal(csv.name, 'bingham.csv');
  assert.equal(csv.bytes.toString(), stdout);
  const plots = (await exported(page, 'Plots (SVG)')).bytes.toString();
  assert.match(plots, /<svg[^]*angular velocity[^]*torque[^]*<\/svg>/);
  const drawing = (await exported(page, 'Schematic (SVG)')).bytes.toString();
  assert.match(drawing, /^<\?xml[^]*data-element="k1"[^]*100 N·m\/rad/);
  for (const label of ['Plots (PNG)', 'Schematic (PNG)']) {
    const { bytes } = await exported(page, label);
    assert.ok(bytes.subarray(1, 4).toString() === 'PNG' && bytes.length > 3000, label);
  }
  const report = await exported(page, 'Report (HTML)');
  const offline = await context.browser().newContext({ offline: true });
  const { page: opened, wrong } = await watched(offline, 'file');
  await opened.goto(pathToFileURL(report.path).href.replace(/$/, ''));
  const shown = await opened.content();
  assert.ok(shown.includes('Bingham element'));
  assert.deepEqual(wrong, []);
  await offline.close();
  await page.locator('button', { hasText: 'Save' }).click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('[role="menuitem"]', { hasText: 'Download' }).click()]);
  assert.equal(readFileSync(await download.path(), 'utf8'), bingham);
  await close();
});

test('a link carries the scene', async () => {
  const { page, close } = await open();
  await redrawn(page, async () => {
    await number(page, 'parameters.Tc').fill('6');
    await number(page, 'parameters.Tc').press('Enter');
  });
  await page.locator('.plot-head label', { hasText: 'Force against velocity' }).click();
  await page.locator('button', { hasText: 'Link' }).click();
  await page.waitForFunction(() => location.hash.startsWith('#s='));
  const link = await page.evaluate(() => location.hash);
  const text = await netlist(page);
  await close();
  const other = await open(link);
  assert.equal(await netlist(other.page), text);
  assert.match(text, /Tc = "6 N\*m"/);
  assert.equal(await other.page.locator('.plot-head input:checked').inputValue(), 'flow');
  await other.close();
  // A broken link gives a message and the first scene.
  for (const hash of ['#scene=AAAA', link.slice(0, -8), link.replace('#s=', '#s=z'), '#s=', '#s=aAAAA']) {
    const broken = await open(hash, {}, () => true);
    await broken.page.waitForFunction(() => document.querySelector('.status').dataset.latency);
    assert.match(await broken.page.textContent('.status'), /The link cannot be read/, hash);
    assert.equal(await broken.page.locator('.drawing svg').count(), 1);
    await broken.close();
  }
});

test('everything works by keyboard', async () => {
  const { page, close } = await open();
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('g');
  await page.waitForSelector('dialog.gallery[open]');
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => !document.querySelector('dialog[open]'));
  // All that can be used is reached by Tab, the editor is left by it.
  const reached = new Set();
  await page.evaluate(() => document.activeElement.blur());
  for (let k = 0; k < 70; ++k) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => {
      const at = document.activeElement;
      return at.closest('.cm-editor') ? 'editor' : at.getAttribute('aria-label') || at.textContent.trim().slice(0, 20) || at.tagName;
    }));
  }
  for (const name of ['Gallery', 'Save ▾', 'Export ▾', 'Link', 'Compare', 'editor', 'B', 'k1 stiffness', '▶ Play', 'Time'])
    assert.ok(reached.has(name), `${name} of ${[...reached].join(', ')}`);
  await slider(page, 'parameters.Tc').focus();
  await redrawn(page, () => page.keyboard.press('End'));
  await shows(page, 0.999, 'k1.force', Number(await number(page, 'parameters.Tc').inputValue()) + 5);
  await page.locator('button', { hasText: 'Export' }).focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('ArrowDown');
  assert.equal(await page.evaluate(() => document.activeElement.textContent), 'Plots (SVG)');
  await page.keyboard.press('Escape');
  assert.match(await page.evaluate(() => document.activeElement.textContent), /^Export/);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('Space');
  assert.equal(await page.locator('button.play').getAttribute('aria-pressed'), 'true');
  await page.keyboard.press('Space');
  assert.equal(await page.locator('button.play').getAttribute('aria-pressed'), 'false');
  await close();
});

test('it fits a phone, and light and dark; nobody is shut out', async () => {
  for (const [width, height, colorScheme] of [[1500, 950, 'light'], [1000, 800, 'dark'], [390, 844, 'dark'], [320, 640, 'light']]) {
    const { page, close } = await open(undefined, { viewport: { width, height }, colorScheme });
    const what = `${width} px, ${colorScheme}`;
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${what}: wider than the screen`);
    const [red] = (await page.evaluate(() => getComputedStyle(document.body).backgroundColor)).match(/\d+/g).map(Number);
    assert.ok(colorScheme === 'dark' ? red < 60 : red > 200, what);
    // The sections are rebuilt some time after each run; open ones stay open.
    await page.waitForSelector('.sections summary');
    for (const name of await page.locator('.sections summary').allTextContents()) await page.locator('.sections summary', { hasText: name }).first().click();
    await accessible(page, what);
    await close();
  }
});

test('what is simulated, and why, is said of the netlist as it is', async () => {
  const { page, close } = await open();
  await page.locator('summary', { hasText: 'What is simulated' }).click();
  const explained = page.locator('.explanation');
  await explained.waitFor();
  assert.match(await explained.textContent(), /dry friction s1/);
  await number(page, 'parameters.Tc').fill('0');
  await number(page, 'parameters.Tc').press('Enter');
  await page.waitForFunction(() => /slider s1: .*carries no force/.test(document.querySelector('.explanation').textContent));
  await close();
});

const twoMotions = '[elements]\nm1 = { type = "mass", at = "a", mass = 1 }\nx = { type = "motion", at = "a", position = 1 }\ny = { type = "motion", at = "a", position = 2 }\n[simulate]\nstop = 1\n';
const replaced = async (page, text) => {
  await page.locator('.cm-content').focus();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText(text);
};

test('a run that fails at its start says why where its curves would be', async () => {
  const { page, close } = await open();
  await replaced(page, twoMotions);
  const reason = page.locator('.plots .no-curves');
  await reason.waitFor();
  assert.match(await reason.textContent(), /does not get beyond its start\. .*x and y.* a/);
  assert.match(await page.textContent('.status'), /did not come to its end/);
  assert.equal(await page.locator('.plots .chart').count(), 0);
  assert.equal(await page.locator('button.play').isVisible(), false);
  await page.locator('details[data-name="Energy account"]').waitFor({ state: 'detached' });
  await accessible(page, 'a run that fails');
  // Beside another one it leaves that its curves.
  await replaced(page, bingham);
  await page.locator('.plots .chart').first().waitFor();
  assert.equal(await page.locator('.no-curves').count(), 0);
  await page.locator('button', { hasText: 'Compare' }).click();
  await replaced(page, twoMotions);
  await reason.waitFor();
  assert.match(await reason.textContent(), /^B: There is nothing/);
  await page.locator('.u-series', { hasText: 'A k1.force' }).waitFor();
  await close();
});

test('panels above each other have their times below each other, however wide their numbers are', async () => {
  const { page, close } = await open('#file=wide.toml');
  const lefts = await page.locator('.plots .chart .u-over').evaluateAll((all) => all.map((over) => Math.round(over.getBoundingClientRect().left)));
  assert.equal(lefts.length, 2);
  assert.equal(lefts[0], lefts[1]);
  // The numbers of one of them need more room than is there anyway.
  assert.ok(lefts[0] - (await page.locator('.plots .chart').first().boundingBox()).x > 86 + 10, String(lefts));
  await close();
});

test('names are broken between their words, and legends are no wider than their charts', async () => {
  const { page, close } = await open('#file=wide.toml', { viewport: { width: 390, height: 844 } });
  assert.equal(await page.locator('.slider-name', { hasText: 'velocity.frequency' }).evaluate((name) => name.innerHTML), 'velocity.<wbr>frequency');
  const wide = await page.locator('.chart').evaluateAll((charts) => charts.flatMap((chart) => [...chart.querySelectorAll('.u-legend, .u-series')]
    .map((part) => part.getBoundingClientRect().right - chart.getBoundingClientRect().right).filter((over) => over > 0.5)));
  assert.deepEqual(wide, []);
  await close();
});

test('a run that is cut short shows what there is of it', async () => {
  const hurried = await serve(desk.folder, '--time-limit', '1');
  const context = await desk.chromium.newContext();
  const { page, wrong } = await watched(context, hurried.origin);
  await page.goto(`${hurried.address}#file=bingham.toml`);
  await done(page);
  await replaced(page, stickSlip.replace('"8 s"', '"1e7 s"').replace('points = 801', 'every = "1e3 s"'));
  await page.waitForFunction(() => /takes longer than the 1 s/.test(document.querySelector('.status').textContent));
  assert.match(await page.textContent('h1'), /Stick and slip/);
  await page.locator('.u-series', { hasText: 'block.position' }).waitFor();
  await page.locator('details[data-name="Statistics"]').waitFor({ state: 'detached' });
  for (const name of await page.locator('.sections summary').allTextContents()) await page.locator('.sections summary', { hasText: name }).first().click();
  await page.locator('.explanation').waitFor();
  assert.equal(await page.locator('details[data-name="Energy account"]').count(), 0);
  // Or why there is nothing so far.
  await replaced(page, stickSlip.replace('"8 s"', '"1e7 s"\nmethod = "ida"').replace('points = 801', 'every = "1 s"'));
  await page.locator('.no-curves').waitFor();
  assert.match(await page.textContent('.no-curves'), /nothing to draw so far\. The run takes longer than the 1 s/);
  assert.deepEqual(wrong, []);
  await context.close();
  await hurried.stop();
});

test('what is 0 all the time is drawn in the middle of an axis that has 0 in its middle', async () => {
  const { page, close } = await open();
  const written = await numbersOnCanvas(page);
  const still = '[elements]\nk = { type = "spring", between = ["a", "ground"], stiffness = 1 }\nm = { type = "mass", at = "a", mass = 1 }\n[simulate]\nstop = "3 s"\nrecord = ["k.force"]\n';
  await redrawn(page, () => replaced(page, still));
  await page.locator('.u-series', { hasText: 'k.force' }).waitFor();
  let numbers = await written();
  assert.ok(numbers.includes(-1) && numbers.includes(1) && !numbers.includes(100), String(numbers));
  await page.locator('.plot-head label', { hasText: 'Force against displacement' }).click();
  await page.locator('.chart.loop').waitFor();
  numbers = await written();
  assert.ok(!numbers.includes(100), String(numbers));
  await close();
});

test('the token leaves the address for the storage of the page, which opens again without it, and asks for it where it is gone', async () => {
  const { page, context, close } = await desk.open();
  assert.ok(!page.url().includes('token'), page.url());
  assert.ok(page.url().endsWith('#file=bingham.toml'));
  await page.reload();
  await done(page);
  // A second page of the same browser has it too.
  const second = await context.newPage();
  await second.goto(`${desk.server.origin}/#file=bingham.toml`);
  await done(second);
  await second.evaluate(() => localStorage.clear());
  await second.reload();
  await second.waitForFunction(() => /the token of the address/.test(document.body?.textContent));
  await second.close();
  // Another browser gets no page without it.
  const stranger = await desk.chromium.newContext();
  const third = await stranger.newPage();
  assert.equal((await third.goto(desk.server.origin)).status(), 401);
  assert.match(await third.locator('h1').textContent(), /needs a token/);
  await accessible(third, 'the page that asks for the token');
  await stranger.close();
  await page.locator('button[aria-label="Help"]').click();
  const [licences] = await Promise.all([context.waitForEvent('page'), page.locator('.help a').click()]);
  await licences.waitForLoadState();
  assert.match(await licences.locator('body').textContent(), /@codemirror\/view [\d.]+ \(MIT\)[^]*SIL OPEN FONT LICENSE/);
  await close();
});
