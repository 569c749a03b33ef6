// What the page holds, as the program wrote it, and its places in a ball of radius 1.

const ARRAYS = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };

/** What base64 stands for. */
const bytesOf = (data) => Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));

/** An array that the page holds as base64. */
const decode = ({ type, data }) => new ARRAYS[type](bytesOf(data).buffer);

function readModel(text) {
  const data = JSON.parse(text);
  const { low, step } = data.grid;
  const steps = decode(data.positions);
  const vertexCount = steps.length / 3;
  const most = [0, 1, 2].map((k) => steps.reduce((most, s, i) => (i % 3 === k ? Math.max(most, s) : most), 0));
  const centre = low.map((x, k) => x + (step * most[k]) / 2);
  const radius = (step * norm(most)) / 2 || 1;
  const positions = Float32Array.from(steps, (s, i) => (low[i % 3] + step * s - centre[i % 3]) / radius);
  const corners = decode(data.corners);
  const copies = data.copies && decode(data.copies);
  const triangles = copies ? Uint32Array.from(corners, (c) => copies[c]) : Uint32Array.from(corners);
  return {
    name: data.name,
    radius,
    diagonal: step * norm(most),
    place: (p) => scale(sub(p, centre), 1 / radius),
    positions,
    vertexCount,
    triangles,
    given: data.given ? Uint32Array.from(decode(data.given)) : triangles,
    isRefined: Boolean(data.given),
    features: { edges: decode(data.features), missed: decode(data.missed) },
    guides: data.guides && readLines(data.guides),
    field: data.field && { ...data.field, angles: decode(data.field.angles) },
    map: data.map && readMap(data.map, corners),
    quads: data.quads && readQuads(data.quads),
    layout: data.layout && readLayout(data.layout),
    changes: data.changes.map((change) => ({
      ...change,
      vertices: decode(change.vertices),
      triangles: decode(change.triangles),
    })),
  };
}

function readMap({ low, step, steps, folded }, corners) {
  const at = decode(steps);
  const uvs = new Float32Array(2 * corners.length);
  corners.forEach((c, i) => {
    uvs[2 * i] = low[0] + step * at[2 * c];
    uvs[2 * i + 1] = low[1] + step * at[2 * c + 1];
  });
  return { uvs, folded };
}

function readQuads({ positions, corners, others, distances }) {
  const at = decode(positions);
  const vertices = Array.from({ length: at.length / 3 }, (_, v) => vectorOf(at, v));
  const flat = decode(corners);
  const quads = Array.from({ length: flat.length / 4 }, (_, q) => [...flat.subarray(4 * q, 4 * q + 4)]);
  const faces = [...quads, ...others];
  return { vertices, quads, others, faces, irregular: irregularOf(vertices.length, faces), distances: decode(distances) };
}

function readLines({ sides, positions }) {
  const all = decode(positions);
  let start = 0;
  return Array.from(decode(sides), (count) => {
    const line = Array.from({ length: count + 1 }, (_, k) => vectorOf(all, start + k));
    start += count + 1;
    return line;
  });
}

function readLayout({ patches, edges, vertices }) {
  const all = decode(vertices);
  let start = 0;
  const arcs = Array.from(decode(edges), (count) => [...all.subarray(start, (start += count + 1))]);
  return { patches: decode(patches), arcs };
}

/** The vertices with other than four edges, three on the boundary, and the steps of their index. */
function irregularOf(vertexCount, faces) {
  const edges = new Map();
  for (const face of faces) face.forEach((v, k) => {
    const w = face[(k + 1) % face.length];
    const key = Math.min(v, w) * vertexCount + Math.max(v, w);
    edges.set(key, (edges.get(key) ?? 0) + 1);
  });
  const valence = new Uint32Array(vertexCount), isBoundary = new Uint8Array(vertexCount);
  for (const [key, sides] of edges) for (const v of [key % vertexCount, Math.floor(key / vertexCount)]) {
    ++valence[v];
    if (sides === 1) isBoundary[v] = 1;
  }
  const steps = Array.from(valence, (edges, v) => [v, 4 - isBoundary[v] - edges]);
  return steps.filter(([, steps]) => steps !== 0);
}

/** The quads as the text of an OBJ file, with the coordinates that the program found. */
function objText({ vertices, faces }) {
  const rows = vertices.map((p) => `v ${p.join(" ")}`);
  for (const face of faces) rows.push(`f ${face.map((v) => v + 1).join(" ")}`);
  return `${rows.join("\n")}\n`;
}
