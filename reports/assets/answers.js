// Answers for the tolerance that the reader enters, from the data in answers_points.js. The rule is that of harness/study/study.h.
"use strict";
(() => {
const data = window.answersPoints; // answers_points.js
const field = name => document.getElementById(name);
const body = document.querySelector("table.reach tbody"), head = document.querySelector("table.reach thead tr");
const make = (tag, words, parent, look) => {
  const made = document.createElement(tag);
  made.textContent = words;
  if (look) made.className = look;
  parent.append(made);
  return made;
};
const seconds = t => t === null ? "\u2013" : t < 1e-3 ? Number((1e6 * t).toPrecision(3)) + " \u00b5s" : t < 1 ? Number((1e3 * t).toPrecision(3)) + " ms" : Number(t.toPrecision(3)) + " s";

// Returns the formulations within the level, [{key, n, cost, time, most, error, defect, unranked}], by cost, then by name.
// Formulations without a rank come behind those with a rank, and formulations with a defect come last.
const reached = (one, found, level) => {
  const out = [];
  for (const [index, defect, errors] of found) {
    const at = errors.findIndex(e => e !== null && e <= level), [n, cost, time, most] = one.meshes[index];
    if (at >= 0) out.push({ unranked: one.unranked[index] || "", key: data.keys[index], n: n[at], cost: cost[at], time: time[at], most: most[at], error: errors[at], defect });
  }
  const cost = way => way.cost === null ? Infinity : way.cost;
  return out.sort((a, b) => Boolean(a.defect) - Boolean(b.defect) || Boolean(a.unranked) - Boolean(b.unranked) || cost(a) - cost(b) || (a.key < b.key ? -1 : 1));
};
const ties = (list, noise) => list.filter(way => !way.defect && !way.unranked && !(way.cost > noise * list[0].cost)).length;

const name = way => `${way.key} n\u00a0=\u00a0${way.n}`;
const beside = (list, cell, level) => {
  for (const words of [...new Set(list.map(way => way.defect))])
    make("div", `also within ${level}, ${words}: ` + list.filter(way => way.defect == words).map(name).join(", "), cell, "beside");
};
// Returns the formulations that have a higher cost than the first one but were faster in every round of a benchmark.
const faster = (list, tied) => list.slice(tied).filter(way => tied && !way.defect && !way.unranked && way.most !== null && list[0].most !== null && way.most < list[0].time);
const range = values => {
  const known = values.filter(t => t !== null), least = Math.min(...known), most = Math.max(...known);
  return !known.length ? "\u2013" : seconds(least) == seconds(most) ? seconds(least) : seconds(least) + " to " + seconds(most);
};
const row = (one, quantity, found, level, percent) => {
  const list = reached(one, found, level), tied = ties(list, one.noise), loose = list.filter(way => way.unranked && !way.defect), line = document.createElement("tr");
  const place = make("td", "", line);
  make("a", one.case, place).href = one.case + ".html";
  make("div", quantity, place, "beside");
  const best = make("td", tied ? list.slice(0, tied).map(name).join(", ") : loose.length ? "" : "not reached by a formulation that passes", line, tied ? "" : "skip");
  if (tied > 1) make("div", "costs tie", best, "noise");
  for (const words of [...new Set(loose.map(way => way.unranked))])
    make("div", `within ${percent}, no rank (${words}): ` + loose.filter(way => way.unranked == words).map(name).join(", "), best, "beside");
  beside(list.filter(way => way.defect), best, percent);
  for (const way of faster(list, tied)) make("div", `measured faster in every round: ${name(way)}, ${seconds(way.time)} to ${seconds(list[0].time)}`, best, "beside");
  make("td", range(list.slice(0, tied).map(way => way.cost)), line);
  make("td", range(list.slice(0, tied).map(way => way.time)), line);
  make("td", list.slice(tied).filter(way => !way.defect && !way.unranked).map(way => `${name(way)} (\u00d7 ${Number((way.cost / list[0].cost).toPrecision(2))})`).join(", ") || "\u2013", line, "beside");
  body.append(line);
  return tied > 0;
};

const show = () => {
  const typed = Number(field("tolerance").value.replace(",", ".").replace("%", "").trim());
  const good = typed >= 1e-4 && typed <= 10;
  field("tolerance").setAttribute("aria-invalid", String(!good));
  if (!good) { field("count").textContent = "Give a tolerance from 0.0001 to 10 %."; return; }
  const level = Number((typed / 100).toPrecision(15)), each = field("which").value == "each", only = field("case").value;
  head.replaceChildren();
  for (const words of ["case", `least cost within ${typed} %`, "cost", "measured", "then, by cost"]) make("th", words, head);
  body.replaceChildren();
  let rows = 0, answered = 0;
  for (const one of data.cases)
    if (!only || one.case == only)
      for (const [quantity, found] of one.asked.filter((q, i) => each ? one.asked.length == 1 || i > 0 : i == 0)) {
        rows++;
        answered += row(one, quantity, found, level, typed + " %");
      }
  field("count").textContent = `${answered} of ${rows} reached by a formulation that passes.`;
};

for (const one of data.cases) field("case").append(new Option(one.case, one.case));
field("asked").hidden = false;
field("asked").addEventListener("input", show);
field("asked").addEventListener("submit", event => event.preventDefault());
show();
})();
