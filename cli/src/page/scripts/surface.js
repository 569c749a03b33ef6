// The triangles of the mesh and the faces of the quads, corner by corner.

/** Edges at which the surface turns by more than this look sharp. */
const CREASE = Math.cos((35 * Math.PI) / 180);

/** A normal for every corner: the mean of those faces around its vertex that turn little from its own. */
function cornerNormals(positions, triangles) {
  const count = triangles.length / 3;
  const areas = new Float32Array(triangles.length), units = new Float32Array(triangles.length);
  const degree = new Uint32Array(positions.length / 3 + 1);
  for (let f = 0; f < count; ++f) {
    const [a, b, c] = [0, 1, 2].map((k) => vectorOf(positions, triangles[3 * f + k]));
    const area = cross(sub(b, a), sub(c, a));
    areas.set(area, 3 * f);
    units.set(unit(area), 3 * f);
    for (let k = 0; k < 3; ++k) ++degree[triangles[3 * f + k] + 1];
  }
  for (let v = 1; v < degree.length; ++v) degree[v] += degree[v - 1];
  const around = new Uint32Array(triangles.length), next = degree.slice();
  triangles.forEach((v, i) => { around[next[v]++] = Math.floor(i / 3); });
  const normals = new Float32Array(3 * triangles.length);
  triangles.forEach((v, i) => {
    const f = 3 * Math.floor(i / 3);
    let [x, y, z] = [0, 0, 0];
    for (let at = degree[v]; at < degree[v + 1]; ++at) {
      const g = 3 * around[at];
      const cosine = units[f] * units[g] + units[f + 1] * units[g + 1] + units[f + 2] * units[g + 2];
      if (cosine < CREASE) continue;
      x += areas[g]; y += areas[g + 1]; z += areas[g + 2];
    }
    const length = Math.hypot(x, y, z) || 1;
    normals[3 * i] = x / length; normals[3 * i + 1] = y / length; normals[3 * i + 2] = z / length;
  });
  return normals;
}

/** The bits of a face's mark. */
const FOLDED = 1, REPAIRED = 2;

/** The batch of the triangles that field and map belong to. */
function surfaceBatch(gl, shader, model) {
  const { positions, triangles, map } = model;
  const corners = triangles.length;
  const position = new Float32Array(3 * corners);
  triangles.forEach((v, i) => position.set(positions.subarray(3 * v, 3 * v + 3), 3 * i));
  const tint = new Float32Array(3 * corners);
  for (let i = 0; i < corners; ++i) tint.set(COLOURS.surface, 3 * i);
  return new Batch(gl, shader, gl.TRIANGLES, corners, {
    position: [position, 3],
    normal: [cornerNormals(positions, triangles), 3],
    grid: [map ? map.uvs : new Float32Array(2 * corners).fill(0.5), 2],
    tint: [tint, 3],
    mark: [marksOf(model, model.changes.filter((change) => change.isShown)), 1],
  });
}

/** The mark of every corner. */
function marksOf({ triangles, map }, changes) {
  const marks = new Uint8Array(triangles.length);
  const mark = (f, bit) => { for (let k = 0; k < 3; ++k) marks[3 * f + k] |= bit; };
  for (const f of map ? map.folded : []) mark(f, FOLDED);
  for (const change of changes) for (const f of change.triangles) mark(f, REPAIRED);
  return marks;
}

/** The triangles of every face, as places in its list of corners, and the grid's coordinates there. */
function trianglesOf(face) {
  const fan = [];
  for (let k = 1; k + 1 < face.length; ++k) fan.push(0, k, k + 1);
  return fan;
}
const SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]];
/** Where no line of a grid is. */
const NO_LINE = [0.5, 0.5];

/** The batch of the quads, and of what faces are not quads. */
function quadsBatch(gl, shader, model) {
  const { vertices, faces } = model.quads;
  const at = vertices.map(model.place);
  const position = [], normal = [], grid = [], owner = [];
  faces.forEach((face, q) => {
    const points = face.map((v) => at[v]);
    const n = unit(areaOf(points));
    for (const k of trianglesOf(face)) {
      position.push(...points[k]);
      normal.push(...n);
      grid.push(...(face.length === 4 ? SQUARE[k] : NO_LINE));
      owner.push(q);
    }
  });
  const batch = new Batch(gl, shader, gl.TRIANGLES, owner.length, {
    position: [new Float32Array(position), 3],
    normal: [new Float32Array(normal), 3],
    grid: [new Float32Array(grid), 2],
    tint: [new Float32Array(3 * owner.length), 3],
    mark: [new Uint8Array(owner.length), 1],
  });
  return { batch, owner };
}

/** The colour of every corner of the quads' triangles. */
function quadTints(owner, quadCount, colourOf) {
  const tint = new Float32Array(3 * owner.length);
  owner.forEach((q, i) => tint.set(q < quadCount ? colourOf(q) : COLOURS.other, 3 * i));
  return tint;
}
