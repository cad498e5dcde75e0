// Converts a pose to solids: monomers, rods with frames, junctions, linkers, clamps, forces, walls and beads.
//
// A pose contains flat arrays (nm, lab frame):
//   strands   { lengths, places 3n, turns 4n, tint n or null, filament, first, per_interface, bonds }
//   rods      { radius, nodes 3(n + 1), frames 4n, tint n + 1 or null, filament }
//   junctions [6 numbers], linkers [6, or 7 with the tension in pN], anchors [3], clamps [12], forces [6],
//   outlines [corners of a line, each 3], beads [4, the last is the radius]
// Colours are read from the element #palette and follow the light or dark mode of the page.

const Bodies = (() => {
  'use strict';

  const PALETTE = JSON.parse(document.getElementById('palette').textContent);
  const THROUGH = 8; // depth offset of parts visible through bodies (nm)
  const ON_SURFACE = 1.2; // depth offset of parts between bodies (nm)
  const AXIS = 5; // length of the axes of segments (nm)
  const DARK = window.matchMedia('(prefers-color-scheme: dark)');
  const LABELLED = 12; // number of labelled linkers, those with the largest tension
  const { axesOf } = Solids;

  // ---- colours

  // Colours for the current mode of the page.
  const shades = () => (DARK.matches ? PALETTE.dark : PALETTE.light);
  const lighter = (rgb, share) => rgb.map((v) => v + share * (255 - v));
  const css = (rgb) => `rgb(${rgb.map(Math.round).join(',')})`;

  // Interpolates between colour stops.
  function along(stops, share) {
    const place = Math.min(1, Math.max(0, share)) * (stops.length - 1);
    const i = Math.min(Math.floor(place), stops.length - 2), t = place - i;
    return stops[i].map((v, k) => v + t * (stops[i + 1][k] - v));
  }

  // Colour of a fraction of rod.
  const resolution = (share) => along(shades().stops, share);

  // Colours of parts. Evaluated at each drawing, since the mode of the page can change.
  function colours() {
    const { things } = shades(), rod = resolution(1), monomer = resolution(0);
    return {
      monomer, other: lighter(monomer, 0.28), rod: lighter(rod, 0.12), ...things,
      line: rod.map((v) => 0.45 * v), edge: things.junction.map((v) => 0.45 * v), ink: things.force,
    };
  }

  // ---- from a file of states

  const flat = (rows, from, to) => Float32Array.from(rows.flatMap((row) => row.slice(from, to)));

  // Converts a state of a file to a pose.
  function pose(state) {
    return {
      outlines: [],
      beads: [],
      ...state,
      strands: state.strands.map(({ semi_axes: lengths, monomers, ...strand }) => (
        { ...strand, lengths, places: flat(monomers, 0, 3), turns: flat(monomers, 3, 7) })),
      rods: state.rods.map(({ nodes, frames }) => (
        { radius: state.rod_radius, nodes: flat(nodes, 0, 3), frames: flat(frames, 0, 4) })),
    };
  }

  // ---- solids

  const at = (places, i) => places.subarray(3 * i, 3 * i + 3);

  // Shows a pose. `tintOf(part, i)` returns the colour of monomer or node i of a strand or rod, `pullOf(pN)` of a linker;
  // `bonds` are the bonds of the file.
  function put(space, from, { bonds = [], tintOf = null, pullOf = null, strongest = 0 } = {}) {
    space.show((batch, level) => {
      const palette = colours(), drawing = { batch, palette, bonds, tintOf, isFine: level === 'fine' };
      const linker = (ends) => (pullOf && ends.length > 6 ? pullOf(ends[6]) : palette.linker);
      if (level === 'far') putStrips(drawing, from, linker);
      else putBodies(drawing, from, linker);
      for (const anchor of from.anchors) batch.ball(anchor, 1.3, palette.anchor, THROUGH, 3);
      for (const c of from.clamps) {
        const corners = [0, 3, 6, 9, 0].map((i) => [c[i], c[i + 1], c[i + 2]]);
        batch.line(corners, 0.5, palette.clamp);
      }
      for (const line of from.outlines) batch.line(line, 0.2, palette.wall, 0, 1.6);
      for (const bead of from.beads) batch.ball(bead.slice(0, 3), bead[3], palette.bead);
    });
    const size = (f) => Math.hypot(f[3], f[4], f[5]), most = strongest || Math.max(...from.forces.map(size));
    space.ink = () => colours().ink;
    space.arrows = from.forces.map((f) => [...f.slice(0, 6), `${force(size(f))} pN`, size(f) / most]);
    space.labels = pulls(from.linkers);
  }

  // Centre lines and linkers at small scales.
  function putStrips({ batch, palette, tintOf }, from, linker) {
    const tint = (part, i, otherwise) => (tintOf ? tintOf(part, i) : otherwise);
    for (const strand of from.strands) {
      const { places } = strand, count = places.length / 3;
      let before = null;
      for (let i = 0; i + 1 < count; i++) {
        const middle = [0, 1, 2].map((k) => (places[3 * i + k] + places[3 * i + 3 + k]) / 2);
        if (before) batch.strip(before, middle, 3.5, 2.6, tint(strand, i - 1, palette.monomer), tint(strand, i, palette.monomer));
        before = middle;
      }
    }
    for (const rod of from.rods) {
      const count = rod.nodes.length / 3;
      for (let i = 0; i + 1 < count; i++) {
        batch.strip(at(rod.nodes, i), at(rod.nodes, i + 1), rod.radius, 2.4, tint(rod, i, palette.rod), tint(rod, i + 1, palette.rod));
      }
    }
    for (const ends of from.linkers) {
      batch.strip(ends.slice(0, 3), ends.slice(3, 6), 0.5, 1.8, linker(ends), linker(ends));
    }
  }

  function putBodies(drawing, from, linker) {
    const { batch, palette } = drawing;
    for (const strand of from.strands) putStrand(drawing, strand);
    for (const rod of from.rods) putRod(drawing, rod);
    for (const bond of from.junctions) {
      const ends = [bond.slice(0, 3), bond.slice(3, 6)];
      batch.line(ends, 0.55, palette.edge, THROUGH, 3.2);
      batch.line(ends, 0.32, palette.junction, THROUGH + 0.5, 1.8);
    }
    for (const ends of from.linkers) {
      const colour = linker(ends);
      batch.line([ends.slice(0, 3), ends.slice(3, 6)], 0.3, colour, THROUGH, 1.8);
      for (const k of [0, 3]) batch.ball(ends.slice(k, k + 3), 0.7, colour, THROUGH, 2);
    }
  }

  // Tension of each linker, at its middle.
  function pulls(linkers) {
    const middle = (ends) => [0, 1, 2].map((k) => (ends[k] + ends[k + 3]) / 2);
    const known = linkers.filter((ends) => ends.length > 6).sort((a, b) => Math.abs(b[6]) - Math.abs(a[6]));
    return known.slice(0, LABELLED).map((ends) => [...middle(ends), `${force(ends[6])} pN`]);
  }

  // Monomers; when magnified, their bonds, stored in 0.01 nm in the body frames.
  function putStrand({ batch, palette, bonds, tintOf, isFine }, strand) {
    const { places, turns, lengths, first } = strand, count = places.length / 3;
    const colourOf = (i) => (tintOf ? tintOf(strand, i) : i % 2 ? palette.other : palette.monomer);
    for (let i = 0; i < count; i++) batch.ellipsoid(places, 3 * i, turns, 4 * i, lengths, colourOf(i));
    const set = bonds[strand.bonds];
    if (!set || !isFine) return;
    const frames = Array.from({ length: count }, (_, i) => axesOf(turns, 4 * i));
    const place = (i, a) => [0, 1, 2].map((k) => places[3 * i + k] + 0.01
      * (a[0] * frames[i][0][k] + a[1] * frames[i][1][k] + a[2] * frames[i][2][k]));
    for (let i = 0; i < count; i++) {
      (set[first + i] || []).forEach((ends, kind) => {
        const upper = i + 1 + kind;
        for (let k = 0; k < ends.length && upper < count; k += 6) {
          const both = [place(i, ends.slice(k, k + 3)), place(upper, ends.slice(k + 3, k + 6))];
          batch.line(both, 0.06, palette.bonds[kind], ON_SURFACE, 1.2);
        }
      });
    }
  }

  // A rod with a stripe, its centre line and nodes; when magnified, the axes of its segments.
  function putRod({ batch, palette, tintOf, isFine }, rod) {
    const { nodes, frames, radius } = rod, count = nodes.length / 3;
    const colourAt = (i) => (tintOf ? tintOf(rod, i) : palette.rod);
    batch.rod(nodes, frames, radius, colourAt, [0.7, 0.55], 2.4);
    if (!isFine) return;
    for (let i = 0; i < count; i++) {
      batch.ball(at(nodes, i), 0.45, palette.node, THROUGH - 0.5, 1.8);
      if (i + 1 === count) continue;
      const middle = [0, 1, 2].map((k) => (nodes[3 * i + k] + nodes[3 * i + 3 + k]) / 2);
      batch.line([at(nodes, i), at(nodes, i + 1)], 0.15, palette.line, THROUGH - 1);
      axesOf(frames, 4 * i).forEach((axis, k) => batch.line(
        [middle, middle.map((v, j) => v + AXIS * axis[j])], 0.18, palette.axes[k], THROUGH - 0.8, 2));
    }
  }

  // All positions of a pose, for the camera.
  function places(from) {
    const ends = [...from.linkers, ...from.junctions].flatMap((l) => [l.slice(0, 3), l.slice(3, 6)]);
    const clamps = from.clamps.flatMap((c) => [0, 3, 6, 9].map((i) => [...c.slice(i, i + 3)]));
    const bodies = [...from.strands.map((s) => s.places), ...from.rods.map((r) => r.nodes)];
    const beads = from.beads.flatMap(([x, y, z, r]) => [[x - r, y - r, z - r], [x + r, y + r, z + r]]);
    const loose = [...ends, ...clamps, ...from.anchors, ...from.outlines.flat(), ...beads].flatMap((p) => [...p]);
    const all = new Float32Array(bodies.reduce((sum, b) => sum + b.length, loose.length));
    let to = 0;
    for (const part of [...bodies, loose]) {
      all.set(part, to);
      to += part.length;
    }
    return all;
  }

  // Legend entries of a pose; `sample` is the number of displayed bonds.
  function legend(from, { level, sample = '', isTinted = false, filaments = null }) {
    const palette = colours(), near = Number(level === 'fine'), bodies = Number(level !== 'far');
    const hasBonds = near * Number(sample !== '');
    const kinds = isTinted ? [] : [
      [from.strands.length, bodies ? 'monomers, every other one lighter' : 'monomers', palette.monomer],
      [from.rods.length, 'rod', palette.rod],
      [bodies * from.rods.length, 'd1 on its surface, both sides', lighter(palette.rod, 0.7)],
    ];
    return [
      ...(filaments || kinds),
      [hasBonds * from.strands.length, `lateral bonds, ${sample}`, palette.bonds[0]],
      [hasBonds * from.strands.length, `longitudinal bonds, ${sample}`, palette.bonds[1]],
      [near * from.rods.length, 'its centre line', palette.line],
      [near * from.rods.length, 'nodes', palette.node],
      ...['d1', 'd2', 'd3'].map((name, k) => [near * from.rods.length, `${name} of segments`, palette.axes[k]]),
      [bodies * from.junctions.length, 'bonds of the junction', palette.junction],
      [from.linkers.length, from.linkers.length > LABELLED && from.linkers[0].length > 6
        ? `linkers, the ${LABELLED} largest tensions labelled` : 'linkers', palette.linker],
      [from.anchors.length, 'anchors', palette.anchor],
      [from.clamps.length, 'held ends', palette.clamp],
      [from.outlines.flat().length, 'walls, periodic box', palette.wall],
      [from.beads.length, 'beads', palette.bead],
      [from.forces.length, 'forces, in proportion down to a third', palette.ink],
      [(1 - near) * Number(from.rods.length > 0 || sample !== ''),
        'Bonds between monomers and axes of segments show from nearer.', null],
    ].filter(([count]) => count > 0).map(([, ...entry]) => entry);
  }

  // Updates a legend if it has changed.
  function explain(list, entries) {
    const text = JSON.stringify(entries);
    if (text === list.dataset.text) return;
    list.dataset.text = text;
    list.replaceChildren(...entries.map(([name, colour]) => {
      const item = document.createElement('li'), swatch = document.createElement('span');
      if (colour) {
        swatch.style.background = css(colour);
        item.append(swatch);
      }
      item.append(name);
      return item;
    }));
  }

  // Text for the number of displayed bonds of an interface.
  function sample({ strands }, bonds) {
    if (strands.length === 0) return '';
    const [{ bonds: set, first, per_interface: all }] = strands;
    if (!bonds[set]) return '';
    const count = (bonds[set][first] || [[]])[0].length / 6;
    return count < all ? `${count} of ${all} an interface` : 'all';
  }

  // Formats a force (pN), zero up to round-off.
  const force = (pn) => (Math.abs(pn) < 1e-4 ? '0' : short(pn));
  // Formats a number with three digits.
  const short = (x) => String(Number(x.toPrecision(3)));

  return { pose, put, places, legend, explain, sample, resolution, along, colours, shades, css, lighter, short, DARK };
})();
