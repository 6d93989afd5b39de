// Actions on the playground, shared by its tests.
import assert from 'node:assert/strict';
import { after, before } from 'node:test';
import { bingham, browser, done, folderWith, pointAt, remove, serve, watched } from './support.mjs';

// A block on a belt that is pulled through a spring: it sticks, and slips.
export const stickSlip = `# A block that is pulled through a spring.
title = "Stick and slip"

[elements]
pull = { type = "motion", at = "hand", velocity = "10 mm/s" }
k1 = { type = "spring", between = ["hand", "block"], stiffness = "100 N/m" }
m1 = { type = "mass", at = "block", mass = "1 kg" }
s1 = { type = "slider", between = ["block", "ground"], coulomb = "1 N", breakaway = "2 N" }

[simulate]
stop = "8 s"
output = { points = 801 }
record = ["block.position", "k1.force"]
`;

// A block that a force pushes against a spring.
export const oscillator = `[elements]
push = { type = "force", at = "block", force = "1 N" }
block = { type = "mass", at = "block", mass = "1 kg" }
k = { type = "spring", between = ["block", "ground"], stiffness = "100 N/m" }
[nodes]
block = { position = "5 mm" }
[simulate]
stop = "2 s"
record = ["block.position"]
`;

// Starts a server of a folder with these netlists, and a browser, for the tests of a file. The properties of the result are set when the tests
// run.
export function setUp(files = { 'bingham.toml': bingham }) {
  const desk = {};
  before(async () => {
    desk.folder = folderWith(files);
    desk.server = await serve(desk.folder);
    desk.chromium = await browser();
  });
  after(async () => {
    await desk.chromium?.close();
    assert.equal(await desk.server.stop(), 0);
    remove(desk.folder);
  });
  // A page of the playground; `close` ends it, and fails if anything was wrong with it.
  desk.open = async (hash = '#file=bingham.toml', options = {}, ready = done) => {
    const { server: { origin, address }, chromium } = desk;
    const context = await chromium.newContext({ viewport: { width: 1500, height: 950 }, acceptDownloads: true, ...options });
    const { page, wrong } = await watched(context, origin);
    await page.goto(`${address}${hash}`);
    if (hash) await ready(page);
    const close = async (expected = []) => {
      assert.deepEqual(wrong, expected);
      await context.close();
    };
    return { page, context, close };
  };
  return desk;
}

// Does something, and waits until all that follows from it is drawn: curves have come since, and no newer ones are on their way.
export async function redrawn(page, act) {
  const text = page.locator('.status');
  await text.evaluate((status) => (status.dataset.latency = ''));
  await act();
  await page.waitForFunction(() => document.querySelector('.status').dataset.latency && document.querySelector('.plots').ariaBusy === 'false');
}

// The legend's value of a record at a fraction of the time axis.
export async function valueAt(page, part, record) {
  const chart = page.locator('.plots .chart', { has: page.locator('.u-series', { hasText: record }) }).first();
  const over = chart.locator('.u-over');
  await pointAt(page, over, part);
  return Number.parseFloat(await chart.locator('.u-series', { hasText: record }).first().locator('.u-value').textContent());
}

// That it is `expected`, as soon as the curves are those of the last change.
export async function shows(page, part, record, expected, tolerance = 1e-3) {
  let value;
  for (let k = 0; k < 40; ++k) {
    value = await valueAt(page, part, record);
    if (Math.abs(value - expected) <= tolerance * Math.abs(expected)) return;
    await page.waitForTimeout(100);
  }
  assert.fail(`${record} is ${value}, expected ${expected}`);
}

// Watches the texts that charts draw from now on. Returns a function that returns the numbers in them so far.
export async function numbersOnCanvas(page) {
  await page.evaluate(() => {
    const { fillText } = CanvasRenderingContext2D.prototype;
    window.written = new Set();
    CanvasRenderingContext2D.prototype.fillText = function (text, ...where) {
      window.written.add(text);
      return fillText.call(this, text, ...where);
    };
  });
  return async () => (await page.evaluate(() => [...window.written])).map(Number).filter(Number.isFinite);
}

// Goes to a part of the run.
export const at = (page, part) => page.locator('.animation > input').evaluate((input, value) => {
  input.value = String(value);
  input.dispatchEvent(new Event('input', { bubbles: true }));
}, Math.round(1000 * part));
export const slider = (page, name) => page.locator(`[data-slider="${name}"] input[type="range"]`);
export const number = (page, name) => page.locator(`[data-slider="${name}"] input[type="text"]`);
export const netlist = (page) => page.evaluate(() => [...document.querySelectorAll('.cm-line')].map((line) => line.textContent).join('\n'));
