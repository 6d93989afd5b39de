// The pictures of pages in the tutorial show the result of its instructions.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { folderWith, remove } from './support.mjs';

const project = join(dirname(fileURLToPath(import.meta.url)), '../..');
// Width and height of a PNG, and its bytes.
function picture(file) {
  const bytes = readFileSync(file);
  assert.equal(bytes.toString('latin1', 1, 4), 'PNG', file);
  return { width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20), size: bytes.length };
}

test('the tutorial comes to the pages that it shows', async () => {
  const made = folderWith({});
  const { stdout } = await promisify(execFile)(join(project, 'tools/teaching/tutorial'), [made], { env: { ...process.env, NODE: process.execPath }, maxBuffer: 1 << 24 });
  assert.match(stdout, /serving|http:\/\/127\.0\.0\.1/);
  for (const name of ['report.png', 'playground.png']) {
    const [kept, drawn] = [join(project, 'netlists/teaching/tutorial', name), join(made, name)].map(picture);
    assert.deepEqual([drawn.width, drawn.height], [kept.width, kept.height], name);
    // A page that is empty, or lacks its plots, is a far smaller file.
    assert.ok(drawn.size > 0.6 * kept.size && drawn.size < 1.6 * kept.size, `${name}: ${drawn.size} bytes, the one that is kept has ${kept.size}`);
  }
  remove(made);
});
