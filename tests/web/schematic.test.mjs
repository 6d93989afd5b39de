// The schematic of the playground: it moves as the network does, and can be read whatever it does and wherever it is.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setUp, stickSlip } from './desk.mjs';

// A row that is wider than a phone, whose middle moves further than its texts are apart.
const maxwell = `[elements]
pull = { type = "force", at = "its_free_end", force = { pulse = "1 N", width = "2 s", time = "0.1 s" } }
spring_of_steel = { type = "spring", between = ["its_free_end", "joint_of_both"], stiffness = "1 kN/m" }
spring_of_wood = { type = "spring", between = ["joint_of_both", "end"], stiffness = "2 kN/m" }
oil = { type = "dashpot", between = ["end", "ground"], damping = "512.3 N*s/m" }
[simulate]
stop = "4 s"
record = ["its_free_end.position"]
`;
// A block that a belt takes along, against a spring.
const held = `[elements]
drive = { type = "motion", at = "belt", velocity = "30 mm/s" }
rubbing = { type = "slider", between = ["belt", "block"], coulomb = "4 N", breakaway = "6 N" }
block = { type = "mass", at = "block", mass = "1 kg" }
k = { type = "spring", between = ["block", "ground"], stiffness = 400 }
[simulate]
stop = "4 s"
record = ["block.position"]
`;
const desk = setUp({ 'maxwell.toml': maxwell, 'held.toml': held, 'stick-slip.toml': stickSlip });
const { open } = desk;

test('the schematic moves as the network does', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const transform = (name) => page.locator(`.drawing [data-element="${name}"]`).evaluate((node) => node.style.transform);
  const at = (part) => page.locator('.animation input').evaluate((input, value) => {
    input.value = String(value);
    input.dispatchEvent(new Event('input', { bubbles: true }));
  }, Math.round(1000 * part));
  const shift = async (name) => Number(/translateX\((-?[\d.]+)px\)/.exec(await transform(name))[1]);
  const stretch = async (name) => Number(/scaleX\(([\d.]+)\)/.exec(await transform(name))[1]);
  // It sticks until the spring pulls with 2 N, at 2 s, and slips at once after.
  await at(0.2);
  assert.equal(await page.locator('.drawing .slider.sticks').count(), 1);
  assert.equal(await shift('m1'), 0);
  const pulled = await stretch('k1');
  await at(0.24);
  assert.notEqual(await stretch('k1'), pulled);
  await at(0.26);
  assert.equal(await page.locator('.drawing .slider.slips').count(), 1);
  assert.notEqual(await shift('m1'), 0);
  assert.equal(await page.locator('.clock').textContent(), '2.08 s');
  // Played, it moves by itself, and the point on the loop moves with it.
  await page.locator('.plot-head label', { hasText: 'Force against displacement' }).click();
  await page.locator('.plot-tools select').selectOption('k1');
  await page.locator('button.play').click();
  const places = new Set();
  for (let k = 0; k < 30 && places.size < 4; ++k) {
    places.add(await page.locator('.loop .dot').evaluate((dot) => dot.style.transform));
    await page.waitForTimeout(100);
  }
  assert.ok(places.size >= 4);
  await page.locator('button.play').click();
  const [clock] = [await page.locator('.clock').textContent()];
  await page.waitForTimeout(200);
  assert.equal(await page.locator('.clock').textContent(), clock);
  await close();
});

test('texts of a schematic in motion stay apart from each other, from the ground and from masses', async () => {
  for (const file of ['maxwell.toml', 'held.toml']) {
    const { page, close } = await open(`#file=${file}`);
    const boxes = () => page.evaluate(() => [...document.querySelectorAll('.drawing text, .drawing path.ground, .drawing .mass')].map((node) => {
      const { left, right, top, bottom } = node.getBoundingClientRect();
      return { left, right, top, bottom, what: node.tagName === 'text' ? node.textContent : node.getAttribute('class') };
    }));
    const overlaps = (all) => all.flatMap((a, k) => all.slice(k + 1).filter((b) =>
      a.left < b.right - 0.5 && b.left < a.right - 0.5 && a.top < b.bottom - 0.5 && b.top < a.bottom - 0.5).map((b) => `${a.what} over ${b.what}`));
    const drawn = await boxes();
    // What stands in a mass.
    const inside = overlaps(drawn);
    assert.equal(inside.length, file === 'held.toml' ? 2 : 0, inside.join(', '));
    let moved = 0;
    for (const part of [0.1, 0.25, 0.5, 0.62, 0.75, 1]) {
      await page.locator('.animation input').evaluate((input, place) => {
        input.value = String(place);
        input.dispatchEvent(new Event('input', { bubbles: true }));
      }, 1000 * part);
      const all = await boxes();
      assert.deepEqual(overlaps(all), inside, `${file} at ${part}`);
      moved = Math.max(moved, ...all.map(({ left }, k) => Math.abs(left - drawn[k].left)));
    }
    assert.ok(moved > 10, String(moved));
    await close();
  }
});

test('a schematic that goes on beyond its edge fades there', async () => {
  const { page, close } = await open('#file=maxwell.toml', { viewport: { width: 390, height: 844 } });
  const schematic = page.locator('.drawing .schematic');
  const sides = () => schematic.evaluate((host) => ['more-left', 'more-right'].filter((side) => host.classList.contains(side)));
  const scroll = (to) => schematic.evaluate((host, left) => new Promise((resolve) => {
    host.addEventListener('scroll', () => requestAnimationFrame(resolve), { once: true });
    host.scrollLeft = left;
  }), to);
  await page.waitForFunction(() => document.querySelector('.drawing .schematic').classList.contains('more-right'));
  assert.deepEqual(await sides(), ['more-right']);
  await scroll(40);
  assert.deepEqual(await sides(), ['more-left', 'more-right']);
  await scroll(1e4);
  assert.deepEqual(await sides(), ['more-left']);
  await page.setViewportSize({ width: 1500, height: 950 });
  await page.waitForFunction(() => document.querySelector('.drawing .schematic').classList.length === 1);
  await close();
});
