// Netlists come from files and go to files, and no text is lost on the way.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { netlist, number, redrawn, setUp, stickSlip } from './desk.mjs';
import { accessible, bingham, done } from './support.mjs';

const desk = setUp({ 'bingham.toml': bingham, 'more/stick-slip.toml': stickSlip });
const { open } = desk;
const onDisk = (name) => readFileSync(join(desk.folder, name), 'utf8');
const conflict = 'Failed to load resource: the server responded with a status of 409 (Conflict)';
const refused = 'Failed to load resource: the server responded with a status of 400 (Bad Request)';

// Sets the stiffness of k1.
const stiffness = (page, value) => redrawn(page, async () => {
  await number(page, 'k1.stiffness').fill(String(value));
  await number(page, 'k1.stiffness').press('Enter');
});
const withStiffness = (value) => bingham.replace('"100 N*m/rad"', `"${value} N*m/rad"`);
const saidSaved = (page, name) => page.waitForFunction((file) => document.querySelector('.status').textContent === `Saved as ${file}.`, name);
const address = (page) => page.evaluate(() => location.hash);
const dialog = (page) => page.locator('dialog.save');
const why = (page) => page.locator('dialog.save .why:visible');

async function saveAs(page, name) {
  await page.locator('button', { hasText: 'Save' }).first().click();
  await page.locator('[role="menuitem"]', { hasText: 'Save in the folder as' }).click();
  await dialog(page).locator('input').fill(name);
  await page.keyboard.press('Enter');
}

test('a netlist is saved under its name, and under another', async () => {
  const { page, close } = await open();
  await stiffness(page, 150);
  await page.keyboard.press('Control+s');
  await saidSaved(page, 'bingham.toml');
  assert.equal(onDisk('bingham.toml'), withStiffness(150));
  assert.equal(await dialog(page).isVisible(), false);
  await stiffness(page, 160);
  await saveAs(page, 'more/stiffer');
  await saidSaved(page, 'more/stiffer.toml');
  assert.equal(onDisk('more/stiffer.toml'), withStiffness(160));
  assert.equal(onDisk('bingham.toml'), withStiffness(150));
  // From now on it is the one that is open.
  assert.equal(await address(page), '#file=more%2Fstiffer.toml');
  await stiffness(page, 170);
  await page.keyboard.press('Control+s');
  await saidSaved(page, 'more/stiffer.toml');
  assert.equal(onDisk('more/stiffer.toml'), withStiffness(170));
  await page.reload();
  await done(page);
  assert.match(await netlist(page), /"170 N\*m\/rad"/);
  await close();
  writeFileSync(join(desk.folder, 'bingham.toml'), bingham);
  rmSync(join(desk.folder, 'more/stiffer.toml'));
});

test('another netlist is overwritten only by who says so', async () => {
  const { page, close } = await open();
  await stiffness(page, 150);
  await saveAs(page, 'more/stick-slip.toml');
  await why(page).waitFor();
  assert.match(await why(page).textContent(), /there is already a netlist `more\/stick-slip\.toml`.*Overwrite it, or give another name/);
  await accessible(page, 'question');
  await dialog(page).locator('button', { hasText: 'Cancel' }).click();
  assert.equal(onDisk('more/stick-slip.toml'), stickSlip);
  assert.equal(await address(page), '#file=bingham.toml');
  await saveAs(page, 'more/stick-slip.toml');
  await why(page).waitFor();
  // Another name is no answer to the question.
  await dialog(page).locator('input').fill('other.toml');
  assert.equal(await dialog(page).locator('.overwrite').isVisible(), false);
  await page.keyboard.press('Enter');
  await saidSaved(page, 'other.toml');
  assert.equal(onDisk('more/stick-slip.toml'), stickSlip);
  await saveAs(page, 'more/stick-slip.toml');
  await dialog(page).locator('.overwrite').click();
  await saidSaved(page, 'more/stick-slip.toml');
  assert.equal(onDisk('more/stick-slip.toml'), withStiffness(150));
  await close([conflict, conflict, conflict]);
  writeFileSync(join(desk.folder, 'more/stick-slip.toml'), stickSlip);
  rmSync(join(desk.folder, 'other.toml'));
});

test('what somebody else has written meanwhile is not lost', async () => {
  const { page, close } = await open();
  await stiffness(page, 150);
  writeFileSync(join(desk.folder, 'bingham.toml'), withStiffness(90));
  await page.keyboard.press('Control+s');
  await why(page).waitFor();
  assert.match(await why(page).textContent(), /`bingham\.toml` has changed since it was opened here/);
  assert.equal(onDisk('bingham.toml'), withStiffness(90));
  // It is asked again if it changes while the question stands.
  writeFileSync(join(desk.folder, 'bingham.toml'), withStiffness(91));
  const [answer] = await Promise.all([page.waitForResponse('**/api/save'), dialog(page).locator('.overwrite').click()]);
  assert.equal(answer.status(), 409);
  assert.equal(onDisk('bingham.toml'), withStiffness(91));
  await dialog(page).locator('.overwrite').click();
  await saidSaved(page, 'bingham.toml');
  assert.equal(onDisk('bingham.toml'), withStiffness(150));
  await close([conflict, conflict]);
  writeFileSync(join(desk.folder, 'bingham.toml'), bingham);
});

test('a name that is none is told so, and nothing is written', async () => {
  const { page, close } = await open();
  for (const [name, reason] of [['../out', /leads out of the folder/], ['new.txt', /ends in \.toml/], ['none/new', /no folder `none`/]]) {
    await saveAs(page, name);
    await why(page).waitFor();
    assert.match(await why(page).textContent(), reason);
    await dialog(page).locator('button', { hasText: 'Cancel' }).click();
  }
  assert.deepEqual(readdirSync(desk.folder).sort(), ['bingham.toml', 'more']);
  await close([refused, refused]);
});

test('a page that is loaded anew before its netlist has come is not taken for one that somebody has changed', async () => {
  const { page, close } = await open('#file=bingham.toml', {}, (it) => it.reload());
  await done(page);
  assert.equal(await netlist(page), bingham);
  await close();
});

test('a netlist of this machine is opened, and the way back leads to the one before', async () => {
  const { page, close } = await open();
  const before = await netlist(page);
  await page.getByRole('button', { name: 'Gallery' }).click();
  const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: 'Open a file …' }).click()]);
  await redrawn(page, () => chooser.setFiles({ name: 'mine.toml', mimeType: 'application/toml', buffer: Buffer.from(before.replace(/^title = .*$/m, 'title = "Mine"')) }));
  assert.match(await netlist(page), /title = "Mine"/);
  assert.equal(await page.locator('.gallery').evaluate((dialog) => dialog.open), false);
  await page.goBack();
  await page.waitForFunction((text) => [...document.querySelectorAll('.cm-line')].map((line) => line.textContent).join('\n') === text, before);
  await close();
});

test('changes that nobody has saved are there again after the page is loaded anew, and behind the way back', async () => {
  const { page, close } = await open();
  await stiffness(page, 150);
  await page.reload();
  await page.waitForFunction(() => document.querySelector('.status').dataset.latency);
  assert.equal(await netlist(page), withStiffness(150));
  assert.match(await page.textContent('.status'), /as you left it; it is not saved/);
  await stiffness(page, 155);
  await page.keyboard.press('Escape');
  await page.locator('button', { hasText: 'Gallery' }).click();
  await page.locator('.card', { hasText: 'Stick and slip' }).click();
  await page.waitForFunction(() => document.querySelector('h1').textContent === 'Stick and slip');
  await done(page);
  await page.goBack();
  await page.waitForFunction(() => document.querySelector('h1').textContent === 'Bingham element');
  assert.equal(await netlist(page), withStiffness(155));
  await page.goForward();
  await page.waitForFunction(() => document.querySelector('h1').textContent === 'Stick and slip');
  await page.goBack();
  // Both of two variants.
  await page.waitForFunction(() => document.querySelector('h1').textContent === 'Bingham element');
  await page.locator('button', { hasText: 'Compare' }).click();
  await stiffness(page, 300);
  await page.reload();
  await page.waitForSelector('.variants:visible');
  await page.waitForFunction(() => document.querySelector('.status').dataset.latency);
  assert.equal(await netlist(page), withStiffness(300));
  await page.locator('.variants label', { hasText: 'Edit A' }).click();
  assert.equal(await netlist(page), withStiffness(155));
  // A saved netlist is not kept in the browser: a reload shows the file in the folder.
  await page.locator('button', { hasText: 'End comparison' }).click();
  await page.keyboard.press('Control+s');
  await saidSaved(page, 'bingham.toml');
  writeFileSync(join(desk.folder, 'bingham.toml'), withStiffness(77));
  await page.reload();
  await done(page);
  assert.equal(await netlist(page), withStiffness(77));
  await close();
  writeFileSync(join(desk.folder, 'bingham.toml'), bingham);
});
