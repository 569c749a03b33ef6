// Sorts and filters the rows. Without it the table is there as it was written, by name.

const table = document.getElementById("rows");
const body = table.tBodies[0];
const rows = [...body.rows];
const find = document.getElementById("find");
const buttons = [...document.querySelectorAll("#outcomes button")];
let outcome = "";

function show() {
  const words = find.value.toLowerCase().split(/\s+/).filter(Boolean);
  let count = 0;
  for (const row of rows) {
    const text = row.textContent.toLowerCase();
    const isShown = (!outcome || row.className === outcome) && words.every((word) => text.includes(word));
    row.hidden = !isShown;
    count += isShown;
  }
  document.getElementById("shown").textContent = `${count} of ${rows.length}`;
}

/** The value of a cell: a number where it has one; rows without go last either way. */
function valueOf(row, column) {
  const { value } = row.cells[column].dataset;
  if (value === undefined) return row.cells[column].textContent;
  return value === "" ? null : Number(value);
}

function sortBy(column, isDescending) {
  const compare = (a, b) => {
    const [x, y] = [valueOf(a, column), valueOf(b, column)];
    if (x === null || y === null) return (x === null) - (y === null);
    const order = typeof x === "number" ? x - y : x.localeCompare(y, "en", { numeric: true });
    return isDescending ? -order : order;
  };
  body.append(...[...rows].sort(compare));
}

[...table.tHead.rows[0].cells].forEach((head, column) => {
  head.querySelector("button")?.addEventListener("click", () => {
    const isDescending = head.getAttribute("aria-sort") === "ascending";
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", isDescending ? "descending" : "ascending");
    sortBy(column, isDescending);
  });
});
for (const button of buttons) {
  button.addEventListener("click", () => {
    outcome = button.value;
    for (const other of buttons) other.setAttribute("aria-pressed", String(other === button));
    show();
  });
}
find.addEventListener("input", show);
document.getElementById("filters").addEventListener("submit", (event) => event.preventDefault());
show();
document.body.dataset.ready = "yes";
