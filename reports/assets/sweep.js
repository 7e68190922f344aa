// Maps of a sweep over axes that the reader selects, drawn from the cells that sweep_own.js reads. They look like those of
// reports/sweep/maps.py and must be changed together with it.
"use strict";
(() => {
const find = id => document.getElementById(id);
const form = find("choice"), place = find("drawn"), count = find("told");
const safe = text => String(text).replace(/[&<>"]/g, c => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" }[c]));
const short = value => String(Math.round(10 * value) / 10);
const { ask, spread, joined, EMPTY } = beamwork_cells;
let data = null;

// Returns [slices][x][y] from the cells of a formulation. `fixed` is the part of each other axis, or -1 for all parts.
const project = (cells, x, y, of, groups, fixed, join) => {
  const size = data.axes.map(axis => axis.names.length), at = size.map(() => 0);
  const out = groups.map(() => Array.from({ length: size[x] }, () => new Array(size[y]).fill(EMPTY)));
  const slice = i => of < 0 ? 0 : groups.findIndex(([low, high]) => at[of] >= low && at[of] <= high);
  for (const value of cells) {
    if (fixed.every((part, axis) => part < 0 || part == at[axis])) {
      const to = out[slice()][at[x]];
      to[at[y]] = join(to[at[y]], value);
    }
    for (let axis = size.length; axis--;) { if (++at[axis] < size[axis]) break; at[axis] = 0; }
  }
  return out;
};

const text = (x, y, words, more) => `<text x="${short(x)}" y="${short(y)}"${more || ""}>${safe(words)}</text>`;
const ticks = (axis, field, room) => {
  const out = [];
  for (const [part, words] of axis.ticks) if (!out.length || part * field - out[out.length - 1][0] >= room) out.push([part * field, words]);
  return out;
};

// Returns a map as SVG.
const draw = (table, x, y, look, wide, title, what) => {
  const { top, below, right, letter } = data.sizes, left = Math.max(data.sizes.left, 12 + 6 * Math.max(0, ...y.ticks.map(([, words]) => words.length))), clamp = value => Math.min(40, Math.max(11.5, value));
  const field = clamp(wide / x.names.length), high = clamp(wide / y.names.length);
  const width = field * x.names.length, height = high * y.names.length, bottom = top + height;
  const paths = {}, signs = {}, seen = {};
  y.names.forEach((_, j) => {
    const up = top + height - (j + 1) * high;
    for (let i = 0; i < x.names.length;) {
      const state = table[i][j];
      let end = i;
      while (end < x.names.length && table[end][j] == state) end++;
      if (state != EMPTY) {
        const long = (end - i) * field;
        (paths[state] ||= []).push(`M${short(left + i * field)} ${short(up)}h${short(long)}v${short(high)}h${short(-long)}z`);
        if (look[state].sign.length * letter <= long) (signs[state] ||= []).push(text(left + i * field + long / 2, up + high / 2 + 3, look[state].sign));
        seen[state] = (seen[state] || 0) + end - i;
      }
      i = end;
    }
  });
  const all = Object.values(seen).reduce((a, b) => a + b, 0);
  const said = Object.keys(seen).map(Number).sort((a, b) => (a < 0) - (b < 0) || a - b).map(state => `${look[state].words}: ${Math.round(100 * seen[state] / all)} %`).join("; ");
  let out = "";
  for (const state in paths) {
    const { fill, ink } = look[state], edge = fill == "none" ? 'stroke="currentColor" stroke-opacity=".35"' : 'stroke="var(--paper,#fff)"';
    out += `<path fill="${fill}" ${edge} stroke-width=".7" d="${paths[state].join("")}"/><g text-anchor="middle" font-size="9" fill="${ink}">${(signs[state] || []).join("")}</g>`;
  }
  const room = Math.max(34, 1.1 * letter * Math.max(...x.ticks.map(([, words]) => words.length)));
  const xs = ticks(x, field, room), ys = ticks(y, high, 14);
  out += `<path fill="none" stroke="currentColor" d="M${left} ${top}V${short(bottom)}H${short(left + width)}${xs.map(([at]) => `M${short(left + at)} ${short(bottom)}v4`).join("")}${ys.map(([at]) => `M${left} ${short(bottom - at)}h-4`).join("")}"/>`;
  out += `<g text-anchor="middle" font-size="10">${xs.map(([at, words]) => text(left + at, bottom + 15, words)).join("")}</g>`;
  out += `<g text-anchor="end" font-size="10">${ys.map(([at, words]) => text(left - 6, bottom - at + 3.5, words)).join("")}</g>`;
  out += text(left + width / 2, bottom + 31, x.title, ' text-anchor="middle"') + text(4, top - 8, y.title);
  out += text(4, 12, title, ' font-weight="bold"');
  const full = Math.max(left + width + right, 7.5 * title.length + 8), tall = bottom + below;
  return `<figure><div class="figure"><svg role="img" aria-label="${safe(what + ": " + (said || "no points"))}" viewBox="0 0 ${short(full)} ${short(tall)}" width="${Math.round(full)}" height="${Math.round(tall)}" fill="currentColor" font-size="11" font-family="'DejaVu Sans',Verdana,sans-serif">${out}</svg></div></figure>`;
};

const chosen = name => Number(form.elements[name].value);

// Returns the axes that are not drawn. The reader selects one part or all parts of each of them.
const others = (x, y, of) => data.axes.map((_, axis) => axis).filter(axis => ![x, y, of].includes(axis));
const fields = () => {
  const left = others(chosen("x"), chosen("y"), chosen("of"));
  for (const label of form.querySelectorAll("label[data-axis]")) label.hidden = !left.includes(Number(label.dataset.axis));
};

const legend = (look, used) => Object.keys(look).map(Number).filter(state => used.has(state)).sort((a, b) => (a < 0) - (b < 0) || a - b).map(state =>
  `<span class="field"><svg width="${16 + 5 * Math.max(0, look[state].sign.length - 1)}" height="18" aria-hidden="true" font-size="10" text-anchor="middle"><rect x=".5" y=".5" width="100%" height="17" fill="${look[state].fill}" stroke="currentColor" stroke-opacity=".4"/><text x="50%" y="12.5" fill="${look[state].ink}">${safe(look[state].sign)}</text></svg> ${safe(look[state].words)}</span>`).join("");

const show = cells => {
  data = cells;
  const x = chosen("x"), y = chosen("y"), of = chosen("of"), q = chosen("quantity"), mesh = chosen("show");
  fields();
  if (x == y || of == x || of == y) { count.textContent = "Choose axes that differ."; return; }
  const fixed = data.axes.map((_, axis) => others(x, y, of).includes(axis) ? chosen(`at${axis}`) : -1);
  const look = mesh < 0 ? data.elements : data.errors, table = mesh < 0 ? data.least[q] : data.worst[q][mesh];
  const third = of < 0 ? null : data.axes[of];
  const slices = third ? third.slices : [["", [0, 0]]], groups = slices.map(([, group]) => group);
  const used = new Set();
  const what = mesh < 0 ? "elements needed" : `error with ${data.meshes[mesh]} elements`;
  const rows = data.order.map(f => {
    const found = project(spread(table[f]), x, y, of, groups, fixed, mesh < 0 ? joined : Math.max);
    found.flat(2).forEach(state => used.add(state));
    const maps = found.map((states, k) => {
      const title = slices[k][0], over = `${data.axes[x].title} and ${data.axes[y].title}`;
      return draw(states, data.axes[x], data.axes[y], look, third ? data.sizes.narrow : data.sizes.wide, title || data.keys[f],
        `${what} by ${data.keys[f]} over ${over}${title && ", " + title}`);
    });
    return third ? `<h3 class="of">${safe(data.keys[f])}</h3><div class="row scroll">${maps.join("")}</div>` : maps.join("");
  });
  place.className = third ? "" : "maps";
  place.innerHTML = rows.join("");
  find("signs").innerHTML = legend(look, used);
  count.textContent = mesh < 0 ? "" : "The largest error of the points of a field, not above the number that stands there [%].";
};

form.hidden = false;
form.addEventListener("change", () => ask(show));
form.addEventListener("submit", event => event.preventDefault());
// The selections of the axes that are not drawn are shown before the cells are loaded.
const drawn = ["x", "y", "of"].map(name => form.elements[name].value);
form.querySelectorAll("label[data-axis]").forEach(label => { label.hidden = drawn.includes(label.dataset.axis); });
})();
