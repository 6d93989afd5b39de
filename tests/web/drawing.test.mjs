// Drawing in the playground: by mouse, by keyboard, on a phone. Each action in the schematic is an edit of the netlist.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { netlist, redrawn, setUp, shows, stickSlip } from './desk.mjs';
import { accessible, done, rheonet } from './support.mjs';

// One of each kind of place that makes elements.
const made = `# Made by models, groups and repetition.
title = "Made"
[models.holder]
ports = ["a", "b"]
parameters = { k = "100 N/m", B = "1 N*s/m" }
[models.holder.elements]
k1 = { type = "spring", between = ["a", "mid"], stiffness = "k" }
c1 = { type = "dashpot", between = ["mid", "b"], damping = "B" }

[elements]
drive = { type = "motion", at = "drum", velocity = { sine = "1 mm/s", frequency = "2 Hz" } }
pivot = { type = "holder", between = ["drum", "ground"], k = "50 N/m" }
chain = { type = "spring", between = ["drum", "ground"], stiffness = "100*(i+1)", repeat = { count = 3 } }
[elements.oil]
between = ["drum", "ground"]
series = [
  { name = "k1", type = "spring", stiffness = "100 N/m" }, # steel
  { parallel = [ { type = "dashpot", damping = "0.5 N*s/m" }, { type = "slider", coulomb = "2 N" } ] },
]

[simulate]
stop = "1 s"
`;
const desk = setUp({ 'stick-slip.toml': stickSlip, 'made.toml': made });
const { open } = desk;

const card = (page) => page.locator('.inspector');
const field = (page, label) => card(page).getByLabel(label, { exact: true });
const symbol = (page, name) => page.locator(`.element-handle[data-of="${name}"]`);
const end = (page, name, node) => page.locator(`.end-handle[data-end-of="${name}"][data-at="${node}"]`);
const ofNode = (page, node) => page.locator(`.end-handle[data-at="${node}"]`).first();
const palette = (page, type) => page.locator(`.palette-type[data-type="${type}"]`);
const asked = (page, text) => page.locator('.prompt').getByRole('button', { name: text, exact: true });
const line = async (page, start) => (await netlist(page)).split('\n').find((each) => each.startsWith(start));

// Writes into a field and leaves it.
async function write(page, label, text) {
  await field(page, label).fill(text);
  await field(page, label).press('Enter');
}

// Middle of something, in the window.
async function middle(target) {
  await target.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await target.boundingBox();
  return [x + width / 2, y + height / 2];
}

// Presses the mouse on one thing, and lets it go over another, or at a free place of the drawing.
async function drag(page, from, to) {
  await page.mouse.move(...(await middle(from)));
  await page.mouse.down();
  await page.mouse.move(...(await middle(to)), { steps: 5 });
  await page.mouse.up();
}

async function draw(page) {
  await page.getByRole('button', { name: 'Draw', exact: true }).click();
  await palette(page, 'mass').waitFor();
}

async function anew(page) {
  await page.keyboard.press('Escape'); // the gallery
  await page.getByRole('button', { name: 'New', exact: true }).click();
  await palette(page, 'mass').waitFor();
}

test('a stick-slip oscillator is built from nothing by mouse alone, and runs', async () => {
  const { page, close } = await open('');
  await page.waitForSelector('dialog.gallery[open]');
  await page.getByRole('button', { name: 'New scene' }).click();
  const free = () => page.locator('.drawing').click({ position: { x: 12, y: 12 } });
  await palette(page, 'mass').click();
  await redrawn(page, free);
  await palette(page, 'spring').click();
  await symbol(page, 'mass1').click({ position: { x: 6, y: 20 } });
  await redrawn(page, free);
  // A drive is dragged to the end of the spring.
  await redrawn(page, () => drag(page, palette(page, 'motion'), end(page, 'spring1', 'b')));
  await palette(page, 'slider').click();
  await ofNode(page, 'a').click();
  await redrawn(page, () => ofNode(page, 'ground').click());
  // The force of breakaway is given, and raised until it is twice that of sliding.
  await card(page).getByText('More parameters').click();
  const give = card(page).getByRole('button', { name: 'Give breakaway' });
  await redrawn(page, async () => {
    // A click is lost if the card is made anew just then.
    do await give.click();
    while (!(await give.waitFor({ state: 'hidden', timeout: 3000 }).then(() => true, () => false)));
  });
  const range = field(page, 'breakaway Fs').locator('xpath=..').locator('input[type=range]');
  const box = await range.boundingBox();
  await redrawn(page, () => page.mouse.click(box.x + box.width * 0.66, box.y + box.height / 2));
  const text = await netlist(page);
  assert.match(text, /^mass1 = \{ type = "mass", at = "a", mass = "1 kg" \}$/m);
  assert.match(text, /^spring1 = \{ type = "spring", between = \["a", "b"\], stiffness = "100 N\/m" \}$/m);
  assert.match(text, /^motion1 = \{ type = "motion", at = "b", velocity = "0.01 m\/s" \}$/m);
  assert.match(text, /^slider1 = \{ type = "slider", between = \["a", "ground"\], coulomb = "1 N", breakaway = "\d.*N" \}$/m);
  assert.match(text, /^stop = "10 s"\noutput = \{ points = 1001 \}\nrecord = \["a.position", "spring1.force", "b.position", "slider1.force"\]$/m);
  // It sticks until the spring pulls with the force of breakaway Fs, at Fs/(k v).
  const breakaway = Number(/breakaway = "([\d.]+) N"/.exec(text)[1]);
  assert.ok(breakaway > 1.2, text);
  await shows(page, 0.9 * breakaway / 10, 'spring1.force', -0.9 * breakaway, 2e-2);
  await page.locator('summary', { hasText: 'Events' }).click();
  await page.waitForFunction(() => /slider1: breakaway, direction 1 at .*slider1: stick at /.test(document.querySelector('.events')?.textContent));
  await accessible(page, 'drawing');
  await close();
});

test('an element is renamed with all that refers to it; comments and blanks stay, and undo brings each step back', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const before = await netlist(page);
  await symbol(page, 'k1').click({ position: { x: 8, y: 4 } });
  await card(page).getByText('k1: spring').waitFor();
  assert.equal(await card(page).locator('.katex').count(), 1);
  await accessible(page, 'a card');
  await redrawn(page, () => write(page, 'name', 'steel'));
  assert.equal(await netlist(page), before.replaceAll('k1', 'steel'));
  assert.equal(await card(page).locator('h2').textContent(), 'steel: spring');
  await redrawn(page, () => write(page, 'stiffness k', '150'));
  assert.equal(await netlist(page), before.replaceAll('k1', 'steel').replace('100 N/m', '150 N/m'));
  // A name that is taken, and one that is none.
  await write(page, 'name', 'm1');
  assert.match(await card(page).textContent(), /There is an element called m1 already/);
  await write(page, 'name', 'a b');
  assert.match(await card(page).textContent(), /letters, digits, _ and -/);
  await card(page).getByRole('button', { name: 'Close the card' }).click();
  await draw(page);
  await redrawn(page, () => page.getByRole('button', { name: 'Undo' }).click());
  await redrawn(page, () => page.getByRole('button', { name: 'Undo' }).click());
  assert.equal(await netlist(page), before);
  await redrawn(page, () => page.getByRole('button', { name: 'Redo' }).click());
  assert.equal(await netlist(page), before.replaceAll('k1', 'steel'));
  await close();
});

test('an element is deleted with what is recorded of it; Ctrl Z outside the editor brings it back', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const before = await netlist(page);
  await symbol(page, 'k1').click({ position: { x: 8, y: 4 } });
  await redrawn(page, () => card(page).getByRole('button', { name: 'Delete' }).click());
  assert.equal(await netlist(page), before.replace(/k1 = .*\n/, '').replace(', "k1.force"', ''));
  assert.equal(await symbol(page, 'k1').count(), 0);
  await redrawn(page, () => page.keyboard.press('Control+z'));
  assert.equal(await netlist(page), before);
  await close();
});

test('rheonet checks what is written into a field: the card says what is wrong', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await symbol(page, 's1').click({ position: { x: 30, y: 4 } });
  await write(page, 'coulomb Fc', '3 kg');
  await card(page).locator('.inspector-wrong p').waitFor();
  assert.match(await card(page).locator('.inspector-wrong').textContent(), /`coulomb`: expected a force \(N\)/);
  assert.equal(await field(page, 'coulomb Fc').getAttribute('aria-invalid'), 'true');
  await accessible(page, 'a mistake in a card');
  // A number alone has the unit of the quantity then, not that which was wrong.
  await redrawn(page, () => write(page, 'coulomb Fc', '1.5'));
  assert.match(await line(page, 's1'), /coulomb = "1.5 N"/);
  assert.equal(await card(page).locator('.inspector-wrong p').count(), 0);
  // A value that is no longer given goes from the text.
  await redrawn(page, () => write(page, 'breakaway Fs', ''));
  assert.equal(await line(page, 's1'), 's1 = { type = "slider", between = ["block", "ground"], coulomb = "1.5 N" }');
  await close();
});

test('what is drawn keeps its room, at the start of the run, while somebody draws', async () => {
  for (const [width, height] of [[1024, 768], [1440, 900]]) {
    const { page, close } = await open('#file=stick-slip.toml', { viewport: { width, height } });
    await page.locator('button.play').click();
    await page.waitForFunction(() => document.querySelector('.clock').textContent !== '0 s');
    await draw(page);
    assert.equal(await page.locator('.clock').textContent(), '0 s');
    assert.equal(await page.locator('button.play').getAttribute('aria-pressed'), 'false');
    await palette(page, 'spring').click();
    const [drawing, plots] = [await page.locator('.drawing').boundingBox(), await page.locator('.plots-box').boundingBox()];
    assert.ok(drawing.height >= 260 && drawing.y + drawing.height <= plots.y, JSON.stringify([drawing, plots]));
    // Handles are not shown where nothing is.
    await page.locator('.animation > input').press('End');
    assert.equal(await end(page, 'k1', 'hand').isVisible(), false);
    await palette(page, 'dashpot').click();
    assert.ok(await end(page, 'k1', 'hand').isVisible());
    await close();
  }
});

test('undo brings back the scene before a new one, and a comparison that has ended', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const before = await netlist(page);
  await page.getByRole('button', { name: 'New', exact: true }).click();
  await palette(page, 'mass').click();
  await redrawn(page, () => asked(page, 'new node').click());
  await page.getByRole('button', { name: 'Draw', exact: true }).click();
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => !document.querySelector('.cm-content').textContent.includes('mass1'));
  // An empty scene that is not drawn in has the button to draw.
  assert.ok(await page.getByRole('button', { name: 'Draw', exact: true }).isVisible());
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => document.querySelector('h1').textContent === 'Stick and slip');
  assert.equal(await netlist(page), before);
  await done(page);
  await redrawn(page, () => page.getByRole('button', { name: 'Compare' }).click());
  await redrawn(page, () => page.locator('[data-slider="k1.stiffness"] input[type=text]').fill('120').then(() => page.keyboard.press('Enter')));
  await page.getByRole('button', { name: 'End comparison' }).click();
  await accessible(page, 'undo in a toast');
  await page.locator('.toast').getByRole('button', { name: 'Undo' }).click();
  await page.locator('.variants label').nth(1).waitFor();
  assert.match(await netlist(page), /stiffness = "120 N\/m"/);
  await page.locator('.variants label').first().click();
  assert.equal(await netlist(page), before);
  await close();
});

test('a drive gets another shape, an element another type', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await symbol(page, 'pull').click();
  await redrawn(page, () => field(page, 'velocity over time').selectOption('sine'));
  assert.equal(await line(page, 'pull'), 'pull = { type = "motion", at = "hand", velocity = { sine = "10 mm/s", frequency = "1 Hz" } }');
  await redrawn(page, () => write(page, 'frequency', '2'));
  assert.match(await line(page, 'pull'), /frequency = "2 Hz"/);
  await redrawn(page, () => field(page, 'velocity over time').selectOption('ramp'));
  assert.match(await line(page, 'pull'), /velocity = \{ ramp = "1 m\/s\^2" \}/);
  await redrawn(page, () => field(page, 'velocity over time').selectOption('constant'));
  assert.match(await line(page, 'pull'), /velocity = "0.01 m\/s" \}/);
  await symbol(page, 's1').click({ position: { x: 30, y: 4 } });
  // The new type keeps the parameters that it has too, and gets initial values for its required parameters.
  await redrawn(page, () => field(page, 'type').selectOption('sfm'));
  assert.equal(await line(page, 's1'), 's1 = { type = "sfm", between = ["block", "ground"], coulomb = "1 N", stiffness = "100 N/m" }');
  await close();
});

test('the law of an element is shown whole, at every width', async () => {
  for (const width of [390, 768, 1024, 1440]) {
    const { page, close } = await open('#file=stick-slip.toml', { viewport: { width, height: 900 } });
    await symbol(page, 's1').click({ position: { x: 30, y: 4 } });
    const law = card(page).locator('.card-law .equation');
    for (const type of ['cfm', 'gear', 'davidenkov', 'lever', 'stop', 'sfm', 'inerter', 'slider']) {
      await redrawn(page, () => field(page, 'type').selectOption(type));
      await law.and(page.getByLabel(`Law of ${type}`)).waitFor();
      const [across, down] = await law.evaluate((host) => [host.scrollWidth - host.clientWidth, host.scrollHeight - host.clientHeight]);
      assert.ok(across <= 0 && down <= 0, `${type} at ${width} px: ${across}, ${down} px are cut off`);
    }
    await close();
  }
});

test('an element is added in series with another one, and parallel to it, by one click', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await symbol(page, 'k1').click();
  await redrawn(page, () => card(page).getByRole('button', { name: 'in parallel' }).click());
  assert.equal(await line(page, 'dashpot1'), 'dashpot1 = { type = "dashpot", between = ["hand", "block"], damping = "1 N*s/m" }');
  assert.match(await card(page).textContent(), /dashpot1: dashpot/);
  await symbol(page, 's1').click({ position: { x: 30, y: 4 } });
  await field(page, 'add').selectOption('vfm');
  await redrawn(page, () => card(page).getByRole('button', { name: 'in series' }).click());
  assert.equal(await line(page, 's1'), 's1 = { type = "slider", between = ["block", "a"], coulomb = "1 N", breakaway = "2 N" }');
  assert.match(await line(page, 'vfm1'), /^vfm1 = \{ type = "vfm", between = \["a", "ground"\]/);
  // One step of undo for each.
  await page.locator('.drawing').click({ position: { x: 12, y: 12 } });
  await redrawn(page, () => page.keyboard.press('Control+z'));
  assert.equal(await line(page, 's1'), 's1 = { type = "slider", between = ["block", "ground"], coulomb = "1 N", breakaway = "2 N" }');
  assert.equal(await line(page, 'vfm1'), undefined);
  await symbol(page, 'm1').click();
  assert.equal(await card(page).getByRole('button', { name: 'in series' }).count(), 0);
  await close();
});

test('the end of an element is dragged to another node, to ground and to a free place', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await draw(page);
  await redrawn(page, () => drag(page, end(page, 's1', 'ground'), ofNode(page, 'hand')));
  assert.match(await line(page, 's1'), /between = \["block", "hand"\]/);
  await redrawn(page, () => page.getByRole('button', { name: 'Undo' }).click());
  // Both ends at one node are none.
  await drag(page, end(page, 's1', 'ground'), ofNode(page, 'block'));
  assert.match(await page.locator('.toast').textContent(), /has its other end at block already/);
  const drawing = page.locator('.drawing');
  const box = await drawing.boundingBox();
  await page.mouse.move(...(await middle(end(page, 'm1', 'block'))));
  await page.mouse.down();
  await page.mouse.move(box.x + 15, box.y + box.height - 15, { steps: 5 });
  await redrawn(page, () => page.mouse.up());
  assert.match(await line(page, 'm1'), /at = "a"/);
  await close();
});

test('an element that is chosen is drawn by one drag from node to node, and what is there stays as it is', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await draw(page);
  const before = await netlist(page);
  await palette(page, 'dashpot').click();
  await redrawn(page, () => drag(page, ofNode(page, 'hand'), end(page, 's1', 'ground')));
  assert.match(await line(page, 'dashpot1'), /between = \["hand", "ground"\]/);
  for (const own of before.split('\n').filter((each) => /^(k1|m1|s1|pull) /.test(each))) assert.equal(await line(page, own.split(' ')[0]), own);
  // An element at one node is placed where the line ends.
  await palette(page, 'force').click();
  await redrawn(page, () => drag(page, end(page, 's1', 'ground'), ofNode(page, 'block')));
  assert.match(await line(page, 'force1'), /at = "block"/);
  await close();
});

test('a node is renamed, started elsewhere, and joined to another one', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const before = await netlist(page);
  await ofNode(page, 'block').click();
  await redrawn(page, () => write(page, 'name', 'cart'));
  assert.equal(await netlist(page), before.replaceAll('"block', '"cart'));
  await redrawn(page, () => write(page, 'position', '2 mm'));
  assert.match(await netlist(page), /\[nodes\]\ncart = \{ position = "2 mm" \}\n/);
  await redrawn(page, () => card(page).getByRole('button', { name: 'mass' }).click());
  assert.equal(await line(page, 'mass1'), 'mass1 = { type = "mass", at = "cart", mass = "1 kg" }');
  await close();
});

test('of what a model, a group or a repetition makes the card says so, and edits its source', async () => {
  const { page, close } = await open('#file=made.toml');
  await symbol(page, 'pivot.k1').click({ position: { x: 8, y: 4 } });
  await card(page).getByText('pivot.k1 is a part of the model holder, which this netlist defines').waitFor();
  await redrawn(page, () => write(page, 'k', '60'));
  assert.match(await line(page, 'pivot'), /k = "60 N\/m"/);
  await card(page).getByRole('button', { name: 'Open its text' }).click();
  assert.equal(await page.locator('.cm-activeLine').textContent(), '[models.holder]');
  await symbol(page, 'chain.1').click({ position: { x: 8, y: 4 } });
  await card(page).getByText('chain.1 is one of those that repeat makes').waitFor();
  await symbol(page, 'oil.slider1').click({ position: { x: 30, y: 4 } });
  await card(page).getByText('oil: in series').waitFor();
  await redrawn(page, () => write(page, 'coulomb Fc', '3'));
  assert.match(await netlist(page), /\{ name = "k1", type = "spring", stiffness = "100 N\/m" \}, # steel\n.*coulomb = "3 N" \} \] \},/);
  await close();
});

test('by keyboard alone: a scene is built, an element is chosen, changed and left', async () => {
  const { page, close } = await open('');
  await page.waitForSelector('dialog.gallery[open]');
  await anew(page);
  await palette(page, 'mass').focus();
  await page.keyboard.press('Enter');
  await asked(page, 'new node').focus();
  await redrawn(page, () => page.keyboard.press('Enter'));
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'Close the card');
  await page.keyboard.press('Enter');
  // The card leaves the keyboard where it came from.
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'mass1, mass');
  await palette(page, 'spring').focus();
  await page.keyboard.press('Enter');
  await asked(page, 'a').focus();
  await page.keyboard.press('Enter');
  await asked(page, 'ground').focus();
  await redrawn(page, () => page.keyboard.press('Enter'));
  await page.keyboard.press('Escape');
  assert.equal(await card(page).isVisible(), false);
  // Arrow keys go from one to the next.
  await symbol(page, 'mass1').focus();
  await page.keyboard.press('ArrowRight');
  const next = await page.evaluate(() => document.activeElement.getAttribute('aria-label'));
  assert.notEqual(next, 'mass1, mass');
  await symbol(page, 'spring1').focus();
  await page.keyboard.press('Enter');
  await field(page, 'stiffness k').focus();
  await page.keyboard.press('Control+a');
  await page.keyboard.type('400 N/m');
  await redrawn(page, () => page.keyboard.press('Tab'));
  assert.match(await line(page, 'spring1'), /stiffness = "400 N\/m"/);
  // The keyboard is at the next place of the card, and stays there when rheonet has read the text: at the slider.
  assert.equal(await page.evaluate(() => document.activeElement.closest('.inspector .field')?.querySelector('label').textContent), 'stiffness k');
  assert.equal(await page.evaluate(() => document.activeElement.type), 'range');
  await page.keyboard.press('Escape');
  await symbol(page, 'spring1').focus();
  await redrawn(page, () => page.keyboard.press('Delete'));
  assert.equal(await line(page, 'spring1'), undefined);
  assert.match(await netlist(page), /record = \["a.position"\]/);
  // A placement that was begun is given up.
  await palette(page, 'dashpot').focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  assert.equal(await palette(page, 'dashpot').getAttribute('aria-pressed'), 'false');
  await close();
});

test('length, rows and records of the run', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await draw(page);
  await page.getByRole('button', { name: 'Run …' }).click();
  await redrawn(page, () => write(page, 'stop', '4'));
  await redrawn(page, () => field(page, 's1.force').check());
  await redrawn(page, () => field(page, 'block.position').uncheck());
  assert.match(await netlist(page), /stop = "4 s"\noutput = \{ points = 801 \}\nrecord = \["k1.force", "s1.force"\]/);
  await accessible(page, 'the card of the run');
  await close();
});

test('the card of the run keeps what is typed, and its button closes it', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await draw(page);
  await page.getByRole('button', { name: 'Run …' }).click();
  // The records that are ticked are read while the next field is written.
  await redrawn(page, async () => {
    await field(page, 's1.force').check();
    await field(page, 'stop').click();
    await page.keyboard.press('Control+a');
    await page.keyboard.type('4 s', { delay: 150 });
    await page.keyboard.press('Enter');
  });
  assert.equal(await line(page, 'stop'), 'stop = "4 s"');
  assert.equal(await field(page, 'stop').inputValue(), '4 s');
  await card(page).getByRole('button', { name: 'Close the card' }).click({ timeout: 3000 });
  await card(page).waitFor({ state: 'hidden' });
  assert.equal(await line(page, 'stop'), 'stop = "4 s"');
  await close();
});

test('unfolded parameters of a card stay so when one of them is given', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await symbol(page, 'k1').click({ position: { x: 8, y: 4 } });
  await card(page).getByText('More parameters').click();
  await redrawn(page, () => card(page).getByRole('button', { name: 'Give rest' }).click());
  await card(page).getByText('More parameters (3)').waitFor();
  assert.ok(await card(page).locator('details.others').evaluate(({ open }) => open));
  const over = await card(page).evaluate((host) => [...host.querySelectorAll('input')].filter((input) => input.offsetParent).map((input) => input.getBoundingClientRect().right - host.getBoundingClientRect().left - host.clientWidth));
  assert.ok(over.every((px) => px <= -4), String(over));
  await close();
});

test('where the elements of two variants differ, the differences name the force of the drive', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await redrawn(page, () => page.getByRole('button', { name: 'Compare' }).click());
  const differences = page.locator('details[data-name="Differences"]');
  await differences.locator('summary').click();
  await differences.locator('table').waitFor();
  assert.doesNotMatch(await differences.textContent(), /different elements/);
  await symbol(page, 'k1').click({ position: { x: 8, y: 4 } });
  await redrawn(page, () => card(page).getByRole('button', { name: 'in parallel' }).click());
  await differences.getByText('The scenes have different elements: pull.force, the force of the drive').waitFor();
  await differences.locator('td', { hasText: 'pull.force' }).waitFor();
  await close();
});

test('every element type of rheonet is in the palette', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await draw(page);
  const shown = await page.locator('.palette-type').evaluateAll((all) => all.map((button) => button.dataset.type));
  const { stdout } = await rheonet(['components']);
  const types = [...stdout.matchAll(/^ {2}([a-z]\w*)(?:, \w+)? /gm)].map(([, type]) => type);
  assert.ok(types.length > 25);
  assert.deepEqual([...shown].sort(), [...types].sort());
  // Letters are explained, words are not.
  assert.deepEqual(await page.locator('.palette-meaning').allTextContents(), ['combined friction model', 'solid friction model', 'viscous friction model']);
  await close();
});

test('on a phone: a card below the schematic, a palette to push sideways, nothing beyond the edge', async () => {
  const { page, close } = await open('#file=stick-slip.toml', { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  await symbol(page, 's1').tap();
  await card(page).waitFor();
  await page.getByRole('button', { name: 'Draw', exact: true }).tap();
  await palette(page, 'spring').tap();
  await ofNode(page, 'hand').tap();
  await redrawn(page, () => asked(page, 'ground').tap());
  assert.match(await line(page, 'spring1'), /between = \["hand", "ground"\]/);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
  await accessible(page, 'drawing on a phone');
  await close();
});

test('the editor offers names, keys and units, and says what a word means', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  const offered = async () => {
    await page.locator('.cm-tooltip-autocomplete li').first().waitFor();
    return page.locator('.cm-tooltip-autocomplete .cm-completionLabel').allTextContents();
  };
  const accept = () => page.locator('.cm-tooltip-autocomplete li').first().click();
  await page.locator('.cm-line', { hasText: '[simulate]' }).click();
  await page.keyboard.press('Home');
  await page.keyboard.type('k2 = { type = "spri');
  assert.deepEqual(await offered(), ['spring']);
  await accept();
  await page.keyboard.type('", between = ["bl');
  assert.deepEqual(await offered(), ['block']);
  await accept();
  await page.keyboard.type('", "gr');
  assert.deepEqual(await offered(), ['ground']);
  await accept();
  await page.keyboard.type('"], sti');
  assert.deepEqual(await offered(), ['stiffness']);
  await accept();
  await page.keyboard.type('30 N');
  await page.keyboard.press('Control+Space');
  assert.ok((await offered()).includes('N/m'));
  await page.keyboard.press('Escape');
  assert.match(await line(page, 'k2'), /^k2 = \{ type = "spring", between = \["block", "ground"\], stiffness = "30 N"/);
  const [x, y] = await page.evaluate(() => {
    const texts = document.createTreeWalker([...document.querySelectorAll('.cm-line')].find((each) => each.textContent.startsWith('s1 =')), NodeFilter.SHOW_TEXT);
    const range = document.createRange();
    for (let node = texts.nextNode(); node; node = texts.nextNode()) {
      const at = node.textContent.indexOf('breakaway');
      if (at < 0) continue;
      range.setStart(node, at);
      range.setEnd(node, at + 4);
      const box = range.getBoundingClientRect();
      return [box.x + box.width / 2, box.y + box.height / 2];
    }
    return null;
  });
  await page.mouse.move(x + 40, y + 60);
  await page.mouse.move(x, y, { steps: 3 });
  await page.waitForSelector('.cm-tooltip .hover');
  assert.match(await page.locator('.cm-tooltip .hover').textContent(), /breakaway Fs: force at which it breaks away/);
  await close();
});

test('a netlist that is no TOML for the moment is not drawn in: the page leads to the line', async () => {
  const { page, close } = await open('#file=stick-slip.toml');
  await page.locator('.cm-line', { hasText: 'm1 =' }).click();
  await page.keyboard.press('End');
  await page.keyboard.type(' }');
  await page.locator('.mistake.error').first().waitFor();
  const before = await netlist(page);
  await symbol(page, 'k1').click({ position: { x: 8, y: 4 } });
  await page.waitForFunction(() => /Line 7 of the netlist is not TOML/.test(document.querySelector('.toast').textContent));
  assert.equal(await netlist(page), before);
  await close();
});
