// Serves folders on this machine: [address, close].

import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const TYPES = {
  '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css',
  '.wasm': 'application/wasm', '.png': 'image/png',
};

/** `folders` are tried in order for each address. */
export async function serve(...folders) {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
    const files = folders.map((folder) => join(folder, path.endsWith('/') ? `${path}index.html` : path));
    const file = files.find((file) => existsSync(file) && statSync(file).isFile());
    if (file === undefined) return response.writeHead(404).end();
    // As hosts of packages do: another page may load these.
    const headers = { 'access-control-allow-origin': '*' };
    response.writeHead(200, { ...headers, 'content-type': TYPES[extname(file)] ?? 'application/octet-stream' });
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return [`http://127.0.0.1:${server.address().port}/`, () => server.close()];
}
