// The texts of the page in four languages: none is missing, none stands outside of t(), and the page speaks the language that is chosen.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { faultsOf, messages, parser, textsOf } from '../../tools/web/texts.mjs';
import { setUp } from './desk.mjs';
import { accessible, done } from './support.mjs';

const { open } = setUp();

test('every text of the sources is given to t(), and has a translation in every language', () => {
  const found = textsOf(parser());
  assert.ok(found.used.size > 200 && Object.keys(messages).length >= 3);
  assert.deepEqual(found.outside, []);
  assert.deepEqual(faultsOf(found), []);
});

test('a text outside of t(), or without a translation, is found', () => {
  const parse = parser();
  const code = "element('p', {}, 'run');\nelement('p', { class: 'note bad', 'aria-label': 'Close' }, t('found'), `${n} steps taken`);\nfail('there is nothing to draw');\nhost.textContent = 'Pause';\nhost.addEventListener('click', () => refuse('A value is missing.'));";
  const { outside } = textsOf((_, options) => parse(code, options), ['menu.js']);
  assert.deepEqual(outside.map((line) => line.replace(/^menu\.js:/, '')), ['1: run', '2: Close', '2: {} steps taken', '3: there is nothing to draw', '4: Pause', '5: A value is missing.']);
  const used = new Map([['{count} of {name}', 'menu.js:1'], ['new', 'menu.js:2']]);
  assert.deepEqual(faultsOf({ used }, { de: { '{count} of {name}': '{count} von {nme}', old: 'alt' } }),
    ['de.json has other {names} in: "{count} of {name}"', 'de.json lacks: "new" (menu.js:2)', 'de.json has a text that is not used: "old"']);
});

test('the page has the language of the browser, or the one that is chosen, also after it is loaded again', async () => {
  const { page, close } = await open('#file=bingham.toml', { locale: 'fr-FR' }, (each) => each.waitForFunction(() => document.querySelector('.plots')?.ariaBusy === 'false'));
  assert.equal(await page.evaluate(() => document.documentElement.lang), 'fr');
  assert.ok(await page.getByRole('button', { name: 'Galerie' }).isVisible());
  await page.waitForFunction(() => /pas, .* ms après la modification/.test(document.querySelector('.status').textContent));
  for (const [language, gallery] of [['de', 'Galerie'], ['es', 'Galería'], ['en', 'Gallery']]) {
    await page.locator('select.language').selectOption(language);
    await page.waitForFunction((code) => document.documentElement?.lang === code, language);
    await page.getByRole('button', { name: gallery, exact: true }).waitFor();
  }
  await done(page);
  await page.locator('select.language').selectOption('de');
  await page.waitForFunction(() => document.documentElement?.lang === 'de');
  await page.reload();
  await page.getByRole('button', { name: 'Vergleichen' }).waitFor();
  await page.locator('.sections details summary', { hasText: 'Gleichungen' }).waitFor();
  await accessible(page, 'in German');
  await close();
});

test('a netlist that is not saved stays when the language changes', async () => {
  const { page, close } = await open();
  const knob = page.locator('[data-slider="parameters.Tc"] input[type="text"]');
  await knob.fill('6');
  await knob.press('Enter');
  await done(page);
  await page.locator('select.language').selectOption('es');
  await page.waitForFunction(() => document.documentElement?.lang === 'es');
  await page.waitForFunction(() => [...document.querySelectorAll('.cm-line')].some((line) => line.textContent.includes('"6 N*m"')));
  await close();
});
