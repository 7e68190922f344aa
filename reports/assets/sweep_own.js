// Results of a sweep for parameters that the reader enters, and the cells of its lattice for the maps (sweep.js). The
// cells are in a separate script (sweep_page.py), which is loaded when they are needed.
"use strict";
(() => {
const find = id => document.getElementById(id);
const EMPTY = -2, UNKNOWN = -1, FARTHEST = 3;
let data = null;
const waiting = [];

// Returns the states of cells as numbers. `text` contains letters ("a" is 0), "_" (no point) or "?" (no reference for the
// error), each followed by its number of repetitions if there are several.
const spread = text => {
  const out = [];
  for (const [, letter, times] of text.matchAll(/([^\d])(\d*)/g)) {
    const value = letter == "_" ? EMPTY : letter == "?" ? UNKNOWN : letter.charCodeAt(0) - 97;
    for (let k = times ? Number(times) : 1; k--;) out.push(value);
  }
  return out;
};

// Returns the state of two cells together: the larger number of elements if both are within the tolerance.
const joined = (a, b) => {
  const { none, some, failed } = data;
  if (Math.min(a, b) < 0) return Math.max(a, b);
  if (a == failed || b == failed) return failed;
  if (a < none && b < none) return Math.max(a, b);
  return a == none && b == none ? none : some;
};

// Returns the indices of the cells at most `far` parts away from the parts `at`. Axes of words are not varied.
const around = (at, far) => at.reduce((cells, part, k) => {
  const { names, words } = data.axes[k], out = [], reach = words ? 0 : far;
  for (let i = Math.max(0, part - reach); i <= Math.min(names.length - 1, part + reach); i++)
    for (const cell of cells) out.push(cell * names.length + i);
  return out;
}, [0]);
const range = (axis, part, far) => {
  const bounds = [axis.range[0], ...axis.cuts, axis.range[1]];
  if (far == 0 || axis.words) return axis.names[part];
  return [bounds[Math.max(0, part - far)], bounds[Math.min(bounds.length - 1, part + far + 1)]].map(x => Number(x.toPrecision(3))).join(" to ");
};

// Shows the elements that each formulation needs at the entered parameters, or near them if their cell has no point.
const own = find("own"), answer = find("here");
const show = () => {
  const values = fields.map(field => field.tagName == "SELECT" ? Number(field.value) : Number(field.value.replace(",", ".").trim() || NaN));
  const wrong = data.axes.findIndex((axis, k) => !(values[k] >= axis.range[0] && values[k] <= axis.range[1]));
  answer.textContent = "";
  if (wrong >= 0) {
    const { name, range: [low, high] } = data.axes[wrong];
    answer.append(`Give ${name} from ${low} to ${high}: nothing was tried elsewhere.`);
    return;
  }
  const at = values.map((value, k) => data.axes[k].cuts.filter(cut => cut <= value).length), q = data.least.length - 1;
  const first = spread(data.least[q][data.order[0]]);
  let far = 0;
  while (far < FARTHEST && around(at, far).every(cell => first[cell] == EMPTY)) far++;
  const cells = around(at, far);
  const line = (words, parent, tag) => parent.append(Object.assign(document.createElement(tag || "td"), { textContent: words }));
  const table = document.createElement("table"), head = table.insertRow();
  ["formulation", "needs", "largest error with these"].forEach(words => line(words, head, "th"));
  for (const f of data.order) {
    const found = (table, join) => { const all = spread(table); return cells.map(cell => all[cell]).reduce(join, EMPTY); };
    const row = table.insertRow(), state = found(data.least[q][f], joined);
    line(data.keys[f], row);
    line(state == EMPTY ? "no point near" : data.elements[state].words, row);
    line(state < 0 || state >= data.none ? "\u2013" : data.errors[found(data.worst[q][state][f], (a, b) => Math.max(a, b))].words, row);
  }
  answer.append(`Tried ${far ? "near it" : "there"}: ${at.map((part, k) => `${data.axes[k].name} ${range(data.axes[k], part, far)}`).join(", ")}.`, table);
};

// Calls `what` with the cells when they are loaded.
const ask = what => {
  if (data) return what(data);
  if (waiting.push(what) == 1) document.head.append(Object.assign(document.createElement("script"), { src: own.dataset.cells }));
};
window.beamwork_sweep = found => { data = found; waiting.forEach(what => what(data)); };
window.beamwork_cells = { ask, spread, joined, EMPTY };
const fields = [...own.elements].filter(field => field.name);
own.hidden = false;
own.addEventListener("change", () => { if (fields.every(field => field.value.trim())) ask(show); });
own.addEventListener("submit", event => { event.preventDefault(); ask(show); });
})();
