// The reference blade seen end-on in an oblique projection: sections, ribbon, and the reference as a grey ghost.
(() => {
  const {text, part} = RX, DEGREE = Math.PI / 180;
  const STOPS = [[52, 91, 219], [134, 84, 208], [208, 66, 130], [222, 64, 40]];
  const along = t => {
    const k = Math.min(2, Math.floor(3 * t)), f = 3 * t - k;
    return `rgb(${STOPS[k].map((v, j) => Math.round(v + f * (STOPS[k + 1][j] - v)))})`;
  };
  RX.along = along;
  const signed = value => Charts.signed(value) + '°';

  RX.paint('inset', now => {
    const card = part('inset');
    card.hidden = !now;
    if (!now || card.clientWidth < 80) return;
    const width = card.clientWidth - 28, height = card.clientHeight - 15, root = now.r[0];
    const share = r => (r - root) / (1 - root);
    // How far the drawn sections reach above and below the quarter chord, in chords: strong twist is drawn smaller, not over the numbers.
    const reach = now.cuts.flatMap(cut => [[cut.theta, now.datum], [cut.ghost ?? cut.theta, cut.ghost === null ? now.datum : now.ghost_datum]].map(([angle, datum]) => {
      const drawn = (datum + now.times * (angle - datum)) * DEGREE, ups = cut.outline.map(([x, z]) => x * Math.sin(drawn) + z * Math.cos(drawn));
      return [share(cut.r), Math.max(...ups), -Math.min(...ups)];
    }));
    let chord = Math.min(122, width / 6.2, 0.78 * height), y0 = 0;
    for (let tries = 0; tries < 12; tries++) {
      y0 = height - 33 - Math.max(0.47 * chord, ...reach.map(([at, , down]) => down * chord + 0.06 * height * at + 2));
      if (reach.every(([at, up]) => y0 + 0.06 * height * at - up * chord > 17)) break;
      chord *= 0.93;
    }
    const x0 = Math.max(0.62 * chord + 8, 84), x1 = width - 0.62 * chord - 12, y1 = y0 + 0.06 * height, at = r => [x0 + (x1 - x0) * share(r), y0 + (y1 - y0) * share(r)];
    // Points forward and up of the quarter chord, in chords; the leading edge is drawn on the right.
    const turned = ([ox, oy], angle, [x, z], datum = now.datum) => {
      const drawn = (datum + now.times * (angle - datum)) * DEGREE, c = Math.cos(drawn), s = Math.sin(drawn);
      return `${(ox + chord * (x * c - z * s)).toFixed(1)} ${(oy - chord * (x * s + z * c)).toFixed(1)}`;
    };
    const edge = (angles, x, datum) => now.r.map((r, k) => turned(at(r), angles[k], [x, 0], datum));
    const lead = edge(now.theta, .25), trail = edge(now.theta, -.75), changed = one => one.ghost !== null && Math.abs(one.theta - one.ghost) >= .05;
    let inside = `<defs><linearGradient id="rxi">${[0, 1, 2, 3].map(k => `<stop offset="${k / 3}" stop-color="${along(k / 3)}"/>`).join('')}</linearGradient></defs>`;
    inside += `<path d="M${x0 - chord / 2} ${y0}L${x1 + .4 * chord} ${y1}" stroke="var(--rx-line)"/>`;
    if (now.cuts.some(changed)) for (const x of [.25, -.75]) inside += `<path d="M${edge(now.ghost, x, now.ghost_datum).join('L')}" class="rxf-ghost-line"/>`;
    inside += `<path d="M${lead.join('L')}L${trail.slice().reverse().join('L')}Z" fill="url(#rxi)" opacity=".13"/><path d="M${lead.join('L')}" stroke="url(#rxi)" stroke-width="1.6" fill="none"/><path d="M${trail.join('L')}" stroke="url(#rxi)" stroke-width="1.6" fill="none" opacity=".75"/>`;
    // In a narrow card every other section has room.
    const sparse = width < 560;
    now.cuts.forEach((cut, k) => {
      if (sparse && k % 2 === 1 && k < now.cuts.length - 1) return;
      const o = at(cut.r), shade = along(share(cut.r)), shape = (angle, kind, datum) => `<path d="M${cut.outline.map(p => turned(o, angle, p, datum)).join('L')}Z" ${kind}>${changed(cut) ? `<title>${signed(cut.theta - cut.ghost)} from ${text(now.ghost_name)}</title>` : ''}</path>`;
      if (changed(cut)) inside += shape(cut.ghost, 'class="rxf-ghost-cut"', now.ghost_datum);
      inside += shape(cut.theta, `fill="${shade}" fill-opacity=".84" stroke="${shade}" data-grab="${cut.r}"`);
      if (k < now.cuts.length - 1 && (k % 2 || k === now.cuts.length - 2)) return;  // Every other section has numbers, none beside the tip's.
      inside += `<text x="${o[0]}" y="${height - 14}" text-anchor="middle" style="fill:var(--rx-ink);font-weight:620;font-size:12px">${signed(cut.theta)}</text>
        <text x="${o[0]}" y="${height - 1}" text-anchor="middle" data-between>${cut.r.toFixed(2)}</text>`;
    });
    // What the two rows of numbers are.
    inside += `<text x="0" y="${height - 14}">twist</text><text x="0" y="${height - 1}" data-between>r/R</text>`;
    const spoken = now.cuts.map(cut => `${signed(cut.theta)} at ${cut.r.toFixed(2)} R`).join(', ');
    card.innerHTML = `<div class="rxf-head"><b>Blade from the tip</b><button class="rxf-dim" data-do="times" title="Twist exaggeration, here and in the scene">twist ×${now.times}${now.times > 1 ? ', as in the scene' : ''}</button>
      <div class="rxf-key"><span title="${text(now.name_hint)}"><i></i>${text(now.name)}</span>${now.ghost ? `<span title="${text(now.ghost_hint)}"><i data-ghost></i>${text(now.ghost_name)}</span>` : ''}<span>root ← r/R → tip</span></div></div>
      <svg viewBox="0 0 ${width} ${height}" role="img" aria-label="Twist: ${spoken}">${inside}</svg>`;
  });
})();
