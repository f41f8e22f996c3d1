// @ts-check
// The blade twisted by hand: while a station is held half the stage is the blade from the tip, the other half the live
// plan of the disk (plan.js), with a scale of power above. Jig twist, drawn four times; the server moves the sliders.
(() => {
  const {DEGREE, text, clamp, lerp, distance, fixed, trace, calm, closest, soon, paced, drag} = Common;
  const {viewer, node, project} = Common;
  const {part} = RX, place = part('twisting'), page = document.documentElement;
  const TIMES = 4, MORPH = 400, SECTIONS = 30, TRAIL = .75, SCALE = 92;
  const ease = t => t * t * (3 - 2 * t), degrees = angle => `${Common.signed(angle)}°`;
  const shares = (count, from, to) => Array.from({length: count + 1}, (_, k) => lerp(from, to, k / count));
  const label = (x, y, content, {anchor = 'middle', css = '', name = ''} = {}) =>
    `<text x="${x}" y="${y}" text-anchor="${anchor}" class="${name}" style="${css}">${text(content)}</text>`;
  // `held`: the blade in the hand; `left`: the one that goes back into the scene. `wanted` is the angle of its station.
  let held = null, left = null, pointer = null;

  let finger = false;
  drag(window, '*', (_, {clientY, pointerType}) => {
    pointer = clientY;
    finger = pointerType === 'touch';
    const byHand = () => held?.by === 'hand';  // From the server's answer to the press on.
    return {
      move(event) {
        pointer = event.clientY;
        if (!byHand()) return;
        event.stopPropagation();  // viser would look for what lies below the pointer.
        turn();
      },
      end() { pointer = null; if (byHand()) release(); },
      escape(event) {
        pointer = null;
        if (!held || held.by === 'key') return;
        event.stopPropagation();
        release(true);
      },
    };
  }, true);

  // Twist less that at 0.75 R [°]: a line of the twist chart.
  /** @returns {any} */
  const line = role => RX.state.twist?.chart.series[RX.state.twist.places[role]];
  const twistAt = ({x, y}, r) => {
    const k = clamp(x.findIndex(station => station >= r), 1, x.length - 1);
    return lerp(y[k - 1], y[k], clamp((r - x[k - 1]) / (x[k] - x[k - 1]), 0, 1));
  };
  // What a turn of the held station does to the blade: straight to its neighbours, until the server's answer comes.
  function hat({stations, at}, r) {
    const own = stations[at], next = stations[r < own ? at - 1 : at + 1];
    if (r === own) return 1;
    return next === undefined ? 0 : Math.max(0, 1 - Math.abs(r - own) / Math.abs(next - own));
  }
  const theta = (blade, r) => twistAt(line('this'), r)
    + (blade.by === 'curve' ? 0 : (blade.wanted - twistAt(line('this'), blade.r)) * hat(blade, r));

  // The disk on the left as far as its circle needs room, above on a narrow stage; the blade has the rest. Numbers
  // stand on its right where there is room, words of the arc on its left.
  function arrange() {
    const stage = place.getBoundingClientRect(), {width, height} = stage, wide = width > Math.max(640, height);
    const card = RX.small.matches ? null : document.querySelector('.rxf-power').getClientRects()[0];
    const top = (card?.bottom ?? stage.top) - stage.top + 10;
    const split = wide ? clamp(height - top - 60, .36 * width, .5 * width) : top + .5 * (height - top);
    const box = wide ? {x: split, y: top, w: width - split, h: height - top - 46}
      : {x: 0, y: split, w: width, h: height - split - 40};
    const column = box.w > 430 ? 172 : 0, room = box.w - column - 118, high = box.h - SCALE;
    const chord = clamp(room / (TRAIL + .32), 90, Math.max(90, .62 * high));
    const x = box.x + box.w - column - .3 * chord - 14 - Math.max(0, .35 * (room - 1.07 * chord));
    const at = t => [x - .08 * chord * (1 - t), box.y + SCALE + (.2 + .52 * t) * high];
    const disk = wide ? `0 ${width - split}px 0 0` : `0 0 ${height - split}px 0`;
    page.style.setProperty('--rx-beside', disk);
    return {width, height, box, column, at, size: t => chord * (.58 + .42 * t), from: inStage(width / 2, height / 2)};
  }
  // Root and tip of the blade in the scene, from where the sections come and to where they go back.
  function inStage(...middle) {
    const blade = node('/rotor/blade_0'), length = blade?.geometry?.boundingBox?.max.x ?? 7.8;
    if (!blade || !viewer().camera || !viewer().canvas) return [middle, middle];
    const [canvas, stage] = [viewer().canvas, place].map(of => of.getBoundingClientRect());
    return [.12, 1].map(share => project(blade, [share * length, 0, 0]))
      .map(point => [point.left + canvas.left - stage.left, point.top + canvas.top - stage.top]);
  }

  RX.paint('twisting', grabbed => {
    if (!grabbed) { if (held) fly(0); held = null; return; }
    if (held?.press === grabbed.press) return;
    const {knot, by, stations} = grabbed, at = Number(knot), [root] = stations, r = stations[at];
    // Let go before the answer came: nothing moves.
    if (!line('this') || !RX.state.inset || (by === 'hand' && pointer === null)) {
      RX.send('knot', [knot, 'end']);
      held = null;
      return;
    }
    page.dataset.twisting = by;
    const start = twistAt(line('this'), r), share = (r - root) / (1 - root);
    held = {...grabbed, at, r, root, share, start, wanted: start, from: pointer, layout: arrange()};
    if (by === 'key') place.focus({preventScroll: true});
    fly(1);
  });
  RX.paint(['twist', 'hand'], () => { if (held && !running) redraw(); });
  // A window that is drawn out or turned meanwhile has other room.
  new ResizeObserver(() => {
    if (!held) return;
    held.layout = arrange();
    if (!running) redraw();
  }).observe(place);

  // The trailing edge of the held station goes as far up or down as the pointer.
  function turn() {
    const reach = TRAIL * held.layout.size(held.share) * Math.max(Math.cos(TIMES * held.start * DEGREE), .5);
    turnTo(held.start + (pointer - held.from) / reach / TIMES / DEGREE);
    if (!running) redraw();
  }
  const heard = paced(angle => { if (held) RX.send('knot', [held.knot, [null, angle]]); });
  // The blade stops where the first of its sliders ends.
  function turnTo(angle) {
    held.wanted = clamp(angle, held.ends[0][0], held.ends[1][0]);
    heard.send(held.wanted);
  }
  function release(undo = false) {
    const {knot, by} = held;
    if (undo) heard.drop(); else heard.flush();
    if (undo) RX.send('knot', [knot, 'undo']);
    else if (by !== 'curve') setTimeout(() => RX.send('knot', [knot, 'end']), 70);
    fly(0);
    held = null;
  }
  let shown = 0, towards = 0, before = 0, running = false;
  function fly(to) {
    towards = to;
    if (!to) { left = held; rotorScene.hide(false); }
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
    else if (towards) rotorScene.hide(true);
    else {
      page.removeAttribute('data-twisting');
      place.querySelector('svg').innerHTML = '';
      left = null;
      RX.again('plan', 'inset');
    }
  }

  const redraw = soon(() => draw());  // Moves and answers come several in a frame.
  function draw() {
    const one = held ?? left, jig = line('this'), cuts = RX.state.inset?.cuts;
    if (!one || !jig || !cuts) return;
    const {layout, root} = one, {box} = layout, shift = ease(shown), best = RX.state.hand?.best;
    // Held softly at the best angle.
    const wanted = one.by === 'curve' ? twistAt(jig, one.r) : best?.held ? best.theta : one.wanted;
    const blade = {...one, wanted}, share = r => clamp((r - root) / (1 - root), 0, 1);
    const [from, to] = layout.from, small = Math.hypot(to[0] - from[0], to[1] - from[1]) * .07;
    const mix = (a, b, t) => a.map((value, k) => lerp(value, b[k], t));
    // A point forward and up of the quarter chord, in chords, so far along the blade and turned so much [px].
    const point = (t, angle, [x, z]) => {
      const [ox, oy] = mix(mix(from, to, t), layout.at(t), shift), chord = lerp(small, layout.size(t), shift);
      const c = Math.cos(TIMES * angle * DEGREE), s = Math.sin(TIMES * angle * DEGREE);
      return [ox + chord * (x * c - z * s), oy - chord * (x * s + z * c)];
    };
    const outline = r => {
      const k = clamp(cuts.findIndex(cut => cut.r >= r), 1, cuts.length - 1), [inner, outer] = [cuts[k - 1], cuts[k]];
      const t = clamp((r - inner.r) / (outer.r - inner.r), 0, 1);
      return inner.outline.map((corner, i) => mix(corner, outer.outline[i], t));
    };
    const shape = (r, angle) => `${trace(outline(r).map(corner => point(share(r), angle, corner)))}Z`;
    const svg = place.querySelector('svg'), words = place.querySelector('p');
    svg.setAttribute('viewBox', `0 0 ${layout.width} ${layout.height}`);
    svg.innerHTML = drawSections(blade, cuts, share, shape) + drawReference(blade, share, point, shape)
      + (shift > .6 ? drawArc(blade, best, point) + drawNumbers(blade, cuts, share, point) + drawScale(one) : '');
    // Not on html: that would have the whole page styled anew in every frame.
    for (const shade of [place, part('plan')]) shade.style.setProperty('--rx-shown', String(Math.min(1, 1.6 * shift)));
    words.style.cssText = `left:${box.x + .5 * box.w}px;max-width:${box.w - 20}px`;
    const keys = one.by === 'key' ? ' ↑ ↓ 0.1°, Shift 1° · ← → another station · Enter keeps it · Esc cancels'
      : finger ? ' lift the finger to keep · a second finger cancels'
        : ` drawn ×${TIMES} · release to keep · Esc cancels`;
    const station = RX.state.hand?.place ?? `${one.titles[one.at]} ${one.r.toFixed(2)} R`;
    const end = limitOf(blade), told = end ? ` limit of ${text(end[1].replace(/ \[.*/, ''))}` : keys;
    words.innerHTML = `<b>${text(station)}</b>${told}`;
  }
  // From the root to the tip, each section over those behind it; those before the held one let it show through.
  function drawSections(blade, cuts, share, shape) {
    const between = shares(SECTIONS, blade.root, 1).slice(0, -1).map(r => ({r, cut: false}));
    return between.concat(cuts.map(({r}) => ({r, cut: true}))).sort((a, b) => a.r - b.r).map(({r, cut}) => {
      const t = share(r), colour = RX.along(t), paler = `${Math.round(74 + 26 * t)}%, var(--rx-paper)`;
      return `<path d="${shape(r, theta(blade, r))}" fill="${cut ? colour : `color-mix(in oklab, ${colour} ${paler})`}"
        ${r > blade.r + .01 ? 'opacity=".3"' : ''} stroke="var(--rx-paper)" stroke-width="${cut ? 1.3 : .5}"
        stroke-opacity="${cut ? .95 : .35}"/>`;
    }).join('');
  }
  function drawReference(blade, share, point, shape) {
    const reference = line('reference');
    if (!reference) return '';
    const edge = x => trace(shares(24, blade.root, 1).map(r => point(share(r), twistAt(reference, r), [x, 0])));
    return [edge(.25), edge(-TRAIL), shape(blade.r, twistAt(reference, blade.r))]
      .map(path => `<path d="${path}" class="rxf-overlay"/>`).join('');
  }
  const limitOf = ({wanted, ends}) => ends.find(([limit]) => Math.abs(limit - wanted) < .06);
  // The arc at the trailing edge: from where it was, past where it would be best, to where it is.
  function drawArc({start, wanted, share, ends}, best, point) {
    const at = (angle, out) => point(share, angle, [-TRAIL * out, 0]);
    const end = limitOf({wanted, ends});
    const arc = (from, to) => trace(shares(20, from, to).map(angle => at(angle, 1.05)));
    const ray = (angle, ...out) => trace(out.map(far => at(angle, far)));
    const words = (angle, content, colour) => {
      const [x, y] = at(angle, 1.16);
      return label(x, y + 4, content, {anchor: 'end', css: `fill:var(${colour})`, name: 'rxf-halo'});
    };
    const reach = Math.max(4, Math.abs(wanted - start) + 2, best ? Math.abs(best.theta - start) + 1 : 0);
    const whole = Math.floor(reach), ticks = shares(2 * whole, -whole, whole)
      .map(tick => ray(start + tick, 1.05, Math.round(tick) % 5 ? 1.075 : 1.1)).join('');
    const goal = best && (best.held ? 'least power' : `best ${degrees(best.theta - start)}`);
    const optimum = best ? `<path d="${ray(best.theta, .99, 1.13)}" stroke="var(--rx-good)" stroke-linecap="round"
      stroke-width="${best.held ? 6 : 4}"/>${words(best.theta, goal, '--rx-good')}` : '';
    const turned = `${degrees(wanted - start)}${end ? ', limit' : ''}`, [x, y] = at(wanted, 1);
    return `<path d="${arc(start - reach, start + reach)}" fill="none" stroke="var(--rx-faint)"/>
      <path d="${ticks}" stroke="var(--rx-faint)"/>
      <path d="${arc(start, wanted)}" fill="none" stroke="var(--rx-accent)" stroke-width="4"/>${optimum}
      ${best && Math.abs(best.theta - wanted) < 1 ? '' : words(wanted, turned, '--rx-accent')}
      <circle cx="${x}" cy="${y}" r="6" fill="var(--rx-accent)" stroke="var(--rx-paper)" stroke-width="2"/>`;
  }
  // r/R, twist and its change beside the leading edges, none over another.
  function drawNumbers(blade, cuts, share, point) {
    const {box, column} = blade.layout, reference = line('reference');
    if (!column) return '';
    const x = box.x + box.w - 164, top = box.y + SCALE + 22, right = {anchor: 'end'};
    let last = top;
    const row = (y, name, angle, change, css = '') => label(x, y, name, {anchor: 'start'})
      + label(x + 84, y, angle, {...right, css}) + label(x + 150, y, change, right);
    return row(top, 'r/R', 'built-in', 'Δ') + cuts.map(({r}) => {
      const angle = theta(blade, r), [edge, height] = point(share(r), angle, [.25, 0]);
      const change = reference ? angle - twistAt(reference, r) : 0;
      last = Math.max(last + 20, Math.min(height, box.y + box.h - 12));
      return `<path d="M${edge + 4} ${height}L${x - 8} ${last - 4}" stroke="var(--rx-faint)" stroke-opacity=".6"/>`
        + row(last, r.toFixed(2), degrees(angle), Math.abs(change) >= .05 ? degrees(change) : '',
          `fill:${RX.along(share(r))};font-weight:650`);
    }).join('');
  }
  // Power: a needle now, where it was, and the least over this station, once it is known. The scale only grows.
  function drawScale(one) {
    const {hand} = RX.state, {box} = one.layout;
    if (!hand) return '';
    const {now, before: start, digits, optimised} = hand, best = hand.best?.power;
    const powers = [now, start, best ?? start, optimised ?? start];
    const from = box.x + 28, to = box.x + box.w - 28, y = box.y + 40;
    const ends = one.powers ??= [start, start], room = Math.max(.025 * Math.abs(start), 12);
    if (Math.min(...powers) < ends[0] + .3 * room) ends[0] = Math.min(...powers) - room;
    if (Math.max(...powers) > ends[1] - .3 * room) ends[1] = Math.max(...powers) + 2 * room;
    const span = ends[1] - ends[0], decade = 10 ** Math.floor(Math.log10(span / 4));
    const tick = decade * ([1, 2, 5].find(k => k * decade >= span / 6) ?? 10);
    const X = power => lerp(from, to, (power - ends[0]) / span);
    const ticks = [];
    for (let power = Math.ceil(ends[0] / tick) * tick; power <= ends[1]; power += tick)
      ticks.push(`<path d="M${X(power)} ${y}v5" stroke="var(--rx-faint)"/>${label(X(power), y + 17, fixed(power))}`);
    // Names of the marks in one row, each below its own or pushed aside by its neighbour.
    const marks = [['before', start, '--rx-dim'], ['least', best, '--rx-good'], ['optimiser', optimised, '--rx-accent']]
      .filter(([, power]) => power ?? null).map(([name, power, colour]) => {
        const words = `${name} ${fixed(power, digits)}`, wide = 7 * words.length + 8;
        return {name, colour, words, wide, x: X(power), at: X(power)};
      }).sort((first, second) => first.x - second.x);
    let end = from - 20;
    for (const mark of marks) end = (mark.at = Math.max(mark.at, end + mark.wide / 2)) + mark.wide / 2;
    end = to + 20;
    for (const mark of marks.toReversed()) end = (mark.at = Math.min(mark.at, end - mark.wide / 2)) - mark.wide / 2;
    const named = marks.map(({name, colour, words, x, at}) => `<path d="M${x} ${y - 7}v14" stroke="var(${colour})"
      stroke-width="${name === 'before' ? 2 : 4}" stroke-linecap="round"/>${
      label(at, y + 33, words, {css: `fill:var(${colour});font-weight:620`})}`);
    const x = X(now), colour = 'var(--rx-ink)', change = `<tspan dx="7">${text(hand.change)}</tspan>`;
    const half = 4 * (hand.power.length + hand.change.length) + 8;
    return `<path d="M${from} ${y}H${to}" stroke="var(--rx-faint)" stroke-width="1.5"/>${ticks.join('')}
      ${named.join('')}
      <g opacity="${RX.state.line?.problem ? .35 : 1}"><path d="M${x} ${y}l-7 -15h14Z" fill="${colour}"/>
        <text x="${clamp(x, from - 20 + half, to + 20 - half)}" y="${y - 21}" text-anchor="middle"
          class="rxf-halo rxf-needle"><tspan>${text(hand.power)}</tspan>${change}</text></g>`;
  }

  // By key.
  const TURNS = {ArrowUp: 1, ArrowDown: -1}, MOVES = {ArrowRight: 1, ArrowLeft: -1};
  addEventListener('keydown', event => {
    const {key} = event, undo = key === 'Escape';
    if (!held || !(undo || (held.by === 'key' && (key === 'Enter' || key in TURNS || key in MOVES)))) return;
    event.preventDefault();
    event.stopPropagation();
    if (undo || key === 'Enter') return release(undo);
    if (key in TURNS) {
      turnTo(held.wanted + TURNS[key] * (event.shiftKey ? 1 : .1));
      draw();
      return RX.say(`${held.titles[held.at]} ${degrees(held.wanted - held.start)}`);
    }
    const next = held.stations[held.at + MOVES[key]];
    if (next === undefined) return;
    release();
    setTimeout(() => RX.send('twist_by_hand', next), 160);
  }, true);
  // A section of the blade in the card below is pressed as the blade is.
  document.addEventListener('pointerdown', event => {
    const cut = closest(event, '[data-grab]');
    if (!cut || event.button) return;
    event.preventDefault();
    RX.send('grab_at', Number(cut.dataset.grab));
  });

  // What the pointer is over decides what a press does there: the reference blade is taken, a blade or the disk shows
  // its section, elsewhere the view turns. The cursor says so, and the blade shines a little.
  const BLADES = ['/lifted/skin', ...Array.from({length: 8}, (_, k) => `/rotor/blade_${k}`)];
  const visible = of => !of || (of.visible && visible(of.parent));
  function find({clientX, clientY}) {
    const {camera, canvas, scene} = viewer(), {left: x, top, width, height} = canvas.getBoundingClientRect();
    const ray = scene.__r3f.root.getState().raycaster;
    ray.setFromCamera({x: 2 * (clientX - x) / width - 1, y: 1 - 2 * (clientY - top) / height}, camera);
    const meet = name => {
      let mesh = null;
      node(name)?.traverse(child => { if (child.isMesh && !child.isLineSegments2) mesh ??= child; });
      const [hit] = mesh && visible(mesh) ? ray.intersectObject(mesh, false) : [];
      return hit && {name, mesh, uv: hit.uv, far: hit.distance};
    };
    const [nearest] = BLADES.map(meet).filter(Boolean).sort((a, b) => a.far - b.far);
    const disk = nearest ? null : meet('/rotor/disk/field');
    return nearest ?? {name: disk && Math.hypot(disk.uv.x - .5, disk.uv.y - .5) < .5 ? 'disk' : '', mesh: null};
  }
  let over = null, shining = null;
  const aim = soon(() => {
    const {name, mesh} = over ? find(over) : {name: '', mesh: null};
    viewer().canvas.style.cursor = !over ? '' : /blade_0|lifted/.test(name) ? 'grab' : name ? 'crosshair' : 'move';
    if (mesh === shining) return;
    const shine = (of, strength) => of?.material.emissive?.copy(of.material.color).multiplyScalar(strength);
    shine(shining, 0);
    shine(mesh, .28);
    shining = mesh;
    viewer().requestRender?.();
  });
  addEventListener('pointermove', event => {
    const free = event.pointerType === 'mouse' && !event.buttons && viewer()?.canvas?.contains(event.target);
    if (!free && !over) return;
    over = free ? event : null;
    aim();
  }, {passive: true});
  // The hand takes the camera: by a drag, the wheel or the keys of its flight. Then it follows nothing any more.
  const inScene = event => viewer()?.canvas === event.target && !page.matches('[data-twisting], [data-pull]');
  const taken = paced(() => RX.send('taken'), 400);
  let down = [0, 0];
  addEventListener('pointerdown', ({clientX, clientY}) => { down = [clientX, clientY]; }, true);
  addEventListener('pointermove', event => {
    if (event.buttons && inScene(event) && distance([event.clientX, event.clientY], down) > 4) taken.send(null);
  }, {passive: true});
  addEventListener('wheel', event => { if (inScene(event)) taken.send(null); }, {passive: true});
  addEventListener('keydown', ({code, target}) => {
    if (/^Key[WASDQE]$/.test(code) && target === document.body) taken.send(null);
  });
  addEventListener('dblclick', event => { if (viewer()?.canvas?.contains(event.target)) RX.send('aim'); });
  // In Actuate the voltage moves the blade, not the hand: pulling its edge moves the voltage, FULL pixels all of it.
  const FULL = 150;
  drag(window, 'canvas', (canvas, event) => {
    if (canvas !== viewer()?.canvas || !find(event).name.startsWith('/lifted')) return null;
    event.stopPropagation();  // Else the camera turns.
    const letGo = RX.hold(0), pull = share => RX.send('pull', share);
    let share = 0, gone = false;
    const follow = soon(() => { if (!gone) pull(share); });
    const finish = () => { gone = true; pull(share); page.removeAttribute('data-pull'); letGo(); };
    page.toggleAttribute('data-pull', true);
    pull(null);
    return {
      move({clientY}) { share = (event.clientY - clientY) / FULL; follow(); },
      end: finish,
      escape(key) { key.stopPropagation(); share = 0; finish(); },
    };
  }, true);
})();
