// The licences of the libraries in the module. Only the parts of their texts about files that the module is made of are kept.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

const debian = (...packages) => packages.map((each) => `/usr/share/doc/${each}/copyright`).find(existsSync);

/// The value of a field of a stanza in a Debian copyright file.
const field = (stanza, name) => stanza.match(new RegExp(`^${name}:((?:.*\n?)(?:[ \\t].*\n?)*)`, 'm'))?.[1].trim() ?? '';
const nameOfLicence = (stanza) => field(stanza, 'License').split('\n')[0];

/// The stanzas of a Debian copyright file about files that are `inside`, with the texts of their licences.
function aboutFiles(text, inside) {
  const stanzas = text.split(/\n(?:[ \t]*\n)+/);
  const kept = new Set(stanzas.filter((stanza) => field(stanza, 'Files').split(/\s+/).some(inside)));
  const named = new Set([...kept].flatMap((stanza) => [nameOfLicence(stanza), ...nameOfLicence(stanza).split(/\s+(?:and|or|with)\s+|,\s*/)]));
  return stanzas.filter((stanza) => !/^(Files|License):/m.test(stanza) || kept.has(stanza) || (/^License:/.test(stanza) && named.has(nameOfLicence(stanza)))).join('\n\n');
}

/// The parts of SuiteSparse's list of licences, each under a line `==> PACKAGE/... <==`, about these packages.
function aboutPackages(text, packages) {
  return text.split(/^(?==+> )/m).filter((part) => !part.startsWith('==') || packages.some((name) => part.startsWith(`==> ${name}/`))).join('');
}

/// One text for each of them.
export function licencesOfModule(sources) {
  const parts = [
    ['SUNDIALS 6.4.1 (BSD-3-Clause)', join(sources, 'sundials/LICENSE')],
    ['AMD, BTF, COLAMD and KLU of SuiteSparse 5.12.0 (BSD-3-Clause, LGPL-2.1-or-later)', join(sources, 'suitesparse/LICENSE.txt'),
      (text) => aboutPackages(text, ['AMD', 'BTF', 'COLAMD', 'KLU'])],
    ['Boost', debian('libboost-dev', 'libboost1.74-dev')],
    ['Eigen', debian('libeigen3-dev')],
    ['fast_float', debian('libfast-float-dev')],
    // Without the documentation and the build of {fmt}.
    ['{fmt}', debian('libfmt-dev'), (text) => aboutFiles(text, (file) => file === '*')],
    ['JSON for Modern C++', debian('nlohmann-json3-dev')],
    ['toml++', debian('libtomlplusplus-dev')],
    // The module holds Emscripten's run-time libraries and what it adds to every program (*), without tests.
    ['The run-time libraries of Emscripten', debian('emscripten'), (text) => aboutFiles(text, (file) => file === '*' || /^system\/lib\/(?!.*(test|bench|fuzz))/.test(file))],
  ];
  return parts.map(([name, file, part = (text) => text]) => {
    if (!file) throw new Error(`${name} has no text of its licence`);
    return `${'-'.repeat(78)}\n${name}\n\n${part(readFileSync(file, 'utf8')).trim()}\n`;
  });
}
