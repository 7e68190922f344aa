// Plays the frames of a motion in the viewer (viewer.js) repeatedly. Space plays and pauses, comma and full stop show the
// previous and the next frame, < and > change the speed, and Home and End show the first and the last frame.
"use strict";
(() => {
const WHOLE = 6, HOLD = 0.6, FACTORS = [0.1, 0.25, 0.5, 1, 2, 4]; // WHOLE: initial duration of a motion, HOLD: pause at its end [s]
const still = matchMedia("(prefers-reduced-motion: reduce)");
// Returns 1, 2 or 5 times a power of ten, near x.
const round = x => { const ten = 10 ** Math.floor(Math.log10(x)); return ten * (x / ten < 1.5 ? 1 : x / ten < 3.5 ? 2 : x / ten < 7.5 ? 5 : 10); };

class Player {
  constructor(viewer) {
    this.viewer = viewer; this.playing = false;
    const { place, shape, slider } = viewer, row = slider.parentNode.parentNode.appendChild(document.createElement("div"));
    this.frames = shape.times.flatMap((t, state) => t === null ? [] : [{ t, state }]);
    this.begin = this.frames[0].t; this.end = this.frames[this.frames.length - 1].t;
    row.className = "player";
    this.button = row.appendChild(Object.assign(document.createElement("button"), { type: "button" }));
    const label = row.appendChild(document.createElement("label"));
    label.textContent = "speed ";
    this.speed = label.appendChild(document.createElement("select"));
    const usual = round((this.end - this.begin) / WHOLE);
    FACTORS.forEach(f => this.speed.add(new Option(f * usual == 1 ? "real time" : `${Number((f * usual).toPrecision(3))} × real time`, f * usual, f == 1, f == 1)));
    slider.setAttribute("aria-label", "time");
    slider.addEventListener("input", () => this.pause());
    this.button.addEventListener("click", () => this.turn());
    place.addEventListener("keydown", event => this.key(event));
    this.pause();
    if ("play" in place.dataset) { this.show(0); if (!still.matches) this.play(); }
    still.addEventListener("change", () => { if (still.matches) this.pause(); });
    place.player = this;
  }

  // Returns the index of the displayed frame, or of the first frame after a displayed state that is not a frame.
  now() { const k = Number(this.viewer.slider.value); return Math.max(0, this.frames.findIndex(f => f.state >= k)); }

  show(i) {
    const to = this.frames[Math.min(Math.max(i, 0), this.frames.length - 1)];
    this.viewer.slider.value = to.state;
    this.viewer.choose();
  }

  turn() { if (this.playing) this.pause(); else this.play(); }

  pause() {
    this.playing = false;
    this.button.textContent = "Play";
    this.viewer.words.setAttribute("aria-live", "polite");
  }

  play() {
    const i = this.now();
    this.playing = true; this.last = null;
    this.time = i == this.frames.length - 1 ? this.begin : this.frames[i].t;
    this.button.textContent = "Pause";
    this.viewer.words.setAttribute("aria-live", "off"); // not every frame is read aloud
    requestAnimationFrame(now => this.tick(now));
  }

  tick(now) {
    if (!this.playing) return;
    const speed = Number(this.speed.value);
    this.time += this.last === null ? 0 : Math.min(0.25, (now - this.last) / 1000) * speed;
    this.last = now;
    if (this.time > this.end + HOLD * speed) this.time = this.begin;
    this.seek(this.time);
    requestAnimationFrame(then => this.tick(then));
  }

  // Shows the last frame that is not after t. Frames are not interpolated.
  seek(t) {
    let i = this.frames.length - 1;
    while (i > 0 && this.frames[i].t > t + 1e-9 * (this.end - this.begin)) i--;
    if (this.frames[i].state != Number(this.viewer.slider.value)) this.show(i);
  }

  faster(by) { this.speed.selectedIndex = Math.min(Math.max(this.speed.selectedIndex + by, 0), this.speed.options.length - 1); }

  key(event) {
    const from = event.target, other = from == this.button || from == this.speed;
    const step = { ",": -1, ".": 1 }[event.key], by = { "<": -1, ">": 1 }[event.key], end = { Home: 0, End: this.frames.length - 1 }[event.key];
    if (event.key == " " && !other) this.turn();
    else if (step) { this.pause(); this.show(this.now() + step); }
    else if (by) this.faster(by);
    else if (end !== undefined && from == this.viewer.canvas) { this.pause(); this.show(end); }
    else return;
    event.preventDefault();
  }
}

window.beamwork_player = viewer => new Player(viewer);
})();
