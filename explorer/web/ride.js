// One slow turn with a blade section: the camera goes with it; a card shows the air it meets, its lift, and its point
// on the lift curve. Any key, or a press beside the card, leads out again.
(() => {
  const {text, part} = RX, {fixed} = Charts, page = document.documentElement, place = part('ride'), DEGREE = Math.PI / 180, TURN = 16000, HEIGHT = 178;
  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  let now = null, begun = 0;

  RX.paint('ride', next => {
    const first = next && !now;
    now = next;
    page.toggleAttribute('data-ride', Boolean(now));
    place.hidden = !now;
    if (first) { begun = performance.now(); requestAnimationFrame(go); place.focus(); }
    if (!now) rotorScene.leave();
  });
  function go(at) {
    if (!now) return;
    const share = Math.min((at - begun) / TURN, 1), psi = now.psi + 360 * (calm.matches ? Math.floor(12 * share) / 12 : share);
    rotorScene.ride(psi * DEGREE, now.out, now.radius);
    draw((psi % 360 + 360) % 360);
    if (share < 1) requestAnimationFrame(go); else end();
  }
  function end() {
    if (!now) return;
    now = null;
    place.hidden = true;
    page.removeAttribute('data-ride');
    rotorScene.leave().then(() => RX.send('ride', 'off'));
  }
  addEventListener('keydown', event => {
    if (!now || ['Shift', 'Control', 'Alt', 'Meta', 'Tab'].includes(event.key) || event.target.closest?.('[data-dock-region]')) return;
    if (event.key === 'Escape' || event.key === ' ') { event.stopPropagation(); event.preventDefault(); }
    end();
  }, true);
  addEventListener('pointerdown', event => { if (now && event.target.matches?.('canvas')) end(); }, true);

  const arrow = ([ax, ay], [bx, by], colour, width) => {
    const long = Math.hypot(bx - ax, by - ay);
    if (long < 2) return '';
    const [ux, uy] = [(bx - ax) / long, (by - ay) / long], head = Math.min(9, .6 * long), [cx, cy] = [bx - head * ux, by - head * uy];
    return `<path d="M${ax.toFixed(1)} ${ay.toFixed(1)}L${cx.toFixed(1)} ${cy.toFixed(1)}" stroke="${colour}" stroke-width="${width}"/><path d="M${bx.toFixed(1)} ${by.toFixed(1)}L${(cx - .45 * head * uy).toFixed(1)} ${(cy + .45 * head * ux).toFixed(1)}L${(cx + .45 * head * uy).toFixed(1)} ${(cy - .45 * head * ux).toFixed(1)}Z" fill="${colour}"/>`;
  };
  function draw(psi) {
    const many = now.u.length, column = psi / 360 * many, k = Math.floor(column) % many, next = (k + 1) % many, late = column - Math.floor(column);
    // Where the flow turns round between two points the nearer one counts: an angle half way between would be of neither.
    const turns = now.u[k] * now.u[next] < 0, nearer = late < .5 ? k : next, of = list => turns ? list[nearer] : list[k] + late * (list[next] - list[k]);
    const phi = turns || Math.abs(now.phi[next] - now.phi[k]) > 180 ? now.phi[nearer] : of(now.phi);
    const u = of(now.u), theta = of(now.theta), alpha = of(now.alpha), cl = of(now.cl), lift = of(now.lift);
    const width = place.clientWidth - 32, half = width > 560 ? .48 * width : width, fastest = Math.max(...now.u.map(Math.abs)), most = Math.max(...now.lift.map(Math.abs));
    const chord = Math.min(150, .42 * half), x = half - .72 * chord - 34, y = .62 * HEIGHT, t = theta * DEGREE, p = phi * DEGREE;
    const turned = ([forward, up]) => [x - chord * (forward * Math.cos(t) - up * Math.sin(t)), y - chord * (forward * Math.sin(t) + up * Math.cos(t))];
    const reach = Math.max(.25, .9 * half - chord) * Math.abs(u) / fastest, edge = turned([u < 0 ? -.8 : .32, 0]), start = [edge[0] - reach * Math.cos(p), edge[1] - reach * Math.sin(p)];
    const size = .56 * HEIGHT * lift / most, tip = [x + size * Math.sin(p), y - size * Math.cos(p)];
    const section = `<path d="M4 ${y}H${half - 4}" stroke="var(--rx-faint)" stroke-dasharray="5 4"/><path d="M${now.outline.map(one => turned(one).map(v => v.toFixed(1)).join(' ')).join('L')}Z" fill="var(--rx-blade)" fill-opacity=".85"/>
      ${arrow(start, edge, 'var(--rx-ink)', 2.4)}${arrow([x, y], tip, 'var(--rx-accent)', 3)}<text x="4" y="${y + 16}">disk plane</text>
      <text x="${(start[0] + edge[0]) / 2}" y="${Math.min(start[1], edge[1]) - 9}" text-anchor="middle">${fixed(Math.abs(u))} m/s</text><text x="${tip[0] + 8}" y="${tip[1] + (size > 0 ? 10 : 2)}" style="fill:var(--rx-accent)">lift</text>`;
    const {chart} = now, frame = Charts.frame(chart, width > 560 ? width - half - 12 : width, HEIGHT, {bottom: 18}), curve = now.curves[nearer], behind = u < 0;
    const line = now.angles.map((a, n) => `${frame.X(a).toFixed(1)} ${frame.Y(curve[n]).toFixed(1)}`).join('L');
    const lifted = `${Charts.axes(chart, frame)}${Charts.inside(chart, frame)}<path d="M${line}" fill="none" stroke="var(--rx-dim)" stroke-width="1.6" ${behind ? 'stroke-dasharray="5 4"' : ''}/>
      <text x="${frame.X(0) + 6}" y="10">C_l at Mach ${fixed(now.mach[nearer], 2)}</text>${Math.abs(alpha) > chart.x.range[1] ? '' : `<circle cx="${frame.X(alpha).toFixed(1)}" cy="${frame.Y(cl).toFixed(1)}" r="6.5" fill="var(--rx-blade)" stroke="var(--rx-paper)" stroke-width="2"/>`}`;
    const bad = now.region[nearer] === 'stalled', words = behind ? `${now.region[nearer]}: the air comes from the trailing edge` : `α ${fixed(alpha, 1)}° · ${bad ? 'stalled' : `${now.margin[nearer]}° to stall`}`;
    place.innerHTML = `<div class="rxf-head"><b class="rxf-num">${now.r.toFixed(2)} R · ψ ${Math.round(psi)}°</b><span class="rxf-dim">${text(now.where[nearer])} · ${text(now.section)}</span>
        <span class="rxf-num ${bad ? 'rxf-bad' : ''}" data-value>${text(words)}</span><button data-page-ride aria-label="Leave the blade" title="Leave the blade (Esc)">×</button></div>
      <svg viewBox="0 0 ${half} ${HEIGHT}" style="width:${half}px" role="img" aria-label="The section with the air it meets and its lift">${section}</svg><svg viewBox="0 0 ${frame.width} ${HEIGHT}" style="width:${frame.width}px" role="img" aria-label="Lift coefficient over the angle of attack, with this section's point">${lifted}</svg>`;
  }
  place.addEventListener('click', event => { if (event.target.closest('[data-page-ride]')) end(); });
})();
