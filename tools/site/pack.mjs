// node pack.mjs WEB BUILD NETLISTS OUTPUT: puts the site together in OUTPUT, of the bundled pages in WEB, what build.sh has made in BUILD,
// and the netlists.
import { readdirSync, readFileSync, mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { licencesOfModule } from './licences.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const [web, build, netlists, output] = process.argv.slice(2);
const [wasm, sources] = [join(build, 'wasm'), join(build, 'sources')];
const read = (folder, name) => readFileSync(join(folder, name), 'utf8');

// The page has the fonts of reports already, and gives them to each report (engine.js).
const fontsIn = (text) => text.match(/@font-face\s*\{[^}]*\}/g) ?? [];
const familiesIn = (text) => fontsIn(text).map((rule) => rule.match(/font-family:\s*([^;}]+)/)[1]);
function withoutFonts(text) {
  const there = familiesIn(read(web, 'playground.css'));
  const missing = familiesIn(text).filter((family) => !there.includes(family));
  if (missing.length || !there.length) throw new Error(`the page has no fonts ${missing}, which reports take from it`);
  return fontsIn(text).reduce((rest, rule) => rest.replace(rule, ''), text);
}

// The file system of the module: what its file offer gives (tools/serve/below.hpp), the names of netlists in the order of the gallery, and the
// template of reports, the units, and the JSON Schema.
const files = { '/report.html': withoutFonts(read(web, 'report.html')), '/units.txt': read(build, 'units.txt'), '/schema.json': JSON.stringify(JSON.parse(read(build, 'schema.json'))) };
for (const entry of readdirSync(netlists, { withFileTypes: true, recursive: true })) {
  const path = join(entry.parentPath ?? entry.path, entry.name);
  if (!entry.isFile() || !/\.(toml|csv|lesson)$|^README\.md$/.test(entry.name)) continue;
  const text = readFileSync(path, 'utf8');
  // The gallery has the order in which a page names its netlists, and needs nothing else of it.
  files[`/netlists/${relative(netlists, path)}`] = entry.name === 'README.md' ? (text.match(/[\w-]+\.toml/g) ?? []).join('\n') : text;
}

const licences = [read(web, 'NOTICE'), ...licencesOfModule(sources)].join('\n');

const packed = {
  'worker.js': Buffer.from(`${read(wasm, 'rheonet.js')}\n${read(here, 'worker.js')}`),
  'rheonet.wasm': readFileSync(join(wasm, 'rheonet.wasm')),
  'netlists.json': Buffer.from(JSON.stringify(files)),
};
for (const name in packed) packed[name] = gzipSync(packed[name], { level: 9 });

// A page of the playground's source with its marks replaced; `by` is a function, as a text may have a $ in it.
function page(fillings) {
  let text = read(join(here, '../web/src'), 'playground.html');
  for (const [mark, by] of fillings) {
    if (!text.includes(mark)) throw new Error(`${mark} is missing`);
    text = text.replace(mark, () => by);
  }
  return text;
}
const head = (script, connect) => `<meta name="rheonet-engine" content="page">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src ${script} 'wasm-unsafe-eval' blob:; worker-src blob:; connect-src ${connect}; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src data:; base-uri 'none'; form-action 'none'">`;
const preloaded = ['worker.js', 'rheonet.wasm', 'netlists.json'].map((name) => `<link rel="preload" as="fetch" crossorigin href="${name}.gz">`).join('\n');
const script = read(web, 'playground.js').replaceAll('</script', '<\\/script');
const inert = (id, text) => `<script type="text/plain" id="${id}">${text}</script>`;

mkdirSync(output, { recursive: true });
const write = (name, content) => writeFileSync(join(output, name), content);
for (const [name, bytes] of Object.entries(packed)) write(`${name}.gz`, bytes);
write('index.html', page([['<!-- engine -->', `${head("'self'", "'self'")}\n${preloaded}`]]));
for (const name of ['playground.css', 'playground.js']) write(name, read(web, name));
write('licences.txt', licences);
write('rheonet.html', page([
  ['<!-- engine -->', head("'unsafe-inline'", "'none'")],
  ['<link rel="stylesheet" href="playground.css">', `<style>${read(web, 'playground.css')}</style>`],
  ['<script src="playground.js"></script>', [
    inert('licences', licences.replaceAll('</script', '<\\/script')),
    ...Object.entries(packed).map(([name, bytes]) => inert(`part-${name}`, bytes.toString('base64'))),
    `<script>${script}</script>`].join('\n')],
]));
const size = (names) => names.reduce((sum, name) => sum + gzipSync(readFileSync(join(output, name)), { level: 9 }).length, 0);
console.log(`site: ${size(['index.html', 'playground.css', 'playground.js', ...Object.keys(packed).map((name) => `${name}.gz`)])} bytes compressed; as one file: ${size(['rheonet.html'])}`);
