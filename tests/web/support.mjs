// Code shared by the tests of the web pages. Environment variables: RHEONET (path of the program), CHROMIUM, NODE_PACKAGES (the folder with
// node_modules).
import assert from 'node:assert/strict';
import { execFile, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync, mkdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { promisify } from 'node:util';

export const program = process.env.RHEONET;
const require = createRequire(join(process.env.NODE_PACKAGES, 'package.json'));
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

// Runs a command; rejects with `code` and `stderr` if it ends with another status than 0.
export const rheonet = (words, options) => promisify(execFile)(program, words, options);

// A folder of its own with these files in it.
export function folderWith(files) {
  const folder = mkdtempSync(join(tmpdir(), 'rheonet-web-'));
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), text);
  }
  return folder;
}

// A server of a folder: { origin, port, address (with the token), key (the header that shows it), process, stop }.
export async function serve(folder, ...options) {
  const process = spawn(program, ['serve', folder, '--port', '0', ...options], { stdio: ['ignore', 'pipe', 'inherit'] });
  const address = await new Promise((resolve, reject) => {
    let text = '';
    process.stdout.on('data', (piece) => {
      text += piece;
      const found = /http:\S+/.exec(text);
      if (found && text.includes('\n')) resolve(found[0]);
    });
    process.on('exit', (status) => reject(new Error(`the server ends with ${status}: ${text}`)));
  });
  // Rejects where the server does not end within the time that its slowest answer may take.
  const stop = () =>
    new Promise((resolve, reject) => {
      process.removeAllListeners('exit');
      const late = setTimeout(() => {
        reject(new Error('the server does not end on SIGTERM'));
        process.kill('SIGKILL');
      }, 60000);
      process.on('exit', (status) => {
        clearTimeout(late);
        resolve(status);
      });
      process.kill('SIGTERM');
    });
  const { origin, port, searchParams } = new URL(address);
  return { origin, port: Number(port), address, key: { Authorization: `Bearer ${searchParams.get('token')}` }, process, stop };
}

export async function browser() {
  const { chromium } = require('playwright-core');
  return chromium.launch({ executablePath: process.env.CHROMIUM, args: ['--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage'] });
}

// A page that is watched: what it says on its console as an error, and whatever it asks of any but its own origin.
export async function watched(context, origin) {
  const page = await context.newPage();
  const wrong = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && wrong.push(message.text()));
  page.on('pageerror', (error) => wrong.push(String(error.stack)));
  page.on('request', (request) => {
    const { protocol, origin: to } = new URL(request.url());
    if (!['data:', 'blob:'].includes(protocol) && to !== origin && !(origin === 'file' && protocol === 'file:')) wrong.push(`asks ${request.url()}`);
  });
  return { page, wrong };
}

// The playground has drawn what it was last given.
export const done = (page) => page.waitForFunction(() =>
  /drawn \d+ ms/.test(document.querySelector('.status').textContent) && document.querySelector('.plots').ariaBusy === 'false');

// Moves the first slider so many times, and tells for each how long it took until the new curves were on the screen, and until the
// server had answered, if there is one [ms]. A move without curves within 5 s is left out.
export const moveSlider = (page, count) => page.evaluate(async (moves) => {
  const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));
  const slider = document.querySelector('[data-slider] input[type=range]');
  const { dataset } = document.querySelector('.status');
  const taken = [];
  for (let k = 0; k < moves && slider; ++k) {
    dataset.latency = '';
    performance.clearResourceTimings();
    slider.value = String(100 + ((k * 7) % 200));
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    for (let waited = 0; !dataset.latency && waited < 5000; waited += 4) await pause(4);
    const [answer] = performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('/api/task'));
    if (dataset.latency) taken.push({ drawn: Number(dataset.latency), answered: answer && answer.responseEnd - answer.startTime });
    // Nobody moves a slider in step with the screen.
    await pause(60 + Math.random() * 40);
  }
  return taken;
}, count);

// Moves the pointer to a fraction of the width of a chart, and waits until the legend shows the values there.
export async function pointAt(page, over, part) {
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  for (const height of [1 / 3, 1 / 2]) await page.mouse.move(box.x + part * box.width, box.y + height * box.height);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}

// Accessibility: no violation that is serious or critical.
export async function accessible(page, what) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run());
  const grave = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
  const words = grave.map(({ id, help, nodes }) => `${id}: ${help}\n${nodes.slice(0, 3).map(({ html, failureSummary }) => `  ${html.slice(0, 200)}\n  ${failureSummary}`).join('\n')}`);
  assert.deepEqual(words, [], what);
}

export const remove = (folder) => rmSync(folder, { recursive: true, force: true });

// A Bingham element on a drum that turns at a constant velocity: the torque comes to Tc + B w.
export const bingham = `title = "Bingham element"
domain = "rotation"

[parameters]
B  = "0.5 N*m*s/rad"
Tc = "2 N*m"

[elements]
drive = { type = "motion",  at = "drum", velocity = { step = "10 rad/s", time = "0 s" } }
k1    = { type = "spring",  between = ["drum", "mid"],   stiffness = "100 N*m/rad" }
c1    = { type = "dashpot", between = ["mid", "ground"], damping = "B" }
s1    = { type = "slider",  between = ["mid", "ground"], coulomb = "Tc" }

[simulate]
stop   = "0.2 s"
output = { every = "1 ms" }
record = ["k1.force", "mid.velocity"]
`;
