// The disk as a plan: picture, crisp outlines, labels outside the rim, values under the pointer, pinned cards, and the
// angle of attack around the circle under the pointer. The values lie in the page: reading them asks no server.
(() => {
  const {text, part} = RX, page = document.documentElement, place = part('plan'), around = part('around');
  const DEGREE = Math.PI / 180, RADII = 40, AZIMUTHS = 120, LABEL = {width: 158, height: 40}, ROOM = 34, CARDS = 288, STACKED = 350;  // [px] The last two: cards beside the circle, and above and below it.
  const COLOURS = {stall: 'var(--rx-stall)', negative_stall: 'var(--rx-stall)', reverse_flow: 'var(--rx-dim)', drag_divergence: 'var(--rx-ink)'};
  const DASHES = {negative_stall: '7 3', drag_divergence: '3 4'};
  const ROWS = [['alpha', 'α', 1, '°'], ['mach', 'M', 3, ''], ['cl', 'c_l', 2, ''], ['margin', 'To stall', 1, '°']];
  const fixed = (value, digits, unit = '') => Charts.fixed(value, digits) + unit;
  let layout = null, tables = {}, pointer = null, circle = 0.75, pins = [], pressed = null, told = null;

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

  // The largest circle: beside the cards, or between them on a stage that is high; there the key of the regions has their
  // shares, which labels beside the circle have else. Labels stand on its right too where that costs the circle little.
  function arrange() {
    const {held} = RX.state.plan, width = place.clientWidth, height = place.clientHeight, wide = !held && width > 560 && width - CARDS > height - STACKED;
    if (held) delete page.dataset.plan; else page.dataset.plan = wide ? 'beside' : 'stacked';
    const low = Math.min(...['.rxf-field', '.rxf-views'].map(name => seen(name)?.top ?? height));
    const both = width - CARDS - LABEL.width > .9 * (height - 2 * ROOM), left = wide ? CARDS : held ? 34 : 8, right = wide ? (both ? LABEL.width : 0) + 26 : held ? 34 : 8, top = wide ? ROOM : (seen('.rxf-power')?.bottom ?? 0) + ROOM + (held ? 20 : 0), bottom = wide ? ROOM : held ? 104 : height - low + ROOM;
    const radius = Math.max(60, Math.min((height - top - bottom) / 2, (width - left - right) / 2));
    const chart = around.firstElementChild;
    return {chart: chart && {width: Math.max(chart.clientWidth - 32, 80), height: Math.max(chart.clientHeight - 36, 40)}, width, height, wide, both, radius, x: left + (width - left - right) / 2, y: top + (height - top - bottom) / 2};
  }

  function rim() {
    const {x, y, radius} = layout, marks = [];
    for (let psi = 0; psi < 360; psi += 10) {
      const main = psi % 90 === 0, some = psi % 30 === 0, [ax, ay] = xy(1.008, psi), [bx, by] = xy(1 + (main ? .04 : some ? .026 : .014), psi);
      marks.push(`M${ax.toFixed(1)} ${ay.toFixed(1)}L${bx.toFixed(1)} ${by.toFixed(1)}`);
    }
    // The sides are named below the circle, where no line to a label passes. Outside the rim: the sense of rotation.
    const flight = RX.state.plan.flight && `<tspan fill="var(--rx-blade)" dx="12">↑ ${text(RX.state.plan.flight)}</tspan>`, below = y + radius + 27, side = Math.max(radius, 172), east = Math.min(x + side, layout.width - 8), west = Math.max(x - side, 8);
    const words = [[x, below, 'middle', 'TAIL · ψ 0°'], [east, below, 'end', 'ADVANCING · 90° →'], [west, below, 'start', '← RETREATING · 270°'], [x, y - radius - 15, 'middle', `NOSE · 180°${flight}`]]
      .map(([left, top, anchor, word]) => `<text x="${left}" y="${top}" text-anchor="${anchor}">${word}</text>`);
    const [ax, ay] = xy(1.055, 32), [bx, by] = xy(1.055, 52), head = [[1.03, 52], [1.055, 57], [1.08, 52]].map(([r, psi]) => xy(r, psi).map(v => v.toFixed(1)));
    words.push(`<path d="M${ax} ${ay}A${1.055 * radius} ${1.055 * radius} 0 0 0 ${bx} ${by}" fill="none" stroke="var(--rx-dim)" stroke-width="2"/><polygon points="${head.join(' ')}" fill="var(--rx-dim)"/>`);
    return `<circle cx="${x}" cy="${y}" r="${radius}" fill="none" stroke="var(--rx-ink)"/><circle cx="${x}" cy="${y}" r="${radius * RX.state.plan.root}" fill="var(--rx-paper)" stroke="var(--rx-faint)"/>
      <path d="${marks.join('')}" stroke="var(--rx-faint)"/>${words.join('')}`;
  }

  // Beside the blade in the hand: what the colours are, what the dashes, and the shares of the regions.
  function key(regions) {
    const {field, unit, held} = RX.state.plan, {y, radius, width} = layout, high = y - radius - 38;
    return `<text x="20" y="${high}">${text(field)}${unit ? ` [${text(unit)}]` : ''}</text><path d="M${width - 92} ${high - 4}h22" stroke="var(--rx-pinned)" stroke-width="1.6" stroke-dasharray="5 4"/><text x="${width - 64}" y="${high}">${held}</text>`
      + regions.map((one, k) => `<text x="20" y="${y + radius + 46 + 18 * k}"><tspan style="fill:${COLOURS[one.name]};font-weight:640">${text(one.title)}</tspan><tspan dx="7">${text(one.words)}</tspan></text>`).join('');
  }

  // Each label on the nearer side, as high as its region, none over another; what has no room left goes right.
  function labels(regions) {
    if (!layout.wide) return {lines: '', boxes: []};
    const low = seen('.rxf-field'), high = seen('.rxf-power');
    const columns = {
      left: {x: 16, from: (high?.bottom ?? 20) + 12, to: (low?.top ?? layout.height) - LABEL.height - 12, taken: []},
      right: {x: layout.width - LABEL.width - 16, from: 62, to: layout.height - LABEL.height - 16, taken: []},
    };
    const boxes = [];
    for (const one of regions) {
      const points = one.lines.reduce((most, line) => line.length > most.length ? line : most), side = points.reduce((sum, [x]) => sum + x, 0) < 0 ? 'left' : 'right';
      const middle = layout.y + layout.radius * points.reduce((sum, [, y]) => sum + y, 0) / points.length - LABEL.height / 2;
      const room = (layout.both ? [side, side === 'left' ? 'right' : 'left'] : ['left']).map(name => ({name, top: free(columns[name], middle)})).find(found => found.top !== null);
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
    return box && {left: box.left - stage.left, right: box.right - stage.left, top: box.top - stage.top, bottom: box.bottom - stage.top};
  }

  RX.paint('plan', now => {
    if (!now && page.hasAttribute('data-rubber')) return;  // It leaves with the blade.
    if (!now) delete page.dataset.plan;
    const told_now = now && now.regions.map(one => one.words).join();
    if (told_now !== told) { told = told_now; RX.again('field'); }  // Its key is that of the plan.
    place.hidden = !now;
    around.hidden = !now || Boolean(now.held);
    if (!now) { pointer = null; pins = []; around.innerHTML = ''; return; }
    if (!now.held && !around.childElementCount) around.innerHTML = '<div class="rxf-chart"></div>';
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
      ${rim()}${now.held ? key(shown) : ''}<g data-blades></g>${before}<g fill="none" stroke-linejoin="round">${outlines}${named.lines}</g><g data-tied></g><g data-cursor></g>`;
    place.querySelector('svg').setAttribute('viewBox', `0 0 ${width} ${height}`);
    place.querySelector('[data-labels]').innerHTML = named.boxes.map(({one, left, top}) => `<div class="rxf-card rxf-region" data-region="${one.name}" style="--c:${COLOURS[one.name]};left:${left}px;top:${top}px"><b>${text(one.title)}</b><span class="rxf-num">${text(one.words)}</span></div>`).join('');
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
  // A card's size is asked for once: to ask between two writes costs a layout.
  const sizes = {};
  function size(element) {
    const kind = `${element.querySelectorAll('dt').length} ${element.hasAttribute('data-pin')} ${RX.state.plan.field}`;
    return sizes[kind] ??= [element.offsetWidth || 150, element.offsetHeight || 110];
  }
  const inside = (left, top, w, h) => [Math.min(Math.max(8, left), layout.width - w - 8), Math.min(Math.max(8, top), layout.height - h - 8)];
  // Beside its point, away from the hub where there is room.
  function put(element, r, psi) {
    const [x, y] = xy(r, psi), [w, h] = size(element), [left, top] = inside(x >= layout.x ? x + 16 : x - 16 - w, y - h / 2, w, h);
    element.style.transform = `translate(${left.toFixed(0)}px, ${top.toFixed(0)}px)`;
  }
  // A pinned one where it hides least: no outline, no other card, and then as little of the disk as can be.
  function tie(all) {
    const stage = ['.rxf-power', '.rxf-field', '.rxf-views'].map(seen).filter(Boolean), named = [...place.querySelectorAll('[data-labels] > *')].map(one => ({left: one.offsetLeft, top: one.offsetTop, right: one.offsetLeft + one.offsetWidth, bottom: one.offsetTop + one.offsetHeight}));
    const points = RX.state.plan.regions.flatMap(one => one.lines.flat()).map(([px, py]) => [layout.x + layout.radius * px, layout.y + layout.radius * py]).concat(pins.map(pin => xy(pin.r, pin.psi)));
    const taken = [...stage, ...named], lines = [];
    pins.forEach((pin, k) => {
      if (!all[k]) return;
      const [x, y] = xy(pin.r, pin.psi), [w, h] = size(all[k]);
      let best = null;
      for (let angle = 0; angle < 360; angle += 15) for (const far of [14, 60, 120, 200, 300]) {
        const [ux, uy] = [Math.cos(angle * DEGREE), Math.sin(angle * DEGREE)], [left, top] = inside(x + ux * (far + w / 2) - w / 2, y + uy * (far + h / 2) - h / 2, w, h);
        const over = taken.filter(box => left < box.right && box.left < left + w && top < box.bottom && box.top < top + h).length;
        const hides = points.filter(([px, py]) => px > left - 6 && px < left + w + 6 && py > top - 6 && py < top + h + 6).length;
        const cost = 1000 * over + 12 * hides + far;
        if (!best || cost < best.cost) best = {cost, left, top};
      }
      taken.push({left: best.left, top: best.top, right: best.left + w, bottom: best.top + h});
      lines.push(`<path d="M${x} ${y}L${Math.min(Math.max(x, best.left), best.left + w)} ${Math.min(Math.max(y, best.top), best.top + h)}" stroke="var(--rx-accent)" stroke-width="1.5"/>`);
      all[k].style.transform = `translate(${best.left.toFixed(0)}px, ${best.top.toFixed(0)}px)`;
    });
    place.querySelector('[data-tied]').innerHTML = lines.join('');
  }
  function cursor() {
    const here = place.querySelector('[data-cursor]'), reading = place.querySelector('[data-reading]');
    if (!here) return;
    const dots = pins.map(pin => { const [x, y] = xy(pin.r, pin.psi); return `<circle cx="${x}" cy="${y}" r="4.5" fill="var(--rx-accent)" stroke="#fff" stroke-width="2"/>`; }).join('');
    const ring = RX.state.plan.held ? '' : `<circle cx="${layout.x}" cy="${layout.y}" r="${circle * layout.radius}" fill="none" stroke="#fff" stroke-opacity=".85" stroke-width="1.4"/>`;
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
    tie([...all.children]);
  }

  // α around the circle, with the stall angles there.
  function drawAround() {
    if (!tables.alpha || !layout.chart) return;
    const chart = around.firstElementChild, {width, height} = layout.chart, x = Array.from({length: 121}, (_, k) => 3 * k);
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
  for (const one of [place, ...document.querySelectorAll('.rxf-field, .rxf-power')]) new ResizeObserver(() => RX.again('plan')).observe(one);
})();
