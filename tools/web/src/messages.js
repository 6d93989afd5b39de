// The texts of the page in the language that is chosen. A text is written in English where it is used, and is the key of its
// translations: messages/*.json. Without a translation the English text is shown.
let translations = {};

export function use(others) {
  translations = others;
}

// `{name}` in the text is replaced by the value of that name.
export const t = (text, values = {}) => (translations[text] ?? text).replace(/\{(\w+)\}/g, (place, name) => values[name] ?? place);
