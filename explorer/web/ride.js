// @ts-check
// One slow turn with a blade section: the camera goes with it; a card shows the air it meets, its lift, and its point
// on the lift curve. Any key, or a press beside the card, leads out again.
(() => {
  const {DEGREE, text, lerp, distance, turned, fixed, trace, calm, closest} = Common;
  const {part} = RX, page = document.documentElement, place = part('ride'), TURN = 16000, HEIGHT = 118;
  const MODIFIERS = ['Shift', 'Control', 'Alt', 'Meta', 'Tab'];
  let section = null, begun = 0;

  RX.paint('ride', ride => {
    const begins = ride && !section;
    section = ride;
    page.toggleAttribute('data-ride', Boolean(ride));
    place.hidden = !ride;
    if (begins) { begun = performance.now(); requestAnimationFrame(go); place.focus(); }
    if (!ride) rotorScene.leave();
  });
  function go(now) {
    if (!section) return;
    const share = Math.min((now - begun) / TURN, 1), shown = calm.matches ? Math.floor(12 * share) / 12 : share;
    const psi = section.psi + 360 * shown;
    rotorScene.ride(psi * DEGREE, section);
    draw(turned(psi));
    if (share < 1) requestAnimationFrame(go); else end();
  }
  function end() {
    if (!section) return;
    section = null;
    place.hidden = true;
    page.removeAttribute('data-ride');
    rotorScene.leave().then(() => RX.send('ride', 'off'));
  }
  addEventListener('keydown', event => {
    if (!section || MODIFIERS.includes(event.key) || closest(event, '[data-dock-region]')) return;
    if (event.key === 'Escape' || event.key === ' ') { event.stopPropagation(); event.preventDefault(); }
    end();
  }, true);
  addEventListener('pointerdown', event => { if (closest(event, 'canvas')) end(); }, true);
  place.addEventListener('click', event => { if (closest(event, '[data-page-ride]')) end(); });

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
    const {u, phi, theta, alpha, cl, lift} = section, column = psi / 360 * u.length;
    const k = Math.floor(column) % u.length, next = (k + 1) % u.length, share = column - Math.floor(column);
    // Where the flow turns round between two points the nearer one counts: an angle half way would be of neither.
    const turns = u[k] * u[next] < 0, jumps = Math.abs(phi[next] - phi[k]) > 180, nearer = share < .5 ? k : next;
    const at = list => turns ? list[nearer] : lerp(list[k], list[next], share);
    return {
      nearer, u: at(u), theta: at(theta), alpha: at(alpha), cl: at(cl), lift: at(lift),
      phi: jumps ? phi[nearer] : at(phi),
    };
  }
  // The section with the air it meets and its lift.
  function drawSection({u, phi, theta, lift}, half) {
    const fastest = Math.max(...section.u.map(Math.abs)), most = Math.max(...section.lift.map(Math.abs));
    const chord = Math.min(150, .42 * half), x = half - .72 * chord - 34, y = .62 * HEIGHT;
    const c = Math.cos(theta * DEGREE), s = Math.sin(theta * DEGREE);
    const across = Math.cos(phi * DEGREE), down = Math.sin(phi * DEGREE);
    const point = ([forward, up]) => [x - chord * (forward * c - up * s), y - chord * (forward * s + up * c)];
    const reach = Math.max(.25, .9 * half - chord) * Math.abs(u) / fastest, edge = point([u < 0 ? -.8 : .32, 0]);
    const start = [edge[0] - reach * across, edge[1] - reach * down];
    const size = .56 * HEIGHT * lift / most, tip = [x + size * down, y - size * across];
    return `<path d="M4 ${y}H${half - 4}" stroke="var(--rx-faint)" stroke-dasharray="5 4"/>
      <path d="${trace(section.outline.map(point))}Z" fill="var(--rx-blade)" fill-opacity=".85"/>
      ${arrow(start, edge, 'var(--rx-ink)', 2.4)}${arrow([x, y], tip, 'var(--rx-accent)', 3)}
      <text x="4" y="${y + 16}">disk plane</text>
      <text x="${(start[0] + edge[0]) / 2}" y="${Math.min(start[1], edge[1]) - 9}" text-anchor="middle">${
        fixed(Math.abs(u))} m/s</text>
      <text x="${tip[0] + 8}" y="${tip[1] + (size > 0 ? 10 : 2)}" style="fill:var(--rx-accent)">lift</text>`;
  }
  // Lift over the angle of attack, with this section's point.
  function drawLift({u, nearer, alpha, cl}, frame) {
    const {chart, angles, curves, mach} = section, {X, Y} = frame;
    const dot = `<circle cx="${X(alpha).toFixed(1)}" cy="${Y(cl).toFixed(1)}" r="6.5" fill="var(--rx-blade)"
      stroke="var(--rx-paper)" stroke-width="2"/>`;
    return `${Charts.axes(chart, frame)}${Charts.inside(chart, frame)}
      <path d="${trace(angles.map((angle, k) => [X(angle), Y(curves[nearer][k])]))}" fill="none" stroke="var(--rx-dim)"
        stroke-width="1.6" ${u < 0 ? 'stroke-dasharray="5 4"' : ''}/>
      <text x="${X(0) + 6}" y="10">C<tspan dy="3" font-size="80%">l</tspan><tspan dy="-3"> at Mach ${
        fixed(mach[nearer], 2)}</tspan></text>
      ${Math.abs(alpha) > chart.x.range[1] ? '' : dot}`;
  }
  // margin: to the static stall angle [°] in words, null where there is none.
  function flowOf(region, margin) {
    if (region === 'separated') return ' · separated';
    if (region.startsWith('past')) return ` · ${margin.replace('−', '')}° ${region}`;
    return margin ? ` · ${margin}° to static stall` : '';
  }
  function draw(psi) {
    const values = valuesAt(psi), {nearer, u, alpha} = values;
    const region = section.region[nearer], bad = region === 'separated';
    const width = place.clientWidth - 32, wide = width > 560, half = wide ? .48 * width : width;
    const frame = Charts.frame(section.chart, wide ? width - half - 12 : width, HEIGHT, {bottom: 18});
    const words = u < 0 ? `${region}: the air comes from the trailing edge`
      : `α ${fixed(alpha, 1)}°${flowOf(region, section.margin[nearer])}`;
    const filled = Math.min(100 * (section.filled[nearer] ?? 0), 100);
    const svg = (size, label, content) => `<svg viewBox="0 0 ${size} ${HEIGHT}" style="width:${size}px" role="img"
      aria-label="${label}">${content}</svg>`;
    place.innerHTML = `<div class="rxf-head"><b class="rxf-num">${section.r.toFixed(2)} R · ψ ${Math.round(psi)}°</b>
        <span class="rxf-dim">${text(section.where[nearer])} · ${text(section.section)}</span>
        <span class="rxf-num ${bad ? 'rxf-bad' : ''}" data-value>${text(words)}</span>
        <button data-page-ride aria-label="Leave the blade" title="Leave the blade (Esc)">×</button></div>
      <div class="rxf-filled ${bad ? 'rxf-bad' : ''}" role="img"
        aria-label="Angle of attack over the static stall angle: ${Math.round(filled)} %">
        <i style="width:${filled.toFixed(1)}%"></i></div>
      ${svg(half, 'The section with the air it meets and its lift', drawSection(values, half))}${svg(frame.width,
        'Lift coefficient over the angle of attack, with the point of this section', drawLift(values, frame))}`;
  }
})();
