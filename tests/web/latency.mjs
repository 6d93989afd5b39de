// node tests/web/latency.mjs: how long it takes from a slider that moves to the new curves on the screen. It wants the
// environment of the tests: see support.mjs.
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { browser, done, serve } from './support.mjs';

const moves = 300;
const server = await serve(join(dirname(fileURLToPath(import.meta.url)), '../../netlists'));
const chromium = await browser();
const page = await chromium.newPage({ viewport: { width: 1280, height: 900 } });
await page.goto(`${server.address}#file=teaching/bingham.toml`);
await done(page);
const measured = await page.evaluate(async (count) => {
  const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));
  const slider = document.querySelector('[data-slider] input[type=range]');
  const { dataset } = document.querySelector('.status');
  const times = [];
  for (let k = 0; k < count; ++k) {
    dataset.latency = '';
    performance.clearResourceTimings();
    slider.value = String(100 + ((k * 7) % 200));
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    while (!dataset.latency) await pause(4);
    const [answer] = performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('/api/task'));
    if (answer) times.push({ drawn: Number(dataset.latency), answered: answer.responseEnd - answer.startTime });
    // Nobody moves a slider in step with the screen.
    await pause(60 + Math.random() * 40);
  }
  return times;
}, moves);
for (const what of ['drawn', 'answered']) {
  const times = measured.map((each) => each[what]).sort((a, b) => a - b);
  const share = (part) => times[Math.floor(part * (times.length - 1))].toFixed(1);
  console.log(`${what}: ${share(0.5)} ms in the median, ${share(0.9)} ms in nine of ten cases, of ${times.length} moves`);
}
await chromium.close();
await server.stop();
