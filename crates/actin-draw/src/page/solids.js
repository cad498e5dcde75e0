// Solids in WebGL 2: ellipsoids and tubes, each drawn as a rectangle whose fragments are intersected with the exact surface.
// Outlines are therefore smooth at every zoom, and intersections are exact. One context serves all views of a page; each
// view is copied to its own canvas.
//
// Coordinates are in the lab frame (nm) and are transformed in the shaders to x (right), y (up), z (towards the viewer).
// The projection is orthographic. Callers decide what is drawn and when; camera and input are in space.js.

const Solids = (() => {
  'use strict';

  // Words of 4 bytes: centre 3, quaternion 4, semi-axes 3, smallest radius (pixels), depth offset, colour.
  const BALL = 13;
  // p 3, q 3, cut at p 3, cut at q 3, quaternion 4, rotations 2, radius, smallest width (pixels), depth offset,
  // colours at p and q, fractions of white in stripe and seams.
  const TUBE = 24;
  // p 3, q 3, corner, radius, smallest width (pixels), colour; four vertices a strip.
  const STRIP = 10;

  const CAMERA = `
    uniform mat3 rows; // right, up, towards the viewer
    uniform vec3 target;
    uniform vec2 size, middle; // size of the picture and position of the target in it (pixels)
    uniform float perNm, reach, ratio; // ratio: pixels of the picture per pixel of the page
    vec3 see(vec3 p) { return (p - target) * rows; }
    vec3 turn(vec4 q, vec3 v) { return v + 2.0 * cross(q.yzw, cross(q.yzw, v) + q.x * v); }
    vec4 place(vec2 at) { return vec4((middle + perNm * at) / size * 2.0 - 1.0, 0.0, 1.0); }
    vec3 rgb(uint c) { return vec3(c & 255u, (c >> 8) & 255u, (c >> 16) & 255u) / 255.0; }`;

  const BALL_VERTEX = `#version 300 es
    ${CAMERA}
    layout(location = 0) in vec3 centre;
    layout(location = 1) in vec4 quaternion;
    layout(location = 2) in vec3 lengths;
    layout(location = 3) in vec2 how;
    layout(location = 4) in uint paint;
    out vec2 at;
    flat out vec3 diagonal, mixed, colour;
    flat out vec2 depth;
    void main() {
      vec3 c = see(centre);
      vec3 semi = max(lengths, vec3(how.x * ratio / perNm));
      diagonal = mixed = vec3(0.0);
      vec2 half_ = vec2(0.0);
      for (int k = 0; k < 3; k++) {
        vec3 unit = vec3(k == 0, k == 1, k == 2);
        vec3 a = turn(quaternion, unit) * rows;
        float share = 1.0 / (semi[k] * semi[k]);
        diagonal += share * a * a;
        mixed += share * a.xxy * a.yzz;
        half_ += semi[k] * semi[k] * a.xy * a.xy;
      }
      vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0;
      at = corner * (sqrt(half_) + ratio / perNm);
      colour = rgb(paint);
      depth = vec2(c.z, how.y);
      gl_Position = place(c.xy + at);
    }`;

  // Directional light from the upper left in front, plus ambient light.
  const LIGHT = `
    uniform float reach;
    out vec4 pixel;
    const vec3 light = normalize(vec3(-0.45, 0.6, 0.75));
    const vec3 half_ = normalize(light + vec3(0.0, 0.0, 1.0));
    vec3 shine(vec3 n, vec3 colour) {
      float lit = max(0.0, dot(n, light)), glint = pow(max(0.0, dot(n, half_)), 40.0);
      vec3 sky = mix(vec3(0.50, 0.47, 0.45), vec3(0.60, 0.61, 0.64), 0.5 + 0.5 * n.y);
      return colour * (sky + 0.52 * lit) + 0.16 * glint;
    }`;
  // A depth offset reduces alpha, by which the last shader excludes the fragment from occlusion.
  const SHADE = `
    void shade(vec3 n, vec3 colour, float z, float nearer) {
      pixel = vec4(shine(n, colour), nearer > 0.0 ? 0.8 : 1.0);
      gl_FragDepth = 0.5 - 0.5 * (z + nearer) / reach;
    }`;

  const BALL_FRAGMENT = `#version 300 es
    precision highp float;
    ${LIGHT}${SHADE}
    in vec2 at;
    flat in vec3 diagonal, mixed, colour;
    flat in vec2 depth;
    void main() {
      float half_b = mixed.y * at.x + mixed.z * at.y;
      float rest = diagonal.x * at.x * at.x + 2.0 * mixed.x * at.x * at.y + diagonal.y * at.y * at.y - 1.0;
      float root = half_b * half_b - diagonal.z * rest;
      if (root < 0.0) discard;
      float z = (sqrt(root) - half_b) / diagonal.z;
      vec3 n = normalize(vec3(diagonal.x * at.x + mixed.x * at.y + mixed.y * z,
        mixed.x * at.x + diagonal.y * at.y + mixed.z * z, half_b + diagonal.z * z));
      shade(n, colour, depth.x + z, depth.y);
    }`;

  // Lateral surface of a cylinder with axis p to q, between the cut planes. Its stripes follow the first axis of the frame,
  // which is rotated by `turns` towards adjacent pieces.
  const TUBE_VERTEX = `#version 300 es
    ${CAMERA}
    layout(location = 0) in vec3 p;
    layout(location = 1) in vec3 q;
    layout(location = 2) in vec3 cutP;
    layout(location = 3) in vec3 cutQ;
    layout(location = 4) in vec4 quaternion;
    layout(location = 5) in vec2 turns;
    layout(location = 6) in vec3 how;
    layout(location = 7) in uvec3 paint;
    out vec2 at;
    flat out vec3 along, first, second, cut0, cut1, colour0, colour1;
    flat out vec4 shape; // radius, z of p, depth offset, positions of seams
    flat out vec4 look;
    void main() {
      vec3 a = see(p), b = see(q);
      along = b - a;
      float r = max(how.x, 0.5 * how.y * ratio / perNm);
      float across = length(along.xy);
      vec2 d = across > 1e-6 ? along.xy / across : vec2(1.0, 0.0);
      vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0;
      float spare = ratio / perNm;
      at = 0.5 * along.xy + d * corner.x * (0.5 * across + 1.5 * r + spare)
        + vec2(-d.y, d.x) * corner.y * (r + spare);
      first = turn(quaternion, vec3(1.0, 0.0, 0.0)) * rows;
      second = turn(quaternion, vec3(0.0, 1.0, 0.0)) * rows;
      cut0 = cutP * rows;
      cut1 = cutQ * rows;
      colour0 = rgb(paint.x);
      colour1 = rgb(paint.y);
      look = vec4(rgb(paint.z).xy, turns);
      shape = vec4(r, a.z, how.z, 0.2);
      gl_Position = place(a.xy + at);
    }`;

  const TUBE_FRAGMENT = `#version 300 es
    precision highp float;
    ${LIGHT}${SHADE}
    in vec2 at;
    flat in vec3 along, first, second, cut0, cut1, colour0, colour1;
    flat in vec4 shape;
    flat in vec4 look;
    void main() {
      float r = shape.x, size = length(along);
      vec3 u = along / size;
      float across = 1.0 - u.z * u.z;
      if (across < 1e-7) discard; // seen end-on: the lateral surface is not visible
      float g = dot(at, u.xy);
      float root = g * g * u.z * u.z - across * (dot(at, at) - g * g - r * r);
      if (root < 0.0) discard;
      float z = (g * u.z + sqrt(root)) / across;
      vec3 here = vec3(at, z);
      float edge = min(dot(here, cut0), dot(along - here, cut1));
      if (edge < 0.0) discard;
      float s = g + z * u.z;
      vec3 n = (here - s * u) / r;
      vec3 colour = mix(colour0, colour1, clamp(s / size, 0.0, 1.0));
      if (look.x > 0.0) {
        float t = s / size - 0.5, angle = t < 0.0 ? -t * look.z : t * look.w;
        float seen = abs(dot(n, first) * cos(angle) + dot(n, second) * sin(angle));
        colour = mix(colour, vec3(1.0), look.x * smoothstep(0.925, 0.95, seen));
        if (edge < shape.w) colour *= look.y;
      }
      shade(n, colour, shape.y + z, shape.z);
    }`;

  // A thin tube seen from afar: a rectangle with the shading of a tube.
  const STRIP_VERTEX = `#version 300 es
    ${CAMERA}
    layout(location = 0) in vec3 p;
    layout(location = 1) in vec3 q;
    layout(location = 2) in vec3 how;
    layout(location = 3) in uint paint;
    out float offset;
    flat out vec3 side, front;
    out vec3 colour;
    void main() {
      vec3 a = see(p), b = see(q), along = normalize(b - a + vec3(0.0, 0.0, 1e-6));
      int corner = int(how.x);
      float r = max(how.y, 0.5 * how.z * ratio / perNm), across = length(along.xy);
      vec2 d = across > 1e-6 ? along.xy / across : vec2(1.0, 0.0);
      float right = float(corner >> 1) * 2.0 - 1.0, end = float(corner & 1) * 2.0 - 1.0;
      vec3 c = end < 0.0 ? a : b;
      side = vec3(-d.y, d.x, 0.0);
      front = normalize(vec3(0.0, 0.0, 1.0) - along * along.z + vec3(0.0, 0.0, 1e-6));
      offset = right;
      colour = rgb(paint);
      gl_Position = place(c.xy + 0.5 * r * end * d + r * right * side.xy);
      gl_Position.z = -c.z / reach; // depth of the axis, without a write per fragment
    }`;
  const STRIP_FRAGMENT = `#version 300 es
    precision highp float;
    ${LIGHT}
    in float offset;
    flat in vec3 side, front;
    in vec3 colour;
    void main() {
      float up = sqrt(max(0.0, 1.0 - offset * offset));
      pixel = vec4(shine(offset * side + up * front, colour), 1.0);
    }`;

  // Postprocessing: ambient occlusion, outlines, haze.
  const LAST_VERTEX = `#version 300 es
    void main() {
      gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
    }`;
  const LAST_FRAGMENT = `#version 300 es
    precision highp float;
    uniform sampler2D colours, depths;
    uniform float reach, perNm, ratio, haze, edges;
    uniform vec2 near; // z of the nearest and of the farthest body
    out vec4 pixel;
    float depth(ivec2 at) {
      at = clamp(at, ivec2(0), textureSize(depths, 0) - 1);
      return reach * (1.0 - 2.0 * texelFetch(depths, at, 0).x);
    }
    // Height of the neighbouring surface above z, clamped to span.
    float above(ivec2 at, float z, float span) {
      at = clamp(at, ivec2(0), textureSize(depths, 0) - 1);
      float alpha = texelFetch(colours, at, 0).a;
      return alpha > 0.0 && alpha < 0.9 ? -span : clamp(depth(at) - z, -span, span);
    }
    void main() {
      ivec2 at = ivec2(gl_FragCoord.xy);
      float z = depth(at);
      vec4 colour = texelFetch(colours, at, 0);
      float wide = clamp(5.0 * perNm, 3.0, 34.0 * ratio), span = wide / perNm, hollow = 0.0;
      if (colour.a > 0.9) {
        for (int k = 0; k < 10; k++) {
          float angle = 2.4 * float(k), far = wide * sqrt((float(k) + 0.5) / 10.0);
          ivec2 step_ = ivec2(far * vec2(cos(angle), sin(angle)));
          float one = above(at + step_, z, span), other = above(at - step_, z, span);
          hollow += clamp((one + other) / span, 0.0, 1.0);
        }
        colour.rgb *= 1.0 - 0.75 * min(1.0, hollow / 10.0);
      }
      float before = 0.0, line = max(1.0, 0.55 * ratio);
      for (int k = 0; k < 8; k++) {
        float angle = 0.7854 * float(k);
        before = max(before, depth(at + ivec2(round(line * vec2(cos(angle), sin(angle))))) - z);
      }
      float outline = edges * smoothstep(1.2, 3.0, before) * smoothstep(0.7, 2.5, perNm / ratio);
      float back = clamp((near.x - z) / max(near.x - near.y, 1.0), 0.0, 1.0);
      float alpha = colour.a > 0.0 ? 1.0 - haze * back : 0.0;
      float dark = 0.62 * outline * (colour.a > 0.0 ? 1.0 : 0.75);
      colour.rgb = mix(colour.rgb, vec3(0.04, 0.05, 0.07), dark);
      alpha = max(alpha, dark * (1.0 - haze * clamp((near.x - z - before) / max(near.x - near.y, 1.0), 0.0, 1.0)));
      pixel = vec4(colour.rgb * alpha, alpha);
    }`;

  const unit = (v) => {
    const l = Math.hypot(v[0], v[1], v[2]) || 1;
    return [v[0] / l, v[1] / l, v[2] / l];
  };
  const packed = (c) => (Math.min(255, c[0]) & 255) | ((Math.min(255, c[1]) & 255) << 8)
    | ((Math.min(255, c[2]) & 255) << 16);

  // A growing list of instances with a fixed number of words.
  class List {
    constructor(words) {
      this.words = words;
      this.count = 0;
      this.reserve(64);
    }

    reserve(count) {
      const bytes = new ArrayBuffer(4 * this.words * count);
      const floats = new Float32Array(bytes);
      if (this.floats) floats.set(this.floats);
      this.floats = floats;
      this.integers = new Uint32Array(bytes);
    }

    // Offset of the next instance.
    next() {
      if (this.words * (this.count + 1) > this.floats.length) this.reserve(2 * this.count + 2);
      this.count += 1;
      return this.words * (this.count - 1);
    }
  }

  // A batch of solids, rebuilt when the contents change.
  class Batch {
    constructor() {
      this.balls = new List(BALL);
      this.tubes = new List(TUBE);
      this.strips = new List(STRIP);
      this.isNew = true;
    }

    clear() {
      this.balls.count = this.tubes.count = this.strips.count = 0;
      this.isNew = true;
    }

    // An ellipsoid with centre c[i] and quaternion (w, x, y, z) q[j]; `least` is its smallest radius in pixels.
    ellipsoid(c, i, q, j, a, colour, nearer = 0, least = 0) {
      const at = this.balls.next(), { floats: f, integers } = this.balls;
      f[at] = c[i]; f[at + 1] = c[i + 1]; f[at + 2] = c[i + 2];
      f[at + 3] = q[j]; f[at + 4] = q[j + 1]; f[at + 5] = q[j + 2]; f[at + 6] = q[j + 3];
      f[at + 7] = a[0]; f[at + 8] = a[1]; f[at + 9] = a[2];
      f[at + 10] = least; f[at + 11] = nearer;
      integers[at + 12] = packed(colour);
    }

    ball(c, r, colour, nearer = 0, least = 0) {
      this.ellipsoid(c, 0, [1, 0, 0, 0], 0, [r, r, r], colour, nearer, least);
    }

    // A piece of a tube; see TUBE.
    piece(p, q, cutP, cutQ, turn, turns, [r, least, nearer], [colourP, colourQ], [stripe, seam]) {
      const at = this.tubes.next(), { floats: f, integers } = this.tubes;
      f.set(p, at); f.set(q, at + 3); f.set(cutP, at + 6); f.set(cutQ, at + 9); f.set(turn, at + 12);
      f[at + 16] = turns[0]; f[at + 17] = turns[1];
      f[at + 18] = r; f[at + 19] = least; f[at + 20] = nearer;
      integers[at + 21] = packed(colourP); integers[at + 22] = packed(colourQ);
      integers[at + 23] = packed([255 * stripe, 255 * seam, 0]);
    }

    // A thin tube between two places, for small scales.
    strip(p, q, r, least, colourP, colourQ) {
      for (let corner = 0; corner < 4; corner++) {
        const at = this.strips.next(), { floats: f, integers } = this.strips;
        for (let k = 0; k < 3; k++) {
          f[at + k] = p[k];
          f[at + 3 + k] = q[k];
        }
        f[at + 6] = corner; f[at + 7] = r; f[at + 8] = least;
        integers[at + 9] = packed(corner & 1 ? colourQ : colourP);
      }
    }

    // A round polyline with a smallest width in pixels.
    line(points, r, colour, nearer = 0, least = 1.6) {
      points.forEach((p, i) => {
        this.ball(p, r, colour, nearer, least / 2);
        if (i === 0) return;
        const o = points[i - 1], u = unit([p[0] - o[0], p[1] - o[1], p[2] - o[2]]);
        this.piece(o, p, u, u, [1, 0, 0, 0], [0, 0], [r, least, nearer], [colour, colour], [0, 1]);
      });
    }

    // A disc with centre c and unit normal n, drawn as a flat ellipsoid.
    disc(c, n, r, colour, least = 0) {
      const w = 1 + n[2], q = w > 1e-6 ? [w, -n[1], n[0], 0] : [0, 1, 0, 0], l = Math.hypot(...q);
      this.ellipsoid(c, 0, q.map((v) => v / l), 0, [r, r, 0.02], colour, 0, least);
    }

    // A rod of straight, mitred pieces between nodes (triples), with one frame (quaternion) each. Between the middles of
    // pieces, frames are interpolated. `colourAt(node)` returns its colour; a stripe follows the first axis, and seams mark
    // nodes.
    rod(nodes, frames, r, colourAt, [stripe, seam], least) {
      const count = nodes.length / 3 - 1, at = (i) => nodes.subarray(3 * i, 3 * i + 3);
      const pieces = [], axes = [];
      for (let i = 0; i < count; i++) {
        const [p, q] = [at(i), at(i + 1)];
        pieces.push(unit([q[0] - p[0], q[1] - p[1], q[2] - p[2]]));
        axes.push(axesOf(frames, 4 * i));
      }
      const cut = (i) => (i === 0 ? pieces[0] : i === count ? pieces[count - 1]
        : unit([0, 1, 2].map((k) => pieces[i - 1][k] + pieces[i][k])));
      const turn = (i, j) => (j < 0 || j === count ? 0
        : Math.atan2(dot(axes[j][0], axes[i][1]), dot(axes[j][0], axes[i][0])));
      for (let i = 0; i < count; i++) {
        this.piece(at(i), at(i + 1), cut(i), cut(i + 1), frames.subarray(4 * i, 4 * i + 4),
          [turn(i, i - 1), turn(i, i + 1)], [r, least, 0], [colourAt(i), colourAt(i + 1)], [stripe, seam]);
      }
      this.disc(at(0), pieces[0], r, colourAt(0), least / 2);
      this.disc(at(count), pieces[count - 1], r, colourAt(count), least / 2);
    }
  }

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

  // Returns the axes of a quaternion (w, x, y, z; body to lab).
  function axesOf(q, i) {
    const w = q[i], x = q[i + 1], y = q[i + 2], z = q[i + 3];
    return [
      [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
      [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
      [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
    ];
  }

  // ---- WebGL context

  const BALL_LAYOUT = [[3, 0], [4, 3], [3, 7], [2, 10], [1, 12, true]];
  const TUBE_LAYOUT = [[3, 0], [3, 3], [3, 6], [3, 9], [4, 12], [2, 16], [3, 18], [3, 21, true]];

  const STRIP_LAYOUT = [[3, 0], [3, 3], [3, 6], [1, 9, true]];

  let gl = null, programs = null, target = null, generation = 0;

  function program(vertex, fragment) {
    const made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
      const logs = gl.getAttachedShaders(made).map((shader) => gl.getShaderInfoLog(shader));
      throw new Error(`shaders: ${gl.getProgramInfoLog(made)} ${logs.join(' ')}`);
    }
    const uniforms = {};
    for (let i = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS) - 1; i >= 0; i--) {
      const { name } = gl.getActiveUniform(made, i);
      uniforms[name] = gl.getUniformLocation(made, name);
    }
    return { made, uniforms };
  }

  function prepare() {
    generation += 1;
    target = null;
    programs = {
      ball: program(BALL_VERTEX, BALL_FRAGMENT),
      tube: program(TUBE_VERTEX, TUBE_FRAGMENT),
      strip: program(STRIP_VERTEX, STRIP_FRAGMENT),
      last: program(LAST_VERTEX, LAST_FRAGMENT),
    };
    gl.disable(gl.BLEND);
  }

  // Returns whether WebGL 2 is available. Views are redrawn when a lost context is restored.
  function isThere(again) {
    if (!gl) {
      const canvas = document.createElement('canvas');
      gl = canvas.getContext('webgl2', { alpha: true, antialias: false, premultipliedAlpha: true });
      if (!gl) return false;
      canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
      canvas.addEventListener('webglcontextrestored', prepare);
      prepare();
    }
    gl.canvas.addEventListener('webglcontextrestored', again);
    return true;
  }

  // Allocates colour and depth buffers of a size.
  function room(w, h) {
    if (target && target.w >= w && target.h >= h) return;
    const old = target;
    [w, h] = [Math.max(w, old ? old.w : 0), Math.max(h, old ? old.h : 0)];
    if (old) {
      for (const texture of [old.colours, old.depths]) gl.deleteTexture(texture);
      gl.deleteFramebuffer(old.frame);
    }
    const texture = (format) => {
      const made = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, made);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, w, h);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      return made;
    };
    target = { w, h, colours: texture(gl.RGBA8), depths: texture(gl.DEPTH_COMPONENT24), frame: gl.createFramebuffer() };
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target.colours, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, target.depths, 0);
    [gl.canvas.width, gl.canvas.height] = [w, h];
  }

  // Creates the vertex buffer of a list.
  function uploaded(list, layout, isNew, corners) {
    if (list.generation !== generation) {
      list.generation = generation;
      list.array = gl.createVertexArray();
      list.buffer = gl.createBuffer();
      gl.bindVertexArray(list.array);
      gl.bindBuffer(gl.ARRAY_BUFFER, list.buffer);
      layout.forEach(([count, offset, isInteger], k) => {
        gl.enableVertexAttribArray(k);
        if (isInteger) gl.vertexAttribIPointer(k, count, gl.UNSIGNED_INT, 4 * list.words, 4 * offset);
        else gl.vertexAttribPointer(k, count, gl.FLOAT, false, 4 * list.words, 4 * offset);
      });
      isNew = true;
    }
    gl.bindVertexArray(list.array);
    if (isNew) {
      gl.bindBuffer(gl.ARRAY_BUFFER, list.buffer);
      gl.bufferData(gl.ARRAY_BUFFER, repeated(list, corners), gl.DYNAMIC_DRAW);
    }
  }

  // Repeats each element of a list for its corners.
  function repeated({ words, count, integers }, corners) {
    if (corners === 1) return integers.subarray(0, words * count);
    const all = new Uint32Array(corners * words * count);
    for (let i = 0, to = 0; i < count; i++) {
      for (let corner = 0; corner < corners; corner++) {
        for (let k = 0; k < words; k++, to++) all[to] = integers[words * i + k];
      }
    }
    return all;
  }

  // Draws two triangles for each four vertices. An instance would take 20 us in a software renderer.
  function drawQuads(list, count) {
    if (!list.corners || list.corners.length < 6 * count || list.cornersOf !== generation) {
      list.corners = Uint32Array.from({ length: 12 * count }, (_, i) => 4 * Math.floor(i / 6) + [0, 1, 2, 2, 1, 3][i % 6]);
      list.cornersOf = generation;
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, list.corners, gl.STATIC_DRAW);
    }
    gl.drawElements(gl.TRIANGLES, 6 * count, gl.UNSIGNED_INT, 0);
  }

  function use({ made, uniforms }, camera) {
    gl.useProgram(made);
    const set = { size: 'uniform2fv', middle: 'uniform2fv', near: 'uniform2fv', target: 'uniform3fv' };
    for (const [name, place] of Object.entries(uniforms)) {
      if (name === 'rows') gl.uniformMatrix3fv(place, false, camera.rows.flat());
      else if (name === 'colours' || name === 'depths') gl.uniform1i(place, name === 'depths' ? 1 : 0);
      else gl[set[name] || 'uniform1f'](place, camera[name]);
    }
  }

  // Copies the picture to the canvas of the context, with occlusion, outlines and haze.
  function finish(camera) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(null);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, target.depths);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, target.colours);
    use(programs.last, camera);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Draws a batch to the canvas of `context`, and returns when the picture is complete. The camera has the fields rows,
  // target, size, middle and near, in pixels and nm, and effort: 0 for a quick picture without effects.
  function draw(context, batch, camera) {
    if (!gl || gl.isContextLost()) return;
    const [w, h] = camera.size;
    room(w, h);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, w, h);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const [list, layout, kind] of [[batch.balls, BALL_LAYOUT, 'ball'], [batch.tubes, TUBE_LAYOUT, 'tube'],
      [batch.strips, STRIP_LAYOUT, 'strip']]) {
      if (list.count === 0) continue;
      use(programs[kind], camera);
      const corners = kind === 'strip' ? 1 : 4; // a strip has four elements
      uploaded(list, layout, batch.isNew, corners);
      drawQuads(list, (corners * list.count) / 4);
    }
    batch.isNew = false;
    if (camera.effort > 0) finish(camera);
    else {
      gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
      gl.blitFramebuffer(0, 0, w, h, 0, 0, w, h, gl.COLOR_BUFFER_BIT, gl.NEAREST);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    }
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits
    context.drawImage(gl.canvas, 0, target.h - h, w, h, 0, 0, w, h);
  }

  return { Batch, isThere, draw, unit, dot, axesOf };
})();
