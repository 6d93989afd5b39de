// The module of the site in Node.js: SITE is the folder of the site, SITE_MODULE that of the loader that its worker has in it,
// NETLISTS that of the netlists.
import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { gunzipSync } from 'node:zlib';

export const netlists = process.env.NETLISTS;
export const site = process.env.SITE;

// The netlists that are scenes, by name.
export function scenes() {
  const files = readdirSync(netlists, { recursive: true }).filter((name) => name.endsWith('.toml'));
  return files.filter((name) => /^\[simulate\]/m.test(text(name)) && /^\[?\[?elements/m.test(text(name))).sort();
}
export const text = (name) => readFileSync(join(netlists, name), 'utf8');

// A function that answers a request by its messages.
export async function start() {
  const create = createRequire(import.meta.url)(join(process.env.SITE_MODULE, 'rheonet.js'));
  let messages = [];
  const module = await create({ wasmBinary: gunzipSync(readFileSync(join(site, 'rheonet.wasm.gz'))), tell: (line) => messages.push(JSON.parse(line)), printErr: () => {} });
  for (const [path, content] of Object.entries(JSON.parse(gunzipSync(readFileSync(join(site, 'netlists.json.gz')))))) {
    module.FS.mkdirTree(dirname(path));
    module.FS.writeFile(path, content);
  }
  const answer = module.cwrap('answer', null, ['string', 'string']);
  return (path, body) => {
    messages = [];
    answer(path, JSON.stringify(body));
    return messages;
  };
}
