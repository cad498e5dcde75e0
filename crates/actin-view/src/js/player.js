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

  // Returns record t as a pose. Orientations are converted when they are read.
  function poseOf(t) {
    const at = (from, to) => places.subarray(3 * (run.points * t + from), 3 * (run.points * t + to));
    const turned = ({ start, end }) => Float32Array.from(
      turns.subarray(4 * (run.frames * t + start), 4 * (run.frames * t + end)), (v) => v / 32767);
    const point = (i) => [...at(i, i + 1)];
    const many = (all, count, each) => Array.from({ length: count },
      (_, i) => [...all.subarray(each * (count * t + i), each * (count * t + i + 1))]);
    const held = many(linkers, run.anchored.length, 8);
    return {
      strands: run.strands.map((s) => ({
        ...s, places: at(s.points.start, s.points.end), get turns() { return turned(s.frames); } })),
      rods: run.rods.map((r) => ({
        ...r, nodes: at(r.points.start, r.points.end), get frames() { return turned(r.frames); } })),
      junctions: run.junctions.map(([a, b]) => [...point(a), ...point(b)]),
      linkers: held.filter((l) => l[6] > 0).map((l) => [...l.slice(0, 6), l[7]]),
      anchors: held.filter((l, i) => run.anchored[i]).map((l) => l.slice(3, 6)),
      clamps: many(clamps, run.held, 12),
      forces: run.forces[t],
      outlines: [...run.walls, run.box[t]],
      beads: run.beads[t],
    };
  }

  // ---- bodies

  // Filament of a point.
  const filamentOf = (i) => run.spans.findIndex(({ start, end }) => i >= start && i < end);
  const pointAt = (i) => places.subarray(3 * (run.points * record + i), 3 * (run.points * record + i) + 3);
  const valueOf = (field, i) => field.low + ((field.high - field.low) / 65535) * field.values[run.points * record + i];

  // Body nearest to a pixel: { point } or { linker }, with its place and distance (pixels).
  function nearest([x, y], most = 14) {
    let best = { distance: most };
    const near = (place, body, handicap) => {
      const [px, py] = space.pixel(space.see(...place)), distance = Math.hypot(px - x, py - y) + handicap;
      if (distance < best.distance) best = { distance, place: [...place], ...body };
    };
    for (let i = 0; i < run.points; i++) near(pointAt(i), { point: i }, 0);
    for (const linker of pose.linkers) near([0, 1, 2].map((k) => (linker[k] + linker[k + 3]) / 2), { linker }, 4);
    return best.place ? best : null;
  }

  // Name of a point, and lines with its fields.
  function described(i) {
    const kind = run.strands.some(({ points: { start, end } }) => i >= start && i < end) ? 'monomer' : 'node';
    const name = `${run.filaments > 1 ? `filament ${filamentOf(i)}, ` : ''}${kind} at s = ${Bodies.short(arcs[i])} nm`;
    return [name, ...fields.map((field) => `${field.name}: ${Bodies.short(valueOf(field, i))} ${field.unit}`)];
  }

  // ---- colours and visible parts

  const space = new Space(query('#space'), { ownsWheel: true });
  const slider = query('#slider'), playing = query('#play'), paint = query('#paint'), clock = query('#clock');
  let record = -1, pose = null, place = 0, selected = null, entries = [], followedAt = 0;

  // Colour scale of a field.
  const stops = (field) => (field.signed ? Bodies.shades().signed : Bodies.shades().rising);
  // Many filaments have colours of a scale by their number, few have distinct colours.
  const isMany = run.filaments > Bodies.shades().lines.length;
  const ofFilament = (k) => (isMany ? Bodies.along(Bodies.shades().rising, k / (run.filaments - 1)) : Bodies.shades().lines[k]);
  const BY_FILAMENT = { name: 'filament', unit: 'number', low: 0, high: run.filaments - 1 };
  let tension = 0, strongest = 0;
  for (let i = 7; i < linkers.length; i += 8) if (linkers[i - 1] > 0) tension = Math.max(tension, Math.abs(linkers[i]));
  for (const f of run.forces.flat()) strongest = Math.max(strongest, Math.hypot(f[3], f[4], f[5]));
  const TENSION = { name: 'tension of linkers', unit: 'pN', low: -tension, high: tension, signed: true };

  // Scale of the selected colouring, if any.
  function scale() {
    const choice = paint.value;
    if (choice === 'filament') return isMany ? BY_FILAMENT : undefined;
    return choice === 'tension' ? TENSION : fields[Number(choice)];
  }

  // Selected colouring.
  function tint() {
    const choice = paint.value;
    if (choice === 'kind' || choice === 'tension') return null;
    if (choice === 'filament') {
      const all = Array.from({ length: run.filaments }, (_, k) => ofFilament(k));
      return (part) => all[part.filament];
    }
    const field = fields[Number(choice)], table = Array.from({ length: 256 },
      (_, k) => Bodies.along(stops(field), k / 255));
    const base = run.points * record;
    return (part, i) => table[field.values[base + part.points.start + i] >> 8];
  }

  function legend() {
    if (!pose) return;
    const choice = paint.value;
    const filaments = choice === 'filament' && !isMany
      ? Array.from({ length: run.filaments }, (_, i) => [1, `filament ${i}`, ofFilament(i)]) : null;
    entries = Bodies.legend(pose, {
      level: space.level, sample: Bodies.sample(pose, run.bonds), isTinted: !['kind', 'tension'].includes(choice), filaments });
    Bodies.explain(query('#legend'), entries);
    const bar = query('#bar'), field = scale();
    bar.hidden = !field;
    if (!field) return;
    const [low, middle, high] = bar.querySelectorAll('span');
    bar.firstElementChild.style.background = `linear-gradient(90deg, ${stops(field).map(Bodies.css).join(',')})`;
    low.textContent = Bodies.short(field.low);
    middle.textContent = `${field.name} (${field.unit})`;
    high.textContent = Bodies.short(field.high);
  }

  function put() {
    const pullOf = paint.value === 'tension' ? (pN) => Bodies.along(stops(TENSION), 0.5 + pN / (2 * tension)) : null;
    Bodies.put(space, pose, { bonds: run.bonds, tintOf: tint(), pullOf, strongest });
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
    if (space.isThere) {
      put();
      follow();
    }
    // During a slow playback, charts follow twice a second: their redrawing takes as long as the view.
    const now = performance.now();
    if (began === null || !space.slow || now - followedAt > 500) {
      charts.forEach((chart) => chart.follow());
      followedAt = now;
    }
    document.body.dataset.record = String(record);
  }

  // ---- selection

  // Keeps the selected body in the middle and marks it.
  function follow() {
    space.marks = selected === null ? [] : [[...pointAt(selected)]];
    if (selected !== null) space.centreOn(pointAt(selected));
    query('#followed').textContent = selected === null ? '' : `Following ${described(selected).join(' · ')} (Esc ends)`;
  }

  function select(body) {
    selected = body && body.point !== undefined ? body.point : null;
    if (selected !== null) space.shift = [0, 0];
    follow();
    space.draw();
    charts.forEach((chart) => chart.follow());
  }

  function hover(event) {
    const tip = query('#tip'), at = space.at(event), body = space.pointers.size === 0 && space.perNm ? nearest(at) : null;
    tip.hidden = !body;
    if (!body) return;
    const lines = body.linker ? ['linker', `tension: ${Bodies.short(body.linker[6])} pN`] : described(body.point);
    tip.replaceChildren(...lines.map((text) => Object.assign(document.createElement('div'), { textContent: text })));
    const { clientWidth, offsetTop } = space.canvas;
    tip.style.left = `${Math.max(0, Math.min(at[0] + 14, clientWidth - tip.offsetWidth - 4))}px`;
    tip.style.top = `${offsetTop + at[1] + 14}px`;
  }

  // ---- pictures and films

  // Copies the view with background, clock and legend.
  function compose(copy) {
    const { canvas } = space, context = copy.getContext('2d'), unit = copy.width / canvas.clientWidth;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = getComputedStyle(canvas).backgroundColor;
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(canvas, 0, 0, copy.width, copy.height);
    context.setTransform(unit, 0, 0, unit, 0, 0);
    Object.assign(context, { font: '13px system-ui, sans-serif', textBaseline: 'middle' });
    const field = scale(), bar = field ? [[`${field.name}: ${Bodies.short(field.low)} to ${Bodies.short(field.high)} ${field.unit}`]] : [];
    [[clock.textContent], ...bar, ...entries.filter(([, colour]) => colour)].forEach(([text, colour], i) => {
      if (colour) {
        context.fillStyle = Bodies.css(colour);
        context.fillRect(14, 15 + 19 * i, 14, 11);
      }
      context.fillStyle = Bodies.css(space.ink());
      context.fillText(text, colour ? 34 : 14, 21 + 19 * i);
    });
    if (!field) return;
    stops(field).forEach((colour, k, all) => {
      context.fillStyle = Bodies.css(colour);
      context.fillRect(14 + (120 / all.length) * k, 48, 120 / all.length, 8);
    });
  }

  function save(blob, name) {
    const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
    link.click();
    document.body.dataset.saved = `${name} ${blob.size}`;
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }

  const copyOf = ({ width, height }) => Object.assign(document.createElement('canvas'), { width, height });
  const fileName = () => document.title.replace(/[^\w-]+/g, '-').slice(0, 60);

  function savePicture() {
    space.render(true);
    const copy = copyOf(space.canvas);
    compose(copy);
    copy.toBlob((blob) => save(blob, `${fileName()}.png`));
  }

  let filming = null;

  // Records the playback from the first record to the last as WebM.
  function film() {
    if (filming) {
      pause();
      return;
    }
    const copy = copyOf({ width: 2 * space.canvas.clientWidth, height: 2 * space.canvas.clientHeight }), chunks = [];
    const recorder = new MediaRecorder(copy.captureStream(30), { mimeType: 'video/webm', videoBitsPerSecond: 1.2e7 });
    recorder.addEventListener('dataavailable', ({ data }) => chunks.push(data));
    recorder.addEventListener('stop', () => save(new Blob(chunks, { type: 'video/webm' }), `${fileName()}.webm`));
    show(0);
    filming = { copy, recorder };
    query('#film').setAttribute('aria-pressed', 'true');
    compose(copy);
    recorder.start();
    play();
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
    charts.forEach((chart) => chart.follow());
    if (!filming) return;
    filming.recorder.stop();
    filming = null;
    query('#film').setAttribute('aria-pressed', 'false');
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
      Object.assign(this, { box, choices });
      this.menu = menu;
      this.chart = new Curves.Chart(box, { label, choose });
      menu.addEventListener('change', () => this.change());
    }

    get choice() {
      return this.choices[Number(this.menu.value)];
    }
  }

  const MOST_LINES = 40; // largest number of filaments with a curve

  // Curve of a number over time.
  class InTime extends Panel {
    change() {
      const { at, values, name } = this.choice, positive = values.filter((v) => v > 0);
      const isLog = name.includes('residual') && positive.length > 2
        && positive.length > 0.8 * values.length && Math.max(...positive) > 300 * Math.min(...positive);
      const y = isLog ? values.map((v) => (v > 0 ? v : NaN)) : values;
      this.chart.show([{ x: at, y }], { isLog, across: run.unit ? 'time (ns)' : 'path parameter' });
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
      const field = this.choice, base = run.points * record, count = run.filaments;
      const step_ = (field.high - field.low) / 65535, chosen = selected === null || count === 1 ? -1 : filamentOf(selected);
      const which = Array.from({ length: Math.min(MOST_LINES, count) }, (_, i) => Math.floor((i * count) / Math.min(MOST_LINES, count)));
      if (chosen >= 0) which.push(chosen);
      const all = which.map((k) => ({
        x: arcs.subarray(run.spans[k].start, run.spans[k].end),
        y: Float32Array.from(
          field.values.subarray(base + run.spans[k].start, base + run.spans[k].end), (v) => field.low + step_ * v),
        colour: count > 1 ? Bodies.css(ofFilament(k)) : '', faded: chosen >= 0 && k !== chosen,
      }));
      this.chart.show(all, { range: [field.low, field.high], across: 'arc length s (nm)' });
      this.value.textContent = chosen >= 0 ? `filament ${chosen}` : count > MOST_LINES ? `${MOST_LINES} of ${count} filaments` : '';
      if (count > 1) this.explain();
    }

    // Legend of the filaments.
    explain() {
      if (!this.key) {
        this.key = Object.assign(document.createElement('ul'), { className: 'legend key' });
        this.box.append(this.key);
      }
      const some = isMany ? [0, 0.25, 0.5, 0.75, 1].map((share) => Math.round(share * (run.filaments - 1)))
        : Array.from({ length: run.filaments }, (_, k) => k);
      Bodies.explain(this.key, some.map((k) => [`${k === some[0] ? 'filament ' : ''}${k}`, ofFilament(k)]));
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
    ...fields.map(({ name }, i) => new Option(`by ${name}`, i)), ...(tension > 0 ? [new Option('by tension of linkers', 'tension')] : [])]);
  paint.addEventListener('change', put);
  slider.max = String(last);
  slider.addEventListener('input', () => {
    pause();
    show(Number(slider.value));
  });
  playing.addEventListener('click', toggle);
  query('#picture').addEventListener('click', savePicture);
  query('#film').addEventListener('click', film);
  query('#film').hidden = last === 0 || !window.MediaRecorder;
  query('#back').addEventListener('click', () => step(-1));
  query('#forth').addEventListener('click', () => step(1));
  query('#speed').addEventListener('change', (event) => { speed = Number(event.target.value); });
  query('#smaller').addEventListener('click', () => space.zoomBy(1 / 1.3));
  query('#larger').addEventListener('click', () => space.zoomBy(1.3));
  query('#reset').addEventListener('click', () => {
    select(null);
    space.reset();
  });
  for (const [name, towards, up] of [['x', [1, 0, 0], [0, 1, 0]], ['y', [0, 1, 0], [1, 0, 0]], ['z', [0, 0, 1], [0, 1, 0]]]) {
    query(`#along-${name}`).addEventListener('click', () => space.along(towards, up));
  }
  document.addEventListener('keydown', (event) => {
    if (event.target.closest('select, input, button, summary') || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = { ' ': toggle, ',': () => step(-1), '.': () => step(1), Escape: () => select(null) }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  for (const element of document.querySelectorAll('.transport')) element.hidden = last === 0;

  // ---- start at the last record, with all records in view

  if (space.isThere) {
    space.drawn = () => {
      legend();
      if (filming) compose(filming.copy);
    };
    space.picked = (at) => select(nearest(at));
    space.canvas.addEventListener('pointermove', hover);
    space.canvas.addEventListener('pointerleave', () => { query('#tip').hidden = true; });
    const top = () => document.documentElement.style.setProperty('--above', `${query('.stage').offsetTop}px`);
    window.addEventListener('resize', top);
    top();
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
