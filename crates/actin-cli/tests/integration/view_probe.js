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
    return rested(canvas);
  }

  // Waits for the picture with all effects, and returns its pixels.
  async function rested(canvas) {
    await wait(60);
    for (let i = 0; i < 100 && canvas.dataset.quality !== 'full'; i += 1) await wait(20);
    return data(canvas);
  }

  // Points at bodies until one is described, clicks on it, and saves a picture.
  async function pointed(canvas) {
    const box = canvas.getBoundingClientRect(), tip = query('#tip');
    const send = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, {
      bubbles: true, pointerId: 5, clientX: box.left + x, clientY: box.top + y }));
    const isBody = () => !tip.hidden && tip.textContent.includes(' at s = ');
    let at = null;
    for (let x = 20; x < box.width - 20 && !at; x += 9) {
      for (let y = 20; y < box.height - 40 && !at; y += 9) {
        send('pointermove', x, y);
        if (isBody()) at = [x, y];
      }
    }
    const described = [...tip.children].map((line) => line.textContent);
    const followed = await after(canvas, () => {
      send('pointerdown', ...at);
      send('pointerup', ...at);
    });
    const name = query('#followed').textContent;
    query('#picture').click();
    for (let i = 0; i < 100 && !document.body.dataset.saved; i += 1) await wait(20);
    return { described, name, followed, saved: document.body.dataset.saved };
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
    const last = await rested(canvas), at_last = cursors(), slider = query('#slider');
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
      Object.assign(found, {
        played: seen.size, ended: document.body.dataset.record, after_play: differing(last, await rested(canvas)),
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
    const { followed, ...selection } = await pointed(canvas);
    found.selection = { ...selection, moved: differing(last, followed) };
    const unselected = await after(canvas, () => query('#reset').click());
    found.after_selection = differing(last, unselected);
    found.small = [...document.querySelectorAll('body *')].filter((element) => element.childElementCount === 0
      && element.textContent.trim() !== '' && element.getClientRects().length > 0
      && parseFloat(getComputedStyle(element).fontSize) < 9).length;
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
