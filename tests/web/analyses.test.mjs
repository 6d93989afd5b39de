// Panels that take many runs of a scene: its effects, the price of accuracy, a sweep.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { netlist, number, redrawn, setUp, stickSlip } from './desk.mjs';
import { accessible, bingham } from './support.mjs';

const creamy = stickSlip.replace('k1 = ', 'oil = { type = "dashpot", between = ["block", "ground"], damping = "1e-9 N*s/m" }\nk1 = ');
const demo = (name) => readFileSync(join(dirname(fileURLToPath(import.meta.url)), '../../netlists/teaching', name), 'utf8');
const desk = setUp({ 'bingham.toml': bingham, 'forced.toml': demo('oscillator-forced.toml'), 'iwan.toml': demo('coulomb-to-iwan.toml'), 'oil.toml': creamy, 'stick-slip.toml': stickSlip,
  'vfm.toml': bingham.replace('type = "dashpot",', 'type = "cfm", stiffness = "50 N*m/rad", coulomb = "3 N*m",') });

const unfold = (page, name) => page.locator(`.sections details[data-name="${name}"] summary`).first().click();
const fold = (page, name) => page.locator(`.sections details[data-name="${name}"]`);
const rows = (part) => part.evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));

test('effects: each left out by itself, the curve that changes most, and the simplest model that is good enough', async () => {
  const { page, close } = await desk.open('#file=oil.toml');
  await unfold(page, 'Effects');
  const effects = fold(page, 'Effects');
  await effects.locator('table').first().waitFor();
  assert.match(await effects.locator('.finding').textContent(), /^To 1 % this scene needs inertia, elasticity, dry friction\. Without viscosity every record stays within 1e-4 % of the full model/);
  const table = await rows(effects.locator('.scroll table').first().locator('tbody tr'));
  assert.deepEqual(table.map(([name]) => name), ['nothing (the full model)', 'inertia', 'elasticity', 'viscosity', 'dry friction']);
  const of = Object.fromEntries(table.map(([name, off]) => [name, off]));
  assert.match(of.viscosity, /^< /);
  assert.ok(Number.parseFloat(of['dry friction']) > 50, of['dry friction']);
  assert.ok(await effects.locator('.chart canvas').isVisible());
  const curves = await effects.locator('.u-label').allTextContents();
  assert.ok(curves.includes('full model') && curves.includes('without inertia'), curves.join());
  await accessible(page, 'effects');
  await close();
});

test('effects: they follow the netlist', async () => {
  const { page, close } = await desk.open('#file=oil.toml');
  await unfold(page, 'Effects');
  const verdict = fold(page, 'Effects').locator('.finding');
  await verdict.waitFor();
  await redrawn(page, () => number(page, 'oil.damping').fill('30').then(() => number(page, 'oil.damping').press('Enter')));
  await page.waitForFunction(() => /needs.*viscosity/.test(document.querySelector('[data-name="Effects"] .analysis > .finding')?.textContent));
  await close();
});

test('accuracy costs nothing where exact arcs solve the scene, and the page says why', async () => {
  const { page, close } = await desk.open('#file=stick-slip.toml');
  await unfold(page, 'Price of accuracy');
  const prices = fold(page, 'Price of accuracy');
  await prices.locator('table').waitFor();
  assert.match(await prices.locator('.finding').textContent(), /^Accuracy costs nothing here: between two events all laws of this scene are linear.*\d+ steps give every digit/);
  const table = await rows(prices.locator('.scroll tbody tr'));
  const arcs = table.filter(([method]) => method === 'exact arcs');
  const steps = table.filter(([method]) => method.startsWith('step by step')).map((row) => Number(row[4].replace(',', '')));
  assert.equal(arcs.length, 1);
  assert.ok(steps.at(-1) > 3 * steps[0] && Number(arcs[0][4].replace(',', '')) < steps[0], `${steps} ${arcs}`);
  assert.equal(await prices.locator('.chart.loop canvas').count(), 2);
  await accessible(page, 'price of accuracy');
  await close();
});

test('what a digit costs where a law is not linear, and why', async () => {
  const { page, close } = await desk.open('#file=vfm.toml');
  await unfold(page, 'Price of accuracy');
  const prices = fold(page, 'Price of accuracy');
  await prices.locator('table').waitFor();
  const words = await prices.locator('.finding').textContent();
  assert.match(words, /step by step, by the integrator IDA: the law of c1 \(cfm\) is not linear\. Each further digit takes 1\.\d+ times the steps/);
  const errors = (await rows(prices.locator('.scroll tbody tr'))).map((row) => Number(row[2].replace('< ', '')));
  assert.ok(errors[0] > 1e3 * errors[6], String(errors));
  await close();
});

test('a newer text ends what takes long, and what it asks for is measured in its place', async () => {
  const { page, close } = await desk.open('#file=stick-slip.toml');
  await page.evaluate(() => {
    const { fetch } = window;
    window.asked = [];
    window.fetch = (path, options) => {
      const request = path.endsWith('/api/task') && JSON.parse(options.body);
      if (request?.task === 'precision') window.asked.push({ text: request.text, signal: options.signal });
      return fetch(path, options);
    };
  });
  await redrawn(page, () => number(page, 'simulate.stop').fill('1500').then(() => number(page, 'simulate.stop').press('Enter')));
  await unfold(page, 'Price of accuracy');
  const prices = fold(page, 'Price of accuracy');
  await prices.locator('progress').waitFor();
  await redrawn(page, () => number(page, 'simulate.stop').fill('8').then(() => number(page, 'simulate.stop').press('Enter')));
  await prices.locator('table').waitFor();
  const asked = await page.evaluate(() => window.asked.map(({ text, signal }) => [/stop = "(.*)"/.exec(text)[1], signal.aborted]));
  assert.deepEqual(asked[0], ['1500 s', true]);
  assert.deepEqual(asked.at(-1), ['8 s', false]);
  await close();
});

// Sweeps from one value to another, and gives the last number that is drawn.
async function swept(page, { number: name, from, to, runs, measure, records = [] }) {
  await unfold(page, 'Sweep');
  const sweep = fold(page, 'Sweep');
  await sweep.getByLabel('number', { exact: true }).selectOption(name);
  await sweep.getByLabel('measure', { exact: true }).selectOption({ label: measure });
  for (const [label, record] of records) await sweep.getByLabel(label, { exact: true }).selectOption(record);
  for (const [label, value] of Object.entries({ from, to, runs })) {
    await sweep.getByLabel(label, { exact: true }).fill(String(value));
    await sweep.getByLabel(label, { exact: true }).press('Tab');
  }
  await sweep.getByRole('button', { name: 'Run the sweep' }).click();
  await sweep.getByText(`${runs} of ${runs} runs`).waitFor();
  return (await sweep.locator('.analysis').getAttribute('data-last')).split(' ').map(Number);
}

test('a sweep draws the resonance curve: F/(2 zeta k) at resonance', async () => {
  const { page, close } = await desk.open('#file=forced.toml');
  const [at, amplitude] = await swept(page, { number: 'parameters.r', from: 0.5, to: 1, runs: 6, measure: 'amplitude in the last third', records: [['record', 'block.position']] });
  assert.equal(at, 1);
  assert.ok(Math.abs(amplitude - 1 / (2 * 0.1 * 200)) < 0.02 * amplitude, String(amplitude));
  const sweep = fold(page, 'Sweep');
  assert.ok(await sweep.locator('.chart.loop canvas').isVisible());
  await accessible(page, 'sweep');
  // The highest point is read at first, others by key or by a click.
  const said = sweep.locator('output.point');
  const value = async () => {
    const [, r, mm] = /^r = ([\d.]+), amplitude in the last third: block\.position = ([\d.]+)\smm$/.exec(await said.textContent());
    return [Number(r), Number(mm) / 1000];
  };
  assert.equal((await value())[0], 1);
  assert.ok(Math.abs((await value())[1] - amplitude) < 1e-5 * amplitude);
  await sweep.getByLabel('Point of the curve').press('ArrowLeft');
  assert.equal((await value())[0], 0.9);
  const over = sweep.locator('.u-over');
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  const dot = await sweep.locator('.dot').boundingBox();
  assert.ok(dot.x > box.x + box.width / 2);
  await sweep.getByLabel('Point of the curve').fill('1');
  const [x, y] = await sweep.locator('.dot').boundingBox().then(({ x, y }) => [x + 5, y + 5]);
  await sweep.getByLabel('Point of the curve').fill('5');
  await page.mouse.click(x, y);
  assert.equal((await value())[0], 0.6);
  await redrawn(page, () => sweep.getByRole('button', { name: 'Load this point' }).click());
  assert.match(await netlist(page), /r += +0\.6\b/);
  await page.waitForTimeout(400); // The sections are made anew; the curve is still that of the netlist.
  assert.equal(await sweep.locator('.stale').count(), 0);
  assert.equal((await value())[0], 0.6);
  await close();
});

test('from the sliders a button leads to the sweep of the number that was moved last', async () => {
  const { page, close } = await desk.open('#file=forced.toml');
  const moved = page.locator('.slider[data-slider="parameters.zeta"] input[type="range"]');
  await redrawn(page, () => moved.press('ArrowRight'));
  await page.getByRole('button', { name: 'Sweep', exact: true }).click();
  const sweep = fold(page, 'Sweep');
  await sweep.getByRole('button', { name: 'Run the sweep' }).waitFor();
  assert.equal(await sweep.getByLabel('number', { exact: true }).inputValue(), 'parameters.zeta');
  await page.waitForFunction(() => document.querySelector('.sweep-fields button').getBoundingClientRect().bottom < innerHeight);
  await close();
});

test('a sweep of the number of elements shows the error: 2 Fc/(4 n^2) of n sliders', async () => {
  const { page, close } = await desk.open('#file=iwan.toml');
  const [n, error] = await swept(page, { number: 'parameters.n', from: 1, to: 8, runs: 8, measure: 'largest difference from', records: [['other record', 'iwan.force'], ['record', 'smooth.force']] });
  assert.equal(n, 8);
  assert.ok(Math.abs(error - (2 * 5) / (4 * 64)) < 0.1 * error, String(error));
  await close();
});

test('limits and curve of a sweep are those of the scene', async () => {
  const { page, close } = await desk.open('#file=forced.toml');
  await swept(page, { number: 'parameters.r', from: 0.5, to: 1, runs: 3, measure: 'steps' });
  await page.evaluate(() => (location.hash = '#file=stick-slip.toml'));
  await page.waitForFunction(() => document.querySelector('h1').textContent === 'Stick and slip');
  await page.waitForFunction(() => document.querySelector('.sweep-fields')?.textContent.includes('k1.stiffness'));
  assert.notEqual(await fold(page, 'Sweep').getByLabel('from', { exact: true }).inputValue(), '0.5');
  assert.equal(await fold(page, 'Sweep').locator('.chart').count(), 0);
  await close();
});

test('a sweep says which runs failed, and what is no number', async () => {
  const { page, close } = await desk.open('#file=stick-slip.toml');
  await swept(page, { number: 'm1.mass', from: -1, to: 1, runs: 3, measure: 'steps' });
  assert.match(await fold(page, 'Sweep').textContent(), /1 of the runs failed\. The first: .*mass.* must be at least 0/);
  await fold(page, 'Sweep').getByLabel('to', { exact: true }).fill('much');
  await fold(page, 'Sweep').getByLabel('to', { exact: true }).press('Tab');
  await fold(page, 'Sweep').getByRole('button', { name: 'Run the sweep' }).click();
  assert.match(await fold(page, 'Sweep').textContent(), /“much” is not a number\./);
  await close();
});
