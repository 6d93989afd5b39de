// What the playground asks of the server that it comes from.

async function checked(response) {
  if (response.ok) return response;
  const why = await response.json().catch(() => ({}));
  throw new Error(why.error ?? `the server answers ${response.status}`);
}

export async function folder() {
  return (await checked(await fetch('/api/folder'))).json();
}

export async function open(file) {
  return (await checked(await fetch(`/api/scene?file=${encodeURIComponent(file)}`))).text();
}

const asJson = { 'Content-Type': 'application/json' };

export async function save(file, text) {
  await checked(await fetch('/api/save', { method: 'POST', headers: asJson, body: JSON.stringify({ file, text }) }));
}

// Gives a task; onmessage gets each message as it comes.
export async function task(request, onmessage, signal) {
  const response = await checked(await fetch('/api/task', { method: 'POST', headers: asJson, body: JSON.stringify(request), signal }));
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

// The one message of a kind that a task is for; throws what is wrong.
async function answer(request, kind) {
  let made = null;
  let wrong = null;
  await task(request, (message) => {
    if (message.kind === kind) made = message;
    if (message.kind === 'failed') wrong = message.message;
    if (message.kind === 'mistakes') wrong ??= message.items.find((item) => item.severity === 'error')?.message;
  });
  if (!made) throw new Error(wrong ?? 'nothing came back');
  return made;
}

export async function file(request) {
  const { text, type } = await answer(request, 'file');
  return new Blob([text], { type });
}

export const explain = (request) => answer({ task: 'explain', ...request }, 'explanation');
