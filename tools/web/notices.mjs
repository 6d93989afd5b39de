// The packages and fonts in the pages: the texts of their licences (NOTICE), and a software bill of materials (CycloneDX).
import { readFileSync, readdirSync } from 'node:fs';
import { createHash } from 'node:crypto';
import { join } from 'node:path';

// The packages that a file of a bundle comes from; `packages` is the folder with node_modules.
export function packagesOf(inputs, packages) {
  const names = new Set();
  for (const input of inputs) {
    const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found) names.add(found[1]);
  }
  return [...names].sort().map((name) => {
    const folder = join(packages, 'node_modules', name);
    const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e(\.(md|txt))?$/i.test(entry));
    // Bundling on without it would break the licence, which is why it must not go unnoticed.
    if (!file || !license) throw new Error(`the package ${name} has no text of its licence`);
    return { name, version, license, purl: `pkg:npm/${name.replace('@', '%40')}@${version}`, text: readFileSync(join(folder, file), 'utf8').trim() };
  });
}

// Entry `wanted` of the table of names of a TrueType font (OpenType 1.9, "name"), as Windows reads it: UTF-16.
function nameInFont(font, wanted) {
  const tables = font.readUInt16BE(4);
  for (let k = 0; k < tables; ++k) {
    const entry = 12 + 16 * k;
    if (font.toString('latin1', entry, entry + 4) !== 'name') continue;
    const table = font.readUInt32BE(entry + 8);
    const texts = table + font.readUInt16BE(table + 4);
    for (let i = 0; i < font.readUInt16BE(table + 2); ++i) {
      const record = table + 6 + 12 * i;
      if (font.readUInt16BE(record) !== 3 || font.readUInt16BE(record + 6) !== wanted) continue;
      const begin = texts + font.readUInt16BE(record + 10);
      return Buffer.from(font.subarray(begin, begin + font.readUInt16BE(record + 8))).swap16().toString('utf16le');
    }
  }
  return '';
}

// The embedded fonts of a package, each with its own statement of its licence.
export function fontsOf(files, licence) {
  const version = JSON.parse(readFileSync(join(files[0], '../../../package.json'), 'utf8')).version;
  const saysOfLicence = 13; // the number of that entry
  return files.map((file) => {
    const font = readFileSync(file.replace(/\.woff2$/, '.ttf'));
    const said = nameInFont(font, saysOfLicence).replaceAll('\r', '').trim();
    if (!said.includes('SIL Open Font License')) throw new Error(`${file} says nothing of the SIL Open Font License`);
    return { name: /([^/]+)\.woff2$/.exec(file)[1], version, license: 'OFL-1.1', said, file, text: readFileSync(licence, 'utf8').trim() };
  });
}

export function notice(packages, fonts) {
  const line = '-'.repeat(78);
  const parts = packages.map(({ name, version, license, text }) => `${name} ${version} (${license})\n\n${text}`);
  const names = fonts.map(({ said, name }) => `${name}: ${said.split(/\n\s*\n/)[0].replaceAll('\n', ' ')}`);
  if (fonts.length) parts.push(`Fonts of KaTeX ${fonts[0].version} (${fonts[0].license})\n\n${names.join('\n')}\n\n${fonts[0].text}`);
  return `The reports and the playground of rheonet hold the software and the fonts below.\nThese are the texts of their licences.\n\n${line}\n${parts.join(`\n\n${line}\n`)}\n`;
}

// CycloneDX 1.5 (ECMA-424).
export function billOfMaterials(version, packages, fonts) {
  const licenses = (id) => [{ license: { id } }];
  const component = ({ name, version: of, license, purl }) => ({ type: 'library', name, version: of, licenses: licenses(license), purl, 'bom-ref': purl });
  const font = ({ name, version: of, license, file }) => ({
    type: 'file', name: `${name}.woff2`, version: of, licenses: licenses(license), 'bom-ref': `font:${name}`,
    hashes: [{ alg: 'SHA-256', content: createHash('sha256').update(readFileSync(file)).digest('hex') }],
  });
  return `${JSON.stringify({
    bomFormat: 'CycloneDX',
    specVersion: '1.5',
    version: 1,
    metadata: { component: { type: 'application', name: 'rheonet', version, licenses: licenses('MIT'), 'bom-ref': 'rheonet' } },
    components: [...packages.map(component), ...fonts.map(font)],
  }, null, 2)}\n`;
}
