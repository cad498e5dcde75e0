// Solids into pixels, with a depth for every pixel, so that bodies that reach into one another
// look as they should. Plain arithmetic into an image of a 2D canvas: no WebGL is needed, and a
// hundred monomers take a few milliseconds.
//
// Coordinates are the camera's, in nm: x to the right, y upwards, z towards the viewer. Nothing
// is foreshortened, so lengths across the line of sight hold everywhere and the scale bar is true.
// What is drawn, and when, is decided in viewer.js.

const Raster = (() => {
  'use strict';

  // Towards the light, and halfway between light and viewer.
  const LIGHT = unit([-0.45, 0.6, 0.75]);
  const HALF = unit([LIGHT[0], LIGHT[1], LIGHT[2] + 1]);
  // How much of the farthest body shows through to the page: depth is seen as haze.
  const HAZE = 0.5;

  let width = 0, height = 0, image = null, pixels = null, depth = null;
  let perNm = 1, middleX = 0, middleY = 0, near = 1, far = -1;

  function unit(v) {
    const l = Math.hypot(v[0], v[1], v[2]) || 1;
    return [v[0] / l, v[1] / l, v[2] / l];
  }

  // Begins an image of so many pixels. `scale` is pixels per nm, `centre` the pixel of x = y = 0,
  // `reach` the largest |z| of the scene (nm).
  function begin(context, w, h, scale, centre, reach) {
    if (w !== width || h !== height) {
      [width, height] = [w, h];
      image = context.createImageData(w, h);
      pixels = image.data;
      depth = new Float32Array(w * h);
    }
    pixels.fill(0);
    depth.fill(-Infinity);
    [perNm, middleX, middleY] = [scale, centre[0], centre[1]];
    [near, far] = [reach, -reach];
  }

  // Puts the image onto the canvas.
  function end(context) {
    context.putImageData(image, 0, 0);
  }

  // The pixels of a box about (x, y), half so wide and high (nm): first and last column and row.
  function box(x, y, halfX, halfY) {
    const px = middleX + perNm * x, py = middleY - perNm * y;
    return [
      Math.max(0, Math.floor(px - perNm * halfX)),
      Math.min(width - 1, Math.ceil(px + perNm * halfX)),
      Math.max(0, Math.floor(py - perNm * halfY)),
      Math.min(height - 1, Math.ceil(py + perNm * halfY)),
    ];
  }

  // Colours the pixel number `at` at depth z with normal (nx, ny, nz), if nothing is before it.
  function paint(at, z, nx, ny, nz, colour, nearer) {
    if (z + nearer <= depth[at]) return;
    depth[at] = z + nearer;
    const lit = Math.max(0, nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]);
    const shine = Math.max(0, nx * HALF[0] + ny * HALF[1] + nz * HALF[2]);
    const edge = nz < 0.4 ? 0.55 + 1.125 * nz : 1;
    const bright = (0.46 + 0.6 * lit) * edge;
    const white = 70 * Math.pow(shine, 26);
    const back = Math.min(1, Math.max(0, (near - z) / (near - far)));
    const i = 4 * at;
    pixels[i] = colour[0] * bright + white;
    pixels[i + 1] = colour[1] * bright + white;
    pixels[i + 2] = colour[2] * bright + white;
    pixels[i + 3] = 255 * (1 - HAZE * back);
  }

  // An ellipsoid about c with three semi-axes a (vectors at right angles): the points p with
  // (p - c) M (p - c) = 1, M the sum of a a^T / |a|^4. On a line of sight that is a quadratic in z;
  // the normal is M (p - c).
  function ellipsoid(c, semiAxes, colour, nearer = 0) {
    let xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, halfX = 0, halfY = 0;
    for (const [a, b, d] of semiAxes) {
      const share = 1 / (a * a + b * b + d * d) ** 2;
      xx += share * a * a; xy += share * a * b; xz += share * a * d;
      yy += share * b * b; yz += share * b * d; zz += share * d * d;
      halfX += a * a; halfY += b * b;
    }
    const [left, right, top, bottom] = box(c[0], c[1], Math.sqrt(halfX), Math.sqrt(halfY));
    for (let row = top; row <= bottom; row++) {
      const y = (middleY - row - 0.5) / perNm - c[1];
      for (let column = left; column <= right; column++) {
        const x = (column + 0.5 - middleX) / perNm - c[0];
        const half = xz * x + yz * y;
        const rest = xx * x * x + 2 * xy * x * y + yy * y * y - 1;
        const root = half * half - zz * rest;
        if (root < 0) continue;
        const z = (Math.sqrt(root) - half) / zz;
        const n = unit([xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, half + zz * z]);
        paint(row * width + column, c[2] + z, n[0], n[1], n[2], colour, nearer);
      }
    }
  }

  // A ball.
  function ball(c, r, colour, nearer = 0) {
    ellipsoid(c, [[r, 0, 0], [0, r, 0], [0, 0, r]], colour, nearer);
  }

  // The mantle of a cylinder of radius r about the line from p to q, cut by the planes through p
  // and q across `cuts`. `colourAt(s, n, edge)` is its colour at s nm from p along the axis, where the
  // normal is n and the nearer of both planes is `edge` nm away.
  function mantle(p, q, r, cuts, colourAt, nearer) {
    const along = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
    const u = unit(along);
    const across = 1 - u[2] * u[2];
    if (across < 1e-9) return; // seen from its end: nothing of the mantle shows
    const [left, right, top, bottom] = box(
      p[0] + along[0] / 2, p[1] + along[1] / 2,
      Math.abs(along[0]) / 2 + 1.4 * r, Math.abs(along[1]) / 2 + 1.4 * r);
    for (let row = top; row <= bottom; row++) {
      const y = (middleY - row - 0.5) / perNm - p[1];
      for (let column = left; column <= right; column++) {
        const x = (column + 0.5 - middleX) / perNm - p[0];
        const g = x * u[0] + y * u[1];
        const root = g * g * u[2] * u[2] - across * (x * x + y * y - g * g - r * r);
        if (root < 0) continue;
        const z = (g * u[2] + Math.sqrt(root)) / across;
        const edge = Math.min(x * cuts[0][0] + y * cuts[0][1] + z * cuts[0][2],
          (along[0] - x) * cuts[1][0] + (along[1] - y) * cuts[1][1] + (along[2] - z) * cuts[1][2]);
        if (edge < 0) continue;
        const s = g + z * u[2];
        const n = [(x - s * u[0]) / r, (y - s * u[1]) / r, (z - s * u[2]) / r];
        paint(row * width + column, p[2] + z, n[0], n[1], n[2], colourAt(s, n, edge), nearer);
      }
    }
  }

  // A disc about c across the unit vector n.
  function disc(c, n, r, colour) {
    if (n[2] < 1e-6) return; // from behind, or edge on
    const [left, right, top, bottom] = box(c[0], c[1], r, r);
    for (let row = top; row <= bottom; row++) {
      const y = (middleY - row - 0.5) / perNm - c[1];
      for (let column = left; column <= right; column++) {
        const x = (column + 0.5 - middleX) / perNm - c[0];
        const z = -(x * n[0] + y * n[1]) / n[2];
        if (x * x + y * y + z * z > r * r) continue;
        paint(row * width + column, c[2] + z, n[0], n[1], n[2], colour, 0);
      }
    }
  }

  // A thin round line with round ends, at least `pixelsWide` wide.
  function line(points, r, colour, nearer = 0, pixelsWide = 1.6) {
    const radius = Math.max(r, pixelsWide / 2 / perNm);
    points.forEach((p, i) => {
      ball(p, radius, colour, nearer);
      if (i === 0) return;
      const o = points[i - 1];
      const u = unit([p[0] - o[0], p[1] - o[1], p[2] - o[2]]);
      mantle(o, p, radius, [u, u], () => colour, nearer);
    });
  }

  // A rod: straight pieces between nodes, mitred where they meet. `first` and `second` are two
  // axes of each segment's frame; between the middles of segments they turn evenly about the rod,
  // as its twist does. Colours: the rod, a stripe on either side along the first axis, seams at nodes.
  function rod(nodes, first, second, r, { body, stripe, seam }) {
    const pieces = nodes.slice(1).map((q, i) =>
      unit([q[0] - nodes[i][0], q[1] - nodes[i][1], q[2] - nodes[i][2]]));
    const last = pieces.length - 1;
    const cut = (i) => (i === 0 ? pieces[0] : i > last ? pieces[last]
      : unit([0, 1, 2].map((k) => pieces[i - 1][k] + pieces[i][k])));
    // Turn of the first axis of segment j as seen in the frame of segment i.
    const turn = (i, j) => (j < 0 || j > last ? 0
      : Math.atan2(dot(first[j], second[i]), dot(first[j], first[i])));
    pieces.forEach((u, i) => {
      const [p, q] = [nodes[i], nodes[i + 1]];
      const length = Math.hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
      const [before, after] = [turn(i, i - 1), turn(i, i + 1)];
      const [d1, d2] = [first[i], second[i]];
      const colourAt = (s, n, edge) => {
        if (edge < 0.2) return seam;
        const t = s / length - 0.5;
        const angle = t < 0 ? -t * before : t * after;
        const seen = dot(n, d1) * Math.cos(angle) + dot(n, d2) * Math.sin(angle);
        return Math.abs(seen) > 0.94 ? stripe : body;
      };
      mantle(p, q, r, [cut(i), cut(i + 1)], colourAt, 0);
    });
    disc(nodes[0], pieces[0].map((v) => -v), r, body);
    disc(nodes[last + 1], pieces[last], r, body);
  }

  function dot(a, b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  return { begin, end, ellipsoid, ball, line, rod, unit };
})();
