// The controls beside the view.

const element = (id) => document.getElementById(id);
const thousands = (count) => count.toLocaleString("en");

function make(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** The layers that a page has: name, title, count, and whether there is anything to see. */
function layersOf({ triangles, given, isRefined, features, guides, field, map, quads, layout, changes }) {
  const count = (n, noun) => `${thousands(n)} ${noun}${n === 1 ? "" : "s"}`;
  const edges = features.edges.length / 2, missed = features.missed.length / 2;
  const layers = [
    ["input", "Input", count((isRefined ? given : triangles).length / 3, "triangle")],
    ["triangles", "Triangles", isRefined ? "of the file" : ""],
  ];
  if (edges) layers.push(["features", "Features", missed ? `${count(edges, "edge")}, ${missed} missed` : count(edges, "edge")]);
  if (guides) layers.push(["guides", "Guide curves", thousands(guides.length)]);
  if (field) {
    layers.push(["field", "Field", field.symmetry === 4 ? "crosses" : `${field.symmetry} arms`]);
    layers.push(["irregular", "Irregular vertices of the field", thousands(field.irregular.length)]);
  }
  if (map) layers.push(["integers", "Integer lines", map.folded.length ? `${thousands(map.folded.length)} folded` : "no folds"]);
  if (quads) {
    layers.push(["quads", "Quads", thousands(quads.quads.length)]);
    layers.push(["poles", "Irregular vertices of the quads", thousands(quads.irregular.length)]);
  }
  if (layout) {
    layers.push(["arcs", "Arcs of the layout", thousands(layout.arcs.length)]);
    layers.push(["numbers", "Edges of quads along arcs", ""]);
  }
  if (changes.length) layers.push(["changes", "Repair", count(changes.length, "kind") + " of change"]);
  return layers;
}

const KINDS = { quad: "quad", corner: "quad vertex", triangle: "triangle", vertex: "vertex" };

/** What each button shows. */
function presetsOf({ field, map, quads, layout }) {
  const presets = [["Input", ["input", "triangles", "features", "changes"]]];
  if (field) presets.unshift(["Field", ["input", "features", "guides", "field", "irregular"]]);
  if (map) presets.unshift(["Map", ["input", "features", "integers", "irregular"]]);
  if (quads) presets.unshift(["Quads", ["quads", "features", "poles"]]);
  if (layout) presets.unshift(["Layout", ["quads", "features", "poles", "arcs", "numbers"]]);
  return presets;
}

class Panel {
  constructor(view, model) {
    Object.assign(this, { view, model });
    this.boxes = {};
    this.measures = model.quads ? measuresOf(model) : [];
    this.picker = new Picker(view, this.measures);
    this.addLayers();
    this.addPresets();
    this.addTools();
    this.addColouring();
    this.addFinding();
    this.select(null);
    listen(view, (place) => this.select(this.picker.at(place)));
  }

  addLayers() {
    for (const [name, title, count] of layersOf(this.model)) {
      const box = make("input", { type: "checkbox", id: `layer-${name}` });
      box.addEventListener("change", () => this.showLayers());
      this.boxes[name] = box;
      element("layers").append(make("label", { className: "layer" }, box, title, make("span", {}, count)));
      if (name === "irregular") element("layers").append(this.indices(name, this.model.field));
      if (name === "poles") element("layers").append(this.indices(name, { ...this.model.quads, symmetry: 4 }));
      if (name === "changes") element("layers").append(this.changes());
    }
  }

  /** How many irregular vertices have which index, by integers. */
  indices(layer, { irregular, symmetry }) {
    const kinds = [
      [`+1/${symmetry}`, "positive", (k) => k === 1], [`−1/${symmetry}`, "negative", (k) => k === -1],
      ["others", "other", (k) => Math.abs(k) !== 1],
    ];
    const note = make("div", { className: "note", id: `indices-${layer}` });
    for (const [name, colour, isOne] of kinds) {
      const count = irregular.filter(([, steps]) => isOne(steps)).length;
      if (!count) continue;
      const dot = make("i");
      dot.style.background = `var(--${colour})`;
      note.append(make("span", {}, dot, `${name}: ${thousands(count)}`));
    }
    return note;
  }

  changes() {
    const note = make("div", { className: "note" });
    for (const change of this.model.changes) {
      const isMarked = change.vertices.length + change.triangles.length > 0;
      const box = make("input", { type: "checkbox", checked: change.isShown, disabled: !isMarked });
      box.addEventListener("change", () => {
        change.isShown = box.checked;
        this.view.showChanges();
      });
      note.append(make("label", {}, box, change.name));
    }
    return note;
  }

  addPresets() {
    this.presets = presetsOf(this.model).map(([title, layers]) => {
      const button = make("button", { type: "button", textContent: title });
      button.addEventListener("click", () => this.show(layers));
      element("presets").append(button);
      return { button, layers };
    });
    this.show(this.presets[0].layers);
  }

  show(layers) {
    for (const [name, box] of Object.entries(this.boxes)) box.checked = layers.includes(name);
    this.showLayers();
  }

  showLayers() {
    for (const [name, box] of Object.entries(this.boxes)) this.view.layers[name] = box.checked;
    for (const { button, layers } of this.presets) {
      const isThis = Object.entries(this.boxes).every(([name, box]) => box.checked === layers.includes(name));
      button.setAttribute("aria-pressed", String(isThis));
    }
    this.view.redraw();
  }

  addTools() {
    const { view, model } = this;
    element("reset").addEventListener("click", () => {
      view.reset();
      this.select(null);
    });
    element("wireframe").addEventListener("click", (event) => {
      view.isWireframe = !view.isWireframe;
      event.currentTarget.setAttribute("aria-pressed", String(view.isWireframe));
      view.redraw();
    });
    const save = (name, type, content) => {
      const blob = new Blob([content], { type });
      const link = make("a", { href: URL.createObjectURL(blob), download: name });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    };
    element("screenshot").addEventListener("click", () => save(`${model.name}.png`, "image/png", view.picture()));
    element("download").hidden = !model.quads;
    element("download").addEventListener("click", () =>
      save(`${model.name}-quads.obj`, "model/obj", objText(model.quads)));
  }

  addColouring() {
    if (!this.measures.length) return;
    element("colouring").hidden = false;
    const names = [...this.measures.map(({ name }) => name), "One colour"];
    element("measure").append(...names.map((name) => make("option", { textContent: name })));
    element("measure").addEventListener("change", () => this.colour());
    element("fit").addEventListener("change", () => this.colour());
    element("worst").addEventListener("click", () => {
      if (!this.measure?.values.length) return;
      if (!this.boxes.quads.checked) this.show(this.presets[0].layers);
      this.goTo({ kind: "quad", number: worstOf(this.measure) });
    });
    this.colour();
  }

  colour() {
    this.measure = this.measures[element("measure").selectedIndex];
    const hasRange = Boolean(this.measure?.range);
    document.querySelector(".chart").hidden = !hasRange;
    for (const id of ["statistics", "worst"]) element(id).hidden = !hasRange;
    element("fit").parentElement.hidden = !hasRange;
    if (!this.measure) return this.view.colour(() => COLOURS.plain);
    if (this.measure.isKind) return this.view.colour((q) => colourOfKind(this.measure.values[q]));
    const { values, isTwoSided } = this.measure;
    this.range = element("fit").checked ? fitted(this.measure) : this.measure.range;
    const stops = stopsOf(this.measure);
    this.view.colour((q) => colourAt(stops, positionIn(this.range, values[q], isTwoSided)));
    drawChart(this.measure, this.range);
    this.markSelection();
  }

  addFinding() {
    const kinds = ["quad", "corner", "triangle", "vertex"].filter((kind) => this.picker.count(kind));
    element("kind").append(...kinds.map((kind) => make("option", { value: kind, textContent: KINDS[kind] })));
    element("find").addEventListener("submit", (event) => {
      event.preventDefault();
      const kind = element("kind").value, number = element("number").valueAsNumber;
      if (Number.isInteger(number) && number >= 0 && number < this.picker.count(kind)) this.goTo({ kind, number });
      else element("selection").textContent = `There are ${thousands(this.picker.count(kind))}, counted from 0.`;
    });
  }

  goTo(chosen) {
    this.select(chosen);
    const points = this.picker.points(chosen);
    const middle = meanOf(points);
    const directions = directionsAround(this.picker.outside(chosen));
    const isFree = (direction) => {
      this.view.camera.lookAt(middle, direction);
      return this.picker.isInSight(chosen);
    };
    if (!directions.some(isFree)) this.view.camera.lookAt(middle, directions[0]);
    const size = Math.max(...points.map((p) => norm(sub(p, middle))), 0.02);
    this.view.camera.zoom = Math.min(0.14 / size, 40);
    this.view.redraw();
  }

  select(chosen) {
    this.chosen = chosen;
    const rows = chosen ? this.picker.rows(chosen) : [];
    const cells = rows.map(([name, value]) => make("tr", {}, make("td", {}, name), make("td", {}, value)));
    element("selection").replaceChildren(chosen ? make("table", {}, ...cells) : "Click an element of the mesh.");
    this.view.outline(chosen ? this.picker.around(chosen) : []);
    this.markSelection();
  }

  markSelection() {
    if (!this.measure?.range) return;
    const value = this.chosen?.kind === "quad" ? this.measure.values[this.chosen.number] : undefined;
    markChart(this.measure, this.range, value);
  }
}
