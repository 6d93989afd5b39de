// node build.mjs OUTPUT: bundles what the browser gets into OUTPUT, whose node_modules holds the packages.
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const source = dirname(fileURLToPath(import.meta.url));
const output = resolve(process.argv[2]);
const esbuild = createRequire(join(output, 'package.json'))('esbuild');

// Fonts of KaTeX that the equations of the elements need; each is there as woff2, which every browser reads.
const wanted = /KaTeX_(Main-Regular|Math-Italic|Size[1-4]-Regular)\.woff2$/;
const fonts = {
  name: 'fonts',
  setup(build) {
    build.onLoad({ filter: /katex\.min\.css$/ }, ({ path }) => {
      const faces = readFileSync(path, 'utf8').replace(/@font-face\{[^}]*\}/g, (face) => {
        const url = /url\(([^)]*\.woff2)\)/.exec(face)?.[1];
        if (!url || !wanted.test(url)) return '';
        const data = readFileSync(join(dirname(path), url)).toString('base64');
        return face.replace(/src:[^;}]*/, `src:url(data:font/woff2;base64,${data}) format("woff2")`);
      });
      return { contents: faces, loader: 'css' };
    });
  },
};

// The pages hold code of others, whose licences want to be named with it.
function licences(inputs) {
  const names = new Set();
  for (const input of Object.keys(inputs)) {
    const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found) names.add(found[1]);
  }
  const said = [...names].sort().map((name) => {
    const folder = join(output, 'node_modules', name);
    const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
    const text = existsSync(join(folder, 'LICENSE')) ? readFileSync(join(folder, 'LICENSE'), 'utf8') : '';
    const holder = /^.*copyright.*$/im.exec(text)?.[0].trim() ?? '';
    return `${name} ${version} (${license}) ${holder}`.trim();
  });
  return `/* With parts of:\n${said.map((line) => `   ${line}`).join('\n')}\n   The licences are those of these packages. */\n`;
}

async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [join(source, 'src', entry)],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2020',
    charset: 'utf8',
    legalComments: 'none',
    nodePaths: [join(output, 'node_modules')],
    outdir: output,
    write: false,
    metafile: true,
    plugins: [fonts],
  });
  const text = (ending) => result.outputFiles.find((file) => file.path.endsWith(ending)).text;
  return { script: licences(result.metafile.inputs) + text('.js'), style: text('.css') };
}

const page = (name) => readFileSync(join(source, 'src', name), 'utf8');
const put = (text, mark, by) => {
  if (!text.includes(mark)) throw new Error(`${mark} is missing`);
  return text.split(mark).join(by);
};

// One file that needs no other: what ends a script element must not stand in it.
const report = await bundle('report.js');
const inline = put(put(page('report.html'), '/* style */', report.style), '/* script */', report.script.replaceAll('</script', '<\\/script'));
writeFileSync(join(output, 'report.html'), inline);

const playground = await bundle('playground.js');
writeFileSync(join(output, 'playground.html'), page('playground.html'));
writeFileSync(join(output, 'playground.css'), playground.style);
writeFileSync(join(output, 'playground.js'), playground.script);
