// Texts with formulas, also those of strangers, in links: KaTeX sets text between dollar signs; text between backticks is set as code.
import katex from 'katex';
import 'katex/dist/katex.min.css';
import { element } from './dom.js';

function formula(tex) {
  const host = element('span', { class: 'formula' });
  katex.render(tex, host, { throwOnError: false, output: 'htmlAndMathml', maxSize: 20 });
  return host;
}

export const richText = (text) => text.split(/(`[^`]*`|\$[^$]+\$)/).map((part, k) =>
  (k % 2 === 0 ? part : part[0] === '$' ? formula(part.slice(1, -1)) : element('code', {}, part.slice(1, -1))));

// A paragraph for each part between empty lines.
export const paragraphs = (text) => text.split(/\n\s*\n/).filter((part) => part.trim()).map((part) => element('p', {}, richText(part.trim())));
