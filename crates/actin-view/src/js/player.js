// Page of a run: a 3D view of its records, a slider, and synchronised curves.
//
// The element #run contains the data; crates/actin-view/src/run/data.rs describes the format.

(() => {
  'use strict';

  const run = JSON.parse(document.getElementById('run').textContent);
  const query = (selector) => document.querySelector(selector);
  const last = run.at.length - 1;

  // ---- data

  function bytes(text) {
    const words = atob(text), all = new Uint8Array(words.length);
    for (let i = 0; i < words.length; i++) all[i] = words.charCodeAt(i);
    return all.buffer;
  }
  const floats = (text) => new Float32Array(bytes(text));

  const places = floats(run.places), linkers = floats(run.linkers), clamps = floats(run.clamps);
  const turns = new Int16Array(bytes(run.turns));
  const fields = run.fields.map((field) => ({ ...field, values: new Uint16Array(bytes(field.values)) }));
  const arcs = floats(run.arcs);
  const columns = run.curves.map((one) => (
    { ...Curves.named(one.name), at: floats(one.at), values: floats(one.values) }));

  // Returns record t as a pose.
  function poseOf(t) {
    const at = (from, to) => places.subarray(3 * (run.points * t + from), 3 * (run.points * t + to));
    const turned = ({ start, end }) => Float32Array.from(
      turns.subarray(4 * (run.frames * t + start), 4 * (run.frames * t + end)), (v) => v / 32767);
    const point = (i) => [...at(i, i + 1)];
    const many = (all, count, each) => Array.from({ length: count },
      (_, i) => [...all.subarray(each * (count * t + i), each * (count * t + i + 1))]);
    const held = many(linkers, run.anchored.length, 8);
    return {
      strands: run.strands.map((s) => ({ ...s, places: at(s.points.start, s.points.end), turns: turned(s.frames) })),
      rods: run.rods.map((r) => ({ ...r, nodes: at(r.points.start, r.points.end), frames: turned(r.frames) })),
      junctions: run.junctions.map(([a, b]) => [...point(a), ...point(b)]),
      linkers: held.filter((l) => l[6] > 0).map((l) => [...l.slice(0, 6), l[7]]),
      anchors: held.filter((l, i) => run.anchored[i]).map((l) => l.slice(3, 6)),
      clamps: many(clamps, run.held, 12),
      forces: run.forces[t],
    };
  }

  // ---- colours and visible parts

  const space = new Space(query('#space'), { ownsWheel: true });
  const slider = query('#slider'), playing = query('#play'), paint = query('#paint'), clock = query('#clock');
  let record = -1, pose = null, place = 0;

  // Colour scale of a field.
  const SIGNED = [[59, 76, 192], [141, 176, 254], [221, 221, 221], [244, 154, 123], [180, 4, 38]];
  const RISING = [[68, 57, 131], [49, 104, 142], [33, 145, 140], [83, 197, 105], [253, 231, 37]];
  const stops = (field) => (field.signed ? SIGNED : RISING);

  // Selected colouring.
  function tint() {
    const choice = paint.value;
    if (choice === 'kind') return null;
    if (choice === 'filament') {
      const { lines } = Bodies.shades();
      return (part) => lines[part.filament % lines.length];
    }
    const field = fields[Number(choice)], table = Array.from({ length: 256 },
      (_, k) => Bodies.along(stops(field), k / 255));
    const base = run.points * record;
    return (part, i) => table[field.values[base + part.points.start + i] >> 8];
  }

  function legend() {
    if (!pose) return;
    const choice = paint.value, { lines } = Bodies.shades();
    const filaments = choice === 'filament' ? Array.from({ length: run.filaments },
      (_, i) => [1, `filament ${i}`, lines[i % lines.length]]) : null;
    Bodies.explain(query('#legend'), Bodies.legend(pose, {
      isFine: space.isFine, sample: Bodies.sample(pose, run.bonds), isTinted: choice !== 'kind', filaments }));
    const bar = query('#bar'), field = fields[Number(choice)];
    bar.hidden = !field;
    if (!field) return;
    const [low, middle, high] = bar.querySelectorAll('span');
    bar.firstElementChild.style.background = `linear-gradient(90deg, ${stops(field).map(Bodies.css).join(',')})`;
    low.textContent = Bodies.short(field.low);
    middle.textContent = `${field.name} (${field.unit})`;
    high.textContent = Bodies.short(field.high);
  }

  function put() {
    Bodies.put(space, pose, { bonds: run.bonds, tintOf: tint() });
    legend();
  }

  // Shows a record and updates slider, clock and cursors.
  function show(t) {
    const next = Math.min(last, Math.max(0, t));
    if (next === record) return;
    record = next;
    pose = poseOf(record);
    slider.value = String(record);
    const at = run.at[record], which = `record ${run.record[record] + 1} of ${run.records}`;
    const value = Curves.digits(at, (run.at[last] - run.at[0]) || at);
    clock.textContent = run.unit ? `${value} ns` : `path ${value}`;
    clock.title = which;
    query('#record').textContent = last > 0 ? which : '';
    slider.setAttribute('aria-valuetext', `${clock.textContent}, ${which}`);
    if (space.isThere) put();
    charts.forEach((chart) => chart.follow());
    document.body.dataset.record = String(record);
  }

  // ---- playback

  const SECONDS = Math.min(12, Math.max(2.5, 0.12 * (last + 1)));
  let began = null, speed = 1;

  // Converts between records and slider positions, which are proportional to time if available.
  const [first, end] = [run.at[0], run.at[last]];
  const isTimed = run.unit === 'ns' && end > first;
  const shareOf = (t) => (isTimed ? (run.at[t] - first) / (end - first) : t / Math.max(1, last));
  function recordAt(share) {
    if (!isTimed) return Math.round(share * last);
    const at = first + share * (end - first), after = run.at.findIndex((v) => v > at + 1e-9 * (end - first));
    return after < 0 ? last : Math.max(0, after - 1);
  }

  function tick(now) {
    if (began === null) return;
    place = Math.min(1, place + ((now - began) / 1000 / SECONDS) * speed);
    began = now;
    show(recordAt(place));
    if (place >= 1) pause();
    else requestAnimationFrame(tick);
  }

  function play() {
    if (last === 0) return;
    place = record === last ? 0 : shareOf(record);
    began = performance.now();
    space.isMoving = true;
    playing.setAttribute('aria-pressed', 'true');
    playing.setAttribute('aria-label', 'Pause');
    requestAnimationFrame(tick);
  }

  function pause() {
    began = null;
    space.isMoving = false;
    playing.setAttribute('aria-pressed', 'false');
    playing.setAttribute('aria-label', 'Play');
    space.draw();
  }

  const toggle = () => (began === null ? play() : pause());
  const step = (by) => {
    pause();
    show(record + by);
  };

  // ---- curves

  // A chart with a menu of quantities.
  class Panel {
    constructor(box, choices, chosen, { label, choose }) {
      const head = document.createElement('div'), menu = document.createElement('select');
      head.className = 'head';
      menu.setAttribute('aria-label', label);
      menu.append(...choices.map(({ name, unit }, i) => new Option(unit ? `${name} (${unit})` : name, i)));
      menu.value = String(chosen);
      this.value = document.createElement('output');
      head.append(menu, this.value);
      box.append(head);
      this.choices = choices;
      this.menu = menu;
      this.chart = new Curves.Chart(box, { label, choose });
      menu.addEventListener('change', () => this.change());
    }

    get choice() {
      return this.choices[Number(this.menu.value)];
    }
  }

  // Curve of a number over time.
  class InTime extends Panel {
    change() {
      const { at, values, name } = this.choice, positive = values.filter((v) => v > 0);
      const isLog = name.includes('residual') && positive.length > 2
        && positive.length > 0.8 * values.length && Math.max(...positive) > 300 * Math.min(...positive);
      const y = isLog ? values.map((v) => (v > 0 ? v : NaN)) : values;
      this.chart.show([{ x: at, y }], { isLog, across: run.unit ? 'ns' : 'path' });
      this.follow();
    }

    follow() {
      this.chart.point(run.at[record]);
      const { at, unit } = this.choice, span = this.chart.ends ? this.chart.ends.top - this.chart.ends.bottom : 1;
      if (this.chart.lines.length === 0) return;
      const value = this.chart.valueAt(run.at[record]);
      this.value.textContent = Number.isFinite(value)
        ? `${this.chart.isLog ? value.toExponential(2) : Curves.digits(value, span / 10)} ${unit}` : '';
    }
  }

  // Curve of a field along the filaments, in the current record.
  class AlongFilaments extends Panel {
    change() {
      this.follow();
    }

    follow() {
      const field = this.choice, { lines } = Bodies.shades(), base = run.points * record;
      const step_ = (field.high - field.low) / 65535;
      const all = run.spans.map(({ start, end }, k) => ({
        x: arcs.subarray(start, end),
        y: Float32Array.from(field.values.subarray(base + start, base + end), (v) => field.low + step_ * v),
        colour: run.spans.length > 1 ? Bodies.css(lines[k % lines.length]) : '',
      }));
      this.chart.show(all, { range: [field.low, field.high], across: 's (nm)' });
    }
  }

  // Initial quantities: observables, energy, residual.
  function preferred() {
    const find = (test) => columns.findIndex(({ name }) => test(name));
    const wanted = [find((n) => n.includes('[')), find((n) => n === 'elastic'), find((n) => n === 'total'),
      find((n) => n === 'kinetic'), find((n) => n === 'residual force'), 0, 1];
    const there = wanted.filter((i) => i >= 0 && i < columns.length);
    return [...new Set(there)].slice(0, 3);
  }

  const charts = [];
  const panel = () => query('#curves').appendChild(Object.assign(document.createElement('section'), { className: 'panel' }));
  if (last > 0) {
    const choose = (at) => {
      pause();
      const nearest = run.at.reduce((best, v, i) => (Math.abs(v - at) < Math.abs(run.at[best] - at) ? i : best), 0);
      show(nearest);
    };
    preferred().forEach((i) => charts.push(new InTime(panel(), columns, i, { label: 'Curve in time', choose })));
  }
  // One chart along the filament next to curves over time; all fields for a single record.
  fields.slice(0, last > 0 ? 1 : 4).forEach((_, i) => charts.push(
    new AlongFilaments(panel(), fields, i, { label: 'Along the filament' })));
  query('#curves').hidden = charts.length === 0;

  // ---- controls

  paint.append(...[...(run.filaments > 1 ? [new Option('by filament', 'filament')] : []),
    ...fields.map(({ name }, i) => new Option(`by ${name}`, i))]);
  paint.addEventListener('change', put);
  slider.max = String(last);
  slider.addEventListener('input', () => {
    pause();
    show(Number(slider.value));
  });
  playing.addEventListener('click', toggle);
  query('#back').addEventListener('click', () => step(-1));
  query('#forth').addEventListener('click', () => step(1));
  query('#speed').addEventListener('change', (event) => { speed = Number(event.target.value); });
  query('#smaller').addEventListener('click', () => space.zoomBy(1 / 1.3));
  query('#larger').addEventListener('click', () => space.zoomBy(1.3));
  query('#reset').addEventListener('click', () => space.reset());
  for (const [name, towards, up] of [['x', [1, 0, 0], [0, 1, 0]], ['y', [0, 1, 0], [1, 0, 0]], ['z', [0, 0, 1], [0, 1, 0]]]) {
    query(`#along-${name}`).addEventListener('click', () => space.along(towards, up));
  }
  document.addEventListener('keydown', (event) => {
    if (event.target.closest('select, input, button, summary') || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = { ' ': toggle, ',': () => step(-1), '.': () => step(1) }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  for (const element of document.querySelectorAll('.transport')) element.hidden = last === 0;

  // ---- start at the last record, with all records in view

  if (space.isThere) {
    space.drawn = legend;
    const some = [...new Set([0, 0.25, 0.5, 0.75, 1].map((share) => Math.round(share * last)))];
    const all = some.map((t) => Bodies.places(poseOf(t)));
    const seen = new Float32Array(all.reduce((sum, one) => sum + one.length, 0));
    all.reduce((to, one) => (seen.set(one, to), to + one.length), 0);
    space.frame(run.attitude, seen);
    space.reset();
    Bodies.DARK.addEventListener('change', put);
  }
  show(last);
  charts.forEach((chart) => chart.change());
})();
