// Lessons: no result before the prediction, the prediction next to the run, buttons for values, and mistakes in a lesson's file.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { netlist, number, redrawn, setUp } from './desk.mjs';
import { SceneData } from '../../tools/web/src/scene-data.js';
import { accessible, browser, done, serve, watched } from './support.mjs';

const netlists = join(dirname(fileURLToPath(import.meta.url)), '../../netlists');
const text = (name) => readFileSync(join(netlists, 'teaching', name), 'utf8');
const lessons = readdirSync(join(netlists, 'teaching')).filter((name) => name.endsWith('.lesson')).map((name) => name.replace('.lesson', ''));

// The example of the page that describes the format, for a netlist of its names.
const example = /```toml\n(level[^]*?)```/.exec(readFileSync(join(netlists, 'teaching/README.md'), 'utf8'))[1];
const belt = `title = "A belt"
[parameters]
k = "1 kN/m"
B = "500 N*s/m"
x0 = "1 mm"
[elements]
hand = { type = "motion", at = "grip", position = "x0" }
k1 = { type = "spring", between = ["grip", "mid"], stiffness = "k" }
c1 = { type = "dashpot", between = ["mid", "ground"], damping = "B" }
[simulate]
stop = "2 s"
record = ["k1.force", "grip.position"]
`;
const desk = setUp({ 'belt.toml': belt, 'belt.lesson': example, 'README.md': 'belt.toml, next.toml', 'next.toml': belt.replace('A belt', 'Another belt'), 'next.lesson': example });
const { open } = desk;
const offered = (page) => page.locator('.choices, .sketch').first().waitFor();

let server;
let chromium;
before(async () => {
  server = await serve(netlists);
  chromium = await browser();
});
after(async () => {
  await chromium.close();
  await server.stop();
});

// The answer of the server for a lesson of the project: its messages by kind.
async function lessonOf(name, language) {
  const response = await fetch(`${server.origin}/api/task`, { method: 'POST', headers: { ...server.key, 'Content-Type': 'application/json' },
    body: JSON.stringify({ task: 'lesson', text: text(`${name}.toml`), file: `teaching/${name}.toml`, language }) });
  const messages = (await response.text()).trim().split('\n').map((line) => JSON.parse(line));
  return Object.fromEntries(messages.map((message) => [message.kind, message]));
}

test('every demo has a lesson without mistakes, in English and in German', async () => {
  assert.deepEqual(lessons, readdirSync(join(netlists, 'teaching')).filter((name) => name.endsWith('.toml')).map((name) => name.replace('.toml', '')));
  for (const name of lessons) {
    const [english, german] = [await lessonOf(name, 'en'), await lessonOf(name, 'de')];
    assert.deepEqual(english.mistakes.items.map((item) => item.text), [], name);
    const texts = ({ lesson: { demo, explain, predict, presets } }) => [...Object.values(demo), explain, predict.prompt, ...(predict.choices ?? []).flatMap((choice) => [choice.text, choice.reply]), ...presets.flatMap((preset) => [preset.name, preset.look])];
    texts(english).forEach((words, k) => {
      assert.ok(words.length > 2, `${name}: ${words}`);
      assert.notEqual(words, texts(german)[k], `${name}: not translated: ${words}`);
    });
  }
});

test('of the curves to choose from, the run is nearest to the one that is said to be right', async () => {
  for (const name of lessons) {
    const { lesson: { predict } } = await lessonOf(name, 'en');
    if (!predict.choices) continue;
    const response = await fetch(`${server.origin}/api/task`, { method: 'POST', headers: { ...server.key, 'Content-Type': 'application/json' },
      body: JSON.stringify({ task: 'show', text: text(`${name}.toml`), file: `teaching/${name}.toml` }) });
    const messages = (await response.text()).trim().split('\n').map((line) => JSON.parse(line));
    const k = messages.find(({ kind }) => kind === 'scene').records.findIndex(({ path }) => path === predict.y);
    const { time, columns } = SceneData.from(messages);
    const values = columns[k];
    const off = predict.choices.map((choice) => Math.sqrt(choice.y.reduce((sum, value, j) => {
      const at = time.findIndex((t) => t >= choice.time[j] - 1e-9);
      return sum + (value - values[at < 0 ? values.length - 1 : at]) ** 2;
    }, 0)));
    const best = off.indexOf(Math.min(...off));
    assert.ok(predict.choices[best].right, `${name}: ${off}`);
    assert.ok(off.every((each, j) => j === best || each > 1.3 * off[best]), `${name}: ${off}`);
  }
});

test('answers that are curves over a position have its name at their axis', async () => {
  const context = await chromium.newContext({ viewport: { width: 1300, height: 950 } });
  const { page, wrong } = await watched(context, server.origin);
  await page.goto(`${server.address}#lesson=teaching/coulomb-to-iwan.toml`);
  await offered(page);
  const names = await page.locator('.choices svg').evaluateAll((all) => all.map((svg) => [...svg.querySelectorAll('text')].map(({ textContent }) => textContent).join(' ')));
  assert.ok(names.length > 1 && names.every((each) => each === 'iwan.force shaft.position'), String(names));
  assert.deepEqual(wrong, []);
  await context.close();
});

test('the result is seen only after the prediction, which stays beside the run', async () => {
  const { page, close } = await open('#lesson=belt.toml', {}, offered);
  await done(page);
  for (const part of ['.plots-box', '.sliders-box', '.more-box', '.animation']) assert.equal(await page.locator(part).isVisible(), false, part);
  await page.keyboard.press(' ');
  assert.equal(await page.locator('.animation').isVisible(), false);
  const compare = page.getByRole('button', { name: 'Compare with the run' });
  assert.equal(await compare.isDisabled(), true);
  await accessible(page, 'before the prediction');
  const answers = await page.locator('.choices svg').evaluateAll((all) => all.map((svg) => [...svg.querySelectorAll('text')].map(({ textContent }) => textContent)));
  assert.ok(answers.length && answers.every(([quantity, time]) => /^[\w.]+$/.test(quantity) && time === 'time'), String(answers));
  const [row, cards] = await page.locator('.choices').evaluate((host) => [host.clientWidth, [...host.children].reduce((sum, card) => sum + card.offsetWidth, 0)]);
  assert.ok(cards > 0.9 * row, `${cards} of ${row} px`);
  await page.getByRole('radio', { name: 'It stays.' }).check();
  await compare.click();
  for (const part of ['.plots-box', '.sliders-box']) assert.ok(await page.locator(part).isVisible(), part);
  assert.match(await page.textContent('.lesson-steps'), /That is not what happens\.Only a spring without a dashpot behind it keeps its force\./);
  // The verdict is in sight, above the curves.
  const [told, drawn] = await page.locator('.lesson-steps').evaluate((steps) => ['section [role="status"]', '.chart'].map((part) => steps.querySelector(part).getBoundingClientRect().toJSON()));
  assert.ok(told.top >= 0 && told.bottom <= drawn.top && told.bottom < page.viewportSize().height, `${told.top} ${told.bottom} ${drawn.top}`);
  assert.deepEqual(await page.locator('.lesson-steps .key').allTextContents(), ['the run', 'your prediction']);
  assert.equal(await page.locator('.choices input').first().isDisabled(), true);
  await page.locator('.lesson-steps summary', { hasText: 'Why' }).click();
  assert.ok(await page.locator('.formula .katex').isVisible());
  await accessible(page, 'after the prediction');

  const verdict = page.getByText('That is not what happens.');
  await redrawn(page, () => page.getByRole('button', { name: 'thin oil' }).click());
  assert.equal(await verdict.isVisible(), false); // it was of the run before
  await page.getByRole('button', { name: 'Netlist' }).click();
  assert.match(await netlist(page), /B = "50 N\*s\/m"/);
  assert.equal(await number(page, 'parameters.B').inputValue(), '50');
  assert.match(await page.textContent('.lesson-steps'), /It falls ten times as fast\./);
  assert.deepEqual(await page.locator('.lesson-steps .key').allTextContents(), ['the run', 'your prediction']);
  await redrawn(page, () => page.getByRole('button', { name: 'as at first' }).click());
  assert.equal(await netlist(page), belt.trimEnd() + '\n');
  assert.ok(await verdict.isVisible());

  await page.getByRole('button', { name: 'Next lesson: Another belt' }).click();
  await page.waitForFunction(() => location.hash === '#lesson=next.toml');
  await offered(page);
  assert.equal(await page.locator('.plots-box').isVisible(), false);
  await page.getByRole('button', { name: 'Leave the lesson' }).click();
  await page.locator('.plots-box').waitFor();
  assert.ok(page.url().endsWith('#file=next.toml'));
  assert.equal(await page.locator('.lesson-steps').count(), 0);
  await close();
});

test('the link of a lesson opens it at its first step, also in a presentation, and the netlist is one click away', async () => {
  const { page, close } = await open('#lesson=belt.toml', {}, offered);
  await page.getByRole('radio', { name: 'It stays.' }).check();
  await page.getByRole('button', { name: 'Compare with the run' }).click();
  await redrawn(page, () => page.getByRole('button', { name: 'thin oil' }).click());
  await page.getByRole('button', { name: 'Link' }).click();
  await page.locator('.toast', { hasText: 'opens the lesson' }).waitFor();
  const link = await page.evaluate(() => location.hash);
  await close();
  const other = await open(link, { viewport: { width: 1366, height: 768 } }, offered);
  assert.equal(await other.page.locator('.plots-box').isVisible(), false);
  assert.equal(await other.page.locator('.editor').isVisible(), false);
  await other.page.getByRole('button', { name: 'Netlist' }).click();
  assert.ok(await other.page.locator('.editor').isVisible());
  assert.equal(await netlist(other.page), belt.trimEnd() + '\n');
  await other.page.getByRole('button', { name: 'Netlist' }).click();
  await other.page.locator('button.present').click();
  for (const input of await other.page.locator('.choices label, .lesson-steps .primary').all()) {
    const [box, inside] = [await input.boundingBox(), await other.page.locator('.lesson-box').boundingBox()];
    assert.ok(box.y + box.height <= inside.y + inside.height, JSON.stringify([box, inside]));
  }
  await other.close();
});

test('a lesson stays where it is when the language changes', async () => {
  const { page, close } = await open('#lesson=belt.toml', {}, offered);
  await page.getByRole('radio', { name: 'It stays.' }).check();
  const language = async (code) => {
    await page.locator('select.language').selectOption(code);
    await page.waitForFunction((now) => document.documentElement?.lang === now, code);
    await offered(page);
  };
  await language('fr');
  assert.ok(await page.getByRole('radio', { name: 'It stays.' }).isChecked());
  assert.equal(await page.locator('.plots-box').isVisible(), false);
  await page.locator('.lesson-steps .primary').click();
  await page.getByRole('button', { name: 'thin oil' }).click();
  await page.waitForFunction(() => document.querySelector('[data-slider="parameters.B"] input[type=text]').value === '50');
  await language('en');
  await page.getByText('4. Explain').waitFor();
  assert.equal(await number(page, 'parameters.B').inputValue(), '50');
  await redrawn(page, () => page.getByRole('button', { name: 'as at first' }).click());
  assert.ok(await page.getByText('That is not what happens.').isVisible());
  assert.equal(await number(page, 'parameters.B').inputValue(), '500');
  await close();
});

test('a curve is sketched by mouse or by keys, and compared', async () => {
  const context = await chromium.newContext({ viewport: { width: 1200, height: 900 } });
  const { page, wrong } = await watched(context, server.origin);
  await page.goto(`${server.address}#lesson=teaching/relaxation.toml`);
  await offered(page);
  const sketch = page.locator('.sketch');
  const compare = page.getByRole('button', { name: 'Compare with the run' });
  await sketch.focus();
  // Up to 1 N from the first value on, then along.
  for (let k = 0; k < 15; ++k) await page.keyboard.press('ArrowUp');
  assert.match(await sketch.getAttribute('aria-valuetext'), /^1\.2 N, 0 s$/);
  assert.equal(await compare.isDisabled(), true);
  await page.keyboard.press('End');
  assert.equal(await compare.isDisabled(), false);
  await page.getByRole('button', { name: 'Erase' }).click();
  assert.equal(await compare.isDisabled(), true);
  const box = await sketch.boundingBox();
  const place = (part, up) => [box.x + box.width * (58 + part * 568) / 640, box.y + box.height * (12 + (1 - up) * 254) / 300];
  // The force, as well as a mouse goes: 1 N after 0.1 s, which decays with 0.5 s.
  await page.mouse.move(...place(0, 0.125));
  await page.mouse.down();
  for (let k = 1; k <= 120; ++k) {
    const time = (4 * k) / 120;
    const force = time < 0.12 ? 0 : Math.exp(-(time - 0.1) / 0.5);
    await page.mouse.move(...place(k / 120, (force + 0.2) / 1.6));
  }
  await page.mouse.up();
  await page.reload();
  await page.waitForFunction(() => document.querySelector('.lesson-steps .primary')?.disabled === false);
  await compare.click();
  const off = Number(/On average your curve is (\d+) % of the height/.exec(await page.textContent('.lesson-steps'))[1]);
  assert.ok(off <= 8, String(off));
  await accessible(page, 'sketch');
  assert.deepEqual(wrong, []);
  await context.close();
});

test('mistakes of a lesson are named with file, line and column', async () => {
  const wrong = {
    'prompt = "A belt is stretched suddenly and held. What does its force do?"\n': ['', /belt\.lesson:5:2: error: \[predict\] needs `prompt`/],
    'y      = "k1.force"': ['y      = "k1.forse"', /belt\.lesson:7:10: error: the netlist has no record `k1\.forse`[^]*did you mean `k1\.force`\?/],
    'y     = "k*x0"': ['y     = "k*x"', /the curve `y`: .*`x`/],
    'y     = "k*x0" ': ['y     = "x0"', /the curve `y`: .*expected a force \(N\), found a length \(m\)/],
    'y     = "k*x0*exp(-t*k/B)"': ['y     = [1, "2 N"]', /a curve `y` that is drawn has two or more numbers/],
    'right = true\n': ['', /of the choices 0 are right, and one must be/],
    '"parameters.B"': ['"parameters.C"', /`parameters\.C` is no number of the netlist that has a slider/],
    '"50 N*s/m"': ['"50 N"', /the preset `thin oil`: .*/],
    'level   = "beginner"': ['level   = "simple"', /`simple` is no level[^]*`beginner`, `intermediate` or `advanced`/],
    'title   = { de = "Ein Riemen lässt nach" }': ['title   = "A belt relaxes"', /`title` must be a table[^]*title\.de = "\.\.\."/],
    'minutes = 10': ['minuts = 10', /unknown key `minuts`[^]*did you mean `minutes`\?/],
  };
  for (const [right, [instead, message]] of Object.entries(wrong)) {
    assert.ok(example.includes(right.trimEnd()), right);
    writeFileSync(join(desk.folder, 'belt.lesson'), example.replace(right.trimEnd(), instead.trimEnd()));
    const { page, close } = await open('#lesson=belt.toml', {}, (page) => page.locator('.lesson-steps pre.bad').first().waitFor());
    assert.match(await page.locator('.lesson-steps').textContent(), message);
    assert.ok(await page.locator('.plots-box').isVisible());
    await close();
  }
  writeFileSync(join(desk.folder, 'belt.lesson'), example);
});

test('the gallery, the page and the next lesson have the title in the language of the page', async () => {
  const context = await chromium.newContext({ viewport: { width: 1200, height: 900 }, locale: 'de-DE' });
  const { page, wrong } = await watched(context, server.origin);
  await page.goto(server.address);
  const card = page.locator('.card[data-file="teaching/oscillator-free.toml"]');
  await card.waitFor();
  assert.equal(await card.locator('.card-title').textContent(), 'Schwinger: frei, ohne Dämpfung');
  assert.equal(await page.locator('.card[data-file="hard/bounces.toml"] .card-title').textContent(), 'A ball on a stiff stop, in a guide with dry friction');
  await card.click();
  await offered(page);
  assert.equal(await page.locator('h1').textContent(), 'Schwinger: frei, ohne Dämpfung');
  assert.deepEqual(wrong, []);
  await context.close();
});

test('the gallery has level and minutes, the easiest first, and opens the lesson', async () => {
  const context = await chromium.newContext({ viewport: { width: 1200, height: 900 } });
  const { page, wrong } = await watched(context, server.origin);
  await page.goto(server.address);
  await page.locator('.gallery[open] .card').first().waitFor();
  const first = page.locator('.card').first();
  assert.equal(await first.locator('.card-lesson').textContent(), 'Lesson: beginner, 5 minutes');
  const levels = (await page.locator('.card-lesson').allTextContents()).map((words) => ['beginner', 'intermediate', 'advanced'].findIndex((level) => words.includes(level)));
  assert.equal(levels.length, lessons.length);
  assert.deepEqual(levels, [...levels].sort());
  await page.getByLabel('Level').selectOption('advanced');
  assert.equal(await page.locator('.card:visible').count(), levels.filter((level) => level === 2).length);
  await page.locator('.gallery input').fill('no such words');
  assert.match(await page.textContent('.gallery [role=status]'), /No netlist has the words “no such words”/);
  await page.locator('.gallery input').fill('');
  await page.getByLabel('Level').selectOption('');
  await first.click();
  await offered(page);
  assert.ok(page.url().endsWith('#lesson=teaching%2Foscillator-free.toml'), page.url());
  assert.deepEqual(wrong, []);
  await context.close();
});
