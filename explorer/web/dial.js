// @ts-check
// The dial of twist at n/rev: a dot to drag, power and vibration foreseen by the T-matrix, the front of both beside it.
(() => {
  const {DEGREE, text, clamp, lerp, distance, turned, fixed, signed, trace, write, calm} = Common;
  const {closest, soon, paced, drag, viewer} = Common, {part} = RX, page = document.documentElement;
  const EDGE = 22;  // [px] Around the circle.
  // `held`: the waves in the hand; `left`: those it has left, until the sliders have them. A wave is amplitude and
  // phase [°] of one harmonic.
  let chosen = 3, held = null, left = null;

  // Loads at N_b/rev and power with cosines and sines [°] of n/rev twist.
  function values({base, slopes, second}, x) {
    return base.map((value, k) => value + x.reduce((sum, a, i) => {
      const bent = a && second[k][i].reduce((all, curvature, j) => all + curvature * x[j], 0);
      return sum + a * (slopes[k][i] + .5 * bent);
    }, 0));
  }
  // Power and index of vibration against the same without n/rev [%].
  /** @returns {[number, number]} */
  function foresee(matrix, x) {
    const all = values(matrix, x), sums = [0, 0];  // Forces, moments.
    for (let k = 0; k < 5; k++) sums[k < 3 ? 0 : 1] += matrix.gains[k] ** 2 * (all[2 * k] ** 2 + all[2 * k + 1] ** 2);
    return [100 * (all[10] / matrix.power - 1), 100 * ((Math.sqrt(sums[0]) + Math.sqrt(sums[1])) / matrix.index - 1)];
  }
  RX.foresee = foresee;
  // As the hand has it, or as the sliders do.
  function wave(n) {
    const ours = held ?? (left && performance.now() - left.at < 900 ? left.waves : null);
    return ours?.[n] ?? RX.shown('dial').now.find(([order]) => order === n)?.slice(1) ?? [0, 0];
  }
  const polar = (size, angle) => [size * Math.cos(angle * DEGREE), size * Math.sin(angle * DEGREE)];
  const direction = (x, y) => turned(Math.round(Math.atan2(y, x) / DEGREE));
  const hundredths = value => Math.round(100 * value) / 100;
  const vector = () => RX.shown('dial').harmonics.flatMap(n => polar(...wave(n)));
  // Largest twist of some harmonics together over a turn [°].
  function peak(orders) {
    const waves = orders.map(n => [n, ...wave(n)]), azimuths = Array.from({length: 72}, (_, k) => 5 * k);
    return Math.max(...azimuths.map(psi =>
      Math.abs(waves.reduce((sum, [n, size, phase]) => sum + size * Math.cos((n * psi - phase) * DEGREE), 0))));
  }

  // What twist at n/rev alone changes, with every inflow model, the design's own first: foreseen in the hand, else
  // trimmed. Of power the design's own counts, of vibration the mean.
  function change() {
    const {dial, dial_matrix: matrix} = RX.state;
    if (dial && !held && !left && dial.settled) return dial.settled;
    if (!dial || !matrix) return null;
    const x = vector(), models = [matrix, ...matrix.inflows], all = models.map(model => foresee(model, x));
    const watts = all.map(([power], k) => power / 100 * models[k].power * dial.per_watt);
    return {power: watts, index: all.map(([, index]) => index)};
  }
  const ends = list => [Math.min(...list), Math.max(...list)];
  const mean = list => list.reduce((sum, value) => sum + value, 0) / list.length;
  function needs(powers) {
    const [power] = powers, [low, high] = ends(powers), {unit} = RX.shown('dial');
    const digits = Math.abs(power) < 10 ? 1 : 0;
    if (Math.abs(power) < .05) return 'needs no more power';
    if (low * high <= 0) return `power unclear (${signed(low, digits)}…${signed(high, digits)} ${unit})`;
    const range = powers.length > 1 ? ` (${[low, high].map(end => fixed(Math.abs(end), digits)).join('…')})` : '';
    const size = `${fixed(Math.abs(power), digits)}${range} ${unit}`;
    return power > 0 ? `needs ${size} more` : `saves ${size}`;
  }
  function shakes(index) {
    if (!index.length) return 'vibration is shown from µ 0.2';
    const [low, high] = ends(index), range = (from, to) => `${fixed(from)}…${fixed(to)} %`;
    if (high < 0) return `cuts vibration by ${fixed(-mean(index))} % (${range(-high, -low)})`;
    if (low > 0) return `raises vibration by ${fixed(mean(index))} % (${range(low, high)})`;
    return `vibration unclear (${signed(low, 0)}…${signed(high, 0)} %)`;
  }
  // Power and vibration in one sentence.
  function verdict() {
    const dial = RX.shown('dial'), now = change();
    return now ? `${needs(now.power)}; ${shakes(now.index)}` : dial.problem || dial.words;
  }

  // Values over the chosen dial on a grid, the other harmonics as they are.
  const GRID = 49;
  let known = null;
  function fieldOf() {
    const {harmonics, reach} = RX.shown('dial'), matrix = RX.shown('dial_matrix');
    const at = 2 * harmonics.indexOf(chosen), x = vector(), models = [matrix, ...matrix.inflows];
    const seen = (model, point) => { [x[at], x[at + 1]] = point; return foresee(model, x); };
    x[at] = x[at + 1] = 0;
    const key = JSON.stringify([chosen, reach, x]);
    if (known?.key === key && known.matrix === matrix) return known;
    const power = [], index = [], least = [];
    for (let row = 0; row < GRID; row++) for (let column = 0; column < GRID; column++) {
      const point = [reach * (2 * column / (GRID - 1) - 1), reach * (1 - 2 * row / (GRID - 1))];
      const all = models.map(model => seen(model, point));
      power.push(all[0][0]);
      const candidates = [mean(all.map(([value]) => value)), mean(all.map(([, value]) => value))];
      index.push(candidates[1]);
      if (Math.hypot(...point) <= reach) candidates.forEach((value, k) => {
        const best = least[k];
        if (!best || value < best.value) least[k] = {value, point};
      });
    }
    // What the least of each would change with every inflow model, against this harmonic at rest.
    least.forEach((one, k) => {
      one.over = models.map(model => seen(model, one.point)[k] - seen(model, [0, 0])[k]);
      one.agreed = Math.max(...one.over) < 0;
    });
    return known = {key, matrix, power, index, least};
  }
  // A line of one value on the grid, in cells: its path, and a point of each of its pieces.
  function contour(grid, level) {
    const points = [];
    let path = '';
    for (let row = 0; row < GRID - 1; row++) for (let column = 0; column < GRID - 1; column++) {
      const corners = [[column, row], [column + 1, row], [column + 1, row + 1], [column, row + 1]], cuts = [];
      corners.forEach(([x0, y0], k) => {
        const [x1, y1] = corners[(k + 1) % 4], v0 = grid[y0 * GRID + x0] - level, v1 = grid[y1 * GRID + x1] - level;
        const share = v0 / (v0 - v1);
        if (v0 < 0 !== v1 < 0) cuts.push([lerp(x0, x1, share), lerp(y0, y1, share)]);
      });
      for (let k = 0; k + 1 < cuts.length; k += 2) {
        path += `M${cuts[k].map(v => v.toFixed(2))}L${cuts[k + 1].map(v => v.toFixed(2))}`;
        points.push(cuts[k]);
      }
    }
    return {path, points};
  }
  function small(n) {
    const [size, phase] = wave(n), radius = 17, [dx, dy] = polar(radius * size / RX.shown('dial').reach, phase);
    const x = (22 + dx).toFixed(1), y = (22 - dy).toFixed(1);
    const label = `${n}/rev: ${size.toFixed(2)}° at ${phase.toFixed(0)}°`;
    return `<button data-harmonic="${n}" aria-pressed="${n === chosen}" aria-label="${label}">
      <svg width="44" height="44" viewBox="0 0 44 44" aria-hidden="true">
        <circle cx="22" cy="22" r="${radius}" fill="var(--rx-field)" stroke="var(--rx-line)"/>
        <path d="M22 22L${x} ${y}" stroke="var(--rx-blade)" stroke-width="1.6"/>
        <circle cx="${x}" cy="${y}" r="${size ? 3.6 : 2.2}" fill="var(${size ? '--rx-blade' : '--rx-faint'})"/></svg>
      <span>${n}/rev</span></button>`;
  }

  const LEVELS = [-8, -4, -2, -1, 0, 1, 2, 4, 8, 16];
  // Places on a dial of this size [px].
  function placing(size) {
    const {reach} = RX.shown('dial'), middle = size / 2, radius = middle - EDGE, scale = radius / reach;
    const at = (x, y) => [middle + scale * x, middle - scale * y];
    return {reach, middle, radius, scale, at, spot: (amplitude, phase) => at(...polar(amplitude, phase))};
  }
  // Lines of equal power, named inside, away from the dot and from other names; least power and least vibration.
  function drawField(size) {
    const {power, least: all} = fieldOf(), least = RX.shown('dial').computing ? [] : all;
    const {middle, radius, at, spot} = placing(size), step = 2 * radius / (GRID - 1);
    const few = Math.max(...power) - Math.min(...power) >= 14, dot = spot(...wave(chosen)), names = [];
    const lines = LEVELS.filter(level => level === 0 || !few || Math.abs(level) >= 2).map(level => {
      const {path, points} = contour(power, level), free = points.map(([x, y]) => [EDGE + step * x, EDGE + step * y])
        .filter(point => distance(point, [middle, middle]) < radius - 16 && distance(point, dot) > 30
          && least.every(one => distance(point, at(...one.point)) > 26)
          && names.every(name => distance(point, name) > 34));
      if (free.length) names.push([...free[free.length >> 1], level]);
      return `<path transform="translate(${EDGE} ${EDGE}) scale(${step})" d="${path}"
        stroke-width="${(level ? .9 : 2) / step}" opacity="${level ? .55 : .9}"/>`;
    });
    const marks = least.map(({point, over, agreed}, k) => {
      const [mark, name] = [['P', 'least power'], ['V', 'least vibration']][k];
      const [x, y] = at(...point), low = Math.min(...over), high = Math.max(...over);
      const band = `${signed(low)} to ${signed(high)} % over inflow models`;
      const where = `${Math.hypot(...point).toFixed(1)}° at ${direction(...point)}°`;
      return `<g data-agreed="${agreed}"><title>${agreed ? `Predicted ${name} on this dial: ${where}, ${band}`
        : `No clear best phase at ${name} of this model: the models disagree: ${band}`}</title>
        <circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="8.5" fill="var(--rx-solid)" stroke="var(--rx-ink)"
          stroke-width="1.3" ${agreed ? '' : 'stroke-dasharray="2 2" opacity=".75"'}/>
        <text x="${x.toFixed(1)}" y="${(y + 4.3).toFixed(1)}" text-anchor="middle"
          style="fill:var(--rx-ink);font-weight:700">${mark}${agreed ? '' : '?'}</text></g>`;
    });
    const words = names.map(([x, y, level]) => `<text x="${x.toFixed(1)}" y="${(y + 4).toFixed(1)}" text-anchor="middle"
      class="rxd-level">${signed(level, 0)} %</text>`);
    return `<clipPath id="rxd${size}"><circle cx="${middle}" cy="${middle}" r="${radius}"/></clipPath>
      <g clip-path="url(#rxd${size})" fill="none" stroke="var(--rx-ink)">${lines.join('')}</g>
      ${words.join('')}${marks.join('')}`;
  }
  const AROUND = [[0, 'start', 3, 4], [90, 'middle', 0, -5], [180, 'end', -3, 4], [270, 'middle', 0, 14]];
  function drawGrid({rings}, {reach, middle, scale, spot}) {
    const outer = r => r > reach - 1e-6, circles = rings.map(([r]) => `<circle cx="${middle}" cy="${middle}" fill="none"
      r="${(scale * r).toFixed(1)}" stroke="var(--rx-ink)" stroke-opacity="${outer(r) ? .5 : .17}"/>`);
    const sizes = rings.filter((_, k) => k % 2 === 1).map(([r, word]) => {
      const [x, y] = spot(r, -45);
      return `<text x="${x + 2}" y="${y + (outer(r) ? 13 : 4)}" class="rxd-level">${word}°</text>`;
    });
    const rays = [0, 45, 90, 135].map(angle => trace([spot(reach, angle), spot(reach, angle + 180)]))
      .map(path => `<path d="${path}" stroke="var(--rx-ink)" stroke-opacity=".13"/>`);
    const angles = AROUND.map(([angle, anchor, dx, dy]) => {
      const [x, y] = spot(reach, angle);
      return `<text x="${x + dx}" y="${y + dy}" text-anchor="${anchor}">${angle}°</text>`;
    });
    return [...circles, ...sizes, ...rays, ...angles].join('');
  }
  // Amplitude that steady voltage and the other harmonics leave to the chosen one.
  const within = ({room, whole, harmonics}) => Math.max(room * whole - peak(harmonics.filter(n => n !== chosen)), 0);
  const beyond = ({room, whole, harmonics}) => whole && peak(harmonics) > room * whole + .005;
  function dialSvg(size) {
    const dial = RX.shown('dial'), matrix = RX.state.dial_matrix;
    const places = placing(size), {reach, middle, scale, spot} = places;
    const [amplitude, phase] = wave(chosen), [x, y] = spot(amplitude, phase).map(v => v.toFixed(1));
    const room = within(dial);
    const ring = `<circle cx="${middle}" cy="${middle}" r="${scale * Math.min(room, reach)}" class="rxd-ring">
      <title>Reach of the actuator: ${room.toFixed(2)}° at ${chosen}/rev with the voltage that is left</title>
      </circle>`;
    const label = `${chosen}/rev: ${amplitude.toFixed(2)}° at phase ${phase.toFixed(0)}°`;
    return `<svg class="rxd-dial" width="${size}" height="${size}" viewBox="0 0 ${size} ${size}" role="group"
        aria-label="Twist at ${chosen}/rev, amplitude by phase">
      ${dial.whole ? ring : ''}${drawGrid(dial, places)}${matrix ? drawField(size) : ''}
      <path d="M${middle} ${middle}L${x} ${y}" stroke="var(--rx-blade)" stroke-width="2"/>
      <circle cx="${middle}" cy="${middle}" r="2" fill="var(--rx-ink)"/>
      <circle data-dot ${beyond(dial) ? 'data-beyond' : ''} cx="${x}" cy="${y}" r="9"
        tabindex="0" role="slider" aria-label="Amplitude and phase at ${chosen}/rev"
        aria-valuemin="0" aria-valuemax="${reach}" aria-valuenow="${amplitude}" aria-valuetext="${label}">
        <title>${label}. Drag it; arrow keys: phase and amplitude.</title></circle></svg>`;
  }
  // Less vibration green, more red: changes [%] of full colour.
  const LESS = 70, MORE = 160, tint = value =>
    Math.round(190 * Math.min(Math.abs(value) / (value > 0 ? MORE : LESS), 1) ** .8);
  const shades = [-1, -.75, -.5, -.25, 0, .25, .5, .75, 1].map(share => {
    const [tone, full] = share > 0 ? ['bad', MORE] : ['good', LESS];
    return `color-mix(in srgb, var(--rx-${tone}) ${(tint(share * full) / 2.55).toFixed()}%, var(--rx-paper))`;
  });
  const COLOUR_KEY = `<div>vibration [%]</div>${Charts.bar(shades,
    [-LESS, -LESS / 2, 0, MORE / 2, MORE].map((value, k) => [25 * k, signed(value, 0)]))}`;
  function shade(canvas, size) {
    const tile = document.createElement('canvas'), style = getComputedStyle(page), pen = canvas.getContext('2d');
    const ink = /** @type {CanvasRenderingContext2D} */ (tile.getContext('2d'));
    const tones = ['--rx-good', '--rx-bad'].map(name =>
      Array.from(style.getPropertyValue(name).matchAll(/[0-9a-f]{2}/gi), ([byte]) => parseInt(byte, 16)));
    canvas.width = canvas.height = GRID * 4;
    canvas.style.cssText = `left:${EDGE}px;top:${EDGE}px;width:${size - 2 * EDGE}px;height:${size - 2 * EDGE}px`;
    tile.width = tile.height = GRID;
    const pixels = ink.createImageData(GRID, GRID);
    fieldOf().index.forEach((value, k) => {
      pixels.data.set([...tones[value > 0 ? 1 : 0], tint(value)], 4 * k);
    });
    ink.putImageData(pixels, 0, 0);
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(tile, 0, 0, canvas.width, canvas.height);
  }

  // The front with this twist on it.
  function drawFront(element, width, height) {
    const {dial_front: chart, dial_matrix: matrix} = RX.state;
    if (!chart) return;
    /** @type {any[]} */
    const series = [...chart.series];
    if (matrix) {
      const all = [matrix, ...matrix.inflows].map(model => foresee(model, vector())), colour = 'var(--rx-blade)';
      const [power, index] = [all[0][0], mean(all.map(([, value]) => value))];
      series.push({kind: 'points', label: 'this twist', x: [power], y: [index], colour, size: 6.5});
    }
    Charts.fill(element, {...chart, series}, {width, height});
  }
  // The waves of the front nearest to a pixel of its chart, between two of its points by a straight line.
  function along(element, x, y) {
    const {front, harmonics} = RX.shown('dial'), {X, Y} = element.drawn.place;
    /** @type {{far: number, twist: number[]} | null} */
    let best = null;
    for (let k = 0; k + 1 < front.length; k++) {
      const [[p0, v0, from], [p1, v1, to]] = [front[k], front[k + 1]];
      const x0 = X(p0), y0 = Y(v0), dx = X(p1) - x0, dy = Y(v1) - y0;
      const share = clamp(((x - x0) * dx + (y - y0) * dy) / Math.max(dx ** 2 + dy ** 2, 1e-9), 0, 1);
      const far = Math.hypot(x0 + share * dx - x, y0 + share * dy - y);
      if (!best || far < best.far) best = {far, twist: from.map((value, j) => lerp(value, to[j], share))};
    }
    return best && Object.fromEntries(harmonics.map((n, k) => {
      const [a, b] = [best.twist[2 * k] ?? 0, best.twist[2 * k + 1] ?? 0];
      return [n, [hundredths(Math.hypot(a, b)), direction(a, b)]];
    }));
  }

  // Two meters: the bar is the band over inflow models, the mark the value, the line the same without n/rev.
  function meter(name, models, own, most, least, words) {
    const at = value => 50 + 50 * clamp(value / most, -1, 1), [low, high] = ends(models).map(at);
    const agreed = models.length > 1 && Math.min(...models) * Math.max(...models) > 0;
    const kind = Math.abs(own) < least || !agreed ? '' : own > 0 ? 'loss' : 'gain';
    return `<div class="rxd-meter" role="img" aria-label="${name}: ${words}"><span>${name}</span>
      <div><i style="left:${low}%;width:${high - low}%"></i><s style="left:50%"></s>
        <b data-kind="${kind}" style="left:${at(own)}%"></b></div>
      <em class="rxf-num" data-kind="${kind}">${words}</em></div>`;
  }
  function readout() {
    const dial = RX.shown('dial'), {dial_matrix: matrix, assessed} = RX.state, now = change();
    const [amplitude, phase] = wave(chosen);
    const dim = words => `<p class="rxf-dim">${text(words)}</p>`;
    const others = dial.harmonics.filter(n => n !== chosen && wave(n)[0] > 0)
      .map(n => `, with ${n}/rev ${wave(n)[0].toFixed(2)}°`);  // Power and vibration below are those of all together.
    const head = `<p class="rxf-num"><b>${chosen}/rev</b> ${amplitude.toFixed(2)}° <span class="rxf-dim">at phase
      ${phase.toFixed(0)}°${others.join('')}${beyond(dial) ? ', out of reach' : ''}</span></p>`;
    const wait = dial.computing || !now
      ? dim(dial.words || `${matrix ? 'Other inflow models' : 'Response to n/rev twist'}: computing …`) : '';
    if (!now) return head + wait;
    const [power] = now.power, index = mean(now.index), range = (list, digits) =>
      list.length > 1 ? ` (${ends(list).map(value => signed(value, digits)).join('…')})` : '';
    const whole = matrix ? .06 * matrix.power * dial.per_watt : Math.max(20, 1.4 * Math.abs(power));
    const against = `vs. ${dial.against}, ${dial.where}${held || !dial.settled ? ', predicted' : ''}`;
    const digits = Math.abs(power) < 10 ? 1 : 0;
    const needed = `${signed(power, digits)}${range(now.power, digits)} ${dial.unit}`;
    const shaken = `${signed(index, 0)}${range(now.index, 0)} %`;
    return `${head}${meter('Power', now.power, power, whole, .05, needed)}
      ${now.index.length ? meter('Vibration', now.index, index, 100, .5, shaken) : ''}
      ${dim(assessed ? against : `${verdict()}, ${against}`)}${wait}
      ${held && matrix && !calm.matches ? dim(`Cabin shaking drawn × ${dial.exaggerated}, slowed`) : ''}`;
  }

  function fill(place) {
    const {dial, dial_matrix: matrix, dial_front: chart} = RX.state, large = place.hasAttribute('data-large');
    const width = place.clientWidth - (large ? 44 : 28), scheme = page.dataset.mantineColorScheme;
    if (!dial || width < 120) return;
    const stamp = JSON.stringify([dial, chart, chosen, width, place.clientHeight, held, left && wave(chosen), scheme]);
    if (place.stamp === stamp && place.matrix === matrix && place.childElementCount) return;
    Object.assign(place, {stamp, matrix});
    const {dataset: focus} = place.contains(document.activeElement) ? document.activeElement : place;
    const again = 'dot' in focus ? '[data-dot]' : focus.harmonic ? `[data-harmonic="${focus.harmonic}"]` : null;
    // Enlarged, the front and what is read stand beside the dial where that leaves it large enough.
    const most = Math.min(place.clientHeight - 194, width / 2 - 24, 780), beside = large && most > 180;
    const size = beside ? most : Math.min(width, 300), frontWidth = beside ? width - size - 44 : width;
    const frontHeight = beside ? Math.max(Math.min(place.clientHeight - 284, size + 20), 120) : 228;
    place.toggleAttribute('data-beside', beside);
    const reading = '<div class="rxd-read" data-explorer="dial-read"></div>';
    const button = large
      ? '<button class="rxl-close" data-dial-large aria-label="Close" title="Close (Esc)">×</button>'
      : '<button class="rxd-open" data-dial-large>Enlarge dial and chart</button>';
    write(place, `<div class="rxd-side"><div class="rxd-row"></div>
        <div class="rxd-round" style="width:${size}px;height:${size}px"><canvas></canvas><div></div></div>
        <div class="rxf-dim rxd-key"></div>${beside ? '' : reading}</div>
      <div class="rxd-side"><div class="rxd-front"></div>${beside ? reading : ''}${large ? '' : button}</div>
      ${large ? button : ''}`);
    const [row, canvas, round, key, read, front] =
      ['.rxd-row', 'canvas', '.rxd-round > div', '.rxd-key', '.rxd-read', '.rxd-front']
        .map(name => place.querySelector(name));
    write(row, dial.harmonics.map(small).join(''));
    canvas.hidden = !matrix;
    if (matrix && (canvas.field !== fieldOf() || canvas.scheme !== scheme)) {
      shade(canvas, size);
      Object.assign(canvas, {field: fieldOf(), scheme});
    }
    write(round, dialSvg(size));
    const drawn = matrix ? [dial.computing ? '' : 'P, V: least power, vibration', 'lines: power'] : [];
    const words = [...drawn, dial.whole ? 'dashed ring: reach' : ''].filter(Boolean);
    write(key, (matrix ? COLOUR_KEY : '') + words.map(each => `<span>${each}</span>`).join(' · '));
    write(read, readout());
    drawFront(front, frontWidth, frontHeight);
    if (again) place.querySelector(again)?.focus({preventScroll: true});
  }
  const sized = new ResizeObserver(() => draw());  // Its folder is opened.
  const draw = soon(() => {
    for (const place of document.querySelectorAll('[data-dial]')) {
      sized.observe(place);
      fill(place);
    }
  });
  // What the hand has left holds until the sliders have it; from then on they tell, or an undo would not be seen.
  function arrived([n, [size, phase]]) {
    const [, amplitude, angle] = RX.shown('dial').now.find(([order]) => order === Number(n)) ?? [0, 0, 0];
    return Math.abs(amplitude - size) < .021 && (amplitude < .03 || Math.abs(angle - phase) < .6);
  }
  RX.paint(['dial', 'dial_matrix', 'dial_front', 'assessed'], dial => {
    if (dial && left && Object.entries(left.waves).every(arrived)) left = null;
    draw();
  });
  new ResizeObserver(draw).observe(document.querySelector('.rxf-stage'));
  new MutationObserver(() => { if (document.querySelector('[data-dial]:empty')) draw(); })
    .observe(document.getElementById('root') ?? document.body, {childList: true, subtree: true});

  // The hand, on a dial or along the front. The dot goes where the pointer is; its place is sent now and then.
  const send = waves => RX.send('dial', Object.entries(waves).map(([n, [size, phase]]) => [Number(n), size, phase]));
  const heard = paced(send);
  function leave(waves) {
    left = {waves, at: performance.now()};
    setTimeout(() => { if (left && performance.now() - left.at > 900) left = null; draw(); }, 950);
    draw();
  }
  // Places of the pointer on a dial, with its radius as 1.
  function onDial(circle, {clientX, clientY}) {
    const box = circle.getBoundingClientRect(), radius = box.width / 2 - EDGE;
    return [(clientX - box.left - box.width / 2) / radius, (box.top + box.height / 2 - clientY) / radius];
  }
  function turn(circle, event) {
    const point = onDial(circle, event), size = hundredths(RX.shown('dial').reach * Math.min(Math.hypot(...point), 1));
    return {[chosen]: [size < .04 ? 0 : size, direction(...point)]};  // The middle means none.
  }
  function trade(front, {clientX, clientY}) {
    const box = front.querySelector('svg').getBoundingClientRect();
    return along(front, clientX - box.left, clientY - box.top) ?? held;
  }
  drag(document, '.rxd-round, .rxd-front svg', (pressed, event) => {
    const {dial} = RX.state, circle = pressed.matches('.rxd-round'), place = circle ? pressed : pressed.parentElement;
    if (!dial || !(circle || dial.front.length > 1)) return null;
    if (circle && Math.hypot(...onDial(place, event)) > 1 + (EDGE - 8) / (place.clientWidth / 2 - EDGE)) return null;
    event.preventDefault();
    if (circle) place.querySelector('[data-dot]')?.focus({preventScroll: true});
    RX.send('dial', 'start');
    held = {};
    const move = now => {
      held = (circle ? turn : trade)(place, now);
      heard.send(held);
      draw();
    };
    move(event);
    shake();
    return {
      move,
      end() {
        heard.drop();
        send(held);
        RX.send('dial', 'end');
        const waves = held;
        held = null;
        leave(waves);
      },
    };
  });
  const STEPS = {
    ArrowUp: [.05, 0], ArrowDown: [-.05, 0], PageUp: [.25, 0], PageDown: [-.25, 0],
    ArrowLeft: [0, 5], ArrowRight: [0, -5], Delete: [-99, 0],
  };
  document.addEventListener('keydown', event => {
    const closing = event.key === 'Escape' && page.dataset.enlarged;
    const step = closest(event, '[data-dot]') && STEPS[event.key], many = event.shiftKey ? 5 : 1;
    if (closing || step) event.stopPropagation();
    if (closing) return enlarge(false);
    if (!step) return;
    event.preventDefault();
    const [size, phase] = wave(chosen), wished = clamp(hundredths(size + many * step[0]), 0, RX.shown('dial').reach);
    const waves = {[chosen]: [wished, (phase + many * step[1] + 360) % 360]};
    heard.send(waves);
    leave(waves);
  }, true);

  // While the hand is on the dial, and some seconds longer, the cabin moves as a rigid body under the foreseen loads at
  // N_b/rev, A cos(N_b ψ − φ)/(m (N_b Ω)²): exaggerated and slowed, and not for those who asked for less motion.
  const SHAKES = 2.5, LONGER = 4000;  // [1/s], [ms]
  let shaking = false;
  function shake() {
    if (calm.matches || shaking) return;
    const begun = performance.now();
    let until = Infinity, rest = null, last = null;
    const put = (pose, position) => {
      last = position;
      Object.assign(pose, {position, poseUpdateState: 'needsUpdate'});
      viewer().requestRender?.();
    };
    const step = now => {
      const {dial, dial_matrix: matrix} = RX.state, pose = viewer()?.nodePoseData?.['/airframe'];
      if (held) until = now + LONGER;
      shaking = Boolean(dial && matrix && pose) && now <= until;
      if (!dial || !matrix || !shaking) { if (rest && pose) put(pose, rest); return; }
      if (pose.position !== last) rest = [...pose.position];
      const loads = values(matrix, vector()), angle = 2 * Math.PI * SHAKES * (now - begun) / 1000;
      put(pose, rest.map((value, k) =>
        value + dial.shake * (loads[2 * k] * Math.cos(angle) + loads[2 * k + 1] * Math.sin(angle))));
      requestAnimationFrame(step);
    };
    shaking = true;
    requestAnimationFrame(step);
  }
  document.addEventListener('click', event => {
    const button = closest(event, '[data-harmonic], [data-dial-large]');
    if (!button) return;
    if (!button.dataset.harmonic) return enlarge(!page.dataset.enlarged);
    chosen = Number(button.dataset.harmonic);
    draw();
  });

  // Dial and front over the stage, as large as it allows.
  function enlarge(open) {
    if (open) page.dataset.enlarged = 'large'; else delete page.dataset.enlarged;
    part('large').hidden = !open;
    part('large').innerHTML = open ? '<div class="rxd" data-dial data-large data-explorer="dial-large"></div>' : '';
    draw();
  }
  RX.paint('bar', bar => { if (bar.mode !== 'actuate' && page.dataset.enlarged) enlarge(false); });
})();
