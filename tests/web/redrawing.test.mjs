// A netlist that changes: its schematic becomes the one of a page that has just opened the changed netlist.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { at, number, oscillator, redrawn, setUp } from './desk.mjs';

// A slider that holds up to 2 N, without a mass to accelerate beyond that; and a mass on a spring.
const held = `[elements]
push = { type = "force", at = "block", force = "1 N" }
rubbing = { type = "slider", between = ["block", "ground"], coulomb = "2 N" }
pull = { type = "force", at = "body", force = "1 N" }
body = { type = "mass", at = "body", mass = "1 kg" }
k = { type = "spring", between = ["body", "ground"], stiffness = "100 N/m" }
[simulate]
stop = "2 s"
record = ["body.position"]
`;
// In translation and in rotation the same symbols, with names that are wider than their values.
const both = `[elements]
spring_of_steel = { type = "spring", between = ["block", "ground"], stiffness = 1 }
dashpot_with_oil = { type = "dashpot", between = ["block", "ground"], damping = 1 }
[nodes]
block = { position = 1 }
[simulate]
stop = 2
record = ["block.position"]
`;
const free = `[elements]
push = { type = "force", at = "body", force = "1 N" }
body = { type = "mass", at = "body", mass = "1 kg" }
[simulate]
stop = "2 s"
record = ["body.position"]
`;
const desk = setUp({ 'oscillator.toml': oscillator, 'held.toml': held, 'both.toml': both, 'free.toml': free });

// The visible state of the schematic: texts and wires with their places on the screen [px], arrows, and the symbols that turn or stick.
const seen = (page) => page.locator('.drawing svg').evaluate((svg) => ({
  shapes: [...svg.querySelectorAll('text, path.node')].map((shape) => {
    const { x, y, width } = shape.getBoundingClientRect();
    return `${shape.textContent} ${[x, y, width].map(Math.round)}`;
  }),
  arrows: [...svg.querySelectorAll('.arrows')].filter((group) => group.style.display !== 'none').length,
  turning: svg.querySelectorAll('.turns').length,
  sticking: svg.querySelectorAll('.sticks').length,
  box: svg.getAttribute('viewBox'),
  name: svg.getAttribute('aria-label').replace('now.toml', '').replace(/\w+\.toml/, ''),
}));
// The page shows what one does that opens this netlist.
async function isAsOpened(page, text, part, ready = undefined) {
  writeFileSync(join(desk.folder, 'now.toml'), text);
  const fresh = await desk.open('#file=now.toml', {}, ready);
  if (part) await at(fresh.page, part);
  assert.deepEqual(await seen(page), await seen(fresh.page), text);
  await fresh.close();
}
const enter = async (page, path, value) => {
  await number(page, path).fill(value);
  await number(page, path).press('Enter');
};

test('a changed number is written into the schematic, which is drawn anew only where more has changed', async () => {
  const { page, close } = await desk.open('#file=oscillator.toml');
  const svg = page.locator('.drawing .schematic svg');
  await svg.evaluate((node) => (node.dataset.first = 'yes'));
  let text = oscillator;
  // At the start and in motion. A longer text needs more room.
  for (const [path, before, now, part, isFirst] of [
    ['k.stiffness', '100 N/m', '200 N/m', 0, true], ['k.stiffness', '200 N/m', '300 N/m', 0.3, true], ['block.mass', '1 kg', '2 kg', 0.3, true],
    ['k.stiffness', '300 N/m', '123456 N/m', 0, false], ['block.mass', '2 kg', '23456.7 kg', 0.3, false],
  ]) {
    await at(page, part);
    await redrawn(page, () => enter(page, path, now.split(' ')[0]));
    assert.equal((await svg.getAttribute('data-first')) === 'yes', isFirst, now);
    assert.ok((await svg.textContent()).includes(now), now);
    await isAsOpened(page, (text = text.replace(before, now)), part);
  }
  await close();
});

test('an answer that comes late, and its rows later still, is shown as any other', async () => {
  const { page, close } = await desk.open('#file=oscillator.toml');
  await page.route('**/api/task', async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 400));
    await route.continue();
  });
  await at(page, 0.3);
  await redrawn(page, () => enter(page, 'k.stiffness', '200'));
  await isAsOpened(page, oscillator.replace('100 N/m', '200 N/m'), 0.3);
  await close();
});

test('a run that fails at its start leaves the schematic at rest, and the next one moves it', async () => {
  const { page, close } = await desk.open('#file=held.toml');
  await page.locator('[data-shows="forces"]').check();
  await at(page, 0.3);
  const failed = (other) => other.waitForFunction(() => /did not come to its end/.test(document.querySelector('.status').textContent));
  await enter(page, 'push.force', '3');
  await failed(page);
  await isAsOpened(page, held.replace('1 N', '3 N'), 0, failed);
  await redrawn(page, () => enter(page, 'push.force', '1'));
  await page.locator('[data-shows="forces"]').uncheck();
  await at(page, 0.3);
  await isAsOpened(page, held, 0.3);
  await close();
});

test('a schematic whose symbols mean something else is drawn anew, and another title names it', async () => {
  const { page, close } = await desk.open('#file=both.toml');
  let text = both;
  for (const line of ['domain = "rotation"\n', 'title = "Another"\n']) {
    await page.locator('.cm-content').click();
    await page.keyboard.press('Control+Home');
    await redrawn(page, () => page.keyboard.insertText(line));
    await at(page, 0.5);
    await isAsOpened(page, (text = line + text), 0.5);
  }
  await close();
});

test('ground that was added for drawing goes with it', async () => {
  const { page, close } = await desk.open('#file=free.toml');
  const draw = page.getByRole('button', { name: 'Draw', exact: true });
  await draw.click();
  await page.locator('.added-ground').waitFor();
  await draw.click();
  await isAsOpened(page, free, 0);
  await close();
});
