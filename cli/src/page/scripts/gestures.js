// Mouse, touch and keys on the canvas.

function listen(view, onPick) {
  const { canvas, camera } = view;
  const pointers = new Map();
  let travelled = 0;
  const placeOf = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  const fromCentre = ([x, y]) => [
    (x - canvas.clientWidth / 2) / view.unitPixels, (canvas.clientHeight / 2 - y) / view.unitPixels,
  ];
  const moveBy = (dx, dy) => camera.move(dx / view.unitPixels, -dy / view.unitPixels);

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (!pointers.size) travelled = 0;
    pointers.set(event.pointerId, placeOf(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const after = placeOf(event);
    const [dx, dy] = [after[0] - before[0], after[1] - before[1]];
    travelled += Math.hypot(dx, dy);
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      const middle = [(after[0] + other[0]) / 2, (after[1] + other[1]) / 2];
      moveBy(dx / 2, dy / 2);
      camera.zoomAt(apart(after) / apart(before), ...fromCentre(middle));
    } else if (event.shiftKey || event.buttons & 6) moveBy(dx, dy);
    else camera.turn(dx / 170, dy / 170);
    pointers.set(event.pointerId, after);
    view.redraw();
  });
  const end = (event) => {
    const wasAlone = pointers.size === 1;
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && wasAlone && event.button === 0 && travelled < 5) onPick(placeOf(event));
  };
  canvas.addEventListener("pointerup", end);
  canvas.addEventListener("pointercancel", end);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 30 : 1;
    camera.zoomAt(Math.exp((-event.deltaY * lines) / 600), ...fromCentre(placeOf(event)));
    view.redraw();
  }, { passive: false });
  const keys = {
    ArrowLeft: () => camera.turn(-0.1, 0), ArrowRight: () => camera.turn(0.1, 0),
    ArrowUp: () => camera.turn(0, -0.1), ArrowDown: () => camera.turn(0, 0.1),
    "+": () => camera.zoomAt(1.15, 0, 0), "-": () => camera.zoomAt(1 / 1.15, 0, 0),
    0: () => element("reset").click(), w: () => element("wireframe").click(),
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
    view.redraw();
  });
}
