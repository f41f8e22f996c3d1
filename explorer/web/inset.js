// @ts-check
// The reference blade seen end-on in an oblique projection: sections, ribbon, and the reference as a grey overlay.
(() => {
  const {DEGREE, text, lerp, trace} = Common, {part} = RX, degrees = angle => `${Common.signed(angle)}°`;
  const STOPS = [[52, 91, 219], [134, 84, 208], [208, 66, 130], [222, 64, 40]];
  const along = RX.along = share => {
    const k = Math.min(2, Math.floor(3 * share));
    return `rgb(${STOPS[k].map((value, j) => Math.round(lerp(value, STOPS[k + 1][j], 3 * share - k)))})`;
  };

  RX.paint('inset', inset => {
    const card = part('inset');
    card.hidden = !inset;
    if (!inset || document.documentElement.hasAttribute('data-twisting') || card.clientWidth < 80) return;
    const {r: stations, theta, overlay, cuts, datum, times} = inset, base = inset.overlay_datum;
    const width = card.clientWidth - 28, height = card.clientHeight - 15, [root] = stations, slope = .06 * height;
    const share = r => (r - root) / (1 - root);
    const changed = cut => cut.overlay !== null && Math.abs(cut.theta - cut.overlay) >= .05;
    // A point forward and up of the quarter chord, in chords, of a blade turned so much from its datum, drawn `times`.
    const turn = (corner, angle, from) => {
      const [x, z] = corner, drawn = (from + times * (angle - from)) * DEGREE, c = Math.cos(drawn), s = Math.sin(drawn);
      return [x * c - z * s, x * s + z * c];
    };
    // How far the drawn sections reach above and below: strong twist is drawn smaller, not over the numbers.
    const reach = cuts.flatMap(cut => [[cut.theta, datum], ...(cut.overlay === null ? [] : [[cut.overlay, base]])]
      .map(([angle, from]) => cut.outline.map(corner => turn(corner, angle, from)[1]))
      .map(ups => [share(cut.r), Math.max(...ups), -Math.min(...ups)]));
    let chord = Math.min(122, width / 6.2, .78 * height), y0 = 0;
    for (let tries = 0; tries < 12; tries++) {
      y0 = height - 33 - Math.max(.47 * chord, ...reach.map(([at, , down]) => down * chord + slope * at + 2));
      if (reach.every(([at, up]) => y0 + slope * at - up * chord > 17)) break;
      chord *= .93;
    }
    // From the quarter chord of the root to its trailing edge, in chords: more on a tapered blade.
    const aft = Math.max(...cuts[0].outline.map(corner => -turn(corner, cuts[0].theta, datum)[0]));
    const x0 = Math.max(.62 * chord + 8, aft * chord + 2, 84), x1 = width - .62 * chord - 12;
    const at = r => [lerp(x0, x1, share(r)), y0 + slope * share(r)];
    // The leading edge is drawn on the right.
    const point = (r, angle, corner, from = datum) => {
      const [x, y] = at(r), [forward, up] = turn(corner, angle, from);
      return [x + chord * forward, y - chord * up];
    };
    const edge = (angles, x, from) => stations.map((r, k) => point(r, angles[k], [x, 0], from));
    const lead = edge(theta, .25), trail = edge(theta, -.75), stops = [0, 1, 2, 3].map(k => k / 3);
    let drawn = `<defs><linearGradient id="rxi">
        ${stops.map(stop => `<stop offset="${stop}" stop-color="${along(stop)}"/>`).join('')}</linearGradient></defs>
      <path d="M${x0 - chord / 2} ${y0}L${x1 + .4 * chord} ${y0 + slope}" stroke="var(--rx-line)"/>`;
    if (cuts.some(changed))
      for (const x of [.25, -.75]) drawn += `<path d="${trace(edge(overlay, x, base))}" class="rxf-overlay"/>`;
    drawn += `<path d="${trace([...lead, ...trail.toReversed()])}Z" fill="url(#rxi)" opacity=".13"/>
      <path d="${trace(lead)}" stroke="url(#rxi)" stroke-width="1.6" fill="none"/>
      <path d="${trace(trail)}" stroke="url(#rxi)" stroke-width="1.6" fill="none" opacity=".75"/>`;
    const last = cuts.length - 1;
    cuts.forEach((cut, k) => {
      const {r, outline} = cut, [x] = at(r), odd = k % 2 === 1, shade = along(share(r));
      if (width < 560 && odd && k < last) return;  // In a narrow card every other section has room.
      const title = `${degrees(cut.theta - Number(cut.overlay))} from ${text(inset.overlay_name)}`;
      const shape = (angle, style, from) => `
        <path d="${trace(outline.map(corner => point(r, angle, corner, from)))}Z" ${style}>${
          changed(cut) ? `<title>${title}</title>` : ''}</path>`;
      if (changed(cut)) drawn += shape(cut.overlay, 'class="rxf-overlay-cut"', base);
      drawn += shape(cut.theta, `fill="${shade}" fill-opacity=".84" stroke="${shade}" data-grab="${r}"`);
      if (k < last && (odd || k === last - 1)) return;  // Every other section has numbers, none beside the tip's.
      drawn += `<text x="${x}" y="${height - 14}" text-anchor="middle" data-between
          style="fill:var(--rx-ink);font-weight:620;font-size:12px">${degrees(cut.theta)}</text>
        <text x="${x}" y="${height - 1}" text-anchor="middle" data-between>${r.toFixed(2)}</text>`;
    });
    // What the two rows of numbers are: a blade that is rigid in torsion flies in its jig shape.
    const of = inset.name === 'in flight' ? 'flight' : 'built';
    drawn += `<text x="0" y="${height - 14}" data-between>${of}</text>
      <text x="0" y="${height - 1}" data-between>r/R</text>`;
    const spoken = cuts.map(cut => `${degrees(cut.theta)} at ${cut.r.toFixed(2)} R`).join(', ');
    const key = (hint, mark, name) => `<span title="${text(hint)}"><i ${mark}></i>${text(name)}</span>`;
    card.innerHTML = `<div class="rxf-head"><b>Blade from the tip</b>
        <span class="rxf-dim">twist ×${times}${times > 1 && RX.state ? ', as in the scene' : ''}</span>
        <div class="rxf-key">${key(inset.name_hint, '', inset.name)}${
          overlay ? key(inset.overlay_hint, 'data-overlay',
            inset.overlay_name) : ''}<span>root ← r/R → tip</span></div></div>
      <svg viewBox="0 0 ${width} ${height}" role="img" aria-label="Twist, ${of}: ${spoken}">${drawn}</svg>`;
  });
})();
