// Sliders and what they are beside: the netlist that they write into and the curves that follow.
import assert from 'node:assert/strict';
import { rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { netlist, number, numbersOnCanvas, redrawn, setUp, shows, slider, stickSlip } from './desk.mjs';
import { bingham } from './support.mjs';

const desk = setUp();
const { open } = desk;

test('curves follow a slider while it is dragged, and so do the netlist and the schematic', async () => {
  const { page, close } = await open();
  // In the end the torque is Tc + B w.
  await shows(page, 0.999, 'k1.force', 7);
  const knob = slider(page, 'parameters.B');
  const box = await knob.boundingBox();
  const seen = new Set();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  for (let part = 0.55; part < 0.8; part += 0.05) {
    await redrawn(page, () => page.mouse.move(box.x + part * box.width, box.y + box.height / 2));
    seen.add(await number(page, 'parameters.B').inputValue());
  }
  await page.mouse.up();
  assert.ok(seen.size >= 4, [...seen].join(' '));
  const damping = Number(await number(page, 'parameters.B').inputValue());
  assert.ok(damping > 1 && damping < 15, String(damping));
  assert.match(await netlist(page), new RegExp(`B  = "${damping} N\\*m\\*s/rad"`));
  assert.match(await page.locator('.drawing').textContent(), new RegExp(`${damping} N·m·s/rad`));
  await redrawn(page, async () => {
    await number(page, 'parameters.Tc').fill('3.5');
    await number(page, 'parameters.Tc').press('Enter');
  });
  // With T = B/k the rest of the start is exp(-t/T).
  const time = 0.2 * 0.999;
  const expected = 3.5 + damping * 10 * (1 - Math.exp((-(time - 3.5 / 1000) * 100) / damping));
  await shows(page, 0.999, 'k1.force', expected, 5e-3);
  await close();
});

test('what is typed beside a slider is a number, or is not taken', async () => {
  const { page, close } = await open();
  const before = await netlist(page);
  for (const text of ['', 'abc', '1e400', '--', '7 kN*m', '2*3', '1,500', '0x10']) {
    await number(page, 'parameters.Tc').fill(text);
    await number(page, 'parameters.Tc').press('Enter');
    assert.equal(await number(page, 'parameters.Tc').getAttribute('aria-invalid'), 'true', text);
    assert.match(await page.locator('[data-slider="parameters.Tc"] .why').textContent(), /not a number of N\*m/, text);
    await number(page, 'parameters.Tc').press(text === 'abc' ? 'Tab' : 'Escape');
    assert.equal(await number(page, 'parameters.Tc').inputValue(), '2', text);
    assert.equal(await number(page, 'parameters.Tc').getAttribute('aria-invalid'), null, text);
  }
  assert.equal(await netlist(page), before);
  await redrawn(page, async () => {
    await number(page, 'parameters.Tc').fill('2.500001');
    await number(page, 'parameters.Tc').press('Enter');
  });
  assert.match(await netlist(page), /Tc = "2.500001 N\*m"/);
  assert.equal(await number(page, 'parameters.Tc').inputValue(), '2.500001');
  await shows(page, 0.999, 'k1.force', 7.5);
  await close();
});

test('sliders are those of the netlist that is open', async () => {
  const { page, close } = await open();
  const text = bingham.replace('"spring"', '"sprong"').replace('[parameters]', '# Longer than it was.\n[parameters]');
  writeFileSync(join(desk.folder, 'wrong.toml'), text);
  await page.evaluate(() => (location.hash = '#file=wrong.toml'));
  await page.waitForSelector('.mistake.error');
  assert.equal(await page.locator('.slider, .drawing svg').count(), 0);
  assert.equal(await page.textContent('h1'), 'wrong.toml');
  assert.equal(await netlist(page), text);
  // They come with the scene, long before its run is done.
  writeFileSync(join(desk.folder, 'slow.toml'), stickSlip.replace('"8 s"', '"1e7 s"').replace('points = 801', 'points = 3'));
  await page.evaluate(() => (location.hash = '#file=slow.toml'));
  await number(page, 'k1.stiffness').fill('125');
  await number(page, 'k1.stiffness').press('Enter');
  assert.match(await netlist(page), /stiffness = "125 N\/m" }\nm1 =/);
  assert.equal(await page.locator('.drawing [data-element="s1"]').count(), 1);
  ['wrong.toml', 'slow.toml'].forEach((name) => rmSync(join(desk.folder, name)));
  await close();
});

test('a slider goes from a tenth of its value to ten times that, rounded, and of a ratio from 0 to 1', async () => {
  const { page, close } = await open();
  await page.locator('.cm-content').fill(`[parameters]
e = 0.8
m = "0.2 kg"
g = "9.81 m/s^2"
[elements]
ball = { type = "mass", at = "ball", mass = "m" }
weight = { type = "force", at = "ball", force = "-m*g" }
floor = { type = "stop", between = ["ball", "ground"], lower = 0, stiffness = "inf", restitution = "e" }
[nodes]
ball = { position = "1 m" }
[simulate]
stop = "1 s"
`);
  const ends = (path) => page.locator(`.slider[data-slider="${path}"] .limits span`).allTextContents();
  await slider(page, 'parameters.e').waitFor();
  assert.deepEqual(await ends('parameters.e'), ['0', '1']);
  assert.deepEqual(await ends('parameters.g'), ['0.5', '100']);
  assert.deepEqual(await ends('parameters.m'), ['0.02', '2']);
  await close();
});

test('what is reset belongs to the scene: another text has other first numbers', async () => {
  const { page, close } = await open();
  await redrawn(page, () => number(page, 'parameters.Tc').fill('3').then(() => number(page, 'parameters.Tc').press('Enter')));
  assert.ok(await page.locator('.undo-all').isVisible());
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+a');
  await redrawn(page, () => page.keyboard.insertText(bingham.replace('2 N*m', '7 N*m')));
  assert.equal(await page.locator('.undo-all').isVisible(), false);
  await redrawn(page, () => number(page, 'parameters.Tc').fill('8').then(() => number(page, 'parameters.Tc').press('Enter')));
  await redrawn(page, () => page.locator('.undo-all').click());
  assert.match(await netlist(page), /Tc = "7 N\*m"/);
  await close();
});

test('a small motion far from 0 is seen, and so is a short time far from 0', async () => {
  const { page, close } = await open();
  const written = await numbersOnCanvas(page);
  await page.locator('.cm-content').focus();
  await page.keyboard.press('Control+a');
  await redrawn(page, () => page.keyboard.insertText('[elements]\nm1 = { type = "mass", at = "a", mass = 1 }\n[nodes]\na = { position = "1 m", velocity = "20 mm/s" }\n' +
    '[simulate]\nstart = "1e6 s"\nstop = "1000000.0001 s"\nrecord = ["a.position"]\n'));
  for (const part of [0.25, 0.75]) await shows(page, part, 'a.position', 1 + part * 2e-6, 2e-8);
  const numbers = await written();
  const places = numbers.filter((value) => value > 1 && value < 1.0000021);
  const times = numbers.filter((value) => value > 1e6 && value < 1000000.00011);
  assert.ok(places.length >= 3 && times.length >= 2, numbers.join(' '));
  await close();
});

test('the newest position of a slider wins', async () => {
  const { page, close } = await open();
  const knob = slider(page, 'parameters.Tc');
  await knob.focus();
  await redrawn(page, async () => {
    for (let k = 0; k < 40; ++k) await knob.press('ArrowRight', { noWaitAfter: true });
  });
  const bound = Number(await number(page, 'parameters.Tc').inputValue());
  assert.ok(bound > 2);
  await shows(page, 0.999, 'k1.force', bound + 5);
  await close();
});

test('a slider whose number has changed in the text meanwhile is refused, until the netlist has been read again', async () => {
  const { page, close } = await open();
  // Nothing is read that is asked for from here on.
  await page.route('**/api/task', () => {});
  const line = page.locator('.cm-line', { hasText: 'Tc = ' });
  await line.click();
  await page.keyboard.press('End');
  for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowLeft', 'ArrowLeft', 'ArrowLeft', 'Backspace', '3']) await page.keyboard.press(key);
  const text = await netlist(page);
  assert.match(text, /Tc = "3 N\*m"/);
  const why = page.locator('[data-slider="parameters.Tc"] .why');
  await number(page, 'parameters.Tc').fill('5');
  await number(page, 'parameters.Tc').press('Enter');
  assert.match(await why.textContent(), /has changed here; the slider follows/);
  assert.equal(await netlist(page), text);
  await slider(page, 'parameters.Tc').focus();
  await page.keyboard.press('End');
  assert.equal(await netlist(page), text);
  assert.equal(await number(page, 'parameters.Tc').inputValue(), '2');
  // One whose number stands as it was still goes.
  await number(page, 'k1.stiffness').fill('120');
  await number(page, 'k1.stiffness').press('Enter');
  assert.match(await netlist(page), /stiffness = "120 N\*m\/rad"/);
  await page.unroute('**/api/task');
  await redrawn(page, async () => {
    await page.locator('.cm-content').focus();
    await page.keyboard.press('Control+End');
    await page.keyboard.type('#');
  });
  assert.equal(await number(page, 'parameters.Tc').inputValue(), '3');
  await redrawn(page, async () => {
    await number(page, 'parameters.Tc').fill('5');
    await number(page, 'parameters.Tc').press('Enter');
  });
  assert.equal(await why.isVisible(), false);
  await shows(page, 0.999, 'k1.force', 10);
  await close();
});
