// The disk as a plan: picture, crisp outlines, labels outside the rim, values under the pointer, pinned cards, and the
// angle of attack around the circle under the pointer. The values lie in the page: reading them asks no server.
(() => {
  const {text, part} = RX, page = document.documentElement, place = part('plan'), around = part('around');
  const DEGREE = Math.PI / 180, RADII = 40, AZIMUTHS = 120, LABEL = {width: 158, height: 40};
  const COLOURS = {stall: 'var(--rx-stall)', negative_stall: 'var(--rx-stall)', reverse_flow: 'var(--rx-dim)', drag_divergence: 'var(--rx-ink)'};
  const DASHES = {negative_stall: '7 3', drag_divergence: '3 4'};
  const ROWS = [['alpha', 'α', 1, '°'], ['mach', 'M', 3, ''], ['cl', 'c_l', 2, ''], ['margin', 'To stall', 1, '°']];
  const fixed = (value, digits, unit = '') => Charts.fixed(value, digits) + unit;
  let layout = null, tables = {}, pointer = null, circle = 0.75, pins = [], pressed = null;

  const unpack = ({low, step, data}) => {
    const bytes = Uint8Array.from(atob(data), one => one.charCodeAt(0)), steps = new Uint16Array(bytes.buffer);
    return Float32Array.from(steps, one => low + step * one);
  };
  // Linear between four neighbours.
  const at = (table, r, psi) => {
    const root = RX.state.plan.root, row = Math.min(Math.max((r - root) / (1 - root), 0), 1) * (RADII - 1), i = Math.min(Math.floor(row), RADII - 2);
    const column = ((psi / 360) % 1 + 1) % 1 * AZIMUTHS, j = Math.floor(column) % AZIMUTHS, k = (j + 1) % AZIMUTHS, u = row - i, v = column - Math.floor(column);
    const of = n => (1 - v) * table[n * AZIMUTHS + j] + v * table[n * AZIMUTHS + k];
    return (1 - u) * of(i) + u * of(i + 1);
  };
  const read = (r, psi) => {
    const value = Object.fromEntries(Object.entries(tables).map(([name, table]) => [name, at(table, r, psi)]));
    return {...value, margin: Math.min(value.upper - value.alpha, value.alpha - value.lower)};
  };
  const reversed = (r, psi) => RX.state.plan.mu * Math.sin(psi * DEGREE) + r < 0;
  // Nose up, advancing side right.
  const xy = (r, psi) => [layout.x + layout.radius * r * Math.sin(psi * DEGREE), layout.y + layout.radius * r * Math.cos(psi * DEGREE)];
  const polar = (x, y) => [Math.hypot(x - layout.x, y - layout.y) / layout.radius, (Math.atan2(x - layout.x, y - layout.y) / DEGREE + 360) % 360];
  const path = line => 'M' + line.map(([x, y]) => `${(layout.x + layout.radius * x).toFixed(1)} ${(layout.y + layout.radius * y).toFixed(1)}`).join('L');

  // The largest circle between the cards; on a small stage the labels stand below it.
  function arrange() {
    const width = place.clientWidth, height = place.clientHeight, wide = width > 640;
    const left = wide ? 288 : 20, right = wide ? LABEL.width + 26 : 20, top = wide ? 34 : (seen('.rxf-power')?.bottom ?? 84) + 14, bottom = wide ? 34 : 250;
    const radius = Math.max(60, Math.min((height - top - bottom) / 2, (width - left - right) / 2));
    const chart = around.firstElementChild;
    return {chart: {width: Math.max(chart.clientWidth - 32, 80), height: Math.max(chart.clientHeight - 36, 40)}, width, height, wide, radius, x: left + (width - left - right) / 2, y: top + (height - top - bottom) / 2};
  }

  function rim() {
    const {x, y, radius} = layout, marks = [];
    for (let psi = 0; psi < 360; psi += 10) {
      const main = psi % 90 === 0, some = psi % 30 === 0, [ax, ay] = xy(1.008, psi), [bx, by] = xy(1 + (main ? .04 : some ? .026 : .014), psi);
      marks.push(`M${ax.toFixed(1)} ${ay.toFixed(1)}L${bx.toFixed(1)} ${by.toFixed(1)}`);
    }
    const words = [[0, 'TAIL · ψ 0°'], [90, 'ADVANCING · 90°'], [180, RX.state.plan.flight ? 'NOSE ↑ · 180°' : 'NOSE · 180°'], [270, 'RETREATING · 270°']].map(([psi, word]) => {
      if (psi % 180) {  // Along the rim at the sides, where labels stand further out.
        const side = psi === 90 ? 1 : -1, cx = x + side * (radius + 22);
        return `<text x="${cx}" y="${y}" text-anchor="middle" transform="rotate(${90 * side} ${cx} ${y})">${word}</text>`;
      }
      return `<text x="${x}" y="${psi ? y - radius - 17 : y + radius + 25}" text-anchor="middle">${word}</text>`;
    });
    return `<circle cx="${x}" cy="${y}" r="${radius}" fill="none" stroke="var(--rx-ink)"/><circle cx="${x}" cy="${y}" r="${radius * RX.state.plan.root}" fill="var(--rx-paper)" stroke="var(--rx-faint)"/>
      <path d="${marks.join('')}" stroke="var(--rx-faint)"/>${words.join('')}`;
  }

  // Each label on the nearer side, as high as its region, none over another; what has no room left goes right.
  function labels(regions) {
    if (!layout.wide) {
      const top = layout.y + layout.radius + 34;
      return {lines: '', boxes: regions.map((one, k) => ({one, left: 16, top: top + 21 * k}))};
    }
    const low = seen('.rxf-field'), high = seen('.rxf-power');
    const columns = {
      left: {x: 16, from: (high?.bottom ?? 20) + 12, to: (low?.top ?? layout.height) - LABEL.height - 12, taken: []},
      right: {x: layout.width - LABEL.width - 16, from: 62, to: layout.height - LABEL.height - 16, taken: []},
    };
    const boxes = [];
    for (const one of regions) {
      const points = one.lines.reduce((most, line) => line.length > most.length ? line : most), side = points.reduce((sum, [x]) => sum + x, 0) < 0 ? 'left' : 'right';
      const middle = layout.y + layout.radius * points.reduce((sum, [, y]) => sum + y, 0) / points.length - LABEL.height / 2;
      const room = [side, side === 'left' ? 'right' : 'left'].map(name => ({name, top: free(columns[name], middle)})).find(found => found.top !== null);
      if (!room) continue;
      const column = columns[room.name], end = room.name === 'left' ? column.x + LABEL.width : column.x;
      column.taken.push(room.top);
      const [ex, ey] = [end, room.top + LABEL.height / 2];
      const all = one.lines.flat(), same = all.filter(([x]) => (x < 0) === (room.name === 'left'));
      const [px, py] = (room.name === side ? points : same.length ? same : all).map(([x, y]) => [layout.x + layout.radius * x, layout.y + layout.radius * y]).reduce((best, p) => Math.hypot(p[0] - ex, p[1] - ey) < Math.hypot(best[0] - ex, best[1] - ey) ? p : best);
      boxes.push({one, left: column.x, top: room.top, line: `M${ex} ${ey}L${px.toFixed(1)} ${py.toFixed(1)}`, px, py});
    }
    return {
      boxes, lines: boxes.map(({one, line, px, py}) => `<path d="${line}" stroke="var(--rx-paper)" stroke-width="3.5" opacity=".8"/><path d="${line}" stroke="${COLOURS[one.name]}" stroke-width="1.4"/>
        <circle cx="${px}" cy="${py}" r="3.5" fill="${COLOURS[one.name]}" stroke="var(--rx-paper)" stroke-width="1.5"/>`).join(''),
    };
  }
  function free(column, wanted) {
    const step = LABEL.height + 8, spots = [Math.min(Math.max(wanted, column.from), column.to)];
    for (const top of column.taken) spots.push(top - step, top + step);
    const possible = spots.filter(top => top >= column.from && top <= column.to && column.taken.every(other => Math.abs(other - top) >= step - .5));
    return possible.length ? possible.reduce((best, top) => Math.abs(top - wanted) < Math.abs(best - wanted) ? top : best) : null;
  }
  // A card of the stage, in the stage's own coordinates.
  function seen(name) {
    const box = document.querySelector(name)?.getClientRects()[0], stage = place.getBoundingClientRect();
    return box && {top: box.top - stage.top, bottom: box.bottom - stage.top};
  }

  RX.paint('plan', now => {
    page.toggleAttribute('data-plan', Boolean(now));
    place.hidden = around.hidden = !now;
    if (!now) { pointer = null; pins = []; around.innerHTML = ''; return; }
    if (!around.childElementCount) around.innerHTML = '<div class="rxf-chart" data-wide></div><div class="rxf-chart rxf-shares"></div>';
    if (now.values) {
      tables = Object.fromEntries(Object.entries(now.values).map(([name, one]) => [name, unpack(one)]));
      tables.before = now.alpha_a ? unpack(now.alpha_a) : undefined;
      if (!tables.before) delete tables.before;
    }
    place.toggleAttribute('data-moving', !now.values);
    layout = arrange();
    const {x, y, radius, width, height} = layout, half = radius * now.reach, shown = now.regions.filter(one => one.lines.length), named = labels(shown);
    const before = now.regions.flatMap(one => one.before).map(line => `<path d="${path(line)}" fill="none" stroke="var(--rx-pinned)" stroke-width="1.6" stroke-dasharray="5 4"/>`).join('');
    const outlines = shown.flatMap(one => one.lines.map(line => `<path d="${path(line)}" stroke="var(--rx-paper)" stroke-width="4" opacity=".75"/><path d="${path(line)}" stroke="${COLOURS[one.name]}" stroke-width="2" ${DASHES[one.name] ? `stroke-dasharray="${DASHES[one.name]}"` : ''}/>`)).join('');
    place.querySelector('svg').innerHTML = `<image x="${x - half}" y="${y - half}" width="${2 * half}" height="${2 * half}" href="data:image/png;base64,${now.picture}"/>
      ${rim()}<g data-blades></g>${before}<g fill="none" stroke-linejoin="round">${outlines}${named.lines}</g><g data-cursor></g>`;
    place.querySelector('svg').setAttribute('viewBox', `0 0 ${width} ${height}`);
    place.querySelector('[data-labels]').innerHTML = named.boxes.map(({one, left, top}) => `<div class="rxf-card rxf-region" data-region="${one.name}" style="--c:${COLOURS[one.name]};left:${left}px;top:${top}px" ${layout.wide ? '' : 'data-line'}><b>${text(one.title)}</b><span class="rxf-num">${text(one.words)}</span></div>`).join('');
    turn();
    cursor();
    drawPins();
    drawAround();
  });

  // Blades as spokes; while the rotor plays they follow the page's own clock.
  function turn() {
    const blades = place.querySelector('[data-blades]'), now = RX.state.plan;
    if (!blades || !now) return;
    const psi = RX.state.turn?.playing ? (window.rotorScene?.psi ?? 0) / DEGREE : RX.state.turn?.psi ?? 0;
    blades.innerHTML = Array.from({length: now.blades}, (_, k) => {
      const angle = psi + 360 * k / now.blades, [ax, ay] = xy(now.root, angle), [bx, by] = xy(1, angle);
      return `<path d="M${ax.toFixed(1)} ${ay.toFixed(1)}L${bx.toFixed(1)} ${by.toFixed(1)}" stroke="var(${k ? '--rx-ink' : '--rx-blade'})" stroke-width="${k ? 1.4 : 2.4}" opacity="${k ? .55 : 1}"/>`;
    }).join('');
  }
  const step = () => { if (RX.state.plan) { if (RX.state.turn?.playing) turn(); requestAnimationFrame(step); } else stepping = false; };
  let stepping = false;
  RX.also('turn', () => { turn(); if (RX.state.plan && RX.state.turn?.playing && !stepping) { stepping = true; requestAnimationFrame(step); } });

  const rows = (r, psi) => {
    const value = read(r, psi), now = RX.state.plan, own = !['Angle of attack', 'Mach number', 'Lift coefficient', 'Stall margin'].includes(now.field);
    const field = own ? `<dt>${text(now.field)}</dt><dd>${fixed(value.field, Math.abs(value.field) < 1 ? 3 : 1)} ${text(now.unit)}</dd>` : '';
    if (reversed(r, psi)) return `<dt>M</dt><dd>${fixed(value.mach, 3)}</dd>${field}<dt>Reverse flow</dt><dd></dd>`;
    return ROWS.map(([name, title, digits, unit]) => `<dt>${title}</dt><dd class="${name === 'margin' && value.margin < 0 ? 'rxf-bad' : ''}">${fixed(value[name], digits, unit)}</dd>`).join('') + field;
  };
  const card = (r, psi, pin) => `<div class="rxf-head"><b class="rxf-num">${r.toFixed(2)} R · ψ ${Math.round(psi)}°</b>${pin === null ? '' : `<button data-ride-at="${pin}" title="One slow turn with this section">Ride</button><button data-unpin="${pin}" aria-label="Unpin this reading" title="Unpin">×</button>`}</div><dl class="rxf-num">${rows(r, psi)}</dl>`;
  // Beside its point, away from the hub where there is room. A card's size is asked for once: to ask between two writes
  // costs a layout.
  const sizes = {};
  function put(element, r, psi) {
    const [x, y] = xy(r, psi), kind = `${element.querySelectorAll('dt').length} ${element.hasAttribute('data-pin')} ${RX.state.plan.field}`;
    const [w, h] = sizes[kind] ??= [element.offsetWidth || 150, element.offsetHeight || 110];
    const outward = x >= layout.x ? x + 16 : x - 16 - w, left = Math.min(Math.max(8, outward), layout.width - w - 8), top = Math.min(Math.max(8, y - h / 2), layout.height - h - 8);
    element.style.transform = `translate(${left.toFixed(0)}px, ${top.toFixed(0)}px)`;
  }
  function cursor() {
    const here = place.querySelector('[data-cursor]'), reading = place.querySelector('[data-reading]');
    if (!here) return;
    const dots = pins.map(pin => { const [x, y] = xy(pin.r, pin.psi); return `<circle cx="${x}" cy="${y}" r="4.5" fill="var(--rx-accent)" stroke="#fff" stroke-width="2"/>`; }).join('');
    const ring = `<circle cx="${layout.x}" cy="${layout.y}" r="${circle * layout.radius}" fill="none" stroke="#fff" stroke-opacity=".85" stroke-width="1.4"/>`;
    const point = pointer ? (() => { const [x, y] = xy(pointer.r, pointer.psi); return `<circle cx="${x}" cy="${y}" r="5" fill="none" stroke="#fff" stroke-width="2"/><circle cx="${x}" cy="${y}" r="6.5" fill="none" stroke="#000" stroke-opacity=".5"/>`; })() : '';
    here.innerHTML = ring + dots + point;
    // Where a pin is, its card says the same.
    const pinned = pointer && pins.some(pin => Math.hypot(...xy(pin.r, pin.psi).map((v, k) => v - xy(pointer.r, pointer.psi)[k])) < 8);
    const shown = Boolean(pointer && tables.alpha && !pinned);
    reading.hidden = !shown;
    if (shown) { reading.innerHTML = card(pointer.r, pointer.psi, null); put(reading, pointer.r, pointer.psi); }
  }
  function drawPins() {
    const all = place.querySelector('[data-pins]');
    all.innerHTML = tables.alpha ? pins.map((pin, k) => `<div class="rxf-card rxf-reading" data-pin>${card(pin.r, pin.psi, k)}</div>`).join('') : '';
    pins.forEach((pin, k) => { if (all.children[k]) put(all.children[k], pin.r, pin.psi); });
  }

  // α around the circle, with the stall angles there, and the shares of the regions beside it.
  function drawAround() {
    if (!tables.alpha || !around.childElementCount) return;
    const [chart, shares] = around.children, {width, height} = layout.chart, x = Array.from({length: 121}, (_, k) => 3 * k);
    const at360 = table => x.map(psi => reversed(circle, psi) ? null : at(table, circle, psi));
    const alpha = at360(tables.alpha), upper = at360(tables.upper), lower = at360(tables.lower), line = (y, colour, thick, dashes) => ({kind: 'line', x, y, colour, width: thick, dashes});
    const margins = alpha.map((v, k) => v === null ? Infinity : Math.min(upper[k] - v, v - lower[k])), margin = Math.min(...margins), here = pointer && !reversed(circle, pointer.psi);
    Charts.fill(chart, {
      ...RX.state.plan.around, y: {...RX.state.plan.around.y, label: `° at ${circle.toFixed(2)} R, the circle under the pointer`},
      value: Number.isFinite(margin) ? `least margin ${fixed(margin, 1)}°` : 'reverse flow', kind: margin < 0 ? 'bad' : '',
      rules: here ? [{at: pointer.psi, along: 'x', colour: 'var(--rx-faint)'}] : [],
      series: [
        line(upper, 'var(--rx-stall)', 1.3, '3 3'), line(lower, 'var(--rx-stall)', 1.3, '3 3'), ...(tables.before ? [line(at360(tables.before), 'var(--rx-pinned)', 1.7, '6 3')] : []),
        line(alpha, 'var(--rx-blade)', 2.1), ...(here ? [{kind: 'points', x: [pointer.psi], y: [at(tables.alpha, circle, pointer.psi)], colour: 'var(--rx-blade)'}] : []),
      ],
    }, {width, height});
    const regions = RX.state.plan.regions.filter(one => one.lines.length);
    shares.innerHTML = `<div class="rxf-head"><b>Regions</b><span class="rxf-dim">share of disk area · of thrust</span></div>` + (regions.map(one => `<div class="rxf-share rxf-num"><i style="background:${COLOURS[one.name]}"></i><span>${text(one.title)}</span><span>${text(one.words.replace(/ (area|thrust)/g, ''))}</span></div>`).join('') || '<p class="rxf-dim">None is marked.</p>');
  }

  RX.also('power', now => place.toggleAttribute('data-faded', Boolean(now.problem)));

  // Once a frame at most.
  let due = 0;
  const later = () => { due ||= requestAnimationFrame(() => { due = 0; if (!RX.state.plan) return; cursor(); drawAround(); }); };
  const find = event => {
    const box = place.getBoundingClientRect(), [r, psi] = polar(event.clientX - box.left, event.clientY - box.top);
    return r >= RX.state.plan.root && r <= 1 ? {r, psi} : null;
  };
  place.addEventListener('pointermove', event => {
    if (!layout || !RX.state.plan) return;
    pointer = find(event);
    if (pointer) circle = pointer.r;
    later();
  });
  place.addEventListener('pointerleave', () => { pointer = null; later(); });
  place.addEventListener('pointerdown', event => { pressed = [event.clientX, event.clientY]; });
  place.addEventListener('click', event => {
    const unpin = event.target instanceof Element && event.target.closest('[data-unpin]');
    const ride = event.target instanceof Element && event.target.closest('[data-ride-at]');
    if (ride) { const {r, psi} = pins[Number(ride.dataset.rideAt)]; RX.send('ride', [r, psi]); }
    else if (unpin) pins.splice(Number(unpin.dataset.unpin), 1);
    else {
      const found = layout && RX.state.plan && find(event);
      if (!found || !pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 5) return;
      pins = [...pins, found].slice(-4);
    }
    cursor();
    drawPins();
  });
  // By key: along the blade and around the disk, Enter pins.
  place.addEventListener('keydown', event => {
    const move = {ArrowUp: [.01, 0], ArrowDown: [-.01, 0], ArrowRight: [0, 5], ArrowLeft: [0, -5]}[event.key];
    if (!RX.state.plan || (!move && event.key !== 'Enter')) return;
    if (event.target !== place) return;
    event.preventDefault();
    event.stopPropagation();
    pointer ??= {r: circle, psi: 90};
    if (move) pointer = {r: Math.min(1, Math.max(RX.state.plan.root, pointer.r + move[0])), psi: (pointer.psi + move[1] + 360) % 360};
    else pins = [...pins, pointer].slice(-4);
    circle = pointer.r;
    cursor(); drawPins(); drawAround();
    RX.say(card(pointer.r, pointer.psi, null).replace(/<dt>/g, ', ').replace(/<\/dt>/g, ' ').replace(/<[^>]+>/g, ''));
  });
  new ResizeObserver(() => RX.again('plan')).observe(place);
})();
