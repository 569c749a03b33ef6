// The page begins.

const model = readModel(element("data").textContent);
// Repair that changed most of the mesh would hide it.
for (const change of model.changes) {
  change.isShown = change.vertices.length <= model.vertexCount / 2 && change.triangles.length <= model.triangles.length / 6;
}
try {
  const view = new View(element("view"), model);
  const panel = new Panel(view, model);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => view.redraw());
  // For the console, and for tests.
  window.roundel = { model, view, panel };
  document.body.dataset.drawn = "yes";
} catch (error) {
  element("failure").textContent = error.message;
  element("failure").hidden = false;
  document.body.dataset.drawn = "no";
  throw error;
}
