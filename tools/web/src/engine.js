// The transport to rheonet as WebAssembly, which runs in Web Workers of this page. The worker's script, the module and the netlists are
// embedded in a single-file page, or are separate files.
import { t } from './messages.js';

async function inflated(part) {
  const embedded = document.getElementById(`part-${part}`)?.textContent;
  // Do not use fetch: a page opened from disk may not, even for a data: address.
  const bytes = embedded
    ? new Blob([Uint8Array.from(atob(embedded), (c) => c.charCodeAt(0))])
    : await (await answered(`${part}.gz`)).blob();
  const isPacked = new Uint8Array(await bytes.slice(0, 2).arrayBuffer()).join() === '31,139'; // gzip; a host may have unpacked it
  return new Response(isPacked ? bytes.stream().pipeThrough(new DecompressionStream('gzip')) : bytes);
}

async function answered(file) {
  const response = await fetch(new URL(file, document.baseURI)).catch(() => null);
  if (!response?.ok) throw new Error(t('a part of this page cannot be loaded: {file}', { file }));
  return response;
}

async function loaded() {
  const [script, module, files] = await Promise.all([
    inflated('worker.js').then((part) => part.blob()),
    inflated('rheonet.wasm').then(async (part) => WebAssembly.compile(await part.arrayBuffer())),
    inflated('netlists.json').then((part) => part.json()),
  ]);
  return { address: URL.createObjectURL(new Blob([script], { type: 'text/javascript' })), module, files };
}
let parts = null;

// A worker handles one request at a time. To cancel a running request, its worker is terminated.
class Desk {
  constructor() {
    this.request = null;
  }

  start() {
    this.started ??= this.begin();
    return this.started;
  }

  async begin() {
    parts ??= loaded();
    const { address, module, files } = await parts;
    this.worker = new Worker(address);
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = ({ message }) => this.take({ wrong: message || t('the worker of this page has ended') });
    this.worker.postMessage({ module, files });
  }

  async give(request) {
    this.request = request;
    try {
      await this.start();
    } catch (error) {
      this.end(error);
      return;
    }
    if (this.request !== request) return; // cancelled meanwhile
    this.worker.postMessage({ path: request.path, body: JSON.stringify(request.body) });
  }

  take({ message, wrong, done }) {
    const { request } = this;
    if (!request) return;
    if (message !== undefined) request.onmessage(JSON.parse(message));
    if (!wrong && !done) return;
    if (wrong) this.restart();
    this.end(wrong && new Error(wrong));
  }

  end(error) {
    const { request } = this;
    this.request = null;
    if (error) request.reject(error);
    else request.resolve();
    next();
  }

  restart() {
    this.worker?.terminate();
    this.worker = null;
    this.started = null;
  }

  cancel() {
    const { worker } = this;
    if (worker) this.restart();
    if (worker) this.start().catch(() => {}); // Ready for the next request.
    this.end(new DOMException('cancelled', 'AbortError'));
  }
}

// Two workers, so that the editor does not wait for a report or for the pictures of the gallery.
const desks = [new Desk(), new Desk()];
const waiting = [];

function next() {
  for (const desk of desks) {
    // The first worker is reserved for requests with a session: the netlist in the editor.
    const k = desk.request ? -1 : waiting.findIndex(({ body }) => (desk === desks[0] ? body.task === 'show' && body.session : true));
    if (k >= 0) desk.give(waiting.splice(k, 1)[0]);
  }
}

function ask(path, body, onmessage, signal) {
  return new Promise((resolve, reject) => {
    const request = { path, body, onmessage, resolve, reject };
    signal?.addEventListener('abort', () => {
      const k = waiting.indexOf(request);
      if (k >= 0) waiting.splice(k, 1);
      if (k >= 0) reject(new DOMException('cancelled', 'AbortError'));
      else desks.find((desk) => desk.request === request)?.cancel();
    });
    waiting.push(request);
    next();
  });
}

async function one(path, body) {
  let answer = null;
  await ask(path, body, (message) => (answer = message));
  if (answer.error) throw new Error(answer.error);
  return answer;
}

export const folder = () => one('/api/folder', {});

export const open = (file) => one('/api/scene', { file });

export const save = async () => {
  throw new Error(t('this page has no folder to save in'));
};

// A report with the fonts of this page: the module's template has none.
function withFonts(report) {
  // Those of another origin, as of an extension of the browser, may not be read.
  const own = [...document.styleSheets].filter(({ href }) => !href || new URL(href).origin === location.origin);
  const rules = own.flatMap(({ cssRules }) => [...cssRules]).filter((rule) => rule instanceof CSSFontFaceRule);
  return report.replace('</head>', () => `<style>${rules.map(({ cssText }) => cssText).join('')}</style></head>`);
}

export const task = (request, onmessage, signal) =>
  ask('/api/task', request, (message) => {
    if (message.error) onmessage({ kind: 'failed', message: message.error });
    else onmessage(message.type === 'text/html' ? { ...message, text: withFonts(message.text) } : message);
  }, signal);
