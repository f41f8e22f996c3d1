// @ts-check
// One slow turn with a blade section: the camera goes with it. A card shows the way round and what separated flow costs
// so far, the air that the section meets, and the way of its point beside the static lift curve. Any key outside the
// panels, or a press on the scene, ends it.
(() => {
  const {DEGREE, text, clamp, lerp, distance, turned, fixed, trace, paced, viewer, calm, closest} = Common;
  const {outdate, staleMark} = Common;
  const {part} = RX, page = document.documentElement, place = part('ride'), TURN = 16000;
  const find = name => place.querySelector(name);
  const STAYS = 1500;  // [ms] What the turn has cost is read at its end.
  const MODIFIERS = ['Shift', 'Control', 'Alt', 'Meta', 'Tab'];
  let section = null, origin = null, begun = 0, arrived = 0, height = 118, covered = 0;
  const passing = paced(psi => RX.send('riding', psi), 250);

  RX.paint('ride', ride => {
    const begins = ride && !section;
    section = ride;
    page.toggleAttribute('data-ride', Boolean(ride));
    place.hidden = !ride;
    if (begins) {
      begun = performance.now();
      arrived = covered = 0;
      origin = document.activeElement;
      requestAnimationFrame(go);
      place.focus();
    }
    if (ride) return;
    passing.drop();
    Charts.turn(null);
    rotorScene.leave(false);
  });
  function go(now) {
    if (!section || !RX.state.ride) return;
    const share = Math.min((now - begun) / TURN, 1), shown = calm.matches ? Math.floor(12 * share) / 12 : share;
    const psi = section.psi + 360 * shown;
    draw(360 * shown);
    covered = cardShare();
    rotorScene.ride(psi * DEGREE, section, covered);
    Charts.turn({'ψ': turned(psi), 'r/R': section.r});
    passing.send(Math.round(turned(psi)));
    if (share === 1) arrived ||= now;
    if (arrived && now - arrived > STAYS) end(); else requestAnimationFrame(go);
  }
  // Which part of the canvas the card covers from below; another height of the card is followed slowly.
  function cardShare() {
    const canvas = viewer()?.canvas?.getBoundingClientRect();
    if (!canvas?.height) return 0;
    const share = clamp((canvas.bottom - place.getBoundingClientRect().top + 8) / canvas.height, 0, .6);
    return covered ? lerp(covered, share, .06) : share;
  }
  function end() {
    if (!section) return;
    section = null;
    passing.drop();
    if (place.contains(document.activeElement)) origin?.focus({preventScroll: true});
    place.hidden = true;
    page.removeAttribute('data-ride');
    Charts.turn(null);
    rotorScene.leave(true).then(() => RX.send('ride', 'off'));
  }
  addEventListener('keydown', event => {
    if (!section || MODIFIERS.includes(event.key) || closest(event, '[data-dock-region]')) return;
    if (event.key === 'Escape' || event.key === ' ') { event.stopPropagation(); event.preventDefault(); }
    end();
  }, true);
  // A press on the scene leads back and picks nothing there.
  addEventListener('pointerdown', event => {
    if (!section || !closest(event, 'canvas')) return;
    event.stopPropagation();
    end();
  }, true);
  place.addEventListener('click', event => { if (closest(event, '[data-page-ride]')) end(); });
  // The same button leads back.
  addEventListener('click', event => {
    if (!section || !closest(event, '[data-do=view][data-value=ride]')) return;
    event.stopPropagation();
    end();
  }, true);

  function arrow(from, to, colour, width) {
    const length = distance(from, to), [ux, uy] = from.map((value, k) => (to[k] - value) / length);
    if (length < 2) return '';
    const head = Math.min(9, .6 * length), x = to[0] - head * ux, y = to[1] - head * uy, half = .45 * head;
    const corners = [to, [x - half * uy, y + half * ux], [x + half * uy, y - half * ux]];
    return `<path d="${trace([from, [x, y]])}" stroke="${colour}" stroke-width="${width}"/>
      <path d="${trace(corners)}Z" fill="${colour}"/>`;
  }
  // The values of the section at an azimuth, between the points of its turn.
  function valuesAt(psi) {
    const {u, phi, theta, alpha, cl, lift, static: curve} = section, column = psi / 360 * u.length;
    const k = Math.floor(column) % u.length, next = (k + 1) % u.length, share = column - Math.floor(column);
    // Where the flow turns round between two points the nearer one counts: an angle half way would be of neither.
    const turns = u[k] * u[next] < 0, jumps = Math.abs(phi[next] - phi[k]) > 180, nearer = share < .5 ? k : next;
    const at = list => turns ? list[nearer] : lerp(list[k], list[next], share);
    return {
      nearer, u: at(u), theta: at(theta), alpha: at(alpha), cl: at(cl), lift: at(lift),
      still: at(curve),
      phi: jumps ? phi[nearer] : at(phi),
    };
  }
  // The section with the air it meets and its lift.
  function drawSection({u, phi, theta, lift}, half) {
    const fastest = Math.max(...section.u.map(Math.abs)), most = Math.max(...section.lift.map(Math.abs));
    const chord = Math.min(150, .42 * half), x = half - .72 * chord - 34, y = .62 * height;
    const c = Math.cos(theta * DEGREE), s = Math.sin(theta * DEGREE);
    const across = Math.cos(phi * DEGREE), down = Math.sin(phi * DEGREE);
    const point = ([forward, up]) => [x - chord * (forward * c - up * s), y - chord * (forward * s + up * c)];
    const reach = Math.max(.25, .9 * half - chord) * Math.abs(u) / fastest, edge = point([u < 0 ? -.8 : .32, 0]);
    const start = [edge[0] - reach * across, edge[1] - reach * down];
    const size = .56 * height * lift / most, tip = [x + size * down, y - size * across];
    return `<path d="M4 ${y}H${half - 4}" stroke="var(--rx-faint)" stroke-dasharray="5 4"/>
      <path d="${trace(section.outline.map(point))}Z" fill="var(--rx-blade)" fill-opacity=".85"/>
      ${arrow(start, edge, 'var(--rx-ink)', 2.4)}${arrow([x, y], tip, 'var(--rx-accent)', 3)}
      <text x="4" y="${y + 16}">disk plane</text>
      <text x="${(start[0] + edge[0]) / 2}" y="${Math.min(start[1], edge[1]) - 9}" text-anchor="middle">${
        fixed(Math.abs(u))} m/s</text>
      ${Math.abs(size) < 16 ? '' : `<text x="${tip[0] + 8}" y="${tip[1] + (size > 0 ? 10 : 2)}"
        style="fill:var(--rx-accent)">lift</text>`}`;
  }
  // The part of the turn that lies behind, as pieces of points of the lift curve; the blade has none in reverse flow.
  function wayBehind(passed, {X, Y}) {
    const {psi, u, alpha, cl} = section, step = 360 / u.length, pieces = [/** @type {any[]} */ ([])];
    const stops = [psi];
    for (let k = Math.floor(psi / step) + 1; k * step < psi + passed; k++) stops.push(k * step);
    stops.push(psi + passed);
    for (const stop of stops) {
      const k = Math.floor(turned(stop) / step) % u.length, next = (k + 1) % u.length;
      const share = turned(stop) / step - Math.floor(turned(stop) / step);
      if (u[k] < 0 || u[next] < 0) pieces.push([]);
      else pieces[pieces.length - 1].push([X(lerp(alpha[k], alpha[next], share)), Y(lerp(cl[k], cl[next], share))]);
    }
    return pieces.filter(piece => piece.length > 1).map(trace).join('');
  }
  // Lift over the angle of attack: the static curve and its stall angle, the way behind the section, and its point with
  // that of the static curve at the same angle.
  function drawLift({u, nearer, alpha, cl, still}, passed, frame) {
    const {chart, angles, curves, mach, stall} = section, {X, Y, top, base, left, right} = frame;
    const [first, last] = chart.x.range, seen = alpha >= first && alpha <= last, x = X(alpha).toFixed(1);
    const angle = stall[nearer], near = angle !== null && X(angle) > right - 70;
    const limit = u < 0 || angle === null || angle > last ? '' : `
      <path d="M${X(angle).toFixed(1)} ${top}V${base}" stroke="var(--rx-stall)" stroke-width="1.2"
        stroke-dasharray="4 3"/>
      <text x="${(X(angle) + (near ? -5 : 5)).toFixed(1)}" y="${base - 4}" text-anchor="${near ? 'end' : 'start'}"
        style="fill:var(--rx-stall)">static stall</text>`;
    const apart = Math.abs(Y(cl) - Y(still)) > 5;
    const dots = `${apart ? `<path d="M${x} ${Y(still).toFixed(1)}V${Y(cl).toFixed(1)}" stroke="var(--rx-blade)"
        stroke-width="1.6"/><circle cx="${x}" cy="${Y(still).toFixed(1)}" r="4" fill="var(--rx-paper)"
        stroke="var(--rx-dim)" stroke-width="1.6" data-static/>` : ''}
      <circle cx="${x}" cy="${Y(cl).toFixed(1)}" r="6.5" fill="var(--rx-blade)" stroke="var(--rx-paper)"
        stroke-width="2" data-flown/>`;
    return `${Charts.axes(chart, frame)}${Charts.inside(chart, frame)}${limit}
      <path d="${trace(angles.map((at, k) => [X(at), Y(curves[nearer][k])]))}" fill="none" stroke-width="1.3"
        stroke="var(--rx-dim)" ${u < 0 ? 'stroke-dasharray="5 4"' : ''} data-curve/>
      <path d="${wayBehind(passed, frame) || 'M0 0'}" fill="none" stroke="var(--rx-accent)" stroke-width="2.4"
        stroke-linejoin="round" data-way/>
      <text x="${left + 5}" y="10">C<tspan dy="3" font-size="80%">l</tspan><tspan dy="-3"> at Mach ${
        fixed(mach[nearer], 2)}</tspan></text>${seen ? dots : ''}`;
  }
  // The turn seen from above, the nose up: what lies behind by its flow, where the flow will be separated, and what
  // separated flow has cost the rotor on the way.
  const ATTACHED = {colour: 'var(--rx-accent)', width: 3};
  const FLOWS = {
    separated: {colour: 'var(--rx-stall)', width: 8}, past: {colour: 'var(--rx-stall)', width: 3},
    reverse: {colour: 'var(--rx-faint)', width: 3},
  };
  function drawTurn(passed) {
    const {psi, region} = section, step = 360 / region.length, middle = height / 2, radius = middle - 9;
    const at = (angle, out) => [middle + out * Math.sin(angle * DEGREE), middle + out * Math.cos(angle * DEGREE)];
    const arc = (from, to) => {
      const many = Math.max(1, Math.ceil((to - from) / 4));
      return trace(Array.from({length: many + 1}, (_, k) => at(lerp(from, to, k / many), radius)));
    };
    // A point of the turn stands for the part about it, half a step to either side.
    const parts = region.map((name, k) => ({kind: name.split(' ')[0], from: (k - .5) * step, to: (k + .5) * step}));
    const stroke = (from, to, {colour, width}, more = '') =>
      `<path d="${arc(from, to)}" fill="none" stroke="${colour}" stroke-width="${width}" ${more}/>`;
    const ahead = parts.filter(({kind}) => kind === 'separated')
      .map(({from, to}) => stroke(from, to, FLOWS.separated, 'opacity=".25"'));
    const behind = parts.flatMap(({kind, from, to}) => [-360, 0, 360, 720].flatMap(turn => {
      const [first, last] = [Math.max(from + turn, psi), Math.min(to + turn, psi + passed)];
      return last > first ? [stroke(first, last, FLOWS[kind] ?? ATTACHED,
        kind === 'separated' ? 'data-separated' : '')] : [];
    }));
    const [x, y] = at(psi + passed, radius);
    return `<circle cx="${middle}" cy="${middle}" r="${radius}" fill="none" stroke="var(--rx-line)" stroke-width="3"/>
      ${ahead.join('')}${behind.join('')}
      <circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="6.5" fill="var(--rx-blade)" stroke="var(--rx-paper)"
        stroke-width="2"/>${drawCost(passed, middle)}`;
  }
  // What separated flow has cost from the beginning of the turn, in the unit of the page.
  function costSoFar(passed, {spent}) {
    const from = turned(section.psi) / 360, to = from + passed / 360, price = spent.at(-1), many = spent.length - 1;
    const sum = turns => {
      const whole = Math.floor(turns), column = (turns - whole) * many, k = Math.floor(column);
      return whole * price + lerp(spent[k], spent[k + 1] ?? price, column - k);
    };
    return passed >= 360 ? price : sum(to) - sum(from);
  }
  function drawCost(passed, middle) {
    const cost = RX.state.ride_cost;
    if (!cost?.spent.length) return '';
    const sum = fixed(costSoFar(passed, cost), 1), mark = staleMark(cost.stale);
    return `<text x="${middle}" y="${middle + 3}" text-anchor="middle" class="rxf-num" data-cost${mark}>${sum}</text>
      <text x="${middle}" y="${middle + 17}" text-anchor="middle">${text(cost.unit)}${
        passed < 360 ? ' so far' : ''}</text>`;
  }
  // margin: to the static stall angle [°] in words, null where there is none.
  function flowOf(region, margin) {
    if (region === 'separated') return ' · separated';
    if (region.startsWith('past')) return ` · ${margin.replace('−', '')}° ${region}`;
    return margin ? ` · ${margin}° to static stall` : '';
  }
  // passed: of the turn [°].
  function draw(passed) {
    height = clamp(.17 * innerHeight, 84, 118);
    const psi = turned(section.psi + passed), values = valuesAt(psi), {nearer, u, alpha} = values;
    const region = section.region[nearer], bad = region === 'separated';
    const width = place.clientWidth - 32, narrow = width <= 560, rest = width - height - 14;
    const half = narrow ? rest : .44 * rest;
    const frame = Charts.frame(section.chart, narrow ? rest : rest - half - 14, height, {bottom: 18});
    const words = u < 0 ? `${region}: the air comes from the trailing edge`
      : `α ${fixed(alpha, 1)}°${flowOf(region, section.margin[nearer])}`;
    const filled = Math.min(100 * (section.filled[nearer] ?? 0), 100), cost = RX.state.ride_cost;
    const parted = section.region.includes('separated');
    const svg = (size, name, label, content) => `<svg viewBox="0 0 ${size} ${height}" style="width:${size}px" role="img"
      data-${name} aria-label="${label}">${content}</svg>`;
    const price = parted || !cost?.spent.length ? cost?.words ?? ''
      : `${cost.words}; nothing is separated at this radius`;
    find('b').textContent = `${section.r.toFixed(2)} R · ψ ${Math.round(psi)}°`;
    find('.rxf-dim').textContent = `${section.where[nearer]} · ${section.section}`;
    find('[data-value]').textContent = words;
    find('[data-value]').classList.toggle('rxf-bad', bad);
    find('.rxf-filled').classList.toggle('rxf-bad', bad);
    find('.rxf-filled').ariaLabel = `Angle of attack over the static stall angle: ${Math.round(filled)} %`;
    find('.rxf-filled i').style.width = `${filled.toFixed(1)}%`;
    find('[data-explorer=ride-seen]').textContent = section.seen[nearer];
    find('[data-explorer=ride-cost]').textContent = price;
    outdate(find('[data-explorer=ride-cost]'), cost?.stale);
    find('.rxf-row').innerHTML = `${svg(height, 'ring',
      'The turn from above, the nose up: where the flow is separated', drawTurn(passed))}${svg(half, 'section',
      'The section with the air it meets and its lift', drawSection(values, half))}${svg(frame.width, 'lift',
      'Lift coefficient over the angle of attack: the static curve and the way of this section',
      drawLift(values, passed, frame))}`;
  }
  // What a press may meet stays the same while the numbers change.
  place.innerHTML = `<div class="rxf-head"><b class="rxf-num"></b><span class="rxf-dim"></span>
      <span class="rxf-num" data-value></span>
      <button data-page-ride aria-label="Leave the blade" title="Leave the blade (Esc)">×</button></div>
    <div class="rxf-filled" role="img"><i></i></div>
    <p><span data-explorer="ride-seen"></span><span class="rxf-num" data-explorer="ride-cost"></span></p>
    <div class="rxf-row"></div>`;
})();
