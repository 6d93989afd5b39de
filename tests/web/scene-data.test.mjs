// The curves of a page are the rows of its run. No browser is needed.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { SceneData } from '../../tools/web/src/scene-data.js';

const rows = (count, ...values) => ({ kind: 'rows', count, columns: Buffer.from(new Float64Array(values).buffer).toString('base64') });
const scene = (...paths) => ({ kind: 'scene', records: paths.map((path) => ({ path })) });

test('rows come in parts, with all digits', () => {
  const data = SceneData.from([scene('x', 'f'), rows(2, 0, 0.1, 1 / 3, 5e-324, -1e300, Number.NaN), rows(1, 0.2, 7, 0.1 + 0.2)]);
  assert.deepEqual(data.time, [0, 0.1, 0.2]);
  assert.deepEqual(data.column('x'), [1 / 3, 5e-324, 7]);
  assert.deepEqual(data.column('f'), [-1e300, Number.NaN, 0.1 + 0.2]);
});

test('rows of a scene without records have times alone', () => {
  const data = SceneData.from([scene(), rows(2, 0, 1)]);
  assert.deepEqual(data.time, [0, 1]);
  assert.deepEqual(data.columns, []);
});

test('without an own function of the browser the bytes are the same', () => {
  const own = Uint8Array.fromBase64;
  Uint8Array.fromBase64 = undefined;
  const message = rows(1, -0.1, 2e17);
  assert.deepEqual(SceneData.from([scene('x'), message]).column('x'), [2e17]);
  Uint8Array.fromBase64 = (text) => new Uint8Array(Buffer.from(text, 'base64'));
  assert.deepEqual(SceneData.from([scene('x'), message]).column('x'), [2e17]);
  Uint8Array.fromBase64 = own;
});
