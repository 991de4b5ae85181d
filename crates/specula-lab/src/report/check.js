// The page's own check, at `report.html#check`: does all that a reader can do, and says in the attribute
// `data-check` of the root what came out.

function expect(condition, what) {
  if (!condition) throw new Error(what);
}

function fire(target, type, init, Kind = Event) {
  target.dispatchEvent(new Kind(type, { bubbles: true, cancelable: true, ...init }));
}

function choose(select, index) {
  select.selectedIndex = index;
  fire(select, "input");
}

function click(viewer, name) {
  viewer.figure.querySelector(`[data-do=${name}]`).click();
}

function near(a, b) {
  return Math.abs(a - b) < 1e-6;
}

/** Zoom and pan of an image as the browser has them. */
function shown(image) {
  const matrix = new DOMMatrix(getComputedStyle(image).transform);
  return [matrix.a, -matrix.e / (matrix.a * image.offsetWidth), -matrix.f / (matrix.d * image.offsetHeight)];
}

function checkSlider(viewer) {
  click(viewer, "slider");
  expect(viewer.split.offsetHeight > 0, "the slider is shown");
  expect(viewer.shots[0].offsetHeight === 0, "pictures side by side are hidden");
  viewer.range.value = 250;
  fire(viewer.range, "input");
  const left = viewer.split.querySelector("img.left");
  expect(getComputedStyle(left).clipPath.includes("75%"), `the slider cuts: ${left.style.clipPath}`);
  const last = viewer.shots.length - 1;
  choose(viewer.selects[0], last);
  expect(left.src === viewer.shots[last].querySelector(".picture").src, "any picture on the left");
  choose(viewer.selects[0], 0);
  expect(left.src === viewer.shots[0].querySelector(".picture").src, "and the first again");
  const pane = viewer.split.querySelector(".pane");
  const box = pane.getBoundingClientRect();
  const at = { clientX: box.left + 0.6 * box.width, clientY: box.top + 1, button: 0 };
  fire(pane, "pointerdown", at, PointerEvent);
  fire(pane, "pointerup", at, PointerEvent);
  expect(Math.abs(viewer.range.value - 600) <= 1, `the divider is dragged: ${viewer.range.value}`);
}

function checkErrors(viewer) {
  const shot = viewer.shots.find((s) => s.querySelector(".error"));
  if (!shot) return;
  const error = shot.querySelector(".error");
  choose(viewer.selects[0], viewer.shots.indexOf(shot));
  click(viewer, "errors");
  expect(viewer.split.querySelector("img.left").src === error.src, "the slider shows error maps");
  click(viewer, "side");
  expect(getComputedStyle(error).visibility === "visible", "error maps are shown");
  fire(viewer.panes[0], "keydown", { key: "e" }, KeyboardEvent);
  expect(getComputedStyle(error).visibility === "hidden", "the key E hides them");
}

function checkZoom(viewer) {
  click(viewer, "side");
  click(viewer, "in");
  const images = viewer.shots.map((s) => s.querySelector(".picture"));
  for (const image of images) {
    const [zoom, x, y] = shown(image);
    expect(near(zoom, 2) && Math.abs(x - 0.25) < 1e-3 && Math.abs(y - 0.25) < 1e-3,
      `all zoom about the middle: ${[zoom, x, y]}`);
    expect(getComputedStyle(image).imageRendering === "pixelated", "pixels are squares");
  }
  const pane = viewer.shots[0].querySelector(".pane");
  fire(pane, "keydown", { key: "ArrowLeft" }, KeyboardEvent);
  for (const image of images) expect(Math.abs(shown(image)[1] - 0.2) < 1e-3, "all move by keys");
  const box = pane.getBoundingClientRect();
  const from = { clientX: box.left + 0.5 * box.width, clientY: box.top + 0.5 * box.height, button: 0 };
  fire(pane, "pointerdown", from, PointerEvent);
  fire(pane, "pointermove", { ...from, clientX: box.left + 0.3 * box.width }, PointerEvent);
  fire(pane, "pointerup", from, PointerEvent);
  for (const image of images) expect(Math.abs(shown(image)[1] - 0.3) < 1e-3, "all are dragged");
  pane.focus();
  fire(pane, "wheel", { clientX: box.left, clientY: box.top, deltaY: -200 }, WheelEvent);
  expect(near(viewer.zoom, 4), `the wheel zooms: ${viewer.zoom}`);
  for (let i = 0; i < 20; i++) click(viewer, "in");
  expect(viewer.zoom === LARGEST_ZOOM, "zoom is bounded");
  viewer.move(99, 99);
  expect(near(viewer.x, 1 - 1 / LARGEST_ZOOM), "the picture is not left");
  click(viewer, "whole");
  expect(viewer.zoom === 1 && viewer.x === 0 && viewer.y === 0, "the whole again");
  pane.blur();
}

function checkPage() {
  const images = [...document.querySelectorAll("img[src]")];
  for (const image of images) {
    expect(image.src.startsWith("data:"), "pictures are in the page");
    expect(image.complete && image.naturalWidth > 0, `a picture is readable: ${image.alt}`);
  }
  for (const link of document.querySelectorAll("a[href^='#'], a[download]")) {
    const target = link.getAttribute("href");
    const there = target.startsWith("data:") || document.getElementById(target.slice(1));
    expect(there, `a link leads somewhere: ${target}`);
  }
  for (const link of document.querySelectorAll("a[download$='.csv']")) {
    expect(atob(link.href.split("base64,")[1]).includes("\n"), "tables can be had");
  }
  const search = document.getElementById("search");
  search.value = "no such word anywhere";
  fire(search, "input");
  const hidden = [...document.querySelectorAll("#summary tbody tr")].every((row) => row.hidden);
  expect(hidden, "the summary is searched");
  search.value = "";
  fire(search, "input");
  const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  expect(wide <= 0, `the page is as wide as its window, and ${wide} pixels`);
}

addEventListener("load", () => {
  if (location.hash !== "#check") return;
  const root = document.documentElement;
  try {
    checkPage();
    for (const viewer of viewers) {
      checkSlider(viewer);
      checkErrors(viewer);
      checkZoom(viewer);
    }
    root.dataset.check = `passed: ${viewers.length} viewers`;
  } catch (error) {
    root.dataset.check = `failed: ${error.message}`;
  }
});
