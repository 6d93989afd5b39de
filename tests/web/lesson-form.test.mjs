// The form of a lesson: made from nothing and sent as a link, mistakes at their fields, saved beside the netlist, edited without loss, and hostile
// lessons in links.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { deflateRawSync } from 'node:zlib';
import { netlist, number, redrawn, setUp } from './desk.mjs';
import { accessible, bingham, done } from './support.mjs';

const own = `# Written by hand.
level   = "advanced"
minutes = 25          # with time to argue

[demo]
question.de = "Was hält den Körper?"

[predict]
prompt.en = "What does the torque do?"
prompt.de = "Was macht das Drehmoment?"
y         = "k1.force"

[[predict.choices]]
text.en = "It stays."
text.de = "Es bleibt."
y       = "7 N*m"
reply   = "Tc + B w"
right   = true

[[predict.choices]]   # the usual mistake
text.en = "It vanishes."
text.de = "Es verschwindet."
y       = "Tc*exp(-t/T)"
reply.en = """
Nothing releases it.

It would have to be unloaded."""

[[presets]]
name   = "dry"
values = { "parameters.B" = "0 N*m*s/rad" }

[explain]
en = """
The slider holds.
"""
`;
const withT = bingham.replace('Tc = ', 'T = "50 ms"\nTc = ');
const desk = setUp({ 'bingham.toml': bingham, 'taught.toml': withT, 'taught.lesson': own, 'plain.toml': bingham });
const { open } = desk;
const inFolder = (name) => join(desk.folder, name);

const choose = async (page, menu, item) => {
  await page.getByRole('button', { name: `${menu} ▾` }).click();
  await page.getByRole('menuitem', { name: item }).click();
};
const form = (page) => page.locator('dialog.lesson-form[open]');
const box = (page, name, k = 0) => form(page).getByRole('textbox', { name, exact: true }).nth(k);
const show = (page) => form(page).getByRole('button', { name: 'See it as a student' }).click();
const offered = (page) => page.locator('.choices, .sketch').first().waitFor();
const lessonText = async (page) => {
  const [download] = await Promise.all([page.waitForEvent('download'), choose(page, 'Save', 'Download the lesson')]);
  return readFileSync(await download.path(), 'utf8');
};
// Shows the lesson, which has no mistakes.
const pass = async (page) => {
  await show(page);
  await form(page).waitFor({ state: 'detached' });
  await offered(page);
};
// Until a mistake is shown at a field that can be seen: one that is hidden keeps the mark that it had.
const marked = (page) => form(page).locator('[aria-invalid]:visible').first().waitFor();
const whyOf = (page, field) => field.evaluate((input) => document.getElementById(input.getAttribute('aria-describedby')).textContent);

test('a lesson is made from nothing, sent as a link, and taken by a student', async () => {
  const { page, close } = await open('');
  await page.locator('.gallery[open]').getByRole('button', { name: 'New scene' }).click();
  await page.locator('.cm-content').focus();
  await page.keyboard.press('Control+a');
  await redrawn(page, () => page.keyboard.insertText(bingham));
  await choose(page, 'Save', 'Make a lesson');
  await accessible(page, 'the form, for a sketch');
  assert.equal(await form(page).getByLabel('The students predict').inputValue(), 'k1.force');
  await form(page).getByLabel('How', { exact: true }).selectOption('choices');
  // From here on by the keyboard.
  await box(page, 'Question').focus();
  await page.keyboard.type('The drum turns evenly. What does the torque do?');
  for (let k = 0; k < 4; ++k) await page.keyboard.press('Tab');
  for (const words of ['It grows without bound.', '', '' /* Draw */, 'Something gives way.', 'It stays at $T_c + B\\omega$.', '7 N*m']) {
    await page.keyboard.type(words);
    await page.keyboard.press('Tab');
  }
  assert.deepEqual([await box(page, 'Answer').inputValue(), await box(page, 'Reply to it').inputValue(), await box(page, 'Its curve', 1).inputValue()],
    ['It grows without bound.', 'Something gives way.', '7 N*m']);
  await form(page).getByRole('radio').nth(1).check();
  await box(page, 'Explanation afterwards').fill('The slider gives $T_c$.\n\nThe dashpot gives $B\\omega$, and $\\nu$ is not a line.');
  await accessible(page, 'the form, for choices');
  await pass(page);
  assert.equal(await page.locator('.plots-box').isVisible(), false);
  await page.getByText('This is what students see').first().waitFor();
  await page.getByRole('button', { name: 'Link', exact: true }).click();
  await page.locator('.toast', { hasText: 'opens the lesson' }).waitFor();
  const link = await page.evaluate(() => location.hash);
  assert.match(link, /^#s=/);
  assert.ok(link.length < 900, String(link.length));
  await choose(page, 'Export', 'Link as a QR code');
  assert.ok(await page.locator('.qr svg').isVisible());
  await close();

  for (const width of [390, 1280]) {
    const { page: student, close: end } = await open(link, { viewport: { width, height: 800 } }, offered);
    for (const part of ['.plots-box', '.sliders-box']) assert.equal(await student.locator(part).isVisible(), false, part);
    assert.match(await student.textContent('.lesson-steps'), /The drum turns evenly/);
    assert.equal(await student.getByRole('button', { name: 'Edit the lesson' }).count(), 0);
    assert.equal(await student.locator('.choice-picture').count(), 1);
    await student.getByRole('radio', { name: 'It grows without bound.' }).check();
    await student.getByRole('button', { name: 'Compare with the run' }).click();
    assert.match(await student.textContent('.lesson-steps'), /That is not what happens\.Something gives way\./);
    assert.deepEqual(await student.locator('.lesson-steps .key').allTextContents(), ['the run']);
    await student.locator('.lesson-steps summary', { hasText: 'Why' }).click();
    assert.equal(await student.locator('.lesson-steps details .formula .katex').count(), 3);
    assert.equal(await student.locator('.lesson-steps summary').count(), 1);
    await accessible(student, `the lesson at ${width} px`);
    assert.equal(await student.evaluate(() => document.documentElement.scrollWidth > innerWidth), false);
    // The link carries the lesson as it was at first, and the lesson begins again there.
    await redrawn(student, () => number(student, 'parameters.Tc').fill('5').then(() => number(student, 'parameters.Tc').press('Enter')));
    await student.getByRole('button', { name: 'Begin this lesson again' }).click();
    await student.waitForFunction(() => document.body?.classList.contains('predicting') && document.querySelector('.choices'));
    await student.reload();
    await offered(student);
    assert.equal(await student.locator('.plots-box').isVisible(), false);
    await student.getByRole('radio').nth(1).check();
    await student.getByRole('button', { name: 'Compare with the run' }).click();
    await student.getByText('That is what happens.').waitFor();
    await student.getByRole('button', { name: 'Leave the lesson' }).click();
    await student.locator('.plots-box').waitFor();
    assert.equal(await student.locator('.lesson-box').isVisible(), false);
    assert.equal(await netlist(student), bingham);
    await end();
  }
});

test('a sketched prediction, with an axis on which the run has room', async () => {
  const { page, close } = await open();
  await choose(page, 'Save', 'Make a lesson');
  assert.deepEqual([await box(page, 'Axis from').inputValue(), await box(page, 'Axis to').inputValue()], ['-1.4 N*m', '8.4 N*m']);
  await form(page).getByLabel('The students predict').selectOption('mid.velocity');
  assert.deepEqual([await box(page, 'Axis from').inputValue(), await box(page, 'Axis to').inputValue()], ['-2 rad/s', '12 rad/s']);
  await box(page, 'Question').fill('How fast?');
  await show(page);
  await page.locator('.sketch').focus();
  await page.keyboard.press('End');
  await page.getByRole('button', { name: 'Compare with the run' }).click();
  await page.getByText('On average your curve is').waitFor();
  assert.equal(await page.getByText('4. Explain').count(), 0);
  await page.getByRole('button', { name: 'Edit the lesson' }).click();
  assert.equal(await box(page, 'Question').inputValue(), 'How fast?');
  await close();
});

test('the curve of an answer is drawn, and drawn anew', async () => {
  const { page, close } = await open('#file=plain.toml');
  const drawnIn = async () => JSON.parse(/^y = (\[.*\])$/m.exec(await lessonText(page))?.[1] ?? 'null');
  await choose(page, 'Save', 'Make a lesson');
  await box(page, 'Question').fill('What does the torque do?');
  await form(page).getByLabel('How', { exact: true }).selectOption('choices');
  for (let k = 0; k < 2; ++k) await box(page, 'Answer', k).fill(`Answer ${k}`);
  await form(page).getByRole('radio').first().check();
  const pen = form(page).getByRole('button', { name: 'Draw', exact: true });
  await box(page, 'Its curve', 0).fill('7 N*m');
  await pen.first().click();
  assert.equal(await box(page, 'Its curve', 0).inputValue(), '7 N*m'); // until something is drawn
  const sketch = form(page).locator('.sketch');
  await sketch.focus();
  for (let k = 0; k < 5; ++k) await page.keyboard.press('ArrowUp');
  await show(page);
  assert.equal(await whyOf(page, box(page, 'Its curve', 0)), 'Draw to the end of the run.');
  await sketch.focus();
  await page.keyboard.press('End');
  assert.equal(await box(page, 'Its curve', 0).inputValue(), '');
  await accessible(page, 'the form, with a sketch');
  await pass(page);
  assert.match(await page.locator('.choice-curve').first().getAttribute('d'), /^M8\.0 /);
  const drawn = await drawnIn();
  assert.equal(drawn.length, 61);
  assert.ok(drawn.every((value) => Math.abs(value - 2.45) < 0.01), String(drawn)); // five twentieths of -1.4 to 8.4 N m
  // It is there again, and stays as it is.
  await page.getByRole('button', { name: 'Edit the lesson' }).click();
  assert.ok(await sketch.isVisible());
  await pass(page);
  assert.deepEqual(await drawnIn(), drawn);
  await page.getByRole('button', { name: 'Edit the lesson' }).click();
  await box(page, 'Its curve', 0).fill('5 N*m');
  assert.equal(await sketch.count(), 0);
  await pass(page);
  assert.equal(await drawnIn(), null);
  assert.match(await lessonText(page), /^y = "5 N\*m"$/m);
  await page.getByRole('button', { name: 'Edit the lesson' }).click();
  await box(page, 'Its curve', 0).fill('');
  await pass(page);
  assert.equal(await page.locator('.choice-curve').count(), 0);
  await close();
});

test('mistakes are shown at their fields, and what was typed stays when the form is closed', async () => {
  const { page, close } = await open();
  await choose(page, 'Save', 'Make a lesson');
  await show(page);
  assert.equal(await whyOf(page, box(page, 'Question')), 'A value is missing.');
  assert.ok(await box(page, 'Question').evaluate((input) => input === document.activeElement && input.getAttribute('aria-invalid') === 'true'));
  await box(page, 'Question').fill('What now?');
  assert.equal(await whyOf(page, box(page, 'Question')), '');
  await box(page, 'Axis to').fill('8 N');
  await box(page, 'Minutes').fill('ten');
  await show(page);
  await marked(page);
  assert.match(await whyOf(page, box(page, 'Axis to')), /expected a torque.*found a force/);
  assert.match(await whyOf(page, box(page, 'Minutes')), /`minutes` is a number above 0/);
  assert.equal(await whyOf(page, box(page, 'Axis from')), '');
  await box(page, 'Minutes').fill('10');
  await form(page).getByLabel('How', { exact: true }).selectOption('choices');
  await form(page).getByRole('button', { name: 'Add an answer' }).click();
  for (let k = 0; k < 3; ++k) await box(page, 'Answer', k).fill(`Answer ${k}`);
  await box(page, 'Its curve', 0).fill('Tc');
  await box(page, 'Its curve', 1).fill('2*Td');
  await box(page, 'Its curve', 2).fill('2 "N');
  await form(page).getByRole('radio').nth(2).check();
  await show(page);
  await marked(page);
  assert.equal(await whyOf(page, box(page, 'Its curve', 0)), '');
  assert.match(await whyOf(page, box(page, 'Its curve', 1)), /`Td`/);
  assert.notEqual(await whyOf(page, box(page, 'Its curve', 2)), '');
  await accessible(page, 'mistakes in the form');
  await form(page).getByRole('button', { name: 'Remove' }).nth(2).click();
  assert.equal(await form(page).getByRole('button', { name: 'Remove' }).count(), 0); // two are the fewest
  await page.keyboard.press('Escape');
  assert.equal(await form(page).count(), 0);
  await choose(page, 'Save', 'Make a lesson');
  assert.equal(await box(page, 'Its curve', 1).inputValue(), '2*Td');
  await box(page, 'Its curve', 1).fill('2*Tc');
  await show(page);
  await form(page).getByText('mark the right one').waitFor();
  await form(page).getByRole('radio').first().check();
  await pass(page);
  await close();
});

test('the lesson is saved beside its netlist, and the gallery has it', async () => {
  const { page, close } = await open('#file=plain.toml');
  await choose(page, 'Save', 'Make a lesson');
  await box(page, 'Question').fill('And now?');
  await pass(page);
  await page.getByRole('button', { name: 'Save ▾' }).click();
  assert.deepEqual(await page.getByRole('menuitem').allTextContents(), ['Save as plain.toml, plain.lesson', 'Save in the folder as …', 'Download the netlist', 'Download the lesson', 'Edit the lesson']);
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('menuitem', { name: 'Download the lesson' }).click()]);
  assert.equal(download.suggestedFilename(), 'plain.lesson');
  // Another one came there meanwhile: it is not overwritten without a question.
  writeFileSync(inFolder('plain.lesson'), own);
  await page.keyboard.press('Control+s');
  await page.locator('dialog.save[open]').getByText('there is already').waitFor();
  assert.equal(readFileSync(inFolder('plain.lesson'), 'utf8'), own);
  const question = page.locator('dialog.save');
  assert.match(await question.locator('.why').textContent(), /there is already a lesson `plain\.lesson`.*Overwrite the lesson, or cancel/);
  assert.deepEqual([await question.getByRole('textbox').getAttribute('readonly'), await question.getByRole('button').allTextContents()], ['', ['Cancel', 'Overwrite it']]);
  await page.locator('dialog.save').getByRole('button', { name: 'Overwrite it' }).click();
  await page.locator('.toast', { hasText: 'Saved as plain.lesson.' }).waitFor();
  const saved = readFileSync(inFolder('plain.lesson'), 'utf8');
  assert.equal(saved, readFileSync(await download.path(), 'utf8'));
  assert.match(saved, /prompt = \{ en = "And now\?" \}/);
  assert.equal(readFileSync(inFolder('plain.toml'), 'utf8'), bingham);
  assert.ok(page.url().endsWith('#lesson=plain.toml'));
  await page.reload();
  await offered(page);
  await page.getByRole('button', { name: 'Gallery' }).click();
  assert.equal(await page.locator('.card[data-file="plain.toml"] .card-lesson').textContent(), 'Lesson: beginner, 10 minutes');
  // A netlist is not saved under the name of a lesson.
  await page.keyboard.press('Escape');
  await choose(page, 'Save', 'Save in the folder as …');
  await question.getByRole('textbox').fill('plain.lesson');
  await question.getByRole('button', { name: 'Save', exact: true }).click();
  await question.getByText('the name of a netlist ends in .toml').waitFor();
  assert.equal(await question.getByRole('button', { name: 'Overwrite it' }).count(), 0);
  await question.getByRole('button', { name: 'Cancel' }).click();
  assert.equal(readFileSync(inFolder('plain.lesson'), 'utf8'), saved);
  // A new name is that of both files.
  await choose(page, 'Save', 'Edit the lesson');
  await box(page, 'Minutes').fill('7');
  await pass(page);
  await choose(page, 'Save', 'Save in the folder as …');
  await page.locator('dialog.save input').fill('other');
  await page.locator('dialog.save').getByRole('button', { name: 'Save', exact: true }).click();
  await page.locator('.toast', { hasText: 'Saved as other.lesson.' }).waitFor();
  assert.ok(existsSync(inFolder('other.toml')));
  assert.match(readFileSync(inFolder('other.lesson'), 'utf8'), /minutes = 7\n/);
  assert.equal(readFileSync(inFolder('plain.lesson'), 'utf8'), saved);
  await close(['Failed to load resource: the server responded with a status of 409 (Conflict)']);
});

test('editing keeps presets, comments and the texts in other languages', async () => {
  const { page, close } = await open('#lesson=taught.toml', {}, offered);
  await choose(page, 'Save', 'Edit the lesson');
  assert.deepEqual([await box(page, 'Question').inputValue(), await box(page, 'Minutes').inputValue(), await box(page, 'Its curve', 1).inputValue()], ['What does the torque do?', '25', 'Tc*exp(-t/T)']);
  // Without a change it is the same text.
  await pass(page);
  const save = async () => {
    await page.keyboard.press('Control+s');
    await page.locator('.toast', { hasText: 'Saved as taught.lesson.' }).waitFor();
  };
  await save();
  assert.equal(readFileSync(inFolder('taught.lesson'), 'utf8'), own);
  await choose(page, 'Save', 'Edit the lesson');
  await box(page, 'Question').fill('What does the torque do in the end?');
  await box(page, 'Reply to it', 0).fill('Tc and B w');
  await form(page).getByRole('radio').nth(1).check();
  await form(page).getByRole('button', { name: 'Add an answer' }).click();
  await box(page, 'Answer', 2).fill('It doubles.');
  await form(page).getByLabel('Level').selectOption('beginner');
  await pass(page);
  await save();
  const expected = own.replace('"What does the torque do?"', '"What does the torque do in the end?"').replace('"Tc + B w"', '"Tc and B w"').replace('right   = true\n', '')
    .replace('"advanced"', '"beginner"').replace('unloaded."""\n', 'unloaded."""\nright = true\n\n[[predict.choices]]\ntext = { en = "It doubles." }\n');
  assert.equal(readFileSync(inFolder('taught.lesson'), 'utf8'), expected);
  // In German: only the German texts change. An answer in between is removed.
  await page.locator('select.language').selectOption('de');
  await page.waitForFunction(() => document.documentElement?.lang === 'de');
  await offered(page);
  await choose(page, 'Speichern', 'Lektion bearbeiten');
  assert.equal(await box(page, 'Frage').inputValue(), 'Was macht das Drehmoment?');
  await box(page, 'Antwort', 2).fill('Es verdoppelt sich.');
  await box(page, 'Erklärung danach').fill('Der Reiber hält.');
  await form(page).getByRole('button', { name: 'Entfernen' }).first().click();
  await form(page).locator('[type=submit]').click();
  await form(page).waitFor({ state: 'detached' });
  await offered(page);
  await page.keyboard.press('Control+s');
  await page.locator('.toast', { hasText: 'taught.lesson' }).waitFor();
  const text = readFileSync(inFolder('taught.lesson'), 'utf8');
  assert.equal(text, expected.replace(/\[\[predict.choices\]\]\ntext.en = "It stays."[^[]*/, '\n').replace('{ en = "It doubles." }', '{ en = "It doubles.", de = "Es verdoppelt sich." }')
    .replace('holds.\n"""', 'holds.\n"""\nde = "Der Reiber hält."'));
  await close();
});

test('presets and sliders of a lesson are not saved, an edit by hand is', async () => {
  writeFileSync(inFolder('kept.toml'), withT);
  writeFileSync(inFolder('kept.lesson'), own);
  const { page, close } = await open('#lesson=kept.toml', {}, offered);
  await page.getByRole('radio').first().check();
  await page.getByRole('button', { name: 'Compare with the run' }).click();
  await redrawn(page, () => page.getByRole('button', { name: 'dry', exact: true }).click());
  assert.match(await netlist(page), /B {2}= "0 N/);
  const save = async () => {
    await page.keyboard.press('Control+s');
    await page.locator('.toast', { hasText: 'Saved as kept' }).waitFor();
    return readFileSync(inFolder('kept.toml'), 'utf8');
  };
  assert.equal(await save(), withT);
  await page.getByRole('button', { name: 'as at first' }).click();
  await page.keyboard.press('e');
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+Home');
  await redrawn(page, () => page.keyboard.insertText('# By hand.\n'));
  await choose(page, 'Save', 'Edit the lesson');
  await pass(page);
  assert.equal(await netlist(page), `# By hand.\n${withT}`);
  assert.equal(await save(), `# By hand.\n${withT}`);
  await close();
});

test('a hostile lesson in a link does no harm', async () => {
  const lesson = (text) => `level = "beginner"\nminutes = 1\n[predict]\nprompt = ${JSON.stringify(text)}\ny = "k1.force"\nrange = [0, 1]\n`;
  const link = (text) => `#scene=${deflateRawSync(JSON.stringify({ scenes: [{ text: bingham, file: 'mine.toml', lesson: { text, isOwn: true } }], plots: {} })).toString('base64url')}`;
  const evil = '<img src=x onerror="window.harmed = 1"> `<script>window.harmed = 1</script>` $\\href{javascript:window.harmed=1}{x}$ $\\rule{9999em}{9999em}$ $\\def\\a{\\a\\a}\\a$';
  const { page, close } = await open(link(lesson(evil)), {}, offered);
  assert.match(await page.textContent('.lesson-steps'), /<img src=x onerror/);
  assert.equal(await page.evaluate(() => window.harmed), undefined);
  assert.equal(await page.locator('.lesson-steps :is(img, script, a)').count(), 0);
  assert.ok((await page.locator('.lesson-steps').boundingBox()).height < 3000);
  assert.equal(await page.getByRole('button', { name: 'Edit the lesson' }).count(), 0);
  await close();
  const many = Array(2000).fill('[[predict.choices]]\ntext = "a"\ny = "Tc"\n').join('');
  const { page: other, close: end } = await open(link(lesson('x').replace(/range.*\n/, '') + many), {}, done);
  await other.getByText('`choices` has 2000 items, and may have 50').first().waitFor();
  await end();
  const { page: plain, close: finish } = await open(link(lesson('x').replace(/range.*\n/, 'choices = ["a", "b"]\n')), {}, done);
  const refusal = plain.locator('.lesson-steps pre.bad').first();
  await refusal.waitFor();
  assert.match(await refusal.textContent(), /mine\.lesson:6:12: error: /);
  await finish();
  // A text that is no TOML is refused with a reason.
  const { page: broken, close: stop } = await open(link('level = ['), {}, done);
  await choose(broken, 'Save', 'Edit the lesson');
  assert.equal(await form(broken).count(), 0);
  assert.ok(await broken.locator('.toast').isVisible());
  await stop();
});

test('curves over another record are kept, and cleared on both sides; going back closes the form', async () => {
  const { page, close } = await open('#file=plain.toml');
  const text = own.replace('y         = "k1.force"', 'x         = "k1.displacement"\ny         = "k1.force"').replaceAll(/^(y {7}= .*)$/gm, '$1\nx       = [0, 1]').replace('It stays.', 'It 🙂 stays.');
  writeFileSync(inFolder('taught.lesson'), text);
  await page.evaluate(() => (location.hash = '#lesson=taught.toml'));
  await page.reload();
  await offered(page);
  await choose(page, 'Save', 'Edit the lesson');
  await pass(page);
  await page.keyboard.press('Control+s');
  await page.locator('.toast', { hasText: 'Saved as taught.lesson.' }).waitFor();
  assert.equal(readFileSync(inFolder('taught.lesson'), 'utf8'), text);
  await choose(page, 'Save', 'Edit the lesson');
  await box(page, 'Its curve', 0).fill('');
  await pass(page);
  await page.keyboard.press('Control+s');
  await page.locator('.toast', { hasText: 'Saved as taught.lesson.' }).waitFor();
  const saved = readFileSync(inFolder('taught.lesson'), 'utf8');
  assert.equal(saved.match(/^x {7}= /gm).length, text.match(/^x {7}= /gm).length - 1);
  await choose(page, 'Save', 'Edit the lesson');
  await form(page).waitFor();
  await page.goBack();
  await form(page).waitFor({ state: 'detached' });
  writeFileSync(inFolder('taught.lesson'), own);
  await close();
});
