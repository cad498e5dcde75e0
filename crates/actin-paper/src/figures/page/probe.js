// Inserted at the beginning of a copy of the page by the tests. Records errors, inspects all pictures, operates
// every view, and posts the results to the parent page.

(() => {
  'use strict';
  const errors = [];
  const note = (what) => errors.push(String(what));
  window.addEventListener('error', (event) => {
    const { target } = event;
    note(target && target.tagName ? `${target.tagName} ${target.src || target.href} did not load` : event.message);
  }, true);
  window.addEventListener('unhandledrejection', (event) => note(`rejected: ${event.reason}`));
  const { error } = console;
  console.error = (...words) => {
    note(`console: ${words.join(' ')}`);
    error(...words);
  };

  // Animation frames are driven by timers, because display frames may be missing under virtual time
  // on a busy machine.
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);

  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const pixels = (canvas) =>
    canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;

  // Number of pixels that differ from the transparent background.
  const painted = (data) => {
    let count = 0;
    for (let i = 3; i < data.length; i += 4) if (data[i] > 0) count += 1;
    return count;
  };
  // Number of differing pixels. The tolerance allows for the different rounding of hardware and software rendering.
  const differing = (a, b) => {
    if (a.length !== b.length) return -1;
    let count = 0;
    for (let i = 0; i < a.length; i += 4) {
      if ([0, 1, 2, 3].some((k) => Math.abs(a[i + k] - b[i + k]) > 2)) count += 1;
    }
    return count;
  };

  // Waits for the picture with all effects, after the quick one of a slow view.
  async function rested(canvas) {
    for (let i = 0; i < 500 && canvas.dataset.quality !== 'full'; i += 1) await wait(20);
    return pixels(canvas);
  }

  // Performs an action on a view and waits until it is redrawn, perhaps without all effects.
  async function sketched(canvas, act) {
    const before = canvas.dataset.drawn;
    act();
    for (let i = 0; i < 100 && canvas.dataset.drawn === before; i += 1) await wait(20);
    return pixels(canvas);
  }

  async function redrawn(canvas, act) {
    await sketched(canvas, act);
    return rested(canvas);
  }

  function drag(canvas, x, y) {
    const box = canvas.getBoundingClientRect();
    const at = (type, dx, dy) => canvas.dispatchEvent(new PointerEvent(type, {
      bubbles: true, pointerId: 7, clientX: box.left + 90 + dx, clientY: box.top + 90 + dy }));
    at('pointerdown', 0, 0);
    for (let k = 1; k <= 5; k += 1) at('pointermove', (x * k) / 5, (y * k) / 5);
    at('pointerup', x, y);
  }

  async function view(figure) {
    const canvas = figure.querySelector('canvas');
    for (let i = 0; i < 100 && !canvas.dataset.drawn; i += 1) await wait(20);
    const first = await rested(canvas);
    const turned = await redrawn(canvas, () => drag(canvas, 60, 30));
    // Zooms about the middle, so that the bodies remain visible.
    const box = canvas.getBoundingClientRect();
    const zoomed = await redrawn(canvas, () => canvas.dispatchEvent(new WheelEvent('wheel', {
      deltaY: -40, ctrlKey: true, cancelable: true,
      clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 })));
    const keyed = await redrawn(canvas, () => canvas.dispatchEvent(
      new KeyboardEvent('keydown', { key: 'ArrowRight', cancelable: true })));
    const buttons = [...figure.querySelectorAll('button')];
    const reset = await redrawn(canvas, () => buttons.at(-1).click());
    const lines = await redrawn(canvas, () => buttons[0].click());
    await redrawn(canvas, () => buttons[0].click());
    const states = [];
    for (const menu of figure.querySelectorAll('select:not([hidden])')) {
      for (let i = 0; i < menu.options.length; i += 1) {
        menu.selectedIndex = i;
        const data = await sketched(canvas, () => menu.dispatchEvent(new Event('change')));
        states.push(painted(data));
      }
    }
    return {
      size: [canvas.width, canvas.height], painted: painted(first), turned: differing(first, turned),
      zoomed: differing(turned, zoomed), keyed: differing(zoomed, keyed),
      after_reset: differing(first, reset), lines: painted(lines),
      compared: differing(reset, lines), states,
      legend: figure.querySelectorAll('.legend li').length,
    };
  }

  // Texts outside their picture, with a tolerance of half a pixel.
  function clipped(picture) {
    const box = picture.getBoundingClientRect();
    const texts = [...picture.querySelectorAll('text')].filter((text) => {
      const { left, right, top, bottom } = text.getBoundingClientRect();
      return left < box.left - 0.5 || right > box.right + 0.5 || top < box.top - 0.5 || bottom > box.bottom + 0.5;
    });
    return texts.map((text) => text.textContent);
  }

  // Displayed colours of the background and of all letters, without duplicates.
  function shades(picture) {
    const fills = (name) => {
      const elements = [...picture.querySelectorAll(name)];
      return [...new Set(elements.map((element) => getComputedStyle(element).fill))];
    };
    const numbers = (fill) => (fill ? fill.match(/\d+/g).map(Number) : null);
    return { ground: numbers(fills('rect')[0]), letters: fills('text').map(numbers) };
  }

  async function verdict() {
    const pictures = [...document.querySelectorAll('figure svg, img')].map((picture) => {
      const { width, height } = picture.getBoundingClientRect();
      if (picture.tagName === 'IMG') return { width, height, loaded: picture.complete && picture.naturalWidth > 0 };
      return { width, height, loaded: picture.childElementCount > 0, clipped: clipped(picture), ...shades(picture) };
    });
    const dark = matchMedia('(prefers-color-scheme: dark)').matches;
    // Drawing takes most of the time: each width and each mode once.
    const views = [];
    if (window.innerWidth < 500 !== dark) {
      for (const figure of document.querySelectorAll('figure.viewer')) views.push(await view(figure));
    }
    const { scrollWidth } = document.scrollingElement;
    const reach = [...document.querySelectorAll('body *')].filter((element) => {
      const right = element.getBoundingClientRect().right;
      return right > window.innerWidth + 1 && !element.closest('.scroll, svg, thead');
    }).map((element) => `${element.tagName}.${element.className}`);
    return { errors, pictures, views, dark, scrollWidth, innerWidth: window.innerWidth, beyond: reach };
  }

  window.addEventListener('load', async () => {
    let found;
    // The browser reports unhandled rejections in a separate task.
    await wait(500);
    try {
      found = await verdict();
    } catch (failure) {
      found = { errors: [...errors, `probe: ${failure.stack || failure}`] };
    }
    window.parent.postMessage({ name: window.name, found }, '*');
  });
})();
