// Line chart with a cursor, as SVG in the colours of the page.

const Curves = (() => {
  'use strict';

  const SVG = 'http://www.w3.org/2000/svg';
  const [LEFT, RIGHT, TOP, BOTTOM] = [52, 14, 8, 38];
  // Suffixes of column names, and their units.
  const UNITS = [['_pn_nm', 'pN nm'], ['_rad_per_nm', 'rad/nm'], ['_nm_per_ns', 'nm/ns'], ['_pn', 'pN'],
    ['_nm2', 'nm²'], ['_nm', 'nm'], ['_rad', 'rad'], ['_deg', '°'], ['_turns', 'turns'], ['_k', 'K']];

  // Splits `tip[0]_x_nm` into name and unit.
  function named(column) {
    const [end, unit] = UNITS.find(([suffix]) => column.endsWith(suffix)) || ['', ''];
    return { name: column.slice(0, column.length - end.length).replaceAll('_', ' '), unit };
  }

  function make(name, attributes, parent) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (parent) parent.append(element);
    return element;
  }

  // Formats a power of ten.
  const ten = (power) => `10${[...String(Number(power))].map((c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]).join('')}`;

  // Formats a number with the digits needed to resolve `span`.
  function digits(x, span) {
    if (x === 0) return '0';
    if (Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3) {
      const [digits_, power] = x.toExponential(1).split('e');
      return `${digits_}·${ten(power)}`;
    }
    return String(Number(x.toFixed(Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(span || 1)))))));
  }

  // Tick positions between two ends, in steps of 1, 2 or 5 times a power of ten.
  function ticks(low, high, most) {
    const raw = (high - low) / most || 1, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((digit) => digit * power >= raw);
    const all = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) all.push(k * step);
    return all;
  }

  // A chart in `box`. Lines are { x, y, colour } with arrays of numbers; NaN marks missing values.
  class Chart {
    constructor(box, { label, height = 148, choose = null }) {
      this.svg = make('svg', { class: 'chart', role: 'img', 'aria-label': label, height });
      Object.assign(this, { height, lines: [], at: null, isLog: false, across: '' });
      box.append(this.svg);
      new ResizeObserver(() => this.draw()).observe(box);
      if (!choose) return;
      const pick = (event) => {
        const { left } = this.svg.getBoundingClientRect();
        if (this.x) choose(this.x.back(event.clientX - left));
      };
      this.svg.classList.add('picks');
      this.svg.addEventListener('pointerdown', (event) => {
        if (event.isTrusted) this.svg.setPointerCapture(event.pointerId);
        this.isHeld = true;
        pick(event);
      });
      this.svg.addEventListener('pointermove', (event) => this.isHeld && pick(event));
      for (const end of ['pointerup', 'pointercancel']) this.svg.addEventListener(end, () => { this.isHeld = false; });
    }

    // Shows lines; `range` fixes the y axis, `across` is the label of the x axis.
    show(lines, { isLog = false, range = null, across = '' } = {}) {
      Object.assign(this, { lines, isLog, range, across });
      this.draw();
    }

    // Moves the cursor to x.
    point(at) {
      this.at = at;
      if (!this.cursor || !this.x) return;
      const shown = at !== null && this.lines.length > 0;
      this.cursor.setAttribute('visibility', shown ? 'visible' : 'hidden');
      if (!shown) return;
      this.cursor.setAttribute('transform', `translate(${this.x(at).toFixed(1)} 0)`);
      const value = this.valueAt(at);
      const isThere = Number.isFinite(value);
      this.dot.setAttribute('visibility', isThere ? 'inherit' : 'hidden');
      if (isThere) this.dot.setAttribute('cy', this.y(value).toFixed(1));
    }

    // Interpolates the first line linearly at x.
    valueAt(at) {
      const [{ x, y }] = this.lines;
      let after = x.findIndex((v) => v >= at);
      if (after < 0) after = x.length - 1;
      if (after === 0 || x[after] === x[after - 1]) return y[after];
      const t = Math.min(1, (at - x[after - 1]) / (x[after] - x[after - 1]));
      return t === 1 ? y[after] : y[after - 1] + t * (y[after] - y[after - 1]);
    }

    scales(width) {
      let [low, high, from, to] = [Infinity, -Infinity, Infinity, -Infinity];
      for (const { x, y } of this.lines) {
        for (let i = 0; i < x.length; i++) {
          from = Math.min(from, x[i]);
          to = Math.max(to, x[i]);
          if (!Number.isFinite(y[i])) continue;
          low = Math.min(low, y[i]);
          high = Math.max(high, y[i]);
        }
      }
      if (this.range) [low, high] = this.range;
      if (!(high >= low)) return false;
      const f = this.isLog ? Math.log10 : (v) => v;
      const pad = this.isLog ? 0.05 * (f(high) - f(low)) + 0.05 : 0.06 * (high - low) || 0.5 * Math.abs(high) || 1;
      const [bottom, top] = [f(low) - pad, f(high) + pad];
      const inner = [width - LEFT - RIGHT, this.height - TOP - BOTTOM];
      this.x = (v) => LEFT + (to > from ? (inner[0] * (v - from)) / (to - from) : inner[0] / 2);
      this.x.back = (pixel) => from + ((pixel - LEFT) / inner[0]) * (to - from);
      this.y = (v) => TOP + inner[1] * (1 - (f(v) - bottom) / (top - bottom));
      this.ends = { from, to, bottom, top };
      return true;
    }

    draw() {
      const width = this.svg.parentNode ? this.svg.parentNode.clientWidth : 0;
      if (width < 80) return;
      this.svg.replaceChildren();
      this.svg.setAttribute('viewBox', `0 0 ${width} ${this.height}`);
      this.svg.setAttribute('width', width);
      if (this.lines.length === 0 || !this.scales(width)) return;
      this.grid(width);
      for (const { x, y, colour, faded } of this.lines) {
        let path = '', isDown = false;
        for (let i = 0; i < x.length; i++) {
          if (!Number.isFinite(y[i])) {
            isDown = false;
            continue;
          }
          path += `${isDown ? 'L' : 'M'}${this.x(x[i]).toFixed(1)} ${this.y(y[i]).toFixed(1)}`;
          isDown = true;
        }
        make('path', { d: path, class: 'curve', style: colour ? `stroke:${colour}` : '', opacity: faded ? 0.25 : 1 }, this.svg);
      }
      this.cursor = make('g', { class: 'cursor', visibility: 'hidden' }, this.svg);
      make('line', { y1: TOP, y2: this.height - BOTTOM }, this.cursor);
      this.dot = make('circle', { r: 4 }, this.cursor);
      this.point(this.at);
    }

    grid(width) {
      const { from, to, bottom, top } = this.ends, text = (x, y, words, anchor) => {
        make('text', { x, y, 'text-anchor': anchor }, this.svg).textContent = words;
      };
      const rows = this.isLog ? ticks(Math.ceil(bottom), top, 3).filter(Number.isInteger) : ticks(bottom, top, 3);
      for (const tick of rows) {
        const y = this.y(this.isLog ? 10 ** tick : tick);
        make('line', { x1: LEFT, x2: width - RIGHT, y1: y, y2: y, class: 'grid' }, this.svg);
        text(LEFT - 6, y + 4, this.isLog ? ten(tick) : digits(tick, top - bottom), 'end');
      }
      const foot = this.height - 22;
      for (const tick of ticks(from, to, Math.max(2, Math.floor(width / 64)))) {
        const x = this.x(tick);
        make('line', { x1: x, x2: x, y1: this.height - BOTTOM, y2: this.height - BOTTOM + 4, class: 'grid' }, this.svg);
        text(Math.min(x, width - 4), foot, digits(tick, to - from), x > width - 34 ? 'end' : 'middle');
      }
      text(LEFT + (width - LEFT - RIGHT) / 2, this.height - 6, this.across, 'middle');
    }
  }

  return { Chart, named, digits };
})();
