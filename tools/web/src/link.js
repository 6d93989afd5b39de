// A link that contains a scene. The scene follows the # of the address, which browsers do not send to servers. It is deflated with one of
// two preset dictionaries, the texts of link-words, so that only differences from them take space. Old links need their dictionary forever:
// never change these files; add a new dictionary with another letter.
import { deflateSync, Inflate } from 'fflate';
import a from './link-words/a.txt';
import b from './link-words/b.txt';
import { t } from './messages.js';

const bytes = (text) => new TextEncoder().encode(text);
const dictionaries = { a: bytes(a), b: bytes(b) };
const between = '\0'; // Does not occur in netlists.

function letters(packed) {
  let text = '';
  for (const byte of packed) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

const most = 4 << 20; // Largest scene [bytes]; a small link could unpack to a huge text.
const piece = 1 << 10; // Bytes of a link that are unpacked at a time, to 1 MB at most.

function inflated(text, dictionary) {
  const packed = Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
  const pieces = [];
  let size = 0;
  let isComplete = false;
  const stream = new Inflate({ dictionary }, (data, final) => {
    pieces.push(data);
    size += data.length;
    isComplete = final;
  });
  for (let at = 0; at < packed.length && size <= most; at += piece) stream.push(packed.subarray(at, at + piece), at + piece >= packed.length);
  if (size > most) throw new Error(t('the link holds too much'));
  if (!isComplete) throw new Error(t('the link ends too early'));
  const whole = new Uint8Array(size);
  let filled = 0;
  for (const data of pieces) {
    whole.set(data, filled);
    filled += data.length;
  }
  return new TextDecoder('utf-8', { fatal: true }).decode(whole);
}

// The text after the #: scenes and the choice of plots. The lesson of a scene comes behind it, as a part without a name.
export function encode({ scenes, plots }) {
  const isChosen = Object.values(plots).some((value) => value !== null);
  const content = bytes([isChosen ? JSON.stringify(plots) : '', ...scenes.flatMap(({ file, text, lesson }) => [file || 'scene.toml', text, ...(lesson ? ['', lesson.text] : [])])].join(between));
  const all = Object.entries(dictionaries).map(([letter, dictionary]) => `s=${letter}${letters(deflateSync(content, { level: 9, mem: 12, dictionary }))}`);
  return all.sort((one, other) => one.length - other.length)[0];
}

// `kind` and `value` are the text before and after the first = of the address. Links of the kind `scene` are older than the dictionaries.
export function decode(kind, value) {
  if (kind === 'scene') return JSON.parse(inflated(value));
  const dictionary = dictionaries[value[0]];
  if (!dictionary) throw new Error(t('the link is of a newer version'));
  const [plots, ...parts] = inflated(value.slice(1), dictionary).split(between);
  if (parts.length < 2 || parts.length % 2 !== 0) throw new Error(t('the link lacks a part'));
  const scenes = [];
  for (let k = 0; k < parts.length; k += 2) {
    if (parts[k] || !k) scenes.push({ file: parts[k], text: parts[k + 1] });
    else scenes.at(-1).lesson = { text: parts[k + 1] };
  }
  return { scenes, plots: plots ? JSON.parse(plots) : {} };
}
