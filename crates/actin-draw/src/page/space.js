// An interactive view of solids: camera, mouse, touch and keys, scale bar and axes. Callers fill its batch, and solids.js
// draws it.
//
// space.show(fill) sets the function that fills a batch; it is called with the batch and the level of detail ('far',
//                  'near', 'fine')
// space.frame()    sets the initial camera
// space.centreOn() moves the centre of rotation and of the picture to a place
// space.arrows     arrows on top: [x, y, z, fx, fy, fz, text, fraction of the longest arrow]
// space.labels     texts on top: [x, y, z, text]
// space.marks      places with a ring: [x, y, z]
// space.picked     called with the pixel of a click
// space.draw()     requests drawing in the next frame

const Space = (() => {
  'use strict';

  const STEP = Math.PI / 36; // rotation by an arrow key (rad)
  const FINE = 2.5; // scale above which details are drawn (pixels per nm)
  const FAR = 0.5; // scale below which bodies are drawn as strips (pixels per nm)
  const SLOW = 40; // time of a slow picture (ms)
  const ARROW = 64; // length of the longest arrow (pixels)
  const HAZE = 0.45; // fraction of the background visible through the farthest body
  const DARK = window.matchMedia('(prefers-color-scheme: dark)');
  const { unit, dot } = Solids;
  const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

  // ---- rotations, as three rows (lab frame): right, up, towards the viewer

  function attitude({ towards, up }) {
    const t = unit(towards), right = unit(cross(up, t));
    return [right, cross(t, right), t];
  }

  // Rotates in the plane of two rows and orthonormalises.
  function turned(rows, i, j, angle) {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const next = rows.slice();
    next[i] = rows[i].map((v, k) => c * v - s * rows[j][k]);
    next[j] = rows[i].map((v, k) => s * v + c * rows[j][k]);
    const t = unit(next[2]), right = unit(cross(next[1], t));
    return [right, cross(t, right), t];
  }

  class Space {
    // `ownsWheel`: true if the wheel zooms without a preceding click.
    constructor(canvas, { ownsWheel = false, foot = 30 } = {}) {
      this.canvas = canvas;
      this.context = canvas.getContext('2d');
      this.batch = new Solids.Batch();
      this.fill = () => {};
      this.arrows = [];
      this.labels = [];
      this.marks = [];
      this.ownsWheel = ownsWheel;
      this.foot = foot; // height of the scale bar area (pixels)
      this.ink = () => [20, 20, 20];
      this.drawn = () => {};
      this.picked = () => {};
      this.pointers = new Map();
      this.rows = attitude({ towards: [0, 1, 0], up: [1, 0, 0] });
      this.isThere = Solids.isThere(() => this.draw());
      if (!this.isThere) {
        this.complain();
        return;
      }
      this.frame({ towards: [0, 1, 0], up: [1, 0, 0] }, [[0, 0, 0]]);
      this.reset();
      this.listen();
    }

    complain() {
      const note = document.createElement('p');
      note.className = 'lost';
      note.textContent = 'This browser draws no WebGL 2, which this view needs. Its settings may have switched '
        + 'it off; any browser of the last years has it.';
      this.canvas.replaceWith(note);
    }

    // Sets the camera to the direction `home` (towards the viewer, up) such that all places ([x, y, z] each, or flat) fit.
    frame(home, places, margin = 7) {
      const flat = places instanceof Float32Array ? places : Float32Array.from(places.flat());
      this.home = home;
      this.lab = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
      const rows = attitude(home), low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (let i = 0; i < flat.length; i += 3) {
        for (let k = 0; k < 3; k++) {
          const seen = rows[k][0] * flat[i] + rows[k][1] * flat[i + 1] + rows[k][2] * flat[i + 2];
          if (seen < low[k]) low[k] = seen;
          if (seen > high[k]) high[k] = seen;
        }
      }
      const middle = low.map((v, k) => (v + high[k]) / 2);
      this.target = [0, 1, 2].map((k) => rows.reduce((sum, row, i) => sum + row[k] * middle[i], 0));
      this.middleOfAll = this.target;
      this.half = low.map((v, k) => margin + (high[k] - v) / 2);
      this.reach = Math.hypot(...this.half);
    }

    // Moves the centre to a place (nm).
    centreOn(place) {
      this.target = [...place];
      this.draw();
    }

    reset() {
      this.target = this.middleOfAll;
      this.rows = attitude(this.home);
      this.zoom = 1;
      this.shift = [0, 0];
      this.draw();
    }

    // Looks along an axis of the lab, with the other two to the right and up.
    along(towards, up) {
      this.rows = attitude({ towards, up });
      this.draw();
    }

    turn(right, up) {
      this.rows = turned(turned(this.rows, 2, 0, right), 2, 1, up);
      this.draw();
    }

    // Zooms about a point of the canvas, by default its middle.
    zoomBy(factor, at) {
      const most = Math.max(40, 60 / this.fit()), next = Math.min(most, Math.max(0.3, this.zoom * factor));
      const [x, y] = at || this.middle([0, 0]), middle = this.middle(this.shift), share = next / this.zoom;
      this.shift = [this.shift[0] + (1 - share) * (x - middle[0]), this.shift[1] + (1 - share) * (y - middle[1])];
      this.zoom = next;
      this.draw();
    }

    move(x, y) {
      this.shift = [this.shift[0] + x, this.shift[1] + y];
      this.draw();
    }

    // Returns the scale at which all places fit (pixels per nm).
    fit() {
      const { clientWidth: w, clientHeight: h } = this.canvas;
      return Math.min((0.5 * w) / this.half[0], (0.5 * (h - this.foot - 10)) / this.half[1]);
    }

    middle([x, y]) {
      return [this.canvas.clientWidth / 2 + x, (this.canvas.clientHeight - this.foot) / 2 + y];
    }

    // ---- input

    listen() {
      const { canvas, pointers } = this;
      canvas.addEventListener('pointerdown', (event) => {
        if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, event);
        this.pressed = [event.clientX, event.clientY];
      });
      const release = (event) => {
        pointers.delete(event.pointerId);
        const moved = Math.hypot(event.clientX - this.pressed[0], event.clientY - this.pressed[1]);
        if (event.type === 'pointerup' && moved < 4) this.picked(this.at(event));
        this.draw();
      };
      canvas.addEventListener('pointerup', release);
      canvas.addEventListener('pointercancel', release);
      canvas.addEventListener('pointermove', (event) => this.drag(event));
      canvas.addEventListener('dblclick', () => this.reset());
      canvas.addEventListener('keydown', (event) => this.key(event));
      // In a page of text the wheel scrolls the page until the view has been clicked. Ctrl, which touchpads report when
      // pinching, always zooms.
      canvas.addEventListener('wheel', (event) => {
        if (!event.ctrlKey && !this.ownsWheel && document.activeElement !== canvas) return;
        event.preventDefault();
        const pixels = event.deltaMode === 1 ? 30 * event.deltaY : event.deltaY;
        this.zoomBy(Math.exp(-0.0015 * pixels * (event.ctrlKey ? 6 : 1)), this.at(event));
      }, { passive: false });
      new ResizeObserver(() => this.draw()).observe(canvas);
      DARK.addEventListener('change', () => this.draw());
    }

    at(event) {
      const box = this.canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    }

    // One pointer rotates, or moves with Shift or the right button; two pointers zoom, move and roll.
    drag(event) {
      const before = this.pointers.get(event.pointerId);
      if (!before) return;
      const others = [...this.pointers.values()].filter((p) => p.pointerId !== event.pointerId);
      this.pointers.set(event.pointerId, event);
      const [x, y] = [event.clientX - before.clientX, event.clientY - before.clientY];
      if (others.length === 0) {
        if (event.shiftKey || event.buttons === 4) this.move(x, y);
        else this.turn(0.008 * x, -0.008 * y);
        return;
      }
      const from = (p) => [p.clientX - others[0].clientX, p.clientY - others[0].clientY];
      const [a, b] = [from(before), from(event)];
      this.rows = turned(this.rows, 0, 1, Math.atan2(a[1], a[0]) - Math.atan2(b[1], b[0]));
      this.shift = [this.shift[0] + x / 2, this.shift[1] + y / 2];
      this.zoomBy(Math.hypot(...b) / Math.max(1, Math.hypot(...a)), this.at(others[0]));
    }

    key(event) {
      const actions = {
        ArrowLeft: () => (event.shiftKey ? this.move(-20, 0) : this.turn(-STEP, 0)),
        ArrowRight: () => (event.shiftKey ? this.move(20, 0) : this.turn(STEP, 0)),
        ArrowUp: () => (event.shiftKey ? this.move(0, -20) : this.turn(0, STEP)),
        ArrowDown: () => (event.shiftKey ? this.move(0, 20) : this.turn(0, -STEP)),
        '+': () => this.zoomBy(1.2), '=': () => this.zoomBy(1.2), '-': () => this.zoomBy(1 / 1.2),
        0: () => this.reset(), Home: () => this.reset(),
        x: () => this.along([1, 0, 0], [0, 1, 0]), y: () => this.along([0, 1, 0], [1, 0, 0]),
        z: () => this.along([0, 0, 1], [0, 1, 0]),
      };
      const act = actions[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    }

    // ---- drawing

    draw() {
      if (this.asked || !this.isThere) return;
      this.asked = true;
      requestAnimationFrame(() => {
        this.asked = false;
        this.render();
      });
    }

    show(fill) {
      Object.assign(this, { fill, filled: '' });
      this.draw();
    }

    // Level of detail at the current scale.
    get level() {
      const perNm = this.zoom * this.fit();
      return perNm >= FINE ? 'fine' : perNm < FAR ? 'far' : 'near';
    }

    // Draws now. A slow view is drawn quickly first, and supersampled with all effects when it rests.
    render(isFinal = false) {
      const { canvas, context } = this;
      const [w, h] = [canvas.clientWidth, canvas.clientHeight];
      if (w === 0 || h === 0) return;
      clearTimeout(this.later);
      const began = performance.now(), isQuick = this.slow && !isFinal, ratio = isQuick ? 1 : 2;
      if (canvas.width !== w * ratio || canvas.height !== h * ratio) {
        [canvas.width, canvas.height] = [w * ratio, h * ratio];
      }
      this.perNm = this.zoom * this.fit();
      this.centre = this.middle(this.shift);
      if (this.filled !== this.level) {
        this.filled = this.level;
        this.batch.clear();
        this.fill(this.batch, this.filled);
      }
      const deep = 2 * this.reach + 20, [x, y] = this.centre; // the target may be at an end
      context.clearRect(0, 0, canvas.width, canvas.height);
      Solids.draw(context, this.batch, {
        rows: this.rows, target: this.target, size: [canvas.width, canvas.height],
        middle: [ratio * x, canvas.height - ratio * y], perNm: ratio * this.perNm, ratio, effort: isQuick ? 0 : 1,
        reach: deep, near: [this.reach, -this.reach], haze: HAZE, edges: DARK.matches ? 0.8 : 1,
      });
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      this.overlay(w, h);
      context.setTransform(1, 0, 0, 1, 0, 0);
      this.drawn();
      if (!isFinal) this.slow = performance.now() - began > (isQuick ? SLOW / 10 : SLOW);
      canvas.dataset.drawn = String(Number(canvas.dataset.drawn || 0) + 1);
      canvas.dataset.quality = isQuick ? 'quick' : 'full';
      if (isQuick && !this.isMoving && this.pointers.size === 0) this.later = setTimeout(() => this.render(true), 250);
    }

    // Draws arrows, scale bar and axes on top of the solids.
    overlay(w, h) {
      const { context } = this, ink = `rgb(${this.ink().map(Math.round).join(',')})`;
      Object.assign(context, {
        strokeStyle: ink, fillStyle: ink, lineWidth: 2, lineCap: 'round', lineJoin: 'round',
        font: '13px system-ui, sans-serif', textBaseline: 'middle', textAlign: 'center',
      });
      this.taken = [];
      for (const one of this.arrows) this.arrow(one, w, h);
      for (const one of this.labels) this.label(one);
      for (const place of this.marks) {
        context.beginPath();
        context.arc(...this.pixel(this.see(...place)), 9, 0, 2 * Math.PI);
        context.stroke();
      }
      context.lineWidth = 2;
      const length = niceLength(130 / this.perNm), bar = length * this.perNm, y = h - 14;
      this.path([[14, y - 4], [14, y], [14 + bar, y], [14 + bar, y - 4]]);
      context.textAlign = 'left';
      context.fillText(length >= 1000 ? `${length / 1000} µm` : `${length} nm`, 14, y - 14);
      context.textAlign = 'center';
      const origin = [w - 42, h - 36];
      ['x', 'y', 'z'].forEach((name, k) => {
        const seen = this.rows.map((row) => row[k]);
        const tip = [origin[0] + 26 * seen[0], origin[1] - 26 * seen[1]];
        context.globalAlpha = seen[2] < -0.2 ? 0.5 : 1;
        this.path([origin, tip]);
        const beyond = 9 / Math.max(0.4, Math.hypot(seen[0], seen[1]));
        context.fillText(name, tip[0] + beyond * seen[0], tip[1] - beyond * seen[1]);
        context.globalAlpha = 1;
      });
    }

    // Reserves space for a text; false if it would cover another.
    takes(left, top, width) {
      const isApart = ([l, t, wide]) => left > l + wide + 4 || left + width + 4 < l || Math.abs(top - t) > 14;
      if (!this.taken.every(isApart)) return false;
      this.taken.push([left, top, width]);
      return true;
    }

    // Draws an arrow with its text. Short arrows have a third of the full length. An arrow from its place out of the
    // picture or onto the axes ends at its place instead.
    arrow([x, y, z, fx, fy, fz, text, share = 1], w, h) {
      const { context } = this, size = Math.hypot(fx, fy, fz), at = this.pixel(this.see(x, y, z));
      const seen = this.rows.map((row) => dot(row, [fx, fy, fz]) / size);
      const length = ARROW * Math.max(1 / 3, share);
      const to = [at[0] + length * seen[0], at[1] - length * seen[1]];
      const isOut = to[0] < 8 || to[0] > w - 8 || to[1] < 26 || to[1] > h - 30 || (to[0] > w - 84 && to[1] > h - 96);
      const way = isOut ? -1 : 1, end = [at[0] + way * length * seen[0], at[1] - way * length * seen[1]];
      const tip = isOut ? at : end;
      context.lineWidth = 3;
      context.save();
      this.path([at, end]);
      const across = Math.hypot(seen[0], seen[1]);
      if (across > 0.1) {
        const u = [seen[0] / across, -seen[1] / across];
        const head = (side) => [tip[0] - 9 * u[0] + side * 5 * u[1], tip[1] - 9 * u[1] - side * 5 * u[0]];
        this.path([head(1), tip, head(-1)]);
      }
      const half = context.measureText(text).width / 2 + 6;
      const inside = Math.min(w - half, Math.max(half, end[0] + 30 * way * seen[0]));
      const top = end[1] + 4 - 16 * way * seen[1];
      if (this.takes(inside - half, top, 2 * half)) context.fillText(text, inside, top);
      context.restore();
    }

    // Draws text with a background halo.
    label([x, y, z, text]) {
      const { context } = this, [left, top] = this.pixel(this.see(x, y, z));
      context.save();
      Object.assign(context, {
        font: '12px system-ui, sans-serif', textAlign: 'left', lineWidth: 3,
        strokeStyle: getComputedStyle(this.canvas).backgroundColor,
      });
      if (this.takes(left + 6, top, context.measureText(text).width)) {
        context.strokeText(text, left + 6, top);
        context.fillText(text, left + 6, top);
      }
      context.restore();
    }

    // Transforms a point to camera coordinates.
    see(x, y, z) {
      const p = [x - this.target[0], y - this.target[1], z - this.target[2]];
      return this.rows.map((row) => dot(row, p));
    }

    pixel([x, y]) {
      return [this.centre[0] + this.perNm * x, this.centre[1] - this.perNm * y];
    }

    path(points) {
      this.context.beginPath();
      points.forEach(([x, y]) => this.context.lineTo(x, y));
      this.context.stroke();
    }
  }

  // Returns the largest of 1, 2, 5, 10, ... up to a limit.
  function niceLength(most) {
    const power = 10 ** Math.floor(Math.log10(most));
    return power * [5, 2, 1].find((digit) => digit * power <= most);
  }

  return Space;
})();
