// node tests/site/latency.mjs: how long it takes in the site from a slider that moves to the new curves on the screen, for each
// demo, and from the address to the first picture. It wants the environment of the tests: see module.mjs.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { browser, done, moveSlider } from '../web/support.mjs';
import { netlists, scenes } from './module.mjs';
import { host, oneFile } from './page.mjs';

const hosted = await host();
const chromium = await browser();
const share = (times, part) => times.sort((a, b) => a - b)[Math.floor(part * (times.length - 1))];
for (const [what, address] of [['a static host', hosted.address], ['disk', oneFile]]) {
  const times = [];
  for (let k = 0; k < 5; ++k) {
    const page = await (await chromium.newContext()).newPage();
    const begun = performance.now();
    await page.goto(`${address}#file=teaching/bingham.toml`);
    await page.waitForSelector('.plots canvas');
    times.push(performance.now() - begun);
    await page.context().close();
  }
  console.log(`first picture from ${what}: ${Math.round(share(times, 0.5))} ms in the median of ${times.length}`);
}
const medians = [];
for (const name of scenes().filter((each) => readFileSync(join(netlists, each), 'utf8').includes('\n[demo]'))) {
  const page = await chromium.newPage({ viewport: { width: 1280, height: 900 } });
  await page.goto(`${hosted.address}#file=${name}`);
  await done(page);
  const times = (await moveSlider(page, 40)).map(({ drawn }) => drawn);
  await page.close();
  if (!times.length) continue;
  medians.push(share(times, 0.5));
  console.log(`${name}: ${share(times, 0.5).toFixed(0)} ms in the median, ${share(times, 0.9).toFixed(0)} ms in nine of ten moves`);
}
console.log(`${medians.filter((time) => time <= 50).length} of ${medians.length} demos take at most 50 ms in the median`);
await chromium.close();
await hosted.stop();
