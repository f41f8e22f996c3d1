// Small charts as SVG: the strip below the scene, and the twist curve that can be dragged.
(() => {
  const {text, part} = RX;
  const digits = value => (value < 0 ? '−' : '') + Math.abs(value).toLocaleString('en', {maximumFractionDigits: 3, useGrouping: false});
  const COLOURS = {earlier: 'var(--rx-ghost)', this: 'var(--rx-blade)', saving: 'var(--rx-accent)', flown: 'var(--rx-accent)', limit: 'var(--rx-stall)', reference: 'var(--rx-ghost)', pinned: 'var(--rx-pinned)'};
  const DASHES = {reference: '4 3', pinned: '6 3', limit: '3 3'}, WIDTHS = {earlier: 1.6, this: 2.1, flown: 1.7, saving: 2, reference: 1.5, pinned: 1.7, limit: 1.3};
  const role = (line, one) => line.colour ? null : line.role === 'reference' && one.pinned ? 'pinned' : line.role;

  function frameOf(one, width, height, left = 32, bottom = 17) {
    const [x0, x1] = one.x_range, [y0, y1] = one.y_range, right = 8, top = 8;
    return {
      X: x => left + (x - x0) / (x1 - x0) * (width - left - right),
      Y: y => top + (y1 - Math.max(y0 - 1e6, Math.min(y1 + 1e6, y))) / (y1 - y0) * (height - top - bottom),
      left, right: width - right, top, base: height - bottom,
    };
  }
  function axes(one, place, height, unit = '') {
    const rows = one.y_ticks.map(v => `<path d="M${place.left} ${place.Y(v).toFixed(1)}H${place.right}" stroke="var(${v === 0 ? '--rx-faint' : '--rx-grid'})"/>
      <text x="${place.left - 6}" y="${(place.Y(v) + 4).toFixed(1)}" text-anchor="end">${digits(v)}${unit}</text>`);
    const columns = one.x_ticks.map(v => `<text x="${place.X(v).toFixed(1)}" y="${height - 2}" text-anchor="middle">${digits(v)}</text>`);
    const name = `<text x="${place.left - 6}" y="${height - 2}" text-anchor="end" data-axis>${text(one.x_name)}</text>`;
    return rows.join('') + columns.join('') + name;
  }
  function curve(line, place, one) {
    let path = '', open = false, first = null, last = null;
    line.x.forEach((x, k) => {
      const y = line.y[k];
      if (y === null) { open = false; return; }
      path += `${open ? 'L' : 'M'}${place.X(x).toFixed(1)} ${place.Y(y).toFixed(1)}`;
      first ??= x; last = x; open = true;
    });
    if (!path) return '';
    const kind = role(line, one), stroke = line.colour ?? COLOURS[kind];
    const fill = line.filled ? `<path d="${path}L${place.X(last)} ${place.Y(0)}L${place.X(first)} ${place.Y(0)}Z" fill="${stroke}" opacity=".1"/>` : '';
    return `${fill}<path d="${path}" fill="none" stroke="${stroke}" stroke-width="${line.width ?? WIDTHS[kind] ?? 2}" stroke-linejoin="round" ${DASHES[kind] ? `stroke-dasharray="${DASHES[kind]}"` : ''}/>`;
  }
  // Where a chart is so narrow that its heading would be cut.
  const SHORT = {starts: 'Starts', power: 'Power', vibration: 'Vibration', alpha: 'α', worth: 'Pitch'};
  let clips = 0;
  function chart(element, one) {
    const width = Math.max(element.clientWidth - 32, 60), height = Math.max(element.clientHeight - 38, 40), place = frameOf(one, width, height, 12 + 7 * Math.max(3, ...one.y_ticks.map(v => digits(v).length))), clip = `rxc${clips++ % 64}`;
    const dots = one.dots.map(dot => `<circle cx="${place.X(dot.x).toFixed(1)}" cy="${place.Y(Math.max(one.y_range[0], Math.min(one.y_range[1], dot.y))).toFixed(1)}" r="${dot.label ? 3.5 : 4.5}" fill="${dot.label ? COLOURS.saving : COLOURS.this}" stroke="var(--rx-paper)" stroke-width="2"><title>${text(dot.label || 'now')}</title></circle>`).join('');
    // A measured point; one of a flight is pressed to fly there.
    const marks = (one.marks ?? []).map(mark => {
      const x = place.X(mark.x).toFixed(1), y = place.Y(mark.y).toFixed(1), press = mark.case ? `role="button" tabindex="0" data-do="flown" data-value="${text(mark.case)}" aria-label="${text(mark.words)}"` : '';
      const scatter = mark.error ? `<path d="M${x} ${place.Y(mark.y + mark.error).toFixed(1)}V${place.Y(mark.y - mark.error).toFixed(1)}" stroke="var(--rx-ink)" stroke-width="1.2" opacity=".55"/>` : '';
      return `<g data-mark ${press} ${mark.elsewhere ? 'opacity=".5"' : ''}><title>${text(mark.words)}${mark.case ? ' Press to fly there.' : ''}</title>${mark.case ? `<circle cx="${x}" cy="${y}" r="7" fill="transparent"/>` : ''}${scatter}<circle cx="${x}" cy="${y}" r="2.6" fill="var(--rx-paper)" stroke="var(--rx-ink)" stroke-width="1.2"/></g>`;
    }).join('');
    const edge = ys => ys.map((y, k) => `${place.X(one.band.x[k]).toFixed(1)} ${place.Y(y).toFixed(1)}`);
    const band = one.band ? `<path d="M${[...edge(one.band.low), ...edge(one.band.high).reverse()].join('L')}Z" fill="${COLOURS.saving}" opacity=".16" data-band/>` : '';
    // Where there is nothing to draw, and why.
    const gap = one.gap ? `<rect x="${place.X(one.gap.low).toFixed(1)}" y="${place.top}" width="${(place.X(one.gap.high) - place.X(one.gap.low)).toFixed(1)}" height="${place.base - place.top}" fill="var(--rx-field)" data-gap/>
      <text x="${place.X((one.gap.low + one.gap.high) / 2).toFixed(1)}" y="${((place.top + place.base) / 2 + 4).toFixed(1)}" text-anchor="middle" style="fill:var(--rx-dim)">${text(one.gap.words)}</text>` : '';
    const key = (one.key ?? []).map(([name, shade]) => `<span class="rxf-legend-line" style="--c:${shade}"><i></i>${text(name)}</span>`).join('');
    element.title = one.note ?? '';
    element.toggleAttribute('data-faded', Boolean(one.faded));
    const tight = element.toggleAttribute('data-tight', width < 260), title = tight && SHORT[one.name] || one.title, unit = tight ? one.unit.replace(/ over designs tried|^both /, '') : one.unit;
    element.innerHTML = `<div class="rxf-head"><b>${text(title)}</b><span class="rxf-dim">${text(unit)}</span>${key}<span class="rxf-num ${one.kind ? `rxf-${one.kind}` : ''}">${text(one.value)}</span></div>
      <svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${text(`${one.title}, ${one.unit}. ${one.value}. ${one.note ?? ''}`)}"><clipPath id="${clip}"><rect x="${place.left}" y="${place.top - 1}" width="${place.right - place.left + 2}" height="${place.base - place.top + 2}"/></clipPath>
      ${axes(one, place, height)}${gap}<g clip-path="url(#${clip})">${band}${one.lines.map(line => curve(line, place, one)).join('')}</g>${dots}<g clip-path="url(#${clip})">${marks}</g></svg>`;
  }
  RX.paint('strip', all => {
    const strip = part('strip');
    while (strip.children.length > all.length) strip.lastChild.remove();
    while (strip.children.length < all.length) strip.append(Object.assign(document.createElement('div'), {className: 'rxf-chart'}));
    if (strip.offsetParent === null && !strip.offsetHeight) return;
    all.forEach((one, k) => strip.children[k].toggleAttribute('data-wide', Boolean(one?.wide)));  // Before any is measured.
    all.forEach((one, k) => { if (one) { strip.children[k].dataset.name = one.name; chart(strip.children[k], one); } });
  });

  // What a step up of a slider changes, with its sign, and an arrow from the thumb the way that saves power.
  RX.paint('worth', all => {
    for (const place of document.querySelectorAll('[data-worth]')) {
      const one = all[place.dataset.worth], stamp = JSON.stringify(one ?? null);
      if (place.dataset.stamp === stamp && place.childElementCount) continue;
      place.dataset.stamp = stamp;
      if (!one) { place.innerHTML = ''; continue; }
      // The track lies between the label and the number.
      const row = place.parentElement?.previousElementSibling?.querySelector('.mantine-Slider-root')?.getBoundingClientRect(), own = place.getBoundingClientRect();
      const track = row && row.width ? [row.left - own.left, row.width] : [76, 166];
      const thumb = track[0] + one.at * track[1], up = one.way === 'up', word = 40;
      const length = Math.min(8 + 36 * one.size, Math.max(6, (up ? own.width - thumb : thumb - track[0]) - 8));
      const possible = up ? one.at < .999 : one.at > .001;  // No arrow beyond the end of the slider.
      // The word stands before the head, or behind the thumb where the head is near the end.
      const head = up ? thumb + length + 8 : thumb - length - 8, ahead = up ? head + word < own.width : head - word > track[0];
      const at = ahead ? (up ? head : head - word) : (up ? thumb - word - 6 : thumb + 6);
      const arrow = one.way && possible ? `<i data-way="${one.way}" style="left:${up ? thumb : thumb - length}px;width:${length}px"></i><em style="left:${at}px;width:${word}px;text-align:${up === ahead ? 'left' : 'right'}">saves</em>` : '';
      place.innerHTML = `${arrow}<span>${one.way ? `<b ${up ? 'class="rxf-good"' : ''}>${text(one.value)}</b>${text(one.unit)}` : text(one.value)}</span>`;
      place.title = one.sentence;
    }
  });

  // Between the least and the greatest flown twist over azimuth.
  function bandOf(now, frame) {
    const xs = now.lines[now.lines.length - 1].x, edge = ys => ys.map((y, k) => `${frame.X(xs[k]).toFixed(1)} ${frame.Y(y).toFixed(1)}`);
    return now.band ? `<path d="M${[...edge(now.band.low), ...edge(now.band.high).reverse()].join('L')}Z" fill="${COLOURS.flown}" opacity=".22" data-band/>` : '';
  }
  const MEANT = {jig: 'As built; the sliders set it', flown: 'Jig, active and elastic twist: mean over azimuth, shaded from least to greatest'};
  // One row, in the corner where it covers none of the curves, or least of them; it stays there while it can.
  const WORDS = {jig: [['jig, set by the sliders', 158]], flown: [['jig', 46], ['flown, band over azimuth', 170]]};
  let corner = 0;
  function keyOf(now, frame) {
    const words = WORDS[now.key.length > 1 ? 'flown' : 'jig'], wide = words.reduce((sum, [, w]) => sum + w, 0);
    const edges = now.band ? [now.band.low, now.band.high].map(y => ({x: now.lines.at(-1).x, y})) : [];
    const points = [...now.lines, ...edges].flatMap(line => line.x.map((x, k) => [frame.X(x), frame.Y(line.y[k])]));
    const corners = [frame.top, frame.base - 16].flatMap(top => [frame.right - wide, frame.left + 4].map(left => ({left, top})));
    for (const one of corners) one.met = points.filter(([x, y]) => x > one.left - 4 && x < one.left + wide && y > one.top - 3 && y < one.top + 16).length;
    const free = corners.reduce((best, one, k) => one.met < corners[best].met ? k : best, 0), met = corners[corner].met;
    if (met > corners[free].met + 6 || (met && !corners[free].met)) corner = free;
    let {left, top} = corners[corner];
    return now.key.map(([name, kind], k) => {
      const at = left;
      left += words[k][1];
      return `<g data-key="${name}"><title>${MEANT[name]}</title><path d="M${at + 3} ${top + 6}h14" stroke="${COLOURS[kind]}" stroke-width="2.2"/>
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
      const width = place.offsetWidth, height = place.offsetHeight, frame = frameOf(now, width, height, 34);
      const knots = now.knots.map(k => `<circle cx="${frame.X(k.r).toFixed(1)}" cy="${frame.Y(k.theta).toFixed(1)}" r="5" tabindex="0" role="slider" data-knot="${k.name}" aria-label="${text(k.title)}" aria-valuenow="${k.theta}" aria-valuetext="${digits(k.theta)}° at ${digits(k.r)} R"><title>${text(k.title)}</title></circle>`).join('');
      place.innerHTML = `<svg viewBox="0 0 ${width} ${height}" role="group" aria-label="Twist curve">${axes(now, frame, height, '°')}${bandOf(now, frame)}${keyOf(now, frame)}${now.lines.map(line => curve(line, frame, now)).join('')}${knots}</svg>`;
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
    const box = held.place.getBoundingClientRect(), now = RX.state.twist, frame = held.place.frame;
    const [x0, x1] = now.x_range, [y0, y1] = now.y_range;
    const r = x0 + (event.clientX - box.left - frame.left) / (frame.right - frame.left) * (x1 - x0);
    const theta = y1 - (event.clientY - box.top - frame.top) / (frame.base - frame.top) * (y1 - y0);
    tell(held.name, [r, theta]);
  });
  for (const end of ['pointerup', 'pointercancel'])
    addEventListener(end, () => { if (held) { const {name} = held; held = null; setTimeout(() => RX.send('knot', [name, 'end']), 70); } });
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
