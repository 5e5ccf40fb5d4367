// Tori as GLB files.

/** A torus of so many quadrilaterals around and across, two triangles each. */
export function torus(around, across) {
  const positions = [];
  const normals = [];
  for (let i = 0; i < around; i += 1) {
    for (let j = 0; j < across; j += 1) {
      const [u, v] = [(i / around) * 2 * Math.PI, (j / across) * 2 * Math.PI];
      const normal = [Math.cos(u) * Math.cos(v), Math.sin(v), Math.sin(u) * Math.cos(v)];
      normals.push(...normal);
      positions.push(Math.cos(u) + 0.4 * normal[0], 0.4 * normal[1], Math.sin(u) + 0.4 * normal[2]);
    }
  }
  const vertex = (i, j) => (i % around) * across + (j % across);
  const indices = [];
  for (let i = 0; i < around; i += 1) {
    for (let j = 0; j < across; j += 1) {
      const [a, b, c, d] = [vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)];
      indices.push(a, b, c, a, c, d);
    }
  }
  return glb(new Float32Array(positions), new Float32Array(normals), new Uint32Array(indices));
}

function glb(positions, normals, indices) {
  const columns = [positions, normals, indices];
  const offsets = columns.map((_, at) => columns.slice(0, at).reduce((sum, column) => sum + column.byteLength, 0));
  const bytes = offsets[2] + indices.byteLength;
  const document = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    materials: [{ pbrMetallicRoughness: { baseColorFactor: [0.8, 0.3, 0.1, 1], metallicFactor: 0, roughnessFactor: 0.4 } }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0 }] }],
    buffers: [{ byteLength: bytes }],
    bufferViews: columns.map((column, at) => ({ buffer: 0, byteOffset: offsets[at], byteLength: column.byteLength })),
    accessors: [
      { bufferView: 0, componentType: 5126, count: positions.length / 3, type: 'VEC3', min: [-1.4, -0.4, -1.4], max: [1.4, 0.4, 1.4] },
      { bufferView: 1, componentType: 5126, count: normals.length / 3, type: 'VEC3' },
      { bufferView: 2, componentType: 5125, count: indices.length, type: 'SCALAR' },
    ],
  };
  const json = Buffer.from(JSON.stringify(document).padEnd(Math.ceil(JSON.stringify(document).length / 4) * 4));
  const chunk = (kind, data) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(data.length, 0);
    head.write(kind, 4, 'latin1');
    return Buffer.concat([head, data]);
  };
  const body = Buffer.concat([
    chunk('JSON', json),
    chunk('BIN\0', Buffer.concat(columns.map((column) => Buffer.from(column.buffer)))),
  ]);
  const head = Buffer.alloc(12);
  head.write('glTF', 0, 'latin1');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + body.length, 8);
  return Buffer.concat([head, body]);
}
