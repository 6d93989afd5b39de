// The context of a position in a netlist: enclosing tables, key, quoted text. Works also for incomplete text that is not valid TOML.

const bare = /[A-Za-z0-9_-]/;

// Returns { path, key, given, from, word, quote, isHeader }. `path`: names of the enclosing tables and indices of the enclosing items.
// `key`: the key of the value at the position; null at a key. `given`: the values before the position in the same table, as written.
// `from`: the begin of the word or of the quoted text. `quote`: the kind of quotes around the position, or ''.
export function placeIn(text, position) {
  const frames = [{ path: [], given: new Map(), isArray: false }];
  let key = null; // before the value that is being read
  let keys = []; // the parts of the key that is being read
  let start = null; // of the value
  let from = null; // of the word
  let isHeader = false;
  let header = [];
  let i = 0;
  const top = () => frames.at(-1);
  const endValue = (end) => {
    if (key !== null && !top().isArray && start !== null) top().given.set(key, text.slice(start, end).trim());
    start = null;
  };
  const newLine = (end) => {
    // An inline table stays on its line; an array may go on.
    if (frames.some(({ isArray }) => isArray)) return;
    endValue(end);
    frames.length = 1;
    key = null;
    keys = [];
    if (isHeader) {
      isHeader = false;
      frames[0] = { path: header, given: new Map(), isArray: false };
    }
  };
  while (i < position) {
    const c = text[i];
    if (c === '#') {
      const end = text.indexOf('\n', i);
      if (end < 0 || end >= position) return null; // in a comment
      i = end;
      continue;
    }
    if (c === '"' || c === "'") {
      const quote = text.startsWith(c.repeat(3), i) ? c.repeat(3) : c;
      let end = i + quote.length;
      while (end < text.length && !text.startsWith(quote, end) && (quote.length === 3 || text[end] !== '\n')) end += c === '"' && text[end] === '\\' ? 2 : 1;
      if (end >= position) return found(i + quote.length, quote);
      if (key === null && !top().isArray) (isHeader ? header : keys).push(text.slice(i + quote.length, end));
      else start ??= i;
      i = text.startsWith(quote, end) ? end + quote.length : end; // one that is not closed ends with its line
      continue;
    }
    if (c === '\n') newLine(i);
    else if (c === '[' && key === null && frames.length === 1 && !keys.length) {
      isHeader = true;
      header = [];
    } else if (c === ']' && isHeader) {
      // to the end of the line
    } else if (c === '=' && key === null && !top().isArray) {
      key = keys.at(-1) ?? '';
      top().prefix = keys.slice(0, -1);
      keys = [];
    } else if (c === '{' || c === '[') {
      const inner = [...top().path, ...(top().isArray ? [top().count] : [...(top().prefix ?? []), key ?? ''])];
      top().key = key;
      frames.push({ path: inner, given: new Map(), isArray: c === '[', count: 0, start: i });
      key = c === '[' ? key : null;
    } else if ((c === '}' || c === ']') && frames.length > 1) {
      endValue(i);
      start = frames.pop().start;
      key = top().key;
    } else if (c === ',') {
      endValue(i);
      if (top().isArray) top().count += 1;
      else key = null;
    } else if (bare.test(c)) {
      const begin = i;
      while (i < text.length && (bare.test(text[i]) || (key !== null && text[i] === '.'))) ++i;
      if (i >= position) return found(begin, '');
      if (isHeader) header.push(text.slice(begin, i));
      else if (key === null && !top().isArray) keys.push(text.slice(begin, i));
      else start ??= begin;
      continue;
    }
    ++i;
  }
  return found(position, '');

  function found(begin, quote) {
    from = begin;
    const { path, given, isArray, count } = top();
    return {
      path: isHeader ? header : isArray ? [...path, count] : [...path, ...(key === null ? keys : top().prefix ?? [])], given, isHeader, from, quote,
      key: isArray ? frames.at(-2).key : key, word: text.slice(begin, position),
    };
  }
}
