// Requests of the playground, sent to the server of the page or to rheonet as WebAssembly in the page.
import * as engine from './engine.js';
import { t } from './messages.js';
import * as server from './server.js';

const transport = document.querySelector('meta[name="rheonet-engine"]') ? engine : server;

// Whether a run needs no server.
export const isAlone = transport === engine;

// folder(): the netlists, for the gallery.
// open(file): the text of a netlist and its version.
// save(file, text, version): writes a netlist and returns its new version. An existing file is replaced only if it has the given version;
//   otherwise the error has the file's version in `there`.
// task(request, onmessage, signal): starts a task; calls onmessage for each message when it arrives.
export const { folder, open, save, task } = transport;

// The message of one kind that a task returns; throws its error.
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
