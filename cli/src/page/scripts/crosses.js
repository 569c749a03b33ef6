// Crosses of a field, in levels: each level has those for which it has room.

/** The distance of crosses of the first level. */
const COARSEST = 0.2;
const spacingOf = (level) => COARSEST * Math.SQRT1_2 ** level;
/** The finest level that is at least so far apart. */
const levelFor = (apart) => Math.max(0, Math.floor(2 * Math.log2(COARSEST / apart)));

/**
 * A level for every point, so that those up to a level are about `spacingOf(level)` apart. The last level has
 * all that are left.
 */
function levelsOf(points, finest) {
  const levels = new Float32Array(points.length);
  let left = points.map((_, i) => i), taken = [];
  for (let level = 0; left.length; ++level) {
    const apart = spacingOf(level);
    if (apart < finest) {
      for (const i of left) levels[i] = level;
      break;
    }
    const cells = new Map();
    const side = Math.ceil(4 / apart);
    const cellOf = (p) => p.map((x) => Math.floor((x + 2) / apart));
    const put = (i) => {
      const [x, y, z] = cellOf(points[i]);
      const key = (z * side + y) * side + x;
      cells.has(key) ? cells.get(key).push(i) : cells.set(key, [i]);
    };
    const isFree = (p) => {
      const [x, y, z] = cellOf(p);
      for (let k = z - 1; k <= z + 1; ++k) for (let j = y - 1; j <= y + 1; ++j) for (let i = x - 1; i <= x + 1; ++i) {
        for (const other of cells.get((k * side + j) * side + i) ?? []) {
          if (norm(sub(points[other], p)) < 0.9 * apart) return false;
        }
      }
      return true;
    };
    taken.forEach(put);
    const rest = [];
    for (const i of left) {
      if (!isFree(points[i])) { rest.push(i); continue; }
      levels[i] = level;
      taken.push(i);
      put(i);
    }
    left = rest;
  }
  return levels;
}

/** The arms of a field, one for each line or ray of every face. */
function crossesBatch(gl, shader, { positions, triangles, field }) {
  const { symmetry, angles } = field;
  const count = triangles.length / 3;
  // Opposite arms are one line.
  const rays = symmetry % 2 === 0 ? symmetry / 2 : symmetry;
  const centres = [], frames = [], limits = [];
  let area = 0;
  for (let f = 0; f < count; ++f) {
    const [a, b, c] = [0, 1, 2].map((k) => vectorOf(positions, triangles[3 * f + k]));
    const normal = cross(sub(b, a), sub(c, a));
    const x = unit(sub(b, a));
    centres.push(meanOf([a, b, c]));
    frames.push([x, cross(unit(normal), x)]);
    limits.push(0.42 * Math.sqrt(norm(normal)));
    area += norm(normal) / 2;
  }
  const levels = levelsOf(centres, Math.sqrt(area / count));
  const finest = levels.reduce((a, b) => Math.max(a, b), 0);
  const centre = new Float32Array(3 * rays * count), arm = new Float32Array(3 * rays * count);
  const level = new Float32Array(rays * count), limit = new Float32Array(rays * count);
  for (let f = 0; f < count; ++f) for (let k = 0; k < rays; ++k) {
    const at = rays * f + k;
    const turn = ((2 * Math.PI) / symmetry) * (k + angles[f] / 256);
    centre.set(centres[f], 3 * at);
    arm.set(add(scale(frames[f][0], Math.cos(turn)), scale(frames[f][1], Math.sin(turn))), 3 * at);
    level[at] = levels[f];
    limit[at] = limits[f];
  }
  const attributes = { centre: [centre, 3], arm: [arm, 3], level: [level, 1], limit: [limit, 1] };
  const batch = new Batch(gl, shader, gl.TRIANGLE_STRIP, level.length, attributes, { instances: level.length });
  return { batch, finest, isTwoSided: symmetry % 2 === 0 };
}
