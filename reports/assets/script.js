// Script of all pages. Tooltips describe the markers of figures (pointer, tap, arrow keys). Entries of legends hide and
// show a formulation in all figures of the page. All details are open in print.
"use strict";
(() => {
const SVG = "http://www.w3.org/2000/svg", REACH = 18; // largest distance of the pointer from a marker [pixels]
const all = (where, what) => [...where.querySelectorAll(what)];
const make = (tag, words, parent, more) => {
  const made = Object.assign(document.createElement(tag), more);
  made.textContent = words;
  parent.append(made);
  return made;
};

// Formats of numbers in tooltips.
const short = (value, digits) => String(Number(value.toPrecision(digits || 6))).replace("-", "\u2212");
const seconds = value => value < 1e-3 ? short(1e6 * value, 3) + " \u00b5s" : value < 1 ? short(1e3 * value, 3) + " ms" : short(value, 3) + " s";
const said = (name, value) => {
  if (value === null) return "\u2013";
  if (typeof value == "string") return value;
  if (name == "error") return short(100 * value, 2) + " %";
  return name == "time [s]" || name == "cost [s]" ? seconds(value) : short(value, 8);
};

// {formulation: true if the reader shows it, false if hidden}, stored for the session of the window.
const place = "beamwork " + location.pathname;
let chosen = {};
try { chosen = JSON.parse(sessionStorage.getItem(place)) || {}; } catch (none) { /* without storage, until the page is closed */ }
const keep = () => { try { sessionStorage.setItem(place, JSON.stringify(chosen)); } catch (none) { /* no storage */ } };

// The tooltip of the page, and a line that screen readers read.
const box = make("div", "", document.body, { id: "said", hidden: true });
const aloud = make("div", "", document.body, { className: "aloud" });
aloud.setAttribute("aria-live", "polite");

// Returns the positions of the markers of a curve in units of the figure: corners of a line, or copies of a marker.
const marks = group => {
  const line = all(group, "polyline").find(each => getComputedStyle(each).markerMid != "none");
  const at = line ? [...line.points] : all(group, "use").map(use => ({ x: use.x.baseVal.value, y: use.y.baseVal.value }));
  return at.map(({ x, y }) => ({ x, y }));
};

class Figure {
  constructor(frame, svg) {
    this.frame = frame; this.svg = svg; this.at = null;
    this.off = new Set((svg.dataset.off || "").split(" ").filter(Boolean));
    this.keys = [...new Set(all(svg, "[data-f]").map(g => g.dataset.f))];
    const data = frame.querySelector("script[type='application/json']");
    const { h, v, s: told } = data ? JSON.parse(data.textContent) : { s: [] };
    told.forEach(one => { // see said_of() in svg.py
      one.c = h[one.h];
      const columns = one.r.slice(), of = one.c.map((_, k) => k in one.k ? null : v[columns.shift()]);
      one.r = Array.from({ length: one.n }, (_, i) => of.map((column, k) => column ? column[i] : one.k[k]));
    });
    // curves: [{told, group, marks}], with the markers in the order of the rows of their tooltips
    this.curves = all(svg, "g[data-p]").map(group => ({ group, told: told[group.dataset.p], marks: marks(group) }))
      .filter(curve => curve.told && curve.marks.length == curve.told.r.length);
    all(svg, "[data-l]").forEach(entry => this.entry(entry));
    if (this.curves.length) this.listen();
    if (this.off.size) this.more();
    this.show();
  }

  shown(key) { return key in chosen ? chosen[key] : !this.off.has(key); }

  show() {
    all(this.svg, "[data-f]").forEach(g => { g.style.display = this.shown(g.dataset.f) ? "" : "none"; });
    all(this.svg, "[data-l]").forEach(entry => {
      entry.style.opacity = this.shown(entry.dataset.l) ? "" : 0.35;
      if (entry.hasAttribute("role")) entry.setAttribute("aria-pressed", this.shown(entry.dataset.l));
    });
    if (this.button) {
      const hidden = this.keys.filter(key => !this.shown(key)).length;
      this.button.textContent = hidden ? `Show all ${this.keys.length} (${this.keys.length - hidden} are shown)` : "Show fewer";
    }
  }

  // Makes a part of a legend entry (text or line) switch its formulation. Only the text has the keyboard focus.
  entry(entry) {
    const key = entry.dataset.l;
    const turn = event => {
      chosen[key] = !this.shown(key);
      keep();
      figures.forEach(figure => figure.show());
      event.preventDefault();
    };
    entry.style.cursor = "pointer";
    entry.addEventListener("click", turn);
    if (!entry.querySelector("text")) return;
    this.svg.setAttribute("role", "group");
    entry.setAttribute("role", "button");
    entry.setAttribute("tabindex", "0");
    entry.addEventListener("keydown", event => { if (event.key == "Enter" || event.key == " ") turn(event); });
  }

  more() {
    this.button = make("button", "", this.frame.parentNode, { className: "more" });
    this.frame.after(this.button);
    this.button.addEventListener("click", () => {
      const some = this.keys.some(key => !this.shown(key));
      this.keys.forEach(key => { if (some) chosen[key] = true; else delete chosen[key]; });
      keep();
      figures.forEach(figure => figure.show());
    });
  }

  listen() {
    const near = event => {
      const found = this.nearest(event.clientX, event.clientY);
      if (found) this.point(...found); else this.hide();
    };
    this.svg.addEventListener("pointermove", near);
    this.svg.addEventListener("pointerdown", near);
    this.svg.addEventListener("pointerleave", event => { if (event.pointerType == "mouse") this.hide(); });
    this.frame.addEventListener("blur", () => this.hide());
    this.frame.addEventListener("keydown", event => {
      const step = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0] }[event.key];
      if (event.key == "Escape") this.hide();
      if (!step || event.target != this.frame) return;
      event.preventDefault();
      this.walk(...step);
    });
  }

  visible() { return this.curves.filter(curve => this.shown(curve.told.f)); }

  walk(curves, marks) {
    const there = this.visible();
    if (!there.length) return;
    let [curve, mark] = this.at && there.includes(this.at[0]) ? this.at : [there[0], curves ? 0 : -1];
    if (curves && this.at) curve = there[(there.indexOf(curve) + curves + there.length) % there.length];
    mark = Math.min(Math.max(mark + marks, 0), curve.marks.length - 1);
    this.point(curve, mark);
    aloud.textContent = box.innerText;
  }

  nearest(x, y) {
    const to = this.svg.getScreenCTM().inverse(), scale = this.svg.getScreenCTM().a;
    const there = new DOMPoint(x, y).matrixTransform(to);
    let best = REACH / scale, found = null;
    for (const curve of this.visible()) curve.marks.forEach((mark, i) => {
      const far = Math.hypot(mark.x - there.x, mark.y - there.y);
      if (far < best) { best = far; found = [curve, i]; }
    });
    return found;
  }

  point(curve, i) {
    this.at = [curve, i];
    const { x, y } = curve.marks[i], { t, f, c, r } = curve.told;
    if (!this.ring) {
      this.ring = document.createElementNS(SVG, "circle");
      for (const [name, value] of Object.entries({ r: 6, fill: "none", stroke: "currentColor", "stroke-width": 1.3, "pointer-events": "none" })) this.ring.setAttribute(name, value);
      this.svg.append(this.ring);
    }
    this.ring.setAttribute("cx", x); this.ring.setAttribute("cy", y); this.ring.style.display = "";
    box.textContent = "";
    make("b", f, box);
    if (t) make("div", t, box);
    const table = make("table", "", box);
    c.forEach((name, k) => {
      const row = make("tr", "", table);
      make("td", name == "time [s]" || name == "cost [s]" ? name.slice(0, 4) : name.replace(" [1]", ""), row);
      make("td", said(name, r[i][k]), row);
    });
    box.hidden = false;
    const on = new DOMPoint(x, y).matrixTransform(this.svg.getScreenCTM());
    const { width, height } = box.getBoundingClientRect();
    const wide = document.documentElement.clientWidth;
    box.style.left = Math.max(4, on.x + 14 + width < wide ? on.x + 14 : Math.min(on.x - 14 - width, wide - width - 4)) + "px";
    box.style.top = Math.max(4, Math.min(on.y + 10, innerHeight - height - 6)) + "px";
  }

  hide() {
    box.hidden = true; this.at = null;
    if (this.ring) this.ring.style.display = "none";
  }
}

const figures = all(document, "div.figure").filter(frame => frame.querySelector("svg")).map(frame => new Figure(frame, frame.querySelector("svg")));
// For figures that are added later (explorer.js). A new figure replaces the previous one in its frame.
window.beamwork = {
  figure(frame) {
    all(frame.parentNode, "button.more").forEach(button => button.remove());
    for (let i = figures.length; i--;) if (figures[i].frame == frame) figures.splice(i, 1);
    figures.push(new Figure(frame, frame.querySelector("svg")));
  }
};
addEventListener("scroll", () => { box.hidden = true; }, { passive: true });

if (document.querySelector("div.viewer")) document.head.append(Object.assign(document.createElement("script"), { src: "viewer.js" }));

// The list of the first page shows the cases whose names contain the entered text.
const find = document.getElementById("find");
if (find) {
  find.hidden = false;
  find.addEventListener("input", () => all(document, ".answers li").forEach(row => {
    row.hidden = !row.firstElementChild.textContent.includes(find.value.trim());
  }));
}

// Wide tables can have the keyboard focus, so that they can be scrolled. Closed details are open in print.
const reach = () => all(document, ".scroll, div.figure").forEach(part => { if (part.scrollWidth > part.clientWidth) part.tabIndex = 0; });
addEventListener("load", reach); addEventListener("resize", reach);
let folded = [];
addEventListener("beforeprint", () => { folded = all(document, "details:not([open])"); folded.forEach(part => { part.open = true; }); });
addEventListener("afterprint", () => folded.forEach(part => { part.open = false; }));
})();
