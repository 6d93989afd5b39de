// The teaching demos, as the playground shows them.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { browser, done, serve, watched } from './support.mjs';

const netlists = join(dirname(fileURLToPath(import.meta.url)), '../../netlists');

test('every demo asks its question, and moves what it says', async () => {
  const demos = readdirSync(join(netlists, 'teaching')).filter((name) => name.endsWith('.toml') && readFileSync(join(netlists, 'teaching', name), 'utf8').includes('\n[demo]'));
  assert.ok(demos.length >= 10, demos.join(', '));
  const server = await serve(netlists);
  const chromium = await browser();
  const context = await chromium.newContext({ viewport: { width: 1500, height: 950 } });
  const { page, wrong } = await watched(context, server.origin);
  for (const name of demos) {
    await page.goto(`${server.address}#file=teaching/${name}`);
    await page.reload();
    await done(page);
    const text = readFileSync(join(netlists, 'teaching', name), 'utf8');
    const question = /question\s*=\s*"(.*)"/.exec(text)[1];
    assert.equal(await page.textContent('.question'), question, name);
    assert.equal(await page.locator('.mistake').count(), 0, name);
    assert.ok(await page.locator('.drawing [data-element]').count(), name);
    assert.ok(await page.locator('.plots .chart canvas').count(), name);
    const asked = /sliders\s*=\s*\{(.*)\}/.exec(text)?.[1].match(/\w+(?=\s*=\s*\[)/g) ?? [];
    assert.deepEqual(await page.locator('fieldset', { hasText: 'to move' }).first().locator('[data-slider]').evaluateAll((rows) => rows.map((row) => row.dataset.slider.replace('parameters.', ''))), asked, name);
  }
  assert.deepEqual(wrong, []);
  await context.close();
  await chromium.close();
  await server.stop();
});

test('no plot of a demo is lower than it can be read, at the sizes of usual screens, also after its lesson', async () => {
  const server = await serve(netlists);
  const chromium = await browser();
  for (const [width, height] of [[1440, 900], [1200, 800]]) {
    const context = await chromium.newContext({ viewport: { width, height } });
    const { page } = await watched(context, server.origin);
    const heights = () => page.locator('.plots .chart:visible .u-over').evaluateAll((all) => all.map((area) => area.clientHeight));
    const expectAll = async (name) => {
      await page.waitForFunction(() => [...document.querySelectorAll('.plots .u-over')].some((area) => area.clientHeight >= 150), null, { timeout: 5000 }).catch(() => {});
      const found = await heights();
      assert.ok(found.length && found.every((each) => each >= 150), `${name} at ${width} x ${height}: ${found}`);
    };
    for (const name of ['dahl', 'coulomb-to-iwan', 'creep', 'couette-lag', 'composed-or-combined', 'relaxation', 'stick-slip']) {
      await page.goto(`${server.address}#file=teaching/${name}.toml`);
      await page.reload();
      await done(page);
      await expectAll(name);
    }
    await page.goto(`${server.address}#lesson=teaching/stick-slip.toml`);
    await page.getByRole('button', { name: 'Leave the lesson' }).click();
    await page.locator('.plots-box').waitFor();
    await done(page);
    await expectAll('after a lesson');
    await context.close();
  }
  await chromium.close();
  await server.stop();
});
