// The schematic of the playground: it moves as the network does, and can be read whatever it does and wherever it is.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { at, netlist, oscillator, redrawn, setUp, shows, stickSlip } from './desk.mjs';

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
// A disc that turns at a constant speed, and a shaft behind a soft coupling.
const rotor = `domain = "rotation"
[elements]
drive = { type = "motion", at = "shaft", velocity = "20 rad/s" }
disc = { type = "inertia", at = "shaft", inertia = 1 }
coupling = { type = "spring", between = ["shaft", "far"], stiffness = 100 }
loss = { type = "dashpot", between = ["far", "ground"], damping = 1 }
[simulate]
stop = "2 s"
record = ["shaft.velocity"]
`;
// A hand that goes against an elastic stop.
const stop = `[elements]
pull = { type = "motion", at = "hand", velocity = "10 mm/s" }
bump = { type = "stop", between = ["hand", "ground"], upper = "10 mm", stiffness = "1 kN/m" }
[simulate]
stop = "2 s"
record = ["bump.force"]
`;
// A hammer falls 1.5 m on a pile, which goes 0.13 m into the ground with it.
const driver = `[elements]
hammer = { type = "mass", at = "hammer", mass = "800 kg" }
pile = { type = "mass", at = "pile", mass = "300 kg" }
W = { type = "force", at = "hammer", force = "7848 N" }
head = { type = "stop", between = ["hammer", "pile"], upper = "1.5 m", stiffness = "inf" }
soil = { type = "slider", between = ["pile", "ground"], coulomb = "90 kN" }
[simulate]
stop = "0.8 s"
record = ["hammer.position", "pile.position"]
`;
// A block that is pulled away to the right, until it has gone 50 mm in 1 s.
const leaving = `[parameters]
X = "50 mm"
[elements]
block = { type = "mass", at = "block", mass = "1 kg" }
pull = { type = "force", at = "block", force = "0.1 N" }
[simulate]
stop = "9 s"
stop_when = "block.position > X"
record = ["block.position"]
`;
const high = `[elements]
drive = { type = "motion", at = "a", velocity = "1 mm/s" }
${[...Array(6).keys()].map((k) => `k${k} = { type = "spring", between = ["a", "ground"], stiffness = ${k + 1} }`).join('\n')}
[simulate]
stop = 1
record = ["k0.force"]
`;
const swing = oscillator.replace('[elements]', '[parameters]\nx0 = "5 mm"\n[elements]').replace('"5 mm" }', '"x0" }');
const far = stickSlip.replace('stop = "8 s"', 'stop = "50 s"');
const desk = setUp({ 'swing.toml': swing, 'far.toml': far, 'leaving.toml': leaving, 'high.toml': high, 'oscillator.toml': oscillator, 'driver.toml': driver, 'rotor.toml': rotor, 'stop.toml': stop, 'maxwell.toml': maxwell, 'held.toml': held, 'stick-slip.toml': stickSlip });
const { open } = desk;

// Where a symbol is, in the coordinates of the drawing.
const boxOf = (page, selector) => page.locator(`.drawing ${selector}`).first().evaluate((node) => {
  const { x, y, width, height } = node.getBBox();
  return { x, y, width, height };
});
const element = (name) => `[data-element="${name}"]`;

test('the schematic moves as the network does', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const at0 = await boxOf(page, element('m1'));
  const spring0 = await boxOf(page, element('k1'));
  // It sticks until the spring pulls with 2 N, at 2 s, and slips at once after.
  await at(page, 0.2);
  assert.equal(await page.locator('.drawing .slider.sticks').count(), 1);
  assert.ok(Math.abs((await boxOf(page, element('m1'))).x - at0.x) < 0.01);
  const pulled = await boxOf(page, element('k1'));
  assert.ok(pulled.width < spring0.width - 2, `${pulled.width} of ${spring0.width}`); // its left end comes nearer
  await at(page, 0.26);
  assert.equal(await page.locator('.drawing .slider.slips').count(), 1);
  assert.ok((await boxOf(page, element('m1'))).x > at0.x + 0.3);
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

test('positions are drawn to one scale, which is shown, however far they go', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const hand = () => page.locator('.drawing path.node[data-node="hand"]').first().evaluate((node) => Number(/translateX\((-?[\d.]+)px/.exec(node.style.transform)[1]));
  const places = [];
  for (const part of [0, 0.25, 0.5, 0.75, 1]) {
    await at(page, part);
    places.push(await hand());
  }
  // The hand goes 10 mm a second, 80 mm in all.
  const bar = page.locator('.motion-legend .scale-bar.length');
  const [, value, unit] = /^([\d.]+) (m|mm)$/.exec(await page.locator('.motion-legend .key', { has: page.locator('.scale-bar.length') }).textContent());
  const px = (await bar.evaluate((node) => Number.parseFloat(node.style.width))) / (Number(value) * (unit === 'm' ? 1000 : 1)); // px/mm
  places.forEach((place, k) => assert.ok(Math.abs(place - 20 * k * px) < 0.1, `${places} at ${px} px/mm`));
  assert.ok(places.at(-1) > 20);
  await close();
});

test('the block of a slider keeps its shape, and its rail goes with the other node', async () => {
  const { page, close } = await open('#file=held.toml');
  const block = `${element('rubbing')} path:first-of-type`;
  const before = await boxOf(page, block);
  const sizes = new Set();
  for (const part of [0.05, 0.3, 0.55, 0.8]) {
    await at(page, part);
    const { width, height } = await boxOf(page, block);
    sizes.add(`${width.toFixed(1)} ${height.toFixed(1)}`);
  }
  assert.deepEqual([...sizes], [`${before.width.toFixed(1)} ${before.height.toFixed(1)}`]);
  await close();
});

test('what goes round turns where it is drawn, as fast as the legend says', async () => {
  const { page, close } = await open('#file=rotor.toml');
  const marks = () => page.locator(`.drawing ${element('disc')} path.turns`).evaluateAll((all) =>
    all.filter((mark) => mark.style.visibility !== 'hidden').map((mark) => Number(/M[\d.]+ ([\d.]+)/.exec(mark.getAttribute('d'))[1])));
  const box = await boxOf(page, `${element('disc')} path[fill]`);
  const turn = Number(await page.locator('.motion-legend [data-turn]').getAttribute('data-turn'));
  const seen = new Set();
  for (const part of [0, 0.1, 0.33, 0.7]) {
    await at(page, part);
    const here = await boxOf(page, `${element('disc')} path[fill]`);
    assert.ok(Math.abs(here.x - box.x) < 0.01 && Math.abs(here.width - box.width) < 0.01);
    // A mark that is turned by the angle stands at its sine; the disc turns at 20 rad/s for 2 s.
    const middle = box.y + box.height / 2;
    const expected = [0, 1, 2].map((k) => 20 * 2 * part * turn + (2 * Math.PI * k) / 3).filter((angle) => Math.cos(angle) > 0).map((angle) => middle + (box.height / 2 - 1) * Math.sin(angle));
    const found = await marks();
    assert.equal(found.length, expected.length);
    found.sort((a, b) => a - b).forEach((y, k) => assert.ok(Math.abs(y - expected.sort((a, b) => a - b)[k]) < 0.1, `${found} for ${expected}`));
    seen.add(found.map((y) => y.toFixed(1)).join());
  }
  assert.equal(seen.size, 4);
  // The other shaft has no disc, and a dial in its place.
  assert.equal(await page.locator('.drawing circle.turns.rim').count(), 1);
  await close();
});

test('the plates of a stop touch when it touches', async () => {
  const { page, close } = await open('#file=stop.toml');
  const gap = () => page.locator(`.drawing ${element('bump')} path`).evaluateAll((paths) => {
    const xs = paths.flatMap((path) => [...path.getAttribute('d').matchAll(/M([\d.]+) [\d.]+L([\d.]+) /g)].filter(([, a, b]) => a === b).map(([, a]) => Number(a))).sort((a, b) => a - b);
    return xs[1] - xs[0];
  });
  // The gap of 10 mm closes at 10 mm/s, at 1 of 2 s.
  const gaps = [];
  for (const part of [0, 0.25, 0.5, 0.75]) {
    await at(page, part);
    gaps.push(await gap());
  }
  assert.ok(gaps[0] > 3 && Math.abs(gaps[1] - gaps[0] / 2) < 0.1 && Math.abs(gaps[2]) < 0.1 && Math.abs(gaps[3]) < 0.1, gaps.join());
  await close();
});

test('what falls on something moves until it touches, and on with it', async () => {
  const { page, close } = await open('#file=driver.toml');
  const places = async (part) => {
    await at(page, part);
    return Promise.all(['hammer', 'pile'].map(async (name) => (await boxOf(page, element(name))).x));
  };
  const [start, fall, impact, end] = [await places(0), await places(0.4), await places(0.72), await places(1)];
  assert.ok(fall[0] > start[0] + 3 && fall[1] === start[1], `${start} ${fall}`);
  assert.ok(impact[0] > start[0] + 15 && end[1] > start[1] + 1, `${start} ${impact} ${end}`);
  assert.ok(Math.abs(end[1] - end[0] - (impact[1] - impact[0])) < 0.2, `${impact} ${end}`);
  await close();
});

test('forces and flows of power are arrows to scales that are shown, and energy is bars', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await page.locator('[data-shows="forces"]').check();
  const arrow = (kind = 'forces') => page.locator(`.${kind}-arrows path`).evaluateAll((all) => all.map((path) => Number(/h(-?[\d.]+)/.exec(path.getAttribute('d'))?.[1] ?? 0)));
  const bar = page.locator('.motion-legend .scale-bar.forces-arrow');
  assert.equal(await page.locator('.motion-legend .key', { has: page.locator('.scale-bar.forces-arrow') }).textContent(), '2\u00a0N');
  const px = (await bar.evaluate((node) => Number.parseFloat(node.style.width))) / 2;
  await at(page, 0.125); // the spring pulls with 1 N, to both sides
  const found = await arrow();
  assert.ok(found.some((length) => Math.abs(length - px) < 0.1) && found.some((length) => Math.abs(length + px) < 0.1), `${found}, ${px} px/N`);
  await page.locator('[data-shows="energy"]').check();
  // The work of the hand so far is the energy of the spring: (1 N)^2/(2 k).
  const energies = async () => /supplied([\d.]+) mJkinetic([\d.]+) mJelastic([\d.]+) mJdissipated([\d.]+) mJ/.exec(await page.locator('.energy-bars').textContent()).slice(1).map(Number);
  const [supplied, kinetic, elastic, dissipated] = await energies();
  assert.ok(Math.abs(supplied - 5) < 0.25 && kinetic === 0 && Math.abs(elastic - 5) < 0.25 && dissipated < 0.01, `${supplied} ${kinetic} ${elastic} ${dissipated}`);
  // The hand moves with 10 mm/s: 10 mW flow from it into the spring, and nothing out of it, because the block rests.
  const key = page.locator('.motion-legend .key', { has: page.locator('.scale-bar.energy-arrow') });
  const [, shown, milli] = /^([\d.]+)\u00a0(m?)W$/.exec(await key.textContent()) ?? assert.fail(await key.textContent());
  const size = Number(shown) * (milli ? 1 : 1e3); // mW
  const width = await key.locator('.scale-bar').evaluate((node) => Number.parseFloat(node.style.width));
  const flows = (await arrow('energy')).filter((length) => length !== 0);
  assert.ok(flows.length === 2 && flows.every((length) => Math.abs(length - (10 * width) / size) < 0.1), `${flows}, ${width} px for ${size} mW`);
  await page.locator('[data-shows="forces"]').uncheck();
  assert.equal(await page.locator('.forces-arrows').isVisible(), false);
  await close();
});

test('the energy of an oscillation goes to and fro, and nothing of it is lost', async () => {
  const { page, close } = await open('#file=oscillator.toml');
  await page.locator('[data-shows="energy"]').check();
  const seen = [];
  for (let k = 0; k < 10; ++k) {
    await at(page, 0.037 * k);
    seen.push((await page.locator('.energy-bars output').allTextContents()).map((text) => Number.parseFloat(text)));
  }
  const left = seen.map(([supplied, kinetic, elastic, dissipated]) => supplied - kinetic - elastic - dissipated);
  const most = Math.max(...seen.flat());
  // The energies are known at the steps, a few in each period, and interpolated between.
  assert.ok(Math.max(...left) - Math.min(...left) < 0.03 * most, String(left));
  const kinetic = seen.map((each) => each[1]);
  assert.ok(Math.max(...kinetic) > 0.1 * most && Math.min(...kinetic) < 0.01 * most, String(kinetic));
  await close();
});

test('what can be clicked moves with the drawing', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const apart = () => page.evaluate(() => [...document.querySelectorAll('.drawing [data-element]')].map((part) => {
    const [shown, handle] = [part, document.querySelector(`.element-handle[data-of="${part.dataset.element}"]`)].map((node) => node.getBoundingClientRect());
    return Math.abs(shown.left + shown.right - handle.left - handle.right) / 2; // a slider that is far from its rail extends it
  }));
  const before = await page.locator('.drawing [data-element="m1"]').boundingBox();
  for (const part of [0, 0.5, 0.99]) {
    await at(page, part);
    for (const px of await apart()) assert.ok(px < 7, `${px} px at ${part}`);
  }
  assert.ok(Math.abs((await page.locator('.drawing [data-element="m1"]').boundingBox()).x - before.x) > 5);
  await close();
});

test('a mass that is pulled starts where it is let go, and a drive gets another value', async () => {
  const { page, close } = await open('#file=oscillator.toml');
  const handle = page.locator('.element-handle[data-of="block"]');
  const middle = async () => {
    const { x, y, width, height } = await handle.boundingBox();
    return [x + width / 2, y + height / 2];
  };
  const mm = async () => Number(/position = "(-?[\d.]+) mm"/.exec(await netlist(page))[1]);
  const [x, y] = await middle();
  const symbol = () => page.locator('[data-element="block"] path').first().evaluate((path) => path.getBoundingClientRect().x);
  const before = await symbol();
  await page.mouse.move(x, y);
  await page.mouse.down();
  await redrawn(page, () => page.mouse.move(x + 12, y, { steps: 4 }));
  const [first, moved] = [await mm(), (await symbol()) - before];
  assert.ok(first > 5 && Math.abs(moved - 12) < 0.5, `${first} mm, ${moved} px`);
  await redrawn(page, () => page.mouse.move(x - 6, y, { steps: 4 }));
  assert.ok(Math.abs((await mm()) - 5 + (first - 5) / 2) < 0.02 * first, String(await mm()));
  await page.mouse.up();
  assert.equal(await page.locator('button.play').getAttribute('aria-pressed'), 'true'); // It swings.
  assert.equal(await page.locator('.inspector').isVisible(), false);
  await page.locator('button.play').click();
  await shows(page, 0.001, 'block.position', await mm(), 0.02);
  await handle.click();
  await page.locator('.inspector').waitFor();
  // A drive.
  const force = async () => Number(/force = "(-?[\d.]+) N"/.exec(await netlist(page))[1]);
  assert.equal(await force(), 1);
  const push = page.locator('.element-handle[data-of="push"]');
  const box = await push.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await redrawn(page, () => page.mouse.move(box.x + box.width / 2 + 30, box.y + box.height / 2, { steps: 4 }));
  await page.mouse.up();
  assert.ok((await force()) > 1.2, String(await force()));
  await close();
});

test('a start position that is a parameter stays one when its mass is pulled, and undo takes the pull as one step', async () => {
  const { page, close } = await open('#file=swing.toml');
  const before = await netlist(page);
  const { x, y, width, height } = await page.locator('.element-handle[data-of="block"]').boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  for (const far of [6, 9, 12]) await redrawn(page, () => page.mouse.move(x + width / 2 + far, y + height / 2, { steps: 2 }));
  await page.mouse.up();
  const pulled = await netlist(page);
  assert.match(pulled, /block = \{ position = "x0" \}/);
  assert.ok(Number(/x0 = "([\d.]+) mm"/.exec(pulled)[1]) > 5, pulled);
  await page.keyboard.press('Control+z');
  assert.equal(await netlist(page), before);
  await close();
});

// The hand goes 0.5 m, and takes along the block, which its drawing has no room for.
test('a block that goes far is at rest in the drawing while it sticks', async () => {
  const { page, close } = await open('#file=far.toml');
  const places = [];
  for (let part = 0; part <= 0.3; part += 0.05) {
    await at(page, part);
    const [block] = await Promise.all([boxOf(page, `${element('m1')} path`)]);
    const shift = await page.locator(`.drawing path.node[data-node="block"]`).first().evaluate((path) => new DOMMatrix(getComputedStyle(path).transform).e);
    const sticks = await page.locator('.drawing .slider').first().evaluate((node) => node.classList.contains('sticks'));
    places.push({ part, x: block.x, shift, sticks });
  }
  const atRest = places.filter(({ sticks }) => sticks);
  assert.ok(atRest.length >= 3, JSON.stringify(places));
  for (const { shift } of atRest) assert.ok(Math.abs(shift - atRest[0].shift) < 0.1, JSON.stringify(places));
  await close();
});

test('who wants less movement gets single pictures', async () => {
  const { page, close } = await open('#file=stick-slip.toml', { reducedMotion: 'reduce' });
  await page.locator('button.play').click();
  const clocks = new Set();
  for (const end = Date.now() + 1800; Date.now() < end;) {
    clocks.add(await page.locator('.clock').textContent());
    await page.waitForTimeout(20);
  }
  assert.ok(clocks.size >= 2 && clocks.size <= 5, [...clocks].join());
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
    // Labels within a mass overlap it in the drawing, too.
    const inside = overlaps(drawn);
    assert.equal(inside.length, file === 'held.toml' ? 2 : 0, inside.join(', '));
    let moved = 0;
    for (const part of [0.1, 0.25, 0.5, 0.62, 0.75, 1]) {
      await at(page, part);
      const all = await boxes();
      assert.deepEqual(overlaps(all), inside, `${file} at ${part}`);
      moved = Math.max(moved, ...all.map(({ left }, k) => Math.abs(left - drawn[k].left)));
    }
    assert.ok(moved > 10, String(moved));
    await close();
  }
});

test('the animation ends where a condition ends the run, and what leaves the drawing stays in sight', async () => {
  const { page, close } = await open('#file=leaving.toml');
  await at(page, 1);
  const end = Number.parseFloat(await page.locator('.clock').textContent());
  assert.ok(Math.abs(end - 1) < 2e-3, String(end));
  const [svg, room] = await page.evaluate(() => ['svg', '.schematic'].map((part) => document.querySelector(`.drawing ${part}`).getBoundingClientRect().right));
  assert.ok(room > svg + 40, `${svg}, ${room}`); // as far as a symbol moves
  assert.equal(await page.locator('.drawing svg').evaluate((picture) => getComputedStyle(picture).overflow), 'visible');
  await close();
});

test('a schematic that is higher than its place fades below', async () => {
  const { page, close } = await open('#file=high.toml', { viewport: { width: 1200, height: 700 } });
  const schematic = page.locator('.drawing .schematic');
  const sides = () => schematic.evaluate((host) => ['more-above', 'more-below'].filter((side) => host.classList.contains(side)));
  await page.waitForFunction(() => document.querySelector('.drawing .schematic').classList.contains('more-below'));
  await schematic.evaluate((host) => (host.scrollTop = 20));
  await page.waitForFunction(() => document.querySelector('.drawing .schematic').classList.contains('more-above'));
  await page.locator('.zoom button', { hasText: 'Fit' }).click();
  await page.waitForFunction(() => document.querySelector('.drawing .schematic').classList.length === 1);
  assert.deepEqual(await sides(), []);
  await close();
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
