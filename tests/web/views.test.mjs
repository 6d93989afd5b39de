// The layout of the playground, and values read from its plots.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { netlist, number, redrawn, setUp, slider } from './desk.mjs';
import { accessible } from './support.mjs';

// An oscillator of 1 Hz that starts at 10 mm, with more records than one wants to see at first.
const oscillator = `title = "Oscillator"

[parameters]
m = "1 kg" # of the block
k = "39.4784176 N/m" # soft: 2 pi a second, with m at 1 kg
B = "0.2 N*s/m"

[elements]
block = { type = "mass", at = "block", mass = "m" }
spring = { type = "spring", between = ["block", "ground"], stiffness = "k" }
loss = { type = "dashpot", between = ["block", "ground"], damping = "B" }

[nodes]
block = { position = "10 mm" }

[simulate]
stop = "4 s"
output = { every = "2 ms" }
record = ["block.position", "block.velocity", "spring.force", "loss.force", "spring.displacement", "loss.displacement", "spring.velocity", "loss.velocity",
  "block.force", "spring.power"]

[demo]
question = "How long is a period of sqrt(k/m)?"
change = "The stiffness k, in N/m, and B up to 3 N*s/m."
see = "More stiffness, more swings."
why = "The period is 2 pi sqrt(m/k), and zeta = B/(2 sqrt(k m))."
sliders = { k = ["10 N/m", "200 N/m"], B = ["0 N*s/m", "3 N*s/m"] }
`;
// Rotation in a unit of its own.
const turning = `domain = "rotation"
[elements]
drive = { type = "motion", at = "shaft", velocity = { ramp = "100 rad/s^2" } }
loss = { type = "dashpot", between = ["shaft", "ground"], damping = "1 mN*m*s/rad" }
[simulate]
stop = "0.5 s"
record = ["shaft.velocity", "loss.force"]
[plot]
y = ["shaft.velocity", "loss.force"]
unit = ["rpm"]
`;
// A row that is much wider than a phone.
const wide = `[elements]
pull = { type = "force", at = "n0", force = "1 N" }
${[...Array(12).keys()].map((k) => `s${k} = { type = "spring", between = ["n${k}", "${k < 11 ? `n${k + 1}` : 'ground'}"], stiffness = 1 }`).join('\n')}
[simulate]
stop = 1
record = ["s0.force"]
`;
// The hand moves by up to 10 mm either way and pulls two equal springs in series.
const loop = `[elements]
hand = { type = "motion", at = "hand", position = { sine = "10 mm", frequency = "1 Hz" } }
k1 = { type = "spring", between = ["hand", "mid"], stiffness = "100 N/m" }
k2 = { type = "spring", between = ["mid", "ground"], stiffness = "100 N/m" }
[simulate]
stop = "1 s"
record = ["hand.position", "k2.force"]
`;
const desk = setUp({ 'equal.toml': loop.replace('"hand.position"', '"k1.force"'), 'loop.toml': loop, 'oscillator.toml': oscillator, 'slip.toml': loop.replace(/k2 = .*/, 'k2 = { type = "slider", between = ["mid", "ground"], coulomb = "0.3 N" }'), 'turning.toml': turning, 'wide.toml': wide });
const { open } = desk;
const file = '#file=oscillator.toml';

// Parts that are not wholly on the screen.
const beyond = (page, selectors) => page.evaluate((all) => all.filter((selector) => [...document.querySelectorAll(selector)].filter((node) => node.getClientRects().length).some((node) => {
  const { left, right, top, bottom } = node.getBoundingClientRect();
  return left < -0.5 || top < -0.5 || right > innerWidth + 0.5 || bottom > innerHeight + 0.5;
})), selectors);

test('schematic and plots share the screen, and where it is too small the plots are below each other', async () => {
  for (const [width, height] of [[1024, 768], [1440, 900], [1920, 1080]]) {
    const { page, close } = await open(file, { viewport: { width, height } });
    assert.deepEqual(await beyond(page, ['.drawing svg', '.animation']), [], `${width} x ${height}`);
    const heights = await page.locator('.plots .chart .u-over').evaluateAll((all) => all.map((area) => area.clientHeight));
    assert.ok(heights.length > 1 && heights.every((each) => each >= 150), `${width} x ${height}: ${heights}`);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await close();
  }
});

test('the presentation has question, schematic, plot and sliders on one screen, and the netlist one click away', async () => {
  for (const [width, height] of [[1024, 768], [390, 844], [844, 390]]) {
    const { page, close } = await open(file, { viewport: { width, height } });
    await page.locator('button.present').click();
    const what = `${width} x ${height}`;
    await page.waitForFunction(() => document.querySelector('.plots .chart canvas').getBoundingClientRect().height > 50);
    assert.deepEqual(await beyond(page, ['.question', '.drawing', '.animation', '.plots .chart', '[data-slider] input[type="range"]', '.bar button']), [], what);
    assert.ok(await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight && document.documentElement.scrollWidth <= innerWidth), what);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll('.sliders, .plots-box .plots .plots, .lesson-box')].filter((part) => part.scrollHeight > part.clientHeight + 1).map((part) => part.className)), [], what);
    for (const part of ['.question', '.drawing svg', '.plots .chart canvas', '[data-slider="parameters.k"] input[type="range"]']) assert.ok(await page.locator(part).first().isVisible(), `${what}: ${part}`);
    assert.equal(await page.locator('.editor').isVisible(), false);
    await page.locator('button', { hasText: 'Netlist' }).click();
    assert.ok(await page.locator('.editor').isVisible());
    await page.locator('button', { hasText: 'Netlist' }).click();
    await redrawn(page, () => slider(page, 'parameters.k').press('ArrowRight'));
    await accessible(page, `presentation, ${what}`);
    await page.keyboard.press('Escape');
    assert.ok(await page.locator('.editor').isVisible());
    await close();
  }
});

test('the presentation of a comparison has both schematics where there is room, and none is cut off', async () => {
  for (const [width, height, count] of [[1024, 768, 2], [390, 844, 1], [844, 390, 1]]) {
    const { page, close } = await open(file, { viewport: { width, height } });
    await page.getByRole('button', { name: 'Compare' }).click();
    await page.locator('.beside svg').waitFor();
    await page.locator('button.present').click();
    const what = `${width} x ${height}`;
    assert.deepEqual(await beyond(page, ['.drawing', '.beside', '.plots .chart', '[data-slider] input[type="range"]']), [], what);
    const cut = await page.locator('.drawings > :visible').evaluateAll((all) => all.map((host) => {
      const [outer, inner] = [host, host.querySelector('svg')].map((node) => node.getBoundingClientRect());
      return Math.max(outer.top - inner.top, inner.bottom - outer.bottom);
    }));
    assert.ok(cut.length === count && cut.every((px) => px < 1), `${what}: ${cut}`);
    await close();
  }
});

test('a comparison shows both schematics whole, with their letters', async () => {
  for (const width of [768, 1024, 1200, 1380, 1440]) {
    const { page, close } = await open(file, { viewport: { width, height: 860 } });
    await page.getByRole('button', { name: 'Compare' }).click();
    await page.locator('.beside svg').waitFor();
    await page.waitForTimeout(200);
    const shown = await page.locator('.drawings > div').evaluateAll((all) => all.map((host) => {
      const schematic = host.querySelector('.schematic');
      return [getComputedStyle(host, '::before').content, schematic.scrollWidth - schematic.clientWidth <= 1 && schematic.scrollHeight - schematic.clientHeight <= 1];
    }));
    assert.deepEqual(shown, [['"B"', true], ['"A"', true]], String(width));
    await close();
  }
});

test('on a phone the tools of the schematic are beside the buttons of its size, and nothing sticks above the plots', async () => {
  const { page, close } = await open(file, { viewport: { width: 390, height: 844 } });
  await page.getByRole('button', { name: 'Draw', exact: true }).click();
  await page.locator('.palette-type').first().waitFor();
  const [run, zoom] = [await page.getByRole('button', { name: 'Run …' }).boundingBox(), await page.locator('.zoom').boundingBox()];
  assert.ok(run.x + run.width <= zoom.x || run.y >= zoom.y + zoom.height);
  await page.locator('.palette.more-right').waitFor();
  assert.equal(await page.locator('.sliders-box').evaluate((box) => getComputedStyle(box).position), 'static');
  await close();
});

test('in the presentation nothing covers a button of the bar', async () => {
  const { page, close } = await open(file, { viewport: { width: 1366, height: 768 } });
  await redrawn(page, () => number(page, 'parameters.k').fill('50').then(() => number(page, 'parameters.k').press('Enter')));
  await page.locator('button.present').click();
  const [reset, bar] = await Promise.all(['.undo-all', '.bar'].map((part) => page.locator(part).boundingBox()));
  assert.ok(reset.y > bar.y + bar.height, `${reset.y}`);
  await close();
});

test('keys present, open the netlist and come back, and the help lists them', async () => {
  const { page, close } = await open(file);
  await page.evaluate(() => document.activeElement.blur());
  const isPresenting = () => page.evaluate(() => document.body.classList.contains('presenting'));
  await page.keyboard.press('p');
  assert.ok(await isPresenting());
  await page.keyboard.press('e');
  assert.ok(await page.locator('.editor').isVisible());
  await page.keyboard.type('p'); // into the netlist
  assert.ok(await isPresenting());
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Escape');
  await page.keyboard.press('p');
  assert.equal(await isPresenting(), false);
  await page.locator('button[aria-label="Help"]').click();
  const help = await page.locator('dialog.help').textContent();
  for (const said of ['Ppresent', 'Ffull screen', 'Ethe netlist', 'Rall numbers', 'Tfreeze', 'Mmeasure', 'Hhold']) assert.ok(help.includes(said), said);
  await close();
});

// The range of the vertical axis of the first plot that is drawn, in its unit.
const heights = (page) => page.locator('.plots .chart').first().getAttribute('data-range').then((text) => text.split(' ').map(Number));

test('the vertical axis only grows while a slider moves, settles after, and stays where it is held', async () => {
  const { page, close } = await open(file);
  const move = (value) => redrawn(page, async () => {
    await number(page, 'parameters.B').fill(String(value));
    await number(page, 'parameters.B').press('Enter');
  });
  await page.locator('.chooser summary').click();
  for (const path of ['block.velocity', 'spring.force', 'loss.force', 'block.position', 'spring.displacement', 'loss.displacement', 'spring.velocity', 'loss.velocity', 'block.force', 'spring.power'])
    await page.locator(`[data-path="${path}"] input`).setChecked(path === 'loss.force');
  await page.keyboard.press('Escape');
  const [, high] = await heights(page);
  await move(0.02); // a tenth of the force
  assert.equal((await heights(page))[1], high);
  await page.waitForTimeout(1200);
  const settled = await page.locator('.plots .chart').first().getAttribute('data-range');
  assert.notEqual(settled.split(' ')[1], String(high));
  await page.locator('button.hold').click();
  await move(3);
  await page.waitForTimeout(1200);
  assert.equal(await page.locator('.plots .chart').first().getAttribute('data-range'), settled);
  await page.locator('button.hold').click();
  assert.notEqual(await page.locator('.plots .chart').first().getAttribute('data-range'), settled);
  await close();
});

test('two cursors measure differences, peaks and the period', async () => {
  const { page, close } = await open(file);
  await page.locator('button.measure').click();
  const cursor = (k) => page.locator('[role="slider"]', { hasText: String(k) }).first();
  const row = async (name) => page.locator('.measured tr', { hasText: name }).first().locator('td').allTextContents();
  assert.match(await page.locator('.measured .apart').textContent(), /2 s apart, 0\.5 Hz/); // from 1 s to 3 s
  const [, first, second, difference, highest, , period] = await row('block.position');
  // x = 10 mm exp(-0.1 t) cos(w t), nearly.
  const expected = (t) => 10 * Math.exp(-0.1 * t) * Math.cos(Math.sqrt(39.4784176 - 0.01) * t);
  assert.ok(Math.abs(Number.parseFloat(first) - expected(1)) < 0.03, first);
  assert.ok(Math.abs(Number.parseFloat(second) - expected(3)) < 0.03, second);
  assert.ok(Math.abs(Number.parseFloat(difference) - (expected(3) - expected(1))) < 0.05, difference);
  assert.match(highest, /^9\.0\d* mm at /);
  assert.ok(Math.abs(Number.parseFloat(period) - 1) < 0.01, period);
  await cursor(1).focus();
  for (let k = 0; k < 5; ++k) await page.keyboard.press('PageUp');
  assert.match(await page.locator('.measured .apart').textContent(), /^Cursors 1 s apart/);
  // By the mouse, which zooms nothing meanwhile.
  const box = await page.locator('.plots .chart .u-over').first().boundingBox();
  const at = async (part) => [box.x + part * box.width, box.y + box.height / 2];
  await page.mouse.move(...await at(0.75));
  await page.mouse.down();
  await page.mouse.move(...await at(0.9), { steps: 4 });
  await page.mouse.up();
  assert.ok(Math.abs(Number(await cursor(2).getAttribute('aria-valuenow')) - 3.6) < 0.03);
  await accessible(page, 'measuring');
  await close();
});

async function exported(page) {
  await page.locator('button', { hasText: 'Export' }).click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('[role="menuitem"]', { hasText: 'Plots (SVG)' }).click()]);
  return readFileSync(await download.path(), 'utf8');
}

test('frozen curves have the colours of their runs everywhere, in an export too', async () => {
  const { page, close } = await open(file);
  await page.locator('button.freeze').click();
  await redrawn(page, async () => {
    await number(page, 'parameters.B').fill('2');
    await number(page, 'parameters.B').press('Enter');
  });
  await page.locator('button.freeze').click();
  await redrawn(page, async () => {
    await number(page, 'parameters.B').fill('1');
    await number(page, 'parameters.B').press('Enter');
  });
  const legend = await page.locator('.plots .chart').first().locator('.u-label').allTextContents();
  const now = legend.filter((name) => name.startsWith('now '));
  assert.ok(legend.some((name) => name.startsWith('as at first ')) && legend.some((name) => name.startsWith('B = 2 N·s/m ')), legend.join());
  const colours = await page.locator('.plots .chart .u-series').evaluateAll((all) => all.map((series) =>
    [series.querySelector('.u-label').textContent.split(' ')[0], getComputedStyle(series.querySelector('.u-marker')).borderTopColor]).filter(([name]) => name !== 'time'));
  const of = (name) => [...new Set(colours.filter(([run]) => run === name).map(([, colour]) => colour))];
  assert.deepEqual([of('now'), of('as'), of('B')], [['rgb(0, 114, 178)'], ['rgb(0, 158, 115)'], ['rgb(180, 80, 138)']]);
  const svg = await exported(page);
  assert.ok(svg.includes(`>${now[0]}<`), now[0]);
  for (const colour of ['#0072b2', '#009e73', '#b4508a']) assert.ok(svg.includes(`stroke="${colour}"`), colour);
  assert.equal(/stroke="#(d55e00|56b4e9|e69f00)"/.test(svg), false);
  await page.locator('button', { hasText: 'Compare' }).first().click();
  // One look at the page: while the comparison runs its plots are drawn anew, and an element found before may be gone.
  const compared = await page.waitForFunction(() => {
    const all = [...document.querySelectorAll('.plots .chart .u-series')];
    const starting = (text) => all.find((series) => series.querySelector('.u-label').textContent.startsWith(text));
    return starting('B ') && starting('as at first') && getComputedStyle(starting('as at first').querySelector('.u-marker')).borderTopColor;
  });
  assert.equal(await compared.jsonValue(), 'rgb(0, 158, 115)');
  await page.locator('button.thaw').click();
  assert.equal(await page.locator('.u-label', { hasText: 'as at first' }).count(), 0);
  await close();
});

test('the key of events stands beside plots over time that have some, and says what they are', async () => {
  const { page, close } = await open('#file=slip.toml');
  const key = page.locator('.event-key');
  await key.locator('summary').click();
  assert.match(await key.locator('p').innerText(), /something sticks/);
  await page.locator('.tabs [data-kind="loop"]').click();
  assert.equal(await key.isVisible(), false);
  await close();
  const smooth = await open(file);
  assert.equal(await smooth.page.locator('.event-key').isVisible(), false);
  await smooth.close();
});

test('an export has the units of the screen, in dark pages the colours of light ones', async () => {
  const { page, close } = await open('#file=turning.toml', { colorScheme: 'dark' });
  const svg = await exported(page);
  for (const said of ['angular velocity [rpm]', 'torque [mN·m]', 'stroke="#0072b2"']) assert.ok(svg.includes(said), said);
  await close();
});

test('of many records a few are shown, and the others are one click away', async () => {
  const { page, close } = await open(file);
  const shown = () => page.locator('.plots .chart .u-series:not(:first-child)').count();
  assert.ok((await shown()) <= 8 && (await page.locator('.plots .chart').count()) <= 3, String(await shown()));
  await page.locator('.chooser summary').click();
  await page.locator('button.all-own').click();
  assert.equal(await shown(), 10);
  await close();
});

test('a curve that covers another one, which is the same, is broken', async () => {
  const broken = (page) => page.evaluate(() => [...document.querySelectorAll('.chart')].map((chart) => chart.dataset.broken).join(''));
  const { page, close } = await open('#file=loop.toml');
  assert.equal(await broken(page), '');
  await close();
  const equal = await open('#file=equal.toml');
  assert.equal(await broken(equal.page), 'k2.force');
  await equal.close();
});

test('any two records are drawn against each other: the force of an element over the position of a driven node', async () => {
  const { page, close } = await open('#file=loop.toml');
  await page.locator('.tabs label', { hasText: 'Any two records' }).click();
  const [up, across] = ['vertical axis', 'horizontal axis'].map((label) => page.getByLabel(label, { exact: true }));
  assert.equal(await across.inputValue(), 'hand.position');
  await up.selectOption('k2.force');
  assert.equal(await up.evaluate((select) => select === document.activeElement), true);
  // Two springs in series share the force: half of 100 N/m times the way of the hand, and k2 is pulled as the hand moves ahead.
  const over = page.locator('.plots .chart.loop .u-over');
  const box = await over.boundingBox();
  await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.3 * box.height);
  const [, x, y] = /^k2\.force: ([-\d.]+) mm, ([-\d.]+) N/.exec(await page.locator('.plots .readout').textContent());
  assert.ok(Number(x) > 4 && Math.abs(Number(y) - 0.05 * Number(x)) < 1e-3 * Number(x), `${x} ${y}`);
  await across.selectOption('k2.displacement');
  assert.match(await page.locator('.plots .chart.loop').getAttribute('aria-label'), /^force against displacement/);
  // A link has the choice too.
  await page.getByRole('button', { name: 'Link' }).click();
  await page.waitForFunction(() => location.hash.length > 50);
  await page.reload();
  await page.waitForSelector('.plots .chart.loop');
  assert.deepEqual([await up.inputValue(), await across.inputValue()], ['k2.force', 'k2.displacement']);
  await accessible(page, 'two records');
  await close();
});

test('letters of a schematic are never too small, and it can be zoomed and moved', async () => {
  const { page, close } = await open('#file=wide.toml', { viewport: { width: 390, height: 844 }, hasTouch: true });
  const letters = () => page.locator('.drawing text').evaluateAll((all) => Math.min(...all.map((text) => text.getBoundingClientRect().height)));
  const size = () => page.locator('.drawing svg').evaluate((svg) => svg.getBoundingClientRect().width / svg.viewBox.baseVal.width * 10); // of its smallest letters, px
  assert.ok((await size()) >= 9, String(await size()));
  const before = await letters();
  await page.locator('.zoom button', { hasText: '+' }).click();
  assert.ok((await letters()) > before * 1.1);
  await page.locator('.zoom button', { hasText: 'Fit' }).click();
  assert.ok(await page.locator('.drawing .schematic').evaluate((host) => host.scrollWidth <= host.clientWidth + 1));
  // Two fingers that go apart to twice their distance.
  const zoomed = await page.locator('.drawing').evaluate((host) => {
    const { left, top } = host.getBoundingClientRect();
    const touch = (id, x) => new Touch({ identifier: id, target: host, clientX: left + x, clientY: top + 20 });
    const send = (type, ...xs) => host.dispatchEvent(new TouchEvent(type, { bubbles: true, cancelable: true, touches: xs.map((x, k) => touch(k, x)) }));
    const width = () => host.querySelector('svg').getBoundingClientRect().width;
    const first = width();
    send('touchstart', 100, 150);
    send('touchmove', 75, 175);
    send('touchend');
    return width() / first;
  });
  assert.ok(Math.abs(zoomed - 2) < 0.05, String(zoomed));
  await close();
});

test('two fingers zoom a plot, and one moves it then', async () => {
  const { page, close } = await open(file, { viewport: { width: 390, height: 844 }, hasTouch: true });
  const scale = () => page.locator('.plots .chart').first().getAttribute('data-span').then((text) => text.split(' ').map(Number));
  const send = (list) => page.locator('.plots .chart .u-over').first().evaluate((over, events) => {
    const { left, top, width } = over.getBoundingClientRect();
    for (const [type, ...parts] of events)
      over.dispatchEvent(new TouchEvent(type, { bubbles: true, cancelable: true, touches: parts.map((part, k) => new Touch({ identifier: k, target: over, clientX: left + part * width, clientY: top + 20 })) }));
  }, list);
  const settled = () => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  await send([['touchstart', 0.5], ['touchmove', 0.2], ['touchend']]); // the page's, not the plot's
  await settled();
  assert.deepEqual(await scale(), [0, 4]);
  await send([['touchstart', 0.4, 0.6], ['touchmove', 0.3, 0.7], ['touchend']]);
  await settled();
  let [low, high] = await scale();
  assert.ok(Math.abs(low - 1) < 0.05 && Math.abs(high - 3) < 0.05, `${low} ${high}`);
  await send([['touchstart', 0.5], ['touchmove', 0.75], ['touchend']]);
  await settled();
  [low, high] = await scale();
  assert.ok(Math.abs(low - 0.5) < 0.05 && Math.abs(high - 2.5) < 0.05, `${low} ${high}`);
  await close();
});

test('sliders say what they stand for and how far they go, and go back', async () => {
  const { page, close } = await open(file);
  const row = page.locator('[data-slider="parameters.k"]');
  assert.match(await row.locator('.hint').textContent(), /soft: 2 ?π? ?.*second/);
  assert.deepEqual(await row.locator('.limits span').allTextContents(), ['10', '200']);
  assert.equal(await row.locator('.unit').textContent(), 'N/m');
  assert.equal(await page.locator('[data-slider="parameters.B"] .unit').textContent(), 'N·s/m');
  const before = await netlist(page);
  assert.equal(await page.locator('.undo-all').isVisible(), false);
  await redrawn(page, () => slider(page, 'parameters.k').press('End'));
  await redrawn(page, () => slider(page, 'parameters.B').press('End'));
  assert.notEqual(await netlist(page), before);
  await redrawn(page, () => row.locator('.undo').click());
  assert.match(await netlist(page), /k = "39\.4784176 N\/m"[^]*B = "3 N\*s\/m"/);
  await redrawn(page, () => page.locator('.undo-all').click());
  assert.equal(await netlist(page), before);
  await close();
});

test('units and formulas of a lesson are set as in print', async () => {
  const { page, close } = await open(file);
  const lesson = page.locator('.lesson');
  assert.match(await lesson.locator('.question').textContent(), /How long is a period of/);
  assert.equal(await lesson.locator('.question .katex').count(), 1);
  assert.ok((await lesson.textContent()).includes('N·s/m'));
  assert.equal(/N\*s|sqrt\(/.test(await lesson.evaluate((node) => [...node.querySelectorAll('annotation')].reduce((text, note) => text.replace(note.textContent, ''), node.innerText))), false);
  await lesson.locator('summary', { hasText: 'Why' }).click();
  assert.deepEqual(await lesson.locator('.formula').evaluateAll((all) => all.map((formula) => formula.dataset.source)), ['sqrt(k/m)', '2 pi sqrt(m/k)', 'zeta = B/(2 sqrt(k m))']);
  await close();
});
