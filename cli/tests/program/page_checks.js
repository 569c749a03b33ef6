// Uses the page as people do, and leaves what it finds in the document for the test.

const { view, panel, model } = window.roundel;
const get = (id) => document.getElementById(id);
// Events of a script have no pointer that could be captured.
view.canvas.setPointerCapture = () => {};

function pixels() {
  view.drawPage();
  const { gl, canvas } = view;
  const data = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  return data;
}

function differing(a, b) {
  let count = 0;
  for (let i = 0; i < a.length; i += 4) {
    if (a[i] !== b[i] || a[i + 1] !== b[i + 1] || a[i + 2] !== b[i + 2] || a[i + 3] !== b[i + 3]) ++count;
  }
  return count;
}

/** Whether the colour at the middle of the canvas is mostly red, mostly blue or something else. */
function hueInTheMiddle() {
  const { gl, canvas } = view;
  const data = new Uint8Array(4);
  view.drawPage();
  gl.readPixels(Math.floor(canvas.width / 2), Math.floor(canvas.height / 2), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const [r, g, b] = data;
  if (r > 1.7 * g && r > 1.7 * b) return "red";
  return b > 1.5 * r && b > 1.5 * g ? "blue" : `other ${r} ${g} ${b}`;
}

function click([x, y]) {
  const { left, top } = view.canvas.getBoundingClientRect();
  const at = { pointerId: 1, button: 0, clientX: left + x, clientY: top + y };
  view.canvas.dispatchEvent(new PointerEvent("pointerdown", at));
  view.canvas.dispatchEvent(new PointerEvent("pointerup", at));
}

const middle = () => [view.canvas.clientWidth / 2, view.canvas.clientHeight / 2];
const shown = () => [...document.querySelectorAll("#selection tr")].map((row) => [...row.cells].map((cell) => cell.textContent));

/** Pixels that each layer draws by itself. */
function layers() {
  const boxes = [...document.querySelectorAll("#layers .layer input")];
  const toggle = (box, on) => { if (box.checked !== on) box.click(); };
  boxes.forEach((box) => toggle(box, false));
  const empty = pixels();
  const drawn = {};
  for (const box of boxes) {
    toggle(box, true);
    drawn[box.id] = differing(pixels(), empty);
    toggle(box, false);
  }
  return { nothing: empty.filter((x) => x > 0).length, drawn };
}

/** The colours that irregular vertices have on the screen. */
function hues(kind, layer, irregular) {
  panel.show([layer === "poles" ? "quads" : "input", layer]);
  // One pixel counts: a small canvas is drawn faster.
  view.canvas.style.cssText = "width: 160px; height: 120px";
  const hues = irregular.map(([number]) => {
    panel.goTo({ kind, number });
    panel.select(null);
    return [number, hueInTheMiddle()];
  });
  view.canvas.style.cssText = "";
  return hues;
}

/** What a click on each of these elements shows. */
function picks(kind, numbers, shows) {
  panel.show(shows);
  return numbers.map((number) => {
    panel.goTo({ kind, number });
    panel.select(null);
    const text = get("selection").textContent;
    click(middle());
    return { number, before: text, rows: shown() };
  });
}

function measures() {
  const of = (_, i) => {
    get("measure").selectedIndex = i;
    get("measure").dispatchEvent(new Event("change"));
    const bars = [...document.querySelectorAll("#histogram b")];
    return {
      statistics: get("statistics").textContent, ends: [get("low").textContent, get("high").textContent],
      counted: bars.reduce((sum, bar) => sum + Number(bar.title), 0), picture: pixels(),
    };
  };
  panel.show(["quads"]);
  const all = Array.from(get("measure").options, of);
  return all.map(({ picture, ...rest }, i) => ({ ...rest, changed: differing(picture, all[(i + 1) % all.length].picture) }));
}

/** What the buttons save: nothing is left to be waited for. */
function downloads() {
  const saved = [], names = [];
  window.Blob = function (parts) { saved.push(parts[0]); };
  URL.createObjectURL = () => "#saved";
  HTMLAnchorElement.prototype.click = function () { names.push(this.download); };
  get("download").click();
  get("screenshot").click();
  const [obj, png] = saved;
  const size = new DataView(png.buffer, 16, 8);
  const { clientWidth, clientHeight } = view.canvas;
  return {
    names, obj, png: String.fromCharCode(...png.subarray(1, 4)),
    finer: [size.getUint32(0) / clientWidth, size.getUint32(4) / clientHeight],
  };
}

/** Whether nothing sticks out of a page that is so wide; tables of figures scroll in their cards. */
function fits(width) {
  document.body.style.width = `${width}px`;
  const right = document.body.getBoundingClientRect().left + width;
  const all = [...document.body.querySelectorAll("main *, header *, footer *")];
  const fits = all.filter((one) => !one.closest(".figures table")).every((one) => one.getBoundingClientRect().right <= right + 0.5);
  document.body.style.width = "";
  return fits;
}

function reset() {
  const atFirst = pixels();
  view.canvas.focus();
  for (const key of ["ArrowLeft", "ArrowDown", "+"]) view.canvas.dispatchEvent(new KeyboardEvent("keydown", { key }));
  const turned = differing(pixels(), atFirst);
  get("wireframe").click();
  const wireframe = differing(pixels(), atFirst);
  get("wireframe").click();
  get("reset").click();
  return { turned, wireframe, left: differing(pixels(), atFirst) };
}

const spread = (count) => Array.from({ length: 12 }, (_, i) => Math.floor((i * count) / 12));
const ofField = model.field?.irregular ?? [];
const found = {
  fits: fits(Number(location.hash.slice(1))),
  dark: window.matchMedia("(prefers-color-scheme: dark)").matches,
  background: getComputedStyle(document.body).backgroundColor,
  reset: reset(),
  layers: layers(),
  legends: ["irregular", "poles"].map((layer) => get(`indices-${layer}`)?.textContent),
  irregular: ofField,
  hues: hues("vertex", "irregular", ofField),
  poleHues: hues("corner", "poles", model.quads.irregular),
  quads: picks("quad", spread(model.quads.quads.length), ["quads"]),
  triangles: picks("triangle", spread(model.triangles.length / 3), ["input"]),
  vertices: picks("vertex", ofField.map(([v]) => v), ["input", "irregular"]),
  measures: measures(),
  downloads: downloads(),
};
const result = document.createElement("pre");
result.id = "found";
result.textContent = JSON.stringify(found);
document.body.append(result);
