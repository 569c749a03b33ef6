// The view: what is drawn, in which order, and what is under a pixel.

/** Crosses on the screen are at least so far apart, in pixels of the page. */
const APART = 15;

class View {
  constructor(canvas, model) {
    this.canvas = canvas;
    this.model = model;
    this.camera = new Camera();
    this.layers = {};
    this.isWireframe = false;
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("The mesh cannot be drawn: this browser has no WebGL 2, or hardware acceleration is off. All figures are below.");
    this.gl = gl;
    this.shaders = {
      surface: build(gl, SURFACE), lines: build(gl, LINES), crosses: build(gl, CROSSES), balls: build(gl, BALLS),
      digits: build(gl, DIGITS),
    };
    this.makeBatches();
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    // At once, before the page is painted with a picture of another size.
    new ResizeObserver(() => this.drawPage()).observe(canvas);
  }

  makeBatches() {
    const { gl, model, shaders } = this;
    const at = (v) => vectorOf(model.positions, v);
    const pairs = ({ length }, vertex) => Array.from({ length: length / 2 }, (_, e) => [at(vertex(2 * e)), at(vertex(2 * e + 1))]);
    this.surface = surfaceBatch(gl, shaders.surface, model);
    if (model.isRefined) {
      const edges = [];
      model.given.forEach((v, i) => {
        const w = model.given[i % 3 === 2 ? i - 2 : i + 1];
        edges.push([at(v), at(w)]);
      });
      this.given = segments(gl, shaders.lines, edges);
    }
    this.features = ["edges", "missed"].map((kind) => {
      const list = model.features[kind];
      return segments(gl, shaders.lines, pairs(list, (i) => list[i]));
    });
    const irregular = (list, at) =>
      balls(gl, shaders.balls, list.map(([v]) => at(v)), list.map(([, steps]) => colourOfIndex(steps)));
    if (model.field) this.irregular = irregular(model.field.irregular, at);
    if (model.quads) {
      const place = (v) => model.place(model.quads.vertices[v]);
      this.quads = quadsBatch(gl, shaders.surface, model);
      this.poles = irregular(model.quads.irregular, place);
      const rims = model.quads.others.flatMap((face) => face.map((v, k) => [place(v), place(face[(k + 1) % face.length])]));
      this.others = segments(gl, shaders.lines, rims);
    }
    const guides = (model.guides ?? []).map((line) => line.map(model.place));
    this.guides = segments(gl, shaders.lines, guides.flatMap((line) => line.slice(1).map((p, k) => [line[k], p])));
    if (model.layout) this.makeLayout();
    this.showChanges();
  }

  makeLayout() {
    const { gl, model, shaders } = this;
    const { vertices, faces } = model.quads;
    const at = vertices.map(model.place);
    const normals = vertices.map(() => [0, 0, 0]);
    for (const face of faces) {
      const area = areaOf(face.map((v) => at[v]));
      for (const v of face) normals[v] = add(normals[v], area);
    }
    const { arcs } = model.layout;
    this.arcs = segments(gl, shaders.lines, arcs.flatMap((arc) => arc.slice(1).map((v, k) => [at[arc[k]], at[v]])));
    this.glyphs = digitTexture(gl);
    this.numbers = numbersBatch(gl, shaders.digits, arcLabels(arcs, at, normals));
  }

  /** Marks what the changes that are shown have changed. */
  showChanges() {
    const { gl, model } = this;
    const shown = model.changes.filter((change) => change.isShown);
    this.surface.put("mark", marksOf(model, shown));
    const vertices = [...new Set(shown.flatMap((change) => [...change.vertices]))];
    const points = vertices.map((v) => vectorOf(model.positions, v));
    this.changed = balls(gl, this.shaders.balls, points, points.map(() => COLOURS.repaired));
    this.redraw();
  }

  /** Colours the quads by a function of their number. */
  colour(colourOf) {
    const { batch, owner } = this.quads;
    batch.put("tint", quadTints(owner, this.model.quads.quads.length, colourOf));
    this.redraw();
  }

  /** Outlines polygons. */
  outline(polygons) {
    const sides = polygons.flatMap((points) => points.map((p, k) => [p, points[(k + 1) % points.length]]));
    this.selected = segments(this.gl, this.shaders.lines, sides);
    this.redraw();
  }

  redraw() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.drawPage();
    });
  }

  drawPage() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight) return;
    if (!this.hasFitted) this.fit(clientWidth, clientHeight);
    this.draw(clientWidth, clientHeight, window.devicePixelRatio || 1);
  }

  /** Zooms so that the mesh fills the canvas. */
  fit(width, height) {
    const { positions, vertexCount } = this.model;
    let [x, y] = [1e-9, 1e-9];
    for (let v = 0; v < vertexCount; ++v) {
      const seen = this.camera.see(vectorOf(positions, v));
      x = Math.max(x, Math.abs(seen[0]));
      y = Math.max(y, Math.abs(seen[1]));
    }
    this.camera.zoom = (0.92 * Math.min(width / x, height / y)) / Math.min(width, height);
    this.hasFitted = true;
  }

  reset() {
    this.camera.reset();
    this.hasFitted = false;
    this.redraw();
  }

  /** Pixels of the page for a length of 1. */
  pixelsPerUnit(width, height) {
    return 0.5 * Math.min(width, height) * this.camera.zoom;
  }

  draw(width, height, ratio) {
    const { gl, canvas, camera } = this;
    const [w, h] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const unitPixels = this.pixelsPerUnit(width, height);
    this.shared = {
      turn: camera.matrix(), target: camera.target, viewport: [w, h],
      scale: [(2 * unitPixels) / width, (2 * unitPixels) / height],
    };
    this.ratio = ratio;
    this.unitPixels = unitPixels;
    this.drawFaces();
    this.drawLines();
    this.drawBalls();
    if (this.layers.numbers) this.drawNumbers();
    if (this.layers.quads && this.layers.input && !this.isWireframe) this.drawSurface(0.35);
  }

  /** The colour of lines: dark on faces, and what the page has for ink where there are none. */
  ink() {
    const isDark = window.matchMedia("(prefers-color-scheme: dark)").matches;
    return isDark && (this.isWireframe || !(this.layers.input || this.layers.quads)) ? COLOURS.chalk : COLOURS.ink;
  }

  drawFaces() {
    const { layers, isWireframe } = this;
    const fill = isWireframe ? 0 : 1;
    if (layers.quads) {
      this.quads.batch.draw({
        ...this.shared, lift: 0, fill, shading: 0.55, inside: COLOURS.inside,
        gridColour: [...this.ink(), isWireframe ? 0.9 : 0.8], gridWidth: 1.25 * this.ratio, edgeColour: [0, 0, 0, 0],
        edgeWidth: 1, marks: [0, 0, 0, 0, 0, 0, 0, 0],
      });
    }
    if (layers.input && !layers.quads) this.drawSurface(fill);
    else if (layers.integers || layers.triangles || layers.changes || (layers.input && isWireframe)) this.drawSurface(0);
  }

  drawSurface(fill) {
    const { layers, ratio, gl, model, isWireframe } = this;
    const isOver = fill > 0 && fill < 1;
    const hasEdges = !isOver && !model.isRefined && (layers.triangles || (isWireframe && layers.input && !layers.quads));
    if (isOver) gl.depthMask(false);
    this.surface.draw({
      ...this.shared, lift: fill === 1 ? 0 : 0.002, fill, shading: 1, inside: COLOURS.inside,
      gridColour: [...(isWireframe ? this.ink() : COLOURS.integer), layers.integers ? 1 : 0], gridWidth: 1.7 * ratio,
      edgeColour: [...this.ink(), hasEdges ? 0.5 : 0], edgeWidth: 0.9 * ratio,
      marks: [
        ...COLOURS.folded, layers.integers ? 1 : 0, ...COLOURS.repaired, layers.changes ? 1 : 0,
      ],
    });
    gl.depthMask(true);
  }

  drawLines() {
    const { layers, ratio } = this;
    const line = (batch, colour, width, lift, alpha = 1) =>
      batch?.draw({ ...this.shared, lift, width: width * ratio, paint: [...colour, alpha] });
    if (layers.triangles) line(this.given, this.ink(), 0.9, 0.0015, 0.6);
    if (layers.quads) line(this.others, this.ink(), 1.25, 0.001);
    if (layers.features) {
      line(this.features[0], this.ink() === COLOURS.chalk ? COLOURS.chalk : COLOURS.feature, 2.4, 0.003);
      line(this.features[1], COLOURS.missed, 4, 0.005);
    }
    if (layers.guides) line(this.guides, COLOURS.guide, 3.2, 0.003);
    if (layers.arcs) line(this.arcs, this.ink() === COLOURS.chalk ? COLOURS.chalk : COLOURS.arc, 3.2, 0.003);
    if (layers.field) this.drawCrosses();
    line(this.selected, COLOURS.selected, 4, 0.0035);
  }

  drawNumbers() {
    this.gl.bindTexture(this.gl.TEXTURE_2D, this.glyphs);
    this.numbers.draw({
      ...this.shared, lift: Math.min(0.03, 9 / this.unitPixels) + 0.006, size: DIGIT.map((x) => x * this.ratio),
      unit: this.unitPixels * this.ratio,
    });
  }

  drawCrosses() {
    this.crosses ??= crossesBatch(this.gl, this.shaders.crosses, this.model);
    const { batch, finest, isTwoSided } = this.crosses;
    // Nearer still, where every face has its cross, crosses grow with their faces.
    const level = Math.min(levelFor(APART / this.unitPixels), finest);
    const extent = 0.37 * spacingOf(level);
    const isBare = this.ink() === COLOURS.chalk;
    batch.draw({
      ...this.shared, lift: Math.min(0.004, 0.2 * extent), width: 1.4 * this.ratio, extent,
      finest: level, bounded: level >= finest ? 1 : 0,
      both: isTwoSided ? 1 : 0, paint: [...(isBare ? COLOURS.chalk : COLOURS.cross), 1],
    });
  }

  /** The diameter of balls in pixels of the page: smaller where there are many, larger near by. */
  ballSize() {
    const { field, quads } = this.model;
    const count = Math.max(field?.irregular.length ?? 0, quads?.irregular.length ?? 0);
    const far = count > 400 ? 6.5 : count > 150 ? 8 : 10.5;
    return Math.min(18, far * Math.max(1, this.camera.zoom) ** 0.3);
  }

  drawBalls() {
    const { layers, ratio } = this;
    const size = this.ballSize();
    const ball = (batch, size, lift) => batch?.draw({ ...this.shared, lift, size: size * ratio });
    if (layers.changes) ball(this.changed, 0.7 * size, 0.006);
    const lift = Math.min(0.012, (0.3 * size) / this.unitPixels) + 0.004;
    if (layers.irregular) ball(this.irregular, size, lift);
    if (layers.poles) ball(this.poles, size, lift);
  }

  /** Where a point is on the canvas, in pixels of the page from its upper left corner, and how near. */
  onScreen(p) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const [x, y, z] = this.camera.see(p);
    const unitPixels = this.pixelsPerUnit(width, height);
    return [width / 2 + unitPixels * x, height / 2 - unitPixels * y, z];
  }

  /** A picture of the view as a PNG file, twice as fine as the screen. */
  picture() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.draw(width, height, 2 * (window.devicePixelRatio || 1));
    const [, data] = this.canvas.toDataURL("image/png").split(",");
    this.redraw();
    return bytesOf(data);
  }
}
