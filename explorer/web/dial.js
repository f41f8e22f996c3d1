// The dial of twist at n/rev: a dot to drag, power and vibration foreseen by the T-matrix, and the front of both beside it.
(() => {
  const {text, part} = RX, page = document.documentElement, DEGREE = Math.PI / 180;
  const {signed} = Charts;
  let chosen = 3, held = null, pressed = null, sent = 0, waiting = null, frame = 0;

  // Power and index [%] from those without n/rev twist, of cosines and sines [°].
  function foresee(matrix, x) {
    const values = matrix.base.map((base, k) => base + x.reduce((sum, a, i) => {
      if (!a) return sum;
      const second = matrix.second[k][i];
      return sum + a * (matrix.slopes[k][i] + .5 * second.reduce((bent, h, j) => bent + h * x[j], 0));
    }, 0));
    let forces = 0, moments = 0;
    for (let k = 0; k < 5; k++) {
      const size = matrix.gains[k] ** 2 * (values[2 * k] ** 2 + values[2 * k + 1] ** 2);
      if (k < 3) forces += size; else moments += size;
    }
    return [100 * (values[10] / matrix.power - 1), 100 * ((Math.sqrt(forces) + Math.sqrt(moments)) / matrix.index - 1)];
  }
  RX.foresee = foresee;
  // Amplitude and phase [°] of a harmonic: as the hand has it, or as the sliders do.
  function wave(n) {
    if (held?.n === n) return [held.amplitude, held.phase];
    if (pressed?.n === n && performance.now() - pressed.at < 900) return [pressed.amplitude, pressed.phase];
    const one = RX.state.dial.now.find(([order]) => order === n);
    return one ? [one[1], one[2]] : [0, 0];
  }
  const vector = () => RX.state.dial.harmonics.flatMap(n => { const [a, p] = wave(n); return [a * Math.cos(p * DEGREE), a * Math.sin(p * DEGREE)]; });

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
  function contour(values, level) {
    let path = '';
    const places = [];
    for (let row = 0; row < GRID - 1; row++) for (let column = 0; column < GRID - 1; column++) {
      const corners = [[column, row], [column + 1, row], [column + 1, row + 1], [column, row + 1]], ends = [];
      corners.forEach(([x0, y0], k) => {
        const [x1, y1] = corners[(k + 1) % 4], v0 = values[y0 * GRID + x0] - level, v1 = values[y1 * GRID + x1] - level;
        if (v0 < 0 !== v1 < 0) { const t = v0 / (v0 - v1); ends.push([x0 + t * (x1 - x0), y0 + t * (y1 - y0)]); }
      });
      for (let k = 0; k + 1 < ends.length; k += 2) { path += `M${ends[k].map(v => v.toFixed(2))}L${ends[k + 1].map(v => v.toFixed(2))}`; places.push(ends[k]); }
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
    const [x, y] = at(a, p), label = `${chosen}/rev: ${a.toFixed(2)}° at phase ${p.toFixed(0)}°`;
    return `<svg class="rxd-dial" width="${size}" height="${size}" viewBox="0 0 ${size} ${size}" role="group" aria-label="Twist at ${chosen}/rev, amplitude by phase">${grid}${inside}
      <path d="M${middle} ${middle}L${x.toFixed(1)} ${y.toFixed(1)}" stroke="var(--rx-blade)" stroke-width="2"/><circle cx="${middle}" cy="${middle}" r="2" fill="var(--rx-ink)"/>
      <circle data-dot cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="9" tabindex="${dial.held ? -1 : 0}" role="slider" aria-label="Amplitude and phase at ${chosen}/rev" aria-valuemin="0" aria-valuemax="${dial.reach}" aria-valuenow="${a}" aria-valuetext="${label}"><title>${label}. Drag it; arrow keys: phase and amplitude.</title></circle></svg>`;
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
    Charts.fill(place, {...chart, value: chart.words.length > 40 ? '' : chart.words, series: [...series, ...now]}, {width, height});
  }

  function readout() {
    const {dial, dial_matrix: matrix} = RX.state, [a, p] = wave(chosen), head = `<b>${chosen}/rev</b> ${a.toFixed(2)}° <span class="rxf-dim">at phase ${p.toFixed(0)}°</span>`;
    if (!matrix) return `<p class="rxf-num">${head}</p><p class="rxf-dim">${dial.computing ? 'Response to n/rev twist: computing …' : ''}</p>`;
    const row = (name, [power, index]) => {
      const kind = (v, least) => Math.abs(v) < least ? '' : v < 0 ? 'rxf-good' : 'rxf-bad';
      return `<p class="rxf-num"><span class="rxf-dim">${name}</span> power <b class="${kind(power, .05)}">${signed(power, 1)} %</b> · vibration <b class="${kind(index, .5)}">${signed(index, 0)} %</b></p>`;
    };
    return `<p class="rxf-num">${head}</p>${row('foreseen', foresee(matrix, vector()))}${held || !dial.settled ? '<p class="rxf-dim">trimmed …</p>' : row('trimmed', dial.settled)}`;
  }

  function fill(place) {
    const {dial, dial_matrix: matrix} = RX.state, large = place.hasAttribute('data-large'), width = place.clientWidth - (large ? 44 : 28);
    if (!dial || width < 120) return;
    const stamp = JSON.stringify([dial, RX.state.dial_front, chosen, width, place.clientHeight, held && [held.amplitude, held.phase], pressed && wave(chosen), page.dataset.mantineColorScheme]);
    if (place.stamp === stamp && place.matrix === matrix && place.childElementCount) return;
    place.stamp = stamp;
    place.matrix = matrix;
    const focus = place.contains(document.activeElement) ? document.activeElement : null, again = focus?.matches('[data-dot]') ? '[data-dot]' : focus?.dataset.harmonic ? `[data-harmonic="${focus.dataset.harmonic}"]` : null;
    const size = large ? Math.min(place.clientHeight - 172, width / 2 - 24, 780) : Math.min(width, 300), wide = large ? width - size - 44 : width, high = large ? size + 20 : 228;
    if (!place.firstElementChild || place.dataset.size !== `${size} ${wide}`) {
      place.dataset.size = `${size} ${wide}`;
      place.shaded = null;  // Its canvas is another.
      place.innerHTML = `<div class="rxd-side"><div class="rxd-row"></div><div class="rxd-round" style="width:${size}px;height:${size}px"><canvas></canvas><div></div></div><div class="rxd-read" data-explorer="dial-read"></div></div>
        <div class="rxd-side"><div class="rxd-why"></div><div class="rxd-front"></div>${large ? '' : '<button class="rxd-open" data-dial-large>Enlarge dial and front</button>'}</div>${large ? '<button class="rxl-close" data-dial-large aria-label="Close" title="Close (Esc)">×</button>' : ''}`;
    }
    place.querySelector('.rxd-row').innerHTML = dial.harmonics.map(small).join('');
    const canvas = place.querySelector('canvas');
    canvas.hidden = !matrix;
    if (matrix && (place.shaded !== fieldOf() || place.scheme !== page.dataset.mantineColorScheme)) { shade(canvas, size); place.shaded = fieldOf(); place.scheme = page.dataset.mantineColorScheme; }
    place.querySelector('.rxd-round > div').innerHTML = dialSvg(size);
    place.querySelector('.rxd-read').innerHTML = readout();
    place.querySelector('.rxd-why').innerHTML = dial.words ? `<p>${text(dial.words)}</p>${dial.action ? `<button data-do="dial_bend">${text(dial.action)}</button>` : ''}` : '';
    front(place.querySelector('.rxd-front'), wide, high);
    if (again) place.querySelector(again)?.focus({preventScroll: true});
  }
  function draw() {
    frame ||= requestAnimationFrame(() => { frame = 0; for (const place of document.querySelectorAll('[data-dial]')) fill(place); });
  }
  // What was pressed holds until the sliders have it; from then on they tell, or an undo would not be seen.
  RX.paint('dial', now => {
    const [, a, p] = now && pressed ? now.now.find(([order]) => order === pressed.n) ?? [0, 0, 0] : [];
    if (pressed && Math.abs(a - pressed.amplitude) < .006 && (!a || Math.abs(p - pressed.phase) < .6)) pressed = null;
    draw();
  });
  for (const name of ['dial_matrix', 'dial_front']) RX.paint(name, draw);
  new ResizeObserver(draw).observe(document.querySelector('.rxf-stage'));
  new MutationObserver(() => { for (const place of document.querySelectorAll('[data-dial]')) if (!place.childElementCount) draw(); }).observe(document.getElementById('root') ?? document.body, {childList: true, subtree: true});

  // The hand. The dot goes where the pointer is; its place is sent at most every 50 ms.
  const tell = (n, change) => {
    waiting = [n, change];
    setTimeout(() => { if (waiting) { sent = performance.now(); RX.send('dial', waiting); waiting = null; } }, Math.max(0, 50 - (performance.now() - sent)));
  };
  function follow(event) {
    const box = held.round.getBoundingClientRect(), radius = box.width / 2 - 22, x = (event.clientX - box.left - box.width / 2) / radius, y = (box.top + box.height / 2 - event.clientY) / radius;
    held.amplitude = Math.round(100 * RX.state.dial.reach * Math.min(Math.hypot(x, y), 1)) / 100;
    if (held.amplitude < .04) held.amplitude = 0;  // The middle means none.
    held.phase = (Math.round(Math.atan2(y, x) / DEGREE) + 360) % 360;
    tell(held.n, [held.amplitude, held.phase]);
    draw();
  }
  document.addEventListener('pointerdown', event => {
    const round = event.target instanceof Element && event.isPrimary && event.button === 0 && event.target.closest('.rxd-round');
    if (!round || RX.state.dial?.held) return;
    const box = round.getBoundingClientRect(), far = Math.hypot(event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2);
    if (far > box.width / 2 - 8) return;
    event.preventDefault();
    held = {n: chosen, round};
    round.querySelector('[data-dot]')?.focus({preventScroll: true});
    RX.send('dial', [chosen, 'start']);
    follow(event);
  });
  addEventListener('pointermove', event => { if (held && event.isPrimary) follow(event); });
  for (const end of ['pointerup', 'pointercancel'])
    addEventListener(end, event => {
      if (!held || !event.isPrimary) return;
      const {n, amplitude, phase} = held;
      waiting = null;
      RX.send('dial', [n, [amplitude, phase]]);
      RX.send('dial', [n, 'end']);
      pressed = {n, amplitude, phase, at: performance.now()};  // Until the sliders have come.
      held = null;
      setTimeout(draw, 950);
      draw();
    });
  document.addEventListener('keydown', event => {
    const near = event.target instanceof Element && event.target;
    if (event.key === 'Escape' && page.dataset.enlarged) { event.stopPropagation(); enlarge(false); return; }
    const dot = near && near.closest('[data-dot]'), many = event.shiftKey ? 5 : 1;
    const step = dot && {ArrowUp: [.05, 0], ArrowDown: [-.05, 0], PageUp: [.25, 0], PageDown: [-.25, 0], ArrowLeft: [0, 5], ArrowRight: [0, -5], Delete: [-99, 0]}[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const [a, p] = wave(chosen);
    pressed = {n: chosen, amplitude: Charts.clamp(Math.round(100 * (a + many * step[0])) / 100, 0, RX.state.dial.reach), phase: (p + many * step[1] + 360) % 360, at: performance.now()};
    tell(chosen, [pressed.amplitude, pressed.phase]);
    setTimeout(draw, 950);
    draw();
  }, true);
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
