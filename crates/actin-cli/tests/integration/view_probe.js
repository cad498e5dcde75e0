// Inserted at the beginning of a copy of a page of a run. Records errors, operates playback, rotation and colouring, and
// sends the results to the surrounding page.

(() => {
  'use strict';
  const errors = [];
  const note = (what) => errors.push(String(what));
  window.addEventListener('error', (event) => note(event.message || 'did not load'), true);
  window.addEventListener('unhandledrejection', (event) => note(`rejected: ${event.reason}`));
  for (const kind of ['error', 'warn']) {
    const told = console[kind];
    console[kind] = (...words) => {
      note(`console: ${words.join(' ')}`);
      told(...words);
    };
  }
  // Frames are driven by timers, since virtual time may not trigger display frames.
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);

  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const query = (selector) => document.querySelector(selector);
  const data = (canvas) => canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  const painted = (all) => {
    let count = 0;
    for (let i = 3; i < all.length; i += 4) if (all[i] > 0) count += 1;
    return count;
  };
  // Reading a canvas back disables hardware rendering, which changes rounding by one step.
  const differing = (a, b) => {
    let count = Math.abs(a.length - b.length) / 4;
    for (let i = 0; i < Math.min(a.length, b.length); i += 4) {
      if ([0, 1, 2, 3].some((k) => Math.abs(a[i + k] - b[i + k]) > 2)) count += 1;
    }
    return count;
  };

  // Performs an action, waits until the view is redrawn, and returns its pixels.
  async function after(canvas, act) {
    const before = canvas.dataset.drawn;
    act();
    for (let i = 0; i < 100 && canvas.dataset.drawn === before; i += 1) await wait(20);
    await wait(60);
    return data(canvas);
  }

  const cursors = () => [...document.querySelectorAll('.chart .cursor')].map((c) => c.getAttribute('transform'));

  async function slide(canvas, value) {
    const slider = query('#slider');
    slider.value = String(value);
    return after(canvas, () => slider.dispatchEvent(new Event('input')));
  }

  async function verdict() {
    const canvas = query('#space');
    for (let i = 0; i < 200 && !canvas.dataset.drawn; i += 1) await wait(20);
    await wait(200);
    const last = data(canvas), at_last = cursors(), slider = query('#slider');
    const found = { painted: painted(last), size: [canvas.width, canvas.height], records: Number(slider.max) + 1 };
    if (found.records > 1) {
      const first = await slide(canvas, 0);
      Object.assign(found, { moved: differing(last, first), at_last, at_first: cursors() });
      query('#speed').value = '4';
      query('#speed').dispatchEvent(new Event('change'));
      query('#play').click();
      const seen = new Set();
      for (let i = 0; i < 400 && query('#play').getAttribute('aria-pressed') === 'true'; i += 1) {
        seen.add(document.body.dataset.record);
        await wait(16);
      }
      await wait(200);
      Object.assign(found, {
        played: seen.size, ended: document.body.dataset.record, after_play: differing(last, data(canvas)),
        clock: query('#clock').textContent });
      const chart = query('.chart.picks'), box = chart.getBoundingClientRect();
      const pick = (type) => chart.dispatchEvent(new PointerEvent(type, {
        bubbles: true, pointerId: 3, clientX: box.left + 60, clientY: box.top + 40 }));
      pick('pointerdown');
      pick('pointerup');
      found.picked = Number(document.body.dataset.record);
      await slide(canvas, slider.max);
    }
    found.tints = [];
    for (const option of [...query('#paint').options].slice(1)) {
      query('#paint').value = option.value;
      const tinted = await after(canvas, () => query('#paint').dispatchEvent(new Event('change')));
      found.tints.push([option.textContent, differing(last, tinted)]);
    }
    query('#paint').value = 'kind';
    await after(canvas, () => query('#paint').dispatchEvent(new Event('change')));
    const press = (key) => after(canvas, () => canvas.dispatchEvent(new KeyboardEvent('keydown', { key, cancelable: true })));
    const zoom = (deltaY) => after(canvas, () => canvas.dispatchEvent(new WheelEvent('wheel', { deltaY, cancelable: true })));
    const turned = await press('ArrowRight'), along = await press('z'), zoomed = await zoom(-300);
    found.turned = differing(last, turned);
    found.along = differing(turned, along);
    found.zoomed = differing(along, zoomed);
    const reset = await after(canvas, () => query('#reset').click());
    found.after_reset = differing(last, reset);
    const reach = [...document.querySelectorAll('body *')].filter((element) => {
      const { right } = element.getBoundingClientRect();
      return right > window.innerWidth + 1 && !element.closest('svg');
    }).map((element) => `${element.tagName}#${element.id}.${element.className}`);
    return {
      ...found, errors, beyond: reach, scrollWidth: document.scrollingElement.scrollWidth,
      charts: document.querySelectorAll('.chart path').length, legend: document.querySelectorAll('#legend li').length,
      remarks: [...document.querySelectorAll('.remarks p')].map((p) => p.textContent),
    };
  }

  window.addEventListener('load', async () => {
    let found;
    await wait(300);
    try {
      found = await verdict();
    } catch (failure) {
      found = { errors: [...errors, `probe: ${failure.stack || failure}`] };
    }
    window.parent.postMessage({ name: window.name, found }, '*');
  });
})();
