// node tests/web/latency.mjs: how long it takes from a slider that moves to the new curves on the screen. It wants the
// environment of the tests: see support.mjs.
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { browser, done, moveSlider, serve } from './support.mjs';

const server = await serve(join(dirname(fileURLToPath(import.meta.url)), '../../netlists'));
const chromium = await browser();
const page = await chromium.newPage({ viewport: { width: 1280, height: 900 } });
await page.goto(`${server.address}#file=teaching/bingham.toml`);
await done(page);
const measured = await moveSlider(page, 300);
for (const what of ['drawn', 'answered']) {
  const times = measured.map((each) => each[what]).filter((time) => time !== undefined).sort((a, b) => a - b);
  const share = (part) => times[Math.floor(part * (times.length - 1))].toFixed(1);
  console.log(`${what}: ${share(0.5)} ms in the median, ${share(0.9)} ms in nine of ten cases, of ${times.length} moves`);
}
await chromium.close();
await server.stop();
