// The explorer draws a quantity of a case against an abscissa that the reader selects. script.js adds tooltips and
// switches to the figure. The data of a case are in a separate script (explorer.py), which is loaded when it is selected.
"use strict";
(() => {
const find = id => document.getElementById(id);
const { cases, looks, axes, columns: order, extra, marks: signs } = JSON.parse(find("chosen").textContent);
const form = find("choice"), fields = form.elements, loaded = {}, waiting = {};
const safe = text => String(text).replace(/[&<>"]/g, c => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" }[c]));
const numbers = text => text ? text.split(" ").map(word => word == "-" ? NaN : Number(word)) : [];
const short = value => Number(value.toPrecision(4));
const power = e => e == 0 ? "1" : e == 1 ? "10" : "10" + String(e).replace(/./g, c => c == "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c]);

function fill(select, items, wanted) {
  select.textContent = "";
  items.forEach(([words, value]) => select.append(new Option(words, value)));
  if (items.some(([, value]) => String(value) == wanted)) select.value = wanted;
}

// Returns [lowest value, highest value, [[value of a tick, label]]] of an axis for these values.
function axis(values, log) {
  let [low, high] = [Math.min(...values), Math.max(...values)];
  if (log) {
    const room = high > low ? (high / low) ** 0.05 : 2;
    low /= room; high *= room;
    const [first, last] = [Math.ceil(Math.log10(low)), Math.floor(Math.log10(high))], every = Math.max(1, Math.ceil((last - first + 1) / 7)), out = [];
    for (let e = first - 1; e <= last; e++) {
      if (last - first >= 2) { if (e >= first && (last - e) % every == 0) out.push([10 ** e, power(e)]); }
      else [1, 2, 5].forEach(s => { const at = s * 10 ** e; if (at >= low && at <= high) out.push([at, short(at)]); });
    }
    return [low, high, out];
  }
  const room = 0.05 * (high - low) || Math.abs(low) || 1;
  low -= room; high += room;
  const rough = 10 ** Math.floor(Math.log10((high - low) / 4)), step = rough * [1, 2, 5, 10].find(f => (high - low) / (f * rough) <= 6), out = [];
  for (let i = Math.ceil(low / step); i * step <= high; i++) out.push([i * step, Number((i * step).toPrecision(9))]);
  return [low, high, out];
}

function draw() {
  const data = loaded[fields.case.value], point = data.points[fields.point.value], q = Number(fields.quantity.value), [x_name, x_key] = axes.find(([, key]) => key == fields.x.value);
  const [name, unit] = point.q[q], error = fields.y.value == "e", curves = [];
  for (const one of point.s) {
    const told = text => typeof text == "number" ? data.w[text] : text, of = told(one[0]), found = one[order.length][q];
    if (!found || !looks[of]) continue;
    const column = key => numbers(told(one[order.indexOf(key)])), [x, n, s, c, u, i] = [x_key, "n", "s", "c", "u", "i"].map(column);
    const [signed, verdict, truth, values] = found.map(told), parts = numbers(signed), off = parts.map(Math.abs);
    const value = values ? numbers(values) : parts.map(e => Number((truth * (1 + e)).toPrecision(7))); // only errors are stored if there is a reference value
    const rows = n.map((_, k) => ({ x: x[k], y: error ? Math.min(Math.max(off[k], 1e-13), 1e3) : value[k], row: [n[k], value[k], Number.isFinite(off[k]) ? Number(off[k].toPrecision(2)) : null, s[k], Number.isFinite(c[k]) ? c[k] : null, u[k], i[k], verdict] })).filter(r => r.x > 0 && Number.isFinite(r.y));
    if (rows.length) curves.push({ key: of, rows });
  }
  const place = find("explored"), words = find("explored-words");
  place.textContent = "";
  if (!curves.length) {
    words.textContent = error ? `${name}: there is no reference value here, or no formulation has a value; choose "value".` : `${name}: no value that ${x_name} tells apart.`;
    return;
  }
  const [left, top, wide, tall] = [72, 12, 760, 380], all = curves.flatMap(curve => curve.rows);
  const [x0, x1, xs] = axis(all.map(r => r.x), true), [y0, y1, ys] = axis(all.map(r => r.y), error);
  const across = v => left + wide * Math.log(v / x0) / Math.log(x1 / x0), up = v => top + tall * (1 - (error ? Math.log(v / y0) / Math.log(y1 / y0) : (v - y0) / (y1 - y0)));
  const at = (a, b) => `${a.toFixed(1)},${b.toFixed(1)}`, right = left + wide, bottom = top + tall;
  const text = (a, b, said, anchor) => `<text x="${a.toFixed(1)}" y="${b.toFixed(1)}" text-anchor="${anchor}">${safe(said)}</text>`;
  let out = `<path stroke="currentColor" stroke-opacity=".12" d="${xs.map(([v]) => `M${across(v)} ${top}V${bottom}`).join("")}${ys.map(([v]) => `M${left} ${up(v)}H${right}`).join("")}"/>`;
  let marks = "";
  const abreast = curves.some(({ key }) => signs[key]) ? 2 : 3, said = key => signs[key] ? `${key} (${signs[key]})` : key;
  curves.forEach(({ key, rows }, i) => {
    const [colour, marker, dash] = looks[key];
    marks += `<marker id="explored${i}" markerUnits="userSpaceOnUse" overflow="visible" markerWidth="1" markerHeight="1"><${marker} fill="${colour}" stroke="${colour}"/></marker>`;
    const line = points => `<polyline points="${points}" fill="none" stroke="${colour}" stroke-width="1.6" stroke-dasharray="${dash}" style="marker:url(#explored${i})"/>`;
    out += `<g data-f="${safe(key)}" data-p="${i}">${line(rows.map(r => at(across(r.x), up(r.y))).join(" "))}</g>`;
    const [a, b] = [left + 780 / abreast * (i % abreast), bottom + 66 + 18 * Math.floor(i / abreast)];
    out += `<g data-l="${safe(key)}"><path fill="none" pointer-events="all" d="M${a} ${b - 9}h250v17H${a}z"/>${line([at(a, b - 1), at(a + 13, b - 1), at(a + 26, b - 1)].join(" "))}${text(a + 34, b + 3, said(key), "start")}</g>`;
  });
  out += `<path fill="none" stroke="currentColor" d="M${left} ${top}V${bottom}H${right}"/>`;
  out += xs.map(([v, said]) => text(across(v), bottom + 18, said, "middle")).join("") + ys.map(([v, said]) => text(left - 8, up(v) + 4, said, "end")).join("");
  out += text(left + wide / 2, bottom + 38, x_name, "middle");
  const side = error ? `relative error of ${name}` : `${name} [${unit}]`;
  out += `<text transform="translate(14 ${top + tall / 2}) rotate(-90)" text-anchor="middle">${safe(side)}</text>`;
  const high = bottom + 66 + 18 * Math.ceil(curves.length / abreast), first = extra.filter(key => curves.some(curve => curve.key == key));
  const off = curves.length > 8 ? first.slice(-(curves.length - 8)) : [];
  place.innerHTML = `<svg viewBox="0 0 ${right + 14} ${high}" width="${right + 14}" height="${high}" role="img" aria-label="${safe(side)} against ${safe(x_name)}" data-off="${safe(off.join(" "))}" fill="currentColor" font-size="11.5" font-family="'DejaVu Sans',Verdana,sans-serif"><defs>${marks}</defs>${out}</svg>`;
  const columns = ["n", unit && unit != "1" ? `value [${unit}]` : "value", "error", "time [s]", "cost [s]", "unknowns", "iterations", "verdict"];
  const told = place.appendChild(Object.assign(document.createElement("script"), { type: "application/json" }));
  const size = columns.length;
  told.textContent = JSON.stringify({ h: [columns], v: curves.flatMap(({ rows }) => columns.map((_, k) => rows.map(r => r.row[k]))), s: curves.map(({ key, rows }, i) => ({ f: key, t: name, h: 0, k: {}, n: rows.length, r: columns.map((_, k) => size * i + k) })) });
  window.beamwork.figure(place);
  words.textContent = `${fields.case.value}, ${point.t}: ${name} [${unit}].`;
}

// Fills the selections that depend on the case. Previous choices are kept if possible.
function offer(from) {
  const data = loaded[fields.case.value], wanted = from || Object.fromEntries(new FormData(form));
  fill(fields.point, data.points.map((point, i) => [point.t, i]), wanted.point);
  const names = data.points[fields.point.value].q.map(([name, unit], i) => [`${name} [${unit}]`, i]);
  const named = names.find(([, i]) => data.points[fields.point.value].q[i][0] == wanted.name);
  fill(fields.quantity, names, named ? named[1] : wanted.quantity);
}

function keep() {
  const [name] = loaded[fields.case.value].points[fields.point.value].q[fields.quantity.value];
  history.replaceState(null, "", "#" + new URLSearchParams({ case: fields.case.value, point: fields.point.value, name, x: fields.x.value, y: fields.y.value }));
}

function show(from) { offer(from); draw(); keep(); }

function load(name, then) {
  if (loaded[name]) { then(); return; }
  waiting[name] = then;
  document.head.append(Object.assign(document.createElement("script"), { src: `data_${name}.js` }));
}

window.beamwork_data = (name, data) => { loaded[name] = data; if (fields.case.value == name) waiting[name](); };

form.hidden = false;
form.addEventListener("submit", event => event.preventDefault());
form.addEventListener("change", () => {
  load(fields.case.value, () => show());
});
const start = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
fill(fields.case, cases.map(name => [name, name]), start.case || "sheet_cantilever");
fill(fields.x, axes, start.x || "s");
fields.y.value = start.y == "v" ? "v" : "e";
load(fields.case.value, () => show(start));
})();
