// Takes the pictures of the tutorial that are of pages in a browser, as it says how to come to them: of the report seal.html
// and of seal.toml in the playground, into the folder in which both are.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { browser, done, serve, watched } from '../../tests/web/support.mjs';

const folder = process.argv[2];
const chromium = await browser();
const server = await serve(folder);

async function pageIn(origin, address, act, picture) {
  const context = await chromium.newContext({ viewport: { width: 1300, height: 820 } });
  const { page, wrong } = await watched(context, origin);
  await page.goto(address);
  await act(page);
  await page.screenshot({ path: join(folder, picture) });
  assert.deepEqual(wrong, []);
  await context.close();
}

try {
  await pageIn('file', pathToFileURL(join(folder, 'seal.html')).href, (page) => page.waitForSelector('.chart canvas'), 'report.png');

  await pageIn(server.origin, server.address, async (page) => {
    await page.locator('.card[data-file="seal.toml"]').click();
    await done(page);
    await page.locator('button', { hasText: 'Compare' }).click();
    const frequency = page.locator('[data-slider="parameters.frequency"] input[type="range"]');
    await frequency.focus();
    const reads = () => page.locator('[data-slider="parameters.frequency"] input[type="text"]').inputValue();
    for (let k = 0; k < 200 && Number(await reads()) < 5; ++k) await frequency.press('ArrowRight');
    assert.ok(Math.abs(Number(await reads()) - 5) < 0.5, await reads());
    await page.waitForSelector('.loop-legend .key >> nth=1');
    await done(page);
    await page.locator('.animation > input').fill('560');
    await page.mouse.move(0, 0);
    await page.waitForTimeout(500);
  }, 'playground.png');
} finally {
  await Promise.all([server.stop(), chromium.close()]);
}
