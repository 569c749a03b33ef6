// What quads are coloured by. All measures are those of the program's figures.

/** The interior angles of a quad in degrees. */
function anglesOf(corners) {
  return corners.map((p, k) => {
    const next = sub(corners[(k + 1) % 4], p), last = sub(corners[(k + 3) % 4], p);
    return (Math.atan2(norm(cross(next, last)), dot(next, last)) * 180) / Math.PI;
  });
}

/** The least sine of an angle, signed about the cross product of the diagonals. */
function scaledJacobian(corners) {
  const [a, b, c, d] = corners;
  const normal = unit(cross(sub(c, a), sub(d, b)));
  const sines = corners.map((p, k) =>
    dot(cross(unit(sub(corners[(k + 1) % 4], p)), unit(sub(corners[(k + 3) % 4], p))), normal));
  return Math.min(...sines);
}

const lengthsOf = (corners) => corners.map((p, k) => norm(sub(corners[(k + 1) % 4], p)));

/** A number with three digits that matter. */
function short(x) {
  if (x === 0 || !Number.isFinite(x)) return String(x);
  const size = Math.abs(x);
  return size >= 1e6 || size < 1e-3 ? x.toExponential(2) : String(Number(x.toPrecision(size >= 1000 ? 4 : 3)));
}

/**
 * The measures: a value a quad, and the range of their colours, from good to bad, or with the mean in the
 * middle where `isTwoSided`. Values beyond the range have the colour of its end. Where `isKind`, values are numbers
 * of things, each with a colour of its own.
 */
function measuresOf(model) {
  const { quads, vertices, distances } = model.quads;
  const corners = quads.map((quad) => quad.map((v) => vertices[v]));
  const lengths = corners.map((quad) => lengthsOf(quad).reduce((a, b) => a + b) / 4);
  const mean = lengths.reduce((a, b) => a + b, 0) / (lengths.length || 1);
  const percent = Array.from(distances, (distance) => (100 * distance) / model.diagonal);
  const farthest = percent.reduce((a, b) => Math.max(a, b), 0);
  const ofLayout = model.layout
    ? [{ name: "Patch of the layout", brief: "Patch", values: [...model.layout.patches], isKind: true, text: String }]
    : [];
  const degrees = (x) => `${x.toFixed(1)}°`;
  return [
    ...ofLayout,
    { name: "Scaled Jacobian", brief: "Scaled Jacobian", values: corners.map(scaledJacobian), range: [1, 0.5], text: (x) => x.toFixed(3) },
    {
      name: "Angle: largest deviation from 90°", brief: "Deviation from 90°",
      values: corners.map((quad) => Math.max(...anglesOf(quad).map((angle) => Math.abs(angle - 90)))),
      range: [0, 30], text: degrees,
    },
    {
      name: "Edge length, relative to the mean", brief: "Edge length / mean",
      values: lengths.map((length) => length / mean),
      range: [0.5, 2], isTwoSided: true, text: (x) => x.toFixed(2),
    },
    {
      name: "Distance to input, % of the diagonal", brief: "Distance, % of diagonal", values: percent,
      // Less is noise of rounding.
      range: [0, farthest || 1], text: (x) => short(x < 1e-9 ? 0 : x),
    },
  ];
}

/** The least and the largest value, in the order of the measure's range. */
function fitted({ values, range, isTwoSided }) {
  const low = values.reduce((a, b) => Math.min(a, b), Infinity);
  const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!(low < high)) return range;
  if (isTwoSided) {
    const widest = Math.max(high, 1 / Math.max(low, 1e-9));
    return [1 / widest, widest];
  }
  return range[0] < range[1] ? [low, high] : [high, low];
}

/** Where a value is in a range, from 0 to 1. Relative measures are compared by their ratio. */
function positionIn([first, last], value, isTwoSided) {
  const f = isTwoSided ? (x) => Math.log(Math.max(x, 1e-9)) : (x) => x;
  return Math.min(1, Math.max(0, (f(value) - f(first)) / (f(last) - f(first))));
}

/** The number of the quad that is farthest from a good one. */
function worstOf({ values, range, isTwoSided }) {
  const badness = (x) => (isTwoSided ? Math.abs(Math.log(Math.max(x, 1e-9))) : (range[0] < range[1] ? x : -x));
  return values.reduce((worst, x, q) => (badness(x) > badness(values[worst]) ? q : worst), 0);
}
