// @ts-check
// The disk as a plan: field, crisp outlines, labels outside the rim, values under the pointer, and the angle of attack
// around the circle under it. The values lie in the page: reading them asks no server.
(() => {
  const {DEGREE, text, clamp, lerp, distance, turned, fixed, trace, write, scale, soon} = Common;
  const {part} = RX, page = document.documentElement, place = part('plan'), around = part('around');
  const RADII = 40, AZIMUTHS = 120, ROOM = 34;
  const LABEL = {get width() { return 158 * scale(); }, get height() { return 40 * scale(); }};
  const CARDS = 288, STACKED = 350;  // [px] Cards beside the circle, and above and below it.
  const MOVING = 320;  // [px] Along the edge of the field while something moves.
  const COLOURS = {
    stall: 'var(--rx-stall)', past_static: 'var(--rx-stall)', reverse_flow: 'var(--rx-dim)',
    drag_divergence: 'var(--rx-ink)',
  };
  const DASHES = {past_static: '1.5 3.5', drag_divergence: '3 4'};
  /** @type {[string, string, number, string][]} */
  const ROWS = [
    ['alpha', 'α', 1, '°'], ['mach', 'Mach', 3, ''], ['cl', 'C_l', 3, ''], ['margin', 'Stall margin', 1, '°'],
  ];
  const READ = ['Angle of attack', 'Mach number', 'Lift coefficient', 'Stall margin'];  // They have a row anyway.
  // `pointer` is a place on the disk, {r, psi}; `circle` the radius that is shown around.
  // In a tree of its own: the first canvas of the page is the scene.
  const shown = place.querySelector('[data-colours]');
  shown.attachShadow({mode: 'open'}).innerHTML =
    '<canvas style="width: 100%; height: 100%"></canvas><canvas></canvas>';
  /** @type {any} */
  let values = null;
  let layout = null, pointer = null, circle = 0.75, pressed = null;

  const unpack = ({low, step, data}) => {
    const bytes = Uint8Array.from(atob(data), letter => letter.charCodeAt(0));
    return Float32Array.from(new Uint16Array(bytes.buffer), count => low + step * count);
  };
  // Linear between four neighbours.
  function at(table, {r, psi}) {
    const {root} = RX.shown('plan'), row = clamp((r - root) / (1 - root), 0, 1) * (RADII - 1);
    const i = Math.min(Math.floor(row), RADII - 2), column = turned(psi) / 360 * AZIMUTHS;
    const j = Math.floor(column) % AZIMUTHS, k = (j + 1) % AZIMUTHS, share = column - Math.floor(column);
    const along = n => lerp(table[n * AZIMUTHS + j], table[n * AZIMUTHS + k], share);
    return lerp(along(i), along(i + 1), row - i);
  }
  const unpacked = ({r, first, tables}) =>
    ({r, first, ...Object.fromEntries(Object.entries(tables).map(([name, table]) => [name, unpack(table)]))});
  // As `probe` of explorer/picture/element.py: what a click shows is what stood under the pointer.
  function read({r, psi}, from) {
    const {r: stations, first} = from, columns = from.u_t.length / stations.length;
    const row = clamp(stations.filter(station => station <= r).length - 1, 0, stations.length - 2);
    const out = (r - stations[row]) / (stations[row + 1] - stations[row]), held = clamp(out, 0, 1);
    const turn = turned(psi - first) / 360 * columns, j = Math.floor(turn) % columns, k = (j + 1) % columns;
    const late = turn - Math.floor(turn);
    const along = (name, n) => lerp(from[name][n * columns + j], from[name][n * columns + k], late);
    const value = (name, share) => lerp(along(name, row), along(name, row + 1), share);
    const phi = Math.atan2(value('u_p', out), value('u_t', out)) / DEGREE;
    const alpha = 180 - turned(180 - value('theta', out) - value('ahead', held) + phi);
    const upper = value('upper', held), lower = value('lower', held);
    const margin = upper < 90 ? Math.min(upper - alpha, alpha - lower) : Infinity;  // Sections may not stall at all.
    const attached = from.attached ? value('attached', held) : margin;
    return {alpha, upper, lower, margin, separated: attached < 0,
      mach: Math.max(value('mach', out), 0), cl: value('cl', held)};
  }
  const reversed = ({r, psi}) => RX.shown('plan').mu * Math.sin(psi * DEGREE) + r < 0;
  // Nose up, advancing side right.
  const pixel = ([x, y]) => [layout.x + layout.radius * x, layout.y + layout.radius * y];
  const xy = (r, psi) => pixel([r * Math.sin(psi * DEGREE), r * Math.cos(psi * DEGREE)]);
  const where = ({r, psi}) => xy(r, psi);
  const path = line => trace(line.map(pixel));

  // The largest circle: beside the cards, or between them on a stage that is high; there the key of the regions has
  // their shares, which labels beside the circle have else. Labels stand on its right too where that costs it little.
  function arrange() {
    const {held} = RX.shown('plan'), {clientWidth: width, clientHeight: height} = place;
    const chart = around.firstElementChild;
    const by = scale(), wide = !held && !RX.small.matches && !page.hasAttribute('data-flight')
      && width > 560 && width - CARDS * by > height - STACKED;
    const both = width - CARDS * by - LABEL.width > .9 * (height - 2 * ROOM);
    if (held) delete page.dataset.plan; else page.dataset.plan = wide ? 'beside' : 'stacked';
    const low = Math.min(...['.rxf-field', '.rxf-views', '.rxf-fly', '.rxf-earns']
      .map(name => seen(name)?.top ?? height).filter(top => top > height / 2));
    const high = (held ? seen('.rxf-power')?.bottom ?? 0 : covered()) + ROOM;
    const alone = held && RX.small.matches && page.dataset.twisting !== 'curve';  // No words.
    const [left, right, top, bottom] = alone ? [12, 12, 12, 12]
      : wide ? [CARDS * by, both ? LABEL.width + 26 : 70, ROOM, ROOM]
        : held ? [34, 34, high + 20, 104] : [8, 8, high, height - low + ROOM];
    return {
      width, height, wide, both, alone, radius: Math.max(60, Math.min(height - top - bottom, width - left - right) / 2),
      x: left + (width - left - right) / 2, y: top + (height - top - bottom) / 2,
      chart: chart && {
        width: Math.max((chart.clientWidth - 32) / by, 80), height: Math.max((chart.clientHeight - 16) / by - 20, 40),
      },
    };
  }

  function drawRim() {
    const {x, y, radius, width} = layout, {flight, root, sides} = RX.shown('plan');
    const marks = Array.from({length: 36}, (_, k) => 10 * k).map(psi =>
      trace([xy(1.008, psi), xy(psi % 90 === 0 ? 1.04 : psi % 30 === 0 ? 1.026 : 1.014, psi)]));
    // The sides are named below the circle, where no line to a label passes. Outside the rim: the sense of rotation.
    const of = side => sides[side] && `${sides[side]} · `;
    const ahead = flight && `<tspan fill="var(--rx-blade)" dx="12">↑ ${text(flight)}</tspan>`;
    const below = y + radius + 27, side = Math.max(radius, 172), words = [
      [x, below, 'middle', `${width < 350 ? '' : of(0)}ψ 0°`],
      [Math.min(x + side, width - 8), below, 'end', `${of(1)}90°${sides[1] && ' →'}`],
      [Math.max(x - side, 8), below, 'start', `${sides[3] && '← '}${of(3)}270°`],
      [x, y - radius - 15, 'middle', `${of(2)}180°${ahead}`],
    ].map(([left, top, anchor, word]) => `<text x="${left}" y="${top}" text-anchor="${anchor}">${word}</text>`);
    const out = 1.055, arc = `M${xy(out, 32)}A${out * radius} ${out * radius} 0 0 0 ${xy(out, 52)}`;
    const head = [[1.03, 52], [out, 57], [1.08, 52]].map(([r, psi]) => xy(r, psi));
    return `<circle cx="${x}" cy="${y}" r="${radius}" fill="none" stroke="var(--rx-ink)"/>
      <circle cx="${x}" cy="${y}" r="${radius * root}" fill="var(--rx-paper)" stroke="var(--rx-faint)"/>
      <path d="${marks.join('')}" stroke="var(--rx-faint)"/>${layout.alone ? '' : words.join('')}
      <path d="${arc}" fill="none" stroke="var(--rx-dim)" stroke-width="2"/>
      <path d="${trace(head)}Z" fill="var(--rx-dim)"/>`;
  }

  // Beside the blade in the hand: the scale of colours, what the dashes are, and the shares of the regions.
  function drawKey(regions) {
    const {field, unit, held} = RX.shown('plan'), {y, radius, width} = layout, high = y - radius - 38;
    const {colours, ticks} = RX.state.field, from = width - 170, low = y + radius + 46;
    const stops = colours.map((colour, k) => `<stop offset="${k / (colours.length - 1)}" stop-color="${colour}"/>`);
    const numbers = ticks.map(([percent, word]) =>
      `<text x="${from + 1.5 * percent}" y="${low + 30}" text-anchor="middle">${text(word)}</text>`);
    const shares = regions.map(({name, title, words}, k) => `<text x="20" y="${low + 18 * k}">
      <tspan style="fill:${COLOURS[name]};font-weight:640">${text(title)}</tspan><tspan
        dx="7">${text(words.split(' · ')[0])}</tspan></text>`);  // Beside the colours there is room for no more.
    return `<linearGradient id="rxk">${stops.join('')}</linearGradient>
      <text x="${from + 75}" y="${low}" text-anchor="middle">${text(field)}${unit ? ` [${text(unit)}]` : ''}</text>
      <rect x="${from}" y="${low + 7}" width="150" height="9" fill="url(#rxk)"/>${numbers.join('')}
      <path d="M${width - 92} ${high - 4}h22" stroke="var(--rx-pinned)" stroke-width="1.6" stroke-dasharray="5 4"/>
      <text x="${width - 64}" y="${high}">${held}</text>${shares.join('')}`;
  }

  // Each label on the nearer side, as high as its region, none over another; what has no room left goes right.
  function placeLabels(regions) {
    if (!layout.wide) return [];
    const sizes = Object.fromEntries(regions.map(region => [region.name, LABEL.height + priceHeight(region.name)]));
    const from = Math.max(seen('.rxf-views:has(p)')?.bottom ?? 0, covered(), 20) + 12;
    const x = layout.width - LABEL.width - 16;
    const to = (seen('.rxf-field')?.top ?? layout.height) - 12;
    const left = {x: 16, end: 16 + LABEL.width, from, to, taken: /** @type {number[][]} */ ([])};
    const right = {x, end: x, from: 62, to: layout.height - 16, taken: /** @type {number[][]} */ ([])};
    const placed = [];
    for (const region of regions) {
      const size = sizes[region.name], largest = region.lines.reduce((most, line) =>
        line.length > most.length ? line : most, []);
      const [sumX, sumY] = largest.reduce(([sx, sy], [px, py]) => [sx + px, sy + py], [0, 0]);
      const nearer = sumX <= 0 ? left : right, other = sumX < 0 ? right : left;
      const middle = layout.y + layout.radius * sumY / Math.max(largest.length, 1) - size / 2;
      const column = (layout.both ? [nearer, other] : [left]).find(one => free(one, middle, size) !== null);
      if (!column) continue;
      const top = free(column, middle, size);
      column.taken.push([top, size]);
      const all = region.lines.flat(), same = all.filter(([px]) => (px < 0) === (column === left));
      const corners = column === nearer ? largest : same.length ? same : all;
      placed.push(aimed({region, column, top, size, corners: corners.map(pixel)}));
    }
    // Two lines of one side that cross change places.
    for (const one of placed) for (const other of placed) {
      if (one.column !== other.column || !cross(one, other)) continue;
      const [upper, lower] = one.top < other.top ? [one, other] : [other, one], high = upper.top;
      upper.top = lower.top + lower.size - upper.size;
      lower.top = high;
      [one, other].forEach(aimed);
    }
    return placed;
  }
  // With its line, from the middle of the label's edge to the nearest corner of the region.
  function aimed(label) {
    const {column, top, corners} = label, end = [column.end, top + LABEL.height / 2];
    if (!corners.length) return Object.assign(label, {end, tip: end});
    const tip = corners.reduce((best, spot) => distance(spot, end) < distance(best, end) ? spot : best);
    return Object.assign(label, {end, tip});
  }
  const side = ([ax, ay], [bx, by], [cx, cy]) => Math.sign((bx - ax) * (cy - ay) - (by - ay) * (cx - ax));
  const parted = (one, other) => side(one.end, one.tip, other.end) !== side(one.end, one.tip, other.tip);
  const cross = (one, other) => one !== other && parted(one, other) && parted(other, one);
  const circleAt = (centre, r, style) => `<circle cx="${centre[0]}" cy="${centre[1]}" r="${r}" ${style}/>`;
  const drawTie = ({region: {name}, end, tip}) => end === tip ? '' : `
    <path d="${trace([end, tip])}" stroke="var(--rx-paper)" stroke-width="3.5" opacity=".8"/>
    <path d="${trace([end, tip])}" stroke="${COLOURS[name]}" stroke-width="1.4" data-tie/>
    ${circleAt(tip, 3.5, `fill="${COLOURS[name]}" stroke="var(--rx-paper)" stroke-width="1.5"`)}`;
  const labelOf = ({region: {name, title, words}, column: {x}, top, size}) => `<div class="rxf-card rxf-region"
    data-region="${name}" style="--c:${COLOURS[name]};left:${x}px;top:${top}px;height:${size}px"><b>${text(title)}</b>
    <span class="rxf-num">${text(words)}</span>${RX.price(name)}</div>`;
  const priceHeight = name => {
    const {lines, press} = RX.state.prices?.[name] ?? {lines: [], press: ''};
    return scale() * (15 * lines.length + (press ? 26 : 0));
  };
  function free({taken, from, to}, wanted, size) {
    const tops = [clamp(wanted, from, to - size), ...taken.flatMap(([top, own]) => [top - size - 8, top + own + 8])];
    const possible = tops.filter(top => top >= from && top <= to - size
      && taken.every(([other, own]) => top >= other + own + 7.5 || top + size <= other - 7.5));
    return possible.sort((a, b) => Math.abs(a - wanted) - Math.abs(b - wanted))[0] ?? null;
  }
  // Down to where cards of the upper left stand: that of power, and below it the bar of a search or a game.
  const covered = () => Math.max(0, ...['.rxf-power', '.rxf-notice'].map(name => seen(name)?.bottom ?? 0));
  // A card of the stage, in the stage's own coordinates.
  function seen(name) {
    const box = document.querySelector(name)?.getClientRects()[0], {left, top} = place.getBoundingClientRect();
    return box && {left: box.left - left, right: box.right - left, top: box.top - top, bottom: box.bottom - top};
  }

  RX.paint(['plan', 'prices'], plan => {
    if (!plan && page.hasAttribute('data-twisting')) return;  // It leaves with the blade.
    place.hidden = !plan;
    around.hidden = !plan || Boolean(plan.held);
    if (!plan) {
      delete page.dataset.plan;
      pointer = null;
      around.innerHTML = '';
      return;
    }
    if (!plan.held && !around.childElementCount) around.innerHTML = '<div class="rxf-chart"></div>';
    if (plan.values && plan.coloured) values = {
      own: unpacked(plan.values), before: plan.before && unpacked(plan.before), coloured: unpack(plan.coloured),
    };
    place.toggleAttribute('data-moving', !plan.values);
    layout = arrange();
    const {x, y, radius, width, height} = layout, svg = place.querySelector('svg'), edge = 2 * radius;
    const sharp = Math.min(devicePixelRatio, 2);
    shown.style.cssText = `left: ${x - radius}px; top: ${y - radius}px; width: ${edge}px; height: ${edge}px`;
    const [drawn, wiped] = shown.shadowRoot.children, pixels = plan.values ? edge * sharp : Math.min(edge, MOVING);
    window.rotorDisk.fill(drawn, plan.disk, plan.root, pixels);
    wiped.hidden = !plan.wiped;
    if (plan.wiped) window.rotorDisk.fill(wiped, plan.wiped, plan.root, pixels);
    wiped.style.cssText = `position: absolute; inset: 0; width: 100%; height: 100%;
      clip-path: inset(0 calc(${x + radius}px - 100cqw * var(--rx-wipe, .5)) 0 0)`;
    const regions = plan.regions.filter(({lines}) => lines.length);
    const stall = {name: 'stall', title: 'Separated', words: 'none'};
    const none = !plan.held && RX.state.prices && !regions.some(({name}) => name === 'stall');
    const labels = placeLabels(none ? [...regions, {...stall, lines: [], before: []}] : regions);
    const before = plan.regions.flatMap(region => region.before).map(line =>
      `<path d="${path(line)}" fill="none" stroke="var(--rx-pinned)" stroke-width="1.6" stroke-dasharray="5 4"/>`);
    const outlines = regions.flatMap(({name, lines}) => lines.map(line => `
      <path d="${path(line)}" stroke="var(--rx-paper)" stroke-width="4" opacity=".75"/>
      <path d="${path(line)}" stroke="${COLOURS[name]}" stroke-width="2"
        stroke-dasharray="${DASHES[name] ?? 'none'}"/>`));
    svg.innerHTML = `${drawRim()}${plan.held && !layout.alone ? drawKey(regions) : ''}
      <g data-blades></g>${before.join('')}
      <g fill="none" stroke-linejoin="round">${outlines.join('')}${labels.map(drawTie).join('')}</g>
      <g data-cursor></g>`;
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    write(place.querySelector('[data-labels]'), labels.map(labelOf).join(''));
    drawBlades();
    drawCursor();
    drawAround();
  });

  // Blades as spokes; while the rotor plays they follow the page's own clock.
  function drawBlades() {
    const spokes = place.querySelector('[data-blades]'), {plan, turn} = RX.state;
    if (!spokes || !plan) return;
    const psi = turn?.playing ? (window.rotorScene?.psi ?? 0) / DEGREE : turn?.psi ?? 0;
    spokes.innerHTML = Array.from({length: plan.blades}, (_, k) => {
      const angle = psi + 360 * k / plan.blades, [ink, width, opacity] = k ? ['ink', 1.4, .55] : ['blade', 2.4, 1];
      return `<path d="${trace([xy(plan.root, angle), xy(1, angle)])}" stroke="var(--rx-${ink})" stroke-width="${width}"
        opacity="${opacity}"/>`;
    }).join('');
    if (turn?.playing) drawNext();
  }
  const drawNext = soon(drawBlades);
  RX.paint('turn', drawBlades);

  function rows(spot) {
    const value = read(spot, values.own), {field, unit} = RX.shown('plan'), colour = at(values.coloured, spot);
    const number = fixed(colour, Math.abs(colour) < 1 ? 3 : 1);
    const own = READ.includes(field) ? '' : `<dt>${text(field)}</dt><dd>${number} ${text(unit)}</dd>`;
    if (reversed(spot)) return `<dt>Mach</dt><dd>${fixed(value.mach, 3)}</dd>${own}<dt>Reverse flow</dt><dd></dd>`;
    return ROWS.filter(([name]) => Number.isFinite(value[name])).map(([name, title, decimals, of]) => {
      const bad = name === 'margin' && value.separated ? 'rxf-bad' : '';
      const words = title.replace('_l', '<sub>l</sub>');
      return `<dt>${words}</dt><dd class="${bad}">${fixed(value[name], decimals)}${of}</dd>`;
    }).join('') + flowOf(value) + own;
  }
  // Past the static angle the flow may still be attached.
  function flowOf({margin, separated}) {
    if (separated) return '<dt>Flow</dt><dd class="rxf-bad">separated</dd>';
    return margin < 0 ? '<dt>Flow</dt><dd>attached</dd>' : '';
  }
  const card = spot => `<div class="rxf-head">
      <b class="rxf-num">${spot.r.toFixed(2)} R · ψ ${Math.round(spot.psi)}°</b></div>
    <dl class="rxf-num">${rows(spot)}</dl>`;
  // A card's size is asked for once: to ask between two writes costs a layout.
  const sizes = {};
  function sizeOf(element) {
    const kind = `${element.querySelectorAll('dt').length} ${RX.shown('plan').field}`;
    return sizes[kind] ??= [element.offsetWidth || 150, element.offsetHeight || 110];
  }
  // Beside its point, away from the hub where there is room.
  function placeReading(element, spot) {
    const [x, y] = where(spot), [w, h] = sizeOf(element);
    const left = clamp(x >= layout.x ? x + 16 : x - 16 - w, 8, layout.width - w - 8);
    const top = clamp(y - h / 2, 8, layout.height - h - 8);
    element.style.transform = `translate(${left.toFixed(0)}px, ${top.toFixed(0)}px)`;
  }
  function drawCursor() {
    const cursor = place.querySelector('[data-cursor]'), reading = place.querySelector('[data-reading]');
    if (!cursor) return;
    const spot = pointer && where(pointer);
    const ring = 'fill="none" stroke="#fff" stroke-opacity=".85" stroke-width="1.4"';
    cursor.innerHTML = (RX.shown('plan').held ? '' : circleAt([layout.x, layout.y], circle * layout.radius, ring))
      + (spot ? circleAt(spot, 5, 'fill="none" stroke="#fff" stroke-width="2"')
        + circleAt(spot, 6.5, 'fill="none" stroke="#000" stroke-opacity=".5"') : '');
    reading.hidden = !spot || !values;
    if (reading.hidden) return;
    reading.innerHTML = card(pointer);
    placeReading(reading, pointer);
  }
  // α around the circle, with the static stall angles there, shaded between where α is past them.
  function drawAround() {
    if (!values || !layout.chart) return;
    const x = Array.from({length: 121}, (_, k) => 3 * k), {around: chart} = RX.shown('plan');
    const turn = from => x.map(psi => reversed({r: circle, psi}) ? null : read({r: circle, psi}, from));
    const own = turn(values.own), of = (all, name) => all.map(here => here && here[name]);
    const [lowest, highest] = chart.y.range;  // Beside reverse flow α leaves the axes.
    const inside = angles => angles.map(angle => angle < lowest || angle > highest ? null : angle);
    const [alpha, upper, lower] = ['alpha', 'upper', 'lower'].map(name => inside(of(own, name)));
    const line = (y, colour, width, dashes) => ({kind: 'line', x, y, colour: `var(--rx-${colour})`, width, dashes});
    /** @type {any[]} */
    const series = [...bandsPast(x, own, inside), line(upper, 'stall', 1.3, '3 3'), line(lower, 'stall', 1.3, '3 3')];
    if (values.before) series.push(line(inside(of(turn(values.before), 'alpha')), 'pinned', 1.7, '6 3'));
    series.push(line(alpha, 'blade', 2.1));
    const here = pointer && !reversed({r: circle, psi: pointer.psi}) ? [pointer.psi] : [];
    for (const psi of here) {
      const y = inside([read({r: circle, psi}, values.own).alpha]);
      series.push({kind: 'points', x: here, y, colour: 'var(--rx-blade)'});
    }
    const narrow = layout.chart.width < 480;  // Else the words of its heading are cut.
    const label = `° at ${circle.toFixed(2)} R${narrow ? '' : ', the white circle'}`;
    Charts.fill(around.firstElementChild, {
      ...chart, title: narrow ? 'Angle of attack' : chart.title, y: {...chart.y, label}, series,
      ...stallOf(own), rules: here.map(psi => ({at: psi, along: 'x', colour: 'var(--rx-faint)'})),
    }, layout.chart);
  }

  // The areas between α and the static stall angle, one for each stretch of the turn.
  function bandsPast(x, own, inside) {
    const bands = [];
    let before = null;
    own.forEach((there, k) => {
      const kind = !there ? null : there.separated ? 'stall' : there.margin < 0 ? 'dim' : null;
      if (!kind) { before = null; return; }
      if (kind !== before) {
        before = kind;
        bands.push({kind: 'band', x: [], low: [], high: [], colour: `var(--rx-${kind})`, opacity: .45});
      }
      const {alpha, upper, lower} = there, band = bands.at(-1);
      const [one, other] = inside([alpha, alpha > (upper + lower) / 2 ? upper : lower]);
      band.x.push(x[k]);
      band.low.push(one);
      band.high.push(other);
    });
    return bands;
  }
  // What the heading of that chart says of stall.
  function stallOf(own) {
    const known = own.filter(Boolean), margin = Math.min(...known.map(there => there.margin));
    if (!known.length) return {value: 'reverse flow', kind: ''};
    if (known.some(there => there.separated)) return {value: 'separated', kind: 'bad'};
    if (margin < 0) return {value: `${fixed(-margin, 1)}° past the static angle, attached`, kind: ''};
    return {value: Number.isFinite(margin) ? `${fixed(margin, 1)}° to static stall` : '', kind: ''};
  }

  const redraw = soon(() => { if (RX.state.plan) { drawCursor(); drawAround(); } });
  const onStep = r => clamp(Math.round(100 * r), Math.ceil(100 * RX.shown('plan').root - 1e-7), 100) / 100;
  function find(event) {
    const box = place.getBoundingClientRect();
    const x = event.clientX - box.left - layout.x, y = event.clientY - box.top - layout.y;
    const r = Math.hypot(x, y) / layout.radius;
    const {root} = RX.shown('plan');
    if (r < root || r > 1) return null;  // Else where a click opens the section: at the steps of its sliders.
    return {r: onStep(r), psi: turned(Math.round(Math.atan2(x, y) / DEGREE))};
  }
  place.addEventListener('pointermove', event => {
    if (!layout || !RX.state.plan) return;
    pointer = find(event);
    if (pointer) circle = pointer.r;
    redraw();
  });
  place.addEventListener('pointerleave', () => { pointer = null; redraw(); });
  place.addEventListener('pointerdown', event => { pressed = [event.clientX, event.clientY]; });
  place.addEventListener('click', event => {
    const spot = layout && RX.state.plan && find(event);
    if (!spot || !pressed || distance([event.clientX, event.clientY], pressed) > 5) return;
    circle = spot.r;  // A tap has no move before it.
    redraw();
    open(spot);
  });
  const open = spot => RX.send('section', [spot.r, spot.psi]);
  // By key: along the blade and around the disk; Enter opens the section.
  const STEPS = {ArrowUp: [.01, 0], ArrowDown: [-.01, 0], ArrowRight: [0, 5], ArrowLeft: [0, -5]};
  place.addEventListener('keydown', event => {
    const step = STEPS[event.key], {plan} = RX.state;
    if (!plan || event.target !== place || (!step && event.key !== 'Enter')) return;
    event.preventDefault();
    event.stopPropagation();
    pointer ??= {r: circle, psi: 90};
    if (step) pointer = {r: onStep(pointer.r + step[0]), psi: turned(pointer.psi + step[1])};
    else open(pointer);
    circle = pointer.r;
    drawCursor();
    drawAround();
    RX.say(card(pointer).replace(/<dt>/g, ', ').replace(/<\/dt>/g, ' ').replace(/<[^>]+>/g, ''));
  });
  for (const element of [place, ...document.querySelectorAll('.rxf-field, .rxf-power, .rxf-notice')])
    new ResizeObserver(() => RX.again('plan')).observe(element);
})();
