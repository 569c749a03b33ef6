// The chart of a measure: how many quads have which value, in the colours that they are drawn in.

const BINS = 36;

function drawChart(measure, range) {
  const counts = new Array(BINS).fill(0);
  const at = (value) => positionIn(range, value, measure.isTwoSided);
  for (const value of measure.values) ++counts[Math.min(BINS - 1, Math.floor(BINS * at(value)))];
  const most = Math.max(...counts, 1);
  const stops = stopsOf(measure);
  const bars = counts.map((count, i) => {
    const bar = document.createElement("b");
    // One quad among many is still to be seen.
    bar.style.height = count ? `max(3px, ${((100 * count) / most).toFixed(1)}%)` : "0";
    bar.style.background = css(colourAt(stops, (i + 0.5) / BINS));
    bar.title = `${count}`;
    return bar;
  });
  element("histogram").replaceChildren(...bars);
  element("histogram").setAttribute("aria-label", `${measure.name}: ${told(measure)}`);
  element("scale").style.background = `linear-gradient(to right, ${stops.map(css).join(", ")})`;
  const isBeyond = (end, other) => measure.values.some((value) => (value - end) * (end - other) > 0);
  const label = (end, other) => (isBeyond(end, other) ? (end < other ? "≤ " : "≥ ") : "") + measure.text(end);
  element("low").textContent = label(range[0], range[1]);
  element("high").textContent = label(range[1], range[0]);
  element("statistics").textContent = told(measure);
}

function told({ values, text }) {
  if (!values.length) return "no quads";
  const low = values.reduce((a, b) => Math.min(a, b)), high = values.reduce((a, b) => Math.max(a, b));
  const mean = values.reduce((a, b) => a + b) / values.length;
  return `least ${text(low)}, mean ${text(mean)}, largest ${text(high)}`;
}

/** Marks a value in the chart, or takes the mark away. */
function markChart(measure, range, value) {
  element("histogram").querySelector("em")?.remove();
  if (value === undefined) return;
  const mark = document.createElement("em");
  mark.style.left = `${(100 * positionIn(range, value, measure.isTwoSided)).toFixed(2)}%`;
  element("histogram").append(mark);
}
