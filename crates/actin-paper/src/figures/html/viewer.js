// Every <figure class="viewer"> of the page becomes a view of states that can be turned.
//
// A figure holds a <script type="application/json"> with `attitude` (towards the viewer, up),
// `bonds` between monomers, and `states`: bodies as plain numbers in nm, in the lab frame (see
// crates/actin-paper/src/figures/viewer). The colours are those of the element #palette. Pixels are made in
// raster.js.

(() => {
  'use strict';

  const PALETTE = JSON.parse(document.getElementById('palette').textContent);
  const STEP = Math.PI / 36; // of an arrow key
  const THROUGH = 8; // what is seen through bodies counts so much nearer (nm)
  const ON_SURFACE = 1.2; // what lies between bodies counts so much nearer (nm)
  const AXIS = 5; // length of the axes of segments (nm)
  const FINE = 2.5; // bonds between monomers and axes of segments show from so many pixels per nm
  const DARK = window.matchMedia('(prefers-color-scheme: dark)');

  // ---- colours

  // Colours of the page as it is now: the element holds those of both, so that a view and a picture
  // show one thing in one colour.
  const shades = () => (DARK.matches ? PALETTE.dark : PALETTE.light);
  const lighter = (rgb, share) => rgb.map((v) => v + share * (255 - v));
  const css = (rgb) => `rgb(${rgb.map(Math.round).join(',')})`;

  // The colour of a share of rod.
  function resolution(share) {
    const { stops } = shades(), place = share * (stops.length - 1);
    const i = Math.min(Math.floor(place), stops.length - 2), t = place - i;
    return stops[i].map((v, k) => v + t * (stops[i + 1][k] - v));
  }

  // What stands for what; evaluated at every drawing, since the page may change to dark.
  function colours() {
    const { things } = shades(), rod = resolution(1), monomer = resolution(0);
    return {
      monomer, other: lighter(monomer, 0.28),
      rod: lighter(rod, 0.12), stripe: lighter(rod, 0.72), seam: rod.map((v) => 0.6 * v),
      ...things, line: rod.map((v) => 0.45 * v), edge: things.junction.map((v) => 0.45 * v), ink: things.force,
    };
  }

  // ---- rotations, as three rows: right, up, towards the viewer, each in the lab frame

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const { unit } = Raster;

  function attitude({ towards, up }) {
    const t = unit(towards), right = unit(cross(up, t));
    return [right, cross(t, right), t];
  }

  // Turned by an angle in the plane of two of its rows, then made orthonormal again.
  function turned(rows, i, j, angle) {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const next = rows.slice();
    next[i] = rows[i].map((v, k) => c * v - s * rows[j][k]);
    next[j] = rows[i].map((v, k) => s * v + c * rows[j][k]);
    const t = unit(next[2]), right = unit(cross(next[1], t));
    return [right, cross(t, right), t];
  }

  // The three axes of a quaternion (w, x, y, z; body to lab).
  function axes(w, x, y, z) {
    return [
      [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
      [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
      [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
    ];
  }

  // ---- one view

  class View {
    constructor(figure) {
      this.data = JSON.parse(figure.querySelector('script').textContent);
      this.canvas = figure.querySelector('canvas');
      this.context = this.canvas.getContext('2d');
      this.legend = figure.querySelector('.legend');
      this.groups = [...new Set(this.data.states.map((s) => s.group))];
      this.controls(figure);
      this.pointers = new Map();
      this.choose(this.groups[0]);
      this.reset();
      this.listen();
    }

    // Menus and buttons; a menu with nothing to choose is left out.
    controls(figure) {
      const bar = figure.querySelector('.controls');
      const add = (name, text, act) => {
        const element = document.createElement(name);
        element.textContent = text;
        if (name === 'button') element.type = 'button';
        element.addEventListener(name === 'select' ? 'change' : 'click', act);
        bar.append(element);
        return element;
      };
      this.groupMenu = add('select', '', () => {
        this.choose(this.groupMenu.value);
        this.draw();
      });
      this.groupMenu.setAttribute('aria-label', 'Setting');
      this.groupMenu.append(...this.groups.map((g) => new Option(g, g)));
      this.groupMenu.hidden = this.groups.length < 2;
      this.stateMenu = add('select', '', () => {
        this.state = this.members[this.stateMenu.selectedIndex];
        this.draw();
      });
      this.stateMenu.setAttribute('aria-label', 'Resolution');
      this.compare = add('button', 'Compare', () => {
        const on = this.compare.getAttribute('aria-pressed') !== 'true';
        this.compare.setAttribute('aria-pressed', String(on));
        this.draw();
      });
      this.compare.setAttribute('aria-pressed', 'false');
      add('button', '−', () => this.zoomBy(1 / 1.3)).setAttribute('aria-label', 'Smaller');
      add('button', '+', () => this.zoomBy(1.3)).setAttribute('aria-label', 'Larger');
      add('button', 'Reset', () => this.reset());
    }

    // Shows a group, and of its states the one of the name shown before, or the middle one.
    choose(group) {
      const before = this.state && this.state.name;
      this.members = this.data.states.filter((s) => s.group === group);
      this.stateMenu.replaceChildren(...this.members.map((s) => new Option(s.name)));
      const same = this.members.findIndex((s) => s.name === before);
      const index = same < 0 ? Math.floor(this.members.length / 2) : same;
      this.state = this.members[index];
      this.stateMenu.selectedIndex = index;
      this.compare.hidden = this.members.length < 2;
      this.frame();
    }

    // Middle, reach and extent of all states of the group as first seen, so that they are compared
    // at one scale.
    frame() {
      const places = this.members.flatMap((s) => [
        ...s.lines.flat(), ...s.linkers.flatMap((l) => [l.slice(0, 3), l.slice(3)])]);
      const rows = attitude(this.data.attitude);
      const seen = places.map((p) => rows.map((row) => dot(row, p)));
      const low = [0, 1, 2].map((k) => Math.min(...seen.map((p) => p[k])));
      const high = [0, 1, 2].map((k) => Math.max(...seen.map((p) => p[k])));
      const middle = low.map((v, k) => (v + high[k]) / 2);
      this.target = [0, 1, 2].map((k) => rows.reduce((sum, row, i) => sum + row[k] * middle[i], 0));
      this.half = low.map((v, k) => 7 + (high[k] - v) / 2);
      this.reach = Math.hypot(...this.half);
    }

    reset() {
      this.rows = attitude(this.data.attitude);
      this.zoom = 1;
      this.shift = [0, 0];
      this.draw();
    }

    turn(right, up) {
      this.rows = turned(turned(this.rows, 2, 0, right), 2, 1, up);
      this.draw();
    }

    zoomBy(factor) {
      this.zoom = Math.min(40, Math.max(0.3, this.zoom * factor));
      this.draw();
    }

    move(x, y) {
      this.shift = [this.shift[0] + x, this.shift[1] + y];
      this.draw();
    }

    // ---- input

    listen() {
      const { canvas, pointers } = this;
      canvas.addEventListener('pointerdown', (event) => {
        if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, event);
      });
      const release = (event) => {
        pointers.delete(event.pointerId);
        this.draw();
      };
      canvas.addEventListener('pointerup', release);
      canvas.addEventListener('pointercancel', release);
      canvas.addEventListener('pointermove', (event) => this.drag(event));
      canvas.addEventListener('dblclick', () => this.reset());
      canvas.addEventListener('keydown', (event) => this.key(event));
      // The wheel belongs to the page until the view has been clicked; Ctrl, which pinching on a
      // touchpad reports, always zooms.
      canvas.addEventListener('wheel', (event) => {
        if (!event.ctrlKey && document.activeElement !== canvas) return;
        event.preventDefault();
        this.zoomBy(Math.exp(-0.0015 * event.deltaY * (event.ctrlKey ? 6 : 1)));
      }, { passive: false });
      new ResizeObserver(() => this.draw()).observe(canvas);
      DARK.addEventListener('change', () => this.draw());
    }

    // One pointer turns, or moves with Shift; two zoom, move and roll.
    drag(event) {
      const before = this.pointers.get(event.pointerId);
      if (!before) return;
      const others = [...this.pointers.values()].filter((p) => p.pointerId !== event.pointerId);
      this.pointers.set(event.pointerId, event);
      const [x, y] = [event.clientX - before.clientX, event.clientY - before.clientY];
      if (others.length === 0) {
        if (event.shiftKey) this.move(x, y);
        else this.turn(0.008 * x, -0.008 * y);
        return;
      }
      const from = (p) => [p.clientX - others[0].clientX, p.clientY - others[0].clientY];
      const [a, b] = [from(before), from(event)];
      this.rows = turned(this.rows, 0, 1, Math.atan2(a[1], a[0]) - Math.atan2(b[1], b[0]));
      this.shift = [this.shift[0] + x / 2, this.shift[1] + y / 2];
      this.zoomBy(Math.hypot(...b) / Math.max(1, Math.hypot(...a)));
    }

    key(event) {
      const actions = {
        ArrowLeft: () => (event.shiftKey ? this.move(-20, 0) : this.turn(-STEP, 0)),
        ArrowRight: () => (event.shiftKey ? this.move(20, 0) : this.turn(STEP, 0)),
        ArrowUp: () => (event.shiftKey ? this.move(0, -20) : this.turn(0, STEP)),
        ArrowDown: () => (event.shiftKey ? this.move(0, 20) : this.turn(0, -STEP)),
        '+': () => this.zoomBy(1.2), '=': () => this.zoomBy(1.2), '-': () => this.zoomBy(1 / 1.2),
        0: () => this.reset(), Home: () => this.reset(),
      };
      const act = actions[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    }

    // ---- drawing

    // Asks for one drawing in the next frame.
    draw() {
      if (this.asked) return;
      this.asked = true;
      requestAnimationFrame(() => {
        this.asked = false;
        this.render();
      });
    }

    // A point of the lab as the camera sees it.
    see(x, y, z) {
      const p = [x - this.target[0], y - this.target[1], z - this.target[2]];
      return this.rows.map((row) => dot(row, p));
    }

    direction(v) {
      return this.rows.map((row) => dot(row, v));
    }

    render() {
      const { canvas, context } = this;
      const [w, h] = [canvas.clientWidth, canvas.clientHeight];
      if (w === 0 || h === 0) return;
      const began = performance.now();
      // Twice as fine as the page when still, for smooth edges; as fine while a slow one is moved.
      const ratio = this.pointers.size > 0 && this.slow ? 1 : 2;
      if (canvas.width !== w * ratio || canvas.height !== h * ratio) {
        [canvas.width, canvas.height] = [w * ratio, h * ratio];
      }
      this.perNm = this.zoom * Math.min(0.5 * w / this.half[0], 0.5 * (h - 40) / this.half[1]);
      this.centre = [w / 2 + this.shift[0], (h - 30) / 2 + this.shift[1]];
      Raster.begin(context, canvas.width, canvas.height, ratio * this.perNm,
        this.centre.map((v) => ratio * v), this.reach);
      const palette = colours();
      if (this.compare.getAttribute('aria-pressed') === 'true') this.lines();
      else this.bodies(palette);
      Raster.end(context);
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      this.overlay(w, h, css(palette.ink));
      context.setTransform(1, 0, 0, 1, 0, 0);
      this.explain(palette);
      this.slow = performance.now() - began > 25;
      canvas.dataset.drawn = String(Number(canvas.dataset.drawn || 0) + 1);
    }

    // Whether the small things are large enough to be told apart.
    get fine() {
      return this.perNm >= FINE;
    }

    // The chosen state: monomers, rods, junctions, linkers, held ends.
    bodies(palette) {
      const { state } = this;
      for (const strand of state.strands) this.strand(strand, palette);
      for (const rod of state.rods) this.rod(rod, palette);
      for (const bond of state.junctions) {
        Raster.line(this.ends(bond), 0.55, palette.edge, THROUGH, 5);
        Raster.line(this.ends(bond), 0.32, palette.junction, THROUGH + 0.5, 3);
      }
      for (const linker of state.linkers) Raster.line(this.ends(linker), 0.3, palette.linker, THROUGH);
      for (const anchor of state.anchors) {
        Raster.ball(this.see(...anchor), Math.max(1.3, 3 / this.perNm), palette.anchor, THROUGH);
      }
      for (const c of state.clamps) {
        const corners = [0, 3, 6, 9, 0].map((i) => this.see(c[i], c[i + 1], c[i + 2]));
        Raster.line(corners, 0.5, palette.clamp);
      }
    }

    // Monomers, and the bonds from each to the next and to the one after. Bonds are kept in 0.01 nm,
    // in the frames of both monomers.
    strand({ monomers, semi_axes: lengths, first, bonds }, palette) {
      const bodies = monomers.map(([x, y, z, ...q]) => (
        { centre: this.see(x, y, z), axes: axes(...q).map((axis) => this.direction(axis)) }));
      bodies.forEach(({ centre, axes: frame }, i) => {
        const semiAxes = frame.map((axis, k) => axis.map((v) => v * lengths[k]));
        Raster.ellipsoid(centre, semiAxes, i % 2 ? palette.other : palette.monomer);
      });
      if (!this.fine) return;
      const place = (body, anchor) => body.centre.map((v, k) => v + 0.01
        * (anchor[0] * body.axes[0][k] + anchor[1] * body.axes[1][k] + anchor[2] * body.axes[2][k]));
      bodies.forEach((lower, i) => (this.data.bonds[bonds][first + i] || []).forEach((ends, kind) => {
        const upper = bodies[i + 1 + kind];
        if (!upper) return;
        for (let at = 0; at < ends.length; at += 6) {
          const [from, to] = [ends.slice(at, at + 3), ends.slice(at + 3, at + 6)];
          Raster.line([place(lower, from), place(upper, to)], 0.06, palette.bonds[kind], ON_SURFACE, 1.2);
        }
      }));
    }

    // A rod with its stripe; through it its centre line, its nodes, and the axes of its segments.
    rod({ nodes, frames }, palette) {
      const places = nodes.map((p) => this.see(...p));
      const turned = frames.map((q) => axes(...q).map((axis) => this.direction(axis)));
      Raster.rod(places, turned.map((t) => t[0]), turned.map((t) => t[1]), this.state.rod_radius,
        { body: palette.rod, stripe: palette.stripe, seam: palette.seam });
      Raster.line(places, 0.15, palette.line, THROUGH - 1);
      for (const node of places) Raster.ball(node, Math.max(0.45, 1.8 / this.perNm), palette.node, THROUGH - 0.5);
      if (!this.fine) return;
      turned.forEach((frame, i) => {
        const middle = places[i].map((v, k) => (v + places[i + 1][k]) / 2);
        frame.forEach((axis, k) => Raster.line(
          [middle, middle.map((v, j) => v + AXIS * axis[j])], 0.18, palette.axes[k], THROUGH - 0.8, 2));
      });
    }

    ends(pair) {
      return [this.see(...pair.slice(0, 3)), this.see(...pair.slice(3))];
    }

    // The centre lines of the whole group.
    lines() {
      for (const state of this.members) {
        for (const line of state.lines) {
          const points = line.map((p) => this.see(...p));
          Raster.line(points, 0.5, resolution(state.share), 0, 2.4);
        }
      }
    }

    // Forces, scale bar and axes, above the bodies.
    overlay(w, h, ink) {
      const { context } = this;
      Object.assign(context, {
        strokeStyle: ink, fillStyle: ink, lineWidth: 2, lineCap: 'round',
        font: '13px system-ui, sans-serif', textBaseline: 'middle', textAlign: 'center',
      });
      for (const f of this.state.forces) this.force(f);
      context.lineWidth = 2;
      const length = niceLength(130 / this.perNm), bar = length * this.perNm, y = h - 14;
      this.path([[14, y - 4], [14, y], [14 + bar, y], [14 + bar, y - 4]]);
      context.textAlign = 'left';
      context.fillText(`${length} nm`, 14, y - 14);
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

    // An arrow where a force acts, of one length for all, with the force in words.
    force([x, y, z, ...f]) {
      const size = Math.hypot(...f), at = this.pixel(this.see(x, y, z));
      const seen = this.direction(f).map((v) => v / size);
      const tip = [at[0] + 52 * seen[0], at[1] - 52 * seen[1]];
      this.context.lineWidth = 3;
      this.path([at, tip]);
      const across = Math.hypot(seen[0], seen[1]);
      if (across > 0.1) {
        const u = [seen[0] / across, -seen[1] / across];
        const head = (side) => [tip[0] - 9 * u[0] + side * 5 * u[1], tip[1] - 9 * u[1] - side * 5 * u[0]];
        this.path([head(1), tip, head(-1)]);
      }
      const inside = Math.min(this.canvas.clientWidth - 26, Math.max(26, tip[0] + 30 * seen[0]));
      this.context.fillText(`${Number(size.toPrecision(3))} pN`, inside, tip[1] + 4 - 16 * seen[1]);
    }

    pixel([x, y]) {
      return [this.centre[0] + this.perNm * x, this.centre[1] - this.perNm * y];
    }

    path(points) {
      this.context.beginPath();
      points.forEach(([x, y]) => this.context.lineTo(x, y));
      this.context.stroke();
    }

    // The legend: what there is in the chosen state, or the states that are compared.
    explain(palette) {
      const { state } = this;
      const fine = Number(this.fine);
      const entries = this.compare.getAttribute('aria-pressed') === 'true'
        ? this.members.map((s) => [s.name, resolution(s.share)])
        : [
          [state.strands.length, 'monomers, every other one lighter', palette.monomer],
          [fine * state.strands.length, `lateral bonds, ${this.sample()}`, palette.bonds[0]],
          [fine * state.strands.length, `longitudinal bonds, ${this.sample()}`, palette.bonds[1]],
          [state.rods.length, 'rod', palette.rod],
          [state.rods.length, 'd1 on its surface, both sides', palette.stripe],
          [state.rods.length, 'its centre line', palette.line],
          [state.rods.length, 'nodes', palette.node],
          ...['d1', 'd2', 'd3'].map((name, k) =>
            [fine * state.rods.length, `${name} of segments`, palette.axes[k]]),
          [state.junctions.length, 'bonds of the junction', palette.junction],
          [state.linkers.length, 'linkers', palette.linker],
          [state.anchors.length, 'anchors', palette.anchor],
          [state.clamps.length, 'held ends', palette.clamp],
          [1 - fine, 'Bonds between monomers and axes of segments show from nearer.', null],
        ].filter(([count]) => count > 0).map(([, ...entry]) => entry);
      const text = JSON.stringify(entries);
      if (text === this.explained) return;
      this.explained = text;
      this.legend.replaceChildren(...entries.map(([name, colour]) => {
        const item = document.createElement('li'), swatch = document.createElement('span');
        if (colour) {
          swatch.style.background = css(colour);
          item.append(swatch);
        }
        item.append(name);
        return item;
      }));
    }

    // How many bonds of an interface are drawn.
    sample() {
      if (this.state.strands.length === 0) return '';
      const [{ bonds, first, per_interface: all }] = this.state.strands;
      const count = (this.data.bonds[bonds][first] || [[]])[0].length / 6;
      return count < all ? `${count} of ${all} an interface` : 'all';
    }
  }

  // The largest of 1, 2, 5, 10, ... that is not longer.
  function niceLength(most) {
    const power = 10 ** Math.floor(Math.log10(most));
    return power * [5, 2, 1].find((digit) => digit * power <= most);
  }

  document.querySelectorAll('figure.viewer').forEach((figure) => new View(figure));
})();
