// What pointers, wheels and keys do to a viewer.

/** Where in a pane an event happened, each in [0, 1]. */
function place(pane, event) {
  const box = pane.getBoundingClientRect();
  return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
}

function act(viewer, name) {
  switch (name) {
    case "slider": case "side": return viewer.setView(name);
    case "in": return viewer.zoomTo(viewer.zoom * 2);
    case "out": return viewer.zoomTo(viewer.zoom / 2);
    case "whole": return viewer.zoomTo(1);
    case "errors": return viewer.setErrors(!viewer.errors);
  }
}

const KEYS = {
  "+": "in", "=": "in", "-": "out", "0": "whole", "e": "errors", "E": "errors",
};
const MOVES = {
  ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1],
};

function listenToKeys(viewer, pane) {
  pane.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (KEYS[event.key]) act(viewer, KEYS[event.key]);
    else if (MOVES[event.key] && viewer.zoom > 1) viewer.move(...MOVES[event.key]);
    else return;
    event.preventDefault();
  });
}

function listenToWheel(viewer, pane) {
  pane.addEventListener("wheel", (event) => {
    // The page scrolls past pictures that nobody has clicked.
    if (document.activeElement !== pane && !event.ctrlKey) return;
    event.preventDefault();
    viewer.zoomTo(viewer.zoom * Math.pow(2, -event.deltaY / 200), ...place(pane, event));
  }, { passive: false });
}

function listenToPointer(viewer, pane) {
  let last = null;
  const drag = (event) => {
    const [u, v] = place(pane, event);
    // In the slider the divider is dragged, with Shift the picture.
    if (viewer.view === "slider" && !event.shiftKey) viewer.setSlider(u);
    else viewer.move(last[0] - u, last[1] - v);
    last = [u, v];
  };
  pane.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pane.focus({ preventScroll: true });
    if (event.isTrusted) pane.setPointerCapture(event.pointerId);
    last = place(pane, event);
    if (viewer.view === "slider") drag(event);
  });
  pane.addEventListener("pointermove", (event) => { if (last) drag(event); });
  for (const end of ["pointerup", "pointercancel"]) {
    pane.addEventListener(end, () => { last = null; });
  }
  pane.addEventListener("dragstart", (event) => event.preventDefault());
}

function listen(viewer) {
  for (const button of viewer.figure.querySelectorAll("[data-do]")) {
    button.addEventListener("click", () => act(viewer, button.dataset.do));
  }
  for (const input of [viewer.range, ...viewer.selects]) {
    input.addEventListener("input", () => viewer.show());
  }
  for (const pane of viewer.panes) {
    listenToKeys(viewer, pane);
    listenToWheel(viewer, pane);
    listenToPointer(viewer, pane);
  }
}
