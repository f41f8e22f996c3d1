// The blade twisted by hand: while a station is held half the stage is the blade from the tip, the other half the live
// plan of the disk (plan.js), with a scale of power above. Jig twist, drawn four times; the server moves the sliders.
(() => {
  const {text, part} = RX, place = part('rubber'), disk = part('plan'), page = document.documentElement, DEGREE = Math.PI / 180;
  const TIMES = 4, MORPH = 400, SECTIONS = 30, TRAIL = .75, SCALE = 92;
  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  const lerp = (a, b, t) => a + (b - a) * t, ease = t => t * t * (3 - 2 * t), clamp = (v, low, high) => Math.min(Math.max(v, low), Math.max(low, high));
  const signed = v => Charts.signed(v) + '°';
  let held = null, shown = 0, towards = 0, before = 0, running = false, pointer = {x: 0, y: 0, down: false}, sent = 0, waiting = null;

  for (const [name, down] of [['pointerdown', true], ['pointermove', null], ['pointerup', false], ['pointercancel', false]])
    addEventListener(name, event => {
      if (!event.isPrimary) return;
      pointer = {x: event.clientX, y: event.clientY, down: down ?? pointer.down};
      if (held?.by !== 'hand') return;
      if (name === 'pointermove') turn();
      else if (down === false) release();
    }, true);

  // Twist less that at 0.75 R [°] of a line of the twist chart.
  const line = role => RX.state.twist?.chart.series[RX.state.twist.places[role]];
  const twist = (curve, r) => {
    const {x, y} = curve, k = clamp(x.findIndex(one => one >= r), 1, x.length - 1);
    return lerp(y[k - 1], y[k], clamp((r - x[k - 1]) / (x[k] - x[k - 1]), 0, 1));
  };
  // What a turn of the held station does to the blade: straight to its neighbours, until the server's answer comes.
  const hat = r => {
    const {stations, at} = held, own = stations[at];
    if (r === own) return 1;
    const next = stations[r < own ? at - 1 : at + 1];
    return next === undefined ? 0 : Math.max(0, 1 - Math.abs(r - own) / Math.abs(next - own));
  };
  const theta = r => twist(line('this'), r) + (held.by === 'curve' ? 0 : (held.wanted - twist(line('this'), held.r)) * hat(r));

  // The disk on the left as far as its circle needs room, above on a narrow stage; the blade has the rest. Numbers stand
  // on its right where there is room, words of the arc on its left.
  function arrange() {
    const stage = place.getBoundingClientRect(), {width, height} = stage, wide = width > 640;
    const top = (document.querySelector('.rxf-power').getClientRects()[0]?.bottom ?? stage.top) - stage.top + 10;
    const split = wide ? clamp(height - top - 60, .36 * width, .5 * width) : top + .5 * (height - top);
    const box = wide ? {x: split, y: top, w: width - split, h: height - top - 46} : {x: 0, y: split, w: width, h: height - split - 40};
    const column = box.w > 430 ? 172 : 0, room = box.w - column - 118, high = box.h - SCALE;
    const chord = clamp(room / (TRAIL + .32), 90, Math.max(90, .62 * high)), x = box.x + box.w - column - .3 * chord - 14 - Math.max(0, .35 * (room - 1.07 * chord));
    const at = t => [x - .08 * chord * (1 - t), box.y + SCALE + (.2 + .52 * t) * high];
    disk.style.inset = wide ? `0 ${width - split}px 0 0` : `0 0 ${height - split}px 0`;
    return {width, height, wide, box, column, stage, at, size: t => chord * (.58 + .42 * t), ...scene(stage)};
  }
  // Root and tip of the blade in the scene, from where the sections come and to where they go back.
  function scene(stage) {
    const client = window.__viserMutable, node = client?.nodeRefFromName?.['/rotor/blade_0'], canvas = client?.canvas?.getBoundingClientRect();
    const pixel = x => { const at = node.position.clone().set(x, 0, 0).applyMatrix4(node.matrixWorld).project(client.camera); return [(at.x + 1) / 2 * canvas.width + canvas.left - stage.left, (1 - at.y) / 2 * canvas.height + canvas.top - stage.top]; };
    if (!node || !client.camera || !canvas) return {from: [[stage.width / 2, stage.height / 2], [stage.width / 2, stage.height / 2]]};
    const length = node.geometry?.boundingBox?.max.x ?? 7.8;
    return {from: [pixel(.12 * length), pixel(length)]};
  }

  RX.paint('rubber', now => {
    if (!now) { if (held) fly(0); held = null; return; }
    if (held?.press === now.press) return;
    const at = Number(now.knot), root = now.stations[0];
    held = {...now, at, r: now.stations[at], share: (now.stations[at] - root) / (1 - root), root};
    if (!line('this') || !RX.state.inset || (now.by === 'hand' && !pointer.down)) {  // Let go before the answer came: nothing moves.
      RX.send('knot', [now.knot, 'end']);
      held = null;
      return;
    }
    held.first = held.start = held.wanted = twist(line('this'), held.r);
    held.layout = arrange();
    held.from = pointer.y;
    if (now.by === 'key') place.focus({preventScroll: true});
    fly(1);
  });
  for (const name of ['twist', 'hand']) RX.also(name, () => { if (held && !running) draw(); });

  // The trailing edge of the held station goes as far up or down as the pointer.
  const pulled = () => (pointer.y - held.from) / (TRAIL * held.layout.size(held.share) * Math.max(Math.cos(TIMES * held.start * DEGREE), .5)) / TIMES / DEGREE;
  // The blade stops where the first of its sliders ends.
  const within = wanted => clamp(wanted, held.ends[0][0], held.ends[1][0]);
  const end = one => one.ends.find(([limit]) => Math.abs(limit - one.wanted) < .06);
  function turn() {
    held.wanted = within(held.start + pulled());
    tell();
    if (!running) draw();
  }
  function tell() {
    waiting = held.wanted;
    setTimeout(() => { if (waiting !== null && held) { sent = performance.now(); RX.send('knot', [held.knot, [null, waiting]]); waiting = null; } }, Math.max(0, 50 - (performance.now() - sent)));
  }
  function release(undo = false) {
    const {knot, by} = held, last = waiting;
    waiting = null;
    if (!undo && last !== null) RX.send('knot', [knot, [null, last]]);
    if (undo) RX.send('knot', [knot, 'undo']);
    else if (by !== 'curve') setTimeout(() => RX.send('knot', [knot, 'end']), 70);
    ended = held;
    fly(0);
    held = null;
  }
  let ended = null;
  function fly(to) {
    towards = to;
    if (to) page.toggleAttribute('data-rubber', true);
    else if (held) ended = held;
    if (running) return;
    running = true;
    before = performance.now();
    requestAnimationFrame(step);
  }
  function step(now) {
    const passed = (now - before) / MORPH;
    before = now;
    shown = calm.matches ? towards : clamp(shown + (towards ? passed : -passed), 0, 1);
    draw();
    running = shown !== towards;
    if (running) requestAnimationFrame(step);
    else if (!towards) { page.removeAttribute('data-rubber'); place.querySelector('svg').innerHTML = disk.style.cssText = ''; ended = null; RX.again('plan'); }
  }

  function draw() {
    const now = held, one = held ?? ended, jig = line('this'), cuts = RX.state.inset?.cuts;
    if (!one || !jig || !cuts) return;
    held = one;  // The helpers above draw what is held, or was.
    const {layout, root} = one, e = ease(shown), best = RX.state.hand?.best, reference = line('reference');
    const free = one.wanted;
    if (one.by === 'curve') one.wanted = twist(jig, one.r);
    else if (best?.held) one.wanted = best.theta;  // Held softly at the best angle.
    const share = r => clamp((r - root) / (1 - root), 0, 1);
    const small = Math.hypot(layout.from[1][0] - layout.from[0][0], layout.from[1][1] - layout.from[0][1]) * .07;
    const spot = t => { const [x, y] = layout.at(t); return [lerp(lerp(layout.from[0][0], layout.from[1][0], t), x, e), lerp(lerp(layout.from[0][1], layout.from[1][1], t), y, e)]; };
    const point = (t, angle, [x, z], out = 1) => {
      const [ox, oy] = spot(t), c = Math.cos(TIMES * angle * DEGREE), s = Math.sin(TIMES * angle * DEGREE), k = out * lerp(small, layout.size(t), e);
      return `${(ox + k * (x * c - z * s)).toFixed(1)} ${(oy - k * (x * s + z * c)).toFixed(1)}`;
    };
    const outline = r => {
      const k = clamp(cuts.findIndex(cut => cut.r >= r), 1, cuts.length - 1), u = clamp((r - cuts[k - 1].r) / (cuts[k].r - cuts[k - 1].r), 0, 1);
      return cuts[k - 1].outline.map(([x, z], i) => [lerp(x, cuts[k].outline[i][0], u), lerp(z, cuts[k].outline[i][1], u)]);
    };
    const shape = (r, angle) => 'M' + outline(r).map(p => point(share(r), angle, p)).join('L') + 'Z';
    let inside = '';
    // From the root to the tip, each section over those behind it.
    const places = Array.from({length: SECTIONS}, (_, k) => ({r: root + (1 - root) * k / SECTIONS})).concat(cuts.map(cut => ({r: cut.r, cut}))).sort((a, b) => a.r - b.r);
    for (const {r, cut} of places) {
      const t = share(r), shade = `color-mix(in oklab, ${RX.along(t)} ${Math.round(74 + 26 * t)}%, var(--rx-paper))`;
      // What lies before the held section lets it show through.
      inside += `<path d="${shape(r, theta(r))}" ${r > one.r + .01 ? 'opacity=".3"' : ''} fill="${cut ? RX.along(t) : shade}" stroke="var(--rx-paper)" stroke-width="${cut ? 1.3 : .5}" stroke-opacity="${cut ? .95 : .35}"/>`;
    }
    if (reference) {
      const edge = x => 'M' + Array.from({length: 25}, (_, k) => root + (1 - root) * k / 24).map(r => point(share(r), twist(reference, r), [x, 0])).join('L');
      inside += [edge(.25), edge(-TRAIL), shape(one.r, twist(reference, one.r))].map(d => `<path d="${d}" class="rxf-ghost-line"/>`).join('');
    }
    if (e > .6) {
      // The arc at the trailing edge: from where it was, past where it would be best, to where it is.
      const t = one.share, arc = (from, to, out) => 'M' + Array.from({length: 21}, (_, k) => point(t, lerp(from, to, k / 20), [-TRAIL * out, 0])).join('L');
      const ray = (angle, a, b) => `M${point(t, angle, [-TRAIL * a, 0])}L${point(t, angle, [-TRAIL * b, 0])}`;
      const reach = Math.max(4, Math.abs(one.wanted - one.first) + 2, best ? Math.abs(best.theta - one.first) + 1 : 0);
      const ticks = Array.from({length: 2 * Math.floor(reach) + 1}, (_, k) => k - Math.floor(reach)).map(d => ray(one.first + d, 1.05, d % 5 ? 1.075 : 1.1)).join('');
      const words = (angle, out, content, colour) => { const [x, y] = point(t, angle, [-TRAIL * out, 0]).split(' '); return `<text x="${x}" y="${+y + 4}" text-anchor="end" class="rxf-halo" style="fill:${colour}">${text(content)}</text>`; };
      inside += `<path d="${arc(one.first - reach, one.first + reach, 1.05)}" fill="none" stroke="var(--rx-faint)"/><path d="${ticks}" stroke="var(--rx-faint)"/>
        <path d="${arc(one.first, one.wanted, 1.05)}" fill="none" stroke="var(--rx-accent)" stroke-width="4"/>`
        + (best ? `<path d="${ray(best.theta, .99, 1.13)}" stroke="var(--rx-good)" stroke-width="${best.held ? 6 : 4}" stroke-linecap="round"/>` + words(best.theta, 1.16, best.held ? 'least power' : `best ${signed(best.theta - one.first)}`, 'var(--rx-good)') : '')
        + (best && Math.abs(best.theta - one.wanted) < 1 ? '' : words(one.wanted, 1.16, `${signed(one.wanted - one.first)}${end(one) ? `, limit of ${end(one)[1]}` : ''}`, 'var(--rx-accent)'));
      const [hx, hy] = point(t, one.wanted, [-TRAIL, 0]).split(' ');
      inside += `<circle cx="${hx}" cy="${hy}" r="6" fill="var(--rx-accent)" stroke="var(--rx-paper)" stroke-width="2"/>`;
      if (layout.column) inside += numbers(layout, cuts, share, point, reference);
      inside += scale(one);
    }
    const svg = place.querySelector('svg');
    svg.setAttribute('viewBox', `0 0 ${layout.width} ${layout.height}`);
    svg.innerHTML = inside;
    place.style.opacity = disk.style.opacity = Math.min(1, 1.6 * e);
    const words = place.querySelector('p');
    words.style.left = `${layout.box.x + .5 * layout.box.w}px`;
    words.style.maxWidth = `${layout.box.w - 20}px`;
    words.innerHTML = `<b>${text(RX.state.hand?.place ?? `${one.titles[one.at]} ${one.r.toFixed(2)} R`)}</b>` + (one.by === 'key' ? ' ↑ ↓ 0.1°, with Shift 1° · ← → another station · Enter: done' : ` drawn ×${TIMES} · release: back`) + ' · Esc: as before';
    one.wanted = free;
    held = now;
  }
  // Power: a needle now, where it was, and the least over this station, once it is known. The scale only grows.
  function scale(one) {
    const hand = RX.state.hand, {box} = one.layout;
    if (!hand) return '';
    const {now, before: start, digits, rival} = hand, best = hand.best?.power, told = [now, start, best ?? start, rival ?? start], left = box.x + 28, right = box.x + box.w - 28, y = box.y + 40;
    const ends = one.ends_kw ??= [start, start], room = Math.max(.025 * Math.abs(start), 12);
    if (Math.min(...told) < ends[0] + .3 * room) ends[0] = Math.min(...told) - room;
    if (Math.max(...told) > ends[1] - .3 * room) ends[1] = Math.max(...told) + 2 * room;
    const span = ends[1] - ends[0], power = 10 ** Math.floor(Math.log10(span / 4)), tick = power * [1, 2, 5, 10].find(k => k * power >= span / 6);
    const X = v => left + (right - left) * (v - ends[0]) / span, x = X(now), named = [[start, 'before', 'var(--rx-dim)'], ...(best === undefined ? [] : [[best, 'least', 'var(--rx-good)']])].sort(([a], [b]) => a - b);
    let out = `<path d="M${left} ${y}H${right}" stroke="var(--rx-faint)" stroke-width="1.5"/>`;
    for (let v = Math.ceil(ends[0] / tick) * tick; v <= ends[1]; v += tick) out += `<path d="M${X(v)} ${y}v5" stroke="var(--rx-faint)"/><text x="${X(v)}" y="${y + 17}" text-anchor="middle">${Charts.fixed(v, 0)}</text>`;
    // Names stand outward of the two marks, so that they never meet.
    named.forEach(([v, name, colour], k) => {
      const one_side = named.length < 2 ? 'middle' : k ? 'start' : 'end', edge = X(v) + (one_side === 'start' ? -5 : one_side === 'end' ? 5 : 0);
      out += `<path d="M${X(v)} ${y - 7}v14" stroke="${colour}" stroke-width="${name === 'least' ? 4 : 2}" stroke-linecap="round"/><text x="${clamp(edge, left + 60, right - 60)}" y="${y + 33}" text-anchor="${one_side}" style="fill:${colour};font-weight:620">${name} ${Charts.fixed(v, digits)}</text>`;
    });
    if (rival !== null) out += `<path d="M${X(rival)} ${y - 7}v14" stroke="var(--rx-accent)" stroke-width="4" stroke-linecap="round"/><text x="${clamp(X(rival), left + 60, right - 60)}" y="${y + 50}" text-anchor="middle" style="fill:var(--rx-accent);font-weight:620">optimiser ${Charts.fixed(rival, digits)}</text>`;
    const gone = RX.state.power?.problem ? 'opacity=".35"' : '', colour = `var(--rx-${hand.kind || 'ink'})`;
    return out + `<g ${gone}><path d="M${x} ${y}l-7 -15h14Z" fill="${colour}"/><text x="${clamp(x, left + 50, right - 60)}" y="${y - 21}" text-anchor="middle" class="rxf-halo rxf-needle"><tspan>${text(hand.power)}</tspan><tspan dx="7" style="fill:${colour}">${text(hand.change)}</tspan></text></g>`;
  }
  // r/R, twist and its change beside the leading edges, none over another.
  function numbers({box}, cuts, share, point, reference) {
    const x = box.x + box.w - 164, top = box.y + SCALE + 22;
    let last = top, out = `<text x="${x}" y="${top}">r/R</text><text x="${x + 84}" y="${top}" text-anchor="end">twist</text><text x="${x + 150}" y="${top}" text-anchor="end">Δ</text>`;
    for (const cut of cuts) {
      const angle = theta(cut.r), [lx, ly] = point(share(cut.r), angle, [.25, 0]).split(' ').map(Number), y = Math.max(last + 20, Math.min(ly, box.y + box.h - 12)), change = reference ? angle - twist(reference, cut.r) : 0;
      last = y;
      out += `<path d="M${lx + 4} ${ly}L${x - 8} ${y - 4}" stroke="var(--rx-faint)" stroke-opacity=".6"/><text x="${x}" y="${y}">${cut.r.toFixed(2)}</text>
        <text x="${x + 84}" y="${y}" text-anchor="end" style="fill:${RX.along(share(cut.r))};font-weight:650">${signed(angle)}</text>` + (Math.abs(change) >= .05 ? `<text x="${x + 150}" y="${y}" text-anchor="end">${signed(change)}</text>` : '');
    }
    return out;
  }

  // By key.
  addEventListener('keydown', event => {
    if (!held) return;
    const own = held.by === 'key' && {ArrowUp: 1, ArrowDown: -1, ArrowLeft: 0, ArrowRight: 0, Enter: 0}[event.key] !== undefined;
    if (event.key !== 'Escape' && !own) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key === 'Escape') release(true);
    else if (event.key === 'Enter') release();
    else if (event.key === 'ArrowUp' || event.key === 'ArrowDown') {
      held.wanted = within(held.wanted + (event.key === 'ArrowUp' ? 1 : -1) * (event.shiftKey ? 1 : .1));
      tell();
      draw();
      RX.say(`${held.titles[held.at]} ${signed(held.wanted - held.first)}`);
    } else {
      const next = clamp(held.at + (event.key === 'ArrowRight' ? 1 : -1), 0, held.stations.length - 1);
      if (next !== held.at) { const r = held.stations[next]; release(); setTimeout(() => RX.send('twist_by_hand', r), 160); }
    }
  }, true);
  // A section of the blade in the card below is pressed as the blade is.
  document.addEventListener('pointerdown', event => {
    const cut = event.target instanceof Element && event.target.closest('[data-grab]');
    if (!cut || event.button) return;
    event.preventDefault();
    RX.send('grab_at', Number(cut.dataset.grab));
  });

  // What the pointer is over decides what a press does there: the reference blade is taken, a blade or the disk shows its
  // section, elsewhere the view turns. The cursor says so, and the blade shines a little.
  let over = null, met = null, due = 0;
  const viewer = () => window.__viserMutable, lies = node => { for (; node; node = node.parent) if (!node.visible) return false; return true; };
  function find({clientX, clientY}) {
    const {camera, canvas, nodeRefFromName: nodes} = viewer(), box = canvas.getBoundingClientRect(), ray = viewer().scene.__r3f.root.getState().raycaster;
    ray.setFromCamera({x: 2 * (clientX - box.left) / box.width - 1, y: 1 - 2 * (clientY - box.top) / box.height}, camera);
    const meet = name => {
      let mesh = null;
      nodes[name]?.traverse(one => { if (one.isMesh && !one.isLineSegments2) mesh ??= one; });
      const [hit] = mesh && lies(mesh) ? ray.intersectObject(mesh, false) : [];
      return hit && {name, mesh, uv: hit.uv, far: hit.distance};
    };
    const hits = ['/lifted/skin', ...Array.from({length: 8}, (_, k) => `/rotor/blade_${k}`)].map(meet).filter(Boolean).sort((a, b) => a.far - b.far);
    const below = hits.length ? null : meet('/rotor/disk/field');
    return hits[0] ?? (below && Math.hypot(below.uv.x - .5, below.uv.y - .5) < .5 ? {name: 'disk'} : {name: ''});
  }
  function aim(at) {
    const now = at ? find(at) : {name: ''}, kind = /blade_0|lifted/.test(now.name) ? 'grab' : now.name ? 'crosshair' : 'move';
    viewer().canvas.style.cursor = at ? kind : '';
    if (now.mesh === met) return;
    for (const [mesh, share] of [[met, 0], [met = now.mesh, .28]]) mesh?.material.emissive?.copy(mesh.material.color).multiplyScalar(share);
    viewer().requestRender?.();
  }
  addEventListener('pointermove', event => {
    const canvas = viewer()?.canvas, free = event.pointerType === 'mouse' && !event.buttons && canvas?.contains(event.target);
    if (!free && !over) return;
    over = free ? event : null;
    due ||= requestAnimationFrame(() => { due = 0; aim(over); });
  }, {passive: true});
  addEventListener('dblclick', event => { if (viewer()?.canvas?.contains(event.target)) RX.send('aim'); });
  // In Actuate the voltage moves the blade, not the hand: pulling the blade's edge moves the voltage, FULL pixels all of it.
  const FULL = 150;
  let pull = null;
  const tug = share => RX.send('pull', share);
  addEventListener('pointerdown', event => {
    if (event.button || !event.isPrimary || !viewer()?.canvas?.contains(event.target) || !find(event).name.startsWith('/lifted')) return;
    event.stopPropagation();  // Else the camera turns.
    pull = {from: event.clientY, share: 0, due: 0};
    page.toggleAttribute('data-pull', true);
    RX.send('hold', true);
    tug(null);
  }, true);
  addEventListener('pointermove', event => {
    if (!pull || !event.isPrimary) return;
    pull.share = (pull.from - event.clientY) / FULL;
    pull.due ||= requestAnimationFrame(() => { if (pull) { pull.due = 0; tug(pull.share); } });
  }, true);
  const letGo = share => {
    if (!pull) return;
    tug(share);
    pull = null;
    page.removeAttribute('data-pull');
    RX.send('hold', false);
  };
  for (const name of ['pointerup', 'pointercancel']) addEventListener(name, event => { if (event.isPrimary) letGo(pull?.share); }, true);
  addEventListener('keydown', event => { if (pull && event.key === 'Escape') { event.stopPropagation(); letGo(0); } }, true);
})();
