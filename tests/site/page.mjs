// The site in a browser: a static host below a path, and the single file from disk. See tests/web/support.mjs for the environment.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { pathToFileURL } from 'node:url';

export const site = process.env.SITE;
export const oneFile = pathToFileURL(join(site, 'rheonet.html')).href;

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.gz': 'application/gzip', '.txt': 'text/plain' };

// A host of static files that knows nothing of rheonet: { address, asked: the paths that it was asked for, stop }.
export async function host(path = '/some/place/') {
  const asked = [];
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://host');
    asked.push(`${request.method} ${pathname}`);
    const name = normalize(pathname.slice(path.length) || 'index.html');
    try {
      if (!pathname.startsWith(path)) throw new Error('elsewhere');
      const bytes = readFileSync(join(site, name));
      response.writeHead(200, { 'Content-Type': types[extname(name)] }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address();
  return { origin: `http://127.0.0.1:${port}`, address: `http://127.0.0.1:${port}${path}`, asked, stop: () => new Promise((resolve) => server.close(resolve)) };
}
