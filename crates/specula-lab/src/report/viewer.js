"use strict";
// Pictures of one scene: side by side or divided by a slider, with one zoom for all, or their error
// maps in their stead.

const LARGEST_ZOOM = 64;

class Viewer {
  constructor(figure) {
    this.figure = figure;
    this.zoom = 1;
    // Of the whole picture, what lies left of the view and above it.
    this.x = 0;
    this.y = 0;
    this.shots = [...figure.querySelectorAll(".shot")];
    this.split = figure.querySelector(".split");
    this.range = this.split.querySelector("input");
    this.selects = [...this.split.querySelectorAll("select")];
    this.panes = [...figure.querySelectorAll(".pane")];
    this.show();
  }

  get view() { return this.figure.dataset.view; }

  setView(view) {
    this.figure.dataset.view = view;
    this.split.hidden = view !== "slider";
    this.press("slider", view === "slider");
    this.press("side", view === "side");
    this.show();
  }

  get errors() { return this.figure.classList.contains("errors"); }

  setErrors(on) {
    if (!this.figure.querySelector(".error")) return;
    this.figure.classList.toggle("errors", on);
    this.press("errors", on);
    this.show();
  }

  press(name, on) {
    const button = this.figure.querySelector(`[data-do=${name}]`);
    if (button) button.setAttribute("aria-pressed", String(on));
  }

  /** Zooms such that the point at (u, v) of the view, each in [0, 1], stays where it is. */
  zoomTo(zoom, u = 0.5, v = 0.5) {
    const next = Math.min(Math.max(zoom, 1), LARGEST_ZOOM);
    this.x += u / this.zoom - u / next;
    this.y += v / this.zoom - v / next;
    this.zoom = next;
    this.move(0, 0);
  }

  /** Moves the view by parts of itself. */
  move(u, v) {
    const within = (at) => Math.min(Math.max(at, 0), 1 - 1 / this.zoom);
    this.x = within(this.x + u / this.zoom);
    this.y = within(this.y + v / this.zoom);
    this.show();
  }

  /** The source that stands for a shot in the slider. */
  source(shot) {
    const error = shot.querySelector(".error");
    return (this.errors && error ? error : shot.querySelector(".picture")).src;
  }

  show() {
    const style = this.figure.style;
    style.setProperty("--zoom", this.zoom);
    style.setProperty("--x", this.x);
    style.setProperty("--y", this.y);
    this.figure.classList.toggle("zoomed", this.zoom > 1);
    const digits = this.zoom < 10 && this.zoom % 1 ? 1 : 0;
    this.figure.querySelector("output").textContent = `${this.zoom.toFixed(digits)}×`;
    if (this.view === "slider") this.showSplit();
  }

  showSplit() {
    const [left, right] = ["left", "right"].map((side) => this.split.querySelector(`img.${side}`));
    [left, right].forEach((image, i) => {
      const shot = this.shots[this.selects[i].selectedIndex];
      const source = this.source(shot);
      if (image.src !== source) image.src = source;
      image.alt = this.selects[i].value;
    });
    const share = this.range.value / this.range.max;
    // The cut stands still while the picture under it is zoomed and moved.
    const cut = this.x + share / this.zoom;
    left.style.clipPath = `inset(0 ${100 * (1 - cut)}% 0 0)`;
    this.split.querySelector(".divider").style.left = `${100 * share}%`;
  }

  setSlider(share) {
    this.range.value = Math.round(Math.min(Math.max(share, 0), 1) * this.range.max);
    this.show();
  }
}
