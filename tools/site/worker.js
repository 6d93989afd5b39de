// rheonet in a Web Worker; the emscripten loader stands before this script. The first message brings the compiled module and the
// files of its file system in memory, the others a request each, which is answered by messages and { done }.
let answer = null;

async function begin({ module, files }) {
  const rheonet = await createRheonet({
    instantiateWasm(imports, ready) {
      WebAssembly.instantiate(module, imports).then((instance) => ready(instance, module));
      return {};
    },
    tell: (message) => postMessage({ message }),
    print: () => {},
    printErr: () => {},
  });
  for (const [path, text] of Object.entries(files)) {
    rheonet.FS.mkdirTree(path.slice(0, path.lastIndexOf('/')) || '/');
    rheonet.FS.writeFile(path, text);
  }
  return rheonet.cwrap('answer', null, ['string', 'string']);
}

onmessage = async ({ data }) => {
  if (data.module) {
    answer = begin(data);
    return;
  }
  try {
    (await answer)(data.path, data.body);
    postMessage({ done: true });
  } catch (error) {
    // A trap: the memory of the module is not to be trusted any more.
    postMessage({ wrong: error instanceof RangeError ? 'the scene needs more memory than a page may have' : String(error.message ?? error) });
  }
};
