// The transport to `rheonet serve`, from which the page has come.
import { t } from './messages.js';

const asJson = { 'Content-Type': 'application/json' };

// The token of the address that the server has printed. It leaves the address, which people copy, for the storage of this origin,
// where the page finds it when it is loaded again; pages of other ports or hosts cannot read it there.
function take(key) {
  const given = new URLSearchParams(location.search).get(key);
  try {
    if (given) localStorage.setItem(key, given);
    // In a frame of another page no cookie loads the page again, and nobody copies its address.
    if (given && key === 'token' && window === top) history.replaceState(history.state, '', location.pathname + location.hash);
    return given ?? localStorage.getItem(key) ?? '';
  } catch {
    return given ?? ''; // without storage it stays in the address
  }
}
// The key of a link for others stays in the address, for it saves nothing in the folder. It is used where there is no token, or one of an earlier start.
const guest = take('guest');
let token = take('token') || guest;

async function ask(path, options = {}) {
  const response = await fetch(path, { ...options, headers: { ...options.headers, Authorization: `Bearer ${token}` } }).catch((error) => {
    if (error.name === 'AbortError') throw error;
    throw new Error(t('the server does not answer: is `rheonet serve` still running?'));
  });
  if (response.status === 401 && guest && token !== guest) {
    token = guest;
    return ask(path, options);
  }
  if (response.ok) return response;
  const { error, version } = await response.json().catch(() => ({}));
  throw Object.assign(new Error(error ?? t('the server answers {status}', { status: response.status })), { there: response.status === 409 ? version : '' });
}

const post = (path, value, signal) => ask(path, { method: 'POST', headers: asJson, body: JSON.stringify(value), signal });

export async function folder() {
  return (await ask('/api/folder')).json();
}

// A netlist of the folder: its text, and what tells that from another text that the file may get.
export async function open(file) {
  const response = await ask(`/api/scene?file=${encodeURIComponent(file)}`);
  return { text: await response.text(), version: response.headers.get('ETag').replaceAll('"', '') };
}

// An error says in `there` which version is in the way.
export async function save(file, text, version) {
  return (await (await post('/api/save', { file, text, version })).json()).version;
}

let turn = 0; // of the newest task: the server must not take an older one that arrives later for a newer one

// Gives a task; onmessage gets each message as it comes.
export async function task(request, onmessage, signal) {
  const response = await post('/api/task', { ...request, turn: ++turn }, signal);
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = '';
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    const lines = (rest + value).split('\n');
    rest = lines.pop();
    lines.forEach((line) => onmessage(JSON.parse(line)));
  }
}
