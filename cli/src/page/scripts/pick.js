// What is under a pixel, and what is told of it.

/** The nearest of these faces at a place of the screen: its number and its depth. */
function faceAt(view, places, faces, [x, y]) {
  const seen = places.map((p) => view.onScreen(p));
  let best = null;
  faces.forEach((face, number) => {
    for (let k = 1; k + 1 < face.length; ++k) {
      const depth = depthIn(seen[face[0]], seen[face[k]], seen[face[k + 1]], x, y);
      if (depth !== null && (!best || depth > best.depth)) best = { number, depth };
    }
  });
  return best;
}

/** The depth of a triangle on the screen at a place, or null. */
function depthIn(a, b, c, x, y) {
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (area === 0) return null;
  const s = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
  const t = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
  return s < 0 || t < 0 || s + t > 1 ? null : a[2] + s * (b[2] - a[2]) + t * (c[2] - a[2]);
}

/** The index of a vertex as a fraction of a turn. */
function indexText(irregular, vertex, symmetry) {
  const steps = irregular.find(([v]) => v === vertex)?.[1] ?? 0;
  return steps === 0 ? "0" : `${steps > 0 ? "+" : "−"}${Math.abs(steps)}/${symmetry}`;
}

class Picker {
  constructor(view, measures) {
    Object.assign(this, { view, model: view.model, measures });
    const { positions, vertexCount, triangles, quads } = this.model;
    this.vertices = Array.from({ length: vertexCount }, (_, v) => vectorOf(positions, v));
    this.triangles = Array.from({ length: triangles.length / 3 }, (_, f) => [...triangles.subarray(3 * f, 3 * f + 3)]);
    this.corners = quads ? quads.vertices.map(this.model.place) : [];
  }

  /** The element at a place of the canvas: an irregular vertex before faces, quads before triangles. */
  at(place) {
    const { layers } = this.view;
    const { quads, field } = this.model;
    const quad = layers.quads ? faceAt(this.view, this.corners, quads.faces, place) : null;
    const triangle = quad ? null : faceAt(this.view, this.vertices, this.triangles, place);
    const corner = layers.poles ? this.irregularAt(quads.irregular, this.corners, place, quad ?? triangle) : null;
    if (corner !== null) return { kind: "corner", number: corner };
    const vertex = layers.irregular ? this.irregularAt(field.irregular, this.vertices, place, quad ?? triangle) : null;
    if (vertex !== null) return { kind: "vertex", number: vertex };
    if (quad) return { kind: "quad", number: quad.number };
    return triangle && { kind: "triangle", number: triangle.number };
  }

  irregularAt(irregular, places, [x, y], hit) {
    const size = this.view.ballSize();
    let best = null, least = 0.5 * size + 3;
    for (const [v] of irregular) {
      const [a, b, depth] = this.view.onScreen(places[v]);
      const away = Math.hypot(a - x, b - y);
      const isHidden = hit && depth < hit.depth - Math.max(0.03, (2 * size) / this.view.unitPixels);
      if (away <= least && !isHidden) [best, least] = [v, away];
    }
    return best;
  }

  /** How many elements of a kind there are. */
  count(kind) {
    return {
      quad: this.model.quads?.faces.length ?? 0, corner: this.corners.length,
      triangle: this.triangles.length, vertex: this.model.vertexCount,
    }[kind];
  }

  /** Where an element is: the corners of a face, or a vertex alone. */
  points({ kind, number }) {
    if (kind === "vertex") return [this.vertices[number]];
    if (kind === "corner") return [this.corners[number]];
    return this.around({ kind, number })[0];
  }

  /** The corners of a face, or of all faces at a vertex. */
  around({ kind, number }) {
    const isOfQuads = kind === "quad" || kind === "corner";
    const [faces, places] = isOfQuads ? [this.model.quads.faces, this.corners] : [this.triangles, this.vertices];
    const isFace = kind === "quad" || kind === "triangle";
    const chosen = isFace ? [faces[number]] : faces.filter((face) => face.includes(number));
    return chosen.map((face) => face.map((v) => places[v]));
  }

  /** Where to look at an element from. */
  outside(chosen) {
    return this.around(chosen).map(areaOf).reduce(add, [0, 0, 0]);
  }

  /** Whether nothing hides an element that is in the middle of the canvas. */
  isInSight({ kind, number }) {
    const { clientWidth, clientHeight } = this.view.canvas;
    const isOfQuads = kind === "quad" || kind === "corner";
    const [faces, places] = isOfQuads ? [this.model.quads.faces, this.corners] : [this.triangles, this.vertices];
    const hit = faceAt(this.view, places, faces, [clientWidth / 2, clientHeight / 2]);
    if (kind === "quad" || kind === "triangle") return hit?.number === number;
    return !hit || faces[hit.number].includes(number);
  }

  /** Rows of a name and a text. */
  rows({ kind, number }) {
    if (kind === "quad") return this.quadRows(number);
    if (kind === "corner") return this.cornerRows(number);
    return kind === "triangle" ? this.triangleRows(number) : this.vertexRows(number);
  }

  quadRows(number) {
    const { quads, vertices, faces } = this.model.quads;
    const face = faces[number];
    if (number >= quads.length) return [["Face, not a quad", `${number}`], ["Vertices", face.join(", ")]];
    const corners = face.map((v) => vertices[v]);
    const rows = [["Quad", `${number}`], ["Vertices", face.join(", ")]];
    for (const { brief, values, text } of this.measures) rows.push([brief, text(values[number])]);
    rows.push(["Angles", anglesOf(corners).map((angle) => `${angle.toFixed(1)}°`).join(", ")]);
    rows.push(["Edges", lengthsOf(corners).map(short).join(", ")]);
    return rows;
  }

  triangleRows(number) {
    const { field, map, radius, isRefined } = this.model;
    const corners = this.points({ kind: "triangle", number });
    const [a, b, c] = corners;
    const rows = [
      [isRefined ? "Triangle, refined" : "Triangle", `${number}`],
      ["Vertices", this.triangles[number].join(", ")],
      ["Area", short((norm(cross(sub(b, a), sub(c, a))) / 2) * radius * radius)],
    ];
    if (field) rows.push(["Field, from the first edge", `${((field.angles[number] / 256) * (360 / field.symmetry)).toFixed(1)}°`]);
    if (map) {
      const uv = (k) => [0, 1].map((i) => map.uvs[6 * number + 2 * k + i].toFixed(2)).join(", ");
      rows.push(["Map at the corners", [0, 1, 2].map((k) => `(${uv(k)})`).join(" ")]);
      rows.push(["Folded by the map", map.folded.includes(number) ? "yes" : "no"]);
    }
    for (const { name, triangles } of this.model.changes) if (triangles.includes(number)) rows.push(["Repair", name]);
    return rows;
  }

  cornerRows(number) {
    const { faces, irregular, vertices } = this.model.quads;
    return [
      ["Vertex of quads", `${number}`],
      ["Place", vertices[number].map(short).join(", ")],
      ["Quads", faces.flatMap((face, q) => (face.includes(number) ? [q] : [])).join(", ")],
      ["Index", indexText(irregular, number, 4)],
    ];
  }

  vertexRows(number) {
    const { field, changes } = this.model;
    const rows = [["Vertex of triangles", `${number}`]];
    if (field) rows.push(["Index of the field", indexText(field.irregular, number, field.symmetry)]);
    for (const change of changes) if (change.vertices.includes(number)) rows.push(["Repair", change.name]);
    return rows;
  }
}
