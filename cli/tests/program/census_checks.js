// Sorts and filters as people do, and leaves the names of the rows that are shown for the test.

const shown = () => [...document.querySelectorAll("#rows tbody tr")].filter((row) => !row.hidden).map((row) => row.cells[1].textContent);
const head = (name) => [...document.querySelectorAll("#rows th button")].find((button) => button.textContent === name);
const outcome = (value) => document.querySelector(`#outcomes button[value="${value}"]`);

function find(text) {
  const field = document.getElementById("find");
  field.value = text;
  field.dispatchEvent(new Event("input"));
  return shown();
}

function click(button) {
  button.click();
  return shown();
}

const found = {
  first: shown(),
  ascending: click(head("triangles")),
  descending: click(head("triangles")),
  byName: click(head("mesh")),
  refused: click(outcome("refused")),
  all: click(outcome("")),
  named: find("TORUS"),
  told: document.getElementById("shown").textContent,
  pictures: [...document.querySelectorAll("#rows img")].map((image) => image.naturalWidth),
};
const result = document.createElement("pre");
result.id = "found";
result.textContent = JSON.stringify(found);
document.body.append(result);
