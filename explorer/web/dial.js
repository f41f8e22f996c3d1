// The dial of twist at n/rev: a dot to drag, power and vibration foreseen by the T-matrix, and the front of both beside it.
(() => {
  const {text, part} = RX, page = document.documentElement, DEGREE = Math.PI / 180;
  const {signed} = Charts;
  let chosen = 3, held = null, pressed = null, sent = 0, waiting = null, frame = 0;

  // Loads at N_b/rev and power with cosines and sines [°] of n/rev twist, and power and index against the other blade [%].
  function values(matrix, x) {
    return matrix.base.map((base, k) => base + x.reduce((sum, a, i) => {
      if (!a) return sum;
      const second = matrix.second[k][i];
      return sum + a * (matrix.slopes[k][i] + .5 * second.reduce((bent, h, j) => bent + h * x[j], 0));
    }, 0));
  }
  function foresee(matrix, x) {
    const all = values(matrix, x);
    let forces = 0, moments = 0;
    for (let k = 0; k < 5; k++) {
      const size = matrix.gains[k] ** 2 * (all[2 * k] ** 2 + all[2 * k + 1] ** 2);
      if (k < 3) forces += size; else moments += size;
    }
    return [100 * (all[10] / matrix.power - 1), 100 * ((Math.sqrt(forces) + Math.sqrt(moments)) / matrix.index - 1)];
  }
  RX.foresee = foresee;
  // Amplitude and phase [°] of a harmonic: as the hand has it, or as the sliders do.
  function wave(n) {
    const ours = held?.waves ?? (pressed && performance.now() - pressed.at < 900 ? pressed.waves : null);
    if (ours?.[n]) return ours[n];
    const one = RX.state.dial.now.find(([order]) => order === n);
    return one ? [one[1], one[2]] : [0, 0];
  }
  const parts = ([a, p]) => [a * Math.cos(p * DEGREE), a * Math.sin(p * DEGREE)];
  const vector = () => RX.state.dial.harmonics.flatMap(n => parts(wave(n)));
  // Largest twist of some harmonics together over a turn [°].
  function peak(orders) {
    let most = 0;
    for (let psi = 0; psi < 360; psi += 5) most = Math.max(most, Math.abs(orders.reduce((sum, n) => { const [a, p] = wave(n); return sum + a * Math.cos((n * psi - p) * DEGREE); }, 0)));
    return most;
  }

  // What flies against the other blade, with every inflow model, the design's own first: foreseen in the hand, else trimmed.
  function change() {
    const {dial, dial_matrix: matrix} = RX.state;
    if (!dial) return null;
    if (!held && !pressed && dial.settled) return dial.settled;
    if (!matrix) return null;
    const x = vector(), all = [matrix, ...matrix.inflows].map(one => [one, foresee(one, x)]);
    return {power: all.map(([one, [power]]) => power / 100 * one.power * dial.per_watt), index: all.map(([, [, index]]) => index)};
  }
  const ends = list => [Math.min(...list), Math.max(...list)];
  const round = value => Charts.fixed(value, Math.abs(value) < 10 ? 1 : 0);
  const needs = power => Math.abs(power) < .05 ? 'needs no more power' : power > 0 ? `needs ${round(power)} ${RX.state.dial.unit} more` : `saves ${round(-power)} ${RX.state.dial.unit}`;
  // Power, vibration and voltage in one sentence, and whether it is good, bad or both.
  function verdict() {
    const {dial} = RX.state, now = change();
    if (!now) return [dial?.problem || dial?.words || 'Computing what it changes here …', ''];
    const {power: [power], index} = now, clauses = [needs(power)], share = dial.whole ? 100 * (1 - dial.room + peak(dial.harmonics) / dial.whole) : 0;
    let calmer = false;
    if (index.length) {
      const [low, high] = ends(index), size = (v, w) => `${Charts.fixed(v, 0)}…${Charts.fixed(w, 0)} %`;
      calmer = high < 0;
      clauses.push(high < 0 ? `takes ${Charts.fixed(-index[0], 0)} % (${size(-high, -low)}) of the vibration` : low > 0 ? `adds ${Charts.fixed(index[0], 0)} % (${size(low, high)}) to the vibration`
        : `vibration ${signed(index[0], 0)} % (${signed(low, 0)}…${signed(high, 0)} %: inflow models disagree)`);
    } else clauses.push('vibration is told from µ 0.2 on');
    const at = !dial.whole ? peak(dial.harmonics) ? ', more than this actuator can follow' : '' : share > 100.5 ? `, with ${Charts.fixed(share, 0)} % of its voltage: out of reach` : share > .5 ? ` at ${Charts.fixed(share, 0)} % of its voltage` : '';
    return [`${clauses.join('; ')}${at}`, power > .05 ? calmer ? '' : 'loss' : 'gain'];
  }
  RX.verdict = verdict;

  // Values over the chosen dial on a grid, the other harmonics as they are.
  const GRID = 49;
  let field = null;
  function fieldOf() {
    const {dial, dial_matrix: matrix} = RX.state, at = dial.harmonics.indexOf(chosen), x = vector();
    x[2 * at] = x[2 * at + 1] = 0;
    const key = JSON.stringify([chosen, dial.reach, x]);
    if (field?.key === key && field.matrix === matrix) return field;
    const power = [], index = [];
    const least = [null, null];
    for (let row = 0; row < GRID; row++) for (let column = 0; column < GRID; column++) {
      const a = dial.reach * (2 * column / (GRID - 1) - 1), b = dial.reach * (1 - 2 * row / (GRID - 1));
      x[2 * at] = a; x[2 * at + 1] = b;
      const [p, v] = foresee(matrix, x);
      power.push(p); index.push(v);
      if (Math.hypot(a, b) > dial.reach) continue;
      [p, v].forEach((value, k) => { if (!least[k] || value < least[k].value) least[k] = {value, a, b}; });
    }
    // What the least of each would change with every inflow model, against this harmonic at rest.
    least.forEach((one, k) => {
      one.over = [matrix, ...matrix.inflows].map(wake => {
        const [there, still] = [[one.a, one.b], [0, 0]].map(([a, b]) => { x[2 * at] = a; x[2 * at + 1] = b; return foresee(wake, x)[k]; });
        return there - still;
      });
      one.agreed = Math.max(...one.over) < 0;
    });
    return field = {key, matrix, power, index, least};
  }
  // Segments of a line of one value on the grid, in cells.
  function contour(grid, level) {
    let path = '';
    const places = [];
    for (let row = 0; row < GRID - 1; row++) for (let column = 0; column < GRID - 1; column++) {
      const corners = [[column, row], [column + 1, row], [column + 1, row + 1], [column, row + 1]], cuts = [];
      corners.forEach(([x0, y0], k) => {
        const [x1, y1] = corners[(k + 1) % 4], v0 = grid[y0 * GRID + x0] - level, v1 = grid[y1 * GRID + x1] - level;
        if (v0 < 0 !== v1 < 0) { const t = v0 / (v0 - v1); cuts.push([x0 + t * (x1 - x0), y0 + t * (y1 - y0)]); }
      });
      for (let k = 0; k + 1 < cuts.length; k += 2) { path += `M${cuts[k].map(v => v.toFixed(2))}L${cuts[k + 1].map(v => v.toFixed(2))}`; places.push(cuts[k]); }
    }
    return [path, places];
  }
  const small = n => {
    const [a, p] = wave(n), r = 17, {reach} = RX.state.dial, x = 22 + r * a / reach * Math.cos(p * DEGREE), y = 22 - r * a / reach * Math.sin(p * DEGREE);
    return `<button data-harmonic="${n}" aria-pressed="${n === chosen}" aria-label="${n}/rev: ${a.toFixed(2)}° at ${p.toFixed(0)}°"><svg width="44" height="44" viewBox="0 0 44 44" aria-hidden="true"><circle cx="22" cy="22" r="${r}" fill="var(--rx-field)" stroke="var(--rx-line)"/>
      <path d="M22 22L${x.toFixed(1)} ${y.toFixed(1)}" stroke="var(--rx-blade)" stroke-width="1.6"/><circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${a ? 3.6 : 2.2}" fill="${a ? 'var(--rx-blade)' : 'var(--rx-faint)'}"/></svg><span>${n}/rev</span></button>`;
  };

  const LEVELS = [-8, -4, -2, -1, 0, 1, 2, 4, 8, 16];
  function dialSvg(size) {
    const {dial, dial_matrix: matrix} = RX.state, edge = 22, radius = size / 2 - edge, middle = size / 2, scale = radius / dial.reach;
    const [a, p] = wave(chosen), at = (amp, phase) => [middle + scale * amp * Math.cos(phase * DEGREE), middle - scale * amp * Math.sin(phase * DEGREE)];
    let inside = '';
    if (matrix) {
      const found = fieldOf(), step = 2 * radius / (GRID - 1), range = Math.max(...found.power) - Math.min(...found.power);
      const shown = LEVELS.filter(level => level === 0 || range < 14 || Math.abs(level) >= 2);
      inside += `<clipPath id="rxd${size}"><circle cx="${middle}" cy="${middle}" r="${radius}"/></clipPath><g clip-path="url(#rxd${size})" fill="none" stroke="var(--rx-ink)">`;
      const words = [];
      for (const level of shown) {
        const [path, places] = contour(found.power, level);
        if (!path) continue;
        inside += `<path transform="translate(${edge} ${edge}) scale(${step})" d="${path}" stroke-width="${(level ? .9 : 2) / step}" opacity="${level ? .55 : .9}"/>`;
        // Where it is named: inside, away from the dot and from other names.
        const [dx, dy] = at(a, p);
        const free = places.map(([x, y]) => [edge + step * x, edge + step * y]).filter(([x, y]) => Math.hypot(x - middle, y - middle) < radius - 16 && Math.hypot(x - dx, y - dy) > 30 && found.least.every(one => Math.hypot(x - middle - scale * one.a, y - middle + scale * one.b) > 26) && words.every(w => Math.hypot(x - w[0], y - w[1]) > 34));
        if (free.length) words.push([...free[free.length >> 1], level]);
      }
      inside += '</g>' + words.map(([x, y, level]) => `<text x="${x.toFixed(1)}" y="${(y + 4).toFixed(1)}" text-anchor="middle" class="rxd-level">${signed(level, 0)} %</text>`).join('');
      const [power, index] = found.least;
      for (const [one, mark, name] of [[power, 'P', 'least power'], [index, 'V', 'least vibration']]) {
        const x = middle + scale * one.a, y = middle - scale * one.b;
        const band = `${signed(Math.min(...one.over), 1)} to ${signed(Math.max(...one.over), 1)} % over inflow models`;
        const where = `${Math.hypot(one.a, one.b).toFixed(1)}° at ${((Math.atan2(one.b, one.a) / DEGREE + 360) % 360).toFixed(0)}°`;
        const said = one.agreed ? `${name} on this dial, foreseen: ${where}, ${band}` : `No phase is best: models disagree, ${band} where this one has ${name}`;
        inside += `<g data-agreed="${one.agreed}"><title>${said}</title><circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="8.5" fill="var(--rx-solid)" stroke="var(--rx-ink)" stroke-width="1.3" ${one.agreed ? '' : 'stroke-dasharray="2 2" opacity=".75"'}/><text x="${x.toFixed(1)}" y="${(y + 4.3).toFixed(1)}" text-anchor="middle" style="fill:var(--rx-ink);font-weight:700">${one.agreed ? mark : mark + '?'}</text></g>`;
      }
    }
    const {rings} = dial;
    const grid = rings.map(([r]) => `<circle cx="${middle}" cy="${middle}" r="${(scale * r).toFixed(1)}" fill="none" stroke="var(--rx-ink)" stroke-opacity="${r > dial.reach - 1e-6 ? .5 : .17}"/>`).join('')
      + rings.filter((_, k) => k % 2 === 1).map(([r, word]) => `<text x="${(middle + scale * r * .707 + 2).toFixed(1)}" y="${(middle + scale * r * .707 + (r > dial.reach - 1e-6 ? 13 : 4)).toFixed(1)}" class="rxd-level">${word}°</text>`).join('')
      + [0, 45, 90, 135].map(angle => { const [x, y] = at(dial.reach, angle), [u, v] = at(dial.reach, angle + 180); return `<path d="M${x.toFixed(1)} ${y.toFixed(1)}L${u.toFixed(1)} ${v.toFixed(1)}" stroke="var(--rx-ink)" stroke-opacity=".13"/>`; }).join('')
      + [[0, 'start', 3, 4], [90, 'middle', 0, -5], [180, 'end', -3, 4], [270, 'middle', 0, 14]].map(([angle, anchor, dx, dy]) => { const [x, y] = at(dial.reach, angle); return `<text x="${x + dx}" y="${y + dy}" text-anchor="${anchor}">${angle}°</text>`; }).join('');
    const room = dial.room * dial.whole - peak(dial.harmonics.filter(n => n !== chosen));
    const ring = dial.whole ? `<circle cx="${middle}" cy="${middle}" r="${(scale * Math.min(Math.max(room, 0), dial.reach)).toFixed(1)}" class="rxd-ring"><title>Reach of the actuator: ${Math.max(room, 0).toFixed(2)}° at ${chosen}/rev with the voltage that is left</title></circle>` : '';
    const [x, y] = at(a, p), label = `${chosen}/rev: ${a.toFixed(2)}° at phase ${p.toFixed(0)}°`;
    return `<svg class="rxd-dial" width="${size}" height="${size}" viewBox="0 0 ${size} ${size}" role="group" aria-label="Twist at ${chosen}/rev, amplitude by phase">${grid}${inside}${ring}
      <path d="M${middle} ${middle}L${x.toFixed(1)} ${y.toFixed(1)}" stroke="var(--rx-blade)" stroke-width="2"/><circle cx="${middle}" cy="${middle}" r="2" fill="var(--rx-ink)"/>
      <circle data-dot ${dial.whole && a > room + .005 ? 'data-beyond' : ''} cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="9" tabindex="${dial.held ? -1 : 0}" role="slider" aria-label="Amplitude and phase at ${chosen}/rev" aria-valuemin="0" aria-valuemax="${dial.reach}" aria-valuenow="${a}" aria-valuetext="${label}"><title>${label}. Drag it; arrow keys: phase and amplitude.</title></circle></svg>`;
  }
  // Less vibration green, more red.
  function shade(canvas, size) {
    canvas.width = canvas.height = GRID * 4;
    const radius = size / 2 - 22, {index} = fieldOf(), style = getComputedStyle(page), pen = canvas.getContext('2d');
    Object.assign(canvas.style, {left: '22px', top: '22px', width: `${2 * radius}px`, height: `${2 * radius}px`});
    const tones = ['--rx-good', '--rx-bad'].map(name => style.getPropertyValue(name).trim().match(/[0-9a-f]{2}/gi).map(v => parseInt(v, 16)));
    const one = document.createElement('canvas');
    one.width = one.height = GRID;
    const pixels = one.getContext('2d').createImageData(GRID, GRID);
    index.forEach((v, k) => {
      const tone = tones[v > 0 ? 1 : 0], strength = Math.min(Math.abs(v) / (v > 0 ? 160 : 70), 1);
      pixels.data.set([...tone, Math.round(190 * strength ** .8)], 4 * k);
    });
    one.getContext('2d').putImageData(pixels, 0, 0);
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(one, 0, 0, canvas.width, canvas.height);
  }

  // The front with this twist on it.
  function front(place, width, height) {
    const {dial_front: chart, dial_matrix: matrix} = RX.state, seen = matrix && foresee(matrix, vector());
    if (!chart) return;
    const now = seen ? [{kind: 'points', label: 'this twist', x: [seen[0]], y: [seen[1]], colour: 'var(--rx-blade)', size: 6.5}] : [];
    const series = chart.series.map(one => width < 360 && one.beside === 'below' ? {...one, names: []} : one);  // They would lie on each other.
    Charts.fill(place, {...chart, series: [...series, ...now]}, {width, height});
  }
  // The twist of the front nearest to a pixel of its chart, between two of its points by a straight line.
  function along(place, px, py) {
    const {front: all} = RX.state.dial, {X, Y} = place.drawn.place;
    let best = null;
    for (let k = 0; k + 1 < all.length; k++) {
      const [[p0, v0, u0], [p1, v1, u1]] = [all[k], all[k + 1]], [x0, y0, x1, y1] = [X(p0), Y(v0), X(p1), Y(v1)];
      const t = Charts.clamp(((px - x0) * (x1 - x0) + (py - y0) * (y1 - y0)) / Math.max((x1 - x0) ** 2 + (y1 - y0) ** 2, 1e-9), 0, 1);
      const far = Math.hypot(x0 + t * (x1 - x0) - px, y0 + t * (y1 - y0) - py);
      if (!best || far < best.far) best = {far, x: u0.map((u, j) => (1 - t) * u + t * u1[j])};
    }
    return best && Object.fromEntries(RX.state.dial.harmonics.map((n, k) => {
      const [a, b] = [best.x[2 * k] ?? 0, best.x[2 * k + 1] ?? 0];
      return [n, [Math.round(100 * Math.hypot(a, b)) / 100, (Math.round(Math.atan2(b, a) / DEGREE) + 360) % 360]];
    }));
  }

  // Two meters: the bar is the band over inflow models, the mark the design's own, the line the other blade.
  function meter(name, told, low, high, zero, said, kind) {
    const at = v => 100 * Charts.clamp((v - low) / (high - low), 0, 1), [a, b] = ends(told).map(at);
    return `<div class="rxd-meter" role="img" aria-label="${name}: ${said}"><span>${name}</span><div><i style="left:${a}%;width:${b - a}%"></i><s style="left:${at(zero)}%"></s><b data-kind="${kind}" style="left:${at(told[0])}%"></b></div><em class="rxf-num" data-kind="${kind}">${said}</em></div>`;
  }
  function readout() {
    const {dial, dial_matrix: matrix} = RX.state, [a, p] = wave(chosen), now = change(), head = `<p class="rxf-num"><b>${chosen}/rev</b> ${a.toFixed(2)}° <span class="rxf-dim">at phase ${p.toFixed(0)}°</span></p>`;
    const wait = dial.computing || !now ? `<p class="rxf-dim">${text(dial.words || 'Response to n/rev twist: computing …')}</p>` : '';
    if (!now) return head + wait;
    const [power] = now.power, whole = matrix ? .06 * matrix.power * dial.per_watt : Math.max(20, 1.4 * Math.abs(power)), [index] = now.index;
    const kind = (v, least) => Math.abs(v) < least ? '' : v > 0 ? 'loss' : 'gain';
    const shaking = held && matrix && !still.matches ? `<p class="rxf-dim">Shaking of the cabin drawn × ${dial.exaggerated}, slowed</p>` : '';
    return `${head}${meter('Power', now.power, -whole, whole, 0, `${signed(power, 1)} ${dial.unit}`, kind(power, .05))}
      ${now.index.length ? meter('Vibration', now.index, -100, 100, 0, `${signed(index, 0)} %`, kind(index, .5)) : ''}
      <p class="rxf-dim">${RX.state.earns ? '' : `${text(verdict()[0])}, `}against ${text(dial.against)}, ${text(dial.where)}${held || !dial.settled ? ', foreseen' : ''}</p>${wait}${shaking}`;
  }

  function fill(place) {
    const {dial, dial_matrix: matrix} = RX.state, large = place.hasAttribute('data-large'), width = place.clientWidth - (large ? 44 : 28);
    if (!dial || width < 120) return;
    const stamp = JSON.stringify([dial, RX.state.dial_front, chosen, width, place.clientHeight, held, pressed && wave(chosen), page.dataset.mantineColorScheme]);
    if (place.stamp === stamp && place.matrix === matrix && place.childElementCount) return;
    place.stamp = stamp;
    place.matrix = matrix;
    const focus = place.contains(document.activeElement) ? document.activeElement : null, again = focus?.matches('[data-dot]') ? '[data-dot]' : focus?.dataset.harmonic ? `[data-harmonic="${focus.dataset.harmonic}"]` : null;
    const size = large ? Math.min(place.clientHeight - 172, width / 2 - 24, 780) : Math.min(width, 300), wide = large ? width - size - 44 : width, high = large ? size + 20 : 228;
    if (!place.firstElementChild || place.dataset.size !== `${size} ${wide}`) {
      place.dataset.size = `${size} ${wide}`;
      place.shaded = null;  // Its canvas is another.
      place.innerHTML = `<div class="rxd-side"><div class="rxd-row"></div><div class="rxd-round" style="width:${size}px;height:${size}px"><canvas></canvas><div></div></div><p class="rxf-dim rxd-key"></p><div class="rxd-read" data-explorer="dial-read"></div></div>
        <div class="rxd-side"><div class="rxd-front"></div>${large ? '' : '<button class="rxd-open" data-dial-large>Enlarge dial and front</button>'}</div>${large ? '<button class="rxl-close" data-dial-large aria-label="Close" title="Close (Esc)">×</button>' : ''}`;
    }
    place.querySelector('.rxd-row').innerHTML = dial.harmonics.map(small).join('');
    const canvas = place.querySelector('canvas');
    canvas.hidden = !matrix;
    if (matrix && (place.shaded !== fieldOf() || place.scheme !== page.dataset.mantineColorScheme)) { shade(canvas, size); place.shaded = fieldOf(); place.scheme = page.dataset.mantineColorScheme; }
    place.querySelector('.rxd-round > div').innerHTML = dialSvg(size);
    place.querySelector('.rxd-key').textContent = matrix ? `P least power · V least vibration${dial.whole ? ' · ring: reach' : ''}` : '';
    place.querySelector('.rxd-read').innerHTML = readout();
    front(place.querySelector('.rxd-front'), wide, high);
    if (again) place.querySelector(again)?.focus({preventScroll: true});
  }
  function draw() {
    frame ||= requestAnimationFrame(() => { frame = 0; RX.told?.(); for (const place of document.querySelectorAll('[data-dial]')) fill(place); });
  }
  // What was pressed holds until the sliders have it; from then on they tell, or an undo would not be seen.
  RX.paint('dial', now => {
    if (now && pressed && Object.entries(pressed.waves).every(([n, [size, phase]]) => {
      const [, a, p] = now.now.find(([order]) => order === Number(n)) ?? [0, 0, 0];
      return Math.abs(a - size) < .021 && (a < .03 || Math.abs(p - phase) < .6);
    })) pressed = null;
    draw();
  });
  for (const name of ['dial_matrix', 'dial_front']) RX.paint(name, draw);
  new ResizeObserver(draw).observe(document.querySelector('.rxf-stage'));
  new MutationObserver(() => { for (const place of document.querySelectorAll('[data-dial]')) if (!place.childElementCount) draw(); }).observe(document.getElementById('root') ?? document.body, {childList: true, subtree: true});

  // The hand, on a dial or along the front. The dot goes where the pointer is; its place is sent at most every 50 ms.
  const tell = waves => {
    waiting = Object.entries(waves).map(([n, [a, p]]) => [Number(n), a, p]);
    setTimeout(() => { if (waiting) { sent = performance.now(); RX.send('dial', waiting); waiting = null; } }, Math.max(0, 50 - (performance.now() - sent)));
  };
  const press = waves => {
    pressed = {waves, at: performance.now()};  // Until the sliders have come.
    setTimeout(() => { if (pressed && performance.now() - pressed.at > 900) pressed = null; draw(); }, 950);
    draw();
  };
  function follow(event) {
    const box = held.place.getBoundingClientRect();
    if (held.front) held.waves = along(held.place, event.clientX - box.left, event.clientY - box.top - held.above) ?? held.waves;
    else {
      const radius = box.width / 2 - 22, x = (event.clientX - box.left - box.width / 2) / radius, y = (box.top + box.height / 2 - event.clientY) / radius;
      const size = Math.round(100 * RX.state.dial.reach * Math.min(Math.hypot(x, y), 1)) / 100;
      held.waves = {[chosen]: [size < .04 ? 0 : size, (Math.round(Math.atan2(y, x) / DEGREE) + 360) % 360]};  // The middle means none.
    }
    tell(held.waves);
    draw();
  }
  document.addEventListener('pointerdown', event => {
    const near = event.target instanceof Element && event.isPrimary && event.button === 0 && event.target, circle = near && near.closest('.rxd-round'), chart = near && near.closest('.rxd-front');
    if (!(circle || (chart && near.closest('svg') && RX.state.dial?.front.length > 1)) || RX.state.dial?.held) return;
    const box = (circle || chart).getBoundingClientRect();
    if (circle && Math.hypot(event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2) > box.width / 2 - 8) return;
    event.preventDefault();
    held = {place: circle || chart, front: !circle, waves: {}, above: circle ? 0 : near.closest('svg').getBoundingClientRect().top - box.top};
    circle?.querySelector('[data-dot]')?.focus({preventScroll: true});
    RX.send('dial', 'start');
    follow(event);
    shake();
  });
  addEventListener('pointermove', event => { if (held && event.isPrimary) follow(event); });
  for (const end of ['pointerup', 'pointercancel'])
    addEventListener(end, event => {
      if (!held || !event.isPrimary) return;
      const {waves} = held;
      waiting = null;
      RX.send('dial', Object.entries(waves).map(([n, [a, p]]) => [Number(n), a, p]));
      RX.send('dial', 'end');
      held = null;
      press(waves);
    });
  document.addEventListener('keydown', event => {
    const near = event.target instanceof Element && event.target;
    if (event.key === 'Escape' && page.dataset.enlarged) { event.stopPropagation(); enlarge(false); return; }
    const dot = near && near.closest('[data-dot]'), many = event.shiftKey ? 5 : 1;
    const step = dot && {ArrowUp: [.05, 0], ArrowDown: [-.05, 0], PageUp: [.25, 0], PageDown: [-.25, 0], ArrowLeft: [0, 5], ArrowRight: [0, -5], Delete: [-99, 0]}[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const [a, p] = wave(chosen), waves = {[chosen]: [Charts.clamp(Math.round(100 * (a + many * step[0])) / 100, 0, RX.state.dial.reach), (p + many * step[1] + 360) % 360]};
    tell(waves);
    press(waves);
  }, true);

  // While the hand is on the dial, and some seconds longer, the cabin moves as a rigid body under the foreseen loads at
  // N_b/rev, A cos(N_b ψ − φ)/(m (N_b Ω)²): exaggerated and slowed, and not for those who asked for less motion.
  const still = matchMedia('(prefers-reduced-motion: reduce)'), NODE = '/airframe', SHAKES = 2.5, LONGER = 4000;
  let shaken = 0, rest = null, last = null;
  function shake() {
    if (still.matches || shaken) return;
    const pose = () => window.__viserMutable?.nodePoseData?.[NODE], begun = performance.now();
    let until = Infinity;
    const put = position => { const now = pose(); if (now) { last = position; Object.assign(now, {position, poseUpdateState: 'needsUpdate'}); window.__viserMutable.requestRender?.(); } };
    const step = now => {
      const {dial, dial_matrix: matrix} = RX.state, at = pose();
      if (held) until = now + LONGER;
      if (!dial || !matrix || !at || now > until) { if (rest) put(rest); shaken = 0; rest = last = null; return; }
      if (at.position !== last) rest = [...at.position];
      const loads = values(matrix, vector()), turn = 2 * Math.PI * SHAKES * (now - begun) / 1000;
      put(rest.map((v, k) => v + dial.shake * (loads[2 * k] * Math.cos(turn) + loads[2 * k + 1] * Math.sin(turn))));
      shaken = requestAnimationFrame(step);
    };
    shaken = requestAnimationFrame(step);
  }
  document.addEventListener('click', event => {
    const near = event.target instanceof Element && event.target.closest('[data-harmonic], [data-dial-large]');
    if (!near) return;
    if (near.dataset.harmonic) { chosen = Number(near.dataset.harmonic); draw(); } else enlarge(!page.dataset.enlarged);
  });

  // Dial and front over the stage, as large as it allows.
  function enlarge(open) {
    const place = part('large');
    if (open) page.dataset.enlarged = 'large'; else delete page.dataset.enlarged;
    place.hidden = !open;
    place.innerHTML = open ? '<div class="rxd" data-dial data-large data-explorer="dial-large"></div>' : '';
    draw();
  }
  RX.also('bar', bar => { if (bar.mode !== 'actuate' && page.dataset.enlarged) enlarge(false); });
})();
