// The files that a model refers to: buffers and images of a glTF, materials of an OBJ and their textures.

const text = (bytes) => new TextDecoder().decode(bytes);

function ofGltf(bytes) {
  let document;
  try {
    document = JSON.parse(text(bytes));
  } catch {
    return []; // The module says what is wrong with it.
  }
  const uris = [document.buffers, document.images].flatMap((list) => (Array.isArray(list) ? list : []));
  return uris
    .map((entry) => entry?.uri)
    .filter((uri) => typeof uri === 'string' && !uri.startsWith('data:'))
    .map((uri) => {
      try {
        return decodeURIComponent(uri);
      } catch {
        return uri;
      }
    });
}

const statements = (bytes, keyword) =>
  [...text(bytes).matchAll(new RegExp(`^[ \\t]*(?:${keyword})[ \\t]+(.+?)[ \\t]*$`, 'gm'))].map(([, rest]) => rest);

// Options come before the name.
const ofMtl = (bytes) =>
  statements(bytes, 'map_\\w+|bump|disp|decal|refl|norm').map((rest) => rest.split(/\s+/).at(-1));

const READERS = { gltf: ofGltf, obj: (bytes) => statements(bytes, 'mtllib'), mtl: ofMtl };

const ending = (path) => path.split('.').at(-1).toLowerCase();

/**
 * Reads a model and what it refers to, by `read(path)`, which gives a promise of bytes, or of `null` where there is no file.
 * Paths start at the model's folder. What is missing is left out: the module warns of it.
 */
export async function collect(model, read) {
  const files = new Map();
  const visit = async (path, bytes) => {
    files.set(path, bytes);
    const names = READERS[ending(path)]?.(bytes) ?? [];
    const folder = path.split('/').slice(0, -1);
    await Promise.all(
      names.map(async (name) => {
        const parts = [...folder, ...name.replaceAll('\\', '/').split('/')].filter((part) => part && part !== '.');
        const other = parts.join('/');
        if (parts.includes('..') || /^([a-z]+:|\/)/i.test(name) || files.has(other)) return;
        files.set(other, null);
        const found = await read(other);
        if (found) await visit(other, found);
        else files.delete(other);
      }),
    );
  };
  const bytes = await read(model);
  if (bytes) await visit(model, bytes);
  return files;
}
