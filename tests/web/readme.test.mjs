// The list of files in tools/web/README.md.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

test('every part of the pages is listed', () => {
  const web = join(dirname(fileURLToPath(import.meta.url)), '../../tools/web');
  const listed = new Set(readFileSync(join(web, 'README.md'), 'utf8').match(/[\w-]+(\.(js|html)|\/)/g));
  for (const entry of readdirSync(join(web, 'src'), { withFileTypes: true })) if (!entry.name.endsWith('.css')) assert.ok(listed.has(entry.isDirectory() ? `${entry.name}/` : entry.name), entry.name);
});
