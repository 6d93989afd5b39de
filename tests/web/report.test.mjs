// A report opens from a file, with the network off.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { promisify } from 'node:util';
import { SceneData } from '../../tools/web/src/scene-data.js';
import { accessible, bingham, browser, folderWith, pointAt, program, remove, rheonet, watched } from './support.mjs';

let folder, chromium;
const soft = bingham.replace('title = "Bingham element"', 'title = "Soft </script><b>one</b> & \\"quoted\\""').replace('"100 N*m/rad"', '"20 N*m/rad"');

before(async () => {
  folder = folderWith({ 'stiff.toml': bingham, 'soft.toml': soft });
  chromium = await browser();
});
after(async () => {
  await chromium?.close();
  remove(folder);
});

async function open(file, options = {}) {
  const context = await chromium.newContext({ viewport: { width: 1300, height: 900 }, ...options });
  await context.setOffline(true);
  const { page, wrong } = await watched(context, 'file');
  await page.goto(`file://${join(folder, file)}`);
  await page.waitForSelector('.report article');
  return { context, page, wrong };
}

// The legend's value of a record with the pointer at a fraction of the width of a chart.
async function valueAt(page, chart, part, record) {
  await pointAt(page, page.locator('.panel .u-over').nth(chart), part);
  const row = page.locator('.u-series', { hasText: record }).first();
  return row.locator('.u-value').textContent();
}

test('a report of one scene shows all there is, offline', async () => {
  await rheonet(['report', 'stiff.toml', '-o', 'one.html', '--certify', '--precision'], { cwd: folder });
  const { context, page, wrong } = await open('one.html');
  assert.equal(await page.title(), 'Bingham element');
  const headings = await page.locator('h3').allTextContents();
  for (const heading of ['Schematic', 'Plots', 'What is simulated, and why', 'Elements', 'Equations', 'Energy account', 'Events', 'Accuracy and its price', 'Statistics', 'Netlist'])
    assert.ok(headings.includes(heading), heading);
  for (const name of ['drive', 'k1', 'c1', 's1']) assert.equal(await page.locator(`.schematic [data-element="${name}"]`).count(), 1, name);
  const explained = await page.locator('.explanation').innerText();
  const { stdout } = await rheonet(['explain', 'stiff.toml'], { cwd: folder });
  for (const line of stdout.split('cost\n')[0].split('\n').slice(2).filter(Boolean))
    assert.ok(explained.toLowerCase().replace(/\s+/g, ' ').includes(line.trim().replaceAll('`', '').toLowerCase().replace(/\s+/g, ' ')), line);
  assert.ok((await page.locator('.explanation li code').allTextContents()).includes('s1'));
  // KaTeX has set the laws of the four types, and says them to who cannot see.
  assert.equal(await page.locator('.equation:has(.katex-html):has(math)').count(), 4);
  assert.match(await page.locator('.source-text pre').first().textContent(), /stiffness = "100 N\*m\/rad"/);
  assert.match(await page.locator('.verdict').textContent(), /^certified: every record is within 1e-06/);
  // In the end the torque is Tc + B w = 2 + 0.5 * 10; nothing is left of exp(-t k/B).
  assert.equal(await valueAt(page, 0, 0.999, 'k1.force'), '7 N·m');
  // The energy account ends with the values in the statistics.
  assert.match(await page.locator('.scene').textContent(), /energy supplied/);
  assert.deepEqual(wrong, []);
  await context.close();
});

test('prices are drawn, wherever they lie', async () => {
  await rheonet(['report', 'stiff.toml', '-o', 'prices.html', '--precision'], { cwd: folder });
  const html = readFileSync(join(folder, 'prices.html'), 'utf8');
  const [, text] = /<script type="application\/json" id="data">(.*?)<\/script>/s.exec(html);
  for (const errors of [[1.6775285934883536e-5, 1.9973574368773443e-12], [3e-5, 1e-5], [0.5, 1e-300], [2e-9]]) {
    const data = JSON.parse(text);
    const list = data.scenes[0].find(({ kind }) => kind === 'prices');
    list.prices = errors.map((error, k) => ({ ...list.prices[0], error, cpu: 0.0019 * (k + 1) }));
    writeFileSync(join(folder, 'moved.html'), html.replace(text, () => JSON.stringify(data).replaceAll('<', '\\u003c')));
    const { context, page, wrong } = await open('moved.html');
    assert.equal(await page.locator('section', { hasText: 'Accuracy and its price' }).last().locator('.loop canvas').count(), 1);
    assert.deepEqual(wrong, [], String(errors));
    await context.close();
  }
});

test('plots zoom, and show what is chosen', async () => {
  await rheonet(['report', 'stiff.toml', '-o', 'plots.html'], { cwd: folder });
  const { context, page, wrong } = await open('plots.html');
  assert.equal(await page.locator('.panel .chart').count(), 2);
  const first = page.locator('.panel .chart').first();
  const time = () => page.locator('.panel .u-series .u-value').first().textContent();
  await valueAt(page, 0, 0.5, 'k1.force');
  const whole = Number.parseFloat(await time());
  assert.ok(Math.abs(whole - 0.1) < 0.01, String(whole));
  // Twice in: the middle stays, and a quarter from it is nearer than before.
  await first.focus();
  await page.keyboard.press('+');
  await page.keyboard.press('+');
  await valueAt(page, 1, 1 - 1e-3, 'mid.velocity');
  const zoomed = Number.parseFloat(await time());
  assert.ok(Math.abs(zoomed - 0.125) < 0.005, String(zoomed));
  await first.focus();
  await page.keyboard.press('0');
  await page.locator('.chooser summary').click();
  await page.locator('.chooser label[data-path="s1.force"] input').check();
  assert.match(await page.locator('.panel').textContent(), /s1\.force/);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.chooser-body').isVisible(), false);
  // The slider gives its 2 N*m once it slips.
  assert.equal(await valueAt(page, 0, 0.999, 's1.force'), '2 N·m');
  await page.locator('.tabs label', { hasText: 'Force against displacement' }).click();
  await page.locator('.plot-tools select').selectOption('k1');
  const over = page.locator('.loop .u-over');
  const box = await over.boundingBox();
  await page.mouse.move(box.x + 0.2 * box.width, box.y + 0.8 * box.height);
  let read = '';
  for (let x = 0.05; x < 1 && !read; x += 0.05) {
    await page.mouse.move(box.x + x * box.width, box.y + (1 - x) * box.height);
    read = await page.locator('.readout').textContent();
  }
  // A spring: force over displacement is its stiffness.
  const [, displacement, unit, force] = /k1: ([\d.e-]+) (m?)rad, ([\d.e-]+) N·m/.exec(read);
  assert.ok(Math.abs(Number(force) / (Number(displacement) * (unit ? 1e-3 : 1)) - 100) < 0.1, read);
  assert.deepEqual(wrong, []);
  await context.close();
});

test('the numbers in tables have six digits at most, but those of a claim that fails', async () => {
  const claimed = bingham.replace('"100 N*m/rad"', '"123456.789 N*m/rad"').replace('"0.5 N*m*s/rad"', '"0.0001234567891 N*m*s/rad"').concat(`
[expect]
"k1.force" = { final = "2.001234567891 N*m", within = "1e-6 N*m" }
"c1.force" = { final = "0.0012345699 N*m", within = "1e-13 N*m" }
`);
  writeFileSync(join(folder, 'claimed.toml'), claimed);
  await promisify(execFile)(program, ['report', 'claimed.toml', '-o', 'claimed.html'], { cwd: folder }).catch(({ code }) => assert.equal(code, 1));
  const { context, page, wrong } = await open('claimed.html');
  const table = (name) => page.locator(`.scroll[aria-label="${name}"] tbody tr`).evaluateAll((rows) => rows.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.match((await table('Elements')).find(([name]) => name === 'k1').at(-1), /^stiffness = 1\.23457e5 N·m\/rad/);
  assert.match((await table('Elements')).find(([name]) => name === 'c1').at(-1), /1\.23457e-4 N·m·s\/rad/);
  const [holds, fails] = await table('Claims');
  assert.deepEqual([holds[1].split(' within')[0], holds[2], holds[3]], ['2.00123 N·m', '2.00123 N·m', 'holds']);
  assert.deepEqual([fails[1].split(' within')[0], fails[3]], ['0.0012345699 N·m', 'fails']);
  for (const [time] of await table('Events')) assert.ok(time.replace(/e.*|\./, '').replace(/^0+/, '').length <= 6, time);
  assert.deepEqual(wrong, []);
  await context.close();
});

test('several scenes stand side by side, and whatever they are called does no harm', async () => {
  await rheonet(['report', 'stiff.toml', 'soft.toml', '-o', 'two.html', '--title', 'Stiff & soft'], { cwd: folder });
  const { context, page, wrong } = await open('two.html');
  assert.equal(await page.textContent('h1'), 'Stiff & soft');
  assert.equal(await page.locator('article.scene').count(), 2);
  assert.match(await page.locator('article.scene').nth(1).locator('h2').textContent(), /Soft <\/script><b>one<\/b> & "quoted"/);
  const [a, b] = [await page.locator('article.scene').nth(0).boundingBox(), await page.locator('article.scene').nth(1).boundingBox()];
  assert.ok(a.y === b.y && a.x + a.width < b.x);
  assert.equal(await valueAt(page, 0, 0.999, 'A k1.force'), '7 N·m');
  assert.match(await page.locator('.comparison').textContent(), /largest difference/);
  await accessible(page, 'a report of two scenes');
  assert.deepEqual(wrong, []);
  await context.close();
});

test('a report is accessible in light and dark, and prints on white', async () => {
  await rheonet(['report', 'stiff.toml', '-o', 'print.html'], { cwd: folder });
  for (const colorScheme of ['light', 'dark']) {
    const { context, page, wrong } = await open('print.html', { colorScheme });
    await accessible(page, colorScheme);
    if (colorScheme === 'dark') {
      await page.emulateMedia({ media: 'print' });
      assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
      const pdf = await page.pdf();
      assert.ok(pdf.subarray(0, 5).toString() === '%PDF-' && pdf.length > 20_000);
    }
    assert.deepEqual(wrong, []);
    await context.close();
  }
});

test('of very many rows a report keeps the peaks', async () => {
  const many = folderWith({
    'many.toml': `[elements]
kick = { type = "force", at = "a", force = { pulse = "3 N", width = "40 us", time = "0.73 s" } }
c1 = { type = "dashpot", between = ["a", "ground"], damping = "2 N*s/m" }
[simulate]
stop = "2 s"
output = { every = "10 us" }
record = ["a.velocity", "kick.force"]
`,
  });
  await rheonet(['report', 'many.toml', '-o', 'many.html'], { cwd: many });
  const html = readFileSync(join(many, 'many.html'), 'utf8');
  const [scene] = JSON.parse(/<script type="application\/json" id="data">(.*?)<\/script>/s.exec(html)[1]).scenes;
  const { time, columns: values } = SceneData.from(scene);
  assert.ok(time.length > 500 && time.length < 20_000, String(time.length));
  assert.equal(time[0], 0);
  assert.equal(time.at(-1), 2);
  assert.ok(time.every((t, k) => k === 0 || t >= time[k - 1]));
  assert.equal(Math.max(...values[0]), 1.5);
  const at = time[values[0].indexOf(1.5)];
  assert.ok(at >= 0.73 - 1e-9 && at <= 0.73004 + 1e-9, String(at));
  remove(many);
});

test('a report says what failed', async () => {
  const wrongs = folderWith({
    'claim.toml': `${bingham}\n[expect]\n"k1.force" = { final = "8 N*m", within = "0.1 N*m" }\n`,
    'bad.toml': bingham.replace('"spring"', '"sprong"'),
  });
  const claim = await rheonet(['report', 'claim.toml', '-o', 'claim.html'], { cwd: wrongs }).catch((error) => error);
  assert.equal(claim.code, 1);
  assert.match(claim.stderr, /a claim of its \[expect\] fails/);
  assert.match(readFileSync(join(wrongs, 'claim.html'), 'utf8'), /"holds":false/);
  const bad = await rheonet(['report', 'bad.toml', '-o', 'bad.html'], { cwd: wrongs }).catch((error) => error);
  assert.equal(bad.code, 2);
  assert.match(bad.stderr, /did you mean `spring`/);
  const name = await rheonet(['report', 'claim.toml', '-o', 'claim.pdf'], { cwd: wrongs }).catch((error) => error);
  assert.equal(name.code, 2);
  assert.match(name.stderr, /is no \.html/);
  remove(wrongs);
});

test('a report of a run that fails at its start says so where its curves would be, and fits a phone', async () => {
  const name = 'a_folder_with_a_long_name/a_scene_that_asks_for_two_motions_at_once.toml';
  mkdirSync(join(folder, 'a_folder_with_a_long_name'));
  writeFileSync(join(folder, name), bingham.replace('[simulate]', 'again = { type = "motion", at = "drum", velocity = 3 }\n[simulate]'));
  const { code } = await rheonet(['report', name, 'stiff.toml', '-o', 'fails.html'], { cwd: folder }).catch((error) => error);
  assert.equal(code, 1);
  const { context, page, wrong } = await open('fails.html', { viewport: { width: 390, height: 844 } });
  assert.match(await page.locator('.comparison .no-curves').textContent(), /^A: There is nothing to draw.* Motions drive and again both prescribe node drum/);
  await page.locator('.comparison .u-series', { hasText: 'B k1.force' }).waitFor();
  assert.equal(await page.locator('h3', { hasText: 'Energy account' }).count(), 1);
  assert.equal(await page.locator('h3', { hasText: 'Differences' }).count(), 0);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await accessible(page, 'a report of a run that fails');
  assert.deepEqual(wrong, []);
  await context.close();
});

test('names of any length do not make a report wider than the screen', async () => {
  const name = 'a'.repeat(150);
  writeFileSync(join(folder, 'names.toml'), `[elements]
drive = { type = "motion", at = "end", velocity = { sine = "1 m/s", frequency = "2 Hz" } }
${name}k = { type = "spring", between = ["end", "${name}"], stiffness = 10 }
block = { type = "slider", between = ["${name}", "ground"], coulomb = 1 }
[simulate]
stop = 1
record = ["${name}k.force", "${name}.position"]
[expect]
"${name}k.force" = { max = 1 }
`);
  await rheonet(['report', 'names.toml', '-o', 'names.html', '--certify'], { cwd: folder });
  const { context, page, wrong } = await open('names.html', { viewport: { width: 390, height: 844 } });
  assert.ok((await page.locator('.explanation').textContent()).includes(name));
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  assert.deepEqual(wrong, []);
  await context.close();
});

test('no two curves of a panel look the same, whichever scene records them', async () => {
  const moved = bingham.replace('record = ["k1.force", "mid.velocity"]', 'record = ["k1.force", "mid.position", "drum.position"]')
    .replaceAll('"drum', '"wheel').replaceAll('"mid', '"joint');
  writeFileSync(join(folder, 'moved.toml'), moved);
  await rheonet(['report', 'stiff.toml', 'moved.toml', '-o', 'looks.html'], { cwd: folder });
  const { context, page, wrong } = await open('looks.html');
  const panels = await page.locator('.comparison .chart').evaluateAll((charts) => charts.map((chart) =>
    [...chart.querySelectorAll('.u-series')].slice(1).map((series) => {
      const { borderTopColor, borderTopStyle } = getComputedStyle(series.querySelector('.u-marker'));
      return { name: series.querySelector('.u-label').textContent, look: `${borderTopColor} ${borderTopStyle}` };
    })));
  assert.ok(panels.some((curves) => curves.length === 2 && curves.every(({ name }) => /^B .*position/.test(name))), JSON.stringify(panels));
  for (const curves of panels) assert.equal(new Set(curves.map(({ look }) => look)).size, curves.length, JSON.stringify(curves));
  assert.deepEqual(wrong, []);
  await context.close();
});

test('of two scenes nothing is compared that has different units', async () => {
  const line = `[elements]
pull = { type = "motion", at = "a", velocity = "1 m/s" }
k1 = { type = "spring", between = ["a", "ground"], stiffness = 7 }
[simulate]
stop = 1
record = ["k1.force"]
`;
  writeFileSync(join(folder, 'line.toml'), line);
  await rheonet(['report', 'stiff.toml', 'line.toml', '-o', 'units.html'], { cwd: folder });
  const { context, page, wrong } = await open('units.html');
  await page.locator('.note', { hasText: 'The scenes record nothing under the same name and in the same unit.' }).waitFor();
  assert.deepEqual(wrong, []);
  await context.close();
});

test('what a netlist includes is named by its way from there', async () => {
  mkdirSync(join(folder, 'parts'));
  writeFileSync(join(folder, 'parts', 'legs.toml'), '[models.leg]\nports = ["a", "b"]\n[models.leg.elements]\nk = { type = "spring", between = ["a", "b"], stiffness = 70 }\n');
  writeFileSync(join(folder, 'table.toml'), 'include = ["parts/legs.toml"]\n[elements]\nleg = { type = "leg", between = ["top", "ground"] }\npush = { type = "force", at = "top", force = 3 }\n[simulate]\nstop = 1\n');
  await rheonet(['report', 'table.toml', '-o', 'table.html'], { cwd: folder });
  const { context, page, wrong } = await open('table.html');
  assert.deepEqual((await page.locator('.source-text summary').allTextContents()).map((text) => text.trim()), ['table.toml', 'parts/legs.toml (included)']);
  assert.ok(!readFileSync(join(folder, 'table.html'), 'utf8').includes(join(folder, 'parts')));
  assert.deepEqual(wrong, []);
  await context.close();
});

test('a title that looks like a mark of the page is a title', async () => {
  for (const title of ['/* data */', '<!-- title -->', '/* script */', '$& $1 \\']) {
    await rheonet(['report', 'stiff.toml', '-o', 'title.html', '--title', title], { cwd: folder });
    const { context, page, wrong } = await open('title.html');
    assert.equal(await page.title(), title);
    assert.equal(await page.locator('h1').textContent(), title);
    assert.deepEqual(wrong, []);
    await context.close();
  }
});

test('a report has the licences of the packages and fonts in it', async () => {
  await rheonet(['report', 'stiff.toml', '-o', 'licences.html'], { cwd: folder });
  const { context, page, wrong } = await open('licences.html');
  const licences = page.locator('details.licences');
  assert.equal(await licences.getAttribute('open'), null);
  await licences.locator('summary').click();
  const text = await licences.locator('pre').innerText();
  for (const part of ['katex', 'uplot']) assert.match(text, new RegExp(`^${part} [\\d.]+ \\(MIT\\)$`, 'm'));
  assert.match(text, /Permission is hereby granted, free of charge/);
  assert.match(text, /KaTeX_Main-Regular: Copyright \(c\) 2009-2010, Design Science.* with Reserved Font Name KaTeX_Main\./);
  assert.match(text, /SIL OPEN FONT LICENSE/);
  // Only the licences of the parts in the report, which has no editor.
  assert.doesNotMatch(text, /codemirror\/view/);
  await accessible(page, 'licences');
  assert.deepEqual(wrong, []);
  await context.close();
});

test('a full disk leaves no part of a report', async () => {
  const full = (file) => promisify(execFile)('bash', ['-c', 'ulimit -f 100; "$0" report stiff.toml -o "$1"', program, file], { cwd: folder }).catch((error) => error);
  const refused = await full('none.html');
  assert.equal(refused.code, 1);
  assert.match(refused.stderr, /cannot write to `none\.html`: File too large\n {2}no file `none\.html` was made/);
  writeFileSync(join(folder, 'old.html'), 'earlier report');
  assert.match((await full('old.html')).stderr, /`old\.html` is as it was before/);
  assert.equal(readFileSync(join(folder, 'old.html'), 'utf8'), 'earlier report');
  assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith('.') || name === 'none.html'), []);
});
