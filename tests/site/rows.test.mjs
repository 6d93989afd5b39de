// Every scene of netlists/ gives the same rows in WebAssembly as natively, within the accuracy that it asks for.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';
import { promisify } from 'node:util';
import { netlists, scenes, start, text } from './module.mjs';

const run = promisify(execFile);

// Columns by name; an empty field is NaN.
function columns(csv) {
  const [head, ...rows] = csv.trim().split('\n').map((line) => line.split(','));
  return new Map(head.map((name, k) => [name, rows.map((row) => (row[k] === '' ? Number.NaN : Number(row[k])))]));
}

// Both runs keep the accuracy, of the largest magnitude of each record: they differ by at most twice that. An event, and the rows
// on both its sides, may be that much earlier or later.
function difference(native, here, accuracy) {
  // The page has columns for the curves of [plot] besides.
  assert.deepEqual([...native.keys()].filter((name) => !here.has(name)), []);
  const time = native.get('time');
  assert.equal(here.get('time').length, time.length, 'rows');
  for (const [name, values] of native) {
    const scale = Math.max(...values.map(Math.abs).filter(Number.isFinite), 0);
    const others = here.get(name);
    values.forEach((value, k) => {
      const same = Object.is(value, others[k]) || (Number.isNaN(value) && Number.isNaN(others[k]));
      if (!same && !(Math.abs(value - others[k]) <= 2 * accuracy * scale)) {
        throw new Error(`${name} at ${time[k]} s: ${value} natively, ${others[k]} here; ${Math.abs(value - others[k]) / scale} of ${scale}, accuracy ${accuracy}`);
      }
    });
  }
}

const ask = await start();
for (const name of scenes()) {
  test(name, async () => {
    // Scenes that take long say with which value they are as good a test: `# short: parameters.turns=1e5`.
    const short = /^# short: parameters\.(\w+)=(\S+)$/m.exec(text(name));
    const shortened = short ? text(name).replace(new RegExp(`^${short[1]} *=.*$`, 'm'), `${short[1]} = ${short[2]}`) : text(name);
    const request = { file: name, text: shortened };
    const scene = ask('/api/task', { task: 'show', ...request, draw: false }).find(({ kind }) => kind === 'scene');
    const native = run(process.env.RHEONET, ['run', join(netlists, name), '--quiet', ...(short ? ['--set', `parameters.${short[1]}=${short[2]}`] : [])], { maxBuffer: 1 << 28 }).then(({ stdout }) => stdout, (error) => error.stdout || error);
    const answers = ask('/api/task', { task: 'csv', ...request });
    const expected = await native;
    if (expected instanceof Error) {
      assert.ok(answers.some(({ kind, items }) => kind === 'failed' || items?.some(({ severity }) => severity === 'error')), `natively: ${expected.stderr}`);
      return;
    }
    const file = answers.find(({ kind }) => kind === 'file');
    assert.ok(file, JSON.stringify(answers));
    difference(columns(expected), columns(file.text), scene.accuracy);
  });
}
