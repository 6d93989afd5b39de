// What the playground asks for: of the server that the page comes from, or of rheonet in the page itself.
import * as engine from './engine.js';
import { t } from './messages.js';
import * as server from './server.js';

const transport = document.querySelector('meta[name="rheonet-engine"]') ? engine : server;

// Whether a run needs no server.
export const isAlone = transport === engine;

// folder(): the netlists, for the gallery.
// open(file): a netlist: its text, and what tells that from another text that the file may get.
// save(file, text, version): writes one, over another only if that has this version; its new version. An error says in `there`
//   which version is in the way.
// task(request, onmessage, signal): gives a task; onmessage gets each message as it comes.
export const { folder, open, save, task } = transport;

// The one message of a kind that a task is for; throws what is wrong.
async function answer(request, kind) {
  let made = null;
  let wrong = null;
  await task(request, (message) => {
    if (message.kind === kind) made = message;
    if (message.kind === 'failed') wrong = message.message;
    if (message.kind === 'mistakes') wrong ??= message.items.find((item) => item.severity === 'error')?.message;
  });
  if (!made) throw new Error(wrong ?? t('nothing came back'));
  return made;
}

export async function file(request) {
  const { text, type } = await answer(request, 'file');
  return new Blob([text], { type });
}

export const explain = (request) => answer({ task: 'explain', ...request }, 'explanation');

// The element types and the schema of netlists.
export const catalogue = () => answer({ task: 'catalogue' }, 'catalogue');
