// Colours, with components from 0 to 1.

const rgb = (text) => [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
const css = (colour) => `rgb(${colour.map((x) => Math.round(255 * x)).join(" ")})`;

/** From good to bad: darker from stop to stop, so that it also reads in grey. */
const HEAT = ["#dcebf2", "#f8e3a3", "#f4a951", "#db5a3f", "#7d1d4f"].map(rgb);
/** From short over the mean to long. */
const BALANCE = ["#1d4f91", "#7fb0d8", "#eceeec", "#eda265", "#9d3412"].map(rgb);

const COLOURS = {
  surface: rgb("#cfd3d6"),
  inside: rgb("#a58f7d"),
  plain: rgb("#e4e8ea"),
  other: rgb("#b81fc4"),
  folded: rgb("#e0302a"),
  repaired: rgb("#17a673"),
  ink: rgb("#17222d"),
  chalk: rgb("#d7e0e8"),
  cross: rgb("#0f4c86"),
  integer: rgb("#12385c"),
  feature: rgb("#0b0e12"),
  missed: rgb("#e6007e"),
  guide: rgb("#6a3fd0"),
  arc: rgb("#101820"),
  selected: rgb("#ff9d00"),
  positive: rgb("#d5342c"),
  negative: rgb("#2a5bd7"),
  unusual: rgb("#efa31d"),
};

function colourAt(stops, t) {
  const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  return stops[i].map((x, k) => x + (at - i) * (stops[i + 1][k] - x));
}

/** Colours of things that only have numbers: hues a golden section of the circle apart, in turns light and dark. */
function colourOfKind(number) {
  const hue = ((number * 0.618034) % 1) * 6, light = [0.92, 0.78, 0.85][number % 3];
  return [5, 3, 1].map((offset) => light * (1 - 0.42 * Math.min(1, Math.max(0, 2 - Math.abs(((hue + offset) % 6) - 3)))));
}

const stopsOf = (measure) => (measure.isTwoSided ? BALANCE : HEAT);

/** The colour of an irregular vertex, by the integer steps of its index. */
const colourOfIndex = (steps) =>
  steps === 1 ? COLOURS.positive : steps === -1 ? COLOURS.negative : COLOURS.unusual;
