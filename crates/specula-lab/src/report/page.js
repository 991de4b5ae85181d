// The page: its viewers, and which rows of the summary are shown.

const viewers = [...document.querySelectorAll(".viewer")].map((figure) => {
  const viewer = new Viewer(figure);
  listen(viewer);
  return viewer;
});

function filterSummary() {
  const outcome = document.getElementById("filter").value;
  const words = document.getElementById("search").value.toLowerCase().split(/\s+/);
  for (const row of document.querySelectorAll("#summary tbody tr")) {
    const text = row.textContent.toLowerCase();
    const named = words.every((word) => text.includes(word));
    row.hidden = !named || (outcome !== "" && row.dataset.outcome !== outcome);
  }
}
for (const id of ["filter", "search"]) {
  document.getElementById(id).addEventListener("input", filterSummary);
}

// Folded tables are printed whole.
let unfolded = [];
addEventListener("beforeprint", () => {
  unfolded = [...document.querySelectorAll("details:not([open])")];
  for (const table of unfolded) table.open = true;
});
addEventListener("afterprint", () => {
  for (const table of unfolded) table.open = false;
});
