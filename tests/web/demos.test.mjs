// The teaching demos, as the playground shows them.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { browser, done, serve, watched } from './support.mjs';

test('every demo asks its question, and moves what it says', async () => {
  const netlists = join(dirname(fileURLToPath(import.meta.url)), '../../netlists');
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
