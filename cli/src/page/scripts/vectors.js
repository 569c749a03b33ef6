// Vectors as arrays of three numbers.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => scale(a, 1 / (norm(a) || 1));
const vectorOf = (array, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]];
const meanOf = (points) => scale(points.reduce(add), 1 / points.length);

/** The normal of a polygon, as long as twice its area. */
function areaOf(points) {
  const middle = meanOf(points);
  const at = points.map((p) => sub(p, middle));
  return at.reduce((sum, p, k) => add(sum, cross(p, at[(k + 1) % at.length])), [0, 0, 0]);
}
