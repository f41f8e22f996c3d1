// The strip below the scene, and the twist curve that can be dragged.
(() => {
  const {text, part} = RX;
  // Where a chart is so narrow that its heading would be cut.
  const SHORT = {power: 'Power', vibration: 'Vibration', alpha: 'α'};
  function chart(element, {name, kind, faded, chart: drawn, speeds}) {
    const width = Math.max(element.clientWidth - 32, 60), tight = element.toggleAttribute('data-tight', width < 260);
    element.toggleAttribute('data-faded', faded);
    const one = {...drawn, kind, speeds}, {y} = one;
    const short = {...one, title: SHORT[name] || one.title, y: {...y, label: y.label.replace(/^both /, '')}};
    Charts.fill(element, tight ? short : one, {width, height: Math.max(element.clientHeight - 38, 40)});
    const {place} = element.drawn, power = one.speeds && one.series.at(-1).y[0];
    if (power !== null && power !== undefined) element.querySelector('svg').insertAdjacentHTML('beforeend', `<circle cx="${place.X(one.speeds.mu)}" cy="${place.Y(power)}" r="11" data-speed><title>Drag: speed. Double click: the fastest trim</title></circle>`);
    say();
  }
  // Speed is dragged by the dot of power over µ, up to the first wall ahead.
  let flown = null, asked = 0, speed = null;
  const say = () => { if (flown?.met) flown.element.querySelector('[data-value]').textContent = flown.met; };
  const fly = () => { if (speed !== null) { RX.send('speed', speed); asked = performance.now(); speed = null; } };
  addEventListener('pointerdown', event => {
    const element = event.button === 0 && event.target instanceof Element && event.target.closest('[data-speed]')?.closest('.rxf-chart');
    if (!element) return;
    const {mu, fastest} = element.drawn.one.speeds;
    flown = {element, most: mu > fastest + .005 ? element.drawn.one.x.range[1] : fastest};
    event.preventDefault();
    RX.send('hold', true);
  });
  addEventListener('pointermove', event => {
    if (!flown) return;
    const {place, one} = flown.element.drawn, box = flown.element.querySelector('svg').getBoundingClientRect();
    speed = Charts.clamp(place.atX((event.clientX - box.left) * place.width / box.width), 0, flown.most);
    flown.met = speed < flown.most ? '' : `limit: ${one.rules.find(wall => Math.abs(wall.at - speed) < .006)?.label ?? 'slider'}`;
    say();
    setTimeout(fly, Math.max(0, 50 - (performance.now() - asked)));
  });
  for (const end of ['pointerup', 'pointercancel'])
    addEventListener(end, () => { if (flown) { fly(); flown = null; setTimeout(() => RX.send('hold', false), 80); } });
  document.addEventListener('dblclick', event => {
    const element = event.target instanceof Element && event.target.closest('[data-speed]')?.closest('.rxf-chart');
    if (element) RX.send('speed', element.drawn.one.speeds.fastest);
  });
  RX.paint('strip', all => {
    RX.again('worth');  // With every answer a thumb may stand elsewhere.
    const strip = part('strip');
    while (strip.children.length > all.length) strip.lastChild.remove();
    while (strip.children.length < all.length) strip.append(Object.assign(document.createElement('div'), {className: 'rxf-chart'}));
    if (strip.offsetParent === null && !strip.offsetHeight) return;
    all.forEach((one, k) => { if (one) { strip.children[k].dataset.name = one.name; chart(strip.children[k], one); } });
  });

  // What a step up of a slider changes, with its sign, and an arrow from the thumb the way that saves power.
  RX.paint('worth', all => {
    for (const place of document.querySelectorAll('[data-worth]')) {
      const one = all[place.dataset.worth];
      // The track lies between the label and the number.
      const slider = place.parentElement?.previousElementSibling?.querySelector('.mantine-Slider-root'), own = place.getBoundingClientRect();
      const row = slider?.getBoundingClientRect(), handle = slider?.querySelector('.mantine-Slider-thumb');
      const low = Number(handle?.ariaValueMin), at = handle ? (Number(handle.ariaValueNow) - low) / (Number(handle.ariaValueMax) - low) : .5;
      const stamp = JSON.stringify([one ?? null, at, own.width]);
      if (place.dataset.stamp === stamp && place.childElementCount) continue;
      place.dataset.stamp = stamp;
      if (!one) { place.innerHTML = ''; continue; }
      place.toggleAttribute('data-stale', one.stale);
      const track = row && row.width ? [row.left - own.left, row.width] : [76, 166];
      const thumb = track[0] + at * track[1], up = one.way === 'up', word = 40;
      const length = Math.min(8 + 36 * one.size, Math.max(6, (up ? own.width - thumb : thumb - track[0]) - 8));
      const possible = up ? at < .999 : at > .001;  // No arrow beyond the end of the slider.
      // The word stands before the head, or behind the thumb where the head is near the end.
      const head = up ? thumb + length + 8 : thumb - length - 8, ahead = up ? head + word < own.width : head - word > track[0];
      const left = ahead ? (up ? head : head - word) : (up ? thumb - word - 6 : thumb + 6);
      const arrow = one.way && possible ? `<i data-way="${one.way}" style="left:${up ? thumb : thumb - length}px;width:${length}px"></i><em style="left:${left}px;width:${word}px;text-align:${up === ahead ? 'left' : 'right'}">saves</em>` : '';
      place.innerHTML = `${arrow}<span>${one.way ? `<b ${up ? 'class="rxf-good"' : ''}>${text(one.value)}</b>${text(one.unit)}` : text(one.value)}</span>`;
      place.title = one.sentence;
    }
  });

  const MEANT = {jig: 'As built; the sliders set it', flown: 'Jig, active and elastic twist: mean over azimuth, shaded from least to greatest'};
  // One row, in the corner where it covers none of the curves, or least of them; it stays there while it can.
  const WORDS = {jig: [['jig, set by the sliders', 158]], flown: [['jig', 46], ['flown, band over azimuth', 170]]};
  let corner = 0;
  function keyOf(now, frame) {
    const named = now.series.filter(one => one.label).reverse(), words = WORDS[named.at(-1).label], wide = words.reduce((sum, [, w]) => sum + w, 0);
    const points = now.series.flatMap(one => [one.y, one.low, one.high].filter(Boolean).flatMap(ys => one.x.map((x, k) => [frame.X(x), frame.Y(ys[k])])));
    const corners = [frame.top, frame.base - 16].flatMap(top => [frame.right - wide, frame.left + 4].map(left => ({left, top})));
    for (const one of corners) one.met = points.filter(([x, y]) => x > one.left - 4 && x < one.left + wide && y > one.top - 3 && y < one.top + 16).length;
    const free = corners.reduce((best, one, k) => one.met < corners[best].met ? k : best, 0), met = corners[corner].met;
    if (met > corners[free].met + 6 || (met && !corners[free].met)) corner = free;
    let {left, top} = corners[corner];
    return named.map(({label, colour}, k) => {
      const at = left;
      left += words[k][1];
      return `<g data-key="${label}"><title>${MEANT[label]}</title><path d="M${at + 3} ${top + 6}h14" stroke="${colour}" stroke-width="2.2"/>
      <text x="${at + 21}" y="${top + 9.5}" style="paint-order:stroke;stroke:var(--rx-paper);stroke-width:3px">${words[k][0]}</text></g>`;
    }).join('');
  }

  // The twist curve: its handles are dragged, or moved by arrow keys.
  let held = null, sent = 0, waiting = null, pressed = null;
  const tell = (name, change) => {
    waiting = [name, change];
    const wait = Math.max(0, 50 - (performance.now() - sent));
    setTimeout(() => { if (waiting) { sent = performance.now(); RX.send('knot', waiting); waiting = null; } }, wait);
  };
  RX.paint('twist', now => {
    for (const place of document.querySelectorAll('[data-curve]')) {
      if (!place.offsetWidth) continue;
      const stamp = JSON.stringify([now, place.offsetWidth, place.offsetHeight]);
      if (place.dataset.stamp === stamp && place.childElementCount) continue;
      place.dataset.stamp = stamp;
      const focus = document.activeElement?.dataset?.knot;
      const width = place.offsetWidth, height = place.offsetHeight, frame = Charts.frame(now.chart, width, height, {left: 34});
      const knots = now.knots.map(k => `<circle cx="${frame.X(k.r).toFixed(1)}" cy="${frame.Y(k.theta).toFixed(1)}" r="5" tabindex="0" role="slider" data-knot="${k.name}" aria-label="${text(k.title)}" aria-valuenow="${k.theta}" aria-valuetext="${k.theta}° at ${k.r} R"><title>${text(k.title)}</title></circle>`).join('');
      place.innerHTML = `<svg viewBox="0 0 ${width} ${height}" role="group" aria-label="Twist curve">${Charts.axes(now.chart, frame)}${Charts.inside(now.chart, frame)}${keyOf(now.chart, frame)}${knots}</svg>`;
      place.frame = frame;
      if (focus) place.querySelector(`[data-knot="${focus}"]`)?.focus();
    }
  });
  document.addEventListener('pointerdown', event => {
    const knot = event.target instanceof Element && event.target.closest('[data-knot]');
    if (!knot) return;
    const place = knot.closest('[data-curve]');
    held = {name: knot.dataset.knot, place};
    event.preventDefault();
    knot.focus();
    RX.send('knot', [held.name, 'start']);
  });
  addEventListener('pointermove', event => {
    if (!held) return;
    const box = held.place.getBoundingClientRect(), {frame} = held.place;
    tell(held.name, [frame.atX(event.clientX - box.left), frame.atY(event.clientY - box.top)]);
  });
  for (const end of ['pointerup', 'pointercancel'])
    addEventListener(end, () => { if (held) { const {name} = held; held = null; setTimeout(() => RX.send('knot', [name, 'end']), 70); } });
  addEventListener('keydown', event => { if (event.key === 'Escape') held = waiting = null; }, true);
  document.addEventListener('keydown', event => {
    const knot = event.target instanceof Element && event.target.closest('[data-knot]');
    const step = knot && {ArrowUp: [0, .1], ArrowDown: [0, -.1], ArrowLeft: [-.01, 0], ArrowRight: [.01, 0]}[event.key];
    if (!step) return;
    // Presses that come faster than answers add up.
    const now = performance.now(), many = event.shiftKey ? 10 : 1;
    const k = pressed && pressed.name === knot.dataset.knot && now - pressed.at < 700 ? pressed : RX.state.twist.knots.find(one => one.name === knot.dataset.knot);
    event.preventDefault();
    event.stopPropagation();
    pressed = {name: k.name, r: k.r + many * step[0], theta: k.theta + many * step[1], at: now};
    tell(k.name, [pressed.r, pressed.theta]);
  }, true);
})();
