// Draws a stored state of a scene in space: walls of sections, centre lines, rigid bodies and supports. Pointers and
// arrow keys rotate the view, + and - zoom, and the slider selects the state. One WebGL canvas draws all viewers of
// the page. Without WebGL or scripts, the still picture remains.
"use strict";
(() => {
const PAINT = { wall: [0.52, 0.71, 0.87], body: [0.93, 0.8, 0.62] };
const SHADERS = [`#version 300 es
in vec3 at; in vec3 paint; uniform mat3 turn; uniform vec3 scale; uniform float dot_size; uniform float before; out vec3 colour; out vec3 seen;
void main() { seen = turn * at; colour = paint; gl_Position = vec4(seen.xy * scale.xy, -seen.z * scale.z - before, 1.0); gl_PointSize = dot_size; }`,
`#version 300 es
precision highp float; in vec3 colour; in vec3 seen; uniform int lit; out vec4 pixel;
void main() {
  vec3 n = normalize(cross(dFdx(seen), dFdy(seen)));
  pixel = vec4(lit == 1 ? colour * (0.64 + 0.42 * abs(dot(n, normalize(vec3(0.35, 0.6, 0.72))))) : colour, 1.0);
}`];

const numbers = text => new Int16Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
let gl = null;

function open() {
  const context = document.createElement("canvas").getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: false });
  if (!context) return null;
  const program = context.createProgram();
  [context.VERTEX_SHADER, context.FRAGMENT_SHADER].forEach((kind, i) => {
    const shader = context.createShader(kind);
    context.shaderSource(shader, SHADERS[i]); context.compileShader(shader); context.attachShader(program, shader);
  });
  ["at", "paint"].forEach((name, i) => context.bindAttribLocation(program, i, name));
  context.linkProgram(program);
  if (!context.getProgramParameter(program, context.LINK_STATUS)) return null;
  context.useProgram(program);
  context.enable(context.DEPTH_TEST);
  context.kept = [context.createBuffer(), context.createBuffer()];
  context.place = name => context.getUniformLocation(program, name);
  return context;
}

// Positions in one state, in units of half the size of the picture.
class State {
  constructor(shape, k) {
    this.shape = shape; this.points = shape.at.subarray(7 * shape.count * k, 7 * shape.count * (k + 1));
    this.nodes = shape.nodes.subarray(3 * shape.ends * k, 3 * shape.ends * (k + 1));
  }
  node(i) { return [0, 1, 2].map(j => this.nodes[3 * i + j] / 32767); }
  centre(i) { return [0, 1, 2].map(j => this.points[7 * i + j] / 32767); }
  // Returns the point (y, z) of the section at point i.
  corner(i, y, z) {
    const [w, a, b, c] = [3, 4, 5, 6].map(j => this.points[7 * i + j] / 32767), at = this.centre(i);
    return [at[0] + 2 * (a * b - w * c) * y + 2 * (a * c + w * b) * z,
      at[1] + (1 - 2 * (a * a + c * c)) * y + 2 * (b * c - w * a) * z,
      at[2] + 2 * (b * c + w * a) * y + (1 - 2 * (a * a + b * b)) * z];
  }
  // Returns the corners of a wall at point i of a member, interpolated between its ends.
  wall(i, part, corners, far) {
    const out = [];
    for (let j = 0; j < corners.length; j += 2) out.push(this.corner(i, corners[j] + part * ((far ? far[j] : corners[j]) - corners[j]), corners[j + 1] + part * ((far ? far[j + 1] : corners[j + 1]) - corners[j + 1])));
    return out;
  }
  middle(some) { return [0, 1, 2].map(j => some.reduce((sum, i) => sum + this.node(i)[j], 0) / some.length); }

  // Returns {faces, lines, edges, dots}, lists of [point, colour].
  mesh(ink, soft) {
    const faces = [], lines = [], edges = [], dots = [], { members, profiles, bodies, rods, held, hinges } = this.shape;
    const face = (corners, paint) => { for (let i = 2; i < corners.length; i++) faces.push([corners[0], paint], [corners[i - 1], paint], [corners[i], paint]); };
    for (const [first, last, profile] of members) {
      for (let i = first; i < last - 1; i++) {
        lines.push([this.centre(i), ink], [this.centre(i + 1), ink]);
        const [a, b] = [i - first, i - first + 1].map(j => j / (last - 1 - first));
        for (const [near, far] of profiles[profile].strips) {
          const [p, q] = this.wall(i, a, near, far), [r, s] = this.wall(i + 1, b, near, far);
          face([p, q, s, r], PAINT.wall);
          edges.push([p, soft], [r, soft], [q, soft], [s, soft]);
        }
      }
      for (const [near, far] of profiles[profile].caps) { face(this.wall(first, 0, near, far), PAINT.wall); face(this.wall(last - 1, 1, near, far), PAINT.wall); }
    }
    for (const body of bodies) if (body.length > 2) face(body.map(i => this.node(i)), PAINT.body); else lines.push(...body.map(i => [this.node(i), [0.75, 0.6, 0.4]]));
    for (const groups of rods) for (const some of groups) lines.push([this.middle(some), [0.75, 0.6, 0.4]], [this.middle(groups.flat()), [0.75, 0.6, 0.4]]);
    held.forEach(i => dots.push([this.node(i), ink]));
    hinges.forEach(i => dots.push([this.centre(i), [0.85, 0.37, 0]]));
    return { faces, lines, edges, dots };
  }
}

class Viewer {
  constructor(place, shape) {
    this.place = place; this.shape = shape;
    [this.azimuth, this.elevation] = shape.view; this.zoom = 1;
    for (const name of ["at", "nodes"]) if (typeof shape[name] == "string") shape[name] = numbers(shape[name]);
    place.textContent = "";
    this.canvas = place.appendChild(document.createElement("canvas"));
    Object.assign(this.canvas, { tabIndex: 0, className: "space" });
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", place.dataset.alt + "; arrow keys turn it, + and - change its size");
    const row = place.appendChild(document.createElement("label"));
    this.slider = row.appendChild(Object.assign(document.createElement("input"), { type: "range", min: 0, max: shape.states.length - 1, value: shape.start }));
    this.slider.setAttribute("aria-label", "stored state");
    this.words = row.appendChild(document.createElement("output"));
    row.hidden = shape.states.length < 2;
    this.listen();
    this.choose();
    if ((shape.times || []).filter(t => t !== null).length > 1) play(this);
  }

  listen() {
    const fingers = new Map(), canvas = this.canvas;
    canvas.addEventListener("pointerdown", event => { fingers.set(event.pointerId, event); canvas.setPointerCapture(event.pointerId); });
    const away = event => fingers.delete(event.pointerId);
    canvas.addEventListener("pointerup", away); canvas.addEventListener("pointercancel", away);
    canvas.addEventListener("pointermove", event => {
      const before = fingers.get(event.pointerId), other = [...fingers.values()].find(f => f.pointerId != event.pointerId);
      if (!before) return;
      const apart = one => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
      if (other) this.grow(apart(event) / Math.max(1, apart(before))); else this.turn(event.clientX - before.clientX, event.clientY - before.clientY);
      fingers.set(event.pointerId, event);
    });
    canvas.addEventListener("wheel", event => { if (document.activeElement == canvas) { event.preventDefault(); this.grow(Math.exp(-event.deltaY / 500)); } }, { passive: false });
    canvas.addEventListener("keydown", event => {
      const step = { ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, -12], ArrowDown: [0, 12] }[event.key], by = { "+": 1.2, "=": 1.2, "-": 1 / 1.2 }[event.key];
      if (step) this.turn(...step); else if (by) this.grow(by); else return;
      event.preventDefault();
    });
    this.slider.addEventListener("input", () => this.choose());
    addEventListener("resize", () => this.draw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.choose());
  }

  turn(x, y) {
    this.azimuth -= 0.5 * x; this.elevation = Math.min(90, Math.max(-90, this.elevation + 0.5 * y));
    this.draw();
  }

  grow(by) { this.zoom = Math.min(20, Math.max(0.3, this.zoom * by)); this.draw(); }

  choose() {
    const k = Number(this.slider.value), dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const ink = dark ? [0.9, 0.92, 0.95] : [0.11, 0.14, 0.19], soft = dark ? [0.35, 0.4, 0.46] : [0.36, 0.5, 0.63], pale = dark ? [0.27, 0.3, 0.35] : [0.8, 0.83, 0.87];
    this.words.textContent = this.shape.states[k];
    this.slider.setAttribute("aria-valuetext", this.shape.states[k]);
    const rest = k ? new State(this.shape, 0).mesh(pale, pale) : { edges: [], lines: [] };
    this.mesh = new State(this.shape, k).mesh(ink, soft);
    this.mesh.ghost = [...rest.edges, ...rest.lines];
    this.draw();
  }

  draw() {
    const many = devicePixelRatio || 1, width = Math.round(this.canvas.clientWidth * many), height = Math.round(this.canvas.clientHeight * many);
    if (!width || !height) return;
    Object.assign(this.canvas, { width, height });
    Object.assign(gl.canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const [a, e] = [this.azimuth, this.elevation].map(d => d * Math.PI / 180), [ca, sa, ce, se] = [Math.cos(a), Math.sin(a), Math.cos(e), Math.sin(e)];
    const right = [-sa, ca, 0], up = [-se * ca, -se * sa, ce], towards = [ce * ca, ce * sa, se];
    gl.uniformMatrix3fv(gl.place("turn"), false, [0, 1, 2].flatMap(j => [right[j], up[j], towards[j]]));
    // The extents of the scene fit in the picture.
    const [wide, tall] = [right, up].map(side => this.shape.corners.reduce((most, c) => Math.max(most, Math.abs(c[0] * side[0] + c[1] * side[1] + c[2] * side[2])), 1e-9));
    const length = 0.9 * this.zoom * Math.min(width / 2 / wide, height / 2 / tall);
    gl.uniform3f(gl.place("scale"), 2 * length / width, 2 * length / height, 0.5);
    gl.uniform1f(gl.place("dot_size"), 6 * many);
    const paint = (kind, list, lit) => {
      if (!list || !list.length) return;
      gl.uniform1i(gl.place("lit"), lit);
      gl.uniform1f(gl.place("before"), lit ? 0 : 0.004); // lines and dots are in front of their walls
      [0, 1].forEach(i => {
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.kept[i]);
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(list.flatMap(item => item[i])), gl.STREAM_DRAW);
        gl.enableVertexAttribArray(i); gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 0, 0);
      });
      gl.drawArrays(kind, 0, list.length);
      [0, 1].forEach(i => { gl.disableVertexAttribArray(i); });
    };
    paint(gl.TRIANGLES, this.mesh.faces, 1);
    paint(gl.LINES, this.mesh.ghost, 0); paint(gl.LINES, this.mesh.edges, 0); paint(gl.LINES, this.mesh.lines, 0);
    paint(gl.POINTS, this.mesh.dots, 0);
    this.label(this.canvas.getContext("2d"), { width, height, many, length, right, up });
  }

  // Draws the picture, a bar of a round length and the axes.
  label(flat, { width, height, many, length, right, up }) {
    flat.drawImage(gl.canvas, 0, 0);
    const half = this.shape.half, round = 10 ** Math.floor(Math.log10(0.3 * width / length * half)), bar = round / half * length;
    flat.strokeStyle = flat.fillStyle = getComputedStyle(this.canvas).color;
    flat.lineWidth = 1.5 * many; flat.font = `${11 * many}px sans-serif`;
    flat.beginPath(); flat.moveTo(10 * many, height - 12 * many); flat.lineTo(10 * many + bar, height - 12 * many); flat.stroke();
    flat.fillText(round >= 1 ? `${round} m` : `${Number((1e3 * round).toPrecision(3))} mm`, 16 * many + bar, height - 8 * many);
    const x = width - 34 * many, y = height - 34 * many;
    ["x", "y", "z"].forEach((name, i) => {
      const [p, q] = [x + 22 * many * right[i], y - 22 * many * up[i]];
      flat.lineWidth = many; flat.beginPath(); flat.moveTo(x, y); flat.lineTo(p, q); flat.stroke();
      flat.fillText(name, p + 2 * many, q - 2 * many);
    });
  }
}

// Loads the player with the first motion. Films contain it.
const play = viewer => {
  if (window.beamwork_player) { window.beamwork_player(viewer); return; }
  document.head.append(Object.assign(document.createElement("script"), { src: "player.js", onload: () => window.beamwork_player(viewer) }));
};

// Shapes are scripts, which also load from file://, when they come into view. Films contain their shape.
const waiting = {};
window.beamwork_shape = (name, shape) => {
  gl = gl || open();
  if (gl) waiting[name].forEach(place => new Viewer(place, structuredClone(shape)));
};
const watch = new IntersectionObserver(seen => seen.filter(each => each.isIntersecting).forEach(({ target }) => {
  watch.unobserve(target);
  const name = target.dataset.shape, own = document.getElementById(`shape_${name}`);
  (waiting[name] = waiting[name] || []).push(target);
  if (own) window.beamwork_shape(name, JSON.parse(own.textContent));
  else document.head.append(Object.assign(document.createElement("script"), { src: `shape_${name}.js` }));
}), { rootMargin: "200px" });
document.querySelectorAll("div.viewer").forEach(place => watch.observe(place));
})();
