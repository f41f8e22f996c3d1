// @ts-check
// What the scripts of the page have in common.
const Common = (() => {
  const DEGREE = Math.PI / 180, page = document.documentElement;
  const ENTITIES = {'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'};
  const text = value => String(value ?? '').replace(/[&<>"]/g, sign => ENTITIES[sign]);  // Written into HTML.
  const clamp = (value, low, high) => Math.max(low, Math.min(value, high));
  const lerp = (from, to, share) => from + (to - from) * share;
  const distance = (from, to) => Math.hypot(to[0] - from[0], to[1] - from[1]);
  const turned = degrees => (degrees % 360 + 360) % 360;
  // With so many decimals and a true minus sign; what rounds to zero has no sign.
  const fixed = (value, decimals = 0) =>
    (value < 0 && Math.abs(value) >= .5 * 10 ** -decimals ? '−' : '') + Math.abs(value).toFixed(decimals);
  const signed = (value, decimals = 1) => (value >= .5 * 10 ** -decimals ? '+' : '') + fixed(value, decimals);
  // A change without its sign and its band as printed, the decimals of both, and the word: as `rotor.trim.doubt` has
  // them in `rounded_pair`. Words: the least ratio of each, the largest first.
  function roundedPair(change, band, words, [most, mostOfSmall]) {
    const wordOf = pair => words.find(([ratio]) => pair.change >= ratio * pair.band)[1];
    const nearest = (size, within, decimals) =>
      ({change: Number(size.toFixed(decimals)), band: Number(within.toFixed(decimals)), decimals});
    const known = band > 0, first = known ? Math.floor(Math.log10(band)) : 0;
    const coarse = known ? Math.max(0, -first + Number(band / 10 ** first < 2)) : 1;
    const decimalsOf = digits =>
      known ? Math.max(0, digits - 1 - Math.floor(Math.log10(Number(band.toPrecision(digits))))) : 1;
    const end = decimalsOf(1) > most ? mostOfSmall : most;
    const pairs = [coarse, decimalsOf(2)].map(decimals => nearest(change, band, Math.min(decimals, end)));
    const otherWay = pairs.toReversed().flatMap(pair => {
      const step = 10 ** -pair.decimals;
      return [
        nearest(pair.change, pair.band + (band < pair.band ? -step : step), pair.decimals),
        nearest(pair.change + (change < pair.change ? -step : step), pair.band, pair.decimals),
      ];
    });
    const word = wordOf({change, band});
    const fits = pair => wordOf(pair) === word && (pair.decimals === 0 || pair.band * 10 ** pair.decimals < 99.5);
    return {...[...pairs, ...otherWay].find(fits) ?? pairs[1], word};
  }
  // A polygon as a path of SVG.
  const trace = points => `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}`;
  // HTML into an element that nobody else fills, unless it has it already: then its controls stay the same ones.
  const write = (element, html) => { if (element.written !== html) element.innerHTML = element.written = html; };

  // What belongs to other inputs than those that are set stays, with this mark, until its own comes.
  const STALE = 'out of date';
  const staleMark = stale => stale ? ` data-stale aria-description="${STALE}"` : '';
  function outdate(element, stale) {
    element.toggleAttribute('data-stale', Boolean(stale));
    if (stale) element.setAttribute('aria-description', STALE);
    else element.removeAttribute('aria-description');
  }

  // How large type, cards and charts are: they grow with a window larger than that of a desk.
  const scale = () => clamp(Math.min(innerWidth / 1650, innerHeight / 940), 1, 1.5);
  const grow = () => page.style.setProperty('--rx-type', scale().toFixed(3));
  addEventListener('resize', grow);
  grow();

  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  /** @returns {any} */
  const closest = ({target}, selector) => target instanceof Element ? target.closest(selector) : null;
  // A function that calls this one in the next frame, however often it is called before.
  const soon = call => {
    let frame = 0;
    return () => { frame ||= requestAnimationFrame(() => { frame = 0; call(); }); };
  };
  // Sends the newest value, so often at most [ms]; `flush` sends what waits at once, `drop` never.
  function paced(send, interval = 50) {
    let sent = -interval, waiting = null;
    const flush = () => {
      if (!waiting) return;
      const [value] = waiting;
      waiting = null;
      sent = performance.now();
      send(value);
    };
    return {
      send(value) { waiting = [value]; setTimeout(flush, Math.max(0, interval - (performance.now() - sent))); },
      flush, drop() { waiting = null; },
    };
  }
  // A gesture, from a press on what `selector` names: `begin` returns its functions, or nothing if it is none. `move`
  // hears of every move, `end` of the release, and `escape`, if there is one, of the key or of a second finger, which
  // end the gesture too.
  function drag(place, selector, begin, capture = false) {
    let held = null;
    place.addEventListener('pointerdown', event => {
      const pressed = event.isPrimary && !event.button && closest(event, selector);
      if (pressed) held = begin(pressed, event) ?? null;
    }, capture);
    const finish = (name, event) => { const was = held; held = null; was[name]?.(event); };
    addEventListener('pointermove', event => { if (held && event.isPrimary) held.move?.(event); }, capture);
    for (const name of ['pointerup', 'pointercancel'])
      addEventListener(name, event => { if (held && event.isPrimary) finish('end', event); }, capture);
    for (const name of ['keydown', 'pointerdown']) addEventListener(name, event => {
      if (held?.escape && (event.key === 'Escape' || event.isPrimary === false)) finish('escape', event);
    }, true);
  }

  const viewer = () => window.__viserMutable, node = name => viewer()?.nodeRefFromName?.[name];
  const setPose = (name, wxyz, position) => {
    viewer().nodePoseData[name] = {wxyz, position, poseUpdateState: 'needsUpdate'};
  };
  // Where a point of a node is on the canvas [px], and whether it is seen there.
  function project(of, point) {
    const {camera, canvas} = viewer(), {width, height} = canvas.getBoundingClientRect();
    const {x, y, z} = of.position.clone().set(...point).applyMatrix4(of.matrixWorld).project(camera);
    return {left: (x + 1) / 2 * width, top: (1 - y) / 2 * height, seen: z < 1 && Math.abs(x) < 1 && Math.abs(y) < 1};
  }
  // Cards stand where the canvas is, and see through what the viewer paints behind it; whether it has moved.
  let stood = '';
  function follow(canvas) {
    const {left, top, width, height} = canvas.getBoundingClientRect(), stands = [left, top, width, height].join();
    if (stands === stood) return false;
    stood = stands;
    const names = {x: left, y: top, w: width, h: height};
    for (const [name, value] of Object.entries(names)) page.style.setProperty(`--rx-${name}`, `${value}px`);
    for (let above = canvas.parentElement; above && above.id !== 'root'; above = above.parentElement)
      if (/background-color/.test(above.getAttribute('style') ?? '')) above.classList.add('rxf-ground');
    return true;
  }

  return {
    DEGREE, text, clamp, lerp, distance, turned, fixed, signed, roundedPair, trace, write, staleMark, outdate, calm,
    closest, scale, soon, paced, drag, viewer, node, setPose, project, follow,
  };
})();
