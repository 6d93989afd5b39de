// node build.mjs OUTPUT VERSION: bundles what the browser gets into OUTPUT, whose node_modules holds the packages. VERSION is that
// of rheonet.
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { fileURLToPath } from 'node:url';
import { billOfMaterials, fontsOf, notice, packagesOf } from './notices.mjs';

const source = dirname(fileURLToPath(import.meta.url));
const output = resolve(process.argv[2]);
const version = process.argv[3];
const esbuild = createRequire(join(output, 'package.json'))('esbuild');

// Fonts of KaTeX that the equations of the elements need; each is there as woff2, which every browser reads.
const wanted = /KaTeX_(Main-Regular|Math-Italic|Size[1-4]-Regular)\.woff2$/;
const fontFiles = new Set();
const fonts = {
  name: 'fonts',
  setup(build) {
    build.onLoad({ filter: /katex\.min\.css$/ }, ({ path }) => {
      const faces = readFileSync(path, 'utf8').replace(/@font-face\{[^}]*\}/g, (face) => {
        const url = /url\(([^)]*\.woff2)\)/.exec(face)?.[1];
        if (!url || !wanted.test(url)) return '';
        const file = join(dirname(path), url);
        fontFiles.add(file);
        const data = readFileSync(file).toString('base64');
        return face.replace(/src:[^;}]*/, `src:url(data:font/woff2;base64,${data}) format("woff2")`);
      });
      return { contents: faces, loader: 'css' };
    });
  },
};

async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [join(source, 'src', entry)],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2020',
    charset: 'utf8',
    loader: { '.txt': 'text' },
    legalComments: 'none',
    nodePaths: [join(output, 'node_modules')],
    outdir: output,
    write: false,
    metafile: true,
    plugins: [fonts],
  });
  const text = (ending) => result.outputFiles.find((file) => file.path.endsWith(ending)).text;
  return { script: text('.js'), style: text('.css'), packages: packagesOf(Object.keys(result.metafile.inputs), output) };
}

// Which packages a script holds; the texts of their licences stand beside it.
const credits = (packages, where) =>
  `/* With parts of ${packages.map(({ name, version: of, license }) => `${name} ${of} (${license})`).join(', ')}.\n   Their licences: ${where} */\n`;

const page = (name) => readFileSync(join(source, 'src', name), 'utf8');
const write = (name, text) => writeFileSync(join(output, name), text);
const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');

// The page with its marks replaced, which come in this order. They are looked for in the page alone: a text that looks like a
// mark stays what it is.
function filled(text, fillings) {
  let result = '';
  for (const [mark, by] of fillings) {
    const at = text.indexOf(mark);
    if (at < 0) throw new Error(`${mark} is missing`);
    result += text.slice(0, at) + by;
    text = text.slice(at + mark.length);
  }
  return result + text;
}

const report = await bundle('report.js');
const playground = await bundle('playground.js');
const embedded = fontsOf([...fontFiles].sort(), join(source, 'licences/OFL-1.1.txt'));

// One file that needs no other: what ends a script element must not stand in it.
const script = credits(report.packages, 'at the end of this page') + report.script.replaceAll('</script', '<\\/script');
write('report.html', filled(page('report.html'), [['/* style */', report.style], ['<!-- licences -->', escaped(notice(report.packages, embedded))], ['/* script */', script]]));

// tools/site makes another page of the same source, whose engine is in the page.
write('playground.html', filled(page('playground.html'), [['<!-- engine -->\n', '']]));
// The server gives these as they are: compressing them for each request took two seconds.
for (const [name, text] of [['playground.css', playground.style], ['playground.js', credits(playground.packages, '/licences.txt') + playground.script]]) {
  write(name, text);
  write(`${name}.gz`, gzipSync(text, { level: 9 }));
}
write('token.html', page('token.html'));

const all = [...new Map([...report.packages, ...playground.packages].map((each) => [each.name, each])).values()].sort((a, b) => (a.name < b.name ? -1 : 1));
write('NOTICE', notice(all, embedded));
write('sbom.cdx.json', billOfMaterials(version, all, embedded));
